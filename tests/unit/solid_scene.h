/* solid_scene.h -- scenes of boxes in space for the tests of the mesh room, and integrals over their cells and sides. */
#ifndef MORTISE_SOLID_SCENE_H
#define MORTISE_SOLID_SCENE_H

#include "mesh_scene.h"

static const char *const SolidSides[6] = {"left", "right", "front", "back", "bottom", "top"};

static inline void SolidSceneInit(TestScene *t)
{
  TestSceneInit(t);
  t->scene.dim   = 3;
  t->scene.model = MODEL_SOLID;
}

/* [in] faces, lower, upper - [3] */
static inline SceneBody *SolidSceneAddBox(TestScene *t, const char name[], const PetscInt faces[],
                                          const PetscReal lower[], const PetscReal upper[])
{
  SceneBody *body = TestSceneAddBox(t, name, faces[0], faces[1], lower[0], lower[1], upper[0], upper[1]);

  body->faces[2] = faces[2];
  body->lower[2] = lower[2];
  body->upper[2] = upper[2];
  return body;
}

/* [out] X - [num][3] */
static inline void SolidNodes(const Level *level, PetscInt num, const PetscInt nodes[], PetscReal X[])
{
  for (PetscInt i = 0; i < num; ++i) {
    for (int d = 0; d < 3; ++d) X[3 * i + d] = level->coords[3 * nodes[i] + d];
  }
}

/* By quadrature in isoparametric cells, the Jacobian of which is of degree 2 or 5 in each direction. */
static inline PetscReal SolidVolume(const Level *level, PetscInt body)
{
  static ElementRule rule[ELEMENT_COUNT];
  PetscReal          volume = 0;

  for (PetscInt c = 0; c < level->num_cells; ++c) {
    const ElementType type = (ElementType)level->cell_type[c];
    PetscReal         X[3 * ELEMENT_MAX_NODES];

    if (level->cell_body[c] != body) continue;
    if (!rule[type].num) ElementRuleSet(type, ElementOrder(type) > 1 ? 5 : 2, &rule[type]);
    SolidNodes(level, ElementNumNodes(type), &level->cell_nodes[level->cell_start[c]], X);
    for (PetscInt q = 0; q < rule[type].num; ++q)
      volume += rule[type].weight[q] * ElementRuleMap(&rule[type], q, X, NULL, NULL);
  }
  return Total(volume);
}

/* MortarIntegrals over a side: 1, n, x . n. */
typedef struct {
  PetscReal area, normal[3], flux;
} SideSums;

static inline void SolidSumSide(TestScene *t, Level *level, PetscInt body, const char side[], SideSums *sums)
{
  Facets facets;

  *sums = (SideSums){0, {0, 0, 0}, 0};
  CHECK(!LevelGetFacets(level, &t->scene, body, side, &facets));
  for (PetscInt f = 0; f < facets.num; ++f) {
    PetscReal      X[3 * ELEMENT_MAX_FACET_NODES], xi[2 * ELEMENT_MAX_POINTS], weight[ELEMENT_MAX_POINTS];
    const PetscInt n = QuadratureRule(facets.type[f], ElementOrder(facets.type[f]) > 1 ? 6 : 3, xi, weight);

    CHECK(level->cell_body[facets.cell[f]] == body);
    CHECK(facets.type[f] == ElementFacetType((ElementType)level->cell_type[facets.cell[f]]));
    SolidNodes(level, ElementNumNodes(facets.type[f]), &facets.nodes[f * ELEMENT_MAX_FACET_NODES], X);
    for (PetscInt q = 0; q < n; ++q) {
      PetscReal       x[3], normal[3], phi[ELEMENT_MAX_NODES];
      const PetscReal area = weight[q] * ElementSurface(facets.type[f], X, &xi[2 * q], x, phi, normal);

      sums->area += area;
      for (int d = 0; d < 3; ++d) {
        sums->normal[d] += area * normal[d];
        sums->flux += area * x[d] * normal[d];
      }
    }
  }
  CHECK(!FacetsDestroy(&facets));
  sums->area = Total(sums->area);
  sums->flux = Total(sums->flux);
  for (int d = 0; d < 3; ++d) sums->normal[d] = Total(sums->normal[d]);
}

/* Every side of a box: area, outward normal, place. */
static inline void SolidCheckBoxSides(TestScene *t, Level *level, PetscInt body, const PetscReal lower[],
                                      const PetscReal upper[])
{
  for (int s = 0; s < 6; ++s) {
    const int       axis = s / 2, a = (axis + 1) % 3, b = (axis + 2) % 3, sign = s % 2 ? 1 : -1;
    const PetscReal area = (upper[a] - lower[a]) * (upper[b] - lower[b]);
    SideSums        sums;

    SolidSumSide(t, level, body, SolidSides[s], &sums);
    CHECK_NEAR(sums.area, area, 1e-12);
    for (int d = 0; d < 3; ++d) CHECK_NEAR(sums.normal[d], d == axis ? sign * area : 0, 1e-12);
    CHECK_NEAR(sums.flux, sign * area * (s % 2 ? upper[axis] : lower[axis]), 1e-12);
  }
}

#endif

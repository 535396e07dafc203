/* mesh_scene.h -- small scenes by hand for tests of the mesh, without options. */
#ifndef MORTISE_MESH_SCENE_H
#define MORTISE_MESH_SCENE_H

#include "mesh/mesh.h"
#include "constant.h"
#include "base/usererror.h"
#include <string.h>
#include "test.h"

enum { MAX_ITEMS = 8 };

/* A scene and the storage it points into. */
typedef struct {
  struct _n_Scene scene;
  SceneBody       bodies[MAX_ITEMS];
  ScenePair       pairs[MAX_ITEMS];
  SceneBoundary   boundaries[MAX_ITEMS][MAX_ITEMS];
} TestScene;

static inline void TestSceneInit(TestScene *t)
{
  memset(t, 0, sizeof(*t));
  t->scene.comm      = PETSC_COMM_WORLD;
  t->scene.dim       = 2;
  t->scene.model     = MODEL_PLANE_STRAIN;
  t->scene.thickness = 1;
  t->scene.bodies    = t->bodies;
  t->scene.pairs     = t->pairs;
}

/* An elastic box of nx x ny cells with E = 1, nu = 0.3. */
static inline SceneBody *TestSceneAddBox(TestScene *t, const char name[], PetscInt nx, PetscInt ny, PetscReal x0,
                                         PetscReal y0, PetscReal x1, PetscReal y1)
{
  const PetscReal young = 1, poisson = 0.3;
  const PetscInt  b    = t->scene.num_bodies++;
  SceneBody      *body = &t->bodies[b];

  body->name       = (char *)name;
  body->faces[0]   = nx;
  body->faces[1]   = ny;
  body->lower[0]   = x0;
  body->lower[1]   = y0;
  body->upper[0]   = x1;
  body->upper[1]   = y1;
  body->order      = 1;
  body->boundaries = t->boundaries[b];
  CHECK(!ConstantCreate("-young", 1, &young, &body->material.young));
  CHECK(!ConstantCreate("-poisson", 1, &poisson, &body->material.poisson));
  return body;
}

static inline SceneBody *TestSceneAddFile(TestScene *t, const char name[], const char file[], const char region[])
{
  SceneBody *body = TestSceneAddBox(t, name, 0, 0, 0, 0, 0, 0);

  body->mesh_file = (char *)file;
  body->region    = (char *)region;
  return body;
}

/* text NULL for BOUNDARY_NORMAL */
static inline void TestSceneAddBoundary(SceneBody *body, BoundaryKind kind, const char side[], const char text[])
{
  SceneBoundary *boundary = &body->boundaries[body->num_boundaries++];

  boundary->kind  = kind;
  boundary->side  = (char *)side;
  boundary->value = NULL;
  if (text) CHECK(!ExpressionCreate(PETSC_COMM_WORLD, "-value", text, 0, PETSC_TRUE, &boundary->value));
}

static inline ScenePair *TestSceneAddPair(TestScene *t, const char name[], PetscInt nonmortar, const char side[],
                                          PetscInt mortar, const char other[])
{
  ScenePair *pair = &t->pairs[t->scene.num_pairs++];

  pair->name      = (char *)name;
  pair->nonmortar = (SceneSide){nonmortar, (char *)side};
  pair->mortar    = (SceneSide){mortar, (char *)other};
  pair->reach     = -1;
  return pair;
}

static inline void TestSceneSetMap(SceneBody *body, const char text[])
{
  CHECK(!ExpressionCreate(PETSC_COMM_WORLD, "-map", text, 2, PETSC_FALSE, &body->map));
}

static inline void TestSceneFree(TestScene *t)
{
  for (PetscInt b = 0; b < t->scene.num_bodies; ++b) {
    CHECK(!ExpressionDestroy(&t->bodies[b].material.young));
    CHECK(!ExpressionDestroy(&t->bodies[b].material.poisson));
    CHECK(!ExpressionDestroy(&t->bodies[b].material.stiffness));
    CHECK(!ExpressionDestroy(&t->bodies[b].map));
    for (PetscInt i = 0; i < t->bodies[b].num_boundaries; ++i) CHECK(!ExpressionDestroy(&t->boundaries[b][i].value));
  }
}

static inline Mesh TestSceneMesh(TestScene *t)
{
  Mesh mesh;

  CHECK(!MeshCreate(&t->scene, &mesh));
  CHECK(!MeshSetUp(mesh));
  return mesh;
}

static inline PetscReal Total(PetscReal local)
{
  CHECK(!MPI_Allreduce(MPI_IN_PLACE, &local, 1, MPIU_REAL, MPIU_SUM, PETSC_COMM_WORLD));
  return local;
}

/* Points are found in their own bodies only, by one rank, and are where the reference coordinates say. [in] point -
   [num][level->dim]; [in] inside - [num][2] */
static inline void CheckLocate(Level *level, PetscInt num, const PetscReal point[], const PetscBool inside[])
{
  const PetscInt dim = level->dim;

  for (PetscInt p = 0; p < num; ++p) {
    for (PetscInt body = 0; body < 2; ++body) {
      PetscReal xi[3], phi[ELEMENT_MAX_NODES], x[3] = {0, 0, 0};
      PetscInt  cell;
      PetscBool found;

      CHECK(!LevelLocate(level, body, &point[p * dim], &cell, xi, &found));
      CHECK(found == inside[2 * p + body]);
      CHECK_NEAR(Total(cell >= 0), found, 0);
      if (cell < 0) continue;
      CHECK(level->cell_body[cell] == body);
      ElementShape((ElementType)level->cell_type[cell], xi, phi, NULL);
      for (PetscInt i = level->cell_start[cell]; i < level->cell_start[cell + 1]; ++i) {
        for (PetscInt d = 0; d < dim; ++d)
          x[d] += phi[i - level->cell_start[cell]] * level->coords[dim * level->cell_nodes[i] + d];
      }
      for (PetscInt d = 0; d < dim; ++d) CHECK_NEAR(x[d], point[p * dim + d], 1e-14);
    }
  }
}

/* Positions of a cell's nodes. */
static inline void CellCoords(const Level *level, PetscInt c, PetscReal X[])
{
  for (PetscInt i = level->cell_start[c]; i < level->cell_start[c + 1]; ++i) {
    for (int d = 0; d < 2; ++d) X[2 * (i - level->cell_start[c]) + d] = level->coords[2 * level->cell_nodes[i] + d];
  }
}

/* Area of a body by quadrature in its isoparametric cells: positive only where they run anticlockwise. */
static inline PetscReal BodyArea(const Level *level, PetscInt body)
{
  PetscReal area = 0;

  for (PetscInt c = 0; c < level->num_cells; ++c) {
    const ElementType type = (ElementType)level->cell_type[c];
    PetscReal X[2 * ELEMENT_MAX_NODES], xi[2 * ELEMENT_MAX_POINTS], weight[ELEMENT_MAX_POINTS], phi[ELEMENT_MAX_NODES];
    const PetscInt n = QuadratureRule(type, ElementOrder(type) > 1 ? 3 : 1, xi, weight);

    CellCoords(level, c, X);
    for (PetscInt q = 0; q < n && level->cell_body[c] == body; ++q)
      area += weight[q] * ElementMap(type, X, &xi[2 * q], NULL, phi, NULL);
  }
  return Total(area);
}

/* Length of a side, and the sum of its outward normals times length. */
static inline PetscReal SideLength(TestScene *t, Level *level, PetscInt body, const char side[], PetscReal normal[2])
{
  PetscReal length = 0, n[2] = {0, 0};
  Facets    facets;

  CHECK(!LevelGetFacets(level, &t->scene, body, side, &facets));
  for (PetscInt f = 0; f < facets.num; ++f) {
    const PetscReal *a = &level->coords[2 * facets.nodes[f * ELEMENT_MAX_FACET_NODES]];
    const PetscReal *b = &level->coords[2 * facets.nodes[f * ELEMENT_MAX_FACET_NODES + 1]];

    CHECK(level->cell_body[facets.cell[f]] == body);
    n[0] += b[1] - a[1];
    n[1] -= b[0] - a[0];
    length += PetscSqrtReal(PetscSqr(b[0] - a[0]) + PetscSqr(b[1] - a[1]));
  }
  CHECK(!FacetsDestroy(&facets));
  normal[0] = Total(n[0]);
  normal[1] = Total(n[1]);
  return Total(length);
}

#endif

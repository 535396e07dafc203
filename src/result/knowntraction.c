/* knowntraction.c -- how far the recovered stress is from tractions that are known.

   All cells at a surface extrapolate the stress alike, so that neither their differences nor those of meshes
   show what is missing there. The known traction does. */
#include "result/knowntraction.h"
#include "base/compat.h"
#include "kernel/vector.h"
#include "result/cellstress.h"

enum { F = ELEMENT_MAX_FACET_NODES };

/* Returns the facet with such nodes, or -1. */
static PetscInt KnownTractionFind_Private(const KnownTraction *known, const PetscInt nodes[])
{
  for (PetscInt f = 0; f < known->facets.num; f++) {
    const PetscInt num = ElementNumNodes(known->facets.type[f]);
    PetscInt       i   = 0;

    while (i < num && known->facets.nodes[f * F + i] == nodes[i]) i++;
    if (i == num) return f;
  }
  return -1;
}

/* The unit normal at a node of a facet. */
static void KnownTractionGetNormal_Private(const KnownTraction *known, const Level *level, PetscInt f, PetscInt i,
                                           PetscReal n[])
{
  const ElementType type = known->facets.type[f];
  PetscReal         X[F * CELL_MAX_DIM], phi[ELEMENT_MAX_NODES];

  VectorGather(level->dim, ElementNumNodes(type), &known->facets.nodes[f * F], level->coords, X);
  (void)ElementSurface(type, X, ElementNode(type, i), NULL, phi, n);
}

/* Adds a traction or a pressure. */
static PetscErrorCode KnownTractionAdd_Private(const Level *level, const SceneBoundary *load, PetscInt f,
                                               KnownTraction *known)
{
  const PetscInt dim = level->dim;
  PetscReal      n[CELL_MAX_DIM], value[CELL_MAX_DIM];

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < ElementNumNodes(known->facets.type[f]); i++) {
    PetscReal *t = &known->given[(f * F + i) * dim];

    PetscCall(ExpressionEvaluate(load->value, dim, &level->coords[known->facets.nodes[f * F + i] * dim], value));
    KnownTractionGetNormal_Private(known, level, f, i, n);
    for (PetscInt k = 0; k < dim; k++) t[k] += load->kind == BOUNDARY_PRESSURE ? -value[0] * n[k] : value[k];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Takes a side: its load, or what it leaves unknown. Collective.
   [in] load - with side, or NULL; along - whether the part along the side remains known */
static PetscErrorCode KnownTractionTakeSide_Private(Level *level, PetscInt body, const char side[],
                                                    const SceneBoundary *load, PetscBool along, KnownTraction *known)
{
  Facets facets;

  PetscFunctionBeginUser;
  PetscCall(LevelGetFacets(level, level->scene, body, side, &facets));
  for (PetscInt k = 0; k < facets.num; k++) {
    const PetscInt f = KnownTractionFind_Private(known, &facets.nodes[k * F]);

    if (f < 0) continue;
    if (load) {
      PetscCall(KnownTractionAdd_Private(level, load, f, known));
    } else {
      known->normal[f] = PETSC_FALSE;
      known->along[f]  = (PetscBool)(known->along[f] && along);
    }
  }
  PetscCall(FacetsDestroy(&facets));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Keeps the facets of marked cells. */
static void KnownTractionKeep_Private(const PetscInt marked[], Facets *facets)
{
  PetscInt num = 0;

  for (PetscInt k = 0; k < facets->num; k++) {
    if (!marked[facets->cell[k]]) continue;
    facets->type[num] = facets->type[k];
    facets->cell[num] = facets->cell[k];
    for (PetscInt i = 0; i < F; i++) facets->nodes[num * F + i] = facets->nodes[k * F + i];
    num++;
  }
  facets->num = num;
}

/* Whether a facet lies on the axis of revolution. */
static PetscBool KnownTractionIsAxis_Private(const Level *level, const Facets *facets, PetscInt f)
{
  if (level->scene->model != MODEL_AXISYMMETRIC) return PETSC_FALSE;
  for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); i++) {
    if (level->coords[facets->nodes[f * F + i] * level->dim] != 0) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

PetscErrorCode KnownTractionCreate(Level *level, PetscInt body, const PetscReal at[], KnownTraction *known)
{
  const Scene      scene = level->scene;
  const SceneBody *own   = &scene->bodies[body];
  PetscInt        *marked;
  PetscReal        size;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(level->num_cells, &marked));
  PetscCall(LevelLocateAll(level, body, at, marked, &size));
  PetscCall(LevelGetBoundary(level, body, &known->facets));
  KnownTractionKeep_Private(marked, &known->facets);
  PetscCall(PetscFree(marked));
  PetscCall(PetscCalloc3(known->facets.num, &known->normal, known->facets.num, &known->along,
                         known->facets.num * F * level->dim, &known->given));
  for (PetscInt f = 0; f < known->facets.num; f++) {
    known->normal[f] = (PetscBool)!KnownTractionIsAxis_Private(level, &known->facets, f);
    known->along[f]  = PETSC_TRUE;
  }
  for (PetscInt b = 0; b < own->num_boundaries; b++) {
    const SceneBoundary *boundary = &own->boundaries[b];
    const PetscBool plain = (PetscBool)(boundary->kind == BOUNDARY_TRACTION || boundary->kind == BOUNDARY_PRESSURE);

    PetscCall(KnownTractionTakeSide_Private(level, body, boundary->side, plain ? boundary : NULL,
                                            (PetscBool)(boundary->kind == BOUNDARY_NORMAL), known));
  }
  for (PetscInt s = 0; s < 2 * scene->num_pairs; s++) {
    const ScenePair *pair  = &scene->pairs[s / 2];
    const SceneSide *side  = s % 2 ? &pair->mortar : &pair->nonmortar;
    const PetscBool  along = (PetscBool)(pair->type == PAIR_CONTACT && !ScenePairHasFriction(pair));

    if (side->body == body) PetscCall(KnownTractionTakeSide_Private(level, body, side->side, NULL, along, known));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode KnownTractionDestroy(KnownTraction *known)
{
  PetscFunctionBeginUser;
  PetscCall(FacetsDestroy(&known->facets));
  PetscCall(PetscFree3(known->normal, known->along, known->given));
  PetscFunctionReturn(PETSC_SUCCESS);
}

void KnownTractionGetError(const KnownTraction *known, const Level *level, const NodalStressArrays *recovered,
                           PetscInt f, PetscInt i, PetscReal error[])
{
  static const PetscInt ROW[CELL_STRESSES] = {0, 1, 2, 1, 0, 0}, COLUMN[CELL_STRESSES] = {0, 1, 2, 2, 2, 1};
  const PetscInt        dim = level->dim, material = level->cell_material[known->facets.cell[f]];
  PetscReal             n[CELL_MAX_DIM] = {0, 0, 0}, r[CELL_MAX_DIM] = {0, 0, 0}, part;

  KnownTractionGetNormal_Private(known, level, f, i, n);
  CellStressTraction(dim, NodalStressAt(recovered, known->facets.nodes[f * F + i], material), n, r);
  for (PetscInt k = 0; k < dim; k++) r[k] -= known->given[(f * F + i) * dim + k];
  part = VectorDot(dim, r, n);
  for (PetscInt k = 0; k < dim; k++) {
    const PetscReal along = r[k] - part * n[k];

    r[k] = (known->normal[f] ? part * n[k] : 0) + (known->along[f] ? along : 0);
  }
  if (!known->normal[f]) part = 0;
  for (PetscInt k = 0; k < CELL_STRESSES; k++)
    error[k] = r[ROW[k]] * n[COLUMN[k]] + n[ROW[k]] * r[COLUMN[k]] - part * n[ROW[k]] * n[COLUMN[k]];
}

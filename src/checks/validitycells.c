/* validitycells.c -- the neglected share of Green's strain, and rotations: one pass over the cells. */
#include "checks/validityimpl.h"
#include "base/compat.h"
#include "kernel/vector.h"
#include "checks/yielding.h"
#include "level/ghosted.h"

/* Strain and rotation are those that this part of a body's strain energy exceeds. At a corner of infinite
   stress the largest ones grow without limit as cells get smaller. A rotation moves all that hangs on a
   place, so that less is left out of it. Chosen so that two plates on any mesh have what the maxima are on 32
   x 32 and 24 x 24 cells, to 20 per cent. */
static const PetscReal STRAIN_SHARE = 0.01, ROTATION_SHARE = 0.002;
/* The strain, over the displacements and the size of the scene, of a place that counts by its volume: it is
   rounding. */
static const PetscReal STRAINLESS = 1e-12;
/* Slender bodies that are free to shorten yield to nearly all of what is neglected. Where more than this part
   is left, all of it counts: then load factors at small and at large loads are those of one formula. */
static const PetscReal YIELDING_PART = 0.25;
/* A rotation of fewer strains is of no slender body: the square of the strain alone exceeds that part. */
static const PetscReal SLENDER_ROTATION = 2;

/* What is neglected of the strain, the strain and the rotation that a gradient stands for. [in] H - grad u,
   in place 9 the strain around the axis; [in] V - the same of the displacement by which bodies yield, or 0;
   [out] sizes - Frobenius norms of 1/2 H'H + eps(v) and eps, the angle of the rotation */
static void ValidityCellsSplitGradient_Private(PetscInt dim, const PetscReal H[10], const PetscReal V[10],
                                               PetscReal sizes[3])
{
  PetscReal product = PetscSqr(0.5 * H[9] * H[9] + V[9]), strain = H[9] * H[9], turn = 0;

  for (PetscInt i = 0; i < dim; i++) {
    for (PetscInt j = 0; j < dim; j++) {
      PetscReal sum = 0;

      for (PetscInt k = 0; k < dim; k++) sum += H[k * dim + i] * H[k * dim + j];
      product += PetscSqr(0.5 * (sum + V[i * dim + j] + V[j * dim + i]));
      strain += PetscSqr(0.5 * (H[i * dim + j] + H[j * dim + i]));
      if (i < j) turn += PetscSqr(0.5 * (H[i * dim + j] - H[j * dim + i]));
    }
  }
  sizes[0] = PetscSqrtReal(product);
  sizes[1] = PetscSqrtReal(strain);
  sizes[2] = PetscSqrtReal(turn);
}

/* What is found in the cells: the root of what is neglected of the strain, the strain, the rotation. */
enum { NEGLECTED, STRAIN, ROTATION, NUM_SIZES };

/* Adds one cell, by strain energy but for the modulus. [in] u - at local nodes; [in] yielding - v at local
   nodes, or NULL; [in] reference - usual size of grad u; [in,out] sizes - [NUM_SIZES] */
static void ValidityCellsAdd_Private(const Fields fields, PetscInt c, const ElementRule *rule, const PetscScalar u[],
                                     const PetscScalar yielding[], PetscReal reference, LargestBut sizes[])
{
  const Level    *level = fields->vi->level;
  const PetscInt  dim = level->dim, n = ElementNumNodes(rule->type), *nodes = &level->cell_nodes[level->cell_start[c]];
  const PetscBool ring = (PetscBool)(level->scene->model == MODEL_AXISYMMETRIC);
  PetscReal       X[ELEMENT_MAX_NODES * 3], U[ELEMENT_MAX_NODES * 3], Y[ELEMENT_MAX_NODES * 3], x[3], found[NUM_SIZES];

  VectorGather(dim, n, nodes, level->coords, X);
  VectorGather(dim, n, nodes, u, U);
  if (yielding) VectorGather(dim, n, nodes, yielding, Y);
  for (PetscInt q = 0; q < rule->num; q++) {
    PetscReal H[10] = {0}, V[10] = {0}, weight;

    if (yielding) ElementRuleGradient(rule, q, X, Y, x, V);
    weight = PetscAbsReal(ElementRuleGradient(rule, q, X, U, x, H));
    for (PetscInt i = 0; ring && i < n; i++) {
      H[9] += rule->phi[q * n + i] * U[i * dim] / x[0];
      if (yielding) V[9] += rule->phi[q * n + i] * Y[i * dim] / x[0];
    }
    if (ring) weight *= x[0];
    ValidityCellsSplitGradient_Private(dim, H, V, found);
    found[NEGLECTED] = PetscSqrtReal(found[NEGLECTED]);
    weight *= PetscSqr(found[STRAIN] / reference) + PetscSqr(STRAINLESS);
    for (PetscInt k = 0; k < NUM_SIZES; k++)
      LargestButAdd(sizes[k], found[k], weight, dim, x, (PetscInt)level->cell_body[c]);
  }
}

/* All cells of this rank. [in] yielding - of YieldingCreate(), or NULL; [in] reference, [in,out] sizes - of
   ValidityCellsAdd_Private() */
static PetscErrorCode ValidityCellsAddAll_Private(Fields fields, Vec yielding, PetscReal reference, LargestBut sizes[])
{
  const Level       *level = fields->vi->level;
  ElementRule       *rule;
  const PetscScalar *u, *v = NULL;
  PetscInt           type = -1;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&rule));
  PetscCall(GhostedGetArrayRead(fields->u, &u));
  if (yielding) PetscCall(GhostedGetArrayRead(yielding, &v));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    if (level->cell_type[c] != type) {
      type = level->cell_type[c];
      ElementRuleSet((ElementType)type, ElementStiffnessDegree((ElementType)type), rule);
    }
    ValidityCellsAdd_Private(fields, c, rule, u, v, reference, sizes);
  }
  if (yielding) PetscCall(GhostedRestoreArrayRead(yielding, &v));
  PetscCall(GhostedRestoreArrayRead(fields->u, &u));
  PetscCall(PetscFree(rule));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* [in] yielding - of YieldingCreate(), or NULL; [out] found - quantiles [NUM_SIZES] */
static PetscErrorCode ValidityCellsFind_Private(Fields fields, Vec yielding, PetscReal reference, Largest found[])
{
  const PetscReal share[NUM_SIZES] = {STRAIN_SHARE, STRAIN_SHARE, ROTATION_SHARE};
  const Level    *level            = fields->vi->level;
  LargestBut      sizes[NUM_SIZES];

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < NUM_SIZES; k++)
    PetscCall(LargestButCreate(fields->vi->scene->num_bodies, reference, &sizes[k]));
  PetscCall(ValidityCellsAddAll_Private(fields, yielding, reference, sizes));
  for (PetscInt k = 0; k < NUM_SIZES; k++) {
    PetscCall(LargestButGet(sizes[k], level->comm, level->dim, share[k], &found[k]));
    PetscCall(LargestButDestroy(&sizes[k]));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ValidityCellsMeasure(Fields fields, Largest largest[VALIDITY_COUNT], PetscReal *strain)
{
  const PetscReal reference = fields->u_ref > 0 ? fields->u_ref / fields->vi->length : 1;
  Largest         found[NUM_SIZES], left[NUM_SIZES];
  Vec             yielding = NULL;

  PetscFunctionBeginUser;
  PetscCall(ValidityCellsFind_Private(fields, NULL, reference, found));
  *strain = found[STRAIN].value;
  if (PetscSqr(found[NEGLECTED].value) > VALIDITY_GREEN_STRAIN * *strain && *strain > STRAINLESS * reference &&
      found[ROTATION].value > SLENDER_ROTATION * *strain)
    PetscCall(YieldingCreate(fields, &yielding));
  if (yielding) {
    PetscCall(ValidityCellsFind_Private(fields, yielding, reference, left));
    if (PetscSqr(left[NEGLECTED].value / found[NEGLECTED].value) < YIELDING_PART) found[NEGLECTED] = left[NEGLECTED];
    PetscCall(VecDestroy(&yielding));
  }
  largest[VALIDITY_STRAIN]       = found[NEGLECTED];
  largest[VALIDITY_STRAIN].value = PetscSqr(found[NEGLECTED].value);
  if (*strain > STRAINLESS * reference)
    largest[VALIDITY_STRAIN].value /= *strain;
  else
    largest[VALIDITY_STRAIN].value = 0; // rigid motions have no strain, and no error of it
  largest[VALIDITY_ROTATION] = found[ROTATION];
  PetscFunctionReturn(PETSC_SUCCESS);
}

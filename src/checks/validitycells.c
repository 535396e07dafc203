/* validitycells.c -- the neglected share of Green's strain, and rotations: one pass over the cells. */
#include "checks/validityimpl.h"
#include "base/compat.h"
#include "kernel/vector.h"
#include "level/ghosted.h"

/* Strain and rotation are those that this part of a body's strain energy exceeds. At a corner of infinite
   stress the largest ones grow without limit as cells get smaller. A rotation moves all that hangs on a
   place, so that less is left out of it. Chosen so that two plates on any mesh have what the maxima are on 32
   x 32 and 24 x 24 cells, to 20 per cent. */
static const PetscReal STRAIN_SHARE = 0.01, ROTATION_SHARE = 0.002;
/* The strain, over the displacements and the size of the scene, of a place that counts by its volume: it is
   rounding. */
static const PetscReal STRAINLESS = 1e-12;

/* What is neglected of the strain, the strain and the rotation that a gradient stands for. [in] H - grad u,
   in place 9 the strain around the axis; [out] sizes - Frobenius norms of 1/2 H'H and eps, the angle of the
   rotation */
static void ValidityCellsSplitGradient_Private(PetscInt dim, const PetscReal H[10], PetscReal sizes[3])
{
  PetscReal product = PetscSqr(0.5 * H[9] * H[9]), strain = H[9] * H[9], turn = 0;

  for (PetscInt i = 0; i < dim; i++) {
    for (PetscInt j = 0; j < dim; j++) {
      PetscReal sum = 0;

      for (PetscInt k = 0; k < dim; k++) sum += H[k * dim + i] * H[k * dim + j];
      product += PetscSqr(0.5 * sum);
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

/* Adds one cell, by strain energy but for the modulus. [in] u - at local nodes; [in] reference - usual size
   of grad u; [in,out] sizes - [NUM_SIZES] */
static void ValidityCellsAdd_Private(const Fields fields, PetscInt c, const ElementRule *rule, const PetscScalar u[],
                                     PetscReal reference, LargestBut sizes[])
{
  const Level    *level = fields->vi->level;
  const PetscInt  dim = level->dim, n = ElementNumNodes(rule->type), *nodes = &level->cell_nodes[level->cell_start[c]];
  const PetscBool ring = (PetscBool)(level->scene->model == MODEL_AXISYMMETRIC);
  PetscReal       X[ELEMENT_MAX_NODES * 3], v[ELEMENT_MAX_NODES * 3], x[3], found[NUM_SIZES];

  VectorGather(dim, n, nodes, level->coords, X);
  VectorGather(dim, n, nodes, u, v);
  for (PetscInt q = 0; q < rule->num; q++) {
    PetscReal H[10] = {0}, weight;

    weight = PetscAbsReal(ElementRuleGradient(rule, q, X, v, x, H));
    for (PetscInt i = 0; ring && i < n; i++) H[9] += rule->phi[q * n + i] * v[i * dim] / x[0];
    if (ring) weight *= x[0];
    ValidityCellsSplitGradient_Private(dim, H, found);
    found[NEGLECTED] = PetscSqrtReal(found[NEGLECTED]);
    weight *= PetscSqr(found[STRAIN] / reference) + PetscSqr(STRAINLESS);
    for (PetscInt k = 0; k < NUM_SIZES; k++)
      LargestButAdd(sizes[k], found[k], weight, dim, x, (PetscInt)level->cell_body[c]);
  }
}

/* All cells of this rank. [in] reference, [in,out] sizes - of ValidityCellsAdd_Private() */
static PetscErrorCode ValidityCellsAddAll_Private(Fields fields, PetscReal reference, LargestBut sizes[])
{
  const Level       *level = fields->vi->level;
  ElementRule       *rule;
  const PetscScalar *u;
  PetscInt           type = -1;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&rule));
  PetscCall(GhostedGetArrayRead(fields->u, &u));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    if (level->cell_type[c] != type) {
      type = level->cell_type[c];
      ElementRuleSet((ElementType)type, ElementStiffnessDegree((ElementType)type), rule);
    }
    ValidityCellsAdd_Private(fields, c, rule, u, reference, sizes);
  }
  PetscCall(GhostedRestoreArrayRead(fields->u, &u));
  PetscCall(PetscFree(rule));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ValidityCellsMeasure(Fields fields, Largest largest[VALIDITY_COUNT], PetscReal *strain)
{
  const PetscReal share[NUM_SIZES] = {STRAIN_SHARE, STRAIN_SHARE, ROTATION_SHARE};
  const Level    *level            = fields->vi->level;
  const PetscReal reference        = fields->u_ref > 0 ? fields->u_ref / fields->vi->length : 1;
  LargestBut      sizes[NUM_SIZES];
  Largest         found[NUM_SIZES];

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < NUM_SIZES; k++)
    PetscCall(LargestButCreate(fields->vi->scene->num_bodies, reference, &sizes[k]));
  PetscCall(ValidityCellsAddAll_Private(fields, reference, sizes));
  for (PetscInt k = 0; k < NUM_SIZES; k++) {
    PetscCall(LargestButGet(sizes[k], level->comm, level->dim, share[k], &found[k]));
    PetscCall(LargestButDestroy(&sizes[k]));
  }
  *strain                        = found[STRAIN].value;
  largest[VALIDITY_STRAIN]       = found[NEGLECTED];
  largest[VALIDITY_STRAIN].value = PetscSqr(found[NEGLECTED].value);
  if (*strain > STRAINLESS * reference)
    largest[VALIDITY_STRAIN].value /= *strain;
  else
    largest[VALIDITY_STRAIN].value = 0; // rigid motions have no strain, and no error of it
  largest[VALIDITY_ROTATION] = found[ROTATION];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* thinbodies.c -- bodies so thin that a factorization is cheaper than an iteration.

   A front moves through the bodies along one axis. A node enters it where its first cell begins and leaves it
   where its last cell ends. An unknown that is eliminated then couples with those in the front: a frontal
   factorization [1]. Its operations are the squares of the front sizes. Nested dissection needs fewer for
   bodies as thick as long, but not for a sheet, a strip or a beam. Its ordering alone takes the time of such
   a solve.

   References: [1] Irons, A frontal solution program for finite element analysis, 1970. */
#include "base/compat.h"
#include "solve/costmodel.h"
#include "solve/thinbodies.h"

/* Intervals along an axis. */
enum { INTERVALS = 4096, SOLID = 3 };
/* Least number of products of an iteration: supported bodies, and with a proximal term. */
static const PetscReal SUPPORTED_PRODUCTS = 100, FLOATING_PRODUCTS = 1000;
/* Assumed number of active sets. */
static const PetscReal ASSUMED_SETS = 10;

/* End and, negative, begin of each node along each axis. [out] ends - to be destroyed by the caller, 2 dim
   per node */
static PetscErrorCode ThinBodiesEnds_Private(Level *level, Vec *ends)
{
  const PetscInt dim = level->dim;
  Vec            local;
  PetscScalar   *a;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, 2 * dim, ends));
  PetscCall(VecGhostGetLocalForm(*ends, &local));
  PetscCall(VecSet(local, PETSC_NINFINITY));
  PetscCall(VecGetArray(local, &a));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const PetscInt *nodes = &level->cell_nodes[level->cell_start[c]],
                   num    = level->cell_start[c + 1] - level->cell_start[c];
    PetscReal max[2 * SOLID];

    for (PetscInt k = 0; k < 2 * dim; k++) max[k] = PETSC_NINFINITY;
    for (PetscInt i = 0; i < num; i++)
      for (PetscInt k = 0; k < dim; k++) {
        max[2 * k]     = PetscMax(max[2 * k], level->coords[nodes[i] * dim + k]);
        max[2 * k + 1] = PetscMax(max[2 * k + 1], -level->coords[nodes[i] * dim + k]);
      }
    for (PetscInt i = 0; i < num; i++)
      for (PetscInt k = 0; k < 2 * dim; k++)
        a[nodes[i] * 2 * dim + k] = PetscMax(PetscRealPart(a[nodes[i] * 2 * dim + k]), max[k]);
  }
  PetscCall(VecRestoreArray(local, &a));
  PetscCall(VecGhostRestoreLocalForm(*ends, &local));
  PetscCall(LevelShareVec(*ends, MAX_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The cost along one axis. [in] a - of ends; [out] operations; [out] front - unknowns of the largest front */
static PetscErrorCode ThinBodiesWalk_Private(const Level *level, const PetscScalar a[], PetscInt axis,
                                             PetscReal *operations, PetscReal *front)
{
  const PetscInt dim    = level->dim;
  PetscReal      end[2] = {PETSC_NINFINITY, PETSC_NINFINITY}, scale, open = 0;
  PetscInt      *num; // nodes that leave in each interval, then nodes that enter

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < level->num_owned; i++)
    for (PetscInt k = 0; k < 2; k++) end[k] = PetscMax(end[k], PetscRealPart(a[(i * dim + axis) * 2 + k]));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, end, 2, MPIU_REAL, MPI_MAX, level->comm));
  scale = end[0] + end[1] > 0 ? INTERVALS * (1 - PETSC_SMALL) / (end[0] + end[1]) : 0;
  PetscCall(PetscCalloc1(2 * INTERVALS, &num));
  for (PetscInt i = 0; i < level->num_owned; i++) {
    const PetscReal hi = PetscRealPart(a[(i * dim + axis) * 2]), lo = -PetscRealPart(a[(i * dim + axis) * 2 + 1]);

    num[(PetscInt)PetscFloorReal((hi + end[1]) * scale)]++;
    num[INTERVALS + (PetscInt)PetscFloorReal((lo + end[1]) * scale)]++;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, num, 2 * INTERVALS, MPIU_INT, MPI_SUM, level->comm));
  *operations = *front = 0;
  for (PetscInt p = 0; p < INTERVALS; p++) {
    const PetscReal closed = (PetscReal)num[p], opened = (PetscReal)num[INTERVALS + p];
    const PetscReal all = (PetscReal)dim * PetscMax(open, closed), left = all - (PetscReal)dim * closed;

    *operations += (PetscPowRealInt(all, 3) - PetscPowRealInt(left, 3)) / 3;
    open += opened - closed;
    *front = PetscMax(*front, (PetscReal)dim * open);
  }
  PetscCall(PetscFree(num));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ThinBodiesAreCheap(VI vi, PetscBool floating, PetscInt num, PetscBool one, PetscBool *cheap)
{
  const PetscReal    bounded = (PetscReal)num;
  const PetscScalar *a;
  PetscReal          least = PETSC_MAX_REAL, unit;
  Vec                ends;

  PetscFunctionBeginUser;
  PetscCall(CostModelUnit(vi, &unit));
  PetscCall(ThinBodiesEnds_Private(vi->level, &ends));
  PetscCall(VecGetArrayRead(ends, &a));
  for (PetscInt axis = 0; axis < vi->level->dim; axis++) {
    PetscReal operations, front;

    PetscCall(ThinBodiesWalk_Private(vi->level, a, axis, &operations, &front));
    /* bounded unknowns that come last couple with half of all eliminated ones, with a quarter of each half,
       and so on */
    if (one) operations += 2 * front * PetscSqr(bounded) + ASSUMED_SETS * CostModelPerSet(num);
    if (!one) operations *= ASSUMED_SETS;
    least = PetscMin(least, operations);
  }
  PetscCall(VecRestoreArrayRead(ends, &a));
  PetscCall(VecDestroy(&ends));
  *cheap = (PetscBool)(least <= (floating ? FLOATING_PRODUCTS : SUPPORTED_PRODUCTS) * unit);
  PetscCall(PetscInfo(vi->K, "a frontal factorization takes %g products\n", (double)(least / unit)));
  PetscFunctionReturn(PETSC_SUCCESS);
}

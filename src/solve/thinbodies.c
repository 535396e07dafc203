/* thinbodies.c -- structures so thin that factoring them is cheaper than to iterate.

   Walk through the bodies along one axis. A node is open from where its first cell begins to where its last one ends, and an unknown that is
   eliminated when it closes meets those of open nodes: a frontal factorisation [1], whose operations are the squares of the fronts' sizes. An order made by
   dissection takes fewer where bodies are as thick as long, but not next to that of a sheet, a strip or a beam, and to find it takes the
   time that such a one is solved in.

   References: [1] Irons, A frontal solution program for finite element analysis, 1970. */
#include "base/compat.h"
#include "solve/costmodel.h"
#include "solve/thinbodies.h"

/* Places along an axis that are told from one another. */
enum { PLACES = 4096, SOLID = 3 };
/* Products that an iteration takes at least where supports hold all bodies, and where springs do. */
static const PetscReal HELD = 100, FLOATS = 1000;
/* Active sets to reckon with. */
static const PetscReal SETS = 10;

/* Where nodes close and, negative, where they open, along each axis. [out] ends - to be destroyed by the caller, 2 dim for each node */
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

/* Along one axis. [in] a - of the vector above; [out] operations; [out] front - unknowns of the largest one */
static PetscErrorCode ThinBodiesWalk_Private(const Level *level, const PetscScalar a[], PetscInt axis,
                                             PetscReal *operations, PetscReal *front)
{
  const PetscInt dim    = level->dim;
  PetscReal      end[2] = {PETSC_NINFINITY, PETSC_NINFINITY}, scale, open = 0;
  PetscInt      *num; // that close at each place, then that open there

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < level->num_owned; i++)
    for (PetscInt k = 0; k < 2; k++) end[k] = PetscMax(end[k], PetscRealPart(a[(i * dim + axis) * 2 + k]));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, end, 2, MPIU_REAL, MPI_MAX, level->comm));
  scale = PLACES * (1 - PETSC_SMALL) / PetscMax(end[0] + end[1], PETSC_SMALL);
  PetscCall(PetscCalloc1(2 * PLACES, &num));
  for (PetscInt i = 0; i < level->num_owned; i++) {
    const PetscReal hi = PetscRealPart(a[(i * dim + axis) * 2]), lo = -PetscRealPart(a[(i * dim + axis) * 2 + 1]);

    num[(PetscInt)PetscFloorReal((hi + end[1]) * scale)]++;
    num[PLACES + (PetscInt)PetscFloorReal((lo + end[1]) * scale)]++;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, num, 2 * PLACES, MPIU_INT, MPI_SUM, level->comm));
  *operations = *front = 0;
  for (PetscInt p = 0; p < PLACES; p++) {
    const PetscReal closed = (PetscReal)num[p], opened = (PetscReal)num[PLACES + p];
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
    /* unknowns with bounds that are left to the end meet half of all eliminations, a quarter of each half, and so on */
    if (one) operations += 2 * front * PetscSqr(bounded) + SETS * CostModelPerSet(num);
    if (!one) operations *= SETS;
    least = PetscMin(least, operations);
  }
  PetscCall(VecRestoreArrayRead(ends, &a));
  PetscCall(VecDestroy(&ends));
  *cheap = (PetscBool)(least <= (floating ? FLOATS : HELD) * unit);
  PetscCall(PetscInfo(vi->K, "a frontal factorisation takes %g products\n", (double)(least / unit)));
  PetscFunctionReturn(PETSC_SUCCESS);
}

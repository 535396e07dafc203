/* rigidgaps.c -- whether rigid motions take given gaps: the least squares problem C q = gaps. */
#include "base/compat.h"
#include "kernel/dense.h"
#include "rigid/rigidimpl.h"

/* Eigenvalues of C'C, and squares of residuals, below this part of the largest are zero. */
static const PetscReal TAKEN_GAP = 1e-12;

PetscErrorCode SolvabilityTakesGaps(VI vi, Solvability s, const PetscReal gaps[], PetscBool *takes)
{
  const PetscInt m = s->m;
  PetscReal     *gram, *sums, *values, *V, *q, largest = 0;
  PetscReal      off[2] = {0, 0}; // squares of the residual and of the gaps

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc4(m * m + m, &gram, m, &values, m * m, &V, m, &q));
  sums = &gram[m * m];
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const PetscReal *row = &s->nodal.rows[r * m], gap = vi->row_direction[r] ? 0 : gaps[vi->row_pair[r]];

    for (PetscInt i = 0; i < m; i++) {
      sums[i] += row[i] * gap;
      for (PetscInt j = 0; j < m; j++) gram[i * m + j] += row[i] * row[j];
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, gram, (PetscMPIInt)(m * m + m), MPIU_REAL, MPI_SUM, vi->level->comm));
  DenseEigen(m, gram, values, V);
  for (PetscInt i = 0; i < m; i++) largest = PetscMax(largest, values[i]);
  for (PetscInt i = 0; i < m; i++) {
    PetscReal part = 0;

    if (!(values[i] > TAKEN_GAP * largest)) continue;
    for (PetscInt k = 0; k < m; k++) part += V[k * m + i] * sums[k] / values[i];
    for (PetscInt k = 0; k < m; k++) q[k] += part * V[k * m + i];
  }
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const PetscReal gap  = vi->row_direction[r] ? 0 : gaps[vi->row_pair[r]];
    PetscReal       left = gap;

    for (PetscInt k = 0; k < m; k++) left -= s->nodal.rows[r * m + k] * q[k];
    off[0] += PetscSqr(left);
    off[1] += PetscSqr(gap);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, off, 2, MPIU_REAL, MPI_SUM, vi->level->comm));
  *takes = (PetscBool)(off[1] > 0 && off[0] <= TAKEN_GAP * off[1]);
  PetscCall(PetscFree4(gram, values, V, q));
  PetscFunctionReturn(PETSC_SUCCESS);
}

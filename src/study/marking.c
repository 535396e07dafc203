/* marking.c -- a histogram of the logarithms of eta_T^2, summed from above. */
#include "base/compat.h"
#include "study/marking.h"
#include <math.h>

enum {
  BINS_OF_OCTAVE = 64,                 /* a bin is 1.1 per cent wide */
  NUM_BINS       = 64 * BINS_OF_OCTAVE /* cells with less than 2^-64 of the largest have no part in it */
};

static const PetscReal EQUAL_PARTS = 1e-6; /* of the share: a sum of equal parts may miss it by that */

/* The bin of a value, counted from that of the largest one downwards. */
static PetscInt MarkingGetBin_Private(PetscReal largest, PetscReal value)
{
  const PetscReal octaves =
      floor(BINS_OF_OCTAVE * PetscLog2Real(largest)) - floor(BINS_OF_OCTAVE * PetscLog2Real(value));

  return value > 0 && octaves < NUM_BINS ? (PetscInt)octaves : NUM_BINS;
}

PetscErrorCode MarkingCreate(const Level *level, Estimate estimate, PetscReal share, PetscBool **marked)
{
  PetscReal *sums, largest = 0, sum = 0;
  PetscInt   last = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(level->num_cells, marked));
  PetscCall(PetscCalloc1(NUM_BINS + 1, &sums));
  for (PetscInt c = 0; c < level->num_cells; c++) largest = PetscMax(largest, estimate->cell[c]);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPIU_REAL, MPIU_MAX, level->comm));
  for (PetscInt c = 0; c < level->num_cells; c++)
    sums[MarkingGetBin_Private(largest, estimate->cell[c])] += estimate->cell[c];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, NUM_BINS + 1, MPIU_REAL, MPI_SUM, level->comm));
  while (last < NUM_BINS && (sum += sums[last]) < (share - EQUAL_PARTS) * estimate->squared) last++;
  for (PetscInt c = 0; c < level->num_cells; c++)
    (*marked)[c] = (PetscBool)(MarkingGetBin_Private(largest, estimate->cell[c]) <= last);
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

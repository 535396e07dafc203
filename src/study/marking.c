/* marking.c -- a histogram of the logarithms of eta_T^2, summed from above. */
#include "base/compat.h"
#include "study/marking.h"
#include <math.h>

enum {
  BINS_OF_OCTAVE = 64,                  /* a bin is 1.1 per cent wide */
  NUM_BINS       = 64 * BINS_OF_OCTAVE, /* cells with less than 2^-64 of the largest value are not marked */
  MAX_HALVINGS   = 2,                   /* of an edge at once: a solution tells little of much smaller cells */
  OCTAVES_LEFT   = 2                    /* expected decrease of the sum over a halved cell, in powers of 2 */
};

static const PetscReal EQUAL_PARTS = 1e-6; /* relative roundoff of a sum that is compared with the share */
static const PetscReal LEAST_GROWTH =
    1.12; /* of the number of cells, without conforming closure: below, more are marked */
static const PetscReal LARGE_ERROR =
    0.01; /* eta^2 of |u|_a^2: above, the places of the largest errors may still change */

/* The bin of a value; bin 0 has the largest value. */
static PetscInt MarkingGetBin_Private(PetscReal largest, PetscReal value)
{
  const PetscReal octaves =
      floor(BINS_OF_OCTAVE * PetscLog2Real(largest)) - floor(BINS_OF_OCTAVE * PetscLog2Real(value));

  return value > 0 && octaves < NUM_BINS ? (PetscInt)octaves : NUM_BINS;
}

/* Sum of eta_T^2, and number, of the cells of a bin. */
typedef struct {
  PetscReal squared, cells;
} Bin;

/* Moves the cells of the largest bins, whose sum is a share of all, to the bins expected of their halves.
   Returns the last bin moved.
   [in] step - distance of the bins of a cell and of its parts; [in,out] bins - [NUM_BINS + 1] */
static PetscInt MarkingHalve_Private(PetscInt dim, PetscInt step, PetscReal share, Bin bins[])
{
  PetscReal sum = 0, marked = 0;
  PetscInt  last = 0;

  for (PetscInt b = 0; b <= NUM_BINS; b++) sum += bins[b].squared;
  while (last < NUM_BINS && (marked += bins[last].squared) < (share - EQUAL_PARTS) * sum) last++;
  for (PetscInt b = last; b >= 0; b--) {
    Bin *parts = &bins[PetscMin(NUM_BINS, b + step)];

    parts->squared += bins[b].squared / (1 << OCTAVES_LEFT);
    parts->cells += bins[b].cells * (1 << dim);
    bins[b] = (Bin){0};
  }
  return last;
}

PetscErrorCode MarkingCreate(const Level *level, Estimate estimate, PetscReal share, PetscInt **marked)
{
  const PetscInt step    = (level->dim + OCTAVES_LEFT) * BINS_OF_OCTAVE;
  PetscReal      largest = 0, before = 0, cells = 0;
  PetscInt       last[MAX_HALVINGS], num = 0;
  Bin           *bins;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(level->num_cells, marked));
  PetscCall(PetscCalloc1(NUM_BINS + 1, &bins));
  for (PetscInt c = 0; c < level->num_cells; c++) largest = PetscMax(largest, estimate->cell[c]);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPIU_REAL, MPIU_MAX, level->comm));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    Bin *bin = &bins[MarkingGetBin_Private(largest, estimate->cell[c])];

    bin->squared += estimate->cell[c];
    bin->cells++;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, bins, 2 * (NUM_BINS + 1), MPIU_REAL, MPI_SUM, level->comm));
  for (PetscInt b = 0; b <= NUM_BINS; b++) before += bins[b].cells;
  while (num < (estimate->squared > LARGE_ERROR * estimate->norm ? 1 : MAX_HALVINGS) && cells < LEAST_GROWTH * before) {
    last[num++] = MarkingHalve_Private(level->dim, step, share, bins);
    cells       = 0;
    for (PetscInt b = 0; b <= NUM_BINS; b++) cells += bins[b].cells;
  }
  for (PetscInt c = 0; c < level->num_cells; c++) {
    PetscInt bin = MarkingGetBin_Private(largest, estimate->cell[c]);

    (*marked)[c] = 0;
    for (PetscInt i = 0; i < num; i++) {
      if (bin > last[i]) continue;
      (*marked)[c]++;
      bin += step;
    }
  }
  PetscCall(PetscFree(bins));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* marking.c -- a histogram of the logarithms of eta_T^2, summed from above. */
#include "base/compat.h"
#include "study/marking.h"
#include <math.h>

enum {
  BINS_OF_OCTAVE = 64,                  /* a bin is 1.1 per cent wide */
  NUM_BINS       = 64 * BINS_OF_OCTAVE, /* cells with less than 2^-64 of the largest value are not marked */
  MAX_HALVINGS   = 4,                   /* rounds of marks: a solution tells little of much smaller cells */
  MAX_GRADED     = 8,                   /* the same of marks that are graded to vertices, which make few cells */
  OCTAVES_LEFT   = 2                    /* expected decrease of the sum over a halved cell, in powers of 2 */
};

static const PetscReal EQUAL_PARTS = 1e-6; /* relative roundoff of a sum that is compared with the share */
static const PetscReal CLOSURE =
    1.8; /* simplices made where one is asked for, since others are bisected until no node hangs; counted in the plane */
static const PetscReal GROWTH_OF_SHARE =
    1.3; /* cells to be added to each one, in shares of 1; with fewer, more are marked */
static const PetscReal LEAST_GROWTH =
    1.12; /* with larger errors, and with small enough ones: of the cells, without CLOSURE */
/* Of eta^2 in |u|_a^2. Above, the places of the largest errors may still change. */
static const PetscReal LARGE_ERROR  = 0.01;  /* no cell is marked again */
static const PetscReal MEDIUM_ERROR = 0.001; /* cells are marked again for LEAST_GROWTH alone */

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

/* The cells of all processes, and those expected of the halved ones. */
typedef struct {
  PetscInt  dim;
  PetscInt  step;    /* distance of the bins of a cell and of its parts */
  PetscReal squared; /* sum over all bins */
  PetscReal cells;
  Bin       bins[NUM_BINS + 1];
} Histogram;

/* Collective. [in] largest - value of a cell on any process */
static PetscErrorCode MarkingCount_Private(const Level *level, const PetscReal cell[], PetscReal largest,
                                           Histogram *all)
{
  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(all, 1));
  all->dim  = level->dim;
  all->step = (level->dim + OCTAVES_LEFT) * BINS_OF_OCTAVE;
  for (PetscInt c = 0; c < level->num_cells; c++) {
    Bin *bin = &all->bins[MarkingGetBin_Private(largest, cell[c])];

    bin->squared += cell[c];
    bin->cells++;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, all->bins, 2 * (NUM_BINS + 1), MPIU_REAL, MPI_SUM, level->comm));
  for (PetscInt b = 0; b <= NUM_BINS; b++) {
    all->squared += all->bins[b].squared;
    all->cells += all->bins[b].cells;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Moves the cells of the largest bins to the bins expected of their halves. It ends where the sum of those
   moved is a share of all, or where there are enough cells. Returns the last bin moved. */
static PetscInt MarkingHalve_Private(Histogram *all, PetscReal share, PetscReal enough)
{
  const PetscReal wanted = (share - EQUAL_PARTS) * all->squared;
  const PetscReal parts = (PetscReal)(1 << all->dim), left = 1. / (1 << OCTAVES_LEFT);
  PetscReal       marked = 0;
  PetscInt        last   = -1;

  do {
    last++;
    marked += all->bins[last].squared;
    all->squared -= (1 - left) * all->bins[last].squared;
    all->cells += (parts - 1) * all->bins[last].cells;
  } while (last < NUM_BINS && marked < wanted && all->cells < enough);
  for (PetscInt b = last; b >= 0; b--) {
    const Bin halved = all->bins[b];
    Bin      *part   = &all->bins[PetscMin(NUM_BINS, b + all->step)];

    all->bins[b] = (Bin){0};
    part->squared += left * halved.squared;
    part->cells += parts * halved.cells;
  }
  return last;
}

/* Cells that are made, on the average, where one is asked for. Collective. */
static PetscErrorCode MarkingGetClosure_Private(const Level *level, PetscReal *closure)
{
  PetscReal count[2] = {0, (PetscReal)level->num_cells}; // simplices, all

  PetscFunctionBeginUser;
  for (PetscInt c = 0; c < level->num_cells; c++)
    count[0] += ElementNumFacets((ElementType)level->cell_type[c]) == level->dim + 1;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, count, 2, MPIU_REAL, MPI_SUM, level->comm));
  *closure = 1 + (CLOSURE - 1) * count[0] / count[1];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* How often cells are marked, in rounds. Marks of MAX_HALVINGS rounds halve edges too often for one level of
   multigrid if they are not graded. */
typedef struct {
  PetscInt  num, last[MAX_GRADED]; /* rounds, and the last bin of each one */
  PetscBool graded;                /* whether marks are graded to vertices */
} Rounds;

/* Makes rounds of marks until there are enough cells, at most so many. */
static void MarkingAddRounds_Private(Histogram *all, PetscReal share, PetscReal enough, PetscInt most, Rounds *rounds)
{
  while (rounds->num < most && all->cells < enough)
    rounds->last[rounds->num++] = MarkingHalve_Private(all, share, enough);
}

/* Sets the marks of this process. Collective.
   [out] marked - [num_cells]; [out] num - of marked cells on all processes */
static PetscErrorCode MarkingSet_Private(const Level *level, const PetscReal cell[], PetscReal largest,
                                         const Histogram *all, const Rounds *rounds, PetscInt marked[], PetscReal *num)
{
  PetscFunctionBeginUser;
  *num = 0;
  for (PetscInt c = 0; c < level->num_cells; c++) {
    PetscInt bin = MarkingGetBin_Private(largest, cell[c]);

    marked[c] = 0;
    for (PetscInt i = 0; i < rounds->num; i++) {
      if (bin > rounds->last[i]) continue;
      marked[c]++;
      bin += all->step;
    }
    *num += marked[c] > 0;
    if (rounds->graded) marked[c] = -marked[c];
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, num, 1, MPIU_REAL, MPI_SUM, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MarkingCreate(const Level *level, const PetscReal cell[], PetscReal norm, PetscReal share,
                             PetscBool least, PetscInt **marked, PetscReal *growth)
{
  PetscReal  largest = 0, closure = 0, squared, before, enough, num;
  Rounds     rounds = {0};
  Histogram *all;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(level->num_cells, marked));
  PetscCall(PetscMalloc1(1, &all));
  for (PetscInt c = 0; c < level->num_cells; c++) largest = PetscMax(largest, cell[c]);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPIU_REAL, MPIU_MAX, level->comm));
  PetscCall(MarkingCount_Private(level, cell, largest, all));
  PetscCall(MarkingGetClosure_Private(level, &closure));
  squared = all->squared;
  before  = all->cells;
  enough  = before * (1 + GROWTH_OF_SHARE * share / closure);

  rounds.last[rounds.num++] = MarkingHalve_Private(all, share, PETSC_INFINITY);
  if (least) enough = LEAST_GROWTH * before;
  if (squared > MEDIUM_ERROR * norm && all->cells >= LEAST_GROWTH * before) enough = 0;
  if (squared > LARGE_ERROR * norm) enough = 0;
  MarkingAddRounds_Private(all, share, enough, MAX_HALVINGS, &rounds);
  rounds.graded = (PetscBool)(!least && closure > CLOSURE * (1 - EQUAL_PARTS) && rounds.num == MAX_HALVINGS);
  if (rounds.graded) MarkingAddRounds_Private(all, share, enough, MAX_GRADED, &rounds);
  PetscCall(MarkingSet_Private(level, cell, largest, all, &rounds, *marked, &num));
  if (rounds.graded) all->cells = before + num * ((1 << level->dim) - 1);
  if (growth) *growth = 1 + closure * (all->cells / before - 1);
  PetscCall(PetscFree(all));
  PetscFunctionReturn(PETSC_SUCCESS);
}

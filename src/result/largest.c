/* largest.c -- the largest of many values with its place, and quantiles by a histogram. */
#include "result/largest.h"
#include "base/compat.h"

/* Values that differ by less than this part are equal. */
static const PetscReal SAME_VALUE = 1e-9;

enum {
  BINS_OF_OCTAVE = 16, /* a bin is 4.4 per cent wide */
  OCTAVES_BELOW  = 32, /* of the reference: what is smaller is rounding */
  OCTAVES_ABOVE  = 16,
  NUM_BINS       = BINS_OF_OCTAVE * (OCTAVES_BELOW + OCTAVES_ABOVE),
  LARGEST_REALS  = sizeof(Largest) / sizeof(PetscReal)
};

struct _n_LargestBut {
  PetscInt   num_owners;
  PetscReal  reference;
  PetscReal *weight;  /* [num_owners][NUM_BINS], the smallest values first */
  Largest   *largest; /* of each bin [num_owners][NUM_BINS] */
};

void LargestTake(Largest *largest, PetscReal value, PetscInt dim, const PetscReal at[], PetscReal owner)
{
  const PetscBool any    = (PetscBool)(largest->value > -PETSC_MAX_REAL); // else a margin would overflow
  const PetscReal margin = any ? SAME_VALUE * PetscAbsReal(largest->value) : 0;
  PetscBool       first  = (PetscBool)(value > largest->value + margin);

  if (!(value > largest->value - margin)) return;
  for (PetscInt k = 0, equal = 1; k < dim && equal && !first; k++) {
    first = (PetscBool)(at[k] < largest->at[k]);
    equal = at[k] == largest->at[k];
  }
  largest->value = PetscMax(largest->value, value);
  if (!first) return;
  largest->owner = owner;
  for (PetscInt k = 0; k < dim; k++) largest->at[k] = at[k];
}

PetscErrorCode LargestReduce(MPI_Comm comm, PetscInt dim, PetscInt num, Largest largest[])
{
  const PetscMPIInt reals = (PetscMPIInt)(num * LARGEST_REALS);
  Largest          *all;
  PetscMPIInt       size;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(PetscMalloc1(size * num, &all));
  PetscCallMPI(MPI_Allgather(largest, reals, MPIU_REAL, all, reals, MPIU_REAL, comm));
  for (PetscInt i = 0; i < num; i++) {
    largest[i] = all[i];
    for (PetscMPIInt r = 1; r < size; r++) {
      const Largest *other = &all[r * num + i];

      LargestTake(&largest[i], other->value, dim, other->at, other->owner);
    }
  }
  PetscCall(PetscFree(all));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LargestButCreate(PetscInt num_owners, PetscReal reference, LargestBut *but)
{
  PetscFunctionBeginUser;
  PetscCall(PetscNew(but));
  (*but)->num_owners = num_owners;
  (*but)->reference  = reference;
  PetscCall(PetscCalloc1(num_owners * NUM_BINS, &(*but)->weight));
  PetscCall(PetscMalloc1(num_owners * NUM_BINS, &(*but)->largest));
  for (PetscInt i = 0; i < num_owners * NUM_BINS; i++) (*but)->largest[i] = (Largest){.value = -1};
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LargestButDestroy(LargestBut *but)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree((*but)->weight));
  PetscCall(PetscFree((*but)->largest));
  PetscCall(PetscFree(*but));
  PetscFunctionReturn(PETSC_SUCCESS);
}

void LargestButAdd(LargestBut but, PetscReal value, PetscReal weight, PetscInt dim, const PetscReal at[],
                   PetscInt owner)
{
  const PetscReal octaves = value > 0 ? PetscLog2Real(value / but->reference) : -OCTAVES_BELOW;
  const PetscReal inside  = PetscMin(PetscMax(octaves + OCTAVES_BELOW, 0), OCTAVES_BELOW + OCTAVES_ABOVE);
  const PetscInt  bin     = PetscMin((PetscInt)(BINS_OF_OCTAVE * inside), NUM_BINS - 1) + owner * NUM_BINS;

  but->weight[bin] += weight;
  LargestTake(&but->largest[bin], value, dim, at, owner);
}

PetscErrorCode LargestButGet(LargestBut but, MPI_Comm comm, PetscInt dim, PetscReal share, Largest *largest)
{
  Largest *chosen;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(but->num_owners, &chosen));
  PetscCallMPI(
      MPI_Allreduce(MPI_IN_PLACE, but->weight, (PetscMPIInt)(but->num_owners * NUM_BINS), MPIU_REAL, MPI_SUM, comm));
  for (PetscInt o = 0; o < but->num_owners; o++) {
    const PetscReal *weight = &but->weight[o * NUM_BINS];
    PetscReal        sum = 0, above = 0;
    PetscInt         bin = NUM_BINS - 1;

    for (PetscInt b = 0; b < NUM_BINS; b++) sum += weight[b];
    while (bin > 0 && (above += weight[bin]) <= share * sum) bin--;
    chosen[o] = but->largest[o * NUM_BINS + bin];
  }
  PetscCall(LargestReduce(comm, dim, but->num_owners, chosen));
  *largest = (Largest){.value = -1};
  for (PetscInt o = 0; o < but->num_owners; o++)
    LargestTake(largest, chosen[o].value, dim, chosen[o].at, chosen[o].owner);
  PetscCall(PetscFree(chosen));
  PetscFunctionReturn(PETSC_SUCCESS);
}

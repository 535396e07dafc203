/* largest.h -- the largest of many values with its place, and quantiles. */
#ifndef MORTISE_LARGEST_H
#define MORTISE_LARGEST_H

#include <petscsys.h>

/* A value, its place, and the number of the body or pair that it belongs to. Before the first one the value
   is that below which none counts, such as -PETSC_MAX_REAL. */
typedef struct {
  PetscReal value, at[3], owner;
} Largest;

/* Takes a value that is larger, or equal but for rounding. Of equal ones the place is the first by
   coordinates: it does not depend on the number of ranks. NAN is omitted. Not collective. */
void LargestTake(Largest *largest, PetscReal value, PetscInt dim, const PetscReal at[], PetscReal owner);
/* The largest of all ranks. Collective. [in] num - of values; [in,out] largest - [num] */
PetscErrorCode LargestReduce(MPI_Comm comm, PetscInt dim, PetscInt num, Largest largest[]);

/* Values with weights, sorted by their logarithms: as many bins as 16 an octave, from 2^-32 to 2^16 times a
   reference. */
typedef struct _n_LargestBut *LargestBut;

/* Without any value. Not collective.
   [in] num_owners - of which each has a share of its own;
   [in] reference - the usual size of values, above 0 */
PetscErrorCode LargestButCreate(PetscInt num_owners, PetscReal reference, LargestBut *but);
PetscErrorCode LargestButDestroy(LargestBut *but);
/* Adds a value. Not collective. [in] weight - at least 0 */
void LargestButAdd(LargestBut but, PetscReal value, PetscReal weight, PetscInt dim, const PetscReal at[],
                   PetscInt owner);
/* For each owner the value that is exceeded, but for the width of a bin, on this share of its weight; of
   these the largest. Collective.
   [in] share - in [0, 1) */
PetscErrorCode LargestButGet(LargestBut but, MPI_Comm comm, PetscInt dim, PetscReal share, Largest *largest);

#endif

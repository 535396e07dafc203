/* iterationcost.h -- when an iteration that drags gives way to a factorisation; internal (eq. 14.5). */
#ifndef MORTISE_ITERATIONCOST_H
#define MORTISE_ITERATIONCOST_H

#include "problem/vi.h"

/* All costs are in products with the finest matrix, as Hierarchy counts its work: the same on all ranks, and on any machine. */
typedef struct {
  PetscBool on;   /* whether it may give way at all */
  PetscBool over; /* whether it has to */
  PetscBool
            found; /* whether the inequality has been solved once with springs: contacts are found then, and what is left is little */
  PetscInt  sets;      /* systems so far, of all levels */
  PetscBool asked;     /* whether the next two are known */
  PetscReal once, set; /* what a factorisation takes once, and for each set */
} Patience;

/* Foretells a factorisation as soon as the iteration has cost so much that this is worth it, and compares from then on. Collective.
   [in] vi - of the finest level; [in] slow - whether smoothing is more than products; [in] sprung - whether springs hold bodies; [in] work - of the iteration so far */
PetscErrorCode PatienceCheck(Patience *patience, VI vi, PetscBool slow, PetscBool sprung, PetscReal work);
/* What a factorisation takes that has as many sets to solve for as there have been; 0 where nobody asked. Not collective. */
PetscReal PatienceForetold(const Patience *patience);

/* Products with the matrix in the time of so many operations of a factorisation. Collective. */
PetscErrorCode PatienceUnit(VI vi, PetscReal *operations);
/* Operations for each set where one factorisation serves num unknowns with bounds. Not collective. */
PetscReal PatienceSet(PetscInt num);

/* Whether a factorisation is sure to be cheaper than any iteration, because bodies are thin (eq. 14.6). Collective.
   [in] floating - whether contact alone holds some body; [in] num - unknowns with bounds; [in] one - whether one factorisation serves all sets */
PetscErrorCode ThinIsCheap(VI vi, PetscBool floating, PetscInt num, PetscBool one, PetscBool *cheap);

#endif

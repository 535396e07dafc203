/* mortarchoice.h -- the choice of the nonmortar side of each pair. */
#ifndef MORTISE_MORTARCHOICE_H
#define MORTISE_MORTARCHOICE_H

#include "mesh/mesh.h"

/* Pairs of bodies with the side that each prefers to be nonmortar, its end 2 p, and the other one, its end 2
   p + 1. */
typedef struct {
  PetscInt   num;
  PetscBool *fixed; /* given by the user [num] */
  PetscInt  *order; /* pairs, fixed ones first, then the ones with the strongest reasons [num] */
  PetscBool *touch; /* whether two ends have a node in common [2 num][2 num] */
} MortarChoice;

/* Exchanges the sides of pairs that are not fixed, the last ones of the order first, so that only fixed pairs
   form cycles. Not collective.
   [out] turned - [num], all false unless found; [out] found - false where there is no such choice, or a long
   search has found none */
PetscErrorCode MortarChoiceOrient(const MortarChoice *graph, PetscBool turned[], PetscBool *found);
/* Whether pairs form a cycle. Not collective. [in] turned - [num] */
PetscErrorCode MortarChoiceHasCycle(const MortarChoice *graph, const PetscBool turned[], PetscBool *cycle);
/* Chooses the nonmortar side of pairs that leave it open; logs unfavourable given ones. User errors: a pair
   whose sides share facets; two pairs of the same facets. Collective. */
PetscErrorCode MortarChoiceMake(Mesh mesh);

#endif

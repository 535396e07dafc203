/* couplings.h -- entries of the pairs' rows beside the node's own displacement.

   Where only vertices of a quadratic side carry multipliers, and on tri6, the change of basis starts from the displacements u~
   of u = S u~ (eqs. 3.6, 3.5). Rows are needed in both: in u for the uncondensed KKT system, in u~ for the change of basis. */
#ifndef MORTISE_COUPLINGS_H
#define MORTISE_COUPLINGS_H

#include "problem/vi.h"

/* Row a of pair p says D_aa u_a + (record[p] u)_a - (arm of the pair u)_a, which is D_aa u~_a + (basis[p] u~)_a - (arm[p] u~)_a. Record and
   basis are node x node matrices, arms unknown x unknown; the rows of multiplier nodes count. */
typedef struct {
  PetscInt num;
  Mat     *record;         /* (D + chain) S^-1 - D - M, NULL where there is nothing of it [num] */
  Mat     *basis;          /* (D + record) S - D; the very same where S = I [num] */
  Mat     *arm;            /* that of the pair, times S; NULL where it has none [num] */
  Mat      shift, unshift; /* S - I, S^-1 - I on unknowns (block size dim), NULL where S = I */
} Couplings;

/* Faults if a node carries a multiplier of one pair and is shifted in another in another way. Collective. */
PetscErrorCode CouplingsCreate(VI vi, Couplings *couplings);
PetscErrorCode CouplingsDestroy(Couplings *couplings);

#endif

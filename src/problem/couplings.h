/* couplings.h -- entries of the pairs' rows at other nodes than the row's own.

   With the quadratic basis transformation u = S u~ (eqs. 3.6, 3.5) the change of basis starts from u~. Rows
   are needed in u for the uncondensed KKT system, and in u~ for the change of basis. */
#ifndef MORTISE_COUPLINGS_H
#define MORTISE_COUPLINGS_H

#include "problem/vi.h"

/* Row a of pair p is D_aa u_a + (record[p] u)_a - (arm of the pair u)_a = D_aa u~_a + (basis[p] u~)_a -
   (arm[p] u~)_a. Record and basis are node x node, arms unknown x unknown; only rows of nodes with
   multipliers are used. */
typedef struct {
  PetscInt num;
  Mat     *record;         /* (D + D_other) S^-1 - D - M, NULL where it is zero [num] */
  Mat     *basis;          /* (D + record) S - D; the same Mat where S = I [num] */
  Mat     *arm;            /* that of the pair, times S; NULL where it has none [num] */
  Mat      shift, unshift; /* S - I, S^-1 - I on unknowns (block size dim), NULL where S = I */
} Couplings;

/* User error: a node has a multiplier of one pair and a different transformation by another. Collective.
   [out] couplings - owned by the caller, CouplingsDestroy() */
PetscErrorCode CouplingsCreate(VI vi, Couplings *couplings);
/* Collective. */
PetscErrorCode CouplingsDestroy(Couplings *couplings);

#endif

/* couplings.h -- what the rows of the pairs hold beside the nodes' own displacements (private to the room).

   Where only vertices of a quadratic side carry multipliers, the change of basis starts from the displacements u~ of
   u = S u~, S = I + shift (T20). Rows are needed in both: in u for the book of record, in u~ for the change of basis. */
#ifndef MORTISE_COUPLINGS_H
#define MORTISE_COUPLINGS_H

#include <mortise/vi.h>

/* Row a of pair p says D_aa u_a + (record[p] u)_a, which is D_aa u~_a + (basis[p] u~)_a. All are node x node matrices of
   which the rows of multiplier nodes count. */
typedef struct {
  PetscInt num;
  Mat     *record; /* chain (I - shift) - M, NULL where there is nothing of it [num] */
  Mat     *basis;  /* (D + record) S - D; the very same where S = I [num] */
  Mat      shift;  /* S - I on unknowns (block size dim), NULL where S = I; its square is 0 */
} Couplings;

/* Faults if a node carries a multiplier of one pair and is shifted in another. Collective. */
PetscErrorCode CouplingsCreate(VI vi, Couplings *couplings);
PetscErrorCode CouplingsDestroy(Couplings *couplings);

#endif

/* coarsecontact.h -- contact that is too few facets wide for its largest pressure to be right. */
#ifndef MORTISE_COARSECONTACT_H
#define MORTISE_COARSECONTACT_H

#include "result/fields.h"

/* The contact patch with the largest pressure of a pair; the same on all ranks. */
typedef struct {
  PetscBool shows;  /* it is a few facets wide, and ends inside the side or where the partner continues */
  PetscBool edge;   /* it reaches an edge of a body as well: the pressure there is unbounded */
  PetscReal facets; /* its width in facets of the nonmortar side; at a plane of symmetry, of both halves */
  PetscReal size;   /* length of facets that would resolve it, as far as its width is known */
  PetscReal doubt;  /* how much too early or too late one node of order 1 may touch; 0 beside large displacements */
  PetscReal at[3];  /* its centre; of a bent strip the place of the largest pressure */
} CoarseContact;

/* Judges the patch of pair p. Contact that ends where both sides end is not coarse, nor is a tie.
   Collective. */
PetscErrorCode CoarseContactFind(Fields fields, PetscInt p, CoarseContact *found);

#endif

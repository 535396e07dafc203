/* coarsecontact.h -- contact that is too few facets wide for its largest pressure to be right. */
#ifndef MORTISE_COARSECONTACT_H
#define MORTISE_COARSECONTACT_H

#include "result/fields.h"

/* Of the patch of contact that has the largest pressure of a pair; the same on all ranks. */
typedef struct {
  PetscBool shows;  /* it is a few facets wide, and ends inside the side or where the partner goes on */
  PetscBool edge;   /* it reaches an edge of a body as well: the pressure there has no limit */
  PetscReal facets; /* its width in facets of the nonmortar side, with what symmetry adds */
  PetscReal size;   /* of facets that would resolve it, as far as its width is known */
  PetscReal at[3];  /* its centre */
} CoarseContact;

/* Contact that ends with both sides is as exact as the mesh and does not show, nor does a tie. Collective. */
PetscErrorCode CoarseContactFind(Fields fields, PetscInt p, CoarseContact *found);

#endif

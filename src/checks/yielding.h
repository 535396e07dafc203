/* yielding.h -- the displacement by which bodies yield to the neglected part of Green's strain. */
#ifndef MORTISE_YIELDING_H
#define MORTISE_YIELDING_H

#include "result/fields.h"

/* v with a(v, w) = -int 1/2 H'H : C eps(w), H = grad u, for all w that keep the active constraints. Of
   1/2 H'H only the part 1/2 H'H + eps(v) strains the bodies (eq. 11.5a). Collective.
   [in] fields - of a solution;
   [out] v - ghosted, dim per node, owned by the caller; NULL where a failure leaves it unknown */
PetscErrorCode YieldingCreate(Fields fields, Vec *v);

#endif

/* frictionfloors.h -- least errors of the numbers of a pair with friction, from one solution (eq. 15.5). */
#ifndef MORTISE_FRICTIONFLOORS_H
#define MORTISE_FRICTIONFLOORS_H

#include "result/fields.h"

typedef struct {
  PetscReal slip; /* where all of the pair sticks: 6 (eta / |u|)^2 of the displacements; where slip is largest at an
                     end of contact: 3/2 of its change on the facet there; else 0 */
  PetscReal work; /* of all that sticks: the work of the tractions along the side on that slip; where slip is
                     largest at an end of contact: half the work at nodes of facets that contact ends on; else 0 */
  PetscReal held; /* force that nodes have not, which a support holds along the side, at the traction beside them */
} FrictionFloors;

/* All 0 without friction. Collective. [in] relative - 6 (eta / |u|)^2 */
PetscErrorCode FrictionFloorsCompute(Fields fields, PetscInt p, PetscReal relative, FrictionFloors *floors);

#endif

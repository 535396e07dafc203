/* quadraticbasis.h -- the quadratic basis transformation, in which the rows of a pair are written (eqs. 3.6, 3.5). */
#ifndef MORTISE_QUADRATICBASIS_H
#define MORTISE_QUADRATICBASIS_H

#include "mesh/mesh.h"

/* u = u~ + to_nodal u~ and u~ = u + from_nodal u on the nonmortar side, node x node. Where only vertices carry multipliers, the unknown
   of every other node is what goes beyond the linear shape functions there; where tri6 carry them, that of a middle node
   is the one of DualShape(). Both NULL where u~ = u. Collective. [in] carrier - of each facet [facets->num] */
PetscErrorCode QuadraticBasisCreate(Level *level, const Facets *facets, const ElementType carrier[], Mat *to_nodal,
                                    Mat *from_nodal);

#endif

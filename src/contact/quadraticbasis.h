/* quadraticbasis.h -- the quadratic basis transformation, in which the rows of a pair are written (eqs. 3.6,
   3.5). */
#ifndef MORTISE_QUADRATICBASIS_H
#define MORTISE_QUADRATICBASIS_H

#include "level/level.h"

/* u = u~ + to_nodal u~ and u~ = u + from_nodal u on the nonmortar side, node x node. With multipliers at
   vertices alone, the unknown of another node is its displacement less the linear interpolation. With
   multipliers on tri6, that of a middle node is the one of DualShape(). Collective.
   [in] carrier - of each facet [facets->num]; [out] to_nodal, from_nodal - owned by the caller, NULL where u~
   = u */
PetscErrorCode QuadraticBasisCreate(Level *level, const Facets *facets, const ElementType carrier[], Mat *to_nodal,
                                    Mat *from_nodal);

#endif

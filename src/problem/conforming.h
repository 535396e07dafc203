/* conforming.h -- the stiffness where nodes hang. */
#ifndef MORTISE_CONFORMING_H
#define MORTISE_CONFORMING_H

#include "mesh/mesh.h"

/* K of continuous displacements, from K of the cells: S'K S, and ConformingHold(). The energy of u is that of
   S u and of springs between hanging nodes and their edges. A solution has no forces on hanging nodes. Hence
   it is continuous and has the energy of the cells. Without hanging nodes nothing happens. Collective.
   [in,out] K - a stiffness (stiffness.h) */
PetscErrorCode ConformingCreate(Level *level, Mat *K);
/* Adds springs between hanging nodes, whose rows and columns are empty, and their edges. Collective.
   [in,out] K - AIJ, block size dim */
PetscErrorCode ConformingHold(Level *level, Mat K);

#endif

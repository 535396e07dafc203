/* cellforce.h -- a force per volume on the nodes of one cell (private to the room). */
#ifndef MORTISE_CELLFORCE_H
#define MORTISE_CELLFORCE_H

#include <mortise/mesh.h>

/* fe_i = int phi_i b over cell c, by a rule of this degree; by parts of the cell where b has a kink or a jump in it.
   Not collective. [out] fe - [num_nodes][dim] */
PetscErrorCode CellForceIntegrate(Scene scene, const Level *level, PetscInt c, PetscInt degree, PetscReal fe[]);

#endif

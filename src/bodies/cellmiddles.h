/* cellmiddles.h -- nodes in the middle of facets and cells, which a file of second order may lack. */
#ifndef MORTISE_CELLMIDDLES_H
#define MORTISE_CELLMIDDLES_H

#include "bodies/bodylist.h"

/* Sets the nodes from num on, in the middle of facets and of the cell, which are not in the file. */
void CellSetMiddles(PetscInt cell, PetscInt num, BodyList *list);
/* The same positions of nodes that are there. */
void CellPlaceMiddles(PetscInt cell, PetscInt num, BodyList *list);

#endif

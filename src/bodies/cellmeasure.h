/* cellmeasure.h -- area or volume of a cell. */
#ifndef MORTISE_CELLMEASURE_H
#define MORTISE_CELLMEASURE_H

#include "bodies/bodylist.h"

/* Area or volume of a cell at X, negative where it is inside out. The same for a cell of a list, with nodes
   up to an order. [in] X - [nodes][dim] */
PetscReal CellGetMeasure(ElementType type, PetscInt dim, const PetscReal X[]);
PetscReal BodyListGetMeasure(const BodyList *list, PetscInt cell, PetscInt order);

#endif

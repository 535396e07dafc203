/* extrapolation.h -- the quantities of a study extrapolated to h = 0. */
#ifndef MORTISE_EXTRAPOLATION_H
#define MORTISE_EXTRAPOLATION_H

#include "study/richardson.h"
#include "study/studyimpl.h"

/* Extrapolates a quantity from the finest three successive levels of one order. Returns whether these are
   solved and the quantity is known on them. Not collective. */
PetscBool ExtrapolationOfQuantity(Study study, PetscInt quantity, PetscInt order, Extrapolation *limit);
/* The order whose error bar is smallest, -1 where no order has three levels. Not collective. */
PetscInt ExtrapolationFindBest(Study study, PetscInt quantity);
/* Whether an extrapolated quantity is zero up to rounding, relative to the others of its vector.
   Not collective. */
PetscBool ExtrapolationVanishes(Study study, PetscInt quantity, const Extrapolation *limit);
/* Warns of quantities that are not monotone. Not collective. */
PetscErrorCode ExtrapolationWarn(Study study);
/* Prints all quantities that do not vanish. Collective. */
PetscErrorCode ExtrapolationPrint(Study study);

#endif

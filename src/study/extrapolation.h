/* extrapolation.h -- the quantities of a study extrapolated to h = 0. */
#ifndef MORTISE_EXTRAPOLATION_H
#define MORTISE_EXTRAPOLATION_H

#include "study/richardson.h"
#include "study/studyimpl.h"

/* Extrapolates a quantity from the finest three levels of one order that follow each other and are solved. Returns whether
   there are such, and the quantity is known on them. Not collective. */
PetscBool ExtrapolationOfQuantity(Study study, PetscInt quantity, PetscInt order, Extrapolation *limit);
/* The order whose error bar is smallest, -1 where no order has three levels. Not collective. */
PetscInt ExtrapolationFindBest(Study study, PetscInt quantity);
/* Whether an extrapolated quantity is zero to all that can be told, beside the others of its vector: a component that the
   scene does not have. Not collective. */
PetscBool ExtrapolationVanishes(Study study, PetscInt quantity, const Extrapolation *limit);
/* Warns of those that do not approach a limit from one side. Not collective. */
PetscErrorCode ExtrapolationWarn(Study study);
/* Prints all that do not vanish. Collective. */
PetscErrorCode ExtrapolationPrint(Study study);

#endif

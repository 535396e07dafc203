/* switching.h -- where formulas may jump or bend: zeros of parts of them; internal to expression.h. */
#ifndef MORTISE_SWITCHING_H
#define MORTISE_SWITCHING_H

#include <petscsys.h>

/* At most 16 functions, separated by commas. Where a formula changes its branch one of them is zero. They are
   a - b for a < b and max(a, b), a for abs(a), sign(a) and atan2(a, b), cos(pi a) for rint(a). Not
   collective.
   [in] text - of one component or several, accepted by muParser; [out] list - owned by the caller, NULL where
   there is none, or more than 16 */
PetscErrorCode SwitchingFunctions(const char text[], char **list);

#endif

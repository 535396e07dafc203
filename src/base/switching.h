/* switching.h -- where formulas may jump or bend: zeros of parts of them; internal to expression.h. */
#ifndef MORTISE_SWITCHING_H
#define MORTISE_SWITCHING_H

#include <petscsys.h>

/* Functions with commas between them, one of which is zero wherever a formula changes from one branch to another: a - b for a < b and
   max(a, b), a for abs(a), sign(a) and atan2(a, b), cos(pi a) for rint(a). No more than 16. Not
   collective.
   [in] text - of one component or several, which muParser has read; [out] list - owned by the caller, NULL where there is none, or more */
PetscErrorCode SwitchingFunctions(const char text[], char **list);

#endif

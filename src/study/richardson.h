/* richardson.h -- the limit of a sequence of values on meshes, each halved once more (floor 8, private to this room). */
#ifndef MORTISE_STUDY_RICHARDSON_H
#define MORTISE_STUDY_RICHARDSON_H

#include <petscsys.h>

enum { RICHARDSON_LEVELS = 3 };

typedef struct {
  PetscReal value, bar;
  PetscReal rate;     /* observed order of convergence, NAN where differences do not shrink or change sign */
  PetscBool monotone; /* else bar is the spread of the values */
} Extrapolation;

/* [in] Q - on three levels, coarse first */
Extrapolation RichardsonExtrapolate(const PetscReal Q[RICHARDSON_LEVELS]);
/* "1.83697e6 +- 2e2": bar rounded up to one or two digits, value to the last of them. [out] text - [len] */
void RichardsonText(const Extrapolation *limit, char text[], size_t len);

#endif

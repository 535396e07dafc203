/* richardson.h -- the limit of a sequence of values on meshes or of load steps, each halved once more. */
#ifndef MORTISE_RICHARDSON_H
#define MORTISE_RICHARDSON_H

#include <petscsys.h>

enum { RICHARDSON_LEVELS = 3, RICHARDSON_TEXT = 96 };

typedef struct {
  PetscReal value, bar;
  PetscReal rate;     /* observed order of convergence, NAN where differences do not shrink or change sign */
  PetscBool monotone; /* else bar is the spread of the values */
} Extrapolation;

/* [in] Q - on three levels, coarse first */
Extrapolation RichardsonExtrapolate(const PetscReal Q[RICHARDSON_LEVELS]);
/* The same of load steps that are halved, whose errors are of first order. */
Extrapolation RichardsonExtrapolateSteps(const PetscReal Q[RICHARDSON_LEVELS]);
/* "1.83697e6 +- 2.0e2": the value rounded to the last digit of a bar of one digit or two, which is rounded up so that the interval
   that is written holds the one that was computed. [out] text - [len], RICHARDSON_TEXT is enough */
void RichardsonText(const Extrapolation *limit, char text[], size_t len);

#endif

/* richardson.h -- the limit of values on meshes, or of load steps, that are halved again and again. */
#ifndef MORTISE_RICHARDSON_H
#define MORTISE_RICHARDSON_H

#include <petscsys.h>

enum { RICHARDSON_LEVELS = 3, RICHARDSON_TEXT = 96 };

typedef struct {
  PetscReal value, bar;
  PetscReal rate;     /* observed order of convergence, NAN where differences do not shrink or change sign */
  PetscBool monotone; /* else bar is the spread of the values */
} Extrapolation;

/* Extrapolates to h = 0. Not collective. [in] Q - on three levels, coarse first */
Extrapolation RichardsonExtrapolate(const PetscReal Q[RICHARDSON_LEVELS]);
/* The same for load steps, whose errors are of first order. Not collective. */
Extrapolation RichardsonExtrapolateSteps(const PetscReal Q[RICHARDSON_LEVELS]);
/* "1.83697e6 +- 2.0e2": the bar has one or two digits, and the value no more decimals than the bar. The bar
   is rounded up, so that the printed interval contains the computed one. Not collective.
   [out] text - [len], RICHARDSON_TEXT is enough */
void RichardsonText(const Extrapolation *limit, char text[], size_t len);

#endif

/* oscillation.h -- the unresolved part of data that vary in space. */
#ifndef MORTISE_OSCILLATION_H
#define MORTISE_OSCILLATION_H

#include "result/compliance.h"
#include "result/fields.h"

/* Of data given as formulas, with the L2 projection P to polynomials of the stresses' degree,
       (h/pi)^2/E' int_T |b - P b|^2 + (2/pi) h/E' int_e |t - P t|^2 + pi E'/h int_e |u_D - u|^2,
   for body forces b, tractions t, prescribed displacements u_D. Collective.
   [in,out] cell - eta^2 of this rank's cells [num_cells]; supports - gains -2 int_e s* n.(u_D - u), which u
   misses of the supports' work */
PetscErrorCode OscillationAdd(Fields fields, Compliance *compliance, PetscReal cell[], PetscReal *supports);

#endif

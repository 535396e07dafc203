/* figure.h -- a study as a chart: error against time, error against unknowns (floor 8, private to this room). */
#ifndef MORTISE_STUDY_FIGURE_H
#define MORTISE_STUDY_FIGURE_H

#include "room.h"

/* Whether there is anything to show: a run with an error. Not collective. */
PetscBool FigureExists(Study study);
/* Writes it as SVG. Not collective. */
void FigureWrite(Study study, FILE *out);

#endif

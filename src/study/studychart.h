/* studychart.h -- a study as a chart: error against time, error against unknowns. */
#ifndef MORTISE_STUDYCHART_H
#define MORTISE_STUDYCHART_H

#include "study/studyimpl.h"

/* Whether there is anything to show: a run with an error. Not collective. */
PetscBool FigureExists(Study study);
/* Writes it as SVG. Not collective. */
void FigureWrite(Study study, FILE *out);

#endif

/* svgchart.h -- a small chart writer: panels of lines with markers on logarithmic axes, as SVG.

   There is no library for this that would be lighter than what is here: a few rectangles, lines and words. */
#ifndef MORTISE_SVGCHART_H
#define MORTISE_SVGCHART_H

#include <petscsys.h>
#include <stdio.h>

enum { PLOT_MAX_LINES = 4, PLOT_MAX_PANELS = 2 };

/* A line of points with positive coordinates; the slope of its last two is written at its end. */
typedef struct {
  const char      *name; /* in the legend */
  PetscInt         num;
  const PetscReal *x, *y; /* [num] */
} PlotLine;

typedef struct {
  const char *title, *x_label;
  PetscInt    num_lines;
  PlotLine    lines[PLOT_MAX_LINES];
} PlotPanel;

/* Panels side by side that share their y axis. */
typedef struct {
  const char *title, *note, *y_label; /* note: a line below the title, or "" */
  PetscInt    num_panels;
  PlotPanel   panels[PLOT_MAX_PANELS];
} Plot;

/* Writes the chart as a complete SVG document. Not collective. */
void PlotWriteSVG(const Plot *plot, FILE *out);

#endif

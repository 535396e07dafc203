/* studychart.c -- which points the chart of a study has. */
#include "study/studychart.h"
#include "base/compat.h"
#include "study/svgchart.h"

enum { MAX_POINTS = 64 }; /* on a line: more levels than any machine holds */

/* A record's place in a panel: its cost, and its error in the energy norm, or in whatever is known first. */
static PetscBool Point_Private(const Record *record, PetscInt panel, PetscReal *x, PetscReal *y)
{
  const RecordError *error = &record->errors[0];

  *x = panel ? (PetscReal)record->unknowns : record->with_coarser;
  *y = error->relative > 0 ? error->relative : error->absolute;
  return (PetscBool)(record->state == RECORD_SOLVED && *x > 0 && *y > 0 && *y < PETSC_INFINITY);
}

PetscBool FigureExists(Study study)
{
  PetscReal x, y;

  for (PetscInt r = 0; study->num_errors && r < study->num; ++r) {
    if (Point_Private(&study->records[r], 0, &x, &y)) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* The runs of one order. [out] x, y - [MAX_POINTS] */
static PetscInt Line_Private(Study study, PetscInt order, PetscInt panel, PetscReal x[], PetscReal y[])
{
  PetscInt num = 0;

  for (PetscInt r = 0; r < study->num && num < MAX_POINTS; ++r) {
    if (study->records[r].order == order && Point_Private(&study->records[r], panel, &x[num], &y[num])) ++num;
  }
  return num;
}

void FigureWrite(Study study, FILE *out)
{
  static const char *const titles[] = {"error against time", "error against unknowns"};
  static const char *const labels[] = {"seconds, coarser levels included", "unknowns"};
  PetscReal                x[PLOT_MAX_PANELS][STUDY_MAX_ORDERS][MAX_POINTS];
  PetscReal                y[PLOT_MAX_PANELS][STUDY_MAX_ORDERS][MAX_POINTS];
  char                     names[STUDY_MAX_ORDERS][ERROR_TEXT], reference[ERROR_TEXT], note[2 * ERROR_TEXT];
  Plot                     plot = {.title = study->scene->title, .num_panels = PLOT_MAX_PANELS};

  CompareReferenceText(study, reference);
  if (study->exact)
    snprintf(note, sizeof(note), "errors against the exact solution");
  else
    snprintf(note, sizeof(note), "differences from %s, which stands for the exact solution", reference);
  if (!plot.title[0]) plot.title = "Error and cost";
  plot.note    = note;
  plot.y_label = study->exact ? "relative error, energy norm" : "relative difference, energy norm";
  for (PetscInt p = 0; p < PLOT_MAX_PANELS; ++p) {
    PlotPanel *panel = &plot.panels[p];

    panel->title   = titles[p];
    panel->x_label = labels[p];
    for (PetscInt o = 0; o < study->num_orders; ++o) {
      const Record sample = {.order = study->scene->study.orders[o]};

      RecordOrderText(&sample, names[o]);
      panel->lines[o]     = (PlotLine){.name = names[o], .x = x[p][o], .y = y[p][o]};
      panel->lines[o].num = Line_Private(study, sample.order, p, x[p][o], y[p][o]);
    }
    panel->num_lines = study->num_orders;
  }
  PlotWriteSVG(&plot, out);
}

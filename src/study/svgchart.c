/* svgchart.c -- a chart as SVG text. */
#include <math.h>
#include <string.h>
#include "study/svgchart.h"

#define MINUS "\xe2\x88\x92" /* the sign as long as a plus, in UTF-8 */

/* The sheet, in pixels of a screen with 96 to the inch. */
enum { WIDTH = 1040, HEIGHT = 520, LEFT = 84, RIGHT = 28, TOP = 96, BOTTOM = 64, BETWEEN = 56, TICK = 6, MINOR = 3 };

static const PetscReal MARKER      = 4.2;  /* radius */
static const PetscReal MARGIN      = 0.06; /* of an axis that is left free at both ends */
static const PetscReal MIN_DECADES = 1;    /* an axis shows at least so much */

/* Colours that are told apart in print and by the colour-blind (Okabe, Ito, Color universal design, 2008). */
static const char *const colours[PLOT_MAX_LINES] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7"};
static const char        ink[] = "#222222", grid[] = "#e3e6ea", faint[] = "#f2f4f6", frame[] = "#8a9099";

/* An axis from 10^low to 10^high over pixels begin..end. */
typedef struct {
  PetscReal low, high, begin, end;
} Axis;

static PetscReal Place_Private(const Axis *axis, PetscReal value)
{
  return axis->begin + (log10((double)value) - axis->low) / (axis->high - axis->low) * (axis->end - axis->begin);
}

/* Text with what XML keeps for itself replaced. */
static void Words_Private(FILE *out, const char text[])
{
  for (; *text; ++text) {
    switch (*text) {
    case '&': fputs("&amp;", out); break;
    case '<': fputs("&lt;", out); break;
    case '>': fputs("&gt;", out); break;
    case '"': fputs("&quot;", out); break;
    default:
      if ((unsigned char)*text >= ' ') fputc(*text, out);
    }
  }
}

/* [in] style - more attributes */
static void Text_Private(FILE *out, PetscReal x, PetscReal y, const char style[], const char text[])
{
  fprintf(out, "<text x=\"%.1f\" y=\"%.1f\" %s>", (double)x, (double)y, style);
  Words_Private(out, text);
  fputs("</text>\n", out);
}

static void Line_Private(FILE *out, const PetscReal from[2], const PetscReal to[2], const char colour[],
                         PetscReal width)
{
  fprintf(out, "<path d=\"M%.2f %.2fL%.2f %.2f\" stroke=\"%s\" stroke-width=\"%g\" fill=\"none\"/>\n", (double)from[0],
          (double)from[1], (double)to[0], (double)to[1], colour, (double)width);
}

/* A range of powers of ten around values, with margins. [in,out] low, high - of the values */
static void Widen_Private(PetscReal *low, PetscReal *high)
{
  const PetscReal missing = MIN_DECADES - (*high - *low);

  if (missing > 0) {
    *low -= missing / 2;
    *high += missing / 2;
  }
  const PetscReal margin = MARGIN * (*high - *low);
  *low -= margin;
  *high += margin;
}

/* The axis over one coordinate of all lines of some panels. [in] which - 0: x, 1: y */
static Axis Range_Private(const Plot *plot, PetscInt first, PetscInt last, int which)
{
  Axis axis = {.low = INFINITY, .high = -INFINITY};

  for (PetscInt p = first; p <= last; ++p) {
    for (PetscInt l = 0; l < plot->panels[p].num_lines; ++l) {
      const PlotLine  *line   = &plot->panels[p].lines[l];
      const PetscReal *values = which ? line->y : line->x;

      for (PetscInt i = 0; i < line->num; ++i) {
        axis.low  = PetscMin(axis.low, log10((double)values[i]));
        axis.high = PetscMax(axis.high, log10((double)values[i]));
      }
    }
  }
  Widen_Private(&axis.low, &axis.high);
  return axis;
}

/* Which numbers at an axis are written: how it is scaled decides for all of them. */
typedef struct {
  PetscBool plain;   /* 0.1, 20 instead of powers of ten */
  PetscBool between; /* 2 and 5 times powers as well */
} Labels;

static Labels ChooseLabels_Private(const Axis *axis)
{
  const PetscReal PLAIN_LOW = -3.2, PLAIN_HIGH = 4.2; /* powers that people read at a glance */
  const PetscReal FEW = 1.6;                          /* decades with less than two labels, perhaps */

  return (Labels){.plain   = (PetscBool)(axis->low > PLAIN_LOW && axis->high < PLAIN_HIGH),
                  .between = (PetscBool)(axis->high - axis->low < FEW)};
}

/* m times 10^power. [in] anchor - of the text */
static void Label_Private(FILE *out, PetscReal x, PetscReal y, const char anchor[], int m, int power, PetscBool plain)
{
  fprintf(out, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" font-size=\"13\">", (double)x, (double)y, anchor);
  if (plain) {
    fprintf(out, "%g", m * pow(10, power));
  } else {
    if (m > 1) fprintf(out, "%d\xc2\xb7", m); // a raised dot
    fprintf(out, "10<tspan dy=\"-5\" font-size=\"10\">%s%d</tspan>", power < 0 ? MINUS : "",
            power < 0 ? -power : power);
  }
  fputs("</text>\n", out);
}

/* Lines and ticks at decades and between them. [in] vertical - whether it is a y axis; across - pixels it reaches over */
static void DrawAxis_Private(FILE *out, const Axis *axis, PetscBool vertical, const PetscReal across[2])
{
  const Labels labels = ChooseLabels_Private(axis);

  for (int power = (int)floor((double)axis->low); power <= (int)ceil((double)axis->high); ++power) {
    for (int m = 1; m < 10; ++m) {
      const PetscReal exponent = power + log10((double)m);
      PetscReal       at, from[2], to[2], tick[2];

      if (exponent < axis->low || exponent > axis->high) continue;
      at      = Place_Private(axis, PetscPowReal(10, exponent));
      from[0] = vertical ? across[0] : at;
      from[1] = vertical ? at : across[0];
      to[0]   = vertical ? across[1] : at;
      to[1]   = vertical ? at : across[1];
      Line_Private(out, from, to, m == 1 ? grid : faint, 1);
      tick[0] = from[0] + (vertical ? (m == 1 ? TICK : MINOR) : 0);
      tick[1] = from[1] - (vertical ? 0 : (m == 1 ? TICK : MINOR));
      Line_Private(out, from, tick, frame, 1);
      if (m > 1 && !(labels.between && (m == 2 || m == 5))) continue;
      if (vertical)
        Label_Private(out, across[0] - 8, at + 4.5, "end", m, power, labels.plain);
      else
        Label_Private(out, at, across[0] + 19, "middle", m, power, labels.plain);
    }
  }
}

/* Circle, square, triangle, diamond. */
static void DrawMarker_Private(FILE *out, PetscInt kind, PetscReal x, PetscReal y)
{
  const double r = (double)MARKER, cx = (double)x, cy = (double)y;

  switch (kind) {
  case 0: fprintf(out, "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%.2f\"", cx, cy, r); break;
  case 1:
    fprintf(out, "<rect x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\"", cx - r, cy - r, 2 * r, 2 * r);
    break;
  case 2: fprintf(out, "<path d=\"M%.2f %.2fl%.2f %.2fh%.2fz\"", cx, cy - 1.2 * r, 1.15 * r, 2 * r, -2.3 * r); break;
  default:
    fprintf(out, "<path d=\"M%.2f %.2fl%.2f %.2fl%.2f %.2fl%.2f %.2fz\"", cx, cy - 1.3 * r, 1.3 * r, 1.3 * r, -1.3 * r,
            1.3 * r, -1.3 * r, -1.3 * r);
  }
  fprintf(out, " fill=\"%s\" stroke=\"#ffffff\" stroke-width=\"1.2\"/>\n", colours[kind]);
}

/* How steep the last part of a line is, written along it. */
static void DrawSlope_Private(FILE *out, const PlotLine *line, PetscInt kind, const Axis *x, const Axis *y)
{
  const PetscInt  n     = line->num;
  const PetscReal at[2] = {Place_Private(x, line->x[n - 2]), Place_Private(x, line->x[n - 1])};
  const PetscReal up[2] = {Place_Private(y, line->y[n - 2]), Place_Private(y, line->y[n - 1])};
  const PetscReal angle = PetscAtan2Real(up[1] - up[0], at[1] - at[0]) * 180 / PETSC_PI;
  const double slope = log((double)(line->y[n - 1] / line->y[n - 2])) / log((double)(line->x[n - 1] / line->x[n - 2]));

  fprintf(out,
          "<text transform=\"translate(%.2f %.2f) rotate(%.2f)\" y=\"-8\" text-anchor=\"middle\" font-size=\"13\" "
          "font-weight=\"600\" fill=\"%s\">slope %s%.2f</text>\n",
          (double)(at[0] + at[1]) / 2, (double)(up[0] + up[1]) / 2, (double)angle, colours[kind],
          slope < 0 ? MINUS : "", fabs(slope));
}

/* The line with its markers. */
static void DrawLine_Private(FILE *out, const PlotLine *line, PetscInt kind, const Axis *x, const Axis *y)
{
  const PetscInt n = line->num;

  if (!n) return;
  fprintf(out, "<path d=\"");
  for (PetscInt i = 0; i < n; ++i)
    fprintf(out, "%c%.2f %.2f", i ? 'L' : 'M', (double)Place_Private(x, line->x[i]),
            (double)Place_Private(y, line->y[i]));
  fprintf(out, "\" stroke=\"%s\" stroke-width=\"2\" stroke-linejoin=\"round\" fill=\"none\"/>\n", colours[kind]);
  for (PetscInt i = 0; i < n; ++i)
    DrawMarker_Private(out, kind, Place_Private(x, line->x[i]), Place_Private(y, line->y[i]));
  if (n > 1 && line->x[n - 1] > line->x[n - 2]) DrawSlope_Private(out, line, kind, x, y);
}

/* Names of the lines, in the upper right corner, where falling lines leave room. */
static void DrawLegend_Private(FILE *out, const PlotPanel *panel, PetscReal right, PetscReal top)
{
  for (PetscInt l = 0; l < panel->num_lines; ++l) {
    const PetscReal y = top + 22 + 21 * l, from[2] = {right - 46, y}, to[2] = {right - 14, y};

    Line_Private(out, from, to, colours[l], 2);
    DrawMarker_Private(out, l, right - 30, y);
    Text_Private(out, right - 54, y + 4.5, "text-anchor=\"end\" font-size=\"13\"", panel->lines[l].name);
  }
}

static void DrawPanel_Private(FILE *out, const Plot *plot, PetscInt p, PetscReal left, PetscReal right)
{
  const PlotPanel *panel     = &plot->panels[p];
  const PetscReal  across[2] = {left, right}, up[2] = {HEIGHT - BOTTOM, TOP};
  Axis             x = Range_Private(plot, p, p, 0), y = Range_Private(plot, 0, plot->num_panels - 1, 1);

  x.begin = left;
  x.end   = right;
  y.begin = up[0];
  y.end   = up[1];
  DrawAxis_Private(out, &x, PETSC_FALSE, up);
  DrawAxis_Private(out, &y, PETSC_TRUE, across);
  fprintf(out, "<rect x=\"%.1f\" y=\"%d\" width=\"%.1f\" height=\"%d\" fill=\"none\" stroke=\"%s\"/>\n", (double)left,
          TOP, (double)(right - left), HEIGHT - BOTTOM - TOP, frame);
  for (PetscInt l = 0; l < panel->num_lines; ++l) DrawLine_Private(out, &panel->lines[l], l, &x, &y);
  DrawLegend_Private(out, panel, right, TOP);
  Text_Private(out, left, TOP - 12, "font-size=\"14\" font-weight=\"600\"", panel->title);
  Text_Private(out, (left + right) / 2, HEIGHT - 16, "text-anchor=\"middle\" font-size=\"14\"", panel->x_label);
}

void PlotWriteSVG(const Plot *plot, FILE *out)
{
  const PetscReal width = (WIDTH - LEFT - RIGHT - BETWEEN * (plot->num_panels - 1)) / (PetscReal)plot->num_panels;
  char            style[160];

  fprintf(out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
  fprintf(out,
          "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" viewBox=\"0 0 %d %d\" "
          "font-family=\"'DejaVu Sans', 'Liberation Sans', Arial, sans-serif\" fill=\"%s\">\n",
          WIDTH, HEIGHT, WIDTH, HEIGHT, ink);
  fputs("<title>", out);
  Words_Private(out, plot->title);
  fprintf(out, "</title>\n<rect width=\"%d\" height=\"%d\" fill=\"#ffffff\"/>\n", WIDTH, HEIGHT);
  Text_Private(out, LEFT, 32, "font-size=\"18\" font-weight=\"600\"", plot->title);
  Text_Private(out, LEFT, 54, "font-size=\"13\" fill=\"#5c636b\"", plot->note);
  for (PetscInt p = 0; p < plot->num_panels; ++p) {
    const PetscReal left = LEFT + p * (width + BETWEEN);

    DrawPanel_Private(out, plot, p, left, left + width);
  }
  snprintf(style, sizeof(style), "text-anchor=\"middle\" font-size=\"14\" transform=\"rotate(-90 22 %d)\"",
           (TOP + HEIGHT - BOTTOM) / 2);
  Text_Private(out, 22, (TOP + HEIGHT - BOTTOM) / 2, style, plot->y_label);
  fputs("</svg>", out);
}

/* levelsets.c -- zeros of functions along the lines of a box, and functions that are zero where these begin,
   end or meet.

   Along a coordinate in which a function is monotone it has at most one zero on a line. Existence of the zero
   changes where the function is zero at an end of the line. This is a function of the other coordinates, and
   so on until there are none left [1]. The zeros of two functions change their order where one function is
   zero at the zero of the other.

   References: [1] R. I. Saye, High-order quadrature methods for implicitly defined surfaces and volumes in
   hyperrectangles, SIAM J. Sci. Comput. 37 (2015); [2] T. R. Chandrupatla, A new hybrid quadratic/bisection
   algorithm for finding the zero of a nonlinear function without using derivatives, Adv. Eng. Softw. 28
   (1997). */
#include "base/compat.h"
#include "kernel/levelsets.h"
#include "kernel/referencecell.h"

enum {
  SAMPLES        = 4, /* along each coordinate of a box, to judge monotonicity */
  MAX_SAMPLES    = SAMPLES * SAMPLES * SAMPLES,
  LINE_SAMPLES   = 9, /* along the last coordinate */
  MAX_ZERO_STEPS = 80,
  MAX_DIP_STEPS  = 20
};

/* Accuracy of zeros. */
static const PetscReal ZERO_ACCURACY = 1e-15;
/* Values and differences below this part of the largest ones are roundoff. */
static const PetscReal ROUNDING = 1e-12;
/* A function whose differences along a coordinate vary by more has no lines along it. */
static const PetscReal VARIATION = 5.;
/* Part of a line at both ends for difference quotients, and their least size relative to the mean slope. */
static const PetscReal END_STEP = 1e-4, LEAST_SLOPE = 0.05;
/* Second differences of a plane, compared with its first ones. */
static const PetscReal STRAIGHT = 1e-9;
/* Weight of the width of a box relative to the change of gradients along it. */
static const PetscReal WIDTH = 0.25;
/* A parabola through three values that stays above this part of the least of them has no zero there. */
static const PetscReal DIP = 0.25;

void LevelSetCellInit(Cubature *cubature, PetscBool collapsed, LevelSetCell *cell, LevelSetBox *box)
{
  const Reference *reference = &REFERENCE[cubature->type];

  *cell           = (LevelSetCell){.cubature = cubature, .dim = reference->dim};
  cell->simplex   = (PetscBool)(reference->simplex && cell->dim > 1 && !collapsed);
  cell->collapsed = (PetscBool)(reference->simplex && cell->dim > 1 && collapsed);
  *box            = (LevelSetBox){.dim = cell->dim};
  for (PetscInt k = 0; k < cell->dim; k++) {
    box->axis[k]  = k;
    box->upper[k] = 1.;
  }
  for (PetscInt i = 0; i < cubature->num_switches; i++)
    box->function[box->num++] = (LevelSetFunction){.of = i, .other = -1};
  if (cell->simplex) box->function[box->num++] = (LevelSetFunction){.of = -1, .other = -1};
}

/* A function of the cell. */
static PetscErrorCode LevelSetCellEvaluate_Private(const LevelSetCell *cell, PetscInt i, const PetscReal u[],
                                                   PetscReal *value)
{
  PetscReal xi[LEVELSET_MAX_DIM], left = 1.;

  PetscFunctionBeginUser;
  if (i < 0) {
    *value = 1.;
    for (PetscInt k = 0; k < cell->dim; k++) *value -= u[k];
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  for (PetscInt k = 0; k < cell->dim; k++) {
    xi[k] = u[k] * left;
    if (cell->collapsed) left *= 1. - u[k];
  }
  PetscCall(cell->cubature->switches(cell->cubature->ctx, i, xi, value));
  cell->cubature->count++;
  if (PetscIsInfOrNanReal(*value)) *value = -1.; // another function ends there
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode LevelSetFindZero_Private(const LevelSetCell *cell, const LevelSetBox *box, PetscInt i,
                                               PetscInt line, PetscReal u[]);

/* Function i of a box at u. [in] u - with all coordinates that the box does not have */
static PetscErrorCode LevelSetEvaluate_Private(const LevelSetCell *cell, const LevelSetBox *box, PetscInt i,
                                               PetscReal u[], PetscReal *value)
{
  const LevelSetFunction *function = &box->function[i];

  PetscFunctionBeginUser;
  if (!box->around) {
    PetscCall(LevelSetCellEvaluate_Private(cell, function->of, u, value));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  if (function->other < 0)
    u[box->line] = function->at;
  else
    PetscCall(LevelSetFindZero_Private(cell, box->around, function->other, box->line, u));
  PetscCall(LevelSetEvaluate_Private(cell, box->around, function->of, u, value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The zero of function i between two points of a line, at which it has opposite signs.
   [in] ends - coordinate and value at both; [out] u - [line] is set */
static PetscErrorCode LevelSetBracketZero_Private(const LevelSetCell *cell, const LevelSetBox *box, PetscInt i,
                                                  PetscInt line, const PetscReal ends[][2], PetscReal u[])
{
  PetscReal a = ends[0][0], fa = ends[0][1], b = ends[1][0], fb = ends[1][1], c, fc, x, f;
  PetscReal t = fa / (fa - fb);

  PetscFunctionBeginUser;
  for (PetscInt step = 0; step < MAX_ZERO_STEPS; step++) {
    const PetscReal least = a == b ? 1. : ZERO_ACCURACY / PetscAbsReal(b - a);
    PetscReal       xi, phi;

    if (least > 0.5) break;
    t       = PetscMax(least, PetscMin(1. - least, t));
    u[line] = x = a + t * (b - a);
    PetscCall(LevelSetEvaluate_Private(cell, box, i, u, &f));
    if ((f > 0.) == (fa > 0.)) {
      c  = a;
      fc = fa;
    } else {
      c  = b;
      fc = fb;
      b  = a;
      fb = fa;
    }
    a  = x;
    fa = f;
    if (f == 0.) break;
    xi  = (a - b) / (c - b);
    phi = (fa - fb) / (fc - fb);
    t   = 0.5;
    if (phi * phi < xi && (1. - phi) * (1. - phi) < 1. - xi)
      t = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb);
  }
  u[line] = PetscAbsReal(fa) < PetscAbsReal(fb) ? a : b;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The zero of a function that rises or falls along a line; where it has none, the end beyond which it would
   be. A function that is zero along a part of a line ends there. */
static PetscErrorCode LevelSetFindZero_Private(const LevelSetCell *cell, const LevelSetBox *box, PetscInt i,
                                               PetscInt line, PetscReal u[])
{
  const PetscReal zero = ROUNDING * box->function[i].scale;
  PetscReal       ends[2][2];

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < 2; k++) {
    u[line] = ends[k][0] = k ? box->upper[line] : box->lower[line];
    PetscCall(LevelSetEvaluate_Private(cell, box, i, u, &ends[k][1]));
  }
  if (PetscAbsReal(ends[0][1]) > zero && PetscAbsReal(ends[1][1]) > zero && (ends[0][1] > 0.) != (ends[1][1] > 0.))
    PetscCall(LevelSetBracketZero_Private(cell, box, i, line, (const PetscReal(*)[2])ends, u));
  else
    u[line] = PetscAbsReal(ends[0][1]) < PetscAbsReal(ends[1][1]) ? ends[0][0] : ends[1][0];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Monotonicity of one function in a box. */
typedef struct {
  PetscBool zero; /* it may be zero in the box */
  PetscReal score
      [LEVELSET_MAX_DIM]; /* evenness of its slope along each coordinate; 0 where it is not monotone, 1 where it is constant */
  PetscBool stays[LEVELSET_MAX_DIM];
  PetscReal bend[LEVELSET_MAX_DIM]; /* change of its gradient along each */
} FunctionTrend;

/* Values at all samples of a box. [out] v - [SAMPLES^dim] */
static PetscErrorCode LevelSetSample_Private(const LevelSetCell *cell, const LevelSetBox *box, PetscInt i,
                                             PetscReal v[])
{
  PetscReal u[LEVELSET_MAX_DIM];
  PetscInt  total = 1;

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < box->dim; k++) total *= SAMPLES;
  for (PetscInt q = 0; q < total; q++) {
    for (PetscInt k = 0, digits = q; k < box->dim; k++, digits /= SAMPLES) {
      const PetscInt axis = box->axis[k];

      u[axis] = box->lower[axis] + (box->upper[axis] - box->lower[axis]) * (digits % SAMPLES) / (SAMPLES - 1);
    }
    PetscCall(LevelSetEvaluate_Private(cell, box, i, u, &v[q]));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The difference of two samples.
   [in] q - their first; returns whether there is a second one along coordinate k */
static PetscBool SampleDifference_Private(const PetscReal v[], PetscInt q, PetscInt k, PetscReal *difference)
{
  PetscInt stride = 1;

  for (PetscInt l = 0; l < k; l++) stride *= SAMPLES;
  if (q / stride % SAMPLES == SAMPLES - 1) return PETSC_FALSE;
  *difference = v[q + stride] - v[q];
  return PETSC_TRUE;
}

/* The largest difference of samples along each coordinate, the largest difference of these, and the largest
   second differences of all coordinates. [out] reach, bend - [dim] */
static void SampleDifferences_Private(PetscInt dim, const PetscReal v[], PetscReal reach[], PetscReal bend[],
                                      PetscReal *margin)
{
  PetscInt total = 1, stride = 1;

  *margin = 0.;
  for (PetscInt k = 0; k < dim; k++) total *= SAMPLES;
  for (PetscInt k = 0; k < dim; k++, stride *= SAMPLES) {
    PetscReal second = 0.;

    reach[k] = bend[k] = 0.;
    for (PetscInt q = 0; q < total; q++) {
      PetscReal d, e;

      if (!SampleDifference_Private(v, q, k, &d)) continue;
      reach[k] = PetscMax(reach[k], PetscAbsReal(d));
      if (SampleDifference_Private(v, q + stride, k, &e)) second = PetscMax(second, PetscAbsReal(e - d));
      for (PetscInt l = 0; l < dim; l++) { // along l, here and at the next sample along k
        if (SampleDifference_Private(v, q, l, &d) && SampleDifference_Private(v, q + stride, l, &e))
          bend[k] = PetscMax(bend[k], PetscAbsReal(e - d));
      }
    }
    *margin += 0.5 * second;
  }
}

/* Whether values on a line are not all larger than near in size, of one sign. [in] q - its first sample */
static PetscBool LineIsNear_Private(const PetscReal v[], PetscInt q, PetscInt stride, PetscReal near)
{
  PetscReal lowest = v[q], highest = v[q];

  for (PetscInt j = 1; j < SAMPLES; j++) {
    lowest  = PetscMin(lowest, v[q + j * stride]);
    highest = PetscMax(highest, v[q + j * stride]);
  }
  return (PetscBool)(lowest <= near && highest >= -near);
}

/* The range of differences on lines along coordinate k that may have a zero on or beside them.
   [in] near - bound on values of these lines; [in] zero - roundoff; [out] rise - [2] */
static void SampleRises_Private(PetscInt dim, PetscInt k, PetscReal near, PetscReal zero, const PetscReal v[],
                                PetscReal rise[])
{
  PetscInt total = 1, stride = 1;

  for (PetscInt l = 0; l < dim; l++) total *= SAMPLES;
  for (PetscInt l = 0; l < k; l++) stride *= SAMPLES;
  rise[0] = PETSC_MAX_REAL;
  rise[1] = -PETSC_MAX_REAL;
  for (PetscInt q = 0; q < total; q++) {
    if (q / stride % SAMPLES > 0 || !LineIsNear_Private(v, q, stride, near)) continue; // not the first of a line
    for (PetscInt j = 1; j < SAMPLES; j++) {
      const PetscReal a = v[q + (j - 1) * stride], b = v[q + j * stride], d = b - a;

      if (PetscAbsReal(a) <= zero || PetscAbsReal(b) <= zero) continue;
      rise[0] = PetscMin(rise[0], d);
      rise[1] = PetscMax(rise[1], d);
    }
  }
}

static void FunctionTrendSet_Private(PetscInt dim, const LevelSetFunction *function, const PetscReal v[],
                                     FunctionTrend *trend)
{
  const PetscReal scale = function->scale, zero = ROUNDING * scale;
  const PetscReal variation = function->other < 0 ? VARIATION : PETSC_MAX_REAL;
  PetscReal       lowest = PETSC_MAX_REAL, highest = -PETSC_MAX_REAL, margin, steepest = 0., all = 0.;
  PetscReal       reach[LEVELSET_MAX_DIM], rise[2];
  PetscInt        total = 1;

  SampleDifferences_Private(dim, v, reach, trend->bend, &margin);
  for (PetscInt k = 0; k < dim; k++) {
    total *= SAMPLES;
    all += reach[k];
    steepest = PetscMax(steepest, reach[k]);
  }
  for (PetscInt q = 0; q < total; q++) {
    lowest  = PetscMin(lowest, v[q]);
    highest = PetscMax(highest, v[q]);
  }
  trend->zero = (PetscBool)(lowest < margin - zero && highest > zero - margin);
  for (PetscInt k = 0; k < dim; k++) {
    SampleRises_Private(dim, k, margin + 0.5 * (all - reach[k]), zero, v, rise);
    trend->stays[k] = (PetscBool)(reach[k] <= ROUNDING * PetscMax(steepest, scale));
    trend->score[k] = rise[0] <= rise[1] ? 0. : 1.;
    if (rise[0] * rise[1] > 0. && rise[0] <= rise[1]) {
      const PetscReal least = PetscMin(PetscAbsReal(rise[0]), PetscAbsReal(rise[1]));

      if (PetscMax(PetscAbsReal(rise[0]), PetscAbsReal(rise[1])) < variation * least)
        trend->score[k] = least / steepest;
    }
    if (trend->stays[k]) trend->score[k] = 1.;
    if (steepest > 0.) trend->bend[k] /= steepest;
  }
}

/* Whether function i is taken at a zero of another one, here or in the boxes around. With u, also whether
   that zero was beyond its box at the last evaluation. [in] u - the point of that evaluation, or NULL */
static PetscBool LevelSetIsMeeting_Private(const LevelSetBox *box, PetscInt i, const PetscReal u[])
{
  for (; box->around; i = box->function[i].of, box = box->around) {
    const LevelSetBox *around = box->around;

    if (box->function[i].other < 0) continue;
    if (!u || u[box->line] <= around->lower[box->line] || u[box->line] >= around->upper[box->line]) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* Whether a function is monotone in the same sense at both ends of the lines along coordinate k. An extremum
   between the last two samples may hide two zeros. [in] v - its samples */
static PetscErrorCode LevelSetCheckEnds_Private(const LevelSetCell *cell, const LevelSetBox *box, PetscInt i,
                                                PetscInt k, const PetscReal v[], PetscBool *goes)
{
  const PetscInt  axis  = box->axis[k];
  const PetscReal lower = box->lower[axis], length = box->upper[axis] - lower, zero = ROUNDING * box->function[i].scale;
  const PetscReal least = box->function[i].other < 0 ? LEAST_SLOPE : 0.;
  PetscReal       reach[LEVELSET_MAX_DIM], bend[LEVELSET_MAX_DIM], margin, all = 0.;
  PetscInt        total = 1, stride = 1;

  PetscFunctionBeginUser;
  SampleDifferences_Private(box->dim, v, reach, bend, &margin);
  for (PetscInt l = 0; l < box->dim; l++) {
    if (l < k) stride *= SAMPLES;
    if (l != k) all += reach[l];
    total *= SAMPLES;
  }
  *goes = PETSC_TRUE;
  for (PetscInt q = 0; q < total && *goes; q++) {
    const PetscReal rise = v[q + (SAMPLES - 1) * stride] - v[q];
    PetscReal       u[LEVELSET_MAX_DIM];

    if (q / stride % SAMPLES > 0 || !LineIsNear_Private(v, q, stride, margin + 0.5 * all)) continue;
    for (PetscInt l = 0, digits = q; l < box->dim; l++, digits /= SAMPLES) {
      const PetscInt other = box->axis[l];

      u[other] = box->lower[other] + (box->upper[other] - box->lower[other]) * (digits % SAMPLES) / (SAMPLES - 1);
    }
    for (PetscInt end = 0; end < 2 && *goes; end++) {
      const PetscReal at = v[q + (end ? (SAMPLES - 1) * stride : 0)];
      PetscReal       inner, slope;

      u[axis] = end ? lower + (1. - END_STEP) * length : lower + END_STEP * length;
      PetscCall(LevelSetEvaluate_Private(cell, box, i, u, &inner));
      slope = (end ? at - inner : inner - at) / END_STEP;
      if (PetscAbsReal(at - inner) <= zero || (least == 0. && LevelSetIsMeeting_Private(box, i, u))) continue;
      *goes = (PetscBool)(slope * rise > 0. && PetscAbsReal(slope) > least * PetscAbsReal(rise));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The best coordinate for lines, -1 where there is none. [in,out] score - [dim] */
static PetscErrorCode LevelSetChooseLine_Private(const LevelSetCell *cell, const LevelSetBox *box,
                                                 const PetscReal v[][MAX_SAMPLES], PetscBool stays[][LEVELSET_MAX_DIM],
                                                 PetscReal score[], PetscInt *line)
{
  PetscFunctionBeginUser;
  for (;;) {
    PetscInt  best = 0;
    PetscBool goes = PETSC_TRUE;

    for (PetscInt k = 1; k < box->dim; k++)
      if (score[k] > score[best]) best = k;
    *line = score[best] > 0. ? best : -1;
    if (*line < 0) break;
    for (PetscInt i = 0; i < box->num && goes; i++)
      if (!stays[i][best]) PetscCall(LevelSetCheckEnds_Private(cell, box, i, best, v[i], &goes));
    if (goes) break;
    score[best] = 0.;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelSetBoxTrend(const LevelSetCell *cell, LevelSetBox *box, LevelSetTrend *trend)
{
  PetscReal     score[LEVELSET_MAX_DIM] = {1., 1., 1.}, bend[LEVELSET_MAX_DIM] = {0.};
  PetscReal     v[LEVELSET_MAX_FUNCTIONS][MAX_SAMPLES], most = ROUNDING, widest = 0.;
  PetscBool     stays[LEVELSET_MAX_FUNCTIONS][LEVELSET_MAX_DIM];
  PetscInt      num = 0, best, bent = 0, total = 1;
  FunctionTrend function;

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < box->dim; k++) total *= SAMPLES;
  for (PetscInt i = 0; i < box->num; i++) {
    PetscReal *scale = &box->function[i].scale;

    PetscCall(LevelSetSample_Private(cell, box, i, v[num]));
    for (PetscInt q = 0; q < total; q++) *scale = PetscMax(*scale, PetscAbsReal(v[num][q]));
    FunctionTrendSet_Private(box->dim, &box->function[i], v[num], &function);
    if (!function.zero) continue;
    for (PetscInt k = 0; k < box->dim; k++) {
      score[k]      = PetscMin(score[k], function.score[k]);
      stays[num][k] = function.stays[k];
      bend[k] += function.bend[k];
    }
    box->function[num++] = box->function[i];
  }
  box->num = num;
  for (PetscInt k = 0; k < box->dim; k++) {
    most   = PetscMax(most, bend[k]);
    widest = PetscMax(widest, box->upper[box->axis[k]] - box->lower[box->axis[k]]);
  }
  trend->planes = (PetscBool)(most <= STRAIGHT);
  PetscCall(LevelSetChooseLine_Private(cell, box, (const PetscReal(*)[MAX_SAMPLES])v, stays, score, &best));
  for (PetscInt k = 0; k < box->dim; k++) { // or the widest one
    bend[k] = bend[k] / most + WIDTH * (box->upper[box->axis[k]] - box->lower[box->axis[k]]) / widest;
    if (bend[k] > bend[bent]) bent = k;
  }
  trend->line = best >= 0 ? box->axis[best] : -1;
  trend->bent = box->axis[bent];
  for (PetscInt i = 0; i < num && best >= 0; i++) trend->stays[i] = stays[i][best];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether two functions of a box are those at the two ends of one. */
static PetscBool FunctionsAreSiblings_Private(const LevelSetFunction *a, const LevelSetFunction *b)
{
  return (PetscBool)(a->other < 0 && b->other < 0 && a->of == b->of);
}

void LevelSetBoxProject(const LevelSetBox *box, const LevelSetTrend *trend, LevelSetBox *base, PetscBool *fits)
{
  LevelSetFunction wanted[LEVELSET_MAX_FUNCTIONS * (LEVELSET_MAX_FUNCTIONS + 3) / 2];
  PetscInt         num = 0;

  *base        = *box;
  base->around = box;
  base->line   = trend->line;
  base->dim    = 0;
  for (PetscInt k = 0; k < box->dim; k++)
    if (box->axis[k] != trend->line) base->axis[base->dim++] = box->axis[k];
  for (PetscInt i = 0; i < box->num; i++) {
    const PetscReal scale = box->function[i].scale;

    wanted[num++] = (LevelSetFunction){i, -1, box->lower[trend->line], scale};
    if (trend->stays[i]) continue;
    wanted[num++] = (LevelSetFunction){i, -1, box->upper[trend->line], scale};
    for (PetscInt j = 0; j < i; j++) {
      if (trend->stays[j] || (box->around && FunctionsAreSiblings_Private(&box->function[i], &box->function[j])))
        continue;
      wanted[num++] = (LevelSetFunction){i, j, 0., scale};
    }
  }
  *fits     = (PetscBool)(num <= LEVELSET_MAX_FUNCTIONS);
  base->num = *fits ? num : 0;
  for (PetscInt i = 0; i < base->num; i++) base->function[i] = wanted[i];
}

/* Searches, by parabolas, a point between three others at which the sign of a function differs from theirs.
   [in,out] at - places and values [3]; the last two become that point and one beside it */
static PetscErrorCode LevelSetFindDip_Private(const LevelSetCell *cell, const LevelSetBox *box, PetscInt i,
                                              PetscReal at[][2], PetscReal u[], PetscBool *found)
{
  const PetscInt line = box->axis[0];

  PetscFunctionBeginUser;
  *found = PETSC_FALSE;
  for (PetscInt step = 0; step < MAX_DIP_STEPS; step++) {
    const PetscReal h0 = at[1][0] - at[0][0], h1 = at[2][0] - at[1][0];
    const PetscReal s0 = (at[1][1] - at[0][1]) / h0, s1 = (at[2][1] - at[1][1]) / h1, c = (s1 - s0) / (h0 + h1);
    const PetscReal sign  = at[1][1] > 0. ? 1. : -1.;
    const PetscReal slope = s0 + c * h0; // of the parabola in the middle
    PetscReal       x, f, least;
    PetscInt        keep;

    if (!(c * sign > 0.)) break;
    x     = at[1][0] - slope / (2. * c);
    least = at[1][1] - slope * slope / (4. * c);
    if (!(x > at[0][0] && x < at[2][0])) break;
    f = PetscMin(PetscAbsReal(at[0][1]), PetscMin(PetscAbsReal(at[1][1]), PetscAbsReal(at[2][1])));
    if (least * sign > DIP * f || PetscAbsReal(x - at[1][0]) < 1e-9 * (h0 + h1)) break;
    u[line] = x;
    PetscCall(LevelSetEvaluate_Private(cell, box, i, u, &f));
    if ((f > 0.) != (at[1][1] > 0.)) {
      at[1][0] = x;
      at[1][1] = f;
      *found   = PETSC_TRUE;
      break;
    }
    keep        = x > at[1][0] ? 0 : 2; // the end that is replaced
    at[keep][0] = at[1][0];
    at[keep][1] = at[1][1];
    at[1][0]    = x;
    at[1][1]    = f;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Zeros of function i on a part of the only coordinate of a box. [in,out] num, ends - they are appended */
static PetscErrorCode LevelSetFindZeros_Private(const LevelSetCell *cell, const LevelSetBox *box, PetscInt i,
                                                const PetscReal part[], PetscReal u[], PetscInt *num, PetscReal ends[])
{
  const PetscInt  line = box->axis[0];
  const PetscReal zero = ROUNDING * box->function[i].scale;
  PetscReal       at[LINE_SAMPLES + 1][2];
  PetscInt        kept = 0;

  PetscFunctionBeginUser;
  for (PetscInt s = 0; s < LINE_SAMPLES; s++) { // roundoff has no sign
    u[line] = at[kept][0] = part[0] + (part[1] - part[0]) * s / (LINE_SAMPLES - 1);
    PetscCall(LevelSetEvaluate_Private(cell, box, i, u, &at[kept][1]));
    if (PetscAbsReal(at[kept][1]) > zero) kept++;
  }
  for (PetscInt s = 0; s + 1 < kept; s++) {
    PetscBool found;

    if ((at[s][1] > 0.) != (at[s + 1][1] > 0.)) {
      PetscCall(LevelSetBracketZero_Private(cell, box, i, line, (const PetscReal(*)[2]) & at[s], u));
      if (*num < LEVELSET_MAX_ZEROS - 2) ends[++*num] = u[line];
    } else if (s + 2 < kept && (at[s][1] > 0.) == (at[s + 2][1] > 0.)) {
      PetscReal three[3][2];

      PetscCall(PetscArraycpy(&three[0][0], &at[s][0], 6));
      PetscCall(LevelSetFindDip_Private(cell, box, i, three, u, &found));
      for (PetscInt k = 0; k < 2 && found; k++) {
        PetscCall(LevelSetBracketZero_Private(cell, box, i, line, (const PetscReal(*)[2]) & three[k], u));
        if (*num < LEVELSET_MAX_ZEROS - 2) ends[++*num] = u[line];
      }
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Zeros along the only coordinate of a box, not in order. The first ones are those where zeros of other
   functions begin on lines; between them, the places where such zeros meet are smooth functions. */
static PetscErrorCode LevelSetFindAllZeros_Private(const LevelSetCell *cell, const LevelSetBox *box, PetscReal u[],
                                                   PetscInt *num, PetscReal ends[])
{
  const PetscInt line = box->axis[0];
  PetscReal      part[LEVELSET_MAX_ZEROS], value;
  PetscInt       parts;

  PetscFunctionBeginUser;
  part[0] = box->lower[line];
  part[1] = box->upper[line];
  for (PetscInt i = 0; i < box->num; i++)
    if (!LevelSetIsMeeting_Private(box, i, NULL))
      PetscCall(LevelSetFindZeros_Private(cell, box, i, part, u, num, ends));
  parts = *num + 1;
  PetscCall(PetscArraycpy(part, ends, parts));
  PetscCall(PetscSortReal(parts, part));
  part[parts] = box->upper[line];
  for (PetscInt i = 0; i < box->num; i++) {
    if (!LevelSetIsMeeting_Private(box, i, NULL)) continue;
    for (PetscInt k = 0; k < parts; k++) {
      u[line] = 0.5 * (part[k] + part[k + 1]);
      if (part[k + 1] - part[k] <= ZERO_ACCURACY) continue;
      PetscCall(LevelSetEvaluate_Private(cell, box, i, u, &value));
      if (!LevelSetIsMeeting_Private(box, i, u))
        PetscCall(LevelSetFindZeros_Private(cell, box, i, &part[k], u, num, ends));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelSetBoxZeros(const LevelSetCell *cell, const LevelSetBox *box, PetscInt line, PetscReal u[],
                                PetscInt *num, PetscReal ends[])
{
  PetscFunctionBeginUser;
  *num    = 0;
  ends[0] = box->lower[line];
  if (box->dim == 1) PetscCall(LevelSetFindAllZeros_Private(cell, box, u, num, ends));
  for (PetscInt i = 0; i < box->num && box->dim > 1; i++) {
    PetscCall(LevelSetFindZero_Private(cell, box, i, line, u));
    if (u[line] > box->lower[line] && u[line] < box->upper[line]) ends[++*num] = u[line];
  }
  PetscCall(PetscSortReal(*num, ends + 1));
  ends[++*num] = box->upper[line];
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelSetBoxBeyond(const LevelSetCell *cell, const LevelSetBox *box, PetscInt line, PetscReal u[],
                                 PetscReal beyond[])
{
  const PetscReal length = box->upper[line] - box->lower[line];

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < box->num; i++) {
    const PetscReal zero = ROUNDING * box->function[i].scale;

    for (PetscInt k = 0; k < 2; k++) {
      const PetscReal sign = k ? 1. : -1.;
      PetscReal       ends[2][2];

      ends[0][0] = k ? box->upper[line] : box->lower[line];
      ends[1][0] = ends[0][0] + sign * length;
      for (PetscInt j = 0; j < 2; j++) {
        u[line] = ends[j][0];
        PetscCall(LevelSetEvaluate_Private(cell, box, i, u, &ends[j][1]));
      }
      if (PetscAbsReal(ends[0][1]) <= zero || (ends[0][1] > 0.) == (ends[1][1] > 0.)) continue;
      PetscCall(LevelSetBracketZero_Private(cell, box, i, line, (const PetscReal(*)[2])ends, u));
      if (sign * (u[line] - beyond[k]) < 0. && sign * (u[line] - ends[0][0]) >= 0.) beyond[k] = u[line];
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

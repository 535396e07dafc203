/* richardson.c -- extrapolation to h = 0, with an error bar (eq. 15.2).

   Q(h) = Q + C h^q + ... gives q from three levels h, h/2, h/4, and Q = Q2 + (Q2 - Q1) / (2^q - 1). The bar
   is the second term times a factor of safety (Roache, Verification and validation in computational science
   and engineering, 1998). Contact forces converge irregularly, since the edge of contact jumps from node to
   node. Two levels may agree by chance, which looks like a high order. So orders above 2 are not used,
   neither for 2^q nor for the last difference. */
#include <math.h>
#include <stdio.h>
#include "study/richardson.h"

/* Roache's factor for three meshes. */
static const PetscReal SAFETY = 1.25;
/* Observed orders are used between these. */
static const PetscReal RATE_MIN = 0.5, RATE_MAX_MESHES = 2;
/* The same for load steps: slip from the beginning to the end of a step is of first order. */
static const PetscReal RATE_MAX_STEPS = 1;
/* Where the order of load steps is above RATE_CHANCE, or there is none, the bar is at least IRREGULAR_SPREAD
   times the spread of the values. Contact grows from node to node then, or loads turn within a step. */
static const PetscReal RATE_CHANCE = 1.2, IRREGULAR_SPREAD = 2;
/* Relative difference between solutions of the same equations, on other numbers of processes for instance. */
static const PetscReal SOLVED = 1e-9;

static PetscReal RichardsonSpread_Private(const PetscReal Q[RICHARDSON_LEVELS])
{
  return PetscMax(PetscMax(Q[0], Q[1]), Q[2]) - PetscMin(PetscMin(Q[0], Q[1]), Q[2]);
}

/* [in] most - the highest order that is used */
static Extrapolation RichardsonExtrapolate_Private(const PetscReal Q[RICHARDSON_LEVELS], PetscReal most)
{
  const PetscReal first = Q[1] - Q[0], second = Q[2] - Q[1];
  Extrapolation   limit = {.value = Q[2], .rate = NAN};

  limit.monotone = (PetscBool)(first * second > 0 && PetscAbsReal(second) < PetscAbsReal(first));
  if (limit.monotone) {
    const PetscReal least = PetscAbsReal(first) / PetscPowReal(2, most); // of the second difference
    PetscReal       shrink;

    limit.rate  = PetscLog2Real(first / second);
    shrink      = PetscPowReal(2, PetscMin(PetscMax(limit.rate, RATE_MIN), most)) - 1;
    limit.value = Q[2] + second / shrink;
    limit.bar   = SAFETY * PetscMax(PetscAbsReal(second), least) / shrink;
  } else {
    limit.bar = RichardsonSpread_Private(Q);
  }
  limit.bar = PetscMax(limit.bar, SOLVED * PetscAbsReal(limit.value));
  return limit;
}

Extrapolation RichardsonExtrapolate(const PetscReal Q[RICHARDSON_LEVELS])
{
  return RichardsonExtrapolate_Private(Q, RATE_MAX_MESHES);
}

Extrapolation RichardsonExtrapolateSteps(const PetscReal Q[RICHARDSON_LEVELS])
{
  Extrapolation limit = RichardsonExtrapolate_Private(Q, RATE_MAX_STEPS);

  if (!limit.monotone || limit.rate > RATE_CHANCE)
    limit.bar = PetscMax(limit.bar, IRREGULAR_SPREAD * RichardsonSpread_Private(Q));
  return limit;
}

/* Prints a number, without the leading zeros and the plus sign that printf gives exponents. */
static void RichardsonPrintNumber_Private(char text[], size_t len, PetscReal value, PetscInt exponent, PetscInt digits)
{
  static const PetscInt PLAIN_MIN = -4, PLAIN_MAX = 5; /* powers of ten that are written out */

  if (exponent >= PLAIN_MIN && exponent <= PLAIN_MAX && digits >= exponent)
    snprintf(text, len, "%.*f", (int)(digits - exponent), (double)value);
  else
    snprintf(text, len, "%.*fe%d", (int)digits, (double)(value / PetscPowReal(10, exponent)), (int)exponent);
}

void RichardsonText(const Extrapolation *limit, char text[], size_t len)
{
  static const PetscReal TWO_DIGITS = 3;  /* bars that begin with 1 or 2 have two digits: one would round up too much */
  static const PetscInt  ALL_DIGITS = 15; /* of a number without a bar */
  static const PetscReal GUARD      = 1e-9; /* so that 2 is not rounded up to 3 by roundoff */
  char                   value[64], bar[64];
  PetscInt               power, exponent;
  PetscReal              unit, shown, rounded;

  if (!(limit->bar > 0) || !isfinite((double)limit->value) || !isfinite((double)limit->bar)) {
    snprintf(text, len, "%.*g", (int)ALL_DIGITS, (double)limit->value);
    return;
  }
  power = (PetscInt)floor(log10((double)limit->bar));
  if (limit->bar / PetscPowReal(10, power) < TWO_DIGITS) --power;
  unit     = PetscPowReal(10, power);
  shown    = unit * round((double)(limit->value / unit));
  rounded  = unit * ceil((double)((limit->bar + PetscAbsReal(limit->value - shown)) / unit) - GUARD);
  exponent = PetscAbsReal(shown) > unit ? (PetscInt)floor(log10((double)PetscAbsReal(shown)) + GUARD) : power;
  if (shown == 0)
    snprintf(value, sizeof(value), "0");
  else
    RichardsonPrintNumber_Private(value, sizeof(value), shown, exponent, PetscMax(exponent - power, 0));
  exponent = (PetscInt)floor(log10((double)rounded) + GUARD);
  RichardsonPrintNumber_Private(bar, sizeof(bar), rounded, exponent, PetscMax(exponent - power, 0));
  snprintf(text, len, "%s +- %s", value, bar);
}

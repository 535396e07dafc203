/* peak.h -- the surfaces around the largest pressure of a pair. */
#ifndef MORTISE_PEAK_H
#define MORTISE_PEAK_H

#include "result/fields.h"

/* Whether the exact pressure can have no limit there. */
typedef enum {
  PEAK_UNKNOWN,
  PEAK_SMOOTH, /* it has one: a smooth side in front of a smooth obstacle */
  PEAK_END,    /* the nonmortar side ends there, at a corner of the body or at a plane of symmetry */
  PEAK_KINK    /* it has none: an edge of an obstacle */
} PeakShape;

typedef struct {
  PetscReal pressure; /* the largest one */
  PetscReal size;     /* of the smallest facet at the largest pressure; 0 without contact */
  PeakShape shape;
  PetscReal exponent; /* e > 0 of the pressure r^-e at an edge there, where that is certain (edgeexponent.h); else 0 */
} Peak;

/* Collective. In space shape and exponent are not known. */
PetscErrorCode PeakGet(Fields fields, PetscInt p, Peak *peak);

#endif

/* unevenpressure.h -- pressures that follow the facets of a coarser and softer mortar side. */
#ifndef MORTISE_UNEVENPRESSURE_H
#define MORTISE_UNEVENPRESSURE_H

#include "result/fields.h"

/* The largest pressure of a pair; the same on all ranks. */
typedef struct {
  PetscBool shows;         /* it is far above the mean around it, since facets of the softer mortar side are larger */
  PetscReal largest, mean; /* this pressure; the mean over the facets around its node */
  PetscReal ratio;         /* of lengths of facets there, mortar over nonmortar */
  PetscReal at[3];         /* its place */
} UnevenPressure;

/* Of pair p. Nothing shows at an edge of the nonmortar side or of its partner, where the pressure may be
   unbounded. A plane of symmetry makes no edge. Nothing shows on bodies with regions of other materials.
   Collective. */
PetscErrorCode UnevenPressureFind(Fields fields, PetscInt p, UnevenPressure *found);

#endif

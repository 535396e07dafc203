/* validity.h -- how far a solution is from where small displacements stop to hold (eqs. 11.5-11.8).

   The theory linearizes strains, normals, projections and gaps where the bodies are before the loads.
   Indicators tell by how much each of these has changed when the loads have moved the bodies. All of them
   grow in proportion to displacements. */
#ifndef MORTISE_VALIDITY_H
#define MORTISE_VALIDITY_H

#include <cjson/cJSON.h>
#include "result/fields.h"

typedef enum {
  VALIDITY_STRAIN, /* |1/2 grad u' grad u| / |eps|, quantiles: the part of Green's strain that is left out (yielding.h) */
  VALIDITY_ROTATION,     /* rotation, a quantile, radians */
  VALIDITY_GAP,          /* largest |deformed gap - linearized gap| over the largest displacement or gap of the pair */
  VALIDITY_SLIP_CELL,    /* largest slip in contact over the shortest facet edge there, or 20 times the next */
  VALIDITY_SLIP_CONTACT, /* largest slip in contact over the sizes of its patch and sides (slippatch.h) */
  VALIDITY_NORMAL,       /* largest turn of a normal of a nonmortar side, radians */
  VALIDITY_COUNT
} ValidityKind;

typedef enum { VALIDITY_UNKNOWN, VALIDITY_GREEN, VALIDITY_AMBER, VALIDITY_RED } ValidityColour;

/* The same on all ranks. */
typedef struct {
  PetscReal      value, at[3]; /* NAN where there is nothing to measure */
  ValidityColour colour;
  PetscInt       body, pair; /* where it is, of the scene; -1 for none */
} ValidityIndicator;

struct _n_Validity {
  ValidityIndicator indicator[VALIDITY_COUNT];
  ValidityColour    worst;
  PetscReal         load_factor; /* the least limit to red over value; NAN where nothing moves */
  PetscBool         homogeneous; /* all sides touch at nodes with a multiplier: u is proportional to the loads */
  /* sum W p |slip| over the work done on the bodies: what friction of coefficient 1 would take of it at most,
     about; NAN without contact */
  PetscReal friction;
};
typedef struct _n_Validity *Validity;

/* Warns "model_limit" unless all indicators are green. Collective. */
PetscErrorCode ValidityWarn(Fields fields);
/* Adds the object "validity" of the summary. Collective. [in] fields - NULL if there is no solution */
PetscErrorCode ValidityAdd(Fields fields, cJSON *root);

#endif

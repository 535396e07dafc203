/* costforecast.h -- memory of the next mesh. */
#ifndef MORTISE_COSTFORECAST_H
#define MORTISE_COSTFORECAST_H

#include "scene/scene.h"

/* A mesh that was solved on. */
typedef struct {
  PetscInt  unknowns;
  PetscReal bytes; /* peak of all ranks */
} CostPoint;

/* Expected bytes of a mesh with more unknowns, from the latest two meshes. Not collective.
   [in] before - optional, may be NULL */
PetscReal CostForecastNext(Scene scene, const CostPoint *last, const CostPoint *before, PetscReal unknowns);

enum { BYTES_TEXT = 32 };
/* A number of bytes as "1.2 GB". Not collective. [out] text - [BYTES_TEXT] */
void CostForecastPrintBytes(PetscReal bytes, char text[]);

#endif

/* costforecast.h -- memory of meshes that are not there yet. */
#ifndef MORTISE_COSTFORECAST_H
#define MORTISE_COSTFORECAST_H

#include "scene/scene.h"

/* A mesh that was solved on. */
typedef struct {
  PetscInt  unknowns;
  PetscReal bytes; /* peak of all ranks */
} CostPoint;

/* Bytes that a mesh with more unknowns will need, from the latest two. Not collective. [in] before - or NULL */
PetscReal CostForecastNext(Scene scene, const CostPoint *last, const CostPoint *before, PetscReal unknowns);

enum { BYTES_TEXT = 32 };
/* "1.2 GB". Not collective. [out] text - [BYTES_TEXT] */
void CostForecastPrintBytes(PetscReal bytes, char text[]);

#endif

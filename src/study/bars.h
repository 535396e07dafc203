/* bars.h -- error bars from the results of several meshes. */
#ifndef MORTISE_BARS_H
#define MORTISE_BARS_H

#include <cjson/cJSON.h>
#include "result/barfloors.h"

/* One mesh. */
typedef struct {
  const cJSON *row; /* of SummaryCreateStep() */
  PetscReal    eta; /* its error estimate, as it was computed */
} BarMesh;

/* All meshes so far, coarse first, and what the finest one says of itself. */
typedef struct {
  PetscInt         num;
  const BarMesh   *mesh; /* [num] */
  const BarFloors *floors;
  Scene            scene;
  PetscReal        error;  /* E: the calibrated estimate of the finest mesh */
  PetscReal        excess; /* its 2 (J_h - J), estimated */
} BarHistory;

/* The half widths of the intervals around the finest mesh's numbers (eq. 15.5), with r_j = min(eta_k / eta_j, .95):
       b = max(1.25 max_{j = k-4..k-1} |Q_k - Q_j| r_j / (1 - r_j), floor),
   with the largest difference in place of the first part where there are fewer meshes and eta_k is above a quarter of the first one's.
   Not collective. [out] bars - an object with the keys of the summary: energy, pairs, reactions, probes; null where a number grows
   without limit, whose pairs are listed in "unbounded". Owned by the caller */
PetscErrorCode BarsCreate(const BarHistory *history, cJSON **bars);

#endif

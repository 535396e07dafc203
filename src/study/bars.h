/* bars.h -- error bars from the results of several meshes. */
#ifndef MORTISE_BARS_H
#define MORTISE_BARS_H

#include <cjson/cJSON.h>
#include "result/barfloors.h"
#include "result/peak.h"

/* One mesh. */
typedef struct {
  const cJSON *row;  /* of SummaryCreateStep() */
  PetscReal    eta;  /* its error estimate, not calibrated */
  PetscBool    lost; /* whether the error is as large as the solution: it shows no rate */
  const Peak  *peak; /* of pairs [num_pairs] */
} BarMesh;

/* All meshes so far, coarse first, and estimates of the finest one. */
typedef struct {
  PetscInt         num;
  const BarMesh   *mesh; /* [num] */
  const BarFloors *floors;
  Scene            scene;
  PetscReal        excess; /* 2 (J_h - J) of the finest mesh, estimated */
  PetscReal        limit;  /* bar of the limit of the potential */
} BarHistory;

/* Error bars: half widths of intervals around the numbers of the finest mesh (eq. 15.5), with r_j = min(eta_k
       / eta_j, .95): b = max(1.25 max_{j = k-4..k-1} |Q_k - Q_j| r_j / (1 - r_j), floor).
   With fewer than five meshes, their largest difference times 4 over the number of earlier meshes takes the
       place of the
   first term; not if eta_k is below a quarter of the first estimate, the error below the solution, and
   increments halve. Not collective.
   [out] bars - an object with the keys of the summary: energy, pairs, reactions, probes; null for a number
   that grows
   without limit. "unbounded" lists the pairs of such pressures. Owned by the caller */
PetscErrorCode BarsCreate(const BarHistory *history, cJSON **bars);

#endif

/* estimatepairs.h -- what contact adds to the error estimate. */
#ifndef MORTISE_ESTIMATEPAIRS_H
#define MORTISE_ESTIMATEPAIRS_H

#include "result/compliance.h"
#include "result/estimate.h"

/* The last two lines of eq. 15.3 for all pairs. Collective. [in] frozen - of EstimateCreateFrozen(), or NULL;
   [in,out] cell - eta_T^2 of this rank's cells [num_cells];
   [in,out] surplus - the part of it that is not in eta^2 [num_cells];
   [out] signs - this rank's part of L; [out] hidden - what this rank knows, zero before; not with a frozen
   set [num_pairs] */
PetscErrorCode EstimatePairsAdd(Fields fields, const EstimateFrozen *frozen, Compliance *compliance, PetscReal cell[],
                                PetscReal surplus[], PetscReal *signs, Largest hidden[]);

#endif

/* envelopecompliance.h -- the compliance of a few combinations of the unknowns of a matrix with factors in
   blocks; internal (eq. 13.5). */
#ifndef MORTISE_ENVELOPECOMPLIANCE_H
#define MORTISE_ENVELOPECOMPLIANCE_H

#include <petscmat.h>
#include "multigrid/envelopeparts.h"

/* G = X A^-1 X'. Collective.
   [in] parts - of rows of A on this rank, without edges; [in] X - AIJ; [in] columns - X' in these rows, with
   all columns, AIJ of one process; [in] limit - of the number of products of all ranks;
   [out] num, touched - blocks in which X has entries; owned by the caller [num];
   [out] G - distributed like X, SPD if the rows of X are independent; owned by the caller; NULL if the
   limit is exceeded */
PetscErrorCode EnvelopeComplianceCreate(const EnvelopeParts *parts, Mat X, Mat columns, PetscReal limit, PetscInt *num,
                                        PetscInt **touched, Mat *G);

#endif

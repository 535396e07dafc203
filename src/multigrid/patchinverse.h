/* patchinverse.h -- inverses of the matrices of patches, for products; internal (eq. 13.7). */
#ifndef MORTISE_PATCHINVERSE_H
#define MORTISE_PATCHINVERSE_H

#include "multigrid/graphpatches.h"

/* One inverse, shared by all patches of the same matrix. */
typedef struct _n_PatchInverse *PatchInverse;
/* Inverses in the making: knows matrices that came before. */
typedef struct _n_PatchInverses *PatchInverses;

/* Not collective. [in] largest - unknowns of a patch at most; [out] inverses - owned by the caller */
PetscErrorCode PatchInversesCreate(PetscInt largest, PatchInverses *inverses);
PetscErrorCode PatchInversesDestroy(PatchInverses *inverses);
/* The inverse of A, or that of its diagonal if roundoff makes A indefinite. Where a diagonal entry is 0, row
   and column of the inverse are 0. Not collective.
   [in] A - symmetric, scaled to a diagonal of about 1; overwritten [num][num]; [out] inverse - owned by the
   caller */
PetscErrorCode PatchInversesGet(PatchInverses inverses, PetscInt num, PetscReal A[], PatchInverse *inverse);

/* z += sum_p R_p' A_p^-1 R_p r over patches p. Not collective.
   [in] inverse - of each patch [patches->num]; [in] r - [nodes][dim]; [in,out] z - like r; work -
   [PatchInverseWork()] */
void PatchInverseAdd(const GraphPatches *patches, const PatchInverse inverse[], PetscInt dim, const PetscReal r[],
                     PetscReal z[], float work[]);
/* Numbers of `work` for patches of at most num unknowns. */
PetscInt PatchInverseWork(PetscInt num);
/* Of one reference. Not collective. */
PetscErrorCode PatchInverseDestroy(PatchInverse *inverse);
/* The same inverse for another owner. Not collective. */
PatchInverse PatchInverseReference(PatchInverse inverse);

#endif

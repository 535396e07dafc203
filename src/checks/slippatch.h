/* slippatch.h -- how far slips are beside the sizes of contact (eq. 11.6a). */
#ifndef MORTISE_SLIPPATCH_H
#define MORTISE_SLIPPATCH_H

#include "checks/contactpatches.h"

/* Of one patch, the same on all ranks. */
typedef struct {
  PetscReal common[3]; /* slip that all nodes have in common: along their mean by force the least one, or 0 */
  PetscReal extent;    /* of the shorter side along this slip; infinite without it */
} SlipPatch;

/* Common slips of the patches of pair p, and extents of its sides along them. Collective.
   [in] patch - of each node, -1 where it is not in contact [pair->num];
   [in] force - of each node [pair->num]; [in] tangential - slips [pair->num][dim];
   [out] slips - owned by the caller, PetscFree() [patches->num] */
PetscErrorCode SlipPatchesCreate(Fields fields, PetscInt p, const ContactPatches *patches, const PetscInt patch[],
                                 const PetscReal force[], const PetscReal tangential[], SlipPatch **slips);
/* |s - c| / width + |c| / extent with the common slip c, where the extent is at least the width. Not
   collective. [in] slip - of a node [dim]; [in] width - of the patch */
PetscReal SlipPatchCompare(const SlipPatch *patch, PetscInt dim, const PetscReal slip[], PetscReal width);

#endif

/* patchlinks.h -- nodes that join the patches of mortar nodes; internal (eq. 13.7). */
#ifndef MORTISE_PATCHLINKS_H
#define MORTISE_PATCHLINKS_H

#include "multigrid/operator.h"

/* Nodes that mortar nodes move by T; with order 2 in the plane also those that share a cell with them.
   Collective.
   [in] op - with T; [in] n - nodes of this rank; [out] links - nodes (rows) and those that join their patches
   (columns); AIJ, owned by the caller */
PetscErrorCode PatchLinksCreate(const Operator *op, PetscInt n, Mat *links);

#endif

/* bundles.h -- lines and planes of nodes across long cells; internal (floor 6). */
#ifndef MORTISE_BUNDLES_H
#define MORTISE_BUNDLES_H

#include <mortise/vi.h>
#include "halo.h"

/* Nodes of one bundle have one label; a node that is in none has its own. Collective.
   [in] vi - with a level; [in] halo - nodes that K leads to; [in] wanted - whether bundles are asked for even where cells are not long; [out] label -
   by halo [halo->n + halo->num]; [out] found - false where cells are not long and bundles not asked for: label is nothing then */
PetscErrorCode BundlesFind(VI vi, Halo *halo, PetscBool wanted, PetscReal label[], PetscBool *found);

#endif

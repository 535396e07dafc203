/* blocksmoother.h -- lines and planes of nodes across long cells. */
#ifndef MORTISE_BLOCKSMOOTHER_H
#define MORTISE_BLOCKSMOOTHER_H

#include "multigrid/operator.h"
#include "multigrid/ghostexchange.h"

/* Nodes of one bundle have one label; a node that is in none has its own. Collective.
   [in] op - with coords; [in] halo - nodes that K leads to; [in] wanted - whether bundles are asked for even where cells are not long; [out] label -
   by halo [halo->n + halo->num]; [out] found - false where cells are not long and bundles not asked for: label is nothing then */
PetscErrorCode BlockSmootherLabel(const Operator *op, GhostExchange *ghosts, PetscBool wanted, PetscReal label[],
                                  PetscBool *found);

#endif

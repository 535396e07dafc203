/* blocksmoother.h -- smoother blocks: lines and planes of nodes along short cell edges (eq. 13.4). */
#ifndef MORTISE_BLOCKSMOOTHER_H
#define MORTISE_BLOCKSMOOTHER_H

#include "multigrid/operator.h"
#include "multigrid/ghostexchange.h"

/* Labels nodes: those of one block share a label, a node without block has its own. Collective.
   [in] op - with coords; [in] ghosts - nodes in the columns of K; [in] wanted - search for blocks even if
   cells are not long; [out] label - own nodes, then ghosts [ghosts->n + ghosts->num]; [out] found - false: no
   search, label is undefined; [out] round - whether no cell is long */
PetscErrorCode BlockSmootherLabel(const Operator *op, GhostExchange *ghosts, PetscBool wanted, PetscReal label[],
                                  PetscBool *found, PetscBool *round);

#endif

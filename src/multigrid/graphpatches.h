/* graphpatches.h -- small sets of nodes around a vertex or of a cell, found in the graph of a matrix;
   internal (eq. 13.7). */
#ifndef MORTISE_GRAPHPATCHES_H
#define MORTISE_GRAPHPATCHES_H

#include "multigrid/ghostexchange.h"
#include "multigrid/rankrows.h"

typedef struct {
  PetscBool cells; /* whether they are cells, not stars; the same on all ranks */
  PetscInt  num;
  PetscInt *start; /* into node [num + 1] */
  PetscInt *node;  /* counted as in GhostExchange [start[num]] */
} GraphPatches;

/* Patches of marked nodes. Collective.
   [in] rows - of a matrix with full blocks of bs unknowns; [in] ghosts - its nodes; [in] marked - own nodes,
   then ghosts, 1 or 0 [n + num]; [out] patches - to be destroyed by the caller */
PetscErrorCode GraphPatchesCreate(RankRows *rows, PetscInt bs, GhostExchange *ghosts, const PetscReal marked[],
                                  GraphPatches *patches);
/* Adds to every patch the nodes that its nodes are linked to. Not collective. [in] links - of patchlinks.h */
PetscErrorCode GraphPatchesExtend(const GhostExchange *ghosts, RankRows *links, GraphPatches *patches);
PetscErrorCode GraphPatchesDestroy(GraphPatches *patches);

#endif

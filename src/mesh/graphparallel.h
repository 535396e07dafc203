/* graphparallel.h -- the graph of cells, partitioned by all ranks. */
#ifndef MORTISE_GRAPHPARALLEL_H
#define MORTISE_GRAPHPARALLEL_H

#include "mesh/filecells.h"
#include "partition/cellgraph.h"

/* Whether there is a library that partitions a graph on all ranks. */
PetscBool GraphHasParallel(void);
/* Partitions the graph of all cells. Collective.
   [in] graph - edges of all cells, each on any one rank; [out] part - [cells->num] */
PetscErrorCode GraphCutParallel(Scene scene, const Files *files, const FileCells *cells, const CellGraph *graph,
                                PetscInt part[]);

#endif

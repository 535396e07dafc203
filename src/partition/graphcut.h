/* graphcut.h -- the parts of the graph of cells by METIS. */
#ifndef MORTISE_GRAPHCUT_H
#define MORTISE_GRAPHCUT_H

#include "partition/cellgraph.h"

/* Partitions the graph by METIS. Not collective.
   [in] level - its dim, num_cells, cell_type and cell_body; [in] refine - number of later refinements;
   [out] part - [level->num_cells] */
PetscErrorCode CellGraphCut(Scene scene, const Level *level, PetscInt refine, const CellGraph *graph,
                            PetscInt num_parts, PetscInt part[]);

#endif

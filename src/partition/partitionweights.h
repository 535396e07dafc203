/* partitionweights.h -- weights of a partition. Nothing is collective. */
#ifndef MORTISE_PARTITIONWEIGHTS_H
#define MORTISE_PARTITIONWEIGHTS_H

#include "partition/cellgraph.h"

/* The loads that a partition balances: the work of unknowns, and that of contact. */
enum { PARTITION_MAX_WEIGHTS = 2 };
typedef struct {
  PetscInt   num, num_parts;                   /* 1, unless nonmortar sides have enough facets */
  PetscReal  bricks;                           /* mean number of bricks of a cell */
  PetscInt  *load;                             /* of every cell, nodes in twelfths [num_cells][num] */
  PetscReal *target;                           /* share of each part in the sum [num_parts][num] */
  PetscReal  tolerance[PARTITION_MAX_WEIGHTS]; /* permitted load of a part over its share */
} PartitionWeights;

/* The same for all. */
PetscErrorCode PartitionWeightsCreate(Scene scene, const Level *level, const CellGraph *graph, PetscInt num_parts,
                                      PartitionWeights *shares);
/* Reduces the targets of parts with many nodes between parts.
   [in] refine - number of later refinements; part - a partition similar to the final one [num_cells] */
PetscErrorCode PartitionWeightsCorrect(Scene scene, const Level *level, PetscInt refine, const CellGraph *graph,
                                       const PetscInt part[], PartitionWeights *shares);
PetscErrorCode PartitionWeightsDestroy(PartitionWeights *shares);

#endif

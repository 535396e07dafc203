/* graphcut.c -- the parts of the graph of cells by METIS. */
#include "base/compat.h"
#include "partition/cellgraph.h"
#include "partition/graphcut.h"
#include "partition/partitionweights.h"
#include <metis.h>

enum { MAX_RECURSIVE = 8 }; /* METIS's own advice: recursive bisection is better up to eight parts */

/* Edges as compressed rows for METIS; weights of repeated edges are added. [out] start - [num_cells+1];
   adjacent, weight - [2 * edges->num] */
static PetscErrorCode EdgesToRows_Private(const CellGraph *edges, PetscInt num_cells, idx_t start[], idx_t adjacent[],
                                          idx_t weight[])
{
  PetscInt *begin, *fill, *other, *share, kept = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc2(num_cells + 1, &begin, num_cells, &fill));
  PetscCall(PetscMalloc2(2 * edges->num, &other, 2 * edges->num, &share));
  for (PetscInt i = 0; i < 2 * edges->num; i++) begin[edges->end[i] + 1]++;
  for (PetscInt c = 0; c < num_cells; c++) begin[c + 1] += begin[c];
  for (PetscInt i = 0; i < 2 * edges->num; i++) { // end i is opposite to end i ^ 1
    const PetscInt c = edges->end[i], at = begin[c] + fill[c]++;

    other[at] = edges->end[i ^ 1];
    share[at] = edges->weight[i / 2];
  }
  for (PetscInt c = 0; c < num_cells; c++) {
    start[c] = (idx_t)kept;
    PetscCall(
        PetscSortIntWithArray(fill[c], &other[begin[c]], &share[begin[c]])); // one facet may have thousands of partners
    for (PetscInt i = begin[c]; i < begin[c + 1]; i++) {
      if (kept > start[c] && adjacent[kept - 1] == other[i]) {
        weight[kept - 1] += (idx_t)share[i];
        continue;
      }
      adjacent[kept] = (idx_t)other[i];
      weight[kept++] = (idx_t)share[i];
    }
  }
  start[num_cells] = (idx_t)kept;
  PetscCall(PetscFree2(begin, fill));
  PetscCall(PetscFree2(other, share));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Partitions the graph by METIS. */
static PetscErrorCode EdgesCut_Private(const CellGraph *edges, PetscInt num_cells, const PartitionWeights *shares,
                                       PetscInt part[])
{
  idx_t  n = (idx_t)num_cells, parts = (idx_t)shares->num_parts, constraints = (idx_t)shares->num, cut;
  idx_t *start, *adjacent, *weight, *load, *answer;
  real_t tolerance[PARTITION_MAX_WEIGHTS], *target;
  int    status;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(num_cells + 1, &start, 2 * edges->num, &adjacent, 2 * edges->num, &weight));
  PetscCall(PetscMalloc3(num_cells * shares->num, &load, shares->num_parts * shares->num, &target, num_cells, &answer));
  PetscCall(EdgesToRows_Private(edges, num_cells, start, adjacent, weight));
  for (PetscInt i = 0; i < num_cells * shares->num; i++) load[i] = (idx_t)shares->load[i];
  for (PetscInt i = 0; i < shares->num_parts * shares->num; i++) target[i] = (real_t)shares->target[i];
  for (PetscInt i = 0; i < shares->num; i++) tolerance[i] = (real_t)shares->tolerance[i];
  if (parts <= MAX_RECURSIVE) {
    status = METIS_PartGraphRecursive(&n, &constraints, start, adjacent, load, NULL, weight, &parts, target, tolerance,
                                      NULL, &cut, answer);
  } else {
    status = METIS_PartGraphKway(&n, &constraints, start, adjacent, load, NULL, weight, &parts, target, tolerance, NULL,
                                 &cut, answer);
  }
  PetscCheck(status != METIS_ERROR_MEMORY, PETSC_COMM_SELF, PETSC_ERR_MEM, "No memory for METIS");
  PetscCheck(status == METIS_OK, PETSC_COMM_SELF, PETSC_ERR_LIB, "METIS gave up with status %d", status);
  for (PetscInt c = 0; c < num_cells; c++) part[c] = (PetscInt)answer[c];
  PetscCall(PetscFree3(load, target, answer));
  PetscCall(PetscFree3(start, adjacent, weight));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CellGraphCut(Scene scene, const Level *level, PetscInt refine, const CellGraph *graph,
                            PetscInt num_parts, PetscInt part[])
{
  PartitionWeights shares;

  PetscFunctionBeginUser;
  PetscCall(PartitionWeightsCreate(scene, level, graph, num_parts, &shares));
  PetscCall(EdgesCut_Private(graph, level->num_cells, &shares, part));
  PetscCall(PartitionWeightsCorrect(scene, level, refine, graph, part, &shares));
  PetscCall(EdgesCut_Private(graph, level->num_cells, &shares, part));
  PetscCall(PartitionWeightsDestroy(&shares));
  PetscFunctionReturn(PETSC_SUCCESS);
}

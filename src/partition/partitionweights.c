/* partitionweights.c -- weights of a partition: each rank gets about equal numbers of unknowns and of facets
   of nonmortar sides. METIS and PETSc partition by given weights; these are computed from mesh and pairs.
   Facets beyond the reach count as well: to find their shapes and that they have no partner is as much work.

   Unknowns belong to nodes, and nodes between the parts of two ranks go to one of them. The parts themselves
   are made of cells of the coarsest mesh, so a rank with nodes between parts gets fewer cells. */
#include "base/compat.h"
#include "partition/cellgraph.h"
#include "partition/partitionweights.h"

/* Facets of nonmortar sides per part: with fewer, contact is not balanced. In the plane contact is little
   work, and more messages are not worth it. */
enum { MIN_FACETS_A_PART = 3, MIN_FACETS_A_PART_SOLID = 1 };
/* Permitted load of a part over its share: cells, contact. */
static const PetscReal TOLERANCE[PARTITION_MAX_WEIGHTS] = {1.02, 1.1};
/* Up to three facets per part, one more than the whole ones of a share is permitted, in spite of rounding.
   METIS gives parts very unequal cells where it cannot reach a tolerance. */
static const PetscReal ONE_MORE = 1.01;

/* This part of the work is proportional to nodes (the solver), the rest to cells (mesh, assembly). */
static const PetscReal BY_NODES = 2.0 / 3;
/* Largest reduction of a part for the nodes around it, relative to its share: parts without an interior gain
   nothing. */
static const PetscReal MOST = 0.5;

/* Nodes per cell and per facet of first order in a regular mesh, in twelfths: a triangle has half of those of
   a quadrilateral. */
static const PetscInt NODES[ELEMENT_COUNT] = {
    [ELEMENT_LINE2] = 12, [ELEMENT_TRI3] = 6, [ELEMENT_QUAD4] = 12, [ELEMENT_TET4] = 2, [ELEMENT_HEX8] = 12};

/* Ratio of the order of a body to the lowest order of all bodies: its factor of nodes along an edge. */
static PetscInt PartitionWeightsOrderFactor_Private(Scene scene, PetscInt body)
{
  PetscInt least = PETSC_MAX_INT;

  for (PetscInt b = 0; b < scene->num_bodies; b++) least = PetscMin(least, scene->bodies[b].order);
  return scene->bodies[body].order / least;
}

PetscErrorCode PartitionWeightsCreate(Scene scene, const Level *level, const CellGraph *graph, PetscInt num_parts,
                                      PartitionWeights *shares)
{
  const PetscInt *contact = graph->contact, *bricks = graph->bricks;
  const PetscInt  least  = level->dim == 3 ? MIN_FACETS_A_PART_SOLID : MIN_FACETS_A_PART;
  PetscInt        facets = 0, all = 0;
  PetscReal       mean;

  PetscFunctionBeginUser;
  for (PetscInt c = 0; c < level->num_cells; c++) facets += contact[c];
  shares->num       = facets >= least * num_parts ? PARTITION_MAX_WEIGHTS : 1;
  shares->num_parts = num_parts;
  for (PetscInt i = 0; i < shares->num; i++) shares->tolerance[i] = TOLERANCE[i];
  mean = (PetscReal)facets / (PetscReal)num_parts;
  if (shares->num > 1 && mean < MIN_FACETS_A_PART)
    shares->tolerance[1] = PetscMax(shares->tolerance[1], ONE_MORE * (PetscFloorReal(mean) + 1) / mean);
  for (PetscInt c = 0; c < level->num_cells; c++) all += bricks ? bricks[c] : 1;
  shares->bricks = (PetscReal)all / (PetscReal)PetscMax(level->num_cells, 1);
  PetscCall(PetscMalloc2(level->num_cells * shares->num, &shares->load, num_parts * shares->num, &shares->target));
  for (PetscInt i = 0; i < num_parts * shares->num; i++) shares->target[i] = 1 / (PetscReal)num_parts;
  for (PetscInt c = 0; c < level->num_cells; c++) {
    PetscInt *own = &shares->load[c * shares->num];

    own[0] = NODES[ElementLinear((ElementType)level->cell_type[c])] * (bricks ? bricks[c] : 1);
    for (PetscInt d = 0; d < level->dim; d++) own[0] *= PartitionWeightsOrderFactor_Private(scene, level->cell_body[c]);
    if (shares->num > 1) own[1] = contact[c];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Nodes between cells of different parts, in the units of loads. On the finest level the ratio of nodes of a
   cell and of a facet is the number of cells along an edge. DMPlexDistribute() gives these nodes to the
   highest rank. A common order of all bodies does not count, so that all orders have one partition.
   [out] nodes - [num_parts] */
static PetscErrorCode PartitionWeightsCountBetween_Private(Scene scene, const Level *level, PetscInt refine,
                                                           const CellGraph *graph, const PetscInt part[],
                                                           PetscReal bricks, PetscReal nodes[])
{
  const PetscReal along = PetscPowRealInt(2, (int)refine) * PetscPowReal(bricks, 1 / (PetscReal)level->dim) / bricks;

  PetscFunctionBeginUser;
  for (PetscInt e = 0; e < graph->num_neighbours; e++) {
    const PetscInt *cells = &graph->end[2 * e];
    PetscReal       own;

    if (part[cells[0]] == part[cells[1]]) continue;
    own = NODES[ElementFacetType(ElementLinear((ElementType)level->cell_type[cells[0]]))] / along;
    for (PetscInt d = 1; d < level->dim; d++)
      own *= PartitionWeightsOrderFactor_Private(scene, level->cell_body[cells[0]]);
    nodes[PetscMax(part[cells[0]], part[cells[1]])] += own;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PartitionWeightsCorrect(Scene scene, const Level *level, PetscInt refine, const CellGraph *graph,
                                       const PetscInt part[], PartitionWeights *shares)
{
  const PetscInt num_parts = shares->num_parts;
  PetscReal     *between, all = 0, mean = 0, most = 0, factor;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(num_parts, &between));
  PetscCall(PartitionWeightsCountBetween_Private(scene, level, refine, graph, part, shares->bricks, between));
  for (PetscInt c = 0; c < level->num_cells; c++) all += (PetscReal)shares->load[c * shares->num];
  for (PetscInt p = 0; p < num_parts; p++) mean += between[p] / (PetscReal)num_parts;
  for (PetscInt p = 0; p < num_parts; p++) most = PetscMax(most, PetscAbsReal(between[p] - mean));
  factor = most > 0 ? PetscMin(BY_NODES, MOST * all / ((PetscReal)num_parts * most)) : 0;
  for (PetscInt p = 0; p < num_parts; p++)
    shares->target[p * shares->num] = 1 / (PetscReal)num_parts - factor * (between[p] - mean) / all;
  PetscCall(PetscFree(between));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PartitionWeightsDestroy(PartitionWeights *shares)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree2(shares->load, shares->target));
  PetscFunctionReturn(PETSC_SUCCESS);
}

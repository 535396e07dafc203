/* prolong.c -- from the nodes of one level to those of the next finer one.

   A fine vertex is the middle of the point it comes from: a vertex, an edge or a quad. So its value is the mean over
   the vertices of that point, which reproduces linear functions exactly (bilinear ones too, on the reference cell). */
#include "room.h"
#include <mortise/compat.h>

/* Global coarse nodes of the point that a fine vertex comes from. [out] nodes - sorted [ELEMENT_MAX_NODES] */
static PetscErrorCode ProlongationGetNodes_Private(const Level *coarse, DMPlexTransform transform, PetscInt vertex,
                                                   PetscInt *num, PetscInt nodes[])
{
  PetscInt       point, replica, cell_begin, vertex_begin, num_cells = coarse->num_cells;
  DMPolytopeType type, fine_type;

  PetscFunctionBeginUser;
  PetscCall(DMPlexTransformGetSourcePoint(transform, vertex, &type, &fine_type, &point, &replica));
  PetscCall(DMPlexGetHeightStratum(coarse->dm, 0, &cell_begin, NULL));
  PetscCall(DMPlexGetDepthStratum(coarse->dm, 0, &vertex_begin, NULL));
  if (point >= cell_begin && point < cell_begin + num_cells) {
    const PetscInt *start = &coarse->cell_start[point - cell_begin];

    *num = start[1] - start[0];
    for (PetscInt i = 0; i < *num; ++i) nodes[i] = coarse->node_global[coarse->cell_nodes[start[0] + i]];
  } else if (type == DM_POLYTOPE_POINT) {
    *num     = 1;
    nodes[0] = coarse->node_global[coarse->vertex_node[point - vertex_begin]];
  } else {
    const PetscInt *ends;

    PetscCall(DMPlexGetCone(coarse->dm, point, &ends));
    PetscCall(DMPlexGetConeSize(coarse->dm, point, num));
    for (PetscInt i = 0; i < *num; ++i) nodes[i] = coarse->node_global[coarse->vertex_node[ends[i] - vertex_begin]];
  }
  PetscCall(PetscSortInt(*num, nodes)); // the weights are all alike, so order is free: Mats want columns to ascend
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Row by row, straight into compressed rows: at most as many entries as a cell has corners. */
PetscErrorCode LevelCreateProlongation(const Level *coarse, DMPlexTransform transform, Level *fine)
{
  PetscInt     begin, end, *start, *columns, *vertex; /* vertex of each owned node */
  PetscScalar *values;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetDepthStratum(fine->dm, 0, &begin, &end));
  PetscCall(PetscMalloc4(fine->num_owned + 1, &start, fine->num_owned * ELEMENT_MAX_NODES, &columns,
                         fine->num_owned * ELEMENT_MAX_NODES, &values, fine->num_owned, &vertex));
  for (PetscInt v = begin; v < end; ++v) {
    if (fine->vertex_node[v - begin] < fine->num_owned) vertex[fine->vertex_node[v - begin]] = v;
  }
  start[0] = 0;
  for (PetscInt i = 0; i < fine->num_owned; ++i) {
    PetscInt num;

    PetscCall(ProlongationGetNodes_Private(coarse, transform, vertex[i], &num, &columns[start[i]]));
    for (PetscInt j = 0; j < num; ++j) values[start[i] + j] = 1.0 / num;
    start[i + 1] = start[i] + num;
  }
  PetscCall(MatCreate(fine->comm, &fine->prolongation));
  PetscCall(MatSetSizes(fine->prolongation, fine->num_owned, coarse->num_owned, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetType(fine->prolongation, MATAIJ));
  PetscCall(MatSeqAIJSetPreallocationCSR(fine->prolongation, start, columns, values)); // one of the two does nothing
  PetscCall(MatMPIAIJSetPreallocationCSR(fine->prolongation, start, columns, values));
  PetscCall(PetscFree4(start, columns, values, vertex));
  PetscFunctionReturn(PETSC_SUCCESS);
}

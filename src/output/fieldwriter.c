/* fieldwriter.c -- transfer of points, cells and one quantity at a time to the first rank, and from there to a format.

   One file of one writer is simple, portable and fast enough up to tens of millions of values; global nodes are numbered
   rank by rank, so gathering in the order of the ranks gives the global order. */
#include "output/fieldwriter.h"
#include "base/compat.h"
#include <errno.h>

PetscErrorCode FieldWriterOpen(MPI_Comm comm, const FieldFormat *format, FieldWriter *writer)
{
  char path[PETSC_MAX_PATH_LEN];

  PetscFunctionBeginUser;
  writer->comm   = comm;
  writer->format = format;
  PetscCallMPI(MPI_Comm_rank(comm, &writer->rank));
  if (writer->rank) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscSNPrintf(path, sizeof(path), "%s%s", writer->base, format->suffix));
  if (!writer->series || writer->series->num == 1 || !format->grows) {
    PetscCall(FileSetOpen(writer->files, path, &writer->out));
  } else {
    writer->out = fopen(path, "r+b");
    if (!writer->out) PetscCall(FileSetFail(writer->files, path, errno));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FieldWriterClose(FieldWriter *writer)
{
  PetscFunctionBeginUser;
  if (writer->rank == 0) PetscCall(writer->format->end(writer));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Values of all points on the first rank, NULL elsewhere. [in] nodes - which of mine they have, or NULL; [out] spare - what is to be freed */
static PetscErrorCode FieldWriterGatherPoints_Private(const FieldWriter *writer, const PetscInt nodes[], PetscInt from,
                                                      PetscInt to, const PetscReal mine[], const PetscReal **all,
                                                      PetscReal **spare)
{
  PetscReal  *padded = NULL, *gathered = NULL;
  PetscMPIInt ranks;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(writer->comm, &ranks));
  if (nodes || from != to) {
    PetscCall(PetscCalloc1(writer->num_mine * to, &padded));
    for (PetscInt i = 0; i < writer->num_mine; i++) {
      const PetscInt node = nodes ? nodes[i] : i;

      for (PetscInt k = 0; k < PetscMin(from, to); k++) padded[i * to + k] = mine[node * from + k];
    }
    mine = padded;
  }
  if (ranks > 1) {
    PetscCall(GatherArraysReal(writer->comm, writer->num_mine * to, mine, NULL, &gathered));
    PetscCall(PetscFree(padded));
  }
  *all   = ranks > 1 ? gathered : mine;
  *spare = ranks > 1 ? gathered : padded;
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode FieldWriterAdd_Private(FieldWriter *writer, Quantity quantity, const PetscInt nodes[],
                                             PetscInt stride, const PetscReal mine[])
{
  const PetscReal *all;
  PetscReal       *spare;

  PetscFunctionBeginUser;
  PetscCall(FieldWriterGatherPoints_Private(writer, nodes, stride, quantity.components, mine, &all, &spare));
  if (writer->out) PetscCall(writer->format->point(writer, &quantity, all));
  writer->point[writer->num_point_quantities++] = quantity;
  PetscCall(PetscFree(spare));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FieldWriterPoints(FieldWriter *writer, Quantity quantity, PetscInt stride, const PetscReal mine[])
{
  PetscFunctionBeginUser;
  PetscCall(FieldWriterAdd_Private(writer, quantity, writer->nodes, stride, mine));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FieldWriterPointValues(FieldWriter *writer, Quantity quantity, const PetscReal mine[])
{
  PetscFunctionBeginUser;
  PetscCall(FieldWriterAdd_Private(writer, quantity, NULL, quantity.components, mine));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FieldWriterCells(FieldWriter *writer, Quantity quantity, const PetscReal all[])
{
  PetscFunctionBeginUser;
  if (writer->out) PetscCall(writer->format->cell(writer, &quantity, all));
  writer->cell[writer->num_cell_quantities++] = quantity;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Nodes of one cell in the order of viewers: that of element.h, but for the middles of facets of hex27. */
static void FieldWriterGetVTKOrder_Private(ElementType type, const PetscInt nodes[], PetscInt ordered[])
{
  /* left, right, front, back, below, above among below, above, front, right, back, left */
  static const PetscInt facet[6] = {5, 3, 2, 4, 0, 1};
  const PetscInt        size = ElementNumNodes(type), first = type == ELEMENT_HEX27 ? size - 7 : size;

  for (PetscInt i = 0; i < size; i++) ordered[i] = nodes[i >= first && i < size - 1 ? first + facet[i - first] : i];
}

/* Gathers and sorts, by counting. [out] cells, tags - on the first rank, empty elsewhere; owned by the caller */
static PetscErrorCode FieldWriterGatherCells_Private(MPI_Comm comm, const FieldMesh *part, SortedCells *cells,
                                                     PetscReal **tags)
{
  PetscInt *all_nodes, *all_types, *all_tags, *starts, num_cells, num_entries, size = 0, n = 0;

  PetscFunctionBeginUser;
  for (PetscInt c = 0; c < part->num_cells; c++) size += ElementNumNodes((ElementType)part->cell_type[c]);
  PetscCall(GatherArraysInt(comm, size, part->cell_nodes, &num_entries, &all_nodes));
  PetscCall(GatherArraysInt(comm, part->num_cells, part->cell_type, &num_cells, &all_types));
  PetscCall(GatherArraysInt(comm, part->num_cells, part->cell_tag, NULL, &all_tags));
  cells->num = num_cells;
  PetscCall(PetscMalloc3(num_cells + 1, &cells->start, num_entries, &cells->nodes, num_cells, &cells->type));
  PetscCall(PetscMalloc1(num_cells, tags));
  PetscCall(PetscMalloc1(num_cells + 1, &starts));
  starts[0] = cells->start[0] = 0;
  for (PetscInt c = 0; c < num_cells; c++) starts[c + 1] = starts[c] + ElementNumNodes((ElementType)all_types[c]);
  for (PetscInt type = 0; type < ELEMENT_COUNT; type++) { /* stable */
    for (PetscInt c = 0; c < num_cells; c++) {
      if (all_types[c] != type) continue;
      FieldWriterGetVTKOrder_Private((ElementType)type, &all_nodes[starts[c]], &cells->nodes[cells->start[n]]);
      cells->start[n + 1] = cells->start[n] + starts[c + 1] - starts[c];
      cells->type[n]      = type;
      (*tags)[n++]        = (PetscReal)all_tags[c];
    }
  }
  PetscCall(PetscFree(starts));
  PetscCall(PetscFree(all_nodes));
  PetscCall(PetscFree(all_types));
  PetscCall(PetscFree(all_tags));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Global nodes of cells become positions among the points, where some nodes are none. */
static PetscErrorCode FieldWriterNumberByPoints_Private(const FieldWriter *writer, const FieldMesh *part,
                                                        SortedCells *cells)
{
  PetscInt *ids, *all_ids, num;
  PetscBool some = (PetscBool)(part->global != NULL);

  PetscFunctionBeginUser;
  PetscCallMPI(
      MPI_Allreduce(MPI_IN_PLACE, &some, 1, MPIU_BOOL, MPI_LOR, writer->comm)); // NULL as well on a rank without nodes
  if (!some) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(part->num_points, &ids));
  for (PetscInt i = 0; i < part->num_points; i++) ids[i] = part->global[part->nodes[i]];
  PetscCall(GatherArraysInt(writer->comm, part->num_points, ids, &num, &all_ids));
  for (PetscInt i = 0; i < cells->start[cells->num]; i++)
    PetscCall(PetscFindInt(cells->nodes[i], num, all_ids, &cells->nodes[i]));
  PetscCall(PetscFree(all_ids));
  PetscCall(PetscFree(ids));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FieldWriterMesh(FieldWriter *writer, const FieldMesh *part, PetscReal **tags)
{
  PetscInt         sums[2] = {part->num_points, part->num_cells};
  SortedCells      cells;
  const PetscReal *positions;
  PetscReal       *spare;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPIU_INT, MPI_SUM, writer->comm));
  writer->num_points = sums[0];
  writer->num_cells  = sums[1];
  writer->num_mine   = part->num_points;
  writer->nodes      = part->nodes;
  if (writer->out) PetscCall(writer->format->begin(writer));
  PetscCall(FieldWriterGatherPoints_Private(writer, part->nodes, part->dim, 3, part->coords, &positions, &spare));
  if (writer->out) PetscCall(writer->format->points(writer, positions));
  PetscCall(PetscFree(spare));
  PetscCall(FieldWriterGatherCells_Private(writer->comm, part, &cells, tags));
  PetscCall(FieldWriterNumberByPoints_Private(writer, part, &cells));
  if (writer->out) PetscCall(writer->format->cells(writer, &cells));
  PetscCall(PetscFree3(cells.start, cells.nodes, cells.type));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* fieldwriter.c -- brings points, cells and one quantity after the other to the first rank, which hands them on to a format.

   One file of one writer is simple, portable and fast enough up to tens of millions of values; global nodes are numbered
   rank by rank, so gathering in the order of the ranks gives the global order. */
#include "output/fieldwriter.h"
#include "base/compat.h"

PetscErrorCode PictureOpen(MPI_Comm comm, const PictureFormat *format, Picture *picture)
{
  char path[PETSC_MAX_PATH_LEN];

  PetscFunctionBeginUser;
  picture->comm   = comm;
  picture->format = format;
  PetscCallMPI(MPI_Comm_rank(comm, &picture->rank));
  if (picture->rank) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscSNPrintf(path, sizeof(path), "%s%s", picture->base, format->suffix));
  PetscCall(FilesOpen(picture->files, path, &picture->out));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PictureClose(Picture *picture)
{
  PetscFunctionBeginUser;
  if (picture->rank == 0) PetscCall(picture->format->end(picture));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Values of all points on the first rank, NULL elsewhere. [out] spare - what is to be freed */
static PetscErrorCode GatherPoints_Private(const Picture *picture, PetscInt from, PetscInt to, const PetscReal mine[],
                                           const PetscReal **all, PetscReal **spare)
{
  PetscReal  *padded = NULL, *gathered = NULL;
  PetscMPIInt ranks;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(picture->comm, &ranks));
  if (picture->nodes || from != to) {
    PetscCall(PetscCalloc1(picture->num_mine * to, &padded));
    for (PetscInt i = 0; i < picture->num_mine; ++i) {
      const PetscInt node = picture->nodes ? picture->nodes[i] : i;

      for (PetscInt k = 0; k < PetscMin(from, to); ++k) padded[i * to + k] = mine[node * from + k];
    }
    mine = padded;
  }
  if (ranks > 1) {
    PetscCall(GatherReals(picture->comm, picture->num_mine * to, mine, NULL, &gathered));
    PetscCall(PetscFree(padded));
  }
  *all   = ranks > 1 ? gathered : mine;
  *spare = ranks > 1 ? gathered : padded;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PicturePoints(Picture *picture, Quantity quantity, PetscInt stride, const PetscReal mine[])
{
  const PetscReal *all;
  PetscReal       *spare;

  PetscFunctionBeginUser;
  PetscCall(GatherPoints_Private(picture, stride, quantity.components, mine, &all, &spare));
  if (picture->out) PetscCall(picture->format->point(picture, &quantity, all));
  picture->point[picture->num_point_quantities++] = quantity;
  PetscCall(PetscFree(spare));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PictureCells(Picture *picture, Quantity quantity, const PetscReal all[])
{
  PetscFunctionBeginUser;
  if (picture->out) PetscCall(picture->format->cell(picture, &quantity, all));
  picture->cell[picture->num_cell_quantities++] = quantity;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Nodes of one cell in the order of viewers: that of element.h, but for the middles of facets of hex27. */
static void ViewerOrder_Private(ElementType type, const PetscInt nodes[], PetscInt ordered[])
{
  /* left, right, front, back, below, above among below, above, front, right, back, left */
  static const PetscInt facet[6] = {5, 3, 2, 4, 0, 1};
  const PetscInt        size = ElementNumNodes(type), first = type == ELEMENT_HEX27 ? size - 7 : size;

  for (PetscInt i = 0; i < size; ++i) ordered[i] = nodes[i >= first && i < size - 1 ? first + facet[i - first] : i];
}

/* Gathers and sorts, by counting. [out] cells, tags - on the first rank, empty elsewhere; owned by the caller */
static PetscErrorCode GatherCells_Private(MPI_Comm comm, const PicturePart *part, SortedCells *cells, PetscReal **tags)
{
  PetscInt *all_nodes, *all_types, *all_tags, *starts, num_cells, num_entries, size = 0, n = 0;

  PetscFunctionBeginUser;
  for (PetscInt c = 0; c < part->num_cells; ++c) size += ElementNumNodes((ElementType)part->cell_type[c]);
  PetscCall(GatherInts(comm, size, part->cell_nodes, &num_entries, &all_nodes));
  PetscCall(GatherInts(comm, part->num_cells, part->cell_type, &num_cells, &all_types));
  PetscCall(GatherInts(comm, part->num_cells, part->cell_tag, NULL, &all_tags));
  cells->num = num_cells;
  PetscCall(PetscMalloc3(num_cells + 1, &cells->start, num_entries, &cells->nodes, num_cells, &cells->type));
  PetscCall(PetscMalloc1(num_cells, tags));
  PetscCall(PetscMalloc1(num_cells + 1, &starts));
  starts[0] = cells->start[0] = 0;
  for (PetscInt c = 0; c < num_cells; ++c) starts[c + 1] = starts[c] + ElementNumNodes((ElementType)all_types[c]);
  for (PetscInt type = 0; type < ELEMENT_COUNT; ++type) { /* stable */
    for (PetscInt c = 0; c < num_cells; ++c) {
      if (all_types[c] != type) continue;
      ViewerOrder_Private((ElementType)type, &all_nodes[starts[c]], &cells->nodes[cells->start[n]]);
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
static PetscErrorCode NumberByPoints_Private(const Picture *picture, const PicturePart *part, SortedCells *cells)
{
  PetscInt *ids, *all_ids, num;
  PetscBool some = (PetscBool)(part->global != NULL);

  PetscFunctionBeginUser;
  PetscCallMPI(
      MPI_Allreduce(MPI_IN_PLACE, &some, 1, MPIU_BOOL, MPI_LOR, picture->comm)); // NULL as well on a rank without nodes
  if (!some) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(part->num_points, &ids));
  for (PetscInt i = 0; i < part->num_points; ++i) ids[i] = part->global[part->nodes[i]];
  PetscCall(GatherInts(picture->comm, part->num_points, ids, &num, &all_ids));
  for (PetscInt i = 0; i < cells->start[cells->num]; ++i)
    PetscCall(PetscFindInt(cells->nodes[i], num, all_ids, &cells->nodes[i]));
  PetscCall(PetscFree(all_ids));
  PetscCall(PetscFree(ids));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PictureMesh(Picture *picture, const PicturePart *part, PetscReal **tags)
{
  PetscInt         sums[2] = {part->num_points, part->num_cells};
  SortedCells      cells;
  const PetscReal *positions;
  PetscReal       *spare;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPIU_INT, MPI_SUM, picture->comm));
  picture->num_points = sums[0];
  picture->num_cells  = sums[1];
  picture->num_mine   = part->num_points;
  picture->nodes      = part->nodes;
  if (picture->out) PetscCall(picture->format->begin(picture));
  PetscCall(GatherPoints_Private(picture, part->dim, 3, part->coords, &positions, &spare));
  if (picture->out) PetscCall(picture->format->points(picture, positions));
  PetscCall(PetscFree(spare));
  PetscCall(GatherCells_Private(picture->comm, part, &cells, tags));
  PetscCall(NumberByPoints_Private(picture, part, &cells));
  if (picture->out) PetscCall(picture->format->cells(picture, &cells));
  PetscCall(PetscFree3(cells.start, cells.nodes, cells.type));
  PetscFunctionReturn(PETSC_SUCCESS);
}

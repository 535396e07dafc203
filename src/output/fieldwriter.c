/* fieldwriter.c -- points, cells and quantities, one at a time, in the order of the file, for all formats.

   Global nodes are numbered rank by rank. So each rank has one contiguous piece of each quantity of points,
   and one piece for each type of cell. */
#include "output/fieldwriter.h"
#include "base/compat.h"
#include "level/ghosted.h"
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
  PetscCall(writer->format->end(writer));
  PetscCall(PetscFree(writer->order));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Numbers rows by type. Collective. [in] mine - rows of this rank [ELEMENT_COUNT] */
static PetscErrorCode FieldRowsCreate_Private(MPI_Comm comm, const PetscInt mine[], FieldRows *rows)
{
  PetscInt before[ELEMENT_COUNT] = {0}, all[ELEMENT_COUNT];

  PetscFunctionBeginUser;
  *rows = (FieldRows){.num = 0};
  PetscCallMPI(MPI_Exscan(mine, before, ELEMENT_COUNT, MPIU_INT, MPI_SUM, comm));
  PetscCallMPI(MPI_Allreduce(mine, all, ELEMENT_COUNT, MPIU_INT, MPI_SUM, comm));
  for (PetscInt type = 0; type < ELEMENT_COUNT; type++) {
    if (!all[type]) continue;
    rows->block[rows->num].type    = (ElementType)type;
    rows->block[rows->num].all     = all[type];
    rows->block[rows->num].mine    = mine[type];
    rows->block[rows->num++].begin = rows->total + before[type];
    rows->total += all[type];
    rows->num_mine += mine[type];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Values of this rank's points. [out] padded - to be freed, NULL where mine has them as they are */
static PetscErrorCode FieldWriterPad_Private(const FieldWriter *writer, PetscInt from, PetscInt to,
                                             const PetscReal mine[], PetscReal **padded)
{
  PetscFunctionBeginUser;
  *padded = NULL;
  if (!writer->nodes && from == to) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscCalloc1(writer->points.num_mine * to, padded));
  for (PetscInt i = 0; i < writer->points.num_mine; i++) {
    const PetscInt node = writer->nodes ? writer->nodes[i] : i;

    for (PetscInt k = 0; k < PetscMin(from, to); k++) (*padded)[i * to + k] = mine[node * from + k];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FieldWriterPointValues(FieldWriter *writer, Quantity quantity, const PetscReal mine[])
{
  PetscFunctionBeginUser;
  PetscCall(writer->format->point(writer, &quantity, mine));
  writer->point[writer->num_point_quantities++] = quantity;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FieldWriterPoints(FieldWriter *writer, Quantity quantity, PetscInt stride, const PetscReal mine[])
{
  PetscReal *padded;

  PetscFunctionBeginUser;
  PetscCall(FieldWriterPad_Private(writer, stride, quantity.components, mine, &padded));
  PetscCall(FieldWriterPointValues(writer, quantity, padded ? padded : mine));
  PetscCall(PetscFree(padded));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FieldWriterCells(FieldWriter *writer, Quantity quantity, const PetscReal mine[])
{
  PetscReal *sorted;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(writer->cells.num_mine, &sorted));
  for (PetscInt c = 0; c < writer->cells.num_mine; c++) sorted[c] = mine[writer->order[c]];
  PetscCall(writer->format->cell(writer, &quantity, sorted));
  writer->cell[writer->num_cell_quantities++] = quantity;
  PetscCall(PetscFree(sorted));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Nodes of one cell in the order of viewers: that of element.h, except for the middles of facets of hex27. */
static void FieldWriterGetVTKOrder_Private(ElementType type, const PetscInt nodes[], PetscInt ordered[])
{
  /* left, right, front, back, below, above among below, above, front, right, back, left */
  static const PetscInt facet[6] = {5, 3, 2, 4, 0, 1};
  const PetscInt        size = ElementNumNodes(type), first = type == ELEMENT_HEX27 ? size - 7 : size;

  for (PetscInt i = 0; i < size; i++) ordered[i] = nodes[i >= first && i < size - 1 ? first + facet[i - first] : i];
}

/* Sorts by counting. [out] cells, order - owned by the caller */
static PetscErrorCode FieldWriterSortCells_Private(const FieldMesh *part, const FieldRows *rows, SortedCells *cells,
                                                   PetscInt **order)
{
  PetscInt fill[ELEMENT_COUNT] = {0}, entries[ELEMENT_COUNT] = {0}, size = 0, at = 0;

  PetscFunctionBeginUser;
  for (PetscInt b = 0, row = 0; b < rows->num; b++) {
    const ElementType type = rows->block[b].type;

    fill[type]    = row;
    entries[type] = size;
    row += rows->block[b].mine;
    size += rows->block[b].mine * ElementNumNodes(type);
  }
  PetscCall(PetscMalloc2(part->num_cells + 1, &cells->start, size, &cells->nodes));
  PetscCall(PetscMalloc1(part->num_cells, order));
  for (PetscInt c = 0; c < part->num_cells; c++) {
    const ElementType type = (ElementType)part->cell_type[c];
    const PetscInt    row  = fill[type]++;

    FieldWriterGetVTKOrder_Private(type, &part->cell_nodes[at], &cells->nodes[entries[type]]);
    cells->start[row] = entries[type];
    (*order)[row]     = c;
    at += ElementNumNodes(type);
    entries[type] += ElementNumNodes(type);
  }
  cells->start[part->num_cells] = size;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FieldWriterNumberPoints(Level *level, const PetscInt start[], PetscInt first[])
{
  const PetscScalar *value;
  PetscScalar       *set;
  PetscInt           begin = 0;
  Vec                numbers;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Exscan(&start[level->num_owned], &begin, 1, MPIU_INT, MPI_SUM, level->comm));
  PetscCall(LevelCreateVec(level, 1, &numbers));
  PetscCall(VecGetArray(numbers, &set));
  for (PetscInt a = 0; a < level->num_owned; a++) set[a] = (PetscReal)(begin + start[a]);
  PetscCall(VecRestoreArray(numbers, &set));
  PetscCall(LevelShareVec(numbers, INSERT_VALUES));
  PetscCall(GhostedGetArrayRead(numbers, &value));
  for (PetscInt n = 0; n < level->num_nodes; n++) first[n] = (PetscInt)PetscRealPart(value[n]);
  PetscCall(GhostedRestoreArrayRead(numbers, &value));
  PetscCall(VecDestroy(&numbers));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FieldWriterMesh(FieldWriter *writer, const FieldMesh *part)
{
  PetscInt    mine[ELEMENT_COUNT] = {part->num_points};
  SortedCells cells;
  PetscReal  *padded;

  PetscFunctionBeginUser;
  PetscCall(FieldRowsCreate_Private(writer->comm, mine, &writer->points));
  mine[0] = 0;
  for (PetscInt c = 0; c < part->num_cells; c++) mine[part->cell_type[c]]++;
  PetscCall(FieldRowsCreate_Private(writer->comm, mine, &writer->cells));
  writer->nodes = part->nodes;
  PetscCall(writer->format->begin(writer));
  PetscCall(FieldWriterPad_Private(writer, part->dim, 3, part->coords, &padded));
  PetscCall(writer->format->points(writer, padded ? padded : part->coords));
  PetscCall(PetscFree(padded));
  PetscCall(FieldWriterSortCells_Private(part, &writer->cells, &cells, &writer->order));
  PetscCall(writer->format->cells(writer, &cells));
  PetscCall(PetscFree2(cells.start, cells.nodes));
  PetscFunctionReturn(PETSC_SUCCESS);
}

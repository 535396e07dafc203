/* vtu.c -- fields as one VTK unstructured grid file (XML, inline base64). The first rank writes it: each
   quantity is one text, which ranks cannot write in parts. */
#include <stdint.h>
#include <string.h>
#include "output/fieldwriter.h"
#include "output/xml.h"
#include "result/gatherarrays.h"
#include "base/compat.h"

/* VTK's number of a cell (vtkCellType.h); its order of nodes is that of the field writer. */
static const uint8_t vtk_number[ELEMENT_COUNT] = {
    [ELEMENT_LINE2] = 3, [ELEMENT_LINE3] = 21, [ELEMENT_TRI3] = 5,   [ELEMENT_QUAD4] = 9,  [ELEMENT_TET4] = 10,
    [ELEMENT_HEX8] = 12, [ELEMENT_TRI6] = 22,  [ELEMENT_QUAD9] = 28, [ELEMENT_TET10] = 24, [ELEMENT_HEX27] = 29};

/* A block: its length in bytes, then the bytes, encoded as one unit. */
static PetscErrorCode VTUWriteBlock_Private(FILE *out, const char type[], const char name[], PetscInt components,
                                            size_t size, const void *values)
{
  const uint64_t length = size;
  char          *unit;

  PetscFunctionBeginUser;
  fprintf(out, "<DataArray type=\"%s\" Name=\"%s\"", type, name);
  if (components > 1) fprintf(out, " NumberOfComponents=\"%" PetscInt_FMT "\"", components);
  fprintf(out, " format=\"binary\">\n");
  PetscCall(PetscMalloc1(sizeof(length) + size, &unit));
  memcpy(unit, &length, sizeof(length));
  if (size) memcpy(unit + sizeof(length), values, size);
  XMLWriteBase64(out, sizeof(length) + size, unit);
  PetscCall(PetscFree(unit));
  fprintf(out, "\n</DataArray>\n");
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Rows of all ranks in the order of the file, on the first rank. [in] columns - of each block; [out] all -
   owned by the caller, NULL on other ranks */
static PetscErrorCode VTUGather_Private(MPI_Comm comm, const FieldRows *rows, const PetscInt columns[],
                                        const PetscReal mine[], PetscReal **all)
{
  PetscMPIInt rank;
  size_t      size = 0, at = 0;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  for (PetscInt b = 0; b < rows->num; b++) size += (size_t)(rows->block[b].all * columns[b]);
  *all = NULL;
  if (!rank) PetscCall(PetscMalloc1(size, all));
  for (PetscInt b = 0; b < rows->num; b++) {
    PetscReal *block;
    PetscInt   num;

    PetscCall(GatherArraysReal(comm, rows->block[b].mine * columns[b], mine, &num, &block));
    if (!rank) PetscCall(PetscArraycpy(&(*all)[at], block, num));
    PetscCall(PetscFree(block));
    mine += rows->block[b].mine * columns[b];
    at += (size_t)num;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode VTUWriteArray_Private(FieldWriter *writer, const FieldRows *rows, const Quantity *quantity,
                                            const PetscReal mine[])
{
  const PetscInt n = rows->total * quantity->components;
  PetscInt       columns[ELEMENT_COUNT];
  PetscReal     *values;

  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < rows->num; b++) columns[b] = quantity->components;
  PetscCall(VTUGather_Private(writer->comm, rows, columns, mine, &values));
  if (writer->out && quantity->integer) {
    int32_t *whole;

    PetscCall(PetscMalloc1(n, &whole));
    for (PetscInt i = 0; i < n; i++) whole[i] = (int32_t)values[i];
    PetscCall(
        VTUWriteBlock_Private(writer->out, "Int32", quantity->name, quantity->components, n * sizeof(int32_t), whole));
    PetscCall(PetscFree(whole));
  } else if (writer->out) {
    PetscCall(VTUWriteBlock_Private(writer->out, "Float64", quantity->name, quantity->components, n * sizeof(double),
                                    values));
  }
  PetscCall(PetscFree(values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Names of bodies in the order of `body`: VTK has texts as the codes of their characters, each ended by 0. */
static void VTUWriteBodies_Private(const FieldWriter *writer)
{
  int num = 1;

  for (const char *c = writer->bodies; *c; c++) num += *c == ',';
  fprintf(writer->out,
          "<FieldData>\n<DataArray type=\"String\" Name=\"bodies\" NumberOfTuples=\"%d\" format=\"ascii\">\n", num);
  for (const char *c = writer->bodies; *c; c++) fprintf(writer->out, "%d ", *c == ',' ? 0 : (int)*c);
  fprintf(writer->out, "0\n</DataArray>\n</FieldData>\n");
}

static PetscErrorCode VTUBegin_Private(FieldWriter *writer)
{
  const uint16_t order = 1; /* its first byte depends on the machine's byte order */

  PetscFunctionBeginUser;
  if (!writer->out) PetscFunctionReturn(PETSC_SUCCESS);
  fprintf(writer->out,
          "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"%s\" "
          "header_type=\"UInt64\">\n<UnstructuredGrid>\n",
          *(const unsigned char *)&order ? "LittleEndian" : "BigEndian");
  VTUWriteBodies_Private(writer);
  fprintf(writer->out, "<Piece NumberOfPoints=\"%" PetscInt_FMT "\" NumberOfCells=\"%" PetscInt_FMT "\">\n",
          writer->points.total, writer->cells.total);
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode VTUPoints_Private(FieldWriter *writer, const PetscReal positions[])
{
  PetscFunctionBeginUser;
  if (writer->out) fprintf(writer->out, "<Points>\n");
  PetscCall(VTUWriteArray_Private(writer, &writer->points, &(Quantity){"points", 3, PETSC_FALSE}, positions));
  if (writer->out) fprintf(writer->out, "</Points>\n");
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Cells of all ranks. [in] nodes - cell after cell [sum of nodes] */
static PetscErrorCode VTUWriteCells_Private(const FieldWriter *writer, PetscInt num_entries, const PetscReal nodes[])
{
  const FieldRows *rows = &writer->cells;
  int64_t         *points, *ends;
  uint8_t         *types;
  PetscInt         c = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(num_entries, &points, rows->total, &ends, rows->total, &types));
  for (PetscInt i = 0; i < num_entries; i++) points[i] = (int64_t)nodes[i];
  for (PetscInt b = 0; b < rows->num; b++) {
    for (PetscInt i = 0; i < rows->block[b].all; i++, c++) {
      ends[c]  = (c ? ends[c - 1] : 0) + ElementNumNodes(rows->block[b].type);
      types[c] = vtk_number[rows->block[b].type];
    }
  }
  fprintf(writer->out, "<Cells>\n");
  PetscCall(VTUWriteBlock_Private(writer->out, "Int64", "connectivity", 1, num_entries * sizeof(int64_t), points));
  PetscCall(VTUWriteBlock_Private(writer->out, "Int64", "offsets", 1, rows->total * sizeof(int64_t), ends));
  PetscCall(VTUWriteBlock_Private(writer->out, "UInt8", "types", 1, rows->total, types));
  fprintf(writer->out, "</Cells>\n");
  PetscCall(PetscFree3(points, ends, types));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode VTUCells_Private(FieldWriter *writer, const SortedCells *cells)
{
  const FieldRows *rows     = &writer->cells;
  const PetscInt   num_mine = cells->start[rows->num_mine];
  PetscInt         columns[ELEMENT_COUNT], num_entries = 0;
  PetscReal       *mine, *all; // whole numbers up to 2^53 are exact

  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < rows->num; b++) {
    columns[b] = ElementNumNodes(rows->block[b].type);
    num_entries += columns[b] * rows->block[b].all;
  }
  PetscCall(PetscMalloc1(num_mine, &mine));
  for (PetscInt i = 0; i < num_mine; i++) mine[i] = (PetscReal)cells->nodes[i];
  PetscCall(VTUGather_Private(writer->comm, rows, columns, mine, &all));
  if (writer->out) PetscCall(VTUWriteCells_Private(writer, num_entries, all));
  PetscCall(PetscFree(mine));
  PetscCall(PetscFree(all));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode VTUPoint_Private(FieldWriter *writer, const Quantity *quantity, const PetscReal values[])
{
  PetscFunctionBeginUser;
  if (writer->out && writer->num_point_quantities == 0) fprintf(writer->out, "<PointData %s>\n", writer->first);
  PetscCall(VTUWriteArray_Private(writer, &writer->points, quantity, values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode VTUCell_Private(FieldWriter *writer, const Quantity *quantity, const PetscReal values[])
{
  PetscFunctionBeginUser;
  if (writer->out && writer->num_cell_quantities == 0)
    fprintf(writer->out, "</PointData>\n<CellData Scalars=\"body\">\n");
  PetscCall(VTUWriteArray_Private(writer, &writer->cells, quantity, values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode VTUEnd_Private(FieldWriter *writer)
{
  PetscFunctionBeginUser;
  if (!writer->out) PetscFunctionReturn(PETSC_SUCCESS);
  fprintf(writer->out, "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
  PetscCall(FileSetClose(writer->files, &writer->out));
  PetscFunctionReturn(PETSC_SUCCESS);
}

const FieldFormat field_format_vtu = {.suffix = ".vtu",
                                      .begin  = VTUBegin_Private,
                                      .points = VTUPoints_Private,
                                      .cells  = VTUCells_Private,
                                      .point  = VTUPoint_Private,
                                      .cell   = VTUCell_Private,
                                      .end    = VTUEnd_Private};

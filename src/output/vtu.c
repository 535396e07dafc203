/* vtu.c -- fields as one VTK unstructured grid file (XML, inline base64). */
#include <stdint.h>
#include <string.h>
#include "output/fieldwriter.h"
#include "output/xml.h"
#include "base/compat.h"

/* VTK's number of a cell (vtkCellType.h); its order of nodes is that of the picture. */
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

static PetscErrorCode VTUWriteArray_Private(FILE *out, PetscInt rows, const Quantity *quantity,
                                            const PetscReal values[])
{
  const PetscInt n = rows * quantity->components;

  PetscFunctionBeginUser;
  if (quantity->integer) {
    int32_t *whole;

    PetscCall(PetscMalloc1(n, &whole));
    for (PetscInt i = 0; i < n; i++) whole[i] = (int32_t)values[i];
    PetscCall(VTUWriteBlock_Private(out, "Int32", quantity->name, quantity->components, n * sizeof(int32_t), whole));
    PetscCall(PetscFree(whole));
  } else {
    PetscCall(VTUWriteBlock_Private(out, "Float64", quantity->name, quantity->components, n * sizeof(double), values));
  }
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
  const uint16_t order = 1; /* its first byte tells the machine's byte order */

  PetscFunctionBeginUser;
  fprintf(writer->out,
          "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"%s\" "
          "header_type=\"UInt64\">\n<UnstructuredGrid>\n",
          *(const unsigned char *)&order ? "LittleEndian" : "BigEndian");
  VTUWriteBodies_Private(writer);
  fprintf(writer->out, "<Piece NumberOfPoints=\"%" PetscInt_FMT "\" NumberOfCells=\"%" PetscInt_FMT "\">\n",
          writer->num_points, writer->num_cells);
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode VTUPoints_Private(FieldWriter *writer, const PetscReal positions[])
{
  PetscFunctionBeginUser;
  fprintf(writer->out, "<Points>\n");
  PetscCall(
      VTUWriteBlock_Private(writer->out, "Float64", "points", 3, writer->num_points * 3 * sizeof(double), positions));
  fprintf(writer->out, "</Points>\n");
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode VTUCells_Private(FieldWriter *writer, const SortedCells *cells)
{
  const PetscInt num_entries = cells->start[cells->num];
  int64_t       *nodes, *ends;
  uint8_t       *types;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(num_entries, &nodes, cells->num, &ends, cells->num, &types));
  for (PetscInt i = 0; i < num_entries; i++) nodes[i] = cells->nodes[i];
  for (PetscInt c = 0; c < cells->num; c++) {
    ends[c]  = cells->start[c + 1];
    types[c] = vtk_number[cells->type[c]];
  }
  fprintf(writer->out, "<Cells>\n");
  PetscCall(VTUWriteBlock_Private(writer->out, "Int64", "connectivity", 1, num_entries * sizeof(int64_t), nodes));
  PetscCall(VTUWriteBlock_Private(writer->out, "Int64", "offsets", 1, cells->num * sizeof(int64_t), ends));
  PetscCall(VTUWriteBlock_Private(writer->out, "UInt8", "types", 1, cells->num, types));
  fprintf(writer->out, "</Cells>\n");
  PetscCall(PetscFree3(nodes, ends, types));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode VTUPoint_Private(FieldWriter *writer, const Quantity *quantity, const PetscReal values[])
{
  PetscFunctionBeginUser;
  if (writer->num_point_quantities == 0) fprintf(writer->out, "<PointData %s>\n", writer->first);
  PetscCall(VTUWriteArray_Private(writer->out, writer->num_points, quantity, values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode VTUCell_Private(FieldWriter *writer, const Quantity *quantity, const PetscReal values[])
{
  PetscFunctionBeginUser;
  if (writer->num_cell_quantities == 0) fprintf(writer->out, "</PointData>\n<CellData Scalars=\"body\">\n");
  PetscCall(VTUWriteArray_Private(writer->out, writer->num_cells, quantity, values));
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

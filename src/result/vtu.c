/* vtu.c -- the picture as one VTK unstructured grid file (XML, inline base64): self-contained, opens everywhere VTK does. */
#include <stdint.h>
#include <string.h>
#include "picture.h"
#include "xml.h"
#include <mortise/compat.h>

/* VTK's number of a cell (vtkCellType.h); its order of nodes is that of the picture. */
static const uint8_t vtk_number[ELEMENT_COUNT] = {
    [ELEMENT_LINE2] = 3, [ELEMENT_LINE3] = 21, [ELEMENT_TRI3] = 5,   [ELEMENT_QUAD4] = 9,  [ELEMENT_TET4] = 10,
    [ELEMENT_HEX8] = 12, [ELEMENT_TRI6] = 22,  [ELEMENT_QUAD9] = 28, [ELEMENT_TET10] = 24, [ELEMENT_HEX27] = 29};

/* A block: its length in bytes, then the bytes, encoded as one unit. */
static PetscErrorCode WriteBlock_Private(FILE *out, const char type[], const char name[], PetscInt components,
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

static PetscErrorCode WriteArray_Private(FILE *out, PetscInt rows, const PictureArray *array)
{
  const PetscInt n = rows * array->components;

  PetscFunctionBeginUser;
  if (array->integer) {
    int32_t *whole;

    PetscCall(PetscMalloc1(n, &whole));
    for (PetscInt i = 0; i < n; ++i) whole[i] = (int32_t)array->values[i];
    PetscCall(WriteBlock_Private(out, "Int32", array->name, array->components, n * sizeof(int32_t), whole));
    PetscCall(PetscFree(whole));
  } else {
    PetscCall(WriteBlock_Private(out, "Float64", array->name, array->components, n * sizeof(double), array->values));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode WriteCells_Private(FILE *out, const Picture *picture)
{
  const PetscInt num_cells = picture->num_cells, num_entries = picture->cell_start[num_cells];
  int64_t       *nodes, *ends;
  uint8_t       *types;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(num_entries, &nodes, num_cells, &ends, num_cells, &types));
  for (PetscInt i = 0; i < num_entries; ++i) nodes[i] = picture->cell_nodes[i];
  for (PetscInt c = 0; c < num_cells; ++c) {
    ends[c]  = picture->cell_start[c + 1];
    types[c] = vtk_number[picture->cell_type[c]];
  }
  fprintf(out, "<Cells>\n");
  PetscCall(WriteBlock_Private(out, "Int64", "connectivity", 1, num_entries * sizeof(int64_t), nodes));
  PetscCall(WriteBlock_Private(out, "Int64", "offsets", 1, num_cells * sizeof(int64_t), ends));
  PetscCall(WriteBlock_Private(out, "UInt8", "types", 1, num_cells, types));
  fprintf(out, "</Cells>\n");
  PetscCall(PetscFree3(nodes, ends, types));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PictureWriteVTU(const Picture *picture, Files *files, const char final[])
{
  const uint16_t order = 1; /* its first byte tells the machine's byte order */
  FILE          *out;

  PetscFunctionBeginUser;
  PetscCall(FilesOpen(files, final, &out));
  if (!out) PetscFunctionReturn(PETSC_SUCCESS);
  fprintf(out,
          "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"%s\" "
          "header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"%" PetscInt_FMT
          "\" NumberOfCells=\"%" PetscInt_FMT "\">\n",
          *(const unsigned char *)&order ? "LittleEndian" : "BigEndian", picture->num_points, picture->num_cells);
  fprintf(out, "<Points>\n");
  PetscCall(WriteBlock_Private(out, "Float64", "points", 3, picture->num_points * 3 * sizeof(double), picture->points));
  fprintf(out, "</Points>\n");
  PetscCall(WriteCells_Private(out, picture));
  fprintf(out, "<PointData %s>\n", picture->first);
  for (PetscInt i = 0; i < picture->num_point_arrays; ++i) {
    PetscCall(WriteArray_Private(out, picture->num_points, &picture->point[i]));
  }
  fprintf(out, "</PointData>\n<CellData Scalars=\"body\">\n");
  for (PetscInt i = 0; i < picture->num_cell_arrays; ++i) {
    PetscCall(WriteArray_Private(out, picture->num_cells, &picture->cell[i]));
  }
  fprintf(out, "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
  PetscCall(FilesClose(files, &out));
  PetscFunctionReturn(PETSC_SUCCESS);
}

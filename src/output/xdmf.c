/* xdmf.c -- the XML file that describes the HDF5 file to viewers.

   Limited to the features that ParaView, VTK and meshio read: one uniform grid, version 3, data items that
   are whole datasets. The file name is relative, so that the two files can be moved together. Reference: the
   XDMF model and format.

   One feature differs: pyvista's reader fails on a grid without a time, and meshio's on a grid with one. So
   the grid is written twice. Readers of XDMF 2 (VTK, hence pyvista and ParaView) follow the Reference of the
   plain grid to its copy with a time. meshio and readers of XDMF 3 ignore this attribute and take the plain
   grid. The copy is in an Information, whose text must be XML for meshio. */
#include <string.h>
#include "output/xdmf.h"
#include "output/xml.h"
#include "base/compat.h"

/* XDMF's name and number of a cell; its order of nodes is that of the field writer. A line of two points is a
   polyline, which needs its number of points; lines are never mixed with other types. */
static const char *const xdmf_name[ELEMENT_COUNT] = {
    [ELEMENT_LINE2] = "Polyline",      [ELEMENT_LINE3] = "Edge_3",    [ELEMENT_TRI3] = "Triangle",
    [ELEMENT_QUAD4] = "Quadrilateral", [ELEMENT_TRI6] = "Triangle_6", [ELEMENT_QUAD9] = "Quadrilateral_9",
    [ELEMENT_TET4] = "Tetrahedron",    [ELEMENT_HEX8] = "Hexahedron", [ELEMENT_TET10] = "Tetrahedron_10",
    [ELEMENT_HEX27] = "Hexahedron_27"};
static const int xdmf_number[ELEMENT_COUNT] = {
    [ELEMENT_TRI3] = 4,   [ELEMENT_QUAD4] = 5, [ELEMENT_TET4] = 6,   [ELEMENT_HEX8] = 9,
    [ELEMENT_QUAD9] = 35, [ELEMENT_TRI6] = 36, [ELEMENT_TET10] = 38, [ELEMENT_HEX27] = 50};

/* Rows of cells as rows of a list of type numbers and nodes. */
static void XDMFListRows_Private(const FieldRows *cells, FieldRows *list)
{
  PetscInt before = 0;

  *list = (FieldRows){.num = cells->num};
  for (PetscInt b = 0; b < cells->num; b++) {
    const PetscInt length = 1 + ElementNumNodes(cells->block[b].type);

    list->block[b] = cells->block[b];
    list->block[b].all *= length;
    list->block[b].mine *= length;
    list->block[b].begin = list->total + (cells->block[b].begin - before) * length;
    list->total += list->block[b].all;
    list->num_mine += list->block[b].mine;
    before += cells->block[b].all;
  }
}

PetscErrorCode XDMFTopologyCreate(const FieldRows *rows, const SortedCells *cells, Topology *topology)
{
  const ElementType first = rows->num ? rows->block[0].type : ELEMENT_TRI3;
  const PetscBool   mixed = (PetscBool)(rows->num > 1);
  PetscInt          n = 0, cell = 0;

  PetscFunctionBeginUser;
  topology->name    = mixed ? "Mixed" : xdmf_name[first];
  topology->columns = mixed ? 1 : ElementNumNodes(first);
  topology->part    = *rows;
  if (mixed) XDMFListRows_Private(rows, &topology->part);
  topology->rows = topology->part.total;
  PetscCall(PetscMalloc1(topology->part.num_mine * topology->columns, &topology->values));
  for (PetscInt b = 0; b < rows->num; b++) {
    for (PetscInt c = 0; c < rows->block[b].mine; c++, cell++) {
      if (mixed) topology->values[n++] = xdmf_number[rows->block[b].type];
      for (PetscInt i = cells->start[cell]; i < cells->start[cell + 1]; i++)
        topology->values[n++] = (int)cells->nodes[i];
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode XDMFTopologyDestroy(Topology *topology)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(topology->values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscInt XDMFTopologyGetNumNodes(int number)
{
  for (PetscInt type = 0; type < ELEMENT_COUNT && number; type++)
    if (xdmf_number[type] == number) return ElementNumNodes((ElementType)type);
  return 0;
}

/* One dataset of the HDF5 file. */
static void XDMFWriteItem_Private(FILE *out, const char hdf5[], const char name[], PetscInt rows, PetscInt columns,
                                  PetscBool integer)
{
  fprintf(out, "<DataItem Format=\"HDF\" NumberType=\"%s\" Precision=\"%d\" Dimensions=\"%" PetscInt_FMT,
          integer ? "Int" : "Float", integer ? 4 : 8, rows);
  if (columns > 1) fprintf(out, " %" PetscInt_FMT, columns);
  fprintf(out, "\">");
  if ((unsigned char)hdf5[0] > 127) fprintf(out, "./"); // VTK's reader loses a file name that begins outside ASCII
  XMLWriteText(out, hdf5);
  fprintf(out, ":/%s</DataItem>\n", name);
}

void XDMFStepName(const FieldSeries *series, PetscInt i, char name[XDMF_STEP_NAME])
{
  snprintf(name, XDMF_STEP_NAME, series ? "steps/%04" PetscInt_FMT "/" : "", i + 1);
}

/* [in] group - with its slash, or "" */
static void XDMFWriteAttribute_Private(FILE *out, const char hdf5[], const char group[], const Quantity *quantity,
                                       PetscInt rows, const char centre[])
{
  const char *type = quantity->components == 1 ? "Scalar" : quantity->components == 3 ? "Vector" : "Tensor";
  char        name[XDMF_STEP_NAME + 32];

  snprintf(name, sizeof(name), "%s%s", group, quantity->name);
  fprintf(out, "      <Attribute Name=\"%s\" AttributeType=\"%s\" Center=\"%s\">\n        ", quantity->name, type,
          centre);
  XDMFWriteItem_Private(out, hdf5, name, rows, quantity->components, quantity->integer);
  fprintf(out, "      </Attribute>\n");
}

/* The items of a grid: points, cells, quantities. [in] group - of the quantities of points */
static void XDMFWriteGridItems_Private(FILE *out, const FieldWriter *writer, const FieldGrid *grid, const char hdf5[],
                                       const char group[])
{
  char place[XDMF_STEP_NAME] = "", name[XDMF_STEP_NAME + 32];

  if (grid->step >= 0) XDMFStepName(writer->series, grid->step, place);
  fprintf(out, "      <Geometry GeometryType=\"XYZ\">\n        ");
  snprintf(name, sizeof(name), "%spoints", place);
  XDMFWriteItem_Private(out, hdf5, name, grid->num_points, 3, PETSC_FALSE);
  fprintf(out,
          "      </Geometry>\n      <Topology TopologyType=\"%s\"%s NumberOfElements=\"%" PetscInt_FMT "\">\n        ",
          grid->topology, grid->topology == xdmf_name[ELEMENT_LINE2] ? " NodesPerElement=\"2\"" : "", grid->num_cells);
  snprintf(name, sizeof(name), "%scells", place);
  XDMFWriteItem_Private(out, hdf5, name, grid->rows, grid->columns, PETSC_TRUE);
  fprintf(out, "      </Topology>\n");
  for (PetscInt i = 0; i < writer->num_point_quantities; i++) {
    XDMFWriteAttribute_Private(out, hdf5, group, &writer->point[i], grid->num_points, "Node");
  }
  for (PetscInt i = 0; i < writer->num_cell_quantities; i++) {
    XDMFWriteAttribute_Private(out, hdf5, place, &writer->cell[i], grid->num_cells, "Cell");
  }
}

/* The grid of fields at one time, written twice. */
static void XDMFWriteSteady_Private(FILE *out, const FieldWriter *writer, const FieldGrid *grid, const char hdf5[],
                                    const char title[])
{
  fprintf(out, "    <Grid Name=\"");
  XMLWriteText(out, title);
  fprintf(out, "\" GridType=\"Uniform\" Reference=\"/Xdmf/Domain/Grid/Information/Grid\">\n");
  XDMFWriteGridItems_Private(out, writer, grid, hdf5, "");
  fprintf(out,
          "      <Information Name=\"steady\" Value=\"the same with a time\">&lt;steady/&gt;\n      <Grid Name=\"");
  XMLWriteText(out, title);
  fprintf(out, "\" GridType=\"Uniform\">\n      <Time Value=\"0\"/>\n");
  XDMFWriteGridItems_Private(out, writer, grid, hdf5, "");
  fprintf(out, "      </Grid>\n      </Information>\n    </Grid>\n");
}

/* One grid for each time. Viewers sort times: where these do not ascend, numbers of steps take their
   place. */
static void XDMFWriteSeries_Private(FILE *out, const FieldWriter *writer, const char hdf5[], const char title[])
{
  const FieldSeries *series = writer->series;
  PetscBool          ascend = PETSC_TRUE;
  char               group[XDMF_STEP_NAME];

  for (PetscInt i = 1; i < series->num; i++) ascend = (PetscBool)(ascend && series->t[i] > series->t[i - 1]);
  fprintf(out, "    <Grid Name=\"");
  XMLWriteText(out, title);
  fprintf(out, "\" GridType=\"Collection\" CollectionType=\"Temporal\">\n");
  for (PetscInt i = 0; i < series->num; i++) {
    const double time = ascend ? (double)series->t[i] : (double)(i + 1);

    fprintf(out, "    <Grid Name=\"t = %.9g\" GridType=\"Uniform\">\n      <Time Value=\"%.17g\"/>\n",
            (double)series->t[i], time);
    XDMFStepName(series, i, group);
    XDMFWriteGridItems_Private(out, writer, &series->grid[i], hdf5, group);
    fprintf(out, "    </Grid>\n");
  }
  fprintf(out, "    </Grid>\n");
}

PetscErrorCode XDMFWrite(const FieldWriter *writer, const Topology *topology, const char hdf5[])
{
  const char *slash = strrchr(hdf5, '/'), *title = writer->title[0] ? writer->title : "mortise";
  char        path[PETSC_MAX_PATH_LEN];
  FILE       *out;
  FieldGrid   grid = {.step       = -1,
                      .num_points = writer->points.total,
                      .num_cells  = writer->cells.total,
                      .rows       = topology->rows,
                      .columns    = topology->columns,
                      .topology   = topology->name};

  PetscFunctionBeginUser;
  if (writer->series) { // all of its grids
    grid.step                                     = writer->series->grid[writer->series->num - 1].step;
    writer->series->grid[writer->series->num - 1] = grid;
  }
  PetscCall(PetscSNPrintf(path, sizeof(path), "%s.xdmf", writer->base));
  PetscCall(FileSetOpen(writer->files, path, &out));
  if (!out) PetscFunctionReturn(PETSC_SUCCESS);
  if (slash) hdf5 = slash + 1;
  fprintf(out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n");
  if (writer->series)
    XDMFWriteSeries_Private(out, writer, hdf5, title);
  else
    XDMFWriteSteady_Private(out, writer, &grid, hdf5, title);
  fprintf(out, "  </Domain>\n</Xdmf>\n");
  PetscCall(FileSetClose(writer->files, &out));
  PetscFunctionReturn(PETSC_SUCCESS);
}

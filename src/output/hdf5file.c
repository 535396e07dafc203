/* hdf5file.c -- fields as contiguous datasets: the first rank makes them, and every rank writes its rows to
   their place in the file.

   HDF5 1.10 crashes after a failed write on a full disk, also with MPI-IO, so its own parallel driver is not
   used. Rows of a rank are one piece of a dataset, or one for each type of cell: collective buffering would
   gain nothing.

   /points [N][3], /cells (see xdmf.c), one dataset per quantity under its own name. Attributes of the file:
   title, names of bodies in the order of `body`, version, units, and a word on every dataset's order.
   Readable by h5py, MATLAB, h5dump without any library of ours.

   Of a series the quantities of points are in groups, /steps/0001 and so on. Each has the attributes t, its
   time, and solved, 1 or 0. Those of the last step have their usual names as well. The attribute before of
   /steps has the times of the steps before a restart. */
#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <hdf5.h>
#include <sys/stat.h>
#include <unistd.h>
#include "output/fieldwriter.h"
#include "output/hdf5driver.h"
#include "output/xdmf.h"
#include "base/compat.h"

/* The file that is being written. */
enum { PLACED = XDMF_STEP_NAME + 32 }; /* length of a dataset's name with its group */

typedef struct {
  HDF5Driver *driver; /* of the first rank; of a file that grows it is kept until its changes are made */
  hid_t       access, file;
  PetscBool   more; /* whether the file grows */
  PetscBool   good; /* false if HDF5 failed, only for lack of memory; failures of files are in driver */
  char        path[PETSC_MAX_PATH_LEN + 64]; /* path of the file while it is written */
  int         descriptor, error; /* of this rank: -1 before its first rows; errno of the first write that failed */
  Topology    topology;
} Image;

/* A text attribute, of variable length so that h5py gives a str; false on failure. */
static PetscBool HDF5FileWriteAttribute_Private(hid_t where, const char name[], const char text[])
{
  const hid_t space = H5Screate(H5S_SCALAR), type = H5Tcopy(H5T_C_S1);
  hid_t       attribute;
  herr_t      bad = H5Tset_size(type, H5T_VARIABLE);

  if (bad >= 0) bad = H5Tset_cset(type, H5T_CSET_UTF8);
  attribute = H5Acreate2(where, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  if (bad >= 0) bad = attribute < 0 ? -1 : H5Awrite(attribute, type, &text);
  if (attribute >= 0) H5Aclose(attribute);
  H5Tclose(type);
  H5Sclose(space);
  return (PetscBool)(bad >= 0);
}

/* An array of shape [rows][columns], [rows] where columns is 1, of int or double. */
typedef struct {
  const char      *name, *about;
  const FieldRows *rows;
  PetscInt         columns;
  PetscBool        integer;
  const void      *values; /* of this rank */
} Dataset;

/* Creates a contiguous dataset. Returns its address in the file, or HADDR_UNDEF on failure. */
static haddr_t HDF5FileCreateDataset_Private(hid_t file, const Dataset *data)
{
  const hsize_t shape[2] = {(hsize_t)data->rows->total, (hsize_t)data->columns};
  const hid_t   space    = H5Screate_simple(data->columns == 1 ? 1 : 2, shape, NULL);
  const hid_t   creation = H5Pcreate(H5P_DATASET_CREATE);
  hid_t         set      = -1;
  haddr_t       at       = HADDR_UNDEF;

  if (H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY) >= 0 && H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER) >= 0)
    set = H5Dcreate2(file, data->name, data->integer ? H5T_NATIVE_INT : H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, creation,
                     H5P_DEFAULT);
  if (set >= 0 && HDF5FileWriteAttribute_Private(set, "about", data->about))
    at = data->rows->total ? H5Dget_offset(set) : 0;
  if (set >= 0 && H5Dclose(set) < 0) at = HADDR_UNDEF;
  H5Pclose(creation);
  H5Sclose(space);
  return at;
}

/* Writes this rank's rows of a dataset. [in] at - where it begins in the file */
static void HDF5FileWriteRows_Private(Image *image, const Dataset *data, haddr_t at)
{
  const size_t row    = (size_t)data->columns * (data->integer ? sizeof(int) : sizeof(double));
  const char  *values = (const char *)data->values;

  if (data->rows->num_mine && image->descriptor < 0 && !image->error) {
    image->descriptor = open(image->path, O_WRONLY);
    if (image->descriptor < 0) image->error = errno;
  }
  for (PetscInt b = 0; b < data->rows->num && !image->error; b++) {
    const size_t size = (size_t)data->rows->block[b].mine * row;

    if (size)
      image->error =
          HDF5DriverWriteBytes(image->descriptor, at + (haddr_t)data->rows->block[b].begin * row, size, values);
    values += size;
  }
}

/* Collective. */
static PetscErrorCode HDF5FileWriteDataset_Private(FieldWriter *writer, const Dataset *data)
{
  Image             *image = (Image *)writer->data;
  unsigned long long at    = HADDR_UNDEF;

  PetscFunctionBeginUser;
  if (image->good && image->file >= 0) {
    at          = HDF5FileCreateDataset_Private(image->file, data);
    image->good = (PetscBool)(at != HADDR_UNDEF && (!data->rows->total || at >= image->driver->size));
    if (!image->good) at = HADDR_UNDEF;
  }
  PetscCallMPI(MPI_Bcast(&at, 1, MPI_UNSIGNED_LONG_LONG, 0, writer->comm));
  if (at != HADDR_UNDEF) HDF5FileWriteRows_Private(image, data, at);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Attributes of a quantity for readers. */
static const char *HDF5FileGetUnit_Private(const char name[])
{
  static const char *const table[][2] = {
      {"points", "positions before the motion: x, y, z"},
      {"displacement", "x, y, z in the unit of length"},
      {"motion", "x, y, z of the rigid motion that loads drive and nothing resists: an angle of 1, else a length of 1"},
      {"stress", "tensor by rows: xx,xy,xz,yx,yy,yz,zx,zy,zz in the unit of stress; volume-weighted nodal average"},
      {"von_mises", "of the averaged stress"},
      {"error_estimate", "root of the squared energy error per volume, estimated in the cells around"},
      {"temperature", "above that without stress; 0 in bodies without one"},
      {"sides", "sum of 2^s over the sides s < 30 of the check, in the order of its summary"},
      {"principal", "principal values of the averaged stress, the largest first"},
      {"pressure", "contact pressure on nonmortar sides, 0 elsewhere"},
      {"gap", "left after the motion, along the nonmortar normal; NAN where there is no constraint"},
      {"normal", "out of the nonmortar body, before the motion; where there is a constraint, its direction"},
      {"status", "0 open, 1 contact, 2 tied, 3 slip, 4 stick, -1 no constraint"},
      {"tangential_traction", "friction that the mortar side exerts on the nonmortar body, in the unit of stress"},
      {"slip", "of the nonmortar side against the mortar side, in this load step; NAN where there is no constraint"},
      {"body", "index of the body, in the order of -bodies"},
      {"region", "0 in no region of the body, else which of -<body>_regions, from 1 on"},
      {"piece", "number of the connected component, over all bodies"}};

  if (strrchr(name, '/')) name = strrchr(name, '/') + 1; // of a step
  for (size_t i = 0; i < sizeof(table) / sizeof(table[0]); i++) {
    if (strcmp(table[i][0], name) == 0) return table[i][1];
  }
  return "";
}

/* This rank's rows of a quantity. Collective. */
static PetscErrorCode HDF5FileWriteQuantity_Private(FieldWriter *writer, const FieldRows *rows,
                                                    const Quantity *quantity, const PetscReal values[])
{
  Dataset data  = {.name    = quantity->name,
                   .about   = HDF5FileGetUnit_Private(quantity->name),
                   .rows    = rows,
                   .columns = quantity->components,
                   .integer = quantity->integer,
                   .values  = values};
  int    *whole = NULL;

  PetscFunctionBeginUser;
  if (quantity->integer) {
    PetscCall(PetscMalloc1(rows->num_mine * quantity->components, &whole));
    for (PetscInt i = 0; i < rows->num_mine * quantity->components; i++) whole[i] = (int)values[i];
    data.values = whole;
  }
  PetscCall(HDF5FileWriteDataset_Private(writer, &data));
  PetscCall(PetscFree(whole));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A number as an attribute; false on failure. */
static PetscBool HDF5FileWriteNumber_Private(hid_t group, const char name[], hid_t type, double number)
{
  const hid_t space     = H5Screate(H5S_SCALAR);
  const hid_t attribute = H5Acreate2(group, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  PetscBool   good      = (PetscBool)(attribute >= 0 && H5Awrite(attribute, H5T_NATIVE_DOUBLE, &number) >= 0);

  if (attribute >= 0) H5Aclose(attribute);
  H5Sclose(space);
  return good;
}

/* Some numbers as an attribute; false on failure. */
static PetscBool HDF5FileWriteNumbers_Private(hid_t group, const char name[], PetscInt num, const PetscReal numbers[])
{
  const hsize_t length    = (hsize_t)num;
  const hid_t   space     = H5Screate_simple(1, &length, NULL);
  const hid_t   attribute = H5Acreate2(group, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT);
  PetscBool     good      = (PetscBool)(attribute >= 0 && H5Awrite(attribute, H5T_NATIVE_DOUBLE, numbers) >= 0);

  if (attribute >= 0) H5Aclose(attribute);
  H5Sclose(space);
  return good;
}

/* The times of the steps before those of the file. */
static PetscBool HDF5FileWritePast_Private(hid_t file, const FieldSeries *series)
{
  const hid_t steps = H5Gopen2(file, "steps", H5P_DEFAULT);
  PetscBool   good  = (PetscBool)(steps >= 0);

  if (good && series->num_past) good = HDF5FileWriteNumbers_Private(steps, "before", series->num_past, series->past);
  if (steps >= 0) H5Gclose(steps);
  return good;
}

/* The group of the last step of a series. */
static PetscBool HDF5FileWriteGroup_Private(hid_t file, const FieldSeries *series)
{
  const hid_t links = H5Pcreate(H5P_LINK_CREATE);
  char        name[XDMF_STEP_NAME];
  hid_t       group = -1;
  PetscBool   good;

  XDMFStepName(series, series->num - 1, name);
  if (links >= 0 && H5Pset_create_intermediate_group(links, 1) >= 0)
    group = H5Gcreate2(file, name, links, H5P_DEFAULT, H5P_DEFAULT);
  good = (PetscBool)(group >= 0 &&
                     HDF5FileWriteNumber_Private(group, "t", H5T_IEEE_F64LE, (double)series->t[series->num - 1]) &&
                     HDF5FileWriteNumber_Private(group, "solved", H5T_STD_I32LE, series->solved ? 1 : 0));
  if (group >= 0) H5Gclose(group);
  if (links >= 0) H5Pclose(links);
  if (good && series->num == 1) good = HDF5FileWritePast_Private(file, series);
  return good;
}

/* Makes or opens the file. First rank only, not collective. */
static void HDF5FileOpen_Private(const FieldWriter *writer, Image *image)
{
  struct stat info;

  H5Eset_auto2(H5E_DEFAULT, NULL, NULL); // without HDF5's own messages: failures are reported by this program
  image->driver->file = fileno(writer->out);
  if (image->more && !fstat(image->driver->file, &info)) image->driver->size = (haddr_t)info.st_size;
  image->access = HDF5DriverCreate(image->driver);
  if (image->more) {
    image->file = image->access < 0 ? -1 : H5Fopen(writer->base, H5F_ACC_RDWR, image->access);
    image->good = (PetscBool)(image->file >= 0);
  } else {
    image->file = image->access < 0 ? -1 : H5Fcreate(writer->base, H5F_ACC_TRUNC, H5P_DEFAULT, image->access);
    image->good = (PetscBool)(image->file >= 0 && HDF5FileWriteAttribute_Private(image->file, "title", writer->title) &&
                              HDF5FileWriteAttribute_Private(image->file, "bodies", writer->bodies) &&
                              HDF5FileWriteAttribute_Private(image->file, "creator", "mortise " MORTISE_VERSION) &&
                              HDF5FileWriteAttribute_Private(
                                  image->file, "units", "those of the scene: whatever consistent set it was given in"));
  }
  if (writer->series) image->good = (PetscBool)(image->good && HDF5FileWriteGroup_Private(image->file, writer->series));
}

static PetscErrorCode HDF5FileBegin_Private(FieldWriter *writer)
{
  Image *image;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&image));
  writer->data      = image;
  image->file       = -1;
  image->descriptor = -1;
  image->more       = (PetscBool)(writer->series && writer->series->num > 1);
  if (writer->out) {
    PetscCall(PetscNew(&image->driver));
    HDF5FileOpen_Private(writer, image);
    if (image->more)
      snprintf(image->path, sizeof(image->path), "%s%s", writer->base, writer->format->suffix);
    else
      snprintf(image->path, sizeof(image->path), "%s", writer->files->temporary[writer->files->num - 1]);
  }
  PetscCallMPI(MPI_Bcast(image->path, sizeof(image->path), MPI_CHAR, 0, writer->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the mesh is to be written: of a series the first one, and each different one. */
static PetscBool HDF5FileTakesMesh_Private(const FieldWriter *writer)
{
  const Image *image = (const Image *)writer->data;

  return (PetscBool)(!image->more || (writer->series->varies && writer->series->fresh));
}

/* The name of a dataset in the group of the last step, or in the root. */
static void HDF5FilePlace_Private(const FieldWriter *writer, PetscBool group, const char name[], char placed[PLACED])
{
  char step[XDMF_STEP_NAME] = "";

  if (group) XDMFStepName(writer->series, writer->series->num - 1, step);
  snprintf(placed, PLACED, "%s%s", step, name);
}

/* Links a name in the root to a dataset of the last step. */
static void HDF5FileLink_Private(Image *image, const char placed[], const char name[])
{
  if (!image->good || image->file < 0) return;
  if (image->more) image->good = (PetscBool)(H5Ldelete(image->file, name, H5P_DEFAULT) >= 0);
  image->good =
      (PetscBool)(image->good && H5Lcreate_hard(image->file, placed, image->file, name, H5P_DEFAULT, H5P_DEFAULT) >= 0);
}

/* Writes a dataset: of a series into the last group, with a link in the root in place of that to the step
   before. [in] group - whether a series has it in groups */
static PetscErrorCode HDF5FileWritePlaced_Private(FieldWriter *writer, PetscBool group, const FieldRows *rows,
                                                  const Quantity *quantity, const PetscReal values[])
{
  char     name[PLACED];
  Quantity placed = *quantity;

  PetscFunctionBeginUser;
  HDF5FilePlace_Private(writer, group, quantity->name, name);
  placed.name = name;
  PetscCall(HDF5FileWriteQuantity_Private(writer, rows, &placed, values));
  if (group) HDF5FileLink_Private((Image *)writer->data, name, quantity->name);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether points and cells stand in groups. */
static PetscBool HDF5FileVaries_Private(const FieldWriter *writer)
{
  return (PetscBool)(writer->series && writer->series->varies);
}

static PetscErrorCode HDF5FilePoints_Private(FieldWriter *writer, const PetscReal positions[])
{
  PetscFunctionBeginUser;
  if (HDF5FileTakesMesh_Private(writer))
    PetscCall(HDF5FileWritePlaced_Private(writer, HDF5FileVaries_Private(writer), &writer->points,
                                          &(Quantity){"points", 3, PETSC_FALSE}, positions));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode HDF5FileCells_Private(FieldWriter *writer, const SortedCells *cells)
{
  Image          *image    = (Image *)writer->data;
  Topology       *topology = &image->topology;
  const PetscBool group    = HDF5FileVaries_Private(writer);
  char            name[PLACED];

  PetscFunctionBeginUser;
  PetscCall(XDMFTopologyCreate(&writer->cells, cells, topology));
  HDF5FilePlace_Private(writer, group, "cells", name);
  if (HDF5FileTakesMesh_Private(writer)) {
    PetscCall(HDF5FileWriteDataset_Private(
        writer, &(Dataset){.name    = name,
                           .about   = topology->columns == 1 ? "per cell: XDMF type number, then its points"
                                                             : "points of each cell",
                           .rows    = &topology->part,
                           .columns = topology->columns,
                           .integer = PETSC_TRUE,
                           .values  = topology->values}));
    if (group) HDF5FileLink_Private(image, name, "cells");
  }
  PetscCall(XDMFTopologyDestroy(topology));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode HDF5FilePoint_Private(FieldWriter *writer, const Quantity *quantity, const PetscReal values[])
{
  PetscFunctionBeginUser;
  PetscCall(
      HDF5FileWritePlaced_Private(writer, (PetscBool)(writer->series != NULL), &writer->points, quantity, values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode HDF5FileCell_Private(FieldWriter *writer, const Quantity *quantity, const PetscReal values[])
{
  PetscFunctionBeginUser;
  if (HDF5FileTakesMesh_Private(writer))
    PetscCall(HDF5FileWritePlaced_Private(writer, HDF5FileVaries_Private(writer), &writer->cells, quantity, values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A file that has grown, until the change is made. */
typedef struct {
  HDF5Driver *driver;
  FILE       *out;
} Growth;

static int GrowthCommitFn(void *ctx)
{
  return HDF5DriverCommit(((Growth *)ctx)->driver);
}

static void GrowthForgetFn(void *ctx)
{
  Growth *growth = ctx;

  if (growth->out) (void)fclose(growth->out);
  HDF5DriverForget(growth->driver);
  (void)PetscFree(growth->driver);
  (void)PetscFree(growth);
}

/* Closes the file, of which all ranks have written their rows. First rank only, not collective. */
static PetscErrorCode HDF5FileClose_Private(FieldWriter *writer, Image *image)
{
  Growth *growth;
  char    path[PETSC_MAX_PATH_LEN];

  PetscFunctionBeginUser;
  if (image->file >= 0 && H5Fclose(image->file) < 0) image->good = PETSC_FALSE;
  if (image->access >= 0) H5Pclose(image->access);
  HDF5DriverDestroy(image->driver);
  PetscCall(PetscSNPrintf(path, sizeof(path), "%s%s", writer->base, writer->format->suffix));
  if (!image->driver->error) image->driver->error = image->error;
  PetscCheck(image->good || image->driver->error || image->more, PETSC_COMM_SELF, PETSC_ERR_MEM,
             "No memory for the file of fields");
  if (!image->good && !image->driver->error) image->driver->error = EIO; // another process has changed the file
  if (image->driver->error) PetscCall(FileSetFail(writer->files, path, image->driver->error));
  if (image->more) {
    PetscCall(PetscNew(&growth));
    *growth     = (Growth){.driver = image->driver, .out = writer->out};
    writer->out = NULL;
    PetscCall(FileSetChangeInPlace(writer->files, path, GrowthCommitFn, GrowthForgetFn, growth));
  } else {
    PetscCall(FileSetClose(writer->files, &writer->out));
    PetscCall(PetscFree(image->driver));
  }
  PetscCall(XDMFWrite(writer, &image->topology, path));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode HDF5FileEnd_Private(FieldWriter *writer)
{
  Image *image = (Image *)writer->data;

  PetscFunctionBeginUser;
  if (image->descriptor >= 0 && close(image->descriptor) && !image->error) image->error = errno;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &image->error, 1, MPI_INT, MPI_MAX, writer->comm));
  if (writer->out) PetscCall(HDF5FileClose_Private(writer, image));
  PetscCall(PetscFree(writer->data));
  PetscFunctionReturn(PETSC_SUCCESS);
}

const FieldFormat field_format_hdf5 = {.suffix = ".h5",
                                       .grows  = PETSC_TRUE,
                                       .begin  = HDF5FileBegin_Private,
                                       .points = HDF5FilePoints_Private,
                                       .cells  = HDF5FileCells_Private,
                                       .point  = HDF5FilePoint_Private,
                                       .cell   = HDF5FileCell_Private,
                                       .end    = HDF5FileEnd_Private};

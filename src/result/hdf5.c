/* hdf5.c -- the picture as plain contiguous datasets, written by the first rank alone.

   /points [N][3], /cells (see xdmf.c), one dataset per quantity under its own name; attributes of the file: title, version,
   units, and a word on every dataset's order. Readable by h5py, MATLAB, h5dump without any library of ours.

   The file is built in memory (HDF5's core driver) and written as bytes: after a failed write HDF5 1.10 can neither close
   the file nor survive MPI_Finalize(), so a full disk would end in a crash instead of a sentence. The price is the file's
   size in memory, little beside what solving took. */
#include <string.h>
#include <hdf5.h>
#include "picture.h"
#include "xdmf.h"
#include <mortise/compat.h>

enum { IMAGE_INCREMENT = 1 << 20 }; /* bytes by which the file in memory grows */

/* A text attribute, of variable length so that h5py gives a str; false on failure. */
static PetscBool WriteAttribute_Private(hid_t where, const char name[], const char text[])
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

/* An array of shape [rows][columns], [rows] where columns is 1; HDF5 converts from the type in memory to the stored one. */
typedef struct {
  const char *name, *about;
  PetscInt    rows, columns;
  hid_t       memory, stored;
  const void *values;
} Dataset;

/* False on failure. */
static PetscBool WriteDataset_Private(hid_t file, const Dataset *data)
{
  const hsize_t shape[2] = {(hsize_t)data->rows, (hsize_t)data->columns};
  const hid_t   space    = H5Screate_simple(data->columns == 1 ? 1 : 2, shape, NULL);
  const hid_t   set      = H5Dcreate2(file, data->name, data->stored, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  PetscBool     good     = (PetscBool)(set >= 0);

  if (good) good = (PetscBool)(H5Dwrite(set, data->memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data->values) >= 0);
  if (good) good = WriteAttribute_Private(set, "about", data->about);
  if (set >= 0 && H5Dclose(set) < 0) good = PETSC_FALSE;
  H5Sclose(space);
  return good;
}

/* What a reader has to know about a quantity. */
static const char *About_Private(const char name[])
{
  static const char *const table[][2] = {
      {"points", "positions before the motion: x, y, z"},
      {"displacement", "x, y, z in the unit of length"},
      {"motion", "x, y, z of the rigid motion that loads drive and nothing resists: an angle of 1, else a length of 1"},
      {"stress", "tensor by rows: xx,xy,xz,yx,yy,yz,zx,zy,zz in the unit of stress; volume-weighted nodal average"},
      {"von_mises", "of the averaged stress"},
      {"principal", "principal values of the averaged stress, the largest first"},
      {"pressure", "contact pressure on nonmortar sides, 0 elsewhere"},
      {"gap", "left after the motion, along the nonmortar normal; NAN where there is no constraint"},
      {"normal", "out of the nonmortar body, before the motion; where there is a constraint, its direction"},
      {"status", "0 open, 1 contact, 2 tied, -1 no constraint"},
      {"body", "index of the body, in the order of -bodies"},
      {"piece", "what hangs together: counted over all bodies"}};

  for (size_t i = 0; i < sizeof(table) / sizeof(table[0]); ++i) {
    if (strcmp(table[i][0], name) == 0) return table[i][1];
  }
  return "";
}

static PetscBool WriteArray_Private(hid_t file, PetscInt rows, const PictureArray *array)
{
  return WriteDataset_Private(file, &(Dataset){.name    = array->name,
                                               .about   = About_Private(array->name),
                                               .rows    = rows,
                                               .columns = array->components,
                                               .memory  = H5T_NATIVE_DOUBLE,
                                               .stored  = array->integer ? H5T_STD_I32LE : H5T_IEEE_F64LE,
                                               .values  = array->values});
}

static PetscBool WriteAll_Private(hid_t file, const Picture *picture, const Topology *topology)
{
  const PictureArray points = {"points", 3, PETSC_FALSE, picture->points};
  const Dataset      cells  = {.name    = "cells",
                               .about   = topology->columns == 1 ? "per cell: XDMF type number, then its points"
                                                                 : "points of each cell",
                               .rows    = topology->rows,
                               .columns = topology->columns,
                               .memory  = H5T_NATIVE_INT,
                               .stored  = H5T_STD_I32LE,
                               .values  = topology->values};
  PetscBool          good;

  good = (PetscBool)(WriteAttribute_Private(file, "title", picture->title) &&
                     WriteAttribute_Private(file, "creator", "mortise " MORTISE_VERSION) &&
                     WriteAttribute_Private(file, "units",
                                            "those of the scene: whatever consistent set it was given in") &&
                     WriteArray_Private(file, picture->num_points, &points) && WriteDataset_Private(file, &cells));
  for (PetscInt i = 0; i < picture->num_point_arrays && good; ++i) {
    good = WriteArray_Private(file, picture->num_points, &picture->point[i]);
  }
  for (PetscInt i = 0; i < picture->num_cell_arrays && good; ++i) {
    good = WriteArray_Private(file, picture->num_cells, &picture->cell[i]);
  }
  return good;
}

/* The file as bytes. [out] image - owned by the caller */
static PetscErrorCode CreateImage_Private(const Picture *picture, const Topology *topology, size_t *size, char **image)
{
  const hid_t access    = H5Pcreate(H5P_FILE_ACCESS);
  hid_t       file      = -1;
  ssize_t     num_bytes = 0;
  PetscBool   good      = (PetscBool)(H5Pset_fapl_core(access, IMAGE_INCREMENT, 0) >= 0);

  PetscFunctionBeginUser;
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL); // its lists of functions; what can fail here is told by us
  if (good) file = H5Fcreate("picture", H5F_ACC_TRUNC, H5P_DEFAULT, access);
  good = (PetscBool)(file >= 0 && WriteAll_Private(file, picture, topology) && H5Fflush(file, H5F_SCOPE_LOCAL) >= 0);
  if (good) num_bytes = H5Fget_file_image(file, NULL, 0);
  *size = (size_t)PetscMax(num_bytes, 0);
  PetscCall(PetscMalloc1(*size, image));
  good = (PetscBool)(good && num_bytes > 0 && H5Fget_file_image(file, *image, *size) == num_bytes);
  if (file >= 0) H5Fclose(file);
  H5Pclose(access);
  PetscCheck(good, PETSC_COMM_SELF, PETSC_ERR_MEM, "No memory for the picture"); // which is nowhere else
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PictureWriteHDF5(const Picture *picture, Files *files, const char final[])
{
  FILE    *out;
  Topology topology;
  char    *image;
  size_t   size;

  PetscFunctionBeginUser;
  PetscCall(FilesOpen(files, final, &out));
  if (!out) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(TopologyCreate(picture, &topology));
  PetscCall(CreateImage_Private(picture, &topology, &size, &image));
  fwrite(image, 1, size, out); /* what fails shows when the file is closed */
  PetscCall(PetscFree(image));
  PetscCall(TopologyDestroy(&topology));
  PetscCall(FilesClose(files, &out));
  PetscFunctionReturn(PETSC_SUCCESS);
}

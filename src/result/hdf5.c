/* hdf5.c -- the picture as plain contiguous datasets, written by the first rank alone.

   /points [N][3], /cells (see xdmf.c), one dataset per quantity under its own name; attributes of the file: title, version,
   units, and a word on every dataset's order. Readable by h5py, MATLAB, h5dump without any library of ours. */
#include <errno.h>
#include <string.h>
#include <hdf5.h>
#include "picture.h"
#include "xdmf.h"
#include <mortise/compat.h>

/* A text attribute; false on failure. */
static PetscBool WriteAttribute_Private(hid_t where, const char name[], const char text[])
{
  const hid_t space = H5Screate(H5S_SCALAR), type = H5Tcopy(H5T_C_S1);
  hid_t       attribute;
  herr_t      bad = H5Tset_size(type, strlen(text) + 1);

  if (bad >= 0) bad = H5Tset_cset(type, H5T_CSET_UTF8);
  attribute = H5Acreate2(where, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  if (bad >= 0) bad = attribute < 0 ? -1 : H5Awrite(attribute, type, text);
  if (attribute >= 0) H5Aclose(attribute);
  H5Tclose(type);
  H5Sclose(space);
  return (PetscBool)(bad >= 0);
}

/* A dataset of shape [rows][columns], [rows] where columns is 1; false on failure. HDF5 converts from memory to file type. */
static PetscBool WriteDataset_Private(hid_t file, const char name[], PetscInt rows, PetscInt columns, hid_t stored,
                                      hid_t memory, const void *values, const char about[])
{
  const hsize_t shape[2] = {(hsize_t)rows, (hsize_t)columns};
  const hid_t   space    = H5Screate_simple(columns == 1 ? 1 : 2, shape, NULL);
  const hid_t   set      = H5Dcreate2(file, name, stored, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  PetscBool     good     = (PetscBool)(set >= 0);

  if (good) good = (PetscBool)(H5Dwrite(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
  if (good) good = WriteAttribute_Private(set, "about", about);
  if (set >= 0 && H5Dclose(set) < 0) good = PETSC_FALSE;
  H5Sclose(space);
  return good;
}

/* What a reader has to know about a quantity. */
static const char *About_Private(const char name[])
{
  static const char *const table[][2] = {
      {"displacement", "x, y, z in the unit of length"},
      {"stress", "tensor by rows: xx,xy,xz,yx,yy,yz,zx,zy,zz in the unit of stress; volume-weighted nodal average"},
      {"von_mises", "of the averaged stress"},
      {"pressure", "contact pressure on nonmortar sides, 0 elsewhere"},
      {"gap", "left after the motion, along the nonmortar normal; NAN where there is no constraint"},
      {"status", "0 open, 1 contact, 2 tied, -1 no constraint"},
      {"body", "index of the body, in the order of -bodies"}};

  for (size_t i = 0; i < sizeof(table) / sizeof(table[0]); ++i) {
    if (strcmp(table[i][0], name) == 0) return table[i][1];
  }
  return "";
}

static PetscBool WriteArray_Private(hid_t file, PetscInt rows, const PictureArray *array)
{
  return WriteDataset_Private(file, array->name, rows, array->components,
                              array->integer ? H5T_STD_I32LE : H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, array->values,
                              About_Private(array->name));
}

static PetscBool WriteAll_Private(hid_t file, const Picture *picture, const Topology *topology)
{
  PetscBool good;

  good = (PetscBool)(WriteAttribute_Private(file, "title", picture->title) &&
                     WriteAttribute_Private(file, "creator", "mortise " MORTISE_VERSION) &&
                     WriteAttribute_Private(file, "units",
                                            "those of the scene: whatever consistent set it was given in") &&
                     WriteDataset_Private(file, "points", picture->num_points, 3, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE,
                                          picture->points, "positions before the motion: x, y, z"));
  if (good) {
    good = WriteDataset_Private(
        file, "cells", topology->rows, topology->columns, H5T_STD_I32LE, H5T_NATIVE_INT, topology->values,
        topology->columns == 1 ? "per cell: XDMF type number, then its points" : "points of each cell");
  }
  for (PetscInt i = 0; i < PICTURE_POINT_ARRAYS && good; ++i) {
    good = WriteArray_Private(file, picture->num_points, &picture->point[i]);
  }
  for (PetscInt i = 0; i < PICTURE_CELL_ARRAYS && good; ++i) {
    good = WriteArray_Private(file, picture->num_cells, &picture->cell[i]);
  }
  return good;
}

PetscErrorCode PictureWriteHDF5(const Picture *picture, Files *files, const char final[])
{
  const char *path;
  hid_t       file;
  Topology    topology;
  H5E_auto2_t print;
  void       *print_data;
  PetscBool   good;

  PetscFunctionBeginUser;
  PetscCall(FilesAdd(files, final, &path));
  if (!path) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(TopologyCreate(picture, &topology));
  /* HDF5's own error stack would be a wall of text: the reason is kept in errno. */
  H5Eget_auto2(H5E_DEFAULT, &print, &print_data);
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
  errno = 0;
  file  = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  good  = (PetscBool)(file >= 0 && WriteAll_Private(file, picture, &topology));
  if (file >= 0 && H5Fclose(file) < 0) good = PETSC_FALSE;
  if (!good) PetscCall(FilesFail(files, path, errno ? errno : EIO));
  H5Eset_auto2(H5E_DEFAULT, print, print_data);
  PetscCall(TopologyDestroy(&topology));
  PetscFunctionReturn(PETSC_SUCCESS);
}

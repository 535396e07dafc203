/* hdf5mesh.h -- a mesh in an HDF5 file, as `mortise -convert` writes it: whole, or a part of its rows.

   /points [n][3]; for each type of elements in the mesh, by Gmsh's number: /elements/<type>/nodes [m][nodes
   of the type], rows of points in Gmsh's order; /elements/<type>/groups [m], the set of physical groups of
   each element. /groups/start [sets+1] and /groups/number: the physical groups of set i are start[i] ..
   start[i+1]-1 of number. /names/dimension, /names/number, /names/name [names] of the named physical groups.
   Attributes of the file: mortise_mesh, the version of this layout, and dimension, the highest one of the
   elements. */
#ifndef MORTISE_HDF5MESH_H
#define MORTISE_HDF5MESH_H

#include "gmsh/gmshpart.h"

enum {
  HDF5_MESH_VERSION = 1,
  HDF5_MESH_NAME    = 128 /* bytes of a physical group's name, with its final zero */
};

/* HDF5's type of a PetscInt, for files that include hdf5.h. */
#define HDF5_MESH_INTEGER (sizeof(PetscInt) == sizeof(int) ? H5T_NATIVE_INT : H5T_NATIVE_INT64)

/* Whether HDF5MeshReadPart() reads a file or reports the reason: it has this layout, or is no HDF5 file.
   PETSC_FALSE for HDF5 files of another layout. Not collective.
   [out] dim - highest dimension of the elements, or 0 */
PetscErrorCode HDF5MeshProbe(const char path[], PetscBool *is, PetscInt *dim);
/* Reads points and elements part by part: of n rows those from n part / num_parts on. Names and groups are
   read whole. Not collective. [out] reason - why the file cannot be used, "" if it can [len] */
PetscErrorCode HDF5MeshReadPart(const char path[], PetscInt part, PetscInt num_parts, GmshNames *names, GmshPart *mesh,
                                char reason[], size_t len);

#endif

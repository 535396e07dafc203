/* meshconvert.h -- a Gmsh file as an HDF5 mesh, of which each rank of a later run reads its part. */
#ifndef MORTISE_MESHCONVERT_H
#define MORTISE_MESHCONVERT_H

#include <petscsys.h>

/* Writes the mesh `from` as `to`, in the layout of hdf5mesh.h: complete, or not at all. Tells on stdout what
   it holds. User errors: a file that is missing or cannot be used, a file `to` that exists. Collective; the
   first rank does it. */
PetscErrorCode MeshConvert(MPI_Comm comm, const char from[], const char to[]);

#endif

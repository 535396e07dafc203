/* gmshpart.h -- a mesh file, of which each rank has some points and some elements. */
#ifndef MORTISE_GMSHPART_H
#define MORTISE_GMSHPART_H

#include "gmsh/gmsh.h"

/* A part of a mesh. Of n points or elements rank r of s ranks has those from n r / s on. */
typedef struct {
  GmshMesh
      mesh; /* num_nodes and coords of this part; nodes of elements are numbers in the file; group is that of all */
  PetscInt first_node, all_nodes; /* of this part; of the file */
} GmshPart;

/* Reads a file in parts. Of a converted file each rank reads its part; a Gmsh file is read by the first rank,
   which sends the parts. Drops elements that are neither cells of the dimension nor facets in a physical
   group. Collective.
   [out] good - whether the file can be read and has no elements of a higher dimension; there is no reason for
   PETSC_FALSE */
PetscErrorCode GmshPartRead(MPI_Comm comm, const char path[], PetscInt dim, GmshNames *names, GmshPart *part,
                            PetscBool *good);

#endif

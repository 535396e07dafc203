/* gmshpart.h -- a mesh file, of which each rank has some points and some elements. */
#ifndef MORTISE_GMSHPART_H
#define MORTISE_GMSHPART_H

#include "gmsh/gmsh.h"

/* A part of a mesh. Of n points or elements rank r of s ranks has those from n r / s on. */
typedef struct {
  GmshMesh
           mesh; /* num_nodes and coords are those of this part; nodes of elements are numbers in the whole file; group is that of all */
  PetscInt first_node, all_nodes; /* of this part; of the file */
} GmshPart;

/* Reads a file: a converted one by all ranks, each its part; one of Gmsh by the first rank, which sends them theirs. Elements that are neither
   cells of the dimension nor facets in a physical group are dropped. Collective. [out] good - whether the file can be read, and has no elements
   of a higher dimension; what is wrong is not told */
PetscErrorCode GmshPartRead(MPI_Comm comm, const char path[], PetscInt dim, GmshNames *names, GmshPart *part,
                            PetscBool *good);

#endif

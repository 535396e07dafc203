/* gmshplex.h -- a Gmsh file as one DMPlex. Nothing is collective. */
#ifndef MORTISE_GMSHPLEX_H
#define MORTISE_GMSHPLEX_H

#include "gmsh/gmsh.h"
#include "refinement/curves.h"

/* A Gmsh file as a DM on this rank alone. [out] curves - owned by the caller; [out] reason - why it cannot be
   used, "" if it can [MESH_SENTENCE] */
PetscErrorCode GmshPlexCreate(const GmshMesh *mesh, PetscInt dim, DM *dm, Curves *curves, char reason[]);

#endif

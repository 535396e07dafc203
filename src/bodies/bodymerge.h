/* bodymerge.h -- all bodies in one DMPlex. */
#ifndef MORTISE_BODYMERGE_H
#define MORTISE_BODYMERGE_H

#include "bodies/bodylist.h"
#include "refinement/curves.h"

/* The one DMPlex of all bodies. Collective.
   [in] lists - complete on the first rank and empty on others, or parts that are joined later */
PetscErrorCode MeshMerge(Scene scene, const BodyList lists[], const SideNames names[], DM *dm, Curves *curves);

#endif

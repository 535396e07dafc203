/* bodyfile.h -- the lists of a body from the mesh of its file. Nothing is collective. */
#ifndef MORTISE_BODYFILE_H
#define MORTISE_BODYFILE_H

#include "bodies/bodylist.h"
#include "bodies/meshfile.h"

/* The cells of a body's file, or of one of its regions. [in] refine - how often they are refined */
PetscErrorCode BodyListCreateFile(Scene scene, PetscInt body, PetscInt refine, const SideNames *names, MeshFile *files,
                                  BodyList *list, char sentence[]);

#endif

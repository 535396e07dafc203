/* bodyfile.h -- the lists of a body from the mesh of its file. Nothing is collective. */
#ifndef MORTISE_BODYFILE_H
#define MORTISE_BODYFILE_H

#include "bodies/bodylist.h"
#include "bodies/meshfile.h"

/* The cells of a body's file, or of one of its regions, with the body's own refinements. */
PetscErrorCode BodyListCreateFile(Scene scene, PetscInt body, const SideNames *names, MeshFile *files, BodyList *list,
                                  char sentence[]);

#endif

/* meshfile.h -- mesh files, read once each on the first rank. */
#ifndef MORTISE_MESHFILE_H
#define MORTISE_MESHFILE_H

#include "gmsh/gmsh.h"
#include "refinement/curves.h"

/* Meshes read so far, one per file, so that bodies that share a file share the reading. */
typedef struct _n_MeshFile *MeshFile;

struct _n_MeshFile {
  char     *path;
  DM        dm; /* as read, before any refinement */
  Curves    curves;
  GmshNames names; /* empty for other formats */
  MeshFile  next;
};

/* The mesh of a body's file as read now or for an earlier body.
   [in,out] files - list of what was read, NULL at first;
   [out] file - borrowed from the list; [out] sentence - [MESH_SENTENCE], "" unless the file cannot be used */
PetscErrorCode MeshFileOpen(const SceneBody *body, PetscInt dim, MeshFile *files, MeshFile *file, char sentence[]);
PetscErrorCode MeshFileDestroy(MeshFile *files);

#endif

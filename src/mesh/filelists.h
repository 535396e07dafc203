/* filelists.h -- sends cells to their ranks, and makes the lists of bodies there. */
#ifndef MORTISE_FILELISTS_H
#define MORTISE_FILELISTS_H

#include "bodies/bodylist.h"
#include "mesh/filecells.h"

/* Sends cells to their ranks, and replaces them by the received ones. Collective. */
PetscErrorCode FileCellsMove(const Files *files, const PetscInt part[], FileCells *cells);
/* The lists of this rank's cells, each with its vertices in ascending order. Collective.
   [out] ids - of the vertices of all lists: that of point p of body b is b files->num_points + p; freed by
   the caller */
PetscErrorCode FileListsCreate(Scene scene, const Files *files, const FileCells *cells, const SideNames names[],
                               BodyList lists[], PetscInt **ids);

#endif

/* restartfile.h -- the end of a run with load steps, read from its HDF5 file. */
#ifndef MORTISE_RESTARTFILE_H
#define MORTISE_RESTARTFILE_H

#include "mesh/mesh.h"

/* Displacement and time of the last solved step. Points are found by place and body, since the order of nodes
   depends on the number of ranks. User errors: a file that cannot be read, is of another scene or mesh, or
   has no solved step. Collective.
   [in] path - every rank reads it, in chunks, and keeps the points near its nodes;
   [out] u - ghosted, dim per node, owned by the caller; [out] t */
PetscErrorCode RestartFileRead(Level *level, const char path[], Vec *u, PetscReal *t);

#endif

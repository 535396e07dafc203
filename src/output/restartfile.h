/* restartfile.h -- the end of a run with load steps, read from its HDF5 file. */
#ifndef MORTISE_RESTARTFILE_H
#define MORTISE_RESTARTFILE_H

#include "level/level.h"

/* Displacement of the last solved step, and the times of all of them. Points are found by place and body,
   since the order of nodes depends on the number of ranks. User errors: a file that cannot be read, is of
   another scene or mesh, or has no solved step. Collective.
   [in] path - every rank reads it, in chunks, and keeps the points near its nodes;
   [out] u - ghosted, dim per node, owned by the caller;
   [out] num, times - of solved steps, with those of the runs that the file's run went on from, in the order
   of their solution; the last one is that of u; owned by the caller [num] */
PetscErrorCode RestartFileRead(Level *level, const char path[], Vec *u, PetscInt *num, PetscReal **times);

#endif

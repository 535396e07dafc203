/* terminal.h -- does somebody look on. */
#ifndef MORTISE_TERMINAL_H
#define MORTISE_TERMINAL_H

#include <petscsys.h>

/* Whether what the first rank prints goes to a terminal. Under mpiexec, which gives its ranks terminals of its own making, that is
   whether mpiexec's output does. Collective. */
PetscErrorCode TerminalIsPresent(MPI_Comm comm, PetscBool *there);

#endif

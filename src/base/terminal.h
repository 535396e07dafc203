/* terminal.h -- whether the output is a terminal. */
#ifndef MORTISE_TERMINAL_H
#define MORTISE_TERMINAL_H

#include <petscsys.h>

/* Whether the output of the first rank is a terminal; under mpiexec, whether that of mpiexec is.
   Collective. */
PetscErrorCode TerminalIsPresent(MPI_Comm comm, PetscBool *there);

#endif

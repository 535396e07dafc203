/* terminal.c -- whether the output is a terminal.

   Under mpiexec isatty() is true on the first rank even if the output of mpiexec is a file. Open MPI gives
   the ranks of its own machine pseudo-terminals. MPI has no call for this. The output of mpiexec is that of
   the parent process, which Linux lists in /proc. Without this, the progress table of a parallel run would
   either fill log files or be missing on terminals. */
#include "base/compat.h"
#include "base/terminal.h"
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

enum { PATH_LENGTH = 64 };

/* Whether standard output of the parent process is a terminal, where the system tells (Linux). */
static int TerminalParentHasTerminal_Private(void)
{
  char path[PATH_LENGTH];
  int  output, terminal;

  (void)snprintf(path, sizeof(path), "/proc/%ld/fd/%d", (long)getppid(), STDOUT_FILENO);
  output = open(path, O_WRONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (output < 0) return 0;
  terminal = isatty(output);
  (void)close(output);
  return terminal;
}

PetscErrorCode TerminalIsPresent(MPI_Comm comm, PetscBool *there)
{
  int terminal = isatty(STDOUT_FILENO);

  PetscFunctionBeginUser;
  if (terminal && getenv("OMPI_COMM_WORLD_SIZE")) terminal = TerminalParentHasTerminal_Private();
  PetscCallMPI(MPI_Bcast(&terminal, 1, MPI_INT, 0, comm));
  *there = terminal ? PETSC_TRUE : PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* initialize.c -- the beginning and the end of the library, and the frame of each of its calls.

   PETSc's handler of errors and its database of options are global. A call replaces both and restores them: a
   program that runs PETSc keeps its own. Between calls only MORTISE_ERR_USER is silent. */
#include "api/apiimpl.h"
#include <metis.h>
#include <muParserDLL.h>
#include <petscpkg_version.h>
#include <stdio.h>
#include <string.h>
#include "api/process.h"
#include "base/compat.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/options.h"
#include "base/warning.h"
#include "pdas/pdas.h"

enum { VERSIONS_LENGTH = 1024 + MPI_MAX_LIBRARY_VERSION_STRING };

static struct {
  PetscBool ready, started_mpi,
      started_petsc;    /* between MortiseInitialize() and MortiseFinalize(); whether it has started MPI, PETSc */
  PetscBool registered; /* types, with a PETSc that has not ended since */
} library;

/* PetscFinalize() destroys the registered types. */
static PetscErrorCode ForgetFn(void)
{
  PetscFunctionBeginUser;
  library.registered = PETSC_FALSE;
  if (library.ready && !library.started_petsc) { // the caller has forgotten MortiseFinalize()
    library.ready = PETSC_FALSE;
    PetscCall(UserErrorUnsilence());
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Registers types and stages with PETSc. */
static PetscErrorCode InitializeTypes_Private(double start)
{
  PetscFunctionBeginUser;
  PetscCall(LogInitialize(start));
  if (library.registered) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PDASRegister());
  PetscCall(PetscRegisterFinalize(ForgetFn));
  library.registered = PETSC_TRUE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Starts PETSc on the arguments and the options files that they name. */
static PetscErrorCode InitializePetsc_Private(int argc, char **argv)
{
  char sentence[USER_ERROR_LENGTH];

  PetscFunctionBeginUser;
  OptionsExpand(argc, argv, &argc, &argv, sentence, sizeof(sentence));
  if (sentence[0]) return UserErrorRaise(MPI_COMM_WORLD, "%s", sentence);
  PetscCall(UserErrorInitialize());
  if (ProcessIsOwn()) MemoryPrepare();
  // a signal that arrives before UserErrorCatchSignals() ends the process, without PETSc's report
  if (ProcessIsOwn()) PetscCall(PetscOptionsSetValue(NULL, "-no_signal_handler", NULL));
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  if (ProcessIsOwn()) PetscCall(PetscOptionsClearValue(NULL, "-no_signal_handler"));
  PetscCall(OptionsListExpanded());
  library.started_petsc = PETSC_TRUE;
  if (ProcessIsOwn()) PetscCall(UserErrorCatchSignals());
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortiseInitialize(int *argc, char ***argv)
{
  const double   start    = ProcessIsOwn() ? ProcessStart() : LogWallClock();
  char           name[]   = "mortise";
  char          *nobody[] = {name, NULL};
  PetscBool      runs;
  PetscErrorCode error;
  int            mpi, ended;

  if (library.ready) return PETSC_SUCCESS;
  UserErrorSetQuiet((PetscBool)!ProcessIsOwn());
  MPI_Finalized(&ended);
  if (ended)
    return UserErrorRaise(MPI_COMM_WORLD, "MortiseInitialize(): MPI has ended, and begins only once in a program");
  MPI_Initialized(&mpi);
  if (!mpi) {
    MPI_Init(argc, argv);
    library.started_mpi = PETSC_TRUE;
  }
  PetscInitialized(&runs);
  error = runs                    ? OptionsJoin()
          : argc && argv && *argc ? InitializePetsc_Private(*argc, *argv)
                                  : InitializePetsc_Private(1, nobody);
  if (!error) error = InitializeTypes_Private(start);
  if (!error && !ProcessIsOwn()) error = UserErrorSilence();
  if (!error) library.ready = PETSC_TRUE;
  return error;
}

PetscErrorCode MortiseFinalize(void)
{
  PetscErrorCode error = PETSC_SUCCESS;

  if (library.ready && !ProcessIsOwn()) error = UserErrorUnsilence();
  library.ready = PETSC_FALSE;
  WarningClear();
  OptionsClear();
  if (!error && library.started_petsc && ProcessIsOwn()) error = UserErrorReleaseSignals();
  if (!error && library.started_petsc) error = PetscFinalize();
  library.started_petsc = PETSC_FALSE;
  if (library.started_mpi) MPI_Finalize();
  library.started_mpi = PETSC_FALSE;
  return error;
}

PetscErrorCode ApiNeedLibrary(const char function[])
{
  if (library.ready) return PETSC_SUCCESS;
  UserErrorSetQuiet((PetscBool)!ProcessIsOwn());
  return UserErrorRaise(MPI_COMM_WORLD, "%s(): call MortiseInitialize() before, and MortiseFinalize() after", function);
}

PetscErrorCode ApiNeedHandle(Mortise m, const char function[])
{
  const PetscErrorCode error = ApiNeedLibrary(function);

  if (error || m) return error;
  return UserErrorRaise(PETSC_COMM_WORLD, "%s(): the handle is NULL; MortiseCreate() makes one", function);
}

PetscErrorCode ApiNeedName(Mortise m, const char function[], const char name[], const char what[])
{
  PetscFunctionBeginUser;
  if (!name) PetscCall(UserErrorRaise(m->comm, "%s(): the name of the %s is NULL", function, what));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscBool ApiJoined(void)
{
  return (PetscBool)!library.started_petsc;
}

PetscErrorCode ApiBegin(Mortise m)
{
  PetscFunctionBeginUser;
  PetscCall(UserErrorEnter());
  if (m->options) PetscCall(PetscOptionsPush(m->options));
  WarningExchange(&m->warnings);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ApiEnd(Mortise m, PetscErrorCode error)
{
  PetscFunctionBeginUser;
  if (error) PetscCall(LogUnwind());
  if (error) WarningBreakRun();
  WarningExchange(&m->warnings);
  if (m->options) PetscCall(PetscOptionsPop());
  PetscCall(UserErrorLeave());
  PetscFunctionReturn(error);
}

PetscErrorCode MortiseGetError(const char **sentence)
{
  *sentence = UserErrorSentence();
  return PETSC_SUCCESS;
}

PetscErrorCode MortiseGetVersions(const char **text)
{
  static char      lines[VERSIONS_LENGTH];
  muParserHandle_t parser = mupCreate(muBASETYPE_FLOAT);
  const char      *name   = mupGetVersion(parser);
  char             mpi[MPI_MAX_LIBRARY_VERSION_STRING];
  int              length;
  size_t           n;

  MPI_Get_library_version(mpi, &length);
  n = (size_t)snprintf(lines, sizeof(lines), "mortise %s\nPETSc %d.%d.%d, %d-bit indices\n", MORTISE_VERSION,
                       PETSC_VERSION_MAJOR, PETSC_VERSION_MINOR, PETSC_VERSION_SUBMINOR, (int)(8 * sizeof(PetscInt)));
#if defined(PETSC_HAVE_MUMPS)
  n += (size_t)snprintf(lines + n, sizeof(lines) - n, "MUMPS %d.%d.%d\n", PETSC_PKG_MUMPS_VERSION_MAJOR,
                        PETSC_PKG_MUMPS_VERSION_MINOR, PETSC_PKG_MUMPS_VERSION_SUBMINOR);
#endif
#if defined(PETSC_HAVE_HYPRE)
  n += (size_t)snprintf(lines + n, sizeof(lines) - n, "hypre %d.%d.%d\n", PETSC_PKG_HYPRE_VERSION_MAJOR,
                        PETSC_PKG_HYPRE_VERSION_MINOR, PETSC_PKG_HYPRE_VERSION_SUBMINOR);
#endif
  n += (size_t)snprintf(lines + n, sizeof(lines) - n, "METIS %d.%d.%d\nHDF5 %d.%d.%d\n", METIS_VER_MAJOR,
                        METIS_VER_MINOR, METIS_VER_SUBMINOR, PETSC_PKG_HDF5_VERSION_MAJOR, PETSC_PKG_HDF5_VERSION_MINOR,
                        PETSC_PKG_HDF5_VERSION_SUBMINOR);
  (void)snprintf(lines + n, sizeof(lines) - n, "muParser %.*s\n%.*s\n", (int)strcspn(name, " "), name,
                 (int)strcspn(mpi, ",\n"), mpi);
  mupRelease(parser);
  *text = lines;
  return PETSC_SUCCESS;
}

PetscErrorCode MortisePrintHelp(MPI_Comm comm)
{
  int rank;

  PetscFunctionBeginUser;
  MPI_Comm_rank(comm, &rank);
  if (!rank) SceneHelp(PETSC_STDOUT);
  PetscFunctionReturn(PETSC_SUCCESS);
}

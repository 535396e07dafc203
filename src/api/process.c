/* process.c -- see the header.

   After a mistake that PETSc has found, some ranks may wait for the others for ever: only the first rank
   opens a file. These are ended by force, and a rank that has the sentence prints it. */
#include "api/process.h"
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>
#include "api/launch.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/threads.h"
#include "output/htmlreport.h"

enum {
  EXIT_SECONDS = 5
}; /* seconds of waiting for the other ranks after a mistake: all have noticed it at once, or never will */

static struct {
  PetscBool own, alone; // alone: there is no MPI
  double    start;
  MPI_Comm  farewell; // separate, so that ranks in another collective call do not match the last one
} process;

/* Opens closed standard streams on /dev/null: otherwise result files would get their numbers. */
static void ProcessOpenStreams_Private(void)
{
  for (int stream = open("/dev/null", O_RDWR); stream >= 0; stream = dup(stream)) {
    if (stream <= STDERR_FILENO) continue;
    (void)close(stream);
    return;
  }
}

void ProcessBegin(int *argc, char ***argv, PetscBool solves)
{
  process.own   = PETSC_TRUE;
  process.start = LogWallClock();
  ProcessOpenStreams_Private();
  process.alone = (PetscBool)(!solves && !LaunchedByLauncher());
  if (process.alone) return;
  ThreadsLimit();
  LaunchMPI(argc, argv);
  MPI_Comm_dup(MPI_COMM_WORLD, &process.farewell);
}

PetscBool ProcessIsFirst(void)
{
  int rank = 0;

  if (!process.alone) MPI_Comm_rank(process.farewell, &rank);
  return (PetscBool)!rank;
}

PetscBool ProcessIsOwn(void)
{
  return process.own;
}

double ProcessStart(void)
{
  return process.start;
}

/* Whether all ranks reach the end of the program within a few seconds. */
static PetscBool ProcessEndTogether_Private(void)
{
  const double limit   = LogWallClock() + EXIT_SECONDS;
  int          arrived = 0;
  MPI_Request  request;

  MPI_Ibarrier(process.farewell, &request);
  while (!arrived && LogWallClock() < limit) MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
  return arrived ? PETSC_TRUE : PETSC_FALSE;
}

/* Whether the whole output was written, unless another error has happened; a full disk is noticed here at the
   latest. */
static PetscBool ProcessEndPrinting_Private(void)
{
  const int failed = fflush(stdout), reason = errno;

  if (!failed && !ferror(stdout)) return PETSC_TRUE;
  fprintf(stderr, "mortise: cannot write what is printed: %s\n",
          failed ? strerror(reason) : "the output is incomplete");
  return PETSC_FALSE;
}

int ProcessEnd(MortiseExit verdict)
{
  int rank, size;

  if (process.alone) return ProcessEndPrinting_Private() ? verdict : MORTISE_FAILED;
  MPI_Comm_rank(process.farewell, &rank);
  MPI_Comm_size(process.farewell, &size);
  InterruptCleanUp();
  if (!ProcessEndPrinting_Private() && verdict != MORTISE_USER_ERROR) verdict = MORTISE_FAILED;
  if (verdict == MORTISE_USER_ERROR && !ProcessEndTogether_Private()) {
    if (rank) fprintf(stderr, "mortise: %s\n", UserErrorSentence());
    MPI_Abort(MPI_COMM_WORLD, MORTISE_USER_ERROR);
  }
  if (verdict == MORTISE_FAILED && size > 1) MPI_Abort(MPI_COMM_WORLD, MORTISE_FAILED);
  MPI_Comm_free(&process.farewell);
  MPI_Finalize();
  if (rank)
    return MORTISE_SOLVED; // a launcher would end the other ranks, which may write a page, as soon as one rank reports a failure
  if (verdict != MORTISE_USER_ERROR && verdict != MORTISE_FAILED && !HTMLReportWrite() && verdict == MORTISE_SOLVED)
    verdict = MORTISE_FAILED;
  return verdict;
}

/* process.c -- see the header.

   Where PETSc has found a mistake, some ranks may not know of it and wait for the others for ever (a file that only the first rank
   opens); these are ended by force, and the sentence is said by a rank that knows it. */
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
}; /* seconds that ranks which know of a mistake wait for the others: they all heard of it at once, or never */

static struct {
  PetscBool own, alone; // alone: there is no MPI
  double    start;
  MPI_Comm  farewell; // what other ranks wait in must not be taken for the last meeting
} process;

/* Opens closed standard streams on /dev/null: otherwise result files would get their numbers. */
static void OpenStreams_Private(void)
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
  OpenStreams_Private();
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

/* Whether all ranks come to the end of the program within a few seconds. */
static PetscBool EndTogether_Private(void)
{
  const double limit   = LogWallClock() + EXIT_SECONDS;
  int          arrived = 0;
  MPI_Request  request;

  MPI_Ibarrier(process.farewell, &request);
  while (!arrived && LogWallClock() < limit) MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
  return arrived ? PETSC_TRUE : PETSC_FALSE;
}

/* Whether all that was printed has arrived, where nothing worse has happened; a full disk shows here at the latest. */
static PetscBool EndPrinting_Private(void)
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

  if (process.alone) return EndPrinting_Private() ? verdict : MORTISE_FAILED;
  MPI_Comm_rank(process.farewell, &rank);
  MPI_Comm_size(process.farewell, &size);
  InterruptCleanUp();
  if (!EndPrinting_Private() && verdict != MORTISE_USER_ERROR) verdict = MORTISE_FAILED;
  if (verdict == MORTISE_USER_ERROR && !EndTogether_Private()) {
    if (rank) fprintf(stderr, "mortise: %s\n", UserErrorSentence());
    MPI_Abort(MPI_COMM_WORLD, MORTISE_USER_ERROR);
  }
  if (verdict == MORTISE_FAILED && size > 1) MPI_Abort(MPI_COMM_WORLD, MORTISE_FAILED);
  MPI_Comm_free(&process.farewell);
  MPI_Finalize();
  if (rank)
    return MORTISE_SOLVED; // a launcher ends the others, at work on a page, as soon as one rank reports a mishap
  if (verdict != MORTISE_USER_ERROR && verdict != MORTISE_FAILED && !HTMLReportWrite() && verdict == MORTISE_SOLVED)
    verdict = MORTISE_FAILED;
  return verdict;
}

/* main.c -- the life of one problem: scene, mesh, inequality, solve, judge, write. */
#include <mortise.h>
#include <errno.h>
#include <fcntl.h>
#include <metis.h>
#include <muParserDLL.h>
#include <petscpkg_version.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum {
  PATIENCE = 5
}; /* seconds that ranks which know of a fault wait for the others: they all heard of it at once, or never */

static const char usage[] =
    "mortise: no scene given; write mortise -options_file <scene.opts>, or mortise -help for every option\n";

/* Solves a scene on one mesh and writes what comes of it; *verdict is the exit code of a run without faults. */
static PetscErrorCode SolveOnce(Scene scene, MortiseExit *verdict)
{
  Mesh         mesh = NULL;
  Run          run  = NULL;
  Output       output;
  SummaryInput input;

  PetscFunctionBeginUser;
  PetscCall(LogStageBegin(STAGE_SETUP));
  PetscCall(MeshCreate(scene, &mesh));
  PetscCall(MeshSetUp(mesh));
  PetscCall(ProbesCheck(scene, mesh));
  PetscCall(LogStageEnd(STAGE_SETUP));

  PetscCall(RunCreate(scene, mesh, NULL, &run));
  PetscCall(OutputCreate(scene->comm, &output));
  if (scene->output) {
    PetscCall(LogStageBegin(STAGE_OUTPUT));
    PetscCall(run->refused ? OutputAddMotion(output, run->vi, &run->solvability->motion)
                           : OutputAddFields(output, run->fields));
    PetscCall(LogStageEnd(STAGE_OUTPUT));
  }
  input = RunSummary(run);
  PetscCall(SummaryWrite(&input, &output));
  *verdict = run->solved ? MORTISE_SOLVED : run->refused ? MORTISE_NO_SOLUTION : MORTISE_NOT_CONVERGED;

  PetscCall(RunDestroy(&run));
  PetscCall(MeshDestroy(&mesh));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Where warnings are to fail a run, they do: files and numbers are there all the same. */
static PetscErrorCode CountWarnings(Scene scene, MortiseExit *verdict)
{
  PetscInt num;

  PetscFunctionBeginUser;
  if (!scene->warnings_fail) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(WarningNum(scene->comm, &num));
  if (!num || *verdict != MORTISE_SOLVED) PetscFunctionReturn(PETSC_SUCCESS);
  *verdict = MORTISE_NOT_CONVERGED;
  PetscCall(PetscFPrintf(scene->comm, PETSC_STDERR,
                         "mortise: -warnings error: %" PetscInt_FMT " warning%s; the results are complete\n", num,
                         num == 1 ? "" : "s"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Solves the scene of the options, once or as a study. */
static PetscErrorCode SolveScene(MortiseExit *verdict)
{
  Scene scene = NULL;

  PetscFunctionBeginUser;
  PetscCall(LogStageBegin(STAGE_SETUP));
  PetscCall(SceneCreate(PETSC_COMM_WORLD, &scene));
  PetscCall(SceneSetFromOptions(scene));
  PetscCall(SceneCheckUnused(scene, PETSC_TRUE));
  PetscCall(OutputCheck(scene));
  PetscCall(HTMLReportCheck(scene));
  PetscCall(LogStageEnd(STAGE_SETUP));
  if (scene->study.kind == STUDY_NONE)
    PetscCall(SolveOnce(scene, verdict));
  else
    PetscCall(StudyRun(scene, verdict));
  PetscCall(CountWarnings(scene, verdict));
  PetscCall(SceneDestroy(&scene));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Prints what the program is made of: the libraries of its results. */
static void PrintVersion(void)
{
  muParserHandle_t parser = mupCreate(muBASETYPE_FLOAT);
  char             mpi[MPI_MAX_LIBRARY_VERSION_STRING];
  int              length;

  MPI_Get_library_version(mpi, &length);
  printf("mortise %s\n", MORTISE_VERSION);
  printf("PETSc %d.%d.%d, %d-bit indices\n", PETSC_VERSION_MAJOR, PETSC_VERSION_MINOR, PETSC_VERSION_SUBMINOR,
         (int)(8 * sizeof(PetscInt)));
#if defined(PETSC_HAVE_MUMPS)
  printf("MUMPS %d.%d.%d\n", PETSC_PKG_MUMPS_VERSION_MAJOR, PETSC_PKG_MUMPS_VERSION_MINOR,
         PETSC_PKG_MUMPS_VERSION_SUBMINOR);
#endif
#if defined(PETSC_HAVE_HYPRE)
  printf("hypre %d.%d.%d\n", PETSC_PKG_HYPRE_VERSION_MAJOR, PETSC_PKG_HYPRE_VERSION_MINOR,
         PETSC_PKG_HYPRE_VERSION_SUBMINOR);
#endif
  printf("METIS %d.%d.%d\n", METIS_VER_MAJOR, METIS_VER_MINOR, METIS_VER_SUBMINOR);
  printf("HDF5 %d.%d.%d\n", PETSC_PKG_HDF5_VERSION_MAJOR, PETSC_PKG_HDF5_VERSION_MINOR,
         PETSC_PKG_HDF5_VERSION_SUBMINOR);
  printf("muParser %.*s\n", (int)strcspn(mupGetVersion(parser), " "), mupGetVersion(parser));
  printf("%.*s\n", (int)strcspn(mpi, ",\n"), mpi);
  mupRelease(parser);
}

/* Starts PETSc on an argument list. */
static PetscErrorCode Begin(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(UserErrorInitialize());
  MemoryPrepare();
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(UserErrorCatchSignals());
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Prints every option; the user's own options play no part in it. */
static PetscErrorCode PrintHelp(char *program)
{
  char  skip[]      = "-skip_petscrc";
  char *arguments[] = {program, skip, NULL};

  PetscFunctionBeginUser;
  PetscCall(Begin(2, arguments));
  PetscCall(SceneHelp(PETSC_COMM_WORLD));
  PetscCall(PetscFinalize());
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Solves the scene of an argument list without mistakes in its form. [out] verdict - how it went, where it went to the end */
static PetscErrorCode RunArguments(double start, int argc, char **argv, MortiseExit *verdict)
{
  PetscFunctionBeginUser;
  PetscCall(Begin(argc, argv));
  PetscCall(LogInitialize(start));
  PetscCall(PDASRegister());
  PetscCall(SolveScene(verdict));
  PetscCall(PetscFinalize());
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the command line has an option, with one dash or two. */
static PetscBool HasOption(int argc, char **argv, const char option[])
{
  for (int a = 1; a < argc; ++a)
    if (!strcmp(argv[a], option) || (argv[a][0] == '-' && !strcmp(argv[a] + 1, option))) return PETSC_TRUE;
  return PETSC_FALSE;
}

/* The exit code of a command line; MPI runs, PETSc does not yet. */
static MortiseExit Dispatch(double start, int argc, char **argv)
{
  MortiseExit    verdict = MORTISE_FAILED;
  PetscErrorCode error;
  char           sentence[USER_ERROR_LENGTH];
  int            rank;

  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (HasOption(argc, argv, "-version")) {
    if (!rank) PrintVersion();
    return MORTISE_SOLVED;
  }
  if (HasOption(argc, argv, "-help") || HasOption(argc, argv, "-h"))
    return PrintHelp(argv[0]) ? MORTISE_FAILED : MORTISE_SOLVED;
  if (argc < 2) {
    if (!rank) fputs(usage, stderr);
    return MORTISE_USER_ERROR;
  }
  OptionsExpand(argc, argv, &argc, &argv, sentence, sizeof(sentence));
  if (sentence[0]) {
    if (!rank) fprintf(stderr, "mortise: %s\n", sentence);
    return MORTISE_USER_ERROR;
  }
  error = RunArguments(start, argc, argv, &verdict);
  if (error == MORTISE_ERR_USER) return MORTISE_USER_ERROR;
  return error ? MORTISE_FAILED : verdict;
}

/* Whether all ranks come to the end of the program within a few seconds. */
static PetscBool EndTogether(MPI_Comm farewell)
{
  const double limit   = LogWallClock() + PATIENCE;
  int          arrived = 0;
  MPI_Request  request;

  MPI_Ibarrier(farewell, &request);
  while (!arrived && LogWallClock() < limit) MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
  return arrived ? PETSC_TRUE : PETSC_FALSE;
}

/* Whether all that was printed has arrived, where nothing worse has happened; a full disk shows here at the latest. */
static PetscBool EndPrinting(void)
{
  const int failed = fflush(stdout), reason = errno;

  if (!failed && !ferror(stdout)) return PETSC_TRUE;
  fprintf(stderr, "mortise: cannot write what is printed: %s\n",
          failed ? strerror(reason) : "the output is incomplete");
  return PETSC_FALSE;
}

/* Streams that were closed by whoever started the program lead to nowhere: else files would be opened in their place. */
static void OpenStreams(void)
{
  for (int stream = open("/dev/null", O_RDWR); stream >= 0; stream = dup(stream)) {
    if (stream <= STDERR_FILENO) continue;
    (void)close(stream);
    return;
  }
}

/* A fault leaves objects behind that nobody needs any more, so PETSc is not finalised after one: its lists of leaks would
   bury the sentence. Where PETSc has found the mistake, some ranks may not know of it and wait for the others for ever (a
   file that only the first rank opens); these are ended by force, and the sentence is said by who knows it. */
int main(int argc, char **argv)
{
  const double start = LogWallClock();
  MortiseExit  verdict;
  MPI_Comm     farewell;
  int          rank, size;

  MemoryLimitThreads(argv);
  OpenStreams();
  MPI_Init(&argc, &argv);
  MPI_Comm_dup(MPI_COMM_WORLD, &farewell); // what other ranks wait in must not be taken for the last meeting
  MPI_Comm_rank(farewell, &rank);
  MPI_Comm_size(farewell, &size);
  verdict = Dispatch(start, argc, argv);
  InterruptCleanUp();
  if (!EndPrinting() && verdict != MORTISE_USER_ERROR) verdict = MORTISE_FAILED;
  if (verdict == MORTISE_USER_ERROR && !EndTogether(farewell)) {
    if (rank) fprintf(stderr, "mortise: %s\n", UserErrorSentence());
    MPI_Abort(MPI_COMM_WORLD, MORTISE_USER_ERROR);
  }
  if (verdict == MORTISE_FAILED && size > 1) MPI_Abort(MPI_COMM_WORLD, MORTISE_FAILED);
  MPI_Comm_free(&farewell);
  MPI_Finalize();
  if (rank)
    return MORTISE_SOLVED; // a launcher ends the others, at work on a page, as soon as one rank reports a mishap
  if (verdict != MORTISE_USER_ERROR && verdict != MORTISE_FAILED && !HTMLReportWrite() && verdict == MORTISE_SOLVED)
    verdict = MORTISE_FAILED;
  return verdict;
}

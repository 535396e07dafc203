/* main.c -- the program: one scene read from options, solved, judged and written. */
#include <mortise.h>
#include <stdio.h>
#include <string.h>
#include "api/process.h"

static const char usage[] =
    "mortise: no scene given; write mortise -options_file <scene.opts>, or mortise -help for every option\n";

/* Solves the scene of the options. [out] status - the exit code of a run without mistakes */
static PetscErrorCode SolveScene(int *status)
{
  Mortise m;

  PetscFunctionBeginUser;
  PetscCall(MortiseCreate(PETSC_COMM_WORLD, &m));
  PetscCall(MortiseSetFromOptions(m));
  PetscCall(MortiseSolve(m));
  PetscCall(MortiseWrite(m));
  PetscCall(MortiseGetStatus(m, status));
  PetscCall(MortiseDestroy(&m));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A user error leaves objects behind. PETSc is not finalised then: its list of leaks would hide the sentence. */
static PetscErrorCode RunArguments(int argc, char **argv, int *status)
{
  PetscFunctionBeginUser;
  PetscCall(MortiseInitialize(&argc, &argv));
  PetscCall(SolveScene(status));
  PetscCall(MortiseFinalize());
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Prints every option; the user's own options play no part in it. */
static PetscErrorCode PrintHelp(char *program)
{
  char  skip[]      = "-skip_petscrc";
  char *arguments[] = {program, skip, NULL}, **argv = arguments;
  int   argc = 2;

  PetscFunctionBeginUser;
  PetscCall(MortiseInitialize(&argc, &argv));
  PetscCall(MortisePrintHelp(PETSC_COMM_WORLD));
  PetscCall(MortiseFinalize());
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the command line has an option, with one dash or two. */
static PetscBool HasOption(int argc, char **argv, const char option[])
{
  for (int a = 1; a < argc; ++a)
    if (!strcmp(argv[a], option) || (argv[a][0] == '-' && !strcmp(argv[a] + 1, option))) return PETSC_TRUE;
  return PETSC_FALSE;
}

/* The exit code of a command line. */
static int Dispatch(int argc, char **argv)
{
  PetscErrorCode error;
  const char    *versions;
  int            rank, status = MORTISE_FAILED;

  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (HasOption(argc, argv, "-version")) {
    MortiseGetVersions(&versions);
    if (!rank) fputs(versions, stdout);
    return MORTISE_SOLVED;
  }
  if (HasOption(argc, argv, "-help") || HasOption(argc, argv, "-h"))
    return PrintHelp(argv[0]) ? MORTISE_FAILED : MORTISE_SOLVED;
  if (argc < 2) {
    if (!rank) fputs(usage, stderr);
    return MORTISE_USER_ERROR;
  }
  error = RunArguments(argc, argv, &status);
  if (error == MORTISE_ERR_USER) return MORTISE_USER_ERROR;
  return error ? MORTISE_FAILED : status;
}

int main(int argc, char **argv)
{
  ProcessBegin(&argc, &argv);
  return ProcessEnd((MortiseExit)Dispatch(argc, argv));
}

/* main.c -- the program: one scene read from options, solved, judged and written. */
#include <mortise.h>
#include <stdio.h>
#include <string.h>
#include "api/process.h"
#include "output/meshconvert.h"
#include "scene/scene.h"

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

/* A user error leaves objects behind. PETSc is not finalised then: its list of leaks would hide the
   sentence. */
static PetscErrorCode RunArguments(int argc, char **argv, int *status)
{
  PetscFunctionBeginUser;
  PetscCall(MortiseInitialize(&argc, &argv));
  PetscCall(SolveScene(status));
  PetscCall(MortiseFinalize());
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Where the command line has an option, with one dash or two; 0 if nowhere. */
static int FindOption(int argc, char **argv, const char option[])
{
  for (int a = 1; a < argc; ++a)
    if (!strcmp(argv[a], option) || (argv[a][0] == '-' && !strcmp(argv[a] + 1, option))) return a;
  return 0;
}

static PetscBool HasOption(int argc, char **argv, const char option[])
{
  return (PetscBool)(FindOption(argc, argv, option) > 0);
}

/* Converts a mesh: -convert <from> <to>. The two words are hidden from PETSc, which takes one value for an
   option. */
static PetscErrorCode ConvertArguments(int argc, char **argv)
{
  const int   at   = FindOption(argc, argv, "-convert");
  const char *from = at + 1 < argc ? argv[at + 1] : "-", *to = at + 2 < argc ? argv[at + 2] : "-";

  PetscFunctionBeginUser;
  for (int a = at; a < argc; ++a) argv[a] = a + 3 < argc ? argv[a + 3] : NULL;
  argc = argc > at + 3 ? argc - 3 : at;
  PetscCall(MortiseInitialize(&argc, &argv));
  if (from[0] == '-' || to[0] == '-')
    PetscCall(UserErrorRaise(PETSC_COMM_WORLD, "-convert needs two names: mortise -convert part.msh part.h5"));
  PetscCall(MeshConvert(PETSC_COMM_WORLD, from, to));
  PetscCall(MortiseFinalize());
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the command line has an option that asks for words alone, or nothing at all: none of this needs
   MPI. */
static PetscBool AsksForWords(int argc, char **argv)
{
  return (PetscBool)(argc < 2 || HasOption(argc, argv, "-version") || HasOption(argc, argv, "-help") ||
                     HasOption(argc, argv, "-h"));
}

/* Prints these words, on the first rank. The user's other options play no part in it. Returns the exit
   code */
static MortiseExit PrintWords(int argc, char **argv)
{
  const char *versions;

  if (argc < 2) {
    if (ProcessIsFirst()) fputs(usage, stderr);
    return MORTISE_USER_ERROR;
  }
  if (!ProcessIsFirst()) return MORTISE_SOLVED;
  if (HasOption(argc, argv, "-version")) {
    MortiseGetVersions(&versions);
    fputs(versions, stdout);
  } else {
    SceneHelp(stdout);
  }
  return MORTISE_SOLVED;
}

/* Solves the scene, or converts a mesh. Returns the exit code */
static MortiseExit Solve(int argc, char **argv)
{
  const PetscBool      converts = HasOption(argc, argv, "-convert");
  int                  status   = converts ? MORTISE_SOLVED : MORTISE_FAILED;
  const PetscErrorCode error    = converts ? ConvertArguments(argc, argv) : RunArguments(argc, argv, &status);

  if (error == MORTISE_ERR_USER) return MORTISE_USER_ERROR;
  return error ? MORTISE_FAILED : (MortiseExit)status;
}

int main(int argc, char **argv)
{
  const PetscBool words = AsksForWords(argc, argv);

  ProcessBegin(&argc, &argv, (PetscBool)!words);
  return ProcessEnd(words ? PrintWords(argc, argv) : Solve(argc, argv));
}

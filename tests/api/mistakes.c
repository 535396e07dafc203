/* mistakes.c -- a mistake of the user comes back as MORTISE_ERR_USER with its sentence, without a word on the terminal, on all ranks; the
   program goes on, and solves in the end.

   mistakes <folder of scenes> <folder of this test> */
#include <math.h>
#include <mortise.h>
#include <stdio.h>
#include <string.h>
#include "test.h"

/* What is expected of a call: the code, and two texts within the sentence. */
#define CHECK_MISTAKE(call, first, second)                                                                             \
  do {                                                                                                                 \
    const char *sentence_;                                                                                             \
    CHECK((call) == MORTISE_ERR_USER);                                                                                 \
    CHECK(!MortiseGetError(&sentence_));                                                                               \
    if (!strstr(sentence_, first) || !strstr(sentence_, second)) fprintf(stderr, "%s\n", sentence_);                   \
    CHECK(strstr(sentence_, first) && strstr(sentence_, second));                                                      \
  } while (0)

static char squeezed[PETSC_MAX_PATH_LEN], pulled[PETSC_MAX_PATH_LEN];

/* A handle with options of its own, before its scene is read. */
static Mortise Create(const char prefix[], const char scene[])
{
  Mortise m;

  CHECK(!MortiseCreate(PETSC_COMM_WORLD, &m));
  CHECK(!MortiseSetOptionsPrefix(m, prefix));
  CHECK(!MortiseInsertFile(m, scene));
  return m;
}

/* Mistakes in options and files, and that the same handle can be mended. */
static void CheckOptions(void)
{
  Mortise m = Create("a_", squeezed);

  CHECK_MISTAKE(MortiseInsertFile(m, "nowhere.opts"), "nowhere.opts", "no such file");
  CHECK(!PetscOptionsSetValue(NULL, "-a_upper_yuong", "1"));
  CHECK_MISTAKE(MortiseSetFromOptions(m), "-upper_yuong", "-upper_young");
  CHECK_MISTAKE(MortiseSolve(m), "MortiseSolve()", "MortiseSetFromOptions()");
  CHECK(!MortiseDestroy(&m));
  CHECK(!PetscOptionsClearValue(NULL, "-a_upper_yuong"));

  m = Create("b_", squeezed);
  CHECK(!PetscOptionsSetValue(NULL, "-b_lower_bc_normal", "left,botom"));
  CHECK_MISTAKE(MortiseSetFromOptions(m), "-lower_bc_normal", "botom");
  CHECK(!PetscOptionsSetValue(NULL, "-b_lower_bc_normal", "left,bottom"));
  CHECK(!MortiseSetFromOptions(m));
  CHECK(!MortiseSolve(m));
  CHECK(!MortiseDestroy(&m));

  m = Create("c_", squeezed);
  CHECK(!PetscOptionsSetValue(NULL, "-c_probe_above_at", "7,7"));
  CHECK(!MortiseSetFromOptions(m));
  CHECK_MISTAKE(MortiseSetUp(m), "probe", "7");
  CHECK_MISTAKE(MortiseSolve(m), "probe", "7");
  CHECK(!MortiseDestroy(&m));
}

/* A mesh is made once, and cannot depend on time. */
static void CheckTime(void)
{
  Mortise m = Create("t_", squeezed);

  CHECK(!PetscOptionsSetValue(NULL, "-t_upper_map", "x*t,y"));
  CHECK(!MortiseSetFromOptions(m));
  CHECK_MISTAKE(MortiseSetUp(m), "-upper_map", "time t");
  CHECK(!MortiseDestroy(&m));
}

/* Mistakes that only the solver finds, some of them by PETSc. */
static void CheckSolver(void)
{
  Mortise m = Create("d_", squeezed);

  CHECK(!PetscOptionsSetValue(NULL, "-d_snes_pdas_c", "-1"));
  CHECK(!MortiseSetFromOptions(m));
  CHECK_MISTAKE(MortiseSolve(m), "-snes_pdas_c", "positive");
  CHECK(!MortiseDestroy(&m));

  m = Create("e_", squeezed);
  CHECK(!PetscOptionsSetValue(NULL, "-e_snes_max_it", "many"));
  CHECK(!MortiseSetFromOptions(m));
  CHECK_MISTAKE(MortiseSolve(m), "PETSc", "many");
  CHECK(!MortiseDestroy(&m));

  m = Create("f_", squeezed);
  CHECK(!PetscOptionsSetValue(NULL, "-f_ksp_nonsense", "1"));
  CHECK(!MortiseSetFromOptions(m));
  CHECK_MISTAKE(MortiseSolve(m), "-ksp_nonsense", "nothing reads");
  CHECK(!MortiseDestroy(&m));
}

/* Mistakes of the caller. */
static void CheckCalls(void)
{
  const PetscReal values[] = {0, NAN, 0};
  Mortise         m        = Create("g_", squeezed);
  const char     *text;
  PetscReal       number, force[3];
  Vec             v;
  DM              dm;
  int             status;

  CHECK(!MortiseSetFromOptions(m));
  CHECK_MISTAKE(MortiseGetStatus(m, &status), "MortiseGetStatus()", "MortiseSolve()");
  CHECK_MISTAKE(MortiseGetDM(m, &dm), "MortiseGetDM()", "MortiseSetUp()");
  CHECK_MISTAKE(MortiseGetDisplacement(m, &v), "MortiseGetDisplacement()", "MortiseSolve()");
  CHECK_MISTAKE(MortiseSetDatum(m, "-upper_bc_displacement_tpo", 2, values), "tpo", "-upper_bc_displacement_top");
  CHECK_MISTAKE(MortiseSetDatum(m, "-upper_young", 1, values), "-upper_young", "no load");
  CHECK_MISTAKE(MortiseSetDatum(m, "-upper_bc_displacement_top", 3, values), "3 numbers", "2 wanted");
  CHECK_MISTAKE(MortiseSetDatum(m, "-upper_bc_displacement_top", 2, values), "component 2", "finite");
  CHECK(!MortiseSolve(m));
  CHECK_MISTAKE(MortiseGetPressure(m, "jiont", &v), "jiont", "joint");
  CHECK_MISTAKE(MortiseGetNumbers(m, "pairs/joint/colour", 1, &number), "pairs/joint/colour", "nothing");
  CHECK_MISTAKE(MortiseGetNumbers(m, "pairs/joint/force", 1, &number), "pairs/joint/force", "2");
  CHECK_MISTAKE(MortiseGetNumbers(m, "pairs/joint/force/2", 1, &number), "pairs/joint/force/2", "nothing");
  CHECK_MISTAKE(MortiseGetNumbers(m, "pairs/joint/patches/0/centre/x", 1, &number), "centre/x", "nothing");
  CHECK_MISTAKE(MortiseGetNumbers(m, "pairs/joint/patches", 1, &number), "pairs/joint/patches", "there are 0");
  CHECK_MISTAKE(MortiseGetNumbers(m, "status", 1, &number), "status", "there are 0");
  CHECK_MISTAKE(MortiseSetTime(m, NAN), "MortiseSetTime()", "finite");
  CHECK(!MortiseGetPairForce(m, "joint", force, NULL));
  CHECK_NEAR(force[1], 1e6, 1e-2);
  CHECK(!MortiseGetSummary(m, &text));
  CHECK(!MortiseDestroy(&m));
}

/* A scene without a solution is no mistake; it has no fields. */
static void CheckNoSolution(void)
{
  Mortise            m = Create("h_", pulled);
  MortiseCertificate certificate;
  const char        *text;
  PetscReal          force[3];
  Vec                v;
  int                status;

  CHECK(!MortiseSetFromOptions(m));
  CHECK(!MortiseSolve(m));
  CHECK(!MortiseGetStatus(m, &status));
  CHECK(status == MORTISE_STATUS_NO_SOLUTION);
  CHECK(!MortiseGetReason(m, &text));
  CHECK(strstr(text, "no solution"));
  CHECK_MISTAKE(MortiseGetDisplacement(m, &v), "MortiseGetDisplacement()", "no solution");
  CHECK(!MortiseGetPairForce(m, "floor", force, NULL));
  CHECK(PetscIsNanReal(force[1]));
  CHECK(!MortiseGetCertificate(m, &certificate));
  CHECK(!certificate.holds && PetscIsNanReal(certificate.friction));
  CHECK(!MortiseGetSummary(m, &text));
  CHECK(strstr(text, "no_solution"));
  CHECK(!MortiseDestroy(&m));
}

/* A program that passes errors on hears no trace. */
static PetscErrorCode PassOn(void)
{
  Mortise m;

  PetscFunctionBeginUser;
  PetscCall(MortiseCreate(PETSC_COMM_WORLD, &m));
  PetscCall(MortiseInsertFile(m, "nowhere.opts"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A handle, a name or a vector that is none. */
static void CheckNames(void)
{
  Mortise        m = Create("n_", squeezed), none = NULL;
  const PetscInt rank_has = 7;
  Vec            v;

  CHECK_MISTAKE(MortiseSetOptionsPrefix(none, "a_"), "MortiseSetOptionsPrefix()", "NULL");
  CHECK_MISTAKE(MortiseInsertFile(none, squeezed), "MortiseInsertFile()", "NULL");
  CHECK_MISTAKE(MortiseSetFromOptions(none), "MortiseSetFromOptions()", "MortiseCreate()");
  CHECK_MISTAKE(MortiseSolve(none), "MortiseSolve()", "MortiseCreate()");
  CHECK_MISTAKE(MortiseGetPressure(none, "joint", &v), "MortiseGetPressure()", "MortiseCreate()");
  CHECK(!MortiseDestroy(&none));
  CHECK_MISTAKE(MortiseInsertFile(m, NULL), "MortiseInsertFile()", "file is NULL");
  CHECK(!MortiseSetFromOptions(m));
  CHECK_MISTAKE(MortiseSetDatum(m, NULL, 0, NULL), "MortiseSetDatum()", "option is NULL");
  CHECK(!VecCreateMPI(PETSC_COMM_WORLD, rank_has, PETSC_DETERMINE, &v));
  CHECK_MISTAKE(MortiseSetInitialGuess(m, v), "MortiseSetInitialGuess()", "7 numbers");
  CHECK(!VecDestroy(&v));
  CHECK(!MortiseSolve(m));
  CHECK_MISTAKE(MortiseGetPressure(m, NULL, &v), "MortiseGetPressure()", "pair is NULL");
  CHECK_MISTAKE(MortiseGetNumbers(m, NULL, 0, NULL), "MortiseGetNumbers()", "number is NULL");
  CHECK(!MortiseDestroy(&m));
}

/* Calls before MortiseInitialize() and after MortiseFinalize(), whether MPI runs or not. */
static void CheckNoLibrary(void)
{
  Mortise m = NULL;
  int     status;

  CHECK_MISTAKE(MortiseCreate(MPI_COMM_WORLD, &m), "MortiseCreate()", "MortiseInitialize()");
  CHECK_MISTAKE(MortiseSetFromOptions(m), "MortiseSetFromOptions()", "MortiseInitialize()");
  CHECK_MISTAKE(MortiseGetStatus(m, &status), "MortiseGetStatus()", "MortiseInitialize()");
}

int main(int argc, char **argv)
{
  int own = 1; // the folders are no options

  CheckNoLibrary();
  MPI_Init(&argc, &argv);
  CheckNoLibrary();
  CHECK(!MortiseInitialize(&own, &argv));
  CHECK(!MortiseInitialize(NULL, NULL));
  snprintf(squeezed, sizeof(squeezed), "%s/patch2d.opts", argv[1]);
  snprintf(pulled, sizeof(pulled), "%s/pulled.opts", argv[2]);
  CHECK_MISTAKE(PassOn(), "nowhere.opts", "no such file");
  CheckOptions();
  CheckTime();
  CheckSolver();
  CheckCalls();
  CheckNoSolution();
  CheckNames();
  CHECK(!MortiseFinalize());
  CHECK(!MortiseFinalize());
  CheckNoLibrary();
  MPI_Finalize();
  CheckNoLibrary();
  CHECK_MISTAKE(MortiseInitialize(&own, &argv), "MortiseInitialize()", "MPI has ended");
  return 0;
}

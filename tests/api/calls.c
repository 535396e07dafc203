/* calls.c -- every function of the interface, in a program that has started PETSc itself. Two handles with
   options of their own, used in turn, give the numbers that statics says; nothing is left behind
   (-malloc_dump).

   calls <folder of scenes> */
#include <math.h>
#include <mortise.h>
#include <stdio.h>
#include <string.h>
#include "test.h"

/* The patch test squeezes with 1e6 at t = 1, and its top goes down by this. */
static const PetscReal SQUEEZE = 1e6, SHIFT = 1.37875e-3, TIGHT = 1e-8;

/* Creates a handle with a prefix, and reads a scene. */
static PetscErrorCode Read(const char folder[], const char scene[], const char prefix[], Mortise *m)
{
  char path[PETSC_MAX_PATH_LEN];

  PetscFunctionBeginUser;
  PetscCall(PetscSNPrintf(path, sizeof(path), "%s/%s", folder, scene));
  PetscCall(MortiseCreate(PETSC_COMM_WORLD, m));
  PetscCall(MortiseSetOptionsPrefix(*m, prefix));
  PetscCall(MortiseInsertFile(*m, path));
  PetscCall(MortiseSetFromOptions(*m));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Solves at a time; the force on the upper body is x, y. */
static PetscErrorCode Expect(Mortise m, const char pair[], PetscReal t, PetscReal x, PetscReal y)
{
  PetscReal force[3], normal, strain, potential, reaction[2], size = PetscMax(PetscAbsReal(x), PetscAbsReal(y));
  MortiseCertificate certificate;
  const char        *reason;
  int                status;

  PetscFunctionBeginUser;
  PetscCall(MortiseSetTime(m, t));
  PetscCall(MortiseSolve(m));
  PetscCall(MortiseGetStatus(m, &status));
  CHECK(status == MORTISE_STATUS_SOLVED);
  PetscCall(MortiseGetReason(m, &reason));
  CHECK(!reason[0]);
  PetscCall(MortiseGetPairForce(m, pair, force, &normal));
  CHECK_NEAR(force[0], x, TIGHT * size);
  CHECK_NEAR(force[1], y, TIGHT * size);
  CHECK(force[2] == 0);
  PetscCall(MortiseGetEnergy(m, &strain, &potential));
  CHECK(strain > 0);
  PetscCall(MortiseGetCertificate(m, &certificate));
  CHECK(certificate.holds && certificate.equilibrium <= certificate.limit);
  PetscCall(MortiseGetNumbers(m, "reactions/upper:top", 2, reaction));
  PetscCall(MortiseGetNumbers(m, "energy/potential", 1, &reaction[0]));
  CHECK_NEAR(reaction[0], potential, TIGHT * PetscAbsReal(potential));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Nodal values of the squeezed bodies: pressure on the nonmortar side, closed gaps, the top at its place. */
static PetscErrorCode CheckFields(Mortise m)
{
  Vec             u, x, p, g;
  DM              dm;
  PetscInt        dim, num, closed = 0, size_u, size_x;
  PetscReal       largest, lowest, force[2];
  const PetscInt *status;
  PetscBool       plex;

  PetscFunctionBeginUser;
  PetscCall(MortiseGetDM(m, &dm));
  PetscCall(PetscObjectTypeCompare((PetscObject)dm, "plex", &plex));
  PetscCall(DMGetDimension(dm, &dim));
  CHECK(plex && dim == 2);
  PetscCall(MortiseGetDisplacement(m, &u));
  PetscCall(MortiseGetCoordinates(m, &x));
  PetscCall(MortiseGetPressure(m, "joint", &p));
  PetscCall(MortiseGetGap(m, "joint", &g));
  PetscCall(MortiseGetPairStatus(m, "joint", &num, &status));
  PetscCall(VecGetSize(u, &size_u));
  PetscCall(VecGetSize(x, &size_x));
  CHECK(size_u == size_x && size_u > 0);
  PetscCall(VecMax(p, NULL, &largest));
  CHECK_NEAR(largest, SQUEEZE, TIGHT * SQUEEZE);
  PetscCall(VecMin(u, NULL, &lowest));
  CHECK_NEAR(lowest, -SHIFT, TIGHT * SHIFT);
  PetscCall(VecMax(x, NULL, &largest));
  CHECK_NEAR(largest, 1, TIGHT);
  for (PetscInt i = 0; i < num; ++i) closed += status[i] == MORTISE_NODE_CONTACT;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &closed, 1, MPIU_INT, MPI_SUM, PETSC_COMM_WORLD));
  CHECK(closed == 6);                                                       // six nodes on the side of five facets
  PetscCall(MortiseGetNumbers(m, "pairs/joint/patches/0/force", 2, force)); // the only one
  CHECK_NEAR(force[1], SQUEEZE, TIGHT * SQUEEZE);
  PetscCall(MortiseGetNumbers(m, "pairs/joint/patches/0/force/1", 1, force));
  CHECK_NEAR(force[0], SQUEEZE, TIGHT * SQUEEZE);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Summary, lines and a second call of everything that is kept. */
static PetscErrorCode CheckText(Mortise m)
{
  const char *json, *again, *versions;

  PetscFunctionBeginUser;
  PetscCall(MortiseGetSummary(m, &json));
  CHECK(strstr(json, "\"status\":\t\"solved\"") && strstr(json, "\"upper_young\":\t\"1e9\""));
  PetscCall(MortiseGetSummary(m, &again));
  CHECK(json == again);
  PetscCall(MortiseGetVersions(&versions));
  CHECK(strstr(versions, "mortise ") == versions && strstr(versions, "PETSc "));
  PetscCall(MortiseView(m, NULL));
  PetscCall(MortiseView(m, PETSC_VIEWER_STDOUT_WORLD));
  PetscCall(MortiseWrite(m));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A value of the caller, and a start of the caller, give what they must. */
static PetscErrorCode CheckSetters(Mortise m)
{
  const PetscReal twice[] = {17, -2 * SHIFT}; // the first is free in the scene
  PetscReal       solver[1];
  Vec             u, copy;

  PetscFunctionBeginUser;
  PetscCall(MortiseGetDisplacement(m, &u));
  PetscCall(VecDuplicate(u, &copy));
  PetscCall(VecCopy(u, copy));
  PetscCall(MortiseSetDatum(m, "-upper_bc_displacement_top", 2, twice));
  PetscCall(MortiseSetInitialGuess(m, copy));
  PetscCall(Expect(m, "joint", 1, 0, 2 * SQUEEZE));
  PetscCall(MortiseSetInitialGuess(m, NULL));
  PetscCall(Expect(m, "joint", 0.25, 0, 0.5 * SQUEEZE));
  PetscCall(MortiseGetNumbers(m, "solver/iterations", 1, solver));
  CHECK(solver[0] >= 1);
  PetscCall(VecDestroy(&copy));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A formula that names t: time is no load factor then. */
static PetscErrorCode CheckTime(const char folder[])
{
  Mortise m;

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsSetValue(NULL, "-timed_upper_bc_displacement_top", "free,-1.37875e-3*t^2"));
  PetscCall(Read(folder, "patch2d.opts", "timed_", &m));
  PetscCall(Expect(m, "joint", 0.5, 0, 0.25 * SQUEEZE));
  PetscCall(Expect(m, "joint", 2, 0, 4 * SQUEEZE));
  PetscCall(MortiseDestroy(&m));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A block on an inclined plane: all 17 nodes of its lower side are in contact; some slide, the others stay. */
static PetscErrorCode CheckFriction(const char folder[])
{
  Mortise            m;
  MortiseCertificate certificate;
  const PetscInt    *status;
  PetscInt           num, count[2] = {0, 0};

  PetscFunctionBeginUser;
  PetscCall(Read(folder, "incline.opts", "incline_", &m));
  PetscCall(MortiseSolve(m));
  PetscCall(MortiseGetPairStatus(m, "floor", &num, &status));
  for (PetscInt i = 0; i < num; ++i) {
    count[0] += status[i] == MORTISE_NODE_SLIP;
    count[1] += status[i] == MORTISE_NODE_STICK;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, count, 2, MPIU_INT, MPI_SUM, PETSC_COMM_WORLD));
  CHECK(count[0] > 0 && count[1] > 0 && count[0] + count[1] == 17);
  PetscCall(MortiseGetCertificate(m, &certificate));
  CHECK(certificate.holds && certificate.friction > 0 && certificate.friction <= certificate.limit);
  PetscCall(MortiseDestroy(&m));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Each handle has its own warnings: bodies that are much too soft, beside the squeezed ones. */
static PetscErrorCode CheckWarnings(const char folder[])
{
  Mortise     soft, plain;
  const char *json;

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsSetValue(NULL, "-soft_upper_young", "1e7"));
  PetscCall(PetscOptionsSetValue(NULL, "-soft_upper_dm_plex_box_faces", "4,4"));
  PetscCall(PetscOptionsSetValue(NULL, "-soft_lower_dm_plex_box_faces", "3,3"));
  PetscCall(PetscOptionsSetValue(NULL, "-soft_quiet", NULL));
  PetscCall(Read(folder, "two_plates.opts", "soft_", &soft));
  PetscCall(Read(folder, "patch2d.opts", "plain_", &plain));
  PetscCall(MortiseSolve(soft));
  PetscCall(MortiseSolve(plain));
  PetscCall(MortiseGetSummary(soft, &json));
  CHECK(strstr(json, "\"model_limit\""));
  PetscCall(MortiseGetSummary(plain, &json));
  CHECK(!strstr(json, "\"model_limit\"") && strstr(json, "\"warnings\":\t[]"));
  PetscCall(MortiseDestroy(&soft));
  PetscCall(MortiseDestroy(&plain));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Without a prefix the scene's options are those of PETSc's database, where what is there already wins. */
static PetscErrorCode CheckDatabase(const char folder[])
{
  Mortise     m;
  char        path[PETSC_MAX_PATH_LEN];
  const char *json;

  PetscFunctionBeginUser;
  PetscCall(PetscSNPrintf(path, sizeof(path), "%s/patch2d.opts", folder));
  PetscCall(PetscOptionsSetValue(NULL, "-upper_bc_displacement_top", "free,-2.7575e-3"));
  PetscCall(MortiseCreate(PETSC_COMM_WORLD, &m));
  PetscCall(MortiseInsertFile(m, path));
  PetscCall(MortiseSetFromOptions(m));
  PetscCall(Expect(m, "joint", 1, 0, 2 * SQUEEZE));
  PetscCall(MortiseGetSummary(m, &json));
  CHECK(strstr(json, "\"upper_bc_displacement_top\":\t\"free,-2.7575e-3\"") &&
        strstr(json, "\"title\":\t\"Patch test\""));
  PetscCall(MortiseDestroy(&m));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Run(const char folder[])
{
  Mortise   squeezed, glued;
  Vec       x;
  PetscInt  size;
  PetscBool used;

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsSetValue(NULL, "-squeezed_order", "2")); // of one handle alone
  PetscCall(PetscOptionsSetValue(NULL, "-something_else", "1")); // of neither
  PetscCall(Read(folder, "patch2d.opts", "squeezed_", &squeezed));
  PetscCall(Read(folder, "tied.opts", "glued_", &glued));
  PetscCall(PetscOptionsUsed(NULL, "squeezed_order", &used));
  CHECK(used);
  PetscCall(MortiseSetUp(glued));
  PetscCall(MortiseGetCoordinates(glued, &x));
  PetscCall(VecGetSize(x, &size));
  CHECK(size == 2 * (8 * 7 + 6 * 6)); // of order 1
  for (PetscInt step = 1; step <= 4; ++step) {
    const PetscReal t = step / 4.;

    PetscCall(Expect(squeezed, "joint", t, 0, t * SQUEEZE));
    PetscCall(Expect(glued, "glue", t, t * -1153846.153846, t * -2692307.692308));
  }
  PetscCall(MortiseDestroy(&squeezed));
  PetscCall(PetscOptionsClearValue(NULL, "-squeezed_order"));
  PetscCall(Read(folder, "patch2d.opts", "squeezed_", &squeezed));
  PetscCall(Expect(squeezed, "joint", 1, 0, SQUEEZE));
  PetscCall(CheckFields(squeezed));
  PetscCall(CheckText(squeezed));
  PetscCall(CheckSetters(squeezed));
  PetscCall(MortiseDestroy(&squeezed));
  PetscCall(MortiseDestroy(&squeezed));
  PetscCall(MortiseDestroy(&glued));
  PetscCall(CheckTime(folder));
  PetscCall(CheckFriction(folder));
  PetscCall(CheckWarnings(folder));
  PetscCall(PetscOptionsClearValue(NULL, "-something_else"));
  PetscCall(CheckDatabase(folder));
  PetscFunctionReturn(PETSC_SUCCESS);
}

int main(int argc, char **argv)
{
  PetscErrorCode error;

  if (PetscInitialize(&argc, &argv, NULL, NULL)) return 4;
  error = MortiseInitialize(NULL, NULL);
  if (!error) error = Run(argv[1]);
  if (!error) error = MortiseFinalize();
  if (!error) error = MortiseInitialize(&argc, &argv); // and once more
  if (!error) error = MortiseFinalize();
  if (!error) error = PetscFinalize();
  return error ? 1 : 0;
}

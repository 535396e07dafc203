/* test_extend.c -- a run that goes on from that of a coarser adapted mesh has its solution. Its multigrid
   needs no more iterations, on any number of ranks. */
#include "base/compat.h"
#include <petscmat.h>
#include "pdas/pdas.h"
#include "study/run.h"
#include "test.h"

enum { STEPS = SANITIZED ? 3 : 7, MAX_ITERATIONS = 18 }; // 12 in the straight scene, 17 in the curved one

static const char *const Common[] = {"-bodies",
                                     "upper,lower",
                                     "-upper_dm_plex_box_faces",
                                     "2,2",
                                     "-upper_dm_plex_box_upper",
                                     "1,1",
                                     "-upper_young",
                                     "8",
                                     "-upper_poisson",
                                     "0.3",
                                     "-lower_dm_plex_box_faces",
                                     "3,2",
                                     "-lower_dm_plex_box_lower",
                                     "0,-1",
                                     "-lower_dm_plex_box_upper",
                                     "1,0",
                                     "-lower_young",
                                     "8",
                                     "-lower_poisson",
                                     "0.3",
                                     "-lower_bc_displacement",
                                     "bottom",
                                     "-lower_bc_displacement_bottom",
                                     "0,0",
                                     "-pairs",
                                     "joint",
                                     "-joint_nonmortar",
                                     "upper:bottom",
                                     "-joint_mortar",
                                     "lower:top",
                                     "-pc_type",
                                     "truncatedmg",
                                     "-quiet",
                                     "1",
                                     NULL};

static const char *const Held[]   = {"-order",      "2", "-upper_bc_displacement", "top", "-upper_bc_displacement_top",
                                     "0.001,-0.01", NULL};
static const char *const Curved[] = {
    "-order",  "2",          "-upper_bc_displacement",   "top", "-upper_bc_displacement_top",
    "0,-0.02", "-upper_map", "x, y+0.3*(1-y)*(x-0.5)^2", NULL};
/* Contact alone holds the upper body upright. */
static const char *const Loose[] = {
    "-order",  "1", "-upper_bc_displacement", "left", "-upper_bc_displacement_left", "0,free", "-upper_body_force",
    "0,-0.01", NULL};

static void SetOptions(const char *const options[])
{
  for (int i = 0; options[i]; i += 2) CHECK(!PetscOptionsSetValue(NULL, options[i], options[i + 1]));
}

/* Cells near the right end of contact. */
static void Adapt(Mesh mesh)
{
  const Level *level = MeshFinest(mesh);
  PetscInt    *marked;

  CHECK(!PetscMalloc1(level->num_cells, &marked));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    PetscReal nearest = PETSC_MAX_REAL;

    for (PetscInt i = 0; i < 3; i++) {
      const PetscReal *x = &level->coords[2 * level->cell_nodes[level->cell_start[c] + i]];

      nearest = PetscMin(nearest, PetscSqr(x[0] - 1) + PetscSqr(x[1]));
    }
    marked[c] = (PetscBool)(nearest < 2. * PetscPowReal(.45, (PetscReal)mesh->num_levels));
  }
  CHECK(!MeshAdapt(mesh, marked));
  CHECK(!PetscFree(marked));
}

/* The displacement of a run on the next level. */
static Vec Prolong(Mesh mesh, Vec u)
{
  Vec guess;
  Mat P;

  CHECK(!LevelCreateVec(MeshFinest(mesh), 2, &guess));
  CHECK(!MatCreateMAIJ(MeshFinest(mesh)->prolongation, 2, &P));
  CHECK(!MatMult(P, u, guess));
  CHECK(!VecGhostUpdateBegin(guess, INSERT_VALUES, SCATTER_FORWARD));
  CHECK(!VecGhostUpdateEnd(guess, INSERT_VALUES, SCATTER_FORWARD));
  CHECK(!MatDestroy(&P));
  return guess;
}

static void CheckSame(Vec u, Vec v)
{
  PetscReal size, difference;

  CHECK(!VecNorm(u, NORM_INFINITY, &size));
  CHECK(!VecAXPY(v, -1, u));
  CHECK(!VecNorm(v, NORM_INFINITY, &difference));
  CHECK(size > 0);
  CHECK_NEAR(difference / size, 0, 1e-8);
}

static void TestScene(const char *const options[])
{
  Scene scene;
  Mesh  mesh;
  Run   run, fresh;

  CHECK(!PetscOptionsClear(NULL));
  SetOptions(Common);
  SetOptions(options);
  CHECK(!SceneCreate(PETSC_COMM_WORLD, &scene));
  CHECK(!SceneSetFromOptions(scene));
  scene->adapt.on       = PETSC_TRUE;
  scene->measure_linear = PETSC_TRUE;
  CHECK(!MeshCreate(scene, &mesh));
  CHECK(!MeshSetUp(mesh));
  CHECK(!RunCreate(scene, mesh, NULL, &run));
  for (PetscInt step = 0; step < STEPS; step++) {
    Vec guess;

    CHECK(run->solved);
    Adapt(mesh);
    guess = Prolong(mesh, run->fields->u);
    CHECK(!RunExtend(guess, &run));
    CHECK(!VecDestroy(&guess));
    CHECK(run->report.reference.done);
    CHECK(run->report.reference.iterations <= MAX_ITERATIONS);
  }
  CHECK(!RunCreate(scene, mesh, NULL, &fresh));
  CHECK(fresh->solved);
  CHECK(run->report.active == fresh->report.active);
  CHECK(PetscAbs(run->report.reference.iterations - fresh->report.reference.iterations) <= 1);
  CheckSame(run->fields->u, fresh->fields->u);
  CHECK(!RunDestroy(&fresh));
  CHECK(!RunDestroy(&run));
  CHECK(!MeshDestroy(&mesh));
  CHECK(!SceneDestroy(&scene));
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(PDASRegister());
  TestScene(Held);
  TestScene(Curved);
  TestScene(Loose);
  PetscCall(PetscFinalize());
  return 0;
}

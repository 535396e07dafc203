/* test_adaptpatch.c -- patch tests on adapted meshes, on any number of ranks. Where the space holds the
   solution, cells bisected or split at random change nothing in it. The estimate is rounding, and the
   certificate holds on every mesh. */
#include "base/compat.h"
#include "pdas/pdas.h"
#include "result/estimate.h"
#include "study/promotion.h"
#include "study/run.h"
#include "test.h"
#include <math.h>

/* Adapted meshes. [kept][dim] */
static const PetscInt  NumSteps[2][4] = {{[2] = 4, [3] = 2}, {[2] = 4, [3] = 3}};
static const PetscReal PART[2][4] = {{[2] = .25, [3] = .06}, {[2] = .25, [3] = .12}}; // of the cells that are marked

/* Two blocks one above the other, pressed together by 1, free to widen. The last axis is across the contact. */
static const char *const Common[] = {"-bodies",
                                     "upper,lower",
                                     "-upper_young",
                                     "8",
                                     "-upper_poisson",
                                     "0.3",
                                     "-lower_young",
                                     "0.5",
                                     "-lower_poisson",
                                     "0.2",
                                     "-pairs",
                                     "joint",
                                     "-joint_nonmortar",
                                     "upper:bottom",
                                     "-joint_mortar",
                                     "lower:top",
                                     "-quiet",
                                     "1",
                                     "-upper_bc_pressure",
                                     "top",
                                     "-upper_bc_pressure_top",
                                     "1",
                                     NULL};
static const char *const Plane[]  = {"-upper_dm_plex_box_faces",
                                     "3,2",
                                     "-lower_dm_plex_box_faces",
                                     "2,2",
                                     "-lower_dm_plex_box_lower",
                                     "0,-1",
                                     "-lower_dm_plex_box_upper",
                                     "1,0",
                                     "-upper_bc_normal",
                                     "left",
                                     "-lower_bc_normal",
                                     "left,bottom",
                                     NULL};
static const char *const Space[]  = {"-model",
                                     "solid",
                                     "-upper_dm_plex_box_faces",
                                     "2,2,1",
                                     "-lower_dm_plex_box_faces",
                                     "1,2,1",
                                     "-lower_dm_plex_box_lower",
                                     "0,0,-1",
                                     "-lower_dm_plex_box_upper",
                                     "1,1,0",
                                     "-upper_bc_normal",
                                     "left,front",
                                     "-lower_bc_normal",
                                     "left,front,bottom",
                                     NULL};

static void SetOptions(const char *const options[])
{
  for (int i = 0; options[i]; i += 2) CHECK(!PetscOptionsSetValue(NULL, options[i], options[i + 1]));
}

/* Cells by a hash of their middle. */
static void Adapt(Mesh mesh, PetscBool kept)
{
  const Level *level = MeshFinest(mesh);
  const int    dim   = (int)level->dim;
  PetscInt    *marked;

  CHECK(!PetscMalloc1(level->num_cells, &marked));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    PetscReal phase = (PetscReal)mesh->num_levels;

    for (PetscInt i = 0; i <= dim; i++) {
      const PetscReal *x = &level->coords[dim * level->cell_nodes[level->cell_start[c] + i]];

      for (int d = 0; d < dim; d++) phase += (12.9898 + 65.2 * d) * x[d];
    }
    marked[c] = (PetscBool)(fabs(fmod(1e4 * sin(phase), 1)) < PART[kept][dim]);
  }
  CHECK(!MeshAdapt(mesh, marked));
  CHECK(!PetscFree(marked));
}

/* Compresses both by the pressure 1: in the plane strain is plane, in space stress is uniaxial. */
static PetscReal Exact(PetscInt dim, PetscInt body, const PetscReal x[], PetscInt direction)
{
  const PetscReal young[2] = {8, .5}, poisson[2] = {.3, .2};
  PetscReal       along[2], across[2];

  for (int b = 0; b < 2; b++) {
    along[b]  = dim == 2 ? (1 - poisson[b] * poisson[b]) / young[b] : 1 / young[b];
    across[b] = dim == 2 ? poisson[b] * (1 + poisson[b]) / young[b] : poisson[b] / young[b];
  }
  if (direction < dim - 1) return across[body] * x[direction];
  return body ? -along[1] * (x[direction] + 1) : -along[1] - along[0] * x[direction];
}

static void CheckExact(Run run)
{
  const Level       *level = run->vi->level;
  const PetscInt     dim   = level->dim;
  const PetscScalar *u;
  Estimate           estimate;
  PetscReal          error = 0;
  Vec                local;

  CHECK(run->solved && run->certificate.holds);
  CHECK(!VecGhostGetLocalForm(run->fields->u, &local));
  CHECK(!VecGetArrayRead(local, &u));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    for (PetscInt i = level->cell_start[c]; i < level->cell_start[c + 1]; i++) {
      const PetscInt n = level->cell_nodes[i];

      for (PetscInt d = 0; d < dim; d++)
        error = PetscMax(error,
                         PetscAbsScalar(u[n * dim + d] - Exact(dim, level->cell_body[c], &level->coords[n * dim], d)));
    }
  }
  CHECK(!VecRestoreArrayRead(local, &u));
  CHECK(!VecGhostRestoreLocalForm(run->fields->u, &local));
  CHECK(!MPI_Allreduce(MPI_IN_PLACE, &error, 1, MPIU_REAL, MPIU_MAX, level->comm));
  CHECK_NEAR(error, 0, 2e-12); // of the largest displacement, 2
  CHECK(!EstimateGet(run->fields, &estimate));
  CHECK(estimate->norm > 0);
  CHECK_NEAR(PetscSqrtReal(estimate->squared / estimate->norm), 0, 1e-10);
}

static void TestScene(const char *const options[], const char order[], PetscBool kept)
{
  Scene    scene;
  Mesh     mesh;
  Run      run;
  PetscInt num_steps, first, last;

  CHECK(!PetscOptionsClear(NULL));
  SetOptions(Common);
  SetOptions(options);
  CHECK(!PetscOptionsSetValue(NULL, "-order", order));
  CHECK(!PetscOptionsSetValue(NULL, "-upper_dm_plex_simplex", kept ? "0" : "1"));
  CHECK(!PetscOptionsSetValue(NULL, "-lower_dm_plex_simplex", kept ? "0" : "1"));
  CHECK(!SceneCreate(PETSC_COMM_WORLD, &scene));
  CHECK(!SceneSetFromOptions(scene));
  scene->adapt.on   = PETSC_TRUE;
  scene->adapt.kept = kept;
  CHECK(!MeshCreate(scene, &mesh));
  CHECK(!MeshSetUp(mesh));
  CHECK(!RunCreate(scene, mesh, NULL, &run));
  num_steps = NumSteps[kept][scene->dim] / (SANITIZED ? 2 : 1);
  first     = MeshFinest(mesh)->num_global;
  CheckExact(run);
  for (PetscInt step = 0; step < num_steps; step++) {
    const PetscInt level = mesh->num_levels - 1;
    Vec            guess;

    Adapt(mesh, kept);
    CHECK(!PromotionApply(mesh, level, level + 1, run->fields->u, &guess));
    CHECK(!RunExtend(guess, &run));
    CHECK(!VecDestroy(&guess));
    CheckExact(run);
  }
  last = MeshFinest(mesh)->num_global;
  CHECK((MeshFinest(mesh)->conforming != NULL) == kept);
  CHECK(last > num_steps * first);
  CHECK(!RunDestroy(&run));
  CHECK(!MeshDestroy(&mesh));
  CHECK(!SceneDestroy(&scene));
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(PDASRegister());
  TestScene(Plane, "1", PETSC_FALSE);
  TestScene(Plane, "2", PETSC_FALSE);
  TestScene(Plane, "1", PETSC_TRUE);
  TestScene(Plane, "2", PETSC_TRUE);
  TestScene(Space, "1", PETSC_FALSE);
  TestScene(Space, "2", PETSC_FALSE);
  TestScene(Space, "1", PETSC_TRUE);
  TestScene(Space, "2", PETSC_TRUE);
  PetscCall(PetscFinalize());
  return 0;
}

/* loop.c -- what adaptive meshes cost beside one solve on the last of them: adaptive.py --loop runs it.

   Reads a scene with -adapt as the program does, and makes the same meshes. Prints a line for each: unknowns,
   sets and iterations, and seconds of the processor. These are for the mesh, the solve with all that belongs
   to it, and the estimate with its marks. Then it solves on the last mesh from nothing. With -measure_linear
   1, iterations are those of one system of the final set from zero to 1e-8, and seconds hold them, too. */
#include "base/compat.h"
#include "base/warning.h"
#include "pdas/pdas.h"
#include "result/estimate.h"
#include "study/marking.h"
#include "study/promotion.h"
#include "study/run.h"
#include <stdio.h>
#include <time.h>

enum { MESH, SOLVE, ESTIMATE, NUM_PARTS };

typedef struct {
  PetscInt  unknowns, sum;
  PetscReal seconds[NUM_PARTS], all[NUM_PARTS];
} Loop;

/* Adds the seconds since the last call to a part. */
static void Spend(Loop *loop, int part, clock_t *begin)
{
  const clock_t now = clock();

  loop->seconds[part] += (PetscReal)(now - *begin) / CLOCKS_PER_SEC;
  loop->all[part] += (PetscReal)(now - *begin) / CLOCKS_PER_SEC;
  *begin = now;
}

static void Print(Loop *loop, const Run run)
{
  const SolverReport *report = &run->report;

  printf("mesh unknowns %d sets %d iterations %d mesh_seconds %.3f solve_seconds %.3f estimate_seconds %.3f\n",
         (int)loop->unknowns, (int)report->iterations,
         (int)(report->reference.done ? report->reference.iterations : report->linear_iterations), loop->seconds[MESH],
         loop->seconds[SOLVE], loop->seconds[ESTIMATE]);
  for (int i = 0; i < NUM_PARTS; i++) loop->seconds[i] = 0;
}

/* Marks, bisects, prolongs. [out] guess - on the new mesh */
static PetscErrorCode Refine(Loop *loop, Mesh mesh, Run run, Vec *guess)
{
  const PetscInt level = mesh->num_levels - 1;
  PetscInt      *marked;
  Estimate       estimate;
  clock_t        begin = clock();

  PetscFunctionBeginUser;
  PetscCall(EstimateGet(run->fields, &estimate));
  PetscCall(MarkingCreate(&mesh->levels[level], estimate->cell, estimate->norm, mesh->scene->adapt.marking, PETSC_FALSE,
                          &marked, NULL));
  Spend(loop, ESTIMATE, &begin);
  Print(loop, run);
  PetscCall(MeshAdapt(mesh, marked));
  PetscCall(PromotionApply(mesh, level, level + 1, run->fields->u, guess));
  PetscCall(PetscFree(marked));
  Spend(loop, MESH, &begin);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Meshes until the next one would have more unknowns than are allowed. */
static PetscErrorCode Solve(Loop *loop, Scene scene, Mesh mesh, Run *run)
{
  clock_t begin = clock();
  Vec     guess;

  PetscFunctionBeginUser;
  PetscCall(RunCreate(scene, mesh, NULL, run));
  Spend(loop, SOLVE, &begin);
  for (PetscInt before = 0;; before = loop->unknowns) {
    Estimate estimate;

    loop->unknowns = MeshFinest(mesh)->num_global * scene->dim;
    loop->sum += loop->unknowns;
    PetscCall(EstimateDestroy(&(*run)->fields->estimate)); // which the run has for its warnings: here it is timed
    begin = clock();
    PetscCall(EstimateGet((*run)->fields, &estimate));
    Spend(loop, ESTIMATE, &begin);
    if (before && (PetscReal)loop->unknowns / before * loop->unknowns > scene->adapt.max_unknowns) break;
    if (mesh->num_levels >= scene->adapt.max_meshes) break;
    PetscCall(Refine(loop, mesh, *run, &guess));
    begin = clock();
    PetscCall(RunExtend(guess, run));
    PetscCall(VecDestroy(&guess));
    Spend(loop, SOLVE, &begin);
  }
  Print(loop, *run);
  PetscFunctionReturn(PETSC_SUCCESS);
}

int main(int argc, char **argv)
{
  Loop      loop = {0};
  PetscReal all, once;
  Scene     scene;
  Mesh      mesh;
  Run       run, fresh;
  clock_t   begin;

  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(PDASRegister());
  WarningHold();
  begin = clock();
  PetscCall(SceneCreate(PETSC_COMM_WORLD, &scene));
  PetscCall(SceneSetFromOptions(scene));
  PetscCall(MeshCreate(scene, &mesh));
  PetscCall(MeshSetUp(mesh));
  Spend(&loop, MESH, &begin);
  PetscCall(Solve(&loop, scene, mesh, &run));
  all   = loop.all[MESH] + loop.all[SOLVE] + loop.all[ESTIMATE];
  begin = clock();
  PetscCall(RunCreate(scene, mesh, NULL, &fresh));
  once = (PetscReal)(clock() - begin) / CLOCKS_PER_SEC;
  printf("loop unknowns %d sum %.3f seconds %.3f mesh %.4f estimate %.4f once_seconds %.3f once_sets %d over %.3f\n",
         (int)loop.unknowns, (double)loop.sum / (double)loop.unknowns, all, loop.all[MESH] / all,
         loop.all[ESTIMATE] / all, once, (int)fresh->report.iterations, all / once);
  PetscCall(RunDestroy(&fresh));
  PetscCall(RunDestroy(&run));
  PetscCall(MeshDestroy(&mesh));
  PetscCall(SceneDestroy(&scene));
  PetscCall(PetscFinalize());
  return 0;
}

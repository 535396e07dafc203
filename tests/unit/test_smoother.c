/* test_smoother.c -- multigrid on stretched cells, and under a stiff nonmortar side. */
#include "mesh/mesh.h"
#include "pdas/pdas.h"
#include "solve_once.h"
#include "two_boxes.h"
#include "test.h"

/* One box pressed on a wider one. [in] height - of both; [in] young - of the upper one, 1000 for the lower; [in] most - CG iterations */
static PetscErrorCode TestPress(PetscReal height, PetscReal young, PetscInt most)
{
  const PetscReal down[2] = {0, -1e-3}, held[2] = {0, 0};
  struct _n_Scene scene;
  SceneBody       bodies[2];
  ScenePair       pair;
  SceneBoundary   boundaries[2];
  SolverReport    report;
  Mesh            mesh;
  VI              vi;
  Vec             y;

  PetscFunctionBeginUser;
  PetscCall(SetTwoBoxes(&scene, bodies, &pair));
  SetBox(&bodies[0], "upper", 8, 6, 0, 0, 1, height);
  SetBox(&bodies[1], "lower", 9, 6, -0.3, -height, 1.3, 0);
  scene.quiet  = PETSC_TRUE;
  scene.refine = 2;
  PetscCall(ExpressionDestroy(&bodies[0].material.young));
  PetscCall(ConstantCreate("-young", 1, &young, &bodies[0].material.young));
  for (PetscInt b = 0; b < 2; b++) {
    bodies[b].num_boundaries = 1;
    bodies[b].boundaries     = &boundaries[b];
    boundaries[b]            = (SceneBoundary){BOUNDARY_DISPLACEMENT, (char *)(b ? "bottom" : "top"), NULL};
    PetscCall(ConstantCreate("-bc", 2, b ? held : down, &boundaries[b].value));
  }
  PetscCall(MeshCreate(&scene, &mesh));
  PetscCall(MeshSetUp(mesh));
  PetscCall(VICreate(&scene, mesh, &vi));
  PetscCall(VecDuplicate(vi->b, &y));
  PetscCall(SolveOnce(vi, NULL, NULL, y, &report));
  CHECK(report.converged);
  CHECK(report.linear_iterations > 0 && report.linear_iterations <= most);
  PetscCall(VecDestroy(&y));
  PetscCall(VIDestroy(&vi));
  PetscCall(MeshDestroy(&mesh));
  PetscCall(DestroyTwoBoxes(bodies));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(UserErrorInitialize());
  PetscCall(PDASRegister());
  PetscCall(PetscOptionsInsertString(NULL, "-pc_type truncatedmg"));
  PetscCall(TestPress(1, 1e3, 12));    // seen: 9 iterations
  PetscCall(TestPress(1, 1e6, 18));    // 15, with the diagonal alone 32
  PetscCall(TestPress(0.02, 1e3, 12)); // 7, also where three ranks cut lines; with the diagonal alone 111
  PetscCall(PetscFinalize());
  return 0;
}

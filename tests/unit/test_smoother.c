/* test_smoother.c -- multigrid on stretched cells, and under a stiff nonmortar side. */
#include "mesh/mesh.h"
#include "multigrid/bodysmoother.h"
#include "multigrid/eigenvalue.h"
#include "multigrid/smoother.h"
#include "pdas/pdas.h"
#include "solve/meshlevels.h"
#include "solve_once.h"
#include "two_boxes.h"
#include "test.h"

/* M (S + change) M x, M = 0 where fixed */
static PetscErrorCode Multiply(Mat S, Mat change, PetscInt num, const PetscInt fixed[], Vec x, Vec y)
{
  PetscScalar *a;

  PetscFunctionBeginUser;
  PetscCall(VecGetArray(x, &a));
  for (PetscInt i = 0; i < num; i++) a[fixed[i]] = 0;
  PetscCall(VecRestoreArray(x, &a));
  PetscCall(MatMult(S, x, y));
  if (change) PetscCall(MatMultAdd(change, x, y, y));
  PetscCall(VecGetArray(y, &a));
  for (PetscInt i = 0; i < num; i++) a[fixed[i]] = 0;
  PetscCall(VecRestoreArray(y, &a));
  PetscFunctionReturn(0);
}

/* The smoother of a finest level solves with the matrix that those of other levels have, without fixed
   unknowns. It does so body by body, with a change of A, and again without one. */
static PetscErrorCode TestBodies(VI vi)
{
  Operator           op;
  Mat                S = NULL, finest, other, change[3] = {NULL};
  Vec                diagonal, x, y, z;
  PetscReal          error;
  PetscInt           n, num = 0, *fixed;
  const PetscScalar *upper;
  PetscBool          by_body, round = PETSC_FALSE;
  PC                 pc;

  PetscFunctionBeginUser;
  PetscCall(MeshLevelsCreateOperator(&(Inequality){.vi = vi, .A = vi->A, .b = vi->b, .upper = vi->upper}, NULL, &op));
  PetscCall(SmootherCreate(&op, PETSC_TRUE, PETSC_FALSE, &round, &finest));
  PetscCall(SmootherCreate(&op, PETSC_FALSE, PETSC_FALSE, &round, &other));
  PetscCall(BodySmootherIs(finest, &by_body));
  CHECK(by_body && !round);
  PetscCall(SmootherScale(finest, 2));
  PetscCall(SmootherScale(other, 2));
  PetscCall(MatCreateVecs(other, &x, &y));
  PetscCall(VecDuplicate(x, &z));
  PetscCall(MatCreateVecs(other, &diagonal, NULL));
  PetscCall(MatGetDiagonal(other, diagonal));
  PetscCall(MatDuplicate(other, MAT_DO_NOT_COPY_VALUES, &change[1]));
  PetscCall(MatDiagonalSet(change[1], diagonal, INSERT_VALUES));
  PetscCall(VecGetLocalSize(vi->upper, &n));
  PetscCall(PetscMalloc1(2 * n, &fixed));
  PetscCall(VecGetArrayRead(vi->upper, &upper));
  for (PetscInt i = 0; i < n; i++)
    if (PetscRealPart(upper[i]) < PETSC_INFINITY && i % 3 > 0) fixed[num++] = i;
  PetscCall(VecRestoreArrayRead(vi->upper, &upper));
  for (PetscInt i = 0; i < op.num_fixed; i++) fixed[num++] = op.fixed[i];
  CHECK(num > op.num_fixed);
  PetscCall(PCCreate(PETSC_COMM_WORLD, &pc));
  for (int step = 0; step < 3; step++) {
    PetscCall(SmootherSetFixed(&op, finest, change[step], num, fixed, &S));
    PetscCall(PCSetOperators(pc, S, S));
    if (!step) PetscCall(SmootherSetPC(pc, S));
    if (step) PetscCall(SmootherRenew(pc));
    PetscCall(EigenvalueSeed(x));
    PetscCall(Multiply(other, change[step], num, fixed, x, y));
    PetscCall(PCApply(pc, y, z));
    PetscCall(VecAXPY(z, -1, x));
    PetscCall(VecNorm(z, NORM_INFINITY, &error));
    CHECK_NEAR(error, 0, 1e-5); // factors are in single precision
  }
  PetscCall(PCDestroy(&pc));
  PetscCall(PetscFree(fixed));
  PetscCall(MatDestroy(&S));
  PetscCall(MatDestroy(&finest));
  PetscCall(MatDestroy(&other));
  PetscCall(MatDestroy(&change[1]));
  PetscCall(VecDestroy(&diagonal));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&y));
  PetscCall(VecDestroy(&z));
  PetscCall(OperatorDestroy(&op));
  PetscFunctionReturn(0);
}

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
  PetscMPIInt     size;

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
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  if (size == 1 && height < 0.1) PetscCall(TestBodies(vi));
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

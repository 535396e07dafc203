/* test_pair.c -- D, M and gap of a pair: exact numbers, row sums, linear reproduction, slivers, on any number of ranks. */
#include "test.h"
#include "two_boxes.h"

/* D of all multiplier nodes by abscissa, D(x); -1 where no node is there. Collective. */
static PetscReal FindD(Pair pair, PetscReal x)
{
  PetscReal D = -1;

  for (PetscInt k = 0; k < pair->num; k++) {
    if (PetscAbsReal(pair->level->coords[2 * pair->nodes[k]] - x) < 1e-9) D = pair->D[k];
  }
  PetscCallAbort(PETSC_COMM_SELF, MPI_Allreduce(MPI_IN_PLACE, &D, 1, MPIU_REAL, MPIU_MAX, PETSC_COMM_WORLD));
  return D;
}

/* M of the node at xs against the mortar node at xm. Collective. */
static PetscReal FindM(Pair pair, PetscReal xs, PetscReal xm)
{
  PetscReal          M = -PETSC_MAX_REAL, sum, y = 0;
  Vec                v, row;
  const PetscScalar *ra;

  PetscFunctionBeginUser;
  PetscCallAbort(PETSC_COMM_SELF, LevelCreateVec(pair->level, 1, &v));
  PetscCallAbort(PETSC_COMM_SELF, VecDuplicate(v, &row));
  PetscCallAbort(PETSC_COMM_SELF, VecSet(v, 0));
  for (PetscInt i = 0; i < pair->level->num_owned; i++) {
    const PetscReal *x = &pair->level->coords[2 * i];
    if (pair->level->node_body[i] == 1 && PetscAbsReal(x[0] - xm) < 1e-9 && PetscAbsReal(x[1]) < 1e-9)
      PetscCallAbort(PETSC_COMM_SELF, VecSetValue(v, pair->level->node_global[i], 1, INSERT_VALUES));
  }
  PetscCallAbort(PETSC_COMM_SELF, VecAssemblyBegin(v));
  PetscCallAbort(PETSC_COMM_SELF, VecAssemblyEnd(v));
  PetscCallAbort(PETSC_COMM_SELF, MatMult(pair->M, v, row));
  PetscCallAbort(PETSC_COMM_SELF, VecGetArrayRead(row, &ra));
  for (PetscInt k = 0; k < pair->num; k++) {
    if (PetscAbsReal(pair->level->coords[2 * pair->nodes[k]] - xs) < 1e-9) M = ra[pair->nodes[k]];
  }
  PetscCallAbort(PETSC_COMM_SELF, VecRestoreArrayRead(row, &ra));
  PetscCallAbort(PETSC_COMM_SELF, VecDestroy(&row));
  PetscCallAbort(PETSC_COMM_SELF, VecDestroy(&v));
  sum = M;
  PetscCallAbort(PETSC_COMM_SELF, MPI_Allreduce(&sum, &y, 1, MPIU_REAL, MPIU_MAX, PETSC_COMM_WORLD));
  PetscFunctionReturn(y);
}

/* sum_b M_ab (1, x_b) - sum_c (D_ac) (1, x_c) for every node: row sums and linear reproduction along the side. */
static PetscErrorCode CheckReproduction(Pair pair, PetscReal tolerance)
{
  Vec                one, x, Mv, Cv;
  const PetscScalar *m, *c;
  PetscScalar       *xa;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(pair->level, 1, &one));
  PetscCall(VecDuplicate(one, &x));
  PetscCall(VecDuplicate(one, &Mv));
  PetscCall(VecDuplicate(one, &Cv));
  PetscCall(VecSet(one, 1));
  PetscCall(VecGetArray(x, &xa));
  for (PetscInt i = 0; i < pair->level->num_owned; i++) xa[i] = pair->level->coords[2 * i];
  PetscCall(VecRestoreArray(x, &xa));
  for (PetscInt power = 0; power < 2; power++) {
    PetscCall(VecSet(Cv, 0));
    PetscCall(MatMult(pair->M, power ? x : one, Mv));
    if (pair->chain) PetscCall(MatMult(pair->chain, power ? x : one, Cv));
    PetscCall(VecGetArrayRead(Mv, &m));
    PetscCall(VecGetArrayRead(Cv, &c));
    for (PetscInt k = 0; k < pair->num; k++) {
      const PetscInt node = pair->nodes[k];
      CHECK_NEAR(m[node], c[node] + pair->D[k] * (power ? pair->level->coords[2 * node] : 1), tolerance);
    }
    PetscCall(VecRestoreArrayRead(Cv, &c));
    PetscCall(VecRestoreArrayRead(Mv, &m));
  }
  PetscCall(VecDestroy(&one));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&Mv));
  PetscCall(VecDestroy(&Cv));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* sum_a (D_ab + D_ac) and sum_a M_ab: a constant pressure must load both sides as it would by itself. */
static PetscErrorCode CheckConstantPressure(Pair pair, PetscReal from, PetscReal to, PetscReal tolerance)
{
  Vec          p, load, chain;
  PetscScalar *pa;
  PetscReal    sum_D = 0, sum_M, sum_C = 0;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(pair->level, 1, &p));
  PetscCall(VecDuplicate(p, &load));
  PetscCall(VecDuplicate(p, &chain));
  PetscCall(VecSet(p, 0));
  PetscCall(VecGetArray(p, &pa));
  for (PetscInt k = 0; k < pair->num; k++) {
    pa[pair->nodes[k]] = 1;
    sum_D += pair->D[k];
  }
  PetscCall(VecRestoreArray(p, &pa));
  PetscCall(MatMultTranspose(pair->M, p, load));
  PetscCall(VecSum(load, &sum_M));
  if (pair->chain) {
    PetscCall(MatMultTranspose(pair->chain, p, chain));
    PetscCall(VecSum(chain, &sum_C));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &sum_D, 1, MPIU_REAL, MPI_SUM, PETSC_COMM_WORLD));
  CHECK_NEAR(sum_M, to - from, tolerance);
  CHECK_NEAR(sum_D + sum_C, to - from, tolerance);
  PetscCall(VecDestroy(&p));
  PetscCall(VecDestroy(&load));
  PetscCall(VecDestroy(&chain));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Makes mesh, supports and pair of a scene. */
static PetscErrorCode MakePair(struct _n_Scene *scene, Mesh *mesh, Support *support, Pair *pair)
{
  PetscFunctionBeginUser;
  PetscCall(MeshCreate(scene, mesh));
  PetscCall(MeshSetUp(*mesh));
  PetscCall(SupportCreate(MeshFinest(*mesh), scene, support));
  PetscCall(PairsCreate(scene, MeshFinest(*mesh), support, pair));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Numbers of two and three cells on [0,1], and of a cut facet, worked out by hand. */
static PetscErrorCode TestExactNumbers(void)
{
  const PetscReal D2[3] = {1 / 4., 1 / 2., 1 / 4.}, x2[3] = {0, 0.5, 1}, x3[4] = {0, 1 / 3., 2 / 3., 1};
  const PetscReal M23[3][4] = {
      {2 / 9., 1 / 18., -1 / 36., 0}, {-1 / 18., 11 / 36., 11 / 36., -1 / 18.}, {0, -1 / 36., 1 / 18., 2 / 9.}};
  struct _n_Scene scene;
  SceneBody       bodies[2];
  ScenePair       spec;
  Mesh            mesh;
  Support         support;
  Pair            pair;

  PetscFunctionBeginUser;
  PetscCall(SetTwoBoxes(&scene, bodies, &spec));
  SetBox(&bodies[0], "upper", 2, 2, 0, 0, 1, 1);
  SetBox(&bodies[1], "lower", 3, 2, 0, -1, 1, 0);
  PetscCall(MakePair(&scene, &mesh, &support, &pair));
  for (PetscInt i = 0; i < 3; i++) {
    CHECK_NEAR(FindD(pair, x2[i]), D2[i], 1e-15);
    for (PetscInt j = 0; j < 4; j++) CHECK_NEAR(FindM(pair, x2[i], x3[j]), M23[i][j], 1e-15);
  }
  PetscCall(PairDestroy(&pair));
  PetscCall(SupportDestroy(&support));
  PetscCall(MeshDestroy(&mesh));

  SetBox(&bodies[0], "upper", 1, 1, 0, 0, 1, 1);
  SetBox(&bodies[1], "lower", 1, 1, 0.25, -1, 1.25, 0);
  PetscCall(MakePair(&scene, &mesh, &support, &pair));
  CHECK_NEAR(FindD(pair, 0), 9 / 32., 1e-15);
  CHECK_NEAR(FindD(pair, 1), 15 / 32., 1e-15);
  CHECK_NEAR(FindM(pair, 0, 0.25), 45 / 128., 1e-15);
  CHECK_NEAR(FindM(pair, 0, 1.25), -9 / 128., 1e-15);
  CHECK_NEAR(FindM(pair, 1, 0.25), 15 / 128., 1e-15);
  CHECK_NEAR(FindM(pair, 1, 1.25), 45 / 128., 1e-15);
  PetscCall(PairDestroy(&pair));
  PetscCall(SupportDestroy(&support));
  PetscCall(MeshDestroy(&mesh));
  PetscCall(DestroyTwoBoxes(bodies));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Cut facets, slivers that drop their node, and overhang on both ends: constants and linears pass to roundoff. */
static PetscErrorCode TestCuts(void)
{
  const PetscReal overlap[4] = {0.3, 0.1, 0.01, 0.001}; /* of a facet */
  struct _n_Scene scene;
  SceneBody       bodies[2];
  ScenePair       spec;
  Mesh            mesh;
  Support         support;
  Pair            pair;

  PetscFunctionBeginUser;
  PetscCall(SetTwoBoxes(&scene, bodies, &spec));
  for (PetscInt i = 0; i < 4; i++) {
    const PetscReal end = (3 + overlap[i]) / 5;
    SetBox(&bodies[0], "upper", 5, 1, 0, 0, 1, 1);
    SetBox(&bodies[1], "lower", 7, 1, 0, -1, end, 0);
    PetscCall(MakePair(&scene, &mesh, &support, &pair));
    PetscCall(CheckReproduction(pair, 1e-14));
    PetscCall(CheckConstantPressure(pair, 0, end, 1e-14));
    CHECK(pair->num_removed == (overlap[i] < 0.05 ? 1 : 0)); /* theta = overlap^2 / 2 of the node beyond */
    CHECK(pair->num_uncovered == 1);
    PetscCall(PairDestroy(&pair));
    PetscCall(SupportDestroy(&support));
    PetscCall(MeshDestroy(&mesh));
  }
  PetscCall(DestroyTwoBoxes(bodies));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Ends that are held in normal direction give their rows to their neighbours. */
static PetscErrorCode TestCrosspoints(void)
{
  const PetscReal zero[2] = {0, 0};
  struct _n_Scene scene;
  SceneBody       bodies[2];
  ScenePair       spec;
  SceneBoundary   boundary = {BOUNDARY_DISPLACEMENT, (char *)"left+right", NULL};
  Mesh            mesh;
  Support         support;
  Pair            pair;

  PetscFunctionBeginUser;
  PetscCall(SetTwoBoxes(&scene, bodies, &spec));
  SetBox(&bodies[0], "upper", 4, 2, 0, 0, 1, 1);
  SetBox(&bodies[1], "lower", 7, 2, 0, -1, 1, 0);
  PetscCall(ExpressionCreateConstant("-upper_bc_displacement_left+right", 2, zero, &boundary.value));
  bodies[0].num_boundaries = 1;
  bodies[0].boundaries     = &boundary;
  PetscCall(MakePair(&scene, &mesh, &support, &pair));
  CHECK(pair->num_removed == 2 && pair->num_multipliers == 3);
  PetscCall(CheckReproduction(pair, 1e-14));
  PetscCall(CheckConstantPressure(pair, 0, 1, 1e-14));
  PetscCall(PairDestroy(&pair));
  PetscCall(SupportDestroy(&support));
  PetscCall(MeshDestroy(&mesh));
  PetscCall(DestroyTwoBoxes(bodies));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Two layers of the mortar side, one behind the other: the nearer one counts, once. */
static PetscErrorCode TestTwoLayers(void)
{
  struct _n_Scene scene;
  SceneBody       bodies[2];
  ScenePair       spec;
  Mesh            mesh;
  Support         support;
  Pair            pair;

  PetscFunctionBeginUser;
  PetscCall(SetTwoBoxes(&scene, bodies, &spec));
  SetBox(&bodies[0], "upper", 4, 1, 0, 0.01, 1, 1);
  SetBox(&bodies[1], "lower", 5, 1, 0, -1, 1, 0);
  /* the lower box's top and bottom as one mortar side: the bottom faces away and never counts */
  spec.mortar.side = (char *)"top+bottom";
  spec.reach       = 5;
  PetscCall(MakePair(&scene, &mesh, &support, &pair));
  PetscCall(CheckReproduction(pair, 1e-13));
  for (PetscInt k = 0; k < pair->num; k++) CHECK_NEAR(pair->gap[k], 0.01, 1e-15);
  PetscCall(PairDestroy(&pair));
  PetscCall(SupportDestroy(&support));
  PetscCall(MeshDestroy(&mesh));
  PetscCall(DestroyTwoBoxes(bodies));
  PetscFunctionReturn(PETSC_SUCCESS);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(FaultInitialize());
  PetscCall(TestExactNumbers());
  PetscCall(TestCuts());
  PetscCall(TestCrosspoints());
  PetscCall(TestTwoLayers());
  PetscCall(PetscFinalize());
  return 0;
}

/* test_pair.c -- D, M and gap of a pair: exact numbers, row sums, reproduction, slivers, curved sides, on any number of
   ranks. */
#include "contact/pairs.h"
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

/* u~ = u - shift u of u = x^power, in which D and the chain are written. Collective. [out] u - owned by the caller */
static PetscErrorCode CreatePower(Pair pair, PetscInt power, Vec *u, Vec *shifted)
{
  PetscScalar *ua;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(pair->level, 1, u));
  PetscCall(VecDuplicate(*u, shifted));
  PetscCall(VecGetArray(*u, &ua));
  for (PetscInt i = 0; i < pair->level->num_owned; i++) ua[i] = PetscPowRealInt(pair->level->coords[2 * i], power);
  PetscCall(VecRestoreArray(*u, &ua));
  PetscCall(VecZeroEntries(*shifted));
  if (pair->to_nodal) PetscCall(MatMult(pair->to_nodal, *u, *shifted));
  PetscCall(VecAYPX(*shifted, -1.0, *u));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* sum_b M_ab x_b^k = D_aa x_a^k + sum_c D_ac u~_c for every node: row sums, and reproduction of polynomials along the side up
   to a degree. */
static PetscErrorCode CheckReproduction(Pair pair, PetscInt degree, PetscReal tolerance)
{
  Vec                u, shifted, Mu, Cu;
  const PetscScalar *m, *c;

  PetscFunctionBeginUser;
  for (PetscInt power = 0; power <= degree; power++) {
    PetscCall(CreatePower(pair, power, &u, &shifted));
    PetscCall(VecDuplicate(u, &Mu));
    PetscCall(VecDuplicate(u, &Cu));
    PetscCall(VecSet(Cu, 0));
    PetscCall(MatMult(pair->M, u, Mu));
    if (pair->D_other) PetscCall(MatMult(pair->D_other, shifted, Cu));
    PetscCall(VecGetArrayRead(Mu, &m));
    PetscCall(VecGetArrayRead(Cu, &c));
    for (PetscInt k = 0; k < pair->num; k++) {
      const PetscInt node = pair->nodes[k];
      CHECK_NEAR(m[node], c[node] + pair->D[k] * PetscPowRealInt(pair->level->coords[2 * node], power), tolerance);
    }
    PetscCall(VecRestoreArrayRead(Cu, &c));
    PetscCall(VecRestoreArrayRead(Mu, &m));
    PetscCall(VecDestroy(&u));
    PetscCall(VecDestroy(&shifted));
    PetscCall(VecDestroy(&Mu));
    PetscCall(VecDestroy(&Cu));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* sum_a (D_ab + D_ac) and sum_a M_ab: a constant pressure must load both sides as it would by itself. */
static PetscErrorCode CheckConstantPressure(Pair pair, PetscReal from, PetscReal to, PetscReal tolerance)
{
  Vec          p, load, one, shifted;
  PetscScalar *pa;
  PetscReal    sum_D = 0, sum_M, sum_C = 0;

  PetscFunctionBeginUser;
  PetscCall(CreatePower(pair, 0, &one, &shifted));
  PetscCall(LevelCreateVec(pair->level, 1, &p));
  PetscCall(VecDuplicate(p, &load));
  PetscCall(VecSet(p, 0));
  PetscCall(VecGetArray(p, &pa));
  for (PetscInt k = 0; k < pair->num; k++) {
    pa[pair->nodes[k]] = 1;
    sum_D += pair->D[k];
  }
  PetscCall(VecRestoreArray(p, &pa));
  PetscCall(MatMultTranspose(pair->M, p, load));
  PetscCall(VecSum(load, &sum_M));
  if (pair->D_other) {
    PetscCall(MatMultTranspose(pair->D_other, p, load));
    PetscCall(VecDot(load, shifted, &sum_C));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &sum_D, 1, MPIU_REAL, MPI_SUM, PETSC_COMM_WORLD));
  CHECK_NEAR(sum_M, to - from, tolerance);
  CHECK_NEAR(sum_D + sum_C, to - from, tolerance);
  PetscCall(VecDestroy(&one));
  PetscCall(VecDestroy(&shifted));
  PetscCall(VecDestroy(&p));
  PetscCall(VecDestroy(&load));
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

/* The entries of the chain in the rows of the nodes at 0 and 1, and of the shift, at the middle node between them. */
static PetscErrorCode CheckMiddle(Pair pair, PetscReal first, PetscReal last)
{
  const PetscReal    chain[2] = {first, last};
  Vec                middle, row;
  const PetscScalar *ra;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(pair->level, 1, &middle));
  PetscCall(VecDuplicate(middle, &row));
  PetscCall(VecSet(middle, 0));
  for (PetscInt i = 0; i < pair->level->num_owned; i++) {
    const PetscReal *x = &pair->level->coords[2 * i];
    if (pair->level->node_body[i] == 0 && PetscAbsReal(x[0] - 0.5) < 1e-9 && PetscAbsReal(x[1]) < 1e-9)
      PetscCall(VecSetValue(middle, pair->level->node_global[i], 1, INSERT_VALUES));
  }
  PetscCall(VecAssemblyBegin(middle));
  PetscCall(VecAssemblyEnd(middle));
  PetscCall(MatMult(pair->D_other, middle, row));
  PetscCall(VecGetArrayRead(row, &ra));
  for (PetscInt k = 0; k < pair->num; k++) {
    const PetscReal x = pair->level->coords[2 * pair->nodes[k]];
    CHECK_NEAR(ra[pair->nodes[k]], chain[x > 0.5 ? 1 : 0], 1e-15);
  }
  PetscCall(VecRestoreArrayRead(row, &ra));
  PetscCall(MatMultTranspose(pair->to_nodal, middle, row));
  PetscCall(VecGetArrayRead(row, &ra));
  for (PetscInt k = 0; k < pair->num; k++) CHECK_NEAR(ra[pair->nodes[k]], 0.5, 0.);
  PetscCall(VecRestoreArrayRead(row, &ra));
  PetscCall(VecDestroy(&middle));
  PetscCall(VecDestroy(&row));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Two quadratic cells against one with all nodes, then with vertices only, and a cut facet: worked out by exact fractions.
   The chain entry at a middle node is int psi_a phi_e, the shift 1/2 from both ends. */
static PetscErrorCode TestExactNumbersQuadratic(PairMultipliers multipliers)
{
  const PetscReal x[3] = {0, 0.5, 1}, xm[5] = {0, 0.25, 0.5, 0.75, 1}, xc[3] = {0.2, 0.7, 1.2};
  const PetscReal D[3] = {1 / 6., 2 / 3., 1 / 6.}, D_cut[3] = {8 / 375., 224 / 375., 68 / 375.};
  const PetscReal M[3][5]     = {{11 / 96., 1 / 8., -1 / 16., -1 / 24., 1 / 32.},
                                 {-1 / 16., 1 / 4., 7 / 24., 1 / 4., -1 / 16.},
                                 {1 / 32., -1 / 24., -1 / 16., 1 / 8., 11 / 96.}};
  const PetscReal M_cut[3][3] = {{112 / 3125., -64 / 3125., 56 / 9375.},
                                 {1568 / 9375., 1568 / 3125., -224 / 3125.},
                                 {-68 / 3125., 1088 / 9375., 272 / 3125.}};
  const PetscReal D_v[3] = {1 / 2., -1, 1 / 2.}, D_v_cut[3] = {8 / 25., -1, 12 / 25.};
  const PetscReal M_v[3][5] = {
      {1 / 6., 5 / 12., 1 / 12., -1 / 12., -1 / 12.}, {0, 0, 0, 0, 0}, {-1 / 12., -1 / 12., 1 / 12., 5 / 12., 1 / 6.}};
  const PetscReal M_v_cut[3][3] = {{128 / 375., 32 / 375., -8 / 75.}, {0, 0, 0}, {-4 / 25., 64 / 125., 16 / 125.}};
  const PetscBool vertices      = (PetscBool)(multipliers == MULTIPLIERS_VERTICES);
  struct _n_Scene scene;
  SceneBody       bodies[2];
  ScenePair       spec;
  Mesh            mesh;
  Support         support;
  Pair            pair;

  PetscFunctionBeginUser;
  PetscCall(SetTwoBoxes(&scene, bodies, &spec));
  spec.multipliers = multipliers;
  for (PetscInt cut = 0; cut < 2; cut++) {
    SetBox(&bodies[0], "upper", 1, 1, 0, 0, 1, 1);
    SetBox(&bodies[1], "lower", cut ? 1 : 2, 1, cut ? 0.2 : 0, -1, cut ? 1.2 : 1, 0);
    bodies[0].order = bodies[1].order = 2;
    PetscCall(MakePair(&scene, &mesh, &support, &pair));
    CHECK(pair->num_multipliers == (vertices ? 2 : 3) && pair->num_removed == 0 && pair->num_uncovered == 0);
    CHECK((pair->to_nodal != NULL) == vertices && (pair->D_other != NULL) == vertices);
    for (PetscInt i = 0; i < 3; i++) {
      const PetscReal *expected = vertices ? (cut ? D_v_cut : D_v) : (cut ? D_cut : D);
      CHECK_NEAR(FindD(pair, x[i]), expected[i], 1e-15);
      for (PetscInt j = 0; j < (cut ? 3 : 5) && expected[i] > 0; j++) {
        const PetscReal value = vertices ? (cut ? M_v_cut[i][j] : M_v[i][j]) : (cut ? M_cut[i][j] : M[i][j]);
        CHECK_NEAR(FindM(pair, x[i], cut ? xc[j] : xm[j]), value, 1e-15);
      }
    }
    if (vertices) PetscCall(CheckMiddle(pair, cut ? 736 / 1875. : 1 / 3., cut ? 128 / 625. : 1 / 3.));
    PetscCall(PairDestroy(&pair));
    PetscCall(SupportDestroy(&support));
    PetscCall(MeshDestroy(&mesh));
  }
  PetscCall(DestroyTwoBoxes(bodies));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Cut facets, slivers that drop their nodes, and overhang on both ends: constants and linears pass to roundoff, and quadratic
   functions between quadratic sides. A share e covers e^2 / 2 of the linear far end, the quadratic one negatively, and
   3 e^2 of the middle node. */
static PetscErrorCode TestCuts(PetscInt order, PetscInt order_m, PairMultipliers multipliers)
{
  const PetscReal overlap[4] = {0.3, 0.1, 0.01, 0.001}; /* of a facet */
  const PetscBool quadratic  = (PetscBool)(order == 2 && multipliers == MULTIPLIERS_NODES);
  struct _n_Scene scene;
  SceneBody       bodies[2];
  ScenePair       spec;
  Mesh            mesh;
  Support         support;
  Pair            pair;

  PetscFunctionBeginUser;
  PetscCall(SetTwoBoxes(&scene, bodies, &spec));
  spec.multipliers = multipliers;
  for (PetscInt i = 0; i < 4; i++) {
    const PetscReal end         = (3 + overlap[i]) / 5;
    PetscInt        num_removed = overlap[i] < 0.05 ? 1 : 0;
    SetBox(&bodies[0], "upper", 5, 1, 0, 0, 1, 1);
    SetBox(&bodies[1], "lower", 7, 1, 0, -1, end, 0);
    bodies[0].order = order;
    bodies[1].order = order_m;
    PetscCall(MakePair(&scene, &mesh, &support, &pair));
    PetscCall(CheckReproduction(pair, order == 2 && order_m == 2 ? 2 : 1, 1e-14));
    PetscCall(CheckConstantPressure(pair, 0, end, 1e-14));
    if (quadratic) num_removed = overlap[i] < 0.13 ? 2 : 1;
    CHECK(pair->num_removed == num_removed);
    CHECK(pair->num_uncovered == (quadratic ? 2 : 1));
    PetscCall(PairDestroy(&pair));
    PetscCall(SupportDestroy(&support));
    PetscCall(MeshDestroy(&mesh));
  }
  PetscCall(DestroyTwoBoxes(bodies));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Ends that are held in normal direction give their rows to their neighbours. */
static PetscErrorCode TestCrosspoints(PetscInt order, PairMultipliers multipliers)
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
  spec.multipliers = multipliers;
  SetBox(&bodies[0], "upper", 4, 2, 0, 0, 1, 1);
  SetBox(&bodies[1], "lower", 7, 2, 0, -1, 1, 0);
  bodies[0].order = bodies[1].order = order;
  PetscCall(ConstantCreate("-upper_bc_displacement_left+right", 2, zero, &boundary.value));
  bodies[0].num_boundaries = 1;
  bodies[0].boundaries     = &boundary;
  PetscCall(MakePair(&scene, &mesh, &support, &pair));
  CHECK(pair->num_removed == 2 && pair->num_multipliers == (order == 2 && multipliers == MULTIPLIERS_NODES ? 7 : 3));
  PetscCall(CheckReproduction(pair, order, 1e-14));
  PetscCall(CheckConstantPressure(pair, 0, 1, 1e-14));
  PetscCall(PairDestroy(&pair));
  PetscCall(SupportDestroy(&support));
  PetscCall(MeshDestroy(&mesh));
  PetscCall(DestroyTwoBoxes(bodies));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Parabolas of chord c and height h over it, their nodes on a quarter of the unit circle. Each has the length
   sqrt(c^2 + 16 h^2) / 2 + c^2 / (8 h) asinh(4 h / c). */
static PetscReal ParabolasLength(PetscInt num)
{
  const PetscReal half = PETSC_PI / 4 / num, c = 2 * PetscSinReal(half), h = 1 - PetscCosReal(half);

  return num * (0.5 * PetscSqrtReal(c * c + 16 * h * h) + c * c / (8 * h) * PetscAsinhReal(4 * h / c));
}

/* Quarter rings, one in the other, cut differently. The length of the side, the normals and the zero gap have
   the accuracy of the curved sides, on any number of ranks. */
static PetscErrorCode TestRings(PairMultipliers multipliers)
{
  struct _n_Scene scene;
  SceneBody       bodies[2];
  ScenePair       spec;
  Mesh            mesh;
  Support         support;
  Pair            pair;
  PetscReal       worst[2][2] = {{0}}; /* gap and normal */

  PetscFunctionBeginUser;
  PetscCall(SetTwoBoxes(&scene, bodies, &spec));
  spec.multipliers    = multipliers;
  spec.nonmortar.side = (char *)"left"; /* the inner side of the outer ring */
  spec.mortar.side    = (char *)"right";
  for (PetscInt level = 0; level < 2; level++) {
    SetBox(&bodies[0], "outer", 1, 4 << level, 1, 0, 2, PETSC_PI / 2);
    SetBox(&bodies[1], "inner", 1, 5 << level, 0.5, 0, 1, PETSC_PI / 2);
    for (PetscInt b = 0; b < 2; b++) {
      bodies[b].order = 2;
      PetscCall(ExpressionCreate(PETSC_COMM_WORLD, "-map", "x*cos(y), x*sin(y)", 2, PETSC_FALSE, &bodies[b].map));
    }
    PetscCall(MakePair(&scene, &mesh, &support, &pair));
    CHECK(pair->num_multipliers == (multipliers == MULTIPLIERS_VERTICES ? 1 : 2) * (4 << level) + 1);
    for (PetscInt k = 0; k < pair->num; k++) {
      const PetscReal *x = &pair->level->coords[2 * pair->nodes[k]], *n = &pair->normal[2 * k];
      worst[level][0] = PetscMax(worst[level][0], PetscAbsReal(pair->gap[k]));
      worst[level][1] = PetscMax(worst[level][1], PetscAbsReal(n[0] * x[1] - n[1] * x[0]));
      CHECK(n[0] * x[0] + n[1] * x[1] < 0);
    }
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, worst[level], 2, MPIU_REAL, MPIU_MAX, PETSC_COMM_WORLD));
    PetscCall(CheckConstantPressure(pair, 0, ParabolasLength(4 << level), 1e-12));
    PetscCall(PairDestroy(&pair));
    PetscCall(SupportDestroy(&support));
    PetscCall(MeshDestroy(&mesh));
    for (PetscInt b = 0; b < 2; b++) PetscCall(ExpressionDestroy(&bodies[b].map));
  }
  CHECK(worst[0][0] / worst[1][0] > 12);
  for (PetscInt level = 0; level < 2; level++) CHECK_NEAR(worst[level][1], 0., 1e-13); // all nodes lie on circles
  PetscCall(DestroyTwoBoxes(bodies));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Two layers of the mortar side, one behind the other: the nearer one counts, once. */
static PetscErrorCode TestTwoLayers(PetscInt order)
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
  bodies[0].order = bodies[1].order = order;
  /* the lower box's top and bottom as one mortar side: the bottom faces away and never counts */
  spec.mortar.side = (char *)"top+bottom";
  spec.reach       = 5;
  PetscCall(MakePair(&scene, &mesh, &support, &pair));
  PetscCall(CheckReproduction(pair, order, 1e-13));
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
  PetscCall(UserErrorInitialize());
  PetscCall(TestExactNumbers());
  PetscCall(TestExactNumbersQuadratic(MULTIPLIERS_NODES));
  PetscCall(TestExactNumbersQuadratic(MULTIPLIERS_VERTICES));
  for (PetscInt order = 1; order <= 2; order++) {
    for (PetscInt order_m = 1; order_m <= 2; order_m++) PetscCall(TestCuts(order, order_m, MULTIPLIERS_NODES));
    PetscCall(TestCrosspoints(order, MULTIPLIERS_NODES));
    PetscCall(TestTwoLayers(order));
  }
  PetscCall(TestCuts(2, 2, MULTIPLIERS_VERTICES));
  PetscCall(TestCrosspoints(2, MULTIPLIERS_VERTICES));
  PetscCall(TestRings(MULTIPLIERS_NODES));
  PetscCall(TestRings(MULTIPLIERS_VERTICES));
  PetscCall(PetscFinalize());
  return 0;
}

/* test_solidpair.c -- pairs of solids: D, M, gap and normals on facets of all types, matching and cut, flat, on any number of
   ranks. */
#include "test.h"
#include "two_solids.h"

static const PetscReal EXACT = 1e-12;

/* A turned frame, no axis of which is special, and the map that turns a box with it. */
static const PetscReal Q[DIM][DIM] = {{2 / 3., -2 / 3., 1 / 3.}, {1 / 3., 2 / 3., 2 / 3.}, {-2 / 3., -1 / 3., 2 / 3.}};
static const char     *TURN        = "(2*x-2*y+z)/3+5, (x+2*y+2*z)/3-2, (0-2*x-y+2*z)/3+1";

/* u: 1 (power 0), or the coordinate k (power k + 1); shifted: the u~ of it, in which D and the chain are written. Collective. */
static PetscErrorCode CreateLinear(Pair pair, PetscInt power, Vec *u, Vec *shifted)
{
  PetscScalar *ua;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(pair->level, 1, u));
  PetscCall(VecDuplicate(*u, shifted));
  PetscCall(VecGetArray(*u, &ua));
  for (PetscInt i = 0; i < pair->level->num_owned; i++) ua[i] = power ? pair->level->coords[DIM * i + power - 1] : 1;
  PetscCall(VecRestoreArray(*u, &ua));
  PetscCall(VecCopy(*u, *shifted));
  if (pair->from_nodal) PetscCall(MatMultAdd(pair->from_nodal, *u, *u, *shifted));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* sum_b M_ab x_b = D_aa x~_a + sum_c D_ac x~_c + gap n, for 1 and the coordinates. [in] n - normal, to which gaps are measured */
static PetscErrorCode CheckReproduction(Pair pair, const PetscReal n[], PetscReal gap, PetscReal tolerance)
{
  PetscFunctionBeginUser;
  for (PetscInt power = 0; power <= DIM; power++) {
    Vec                u, shifted, Mu, Cu, one, one_shifted, C1;
    const PetscScalar *m, *c, *own, *c1;

    PetscCall(CreateLinear(pair, power, &u, &shifted));
    PetscCall(CreateLinear(pair, 0, &one, &one_shifted));
    PetscCall(VecDuplicate(u, &Mu));
    PetscCall(VecDuplicate(u, &Cu));
    PetscCall(VecDuplicate(u, &C1));
    PetscCall(VecSet(Cu, 0));
    PetscCall(VecSet(C1, 0));
    PetscCall(MatMult(pair->M, u, Mu));
    if (pair->D_other) PetscCall(MatMult(pair->D_other, shifted, Cu));
    if (pair->D_other) PetscCall(MatMult(pair->D_other, one_shifted, C1));
    PetscCall(VecGetArrayRead(Mu, &m));
    PetscCall(VecGetArrayRead(Cu, &c));
    PetscCall(VecGetArrayRead(C1, &c1));
    PetscCall(VecGetArrayRead(shifted, &own));
    for (PetscInt k = 0; k < pair->num; k++) {
      const PetscInt  node  = pair->nodes[k];
      const PetscReal moved = power ? gap * n[power - 1] * (pair->D[k] + c1[node]) : 0;
      CHECK_NEAR(m[node], c[node] + pair->D[k] * own[node] + moved, tolerance);
      if (power == 0) CHECK(m[node] > 0); // a pressure pushes
    }
    PetscCall(VecRestoreArrayRead(shifted, &own));
    PetscCall(VecRestoreArrayRead(C1, &c1));
    PetscCall(VecRestoreArrayRead(Cu, &c));
    PetscCall(VecRestoreArrayRead(Mu, &m));
    PetscCall(VecDestroy(&u));
    PetscCall(VecDestroy(&shifted));
    PetscCall(VecDestroy(&one));
    PetscCall(VecDestroy(&one_shifted));
    PetscCall(VecDestroy(&Mu));
    PetscCall(VecDestroy(&Cu));
    PetscCall(VecDestroy(&C1));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A constant pressure of 1 loads either side with the area. */
static PetscErrorCode CheckConstantPressure(Pair pair, PetscReal area, PetscReal tolerance)
{
  Vec          p, load, one, shifted;
  PetscScalar *pa;
  PetscReal    sum_D = 0, sum_M, sum_C = 0;

  PetscFunctionBeginUser;
  PetscCall(CreateLinear(pair, 0, &one, &shifted));
  PetscCall(VecDuplicate(one, &p));
  PetscCall(VecDuplicate(one, &load));
  PetscCall(VecSet(p, 0));
  PetscCall(VecGetArray(p, &pa));
  for (PetscInt k = 0; k < pair->num; k++) {
    pa[pair->nodes[k]] = 1;
    sum_D += pair->D[k];
    CHECK(pair->D[k] > 0);
  }
  PetscCall(VecRestoreArray(p, &pa));
  PetscCall(MatMultTranspose(pair->M, p, load));
  PetscCall(VecSum(load, &sum_M));
  if (pair->D_other) {
    PetscCall(MatMultTranspose(pair->D_other, p, load));
    PetscCall(VecDot(load, shifted, &sum_C));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &sum_D, 1, MPIU_REAL, MPI_SUM, PETSC_COMM_WORLD));
  CHECK_NEAR(sum_M, area, tolerance);
  CHECK_NEAR(sum_D + sum_C, area, tolerance);
  PetscCall(VecDestroy(&one));
  PetscCall(VecDestroy(&shifted));
  PetscCall(VecDestroy(&p));
  PetscCall(VecDestroy(&load));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* M of the nonmortar node at xs against the mortar node at xm, both places in the plane z = 0. Collective. */
static PetscReal FindM(Pair pair, const PetscReal xs[], const PetscReal xm[])
{
  const Level       *level = pair->level;
  PetscReal          M     = -PETSC_MAX_REAL, found;
  Vec                v, row;
  const PetscScalar *ra;

  PetscCallAbort(PETSC_COMM_SELF, LevelCreateVec(pair->level, 1, &v));
  PetscCallAbort(PETSC_COMM_SELF, VecDuplicate(v, &row));
  PetscCallAbort(PETSC_COMM_SELF, VecSet(v, 0));
  for (PetscInt i = 0; i < level->num_owned; i++) {
    const PetscReal *x = &level->coords[DIM * i];
    if (level->node_body[i] == 1 && PetscAbsReal(x[0] - xm[0]) + PetscAbsReal(x[1] - xm[1]) + PetscAbsReal(x[2]) < 1e-9)
      PetscCallAbort(PETSC_COMM_SELF, VecSetValue(v, level->node_global[i], 1, INSERT_VALUES));
  }
  PetscCallAbort(PETSC_COMM_SELF, VecAssemblyBegin(v));
  PetscCallAbort(PETSC_COMM_SELF, VecAssemblyEnd(v));
  PetscCallAbort(PETSC_COMM_SELF, MatMult(pair->M, v, row));
  PetscCallAbort(PETSC_COMM_SELF, VecGetArrayRead(row, &ra));
  for (PetscInt k = 0; k < pair->num; k++) {
    const PetscReal *x = &level->coords[DIM * pair->nodes[k]];
    if (PetscAbsReal(x[0] - xs[0]) + PetscAbsReal(x[1] - xs[1]) < 1e-9) M = ra[pair->nodes[k]];
  }
  PetscCallAbort(PETSC_COMM_SELF, VecRestoreArrayRead(row, &ra));
  PetscCallAbort(PETSC_COMM_SELF, VecDestroy(&row));
  PetscCallAbort(PETSC_COMM_SELF, VecDestroy(&v));
  PetscCallAbort(PETSC_COMM_SELF, MPI_Allreduce(&M, &found, 1, MPIU_REAL, MPIU_MAX, PETSC_COMM_WORLD));
  return found;
}

/* One quad against the two triangles of the same square, and against one quad that covers a quarter of it: fractions by hand. */
static PetscErrorCode TestExactNumbers(void)
{
  const PetscReal corner[4][2]  = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const PetscReal full[4][4]    = {{34, -4, 4, -4}, {1, 29, 1, -1}, {4, -4, 34, -4}, {1, -1, 1, 29}};
  const PetscReal above[2][DIM] = {{0, 0, 0}, {1, 1, 1}}, below[2][DIM] = {{0, 0, -1}, {1, 1, 0}},
                  aside[2][DIM] = {{0.5, 0.5, -1}, {1.5, 1.5, 0}};
  /* psi of the quarter is the product of 7 - 9 x and 9 x - 6 along each axis, against 3/2 - x and x - 1/2 */
  const PetscReal line[2][2] = {{3 / 16., -1 / 16.}, {3 / 16., 3 / 16.}};
  struct _n_Scene scene;
  SceneBody       bodies[2];
  ScenePair       spec;
  Mesh            mesh;
  Support         support;
  Pair            pair;

  PetscFunctionBeginUser;
  PetscCall(SetTwoSolids(&scene, bodies, &spec));
  SetSolid(&bodies[0], "upper", ELEMENT_HEX8, 1, 1, 1, above[0], above[1]);
  SetSolid(&bodies[1], "lower", ELEMENT_TET4, 1, 1, 1, below[0], below[1]);
  PetscCall(MakePair(&scene, NULL, &mesh, &support, &pair));
  {
    /* whichever diagonal the box has cut the square along: the numbers are for that through 0 and 2 */
    const PetscInt turn = PetscAbsReal(FindM(pair, corner[0], corner[0]) - full[0][0] / 120) < EXACT ? 0 : 1;
    for (PetscInt a = 0; a < 4; a++) {
      for (PetscInt b = 0; b < 4; b++)
        CHECK_NEAR(FindM(pair, corner[(a + turn) % 4], corner[(b + turn) % 4]), full[a][b] / 120, EXACT);
    }
  }
  for (PetscInt k = 0; k < pair->num; k++) CHECK_NEAR(pair->D[k], 0.25, EXACT);
  PetscCall(LosePair(&scene, &mesh, &support, &pair));
  SetSolid(&bodies[1], "lower", ELEMENT_HEX8, 1, 1, 1, aside[0], aside[1]);
  PetscCall(MakePair(&scene, NULL, &mesh, &support, &pair));
  for (PetscInt a = 0; a < 4; a++) {
    for (PetscInt b = 0; b < 4; b++) {
      const PetscReal xm[2] = {corner[b][0] + 0.5, corner[b][1] + 0.5};
      CHECK_NEAR(FindM(pair, corner[a], xm),
                 line[(PetscInt)corner[a][0]][(PetscInt)corner[b][0]] *
                     line[(PetscInt)corner[a][1]][(PetscInt)corner[b][1]],
                 EXACT);
    }
  }
  PetscCall(LosePair(&scene, &mesh, &support, &pair));
  PetscCall(DestroyTwoBoxes(bodies));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Non-matching sides of all types, anywhere in space, apart: constants and linear functions pass, gaps are the distance. */
static PetscErrorCode TestFlat(ElementType cell, ElementType cell_m, PairMultipliers multipliers)
{
  const PetscReal gap = 0.1, lower[2][DIM] = {{0, 0, 0}, {0, 0, -1.1}}, upper[2][DIM] = {{1, 1, 0.5}, {1, 1, -0.1}};
  const PetscReal n[DIM] = {-Q[0][2], -Q[1][2], -Q[2][2]};
  struct _n_Scene scene;
  SceneBody       bodies[2];
  ScenePair       spec;
  Mesh            mesh;
  Support         support;
  Pair            pair;

  PetscFunctionBeginUser;
  PetscCall(SetTwoSolids(&scene, bodies, &spec));
  spec.multipliers = multipliers;
  SetSolid(&bodies[0], "upper", cell, 3, 2, 1, lower[0], upper[0]);
  SetSolid(&bodies[1], "lower", cell_m, 2, 3, 1, lower[1], upper[1]);
  PetscCall(MakePair(&scene, TURN, &mesh, &support, &pair));
  CHECK(pair->num_multipliers == (bodies[0].order == 1 || multipliers == MULTIPLIERS_VERTICES ? 12 : 35));
  PetscCall(CheckReproduction(pair, n, gap, EXACT));
  PetscCall(CheckConstantPressure(pair, 1, EXACT));
  for (PetscInt k = 0; k < pair->num; k++) {
    CHECK_NEAR(pair->gap[k], gap, EXACT);
    for (PetscInt j = 0; j < DIM; j++) CHECK_NEAR(pair->normal[DIM * k + j], n[j], EXACT);
  }
  PetscCall(LosePair(&scene, &mesh, &support, &pair));
  PetscCall(DestroyTwoBoxes(bodies));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The nonmortar side is wider in both directions: facets cut along lines and at a corner, slivers that lose their nodes. */
static PetscErrorCode TestCuts(ElementType cell, ElementType cell_m, PairMultipliers multipliers)
{
  const PetscReal overlap[4] = {0.3, 0.1, 0.01, 0.001}; /* of a facet */
  const PetscReal n[DIM]     = {-Q[0][2], -Q[1][2], -Q[2][2]};
  struct _n_Scene scene;
  SceneBody       bodies[2];
  ScenePair       spec;
  Mesh            mesh;
  Support         support;
  Pair            pair;

  PetscFunctionBeginUser;
  PetscCall(SetTwoSolids(&scene, bodies, &spec));
  spec.multipliers = multipliers;
  for (PetscInt i = 0; i < 4; i++) {
    const PetscReal end = (1 + overlap[i]) / 3, lower[2][DIM] = {{0, 0, 0}, {0, 0, -1}},
                    upper[2][DIM] = {{1, 1, 0.5}, {end, end, 0}};
    SetSolid(&bodies[0], "upper", cell, 3, 3, 1, lower[0], upper[0]);
    SetSolid(&bodies[1], "lower", cell_m, 2, 1, 1, lower[1], upper[1]);
    PetscCall(MakePair(&scene, TURN, &mesh, &support, &pair));
    CHECK(pair->num_uncovered > 0 && (pair->num_removed > 0 || overlap[i] > 0.09));
    PetscCall(CheckReproduction(pair, n, 0, EXACT));
    PetscCall(CheckConstantPressure(pair, end * end, EXACT));
    PetscCall(LosePair(&scene, &mesh, &support, &pair));
  }
  PetscCall(DestroyTwoBoxes(bodies));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The mortar side ends along a line that runs askew through the nonmortar side and passes a node at a
   distance. Facets are cut to triangles, pentagons, slivers. What is covered is the area beside the line. */
static PetscErrorCode TestAskew(ElementType cell, ElementType cell_m)
{
  const PetscReal distance[5] = {0.05, 1e-2, 1e-3, 1e-5, -1e-5}, slope = 0.7, far = 4, down[DIM] = {0, 0, -1};
  struct _n_Scene scene;
  SceneBody       bodies[2];
  ScenePair       spec;
  Mesh            mesh;
  Support         support;
  Pair            pair;

  PetscFunctionBeginUser;
  PetscCall(SetTwoSolids(&scene, bodies, &spec));
  for (PetscInt i = 0; i < 5; i++) {
    const PetscReal end = (1 - slope) / 3 + distance[i], lower[2][DIM] = {{0, 0, 0}, {end - far, -1, -1}},
                    upper[2][DIM] = {{1, 1, 0.5}, {end, 3, 0}};
    SetSolid(&bodies[0], "upper", cell, 3, 3, 1, lower[0], upper[0]);
    SetSolid(&bodies[1], "lower", cell_m, 5, 7, 1, lower[1], upper[1]);
    PetscCall(ExpressionCreate(PETSC_COMM_WORLD, "-map", "x+0.7*y, y, z", DIM, PETSC_FALSE, &bodies[1].map));
    PetscCall(MakePair(&scene, NULL, &mesh, &support, &pair));
    PetscCall(CheckReproduction(pair, down, 0, EXACT));
    PetscCall(CheckConstantPressure(pair, end + slope / 2, EXACT));
    PetscCall(LosePair(&scene, &mesh, &support, &pair));
  }
  PetscCall(DestroyTwoBoxes(bodies));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* All four edges of the nonmortar side are held: inner nodes take their rows, those of the corners by way of their neighbours. */
static PetscErrorCode TestCrosspoints(ElementType cell, PairMultipliers multipliers)
{
  const PetscReal zero[DIM] = {0, 0, 0}, lower[2][DIM] = {{0, 0, 0}, {0, 0, -1}},
                  upper[2][DIM] = {{1, 1, 0.5}, {1, 1, 0}};
  const PetscReal n[DIM]        = {-Q[0][2], -Q[1][2], -Q[2][2]};
  struct _n_Scene scene;
  SceneBody       bodies[2];
  ScenePair       spec;
  SceneBoundary   boundary = {BOUNDARY_DISPLACEMENT, (char *)"left+right+front+back", NULL};
  Mesh            mesh;
  Support         support;
  Pair            pair;

  PetscFunctionBeginUser;
  PetscCall(SetTwoSolids(&scene, bodies, &spec));
  spec.multipliers = multipliers;
  SetSolid(&bodies[0], "upper", cell, 3, 3, 1, lower[0], upper[0]);
  SetSolid(&bodies[1], "lower", ELEMENT_HEX8, 4, 2, 1, lower[1], upper[1]);
  PetscCall(ConstantCreate("-upper_bc_displacement", DIM, zero, &boundary.value));
  bodies[0].num_boundaries = 1;
  bodies[0].boundaries     = &boundary;
  PetscCall(MakePair(&scene, TURN, &mesh, &support, &pair));
  CHECK(pair->num_multipliers == (bodies[0].order == 2 && multipliers == MULTIPLIERS_NODES ? 25 : 4));
  CHECK(pair->num_removed == (bodies[0].order == 2 && multipliers == MULTIPLIERS_NODES ? 24 : 12));
  PetscCall(CheckReproduction(pair, n, 0, EXACT));
  PetscCall(CheckConstantPressure(pair, 1, EXACT));
  PetscCall(LosePair(&scene, &mesh, &support, &pair));
  PetscCall(DestroyTwoBoxes(bodies));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Picks one of six values by x = 0..5. */
#define SIX(a, b, c, d, e, f) "(x<0.5?" #a ":(x<1.5?" #b ":(x<2.5?" #c ":(x<3.5?" #d ":(x<4.5?" #e ":" #f ")))))"

/* A sheet folded twice, so that its side "top" faces up at z = 0, and again at z = -0.9 behind that. The
   nearer layer counts, once. The one behind it does not count even where both are within reach. */
static PetscErrorCode TestTwoLayers(ElementType cell)
{
  const char *fold = "(1-z)*" SIX(0, 1, 1, -0.1, -0.1, 1) "+z*" SIX(0, 1.1, 1.1, 0, 0, 1) ", y, (1-z)*" SIX(
      -0.1, -0.1, -0.4, -0.4, -1, -1) "+z*" SIX(0, 0, -0.5, -0.5, -0.9, -0.9);
  const PetscReal above[2][DIM] = {{0, 0, 0.01}, {1, 1, 0.5}}, sheet[2][DIM] = {{0, 0, 0}, {5, 1, 1}};
  struct _n_Scene scene;
  SceneBody       bodies[2];
  ScenePair       spec;
  Mesh            mesh;
  Support         support;
  Pair            pair;

  PetscFunctionBeginUser;
  PetscCall(SetTwoSolids(&scene, bodies, &spec));
  SetSolid(&bodies[0], "upper", cell, 3, 2, 1, above[0], above[1]);
  SetSolid(&bodies[1], "sheet", ELEMENT_HEX8, 5, 1, 1, sheet[0], sheet[1]);
  PetscCall(ExpressionCreate(PETSC_COMM_WORLD, "-map", fold, DIM, PETSC_FALSE, &bodies[1].map));
  spec.reach = 2;
  PetscCall(MakePair(&scene, NULL, &mesh, &support, &pair));
  PetscCall(CheckConstantPressure(pair, 1, EXACT));
  for (PetscInt k = 0; k < pair->num; k++) CHECK_NEAR(pair->gap[k], 0.01, EXACT);
  PetscCall(LosePair(&scene, &mesh, &support, &pair));
  PetscCall(DestroyTwoBoxes(bodies));
  PetscFunctionReturn(PETSC_SUCCESS);
}

int main(int argc, char **argv)
{
  const ElementType cells[4] = {ELEMENT_TET4, ELEMENT_HEX8, ELEMENT_TET10, ELEMENT_HEX27};

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(UserErrorInitialize());
  PetscCall(TestExactNumbers());
  for (PetscInt i = 0; i < 4; i++) {
    for (PetscInt j = 0; j < 4; j++) PetscCall(TestFlat(cells[i], cells[j], MULTIPLIERS_NODES));
    PetscCall(TestCuts(cells[i], cells[(i + 1) % 4], MULTIPLIERS_NODES));
    PetscCall(TestAskew(cells[i], cells[(i + 1) % 4]));
    PetscCall(TestCrosspoints(cells[i], MULTIPLIERS_NODES));
    PetscCall(TestTwoLayers(cells[i]));
  }
  for (PetscInt i = 2; i < 4; i++) {
    PetscCall(TestFlat(cells[i], cells[5 - i], MULTIPLIERS_VERTICES));
    PetscCall(TestCuts(cells[i], cells[5 - i], MULTIPLIERS_VERTICES));
    PetscCall(TestCrosspoints(cells[i], MULTIPLIERS_VERTICES));
  }
  PetscCall(PetscFinalize());
  return 0;
}

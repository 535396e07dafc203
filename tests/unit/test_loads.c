/* test_loads.c -- total loads of formulas with jumps and kinks inside facets and cells, by closed formulas. */
#include "base/compat.h"
#include "problem/elasticity.h"
#include "solid_scene.h"

/* What totals are promised to, relative to themselves. */
static const PetscReal PROMISED = 1e-10;

/* One box with one load. */
typedef struct {
  PetscInt    dim, faces[3], order;
  PetscBool   simplex;
  ModelKind   model;
  const char *side; /* of a traction or pressure; NULL for a body force */
  PetscBool   pressure;
  const char *value;
  PetscInt    component;
  PetscReal   total;
} Case;

static const Case CASES[] = {
    /* tractions on one facet and on sixteen; a strip as narrow as 0.003 of a facet; kinks */
    {2, {1, 1}, 1, PETSC_FALSE, MODEL_PLANE_STRAIN, "top", PETSC_FALSE, "0, (x>0.7) ? -10 : 0", 1, -3.},
    {2, {16, 16}, 2, PETSC_FALSE, MODEL_PLANE_STRAIN, "top", PETSC_FALSE, "0, (x>0.7) ? -10 : 0", 1, -3.},
    {2, {1, 1}, 2, PETSC_FALSE, MODEL_PLANE_STRAIN, "top", PETSC_FALSE, "(x>0.997) ? 1 : 0, 5", 0, 0.003},
    {2, {5, 2}, 1, PETSC_TRUE, MODEL_PLANE_STRAIN, "top", PETSC_FALSE, "0, abs(x-0.7)", 1, 0.29},
    /* (1 - x^2)^1/2 at the end of a side: a root */
    {2, {3, 3}, 2, PETSC_FALSE, MODEL_PLANE_STRAIN, "top", PETSC_TRUE, "sqrt(1-x^2)", 1, -PETSC_PI / 4.},
    /* body forces in the plane: beyond an oblique line, on a disc, on a disc with a kink around it */
    {2, {1, 1}, 1, PETSC_FALSE, MODEL_PLANE_STRAIN, NULL, PETSC_FALSE, "0, (x+2*y>1.3) ? -10 : 0", 1, -6.},
    {2, {7, 5}, 2, PETSC_TRUE, MODEL_PLANE_STRAIN, NULL, PETSC_FALSE, "0, (x+2*y>1.3) ? -10 : 0", 1, -6.},
    {2,
     {6, 6},
     2,
     PETSC_FALSE,
     MODEL_PLANE_STRAIN,
     NULL,
     PETSC_FALSE,
     "((x-.5)^2+(y-.47)^2<.09) ? 2 : 0, 0",
     0,
     0.18 * PETSC_PI},
    {2,
     {3, 3},
     1,
     PETSC_TRUE,
     MODEL_PLANE_STRAIN,
     NULL,
     PETSC_FALSE,
     "0, max(0, .09-(x-.5)^2-(y-.5)^2)",
     1,
     0.00405 * PETSC_PI},
    /* rings: the end face beyond r = 0.7, and the volume below z = 0.3 */
    {2, {4, 4}, 1, PETSC_FALSE, MODEL_AXISYMMETRIC, "top", PETSC_FALSE, "0, (r>0.7) ? 1 : 0", 1, 0.51 * PETSC_PI},
    {2, {3, 4}, 2, PETSC_FALSE, MODEL_AXISYMMETRIC, NULL, PETSC_FALSE, "0, (y<0.3) ? 1 : 0", 1, 0.3 * PETSC_PI},
    /* pressure on a disc in space; the same in one facet, and on triangles */
    {3,
     {9, 8, 1},
     1,
     PETSC_FALSE,
     MODEL_SOLID,
     "top",
     PETSC_TRUE,
     "((x-.5)^2+(y-.47)^2<.09) ? 10 : 0",
     2,
     -0.9 * PETSC_PI},
    {3,
     {1, 1, 1},
     2,
     PETSC_FALSE,
     MODEL_SOLID,
     "top",
     PETSC_TRUE,
     "((x-.5)^2+(y-.47)^2<.09) ? 10 : 0",
     2,
     -0.9 * PETSC_PI},
    {3,
     {4, 4, 1},
     1,
     PETSC_TRUE,
     MODEL_SOLID,
     "top",
     PETSC_TRUE,
     "((x-.5)^2+(y-.47)^2<.09) ? 10 : 0",
     2,
     -0.9 * PETSC_PI},
    /* body forces in space, beyond planes */
    {3, {2, 2, 4}, 1, PETSC_FALSE, MODEL_SOLID, NULL, PETSC_FALSE, "0, 0, (z>0.7) ? -10 : 0", 2, -3.},
    {3, {3, 2, 2}, 1, PETSC_FALSE, MODEL_SOLID, NULL, PETSC_FALSE, "0, (x>0.7) ? -10 : 0, 0", 1, -3.},
    {3, {2, 2, 1}, 2, PETSC_FALSE, MODEL_SOLID, NULL, PETSC_FALSE, "0, 0, (x+2*y>1.3) ? -10 : 0", 2, -6.},
    /* two planes, a kink along an oblique one, a cylinder, a ball */
    {3, {2, 3, 2}, 2, PETSC_TRUE, MODEL_SOLID, NULL, PETSC_FALSE, "(x>0.3 && y>0.45) ? 2 : 0, 0, 0", 0, 0.77},
    {3, {2, 3, 2}, 1, PETSC_FALSE, MODEL_SOLID, NULL, PETSC_FALSE, "0, abs(x+2*y-1), 0", 1, 2. / 3.},
    {3, {2, 2, 2}, 1, PETSC_TRUE, MODEL_SOLID, NULL, PETSC_FALSE, "abs(x+y-z), 0, 0", 0, 7. / 12.},
    {3, {3, 3, 1}, 1, PETSC_FALSE, MODEL_SOLID, NULL, PETSC_FALSE, "max(0, 1-4*(x^2+y^2)), 0, 0", 0, PETSC_PI / 32.},
    {3,
     {2, 2, 2},
     1,
     PETSC_FALSE,
     MODEL_SOLID,
     NULL,
     PETSC_FALSE,
     "0, 0, x^2+y^2+z^2<0.49 ? 1 : 0",
     2,
     0.343 * PETSC_PI / 6.},
    /* the same ball, a Hertz type in it, two cylinders that touch, in tetrahedra */
    {3,
     {2, 2, 2},
     1,
     PETSC_TRUE,
     MODEL_SOLID,
     NULL,
     PETSC_FALSE,
     "0, 0, x^2+y^2+z^2<0.49 ? 1 : 0",
     2,
     0.343 * PETSC_PI / 6.},
    {3,
     {2, 2, 2},
     1,
     PETSC_TRUE,
     MODEL_SOLID,
     NULL,
     PETSC_FALSE,
     "0, sqrt(max(0, 1-(x^2+y^2+z^2)/.49)), 0",
     1,
     0.343 * PETSC_PI *PETSC_PI / 32.},
    {3,
     {1, 1, 1},
     2,
     PETSC_TRUE,
     MODEL_SOLID,
     NULL,
     PETSC_FALSE,
     "x^2+y^2<.49 && y^2+z^2<.49 ? 1 : 0, 0, 0",
     0,
     0.343 * 2. / 3.},
    /* a lens of two discs: 2 R^2 acos(d/R) - 2 d (R^2 - d^2)^1/2 with d = 0.1 */
    {2,
     {3, 3},
     1,
     PETSC_TRUE,
     MODEL_PLANE_STRAIN,
     NULL,
     PETSC_FALSE,
     "(x-.34451025279448844)^2+(y-.44464036307513732)^2<.19417262894295745^2 && "
     "(x-.54451025279448844)^2+(y-.44464036307513732)^2<.19417262894295745^2 ? 1 : 0, 0",
     0,
     0.04436332634844418},
    /* Hertz' pressure and a cone on facets in space */
    {3,
     {5, 4, 1},
     2,
     PETSC_TRUE,
     MODEL_SOLID,
     "top",
     PETSC_TRUE,
     "sqrt(max(0, 1-((x-.5)^2+(y-.47)^2)/.09))",
     2,
     -0.06 * PETSC_PI},
    {3,
     {5, 4, 1},
     1,
     PETSC_FALSE,
     MODEL_SOLID,
     "top",
     PETSC_TRUE,
     "max(0, 1-sqrt((x-.5)^2+(y-.47)^2)/.3)",
     2,
     -0.03 * PETSC_PI},
    /* smooth, but steep: finer rules, also next to a kink that is hidden: (e^6-1)/6 + (.53^2+.47^2)/2 */
    {2, {5, 1}, 1, PETSC_FALSE, MODEL_PLANE_STRAIN, NULL, PETSC_FALSE, "exp(6*x), 0", 0, 67.071465582122524},
    {2,
     {5, 1},
     1,
     PETSC_FALSE,
     MODEL_PLANE_STRAIN,
     NULL,
     PETSC_FALSE,
     "exp(6*x)+sqrt((x-.53)^2), 0",
     0,
     67.322365582122524},
    {2,
     {5, 1},
     2,
     PETSC_TRUE,
     MODEL_PLANE_STRAIN,
     NULL,
     PETSC_FALSE,
     "exp(6*x)+sqrt((x-.53)^2), 0",
     0,
     67.322365582122524},
    {3, {3, 3, 3}, 1, PETSC_FALSE, MODEL_SOLID, NULL, PETSC_FALSE, "0, 0, exp(2*x+3*y)*(1+z)", 2, 30.484641520114573},
    {3, {2, 2, 2}, 2, PETSC_TRUE, MODEL_SOLID, NULL, PETSC_FALSE, "0, 0, exp(2*x+3*y)*(1+z)", 2, 30.484641520114573},
};

/* The sum of the nodal loads. */
static PetscReal TotalLoad(TestScene *t, PetscInt component)
{
  Mesh        mesh = TestSceneMesh(t);
  PetscScalar total;
  Mat         K;
  Vec         f;

  CHECK(!ElasticityAssemble(&t->scene, MeshFinest(mesh), &K, &f));
  CHECK(!VecStrideSum(f, component, &total));
  CHECK(!MatDestroy(&K));
  CHECK(!VecDestroy(&f));
  CHECK(!MeshDestroy(&mesh));
  return PetscRealPart(total);
}

static void CheckCase(const Case *c)
{
  const PetscReal lower[3] = {0, 0, 0}, upper[3] = {1, 1, 1};
  TestScene       t;
  SceneBody      *body;

  SolidSceneInit(&t);
  t.scene.dim   = c->dim;
  t.scene.model = c->model;
  body          = SolidSceneAddBox(&t, "body", c->faces, lower, upper);
  body->order   = c->order;
  body->simplex = c->simplex;
  if (c->side)
    TestSceneAddBoundary(body, c->pressure ? BOUNDARY_PRESSURE : BOUNDARY_TRACTION, c->side, c->value);
  else
    CHECK(!ExpressionCreate(PETSC_COMM_WORLD, "-force", c->value, c->dim, PETSC_FALSE, &body->material.body_force));
  CHECK_NEAR(TotalLoad(&t, c->component), c->total, PROMISED * PetscAbsReal(c->total));
  CHECK(!ExpressionDestroy(&body->material.body_force));
  TestSceneFree(&t);
}

/* A pressure on a disc, which pushes along z on top of a box, has no moment about z. About x and y it is its
   place times the force. */
static void TestMoment(PetscBool simplex)
{
  const PetscReal    lower[3] = {0, 0, 0}, upper[3] = {1, 1, 1}, force = -0.9 * PETSC_PI;
  const PetscInt     faces[3]  = {5, 4, 1};
  PetscReal          moment[2] = {0., 0.};
  TestScene          t;
  SceneBody         *body;
  Mesh               mesh;
  Level             *level;
  Mat                K;
  Vec                f;
  const PetscScalar *fa;

  SolidSceneInit(&t);
  body          = SolidSceneAddBox(&t, "body", faces, lower, upper);
  body->order   = 2;
  body->simplex = simplex;
  TestSceneAddBoundary(body, BOUNDARY_PRESSURE, "top", "((x-.5)^2+(y-.47)^2<.09) ? 10 : 0");
  mesh  = TestSceneMesh(&t);
  level = MeshFinest(mesh);
  CHECK(!ElasticityAssemble(&t.scene, level, &K, &f));
  CHECK(!VecGetArrayRead(f, &fa));
  for (PetscInt n = 0; n < level->num_owned; n++) {
    for (PetscInt k = 0; k < 2; k++) moment[k] += level->coords[3 * n + k] * PetscRealPart(fa[3 * n + 2]);
  }
  CHECK(!VecRestoreArrayRead(f, &fa));
  CHECK(!MPI_Allreduce(MPI_IN_PLACE, moment, 2, MPIU_REAL, MPI_SUM, PETSC_COMM_WORLD));
  CHECK_NEAR(moment[0], 0.5 * force, PROMISED);
  CHECK_NEAR(moment[1], 0.47 * force, PROMISED);
  CHECK(!MatDestroy(&K));
  CHECK(!VecDestroy(&f));
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* On a side that bends at (2, 0) a pressure beyond x = 1.3, between y = -0.7 and 0.7, pushes along x with this height. */
static void TestPressureOnCurve(void)
{
  TestScene  t;
  SceneBody *body;

  TestSceneInit(&t);
  body = TestSceneAddBox(&t, "body", 1, 2, 0, -1, 1, 1);
  TestSceneSetMap(body, "x*(2-abs(y)), y");
  TestSceneAddBoundary(body, BOUNDARY_PRESSURE, "right", "(x>1.3) ? 5 : 0"); /* sides (1,-1), (2,0), (1,1) */
  CHECK_NEAR(TotalLoad(&t, 0), -5 * 1.4, PROMISED * 7);
  TestSceneFree(&t);
}

/* A quarter of a ball, around an edge, inside tetrahedra of order 2 with curved sides, whose map keeps volumes. */
static void TestBallInCurves(void)
{
  const PetscReal lower[3] = {0, 0, 0}, upper[3] = {1, 1, 1};
  const PetscInt  faces[3] = {2, 2, 2};
  TestScene       t;
  SceneBody      *body;

  SolidSceneInit(&t);
  body          = SolidSceneAddBox(&t, "body", faces, lower, upper);
  body->order   = 2;
  body->simplex = PETSC_TRUE;
  CHECK(!ExpressionCreate(PETSC_COMM_WORLD, "-map", "x, y, z+0.2*x*y", 3, PETSC_FALSE, &body->map));
  CHECK(!ExpressionCreate(PETSC_COMM_WORLD, "-force", "0, 0, x^2+y^2+(z-.5)^2<.09 ? 1 : 0", 3, PETSC_FALSE,
                          &body->material.body_force));
  CHECK_NEAR(TotalLoad(&t, 2), 0.009 * PETSC_PI, PROMISED * 0.009 * PETSC_PI);
  CHECK(!ExpressionDestroy(&body->material.body_force));
  TestSceneFree(&t);
}

/* Sanitizers make each case thirty times as long, and several ranks thrice. */
int main(int argc, char **argv)
{
  PetscMPIInt size;

  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(CASES); i += SANITIZED ? 7 : size > 1 ? 3 : 1) CheckCase(&CASES[i]);
  TestPressureOnCurve();
  if (!SANITIZED) TestBallInCurves();
  TestMoment(PETSC_FALSE);
  TestMoment(PETSC_TRUE);
  PetscCall(PetscFinalize());
  return 0;
}

/* test_sideshape.c -- normals and curvatures of circles, cylinders and spheres cut into facets, up to their ends, and at edges. */
#include "solid_scene.h"
#include "base/compat.h"
#include "kernel/frame.h"
#include "side/sideshape.h"

enum { F = ELEMENT_MAX_FACET_NODES };

static const PetscReal EXACT = 1e-12;

/* Largest errors over all corners: of the normal against x / |x| across an axis, of the curvature against (1 - n n' - a a') / R. */
typedef struct {
  PetscReal normal, curvature;
  PetscInt  ridges;
} Errors;

/* [in] axis - unit, or zero for a sphere; [in] sign - 1 for a convex side */
static Errors MeasureRound(TestScene *t, PetscInt dim, const char side[], const PetscReal axis[], PetscReal sign)
{
  Mesh      mesh   = TestSceneMesh(t);
  Level    *level  = MeshFinest(mesh);
  Errors    errors = {0, 0, 0};
  Facets    facets;
  SideShape shape;

  CHECK(!LevelGetFacets(level, &t->scene, 0, side, &facets));
  CHECK(!SideShapeCreate(level, &facets, NULL, &shape));
  for (PetscInt f = 0; f < facets.num; ++f) {
    for (PetscInt i = 0; i < ElementNumNodes(facets.type[f]); ++i) {
      const PetscReal *x = &level->coords[facets.nodes[f * F + i] * dim], *n = &shape.normal[(f * F + i) * dim];
      PetscReal        r[3], R = 0, along = 0;

      for (PetscInt k = 0; k < dim; ++k) along += x[k] * axis[k];
      for (PetscInt k = 0; k < dim; ++k) {
        r[k] = x[k] - along * axis[k];
        R += r[k] * r[k];
      }
      R = PetscSqrtReal(R);
      for (PetscInt k = 0; k < dim; ++k) errors.normal = PetscMax(errors.normal, PetscAbsReal(n[k] - sign * r[k] / R));
      for (PetscInt k = 0; k < dim * dim; ++k) {
        const PetscInt  a = k / dim, b = k % dim;
        const PetscReal S = sign * ((a == b ? 1 : 0) - r[a] * r[b] / (R * R) - axis[a] * axis[b]) / R;

        errors.curvature = PetscMax(errors.curvature, PetscAbsReal(shape.curvature[(f * F + i) * dim * dim + k] - S));
      }
      if (shape.ridge[f * F + i] != 0) ++errors.ridges;
    }
  }
  CHECK(!SideShapeDestroy(&shape));
  CHECK(!FacetsDestroy(&facets));
  CHECK(!MeshDestroy(&mesh));
  CHECK(!MPI_Allreduce(MPI_IN_PLACE, &errors.normal, 1, MPIU_REAL, MPIU_MAX, PETSC_COMM_WORLD));
  CHECK(!MPI_Allreduce(MPI_IN_PLACE, &errors.curvature, 1, MPIU_REAL, MPIU_MAX, PETSC_COMM_WORLD));
  CHECK(!MPI_Allreduce(MPI_IN_PLACE, &errors.ridges, 1, MPIU_INT, MPI_SUM, PETSC_COMM_WORLD));
  return errors;
}

/* An arc of unequal segments, convex and concave. */
static void TestCircle(void)
{
  const PetscReal none[3] = {0, 0, 0};
  TestScene       t;
  Errors          errors;

  TestSceneInit(&t);
  (void)TestSceneAddBox(&t, "ring", 2, 7, 2, 0, 3, 1);
  (void)TestSceneAddPair(&t, "outer", 0, "right", 0, "left");
  TestSceneSetMap(&t.bodies[0], "x*cos(y+0.2*y^2),x*sin(y+0.2*y^2)");
  for (PetscInt trial = 0; trial < 4; ++trial) {
    const PetscInt inner = trial % 2;

    t.bodies[0].order = 1 + trial / 2;
    errors            = MeasureRound(&t, 2, inner ? "left" : "right", none, inner ? -1 : 1);
    CHECK_NEAR(errors.normal, 0, EXACT);
    CHECK_NEAR(errors.curvature, 0, EXACT);
    CHECK(errors.ridges == 0);
  }
  TestSceneFree(&t);
}

/* The normal of curves 0 and 3, an ellipse, and of curves 1 and 2, a line that passes over into an arc at x = 1. */
static void CurveNormal(PetscInt curve, const PetscReal x[2], PetscReal n[2])
{
  const PetscBool ellipse = (PetscBool)(curve % 3 == 0);

  n[0] = ellipse ? x[0] / 4 : PetscMax(x[0] - 1, 0);
  n[1] = ellipse ? x[1] : x[0] > 1 ? x[1] + 1 : 1;
  (void)FrameNormalize(2, n);
}

/* The largest error of a normal on a side of unequal facets; on curve 2 of those of the line. [out] told - the largest one
   that is told of the same nodes, or NULL */
static PetscReal CurveError(PetscInt curve, PetscInt order, PetscInt facets_along, PetscReal *told)
{
  const char *const line    = "x<1?x:1+(1+y)*sin((x-1)*(1+0.1*x)),x<1?y:(1+y)*cos((x-1)*(1+0.1*x))-1";
  const char *const maps[4] = {"2*(1+y)*sin(0.3+0.5*x+0.05*x^2),(1+y)*cos(0.3+0.5*x+0.05*x^2)", line, line,
                               "2*(1+y)*sin(pi/4*(x+0.15*sin(pi*x))),(1+y)*cos(pi/4*(x+0.15*sin(pi*x)))"};

  TestScene t;
  Level    *level;
  Mesh      mesh;
  Facets    facets;
  SideShape shape;
  PetscReal error[2] = {0, 0}; // true, told

  TestSceneInit(&t);
  (void)TestSceneAddBox(&t, "body", facets_along, 1, 0, -0.2, 2, 0);
  (void)TestSceneAddPair(&t, "pair", 0, "top", 0, "bottom");
  TestSceneSetMap(&t.bodies[0], maps[curve]);
  for (PetscInt i = 0; i < 2 && curve == 3; ++i)
    TestSceneAddBoundary(&t.bodies[0], BOUNDARY_NORMAL, i ? "right" : "left", NULL);
  t.bodies[0].order = order;
  mesh              = TestSceneMesh(&t);
  level             = MeshFinest(mesh);
  CHECK(!LevelGetFacets(level, &t.scene, 0, "top", &facets));
  CHECK(!SideShapeCreate(level, &facets, NULL, &shape));
  for (PetscInt f = 0; f < facets.num; ++f) {
    for (PetscInt i = 0; i < 1 + order; ++i) {
      PetscReal n[2];

      CurveNormal(curve, &level->coords[2 * facets.nodes[f * F + i]], n);
      if (curve == 2 && level->coords[2 * facets.nodes[f * F + i]] > 1.01) continue;
      for (PetscInt k = 0; k < 2; ++k)
        error[0] = PetscMax(error[0], PetscAbsReal(n[k] - shape.normal[(f * F + i) * 2 + k]));
      error[1] = PetscMax(error[1], shape.error[f * F + i]);
    }
  }
  CHECK(!SideShapeDestroy(&shape));
  CHECK(!FacetsDestroy(&facets));
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
  CHECK(!MPI_Allreduce(MPI_IN_PLACE, error, 2, MPIU_REAL, MPIU_MAX, PETSC_COMM_WORLD));
  if (told) *told = error[1];
  return error[0];
}

/* Fourth order on an ellipse (third at its ends); exact where a line passes over into an arc. A line of two facets stays one.
   Where an ellipse ends on planes of symmetry, all is of fourth order, and errors are known. */
static void TestCurves(void)
{
  for (PetscInt order = 1; order <= 2; ++order) {
    PetscReal told, error;

    CHECK(CurveError(0, order, 12 / order, NULL) < 2e-3);
    CHECK(CurveError(0, order, 96 / order, NULL) < CurveError(0, order, 48 / order, NULL) / 6.5);
    CHECK_NEAR(CurveError(1, order, 12 / order, &told), 0, EXACT);
    CHECK_NEAR(told, 0, 0);
    CHECK_NEAR(CurveError(2, order, 4 / order, NULL), 0, EXACT);
    error = CurveError(3, order, 48 / order, &told);
    CHECK(CurveError(3, order, 96 / order, NULL) < error / 14);
    CHECK(told > 0.8 * error && told < 2 * error);
  }
}

/* A part of a cylinder and of a sphere, as quads with unequal edges; one facet wide, too. */
static void TestSolids(void)
{
  const char *ball =
      "z*tan(x)/sqrt(1+tan(x)^2+tan(y)^2), z*tan(y)/sqrt(1+tan(x)^2+tan(y)^2), z/sqrt(1+tan(x)^2+tan(y)^2)";
  const PetscReal lower[3] = {-0.4, -0.3, 1}, upper[3] = {0.4, 0.5, 2}, axis[2][3] = {{0, 1, 0}, {0, 0, 0}};
  const PetscInt  faces[2][3] = {{5, 1, 1}, {6, 5, 1}};

  for (PetscInt trial = 0; trial < 4; ++trial) {
    const PetscInt sphere = trial % 2;
    TestScene      t;
    Errors         errors;

    SolidSceneInit(&t);
    (void)SolidSceneAddBox(&t, "part", faces[sphere], lower, upper);
    (void)TestSceneAddPair(&t, "outer", 0, "top", 0, "bottom");
    t.bodies[0].order = 1 + trial / 2;
    CHECK(!ExpressionCreate(PETSC_COMM_WORLD, "-map", sphere ? ball : "z*sin(x), y, z*cos(x)", 3, PETSC_FALSE,
                            &t.bodies[0].map));
    errors = MeasureRound(&t, 3, "top", axis[sphere], 1);
    CHECK_NEAR(errors.normal, 0, EXACT);
    CHECK_NEAR(errors.curvature, 0, EXACT);
    errors = MeasureRound(&t, 3, "bottom", axis[sphere], -1);
    CHECK_NEAR(errors.normal, 0, EXACT);
    CHECK_NEAR(errors.curvature, 0, EXACT);
    TestSceneFree(&t);
  }
}

/* A part of a cylinder of tetrahedra, one and two facets long: no mirror image across a diagonal is exact there. */
static void TestTriangles(void)
{
  const PetscReal lower[3] = {-0.4, -0.3, 1}, upper[3] = {0.4, 0.5, 2}, axis[3] = {0, 1, 0};

  for (PetscInt trial = 0; trial < 4; ++trial) {
    const PetscInt faces[3] = {5, 1 + trial % 2, 1};
    TestScene      t;

    SolidSceneInit(&t);
    SolidSceneAddBox(&t, "part", faces, lower, upper)->simplex = PETSC_TRUE;
    (void)TestSceneAddPair(&t, "outer", 0, "top", 0, "bottom");
    t.bodies[0].order = 1 + trial / 2;
    CHECK(!ExpressionCreate(PETSC_COMM_WORLD, "-map", "z*sin(x), y, z*cos(x)", 3, PETSC_FALSE, &t.bodies[0].map));
    CHECK_NEAR(MeasureRound(&t, 3, "top", axis, 1).normal, 0, EXACT);
    CHECK_NEAR(MeasureRound(&t, 3, "bottom", axis, -1).normal, 0, EXACT);
    TestSceneFree(&t);
  }
}

enum { CYLINDER, CONE, FILLET, TORUS, WAVES, NUM_SHAPES };

/* The normal of a shape at a point of its upper side, of radius 2. */
static void ShapeNormal(PetscInt shape, const PetscReal x[3], PetscReal n[3])
{
  const PetscReal within = shape == TORUS ? 1 - 4 / PetscSqrtReal(x[0] * x[0] + x[2] * x[2]) : 1;

  n[0] = shape == FILLET && x[0] < 0 ? 0 : x[0];
  n[1] = shape == CONE ? 0.3 * (2 - 0.3 * x[1]) : 0;
  n[2] = shape == FILLET && x[0] < 0 ? 2 : x[2];
  if (shape == TORUS) {
    n[0] = within * x[0];
    n[1] = x[1];
    n[2] = within * x[2];
  }
  if (shape == WAVES) {
    n[0] = -0.6 * PetscCosReal(3 * x[0]) * PetscSinReal(4 * x[1]);
    n[1] = -0.8 * PetscSinReal(3 * x[0]) * PetscCosReal(4 * x[1]);
    n[2] = 1;
  }
  (void)FrameNormalize(3, n);
}

/* What is told of errors is 1 to 2 times as large as they are, in the mean square over nodes where it is known. [in] sums - of
   squares: of errors, of what is told */
static void CheckTold(const PetscReal sums[2])
{
  const PetscReal share = PetscSqrtReal(sums[1] / sums[0]);

  CHECK(share > 0.9 && share < 2);
}

/* Facets that are no rectangles in halves, of a file for all that the sides know: a cylinder, a cone, a plane that
   passes over into a cylinder; a torus and waves, which are no quadrics. Means over facets are off by 0.007 to 0.026, on the
   torus by 4e-3 and 1e-3 in the mean. */
static void TestQuadrics(PetscInt kind, PetscInt order)
{
  const char *const maps[]   = {"z*sin(x+0.05*sin(9*x+5*y)), y+0.03*sin(7*x+8*y), z*cos(x+0.05*sin(9*x+5*y))",
                                "(z-0.3*y)*sin(x+0.05*sin(9*x+5*y)), y, (z-0.3*y)*cos(x+0.05*sin(9*x+5*y))",
                                "x < 0 ? z*x : z*sin(x), y+0.03*sin(7*x+8*y), x < 0 ? z : z*cos(x)",
                                "(4+z*sin(y+0.03*sin(7*x+8*y)))*sin(x+0.05*sin(9*x+5*y)), z*cos(y+0.03*sin(7*x+8*y)), "
                                  "(4+z*sin(y+0.03*sin(7*x+8*y)))*cos(x+0.05*sin(9*x+5*y))",
                                "x+0.02*sin(9*x+5*y), y+0.03*sin(7*x+8*y), "
                                  "(z-1)*(2+0.2*sin(3*(x+0.02*sin(9*x+5*y)))*sin(4*(y+0.03*sin(7*x+8*y))))"};
  const PetscReal   lower[3] = {-0.6, -0.3, 1}, upper[3] = {0.6, 0.5, 2};
  const PetscInt    faces[3] = {12, 6, 1};
  TestScene         t;
  Mesh              mesh;
  Level            *level;
  PetscReal         errors[2] = {0, 0}, squares[2] = {0, 0}; // sum and number; of both, where one is told
  Facets            facets;
  SideShape         shape;

  SolidSceneInit(&t);
  SolidSceneAddBox(&t, "part", faces, lower, upper)->simplex = PETSC_TRUE;
  (void)TestSceneAddPair(&t, "outer", 0, "top", 0, "bottom");
  t.bodies[0].order = order;
  CHECK(!ExpressionCreate(PETSC_COMM_WORLD, "-map", maps[kind], 3, PETSC_FALSE, &t.bodies[0].map));
  mesh  = TestSceneMesh(&t);
  level = MeshFinest(mesh);
  CHECK(!ExpressionDestroy(&t.bodies[0].map));
  t.bodies[0].mesh_file = (char *)"part.msh";
  CHECK(!LevelGetFacets(level, &t.scene, 0, "top", &facets));
  CHECK(!SideShapeCreate(level, &facets, NULL, &shape));
  for (PetscInt f = 0; f < facets.num; ++f) {
    for (PetscInt i = 0; i < ElementNumNodes(facets.type[f]); ++i) {
      const PetscReal told   = shape.error[f * F + i];
      PetscReal       square = 0, n[3];

      ShapeNormal(kind, &level->coords[3 * facets.nodes[f * F + i]], n);
      for (PetscInt k = 0; k < 3; ++k) {
        const PetscReal error = PetscAbsReal(shape.normal[(f * F + i) * 3 + k] - n[k]);

        if (kind < TORUS) CHECK_NEAR(error, 0, kind == FILLET ? 1e-4 : 1e-9);
        errors[0] += error;
        errors[1] += 1;
        square += error * error;
      }
      if (kind < TORUS) CHECK_NEAR(told, 0, 0);
      squares[0] += told > 0 ? square : 0;
      squares[1] += told * told;
    }
  }
  CHECK(!MPI_Allreduce(MPI_IN_PLACE, errors, 2, MPIU_REAL, MPIU_SUM, PETSC_COMM_WORLD));
  CHECK(!MPI_Allreduce(MPI_IN_PLACE, squares, 2, MPIU_REAL, MPIU_SUM, PETSC_COMM_WORLD));
  if (kind >= TORUS) CheckTold(squares);
  if (kind == TORUS) CHECK(errors[0] / errors[1] < (order == 1 ? 5e-4 : 3e-5));
  t.bodies[0].mesh_file = NULL;
  CHECK(!SideShapeDestroy(&shape));
  CHECK(!FacetsDestroy(&facets));
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* Two sides of a box as one: each facet has the normal of its own side, exactly flat. The edge between them
   is a convex ridge. */
static void TestEdge(void)
{
  TestScene t;
  Mesh      mesh;
  Level    *level;
  Facets    facets;
  SideShape shape;
  PetscInt  ridges = 0;
  PetscBool curved;

  TestSceneInit(&t);
  (void)TestSceneAddBox(&t, "box", 3, 4, 0, 0, 1, 1);
  (void)TestSceneAddPair(&t, "corner", 0, "top+right", 0, "left");
  mesh  = TestSceneMesh(&t);
  level = MeshFinest(mesh);
  CHECK(!LevelGetFacets(level, &t.scene, 0, "top+right", &facets));
  CHECK(!SideShapeCreate(level, &facets, NULL, &shape));
  for (PetscInt f = 0; f < facets.num; ++f) {
    const PetscReal *a = &level->coords[2 * facets.nodes[f * F]], *b = &level->coords[2 * facets.nodes[f * F + 1]];
    const PetscBool  top = (PetscBool)(a[1] == b[1]);

    for (PetscInt i = 0; i < 2; ++i) {
      const PetscReal *x = i ? b : a, *n = &shape.normal[(f * F + i) * 2];

      CHECK_NEAR(n[0], top ? 0 : 1, EXACT);
      CHECK_NEAR(n[1], top ? 1 : 0, EXACT);
      CHECK(shape.ridge[f * F + i] == (x[0] == 1 && x[1] == 1 ? 1 : 0));
      ridges += shape.ridge[f * F + i] != 0;
    }
  }
  CHECK_NEAR(Total(ridges), 2, 0);
  CHECK(!SideShapeIsCurved(level, &facets, &shape, &curved));
  CHECK(!curved);
  CHECK(!SideShapeDestroy(&shape));
  CHECK(!FacetsDestroy(&facets));
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(UserErrorInitialize());
  TestCircle();
  TestCurves();
  TestSolids();
  TestTriangles();
  for (PetscInt kind = 0; kind < NUM_SHAPES; ++kind) {
    for (PetscInt order = 1; order <= 2; ++order) TestQuadrics(kind, order);
  }
  TestEdge();
  PetscCall(PetscFinalize());
  return 0;
}

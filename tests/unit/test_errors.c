/* test_errors.c -- gradients of formulas against closed forms, norms against integrals done by hand, and the sentences about
   exact solutions that cannot be. */
#include "test.h"
#include "two_boxes.h"
#include <math.h>
#include "result/errors.h"
#include <string.h>
#include "result/exact.h"

/* Errors of a gradient, relative to its size. STEP_ERROR is that of the step in the largest cell and beside a
   singular point. ROUNDING is that in a cell as long as the formula's own length. It grows as cells become
   shorter. */
static const PetscReal STEP_ERROR = 1e-9, ROUNDING = 5e-12;

/* A displacement and its gradient g[k][i] = d u_i / d x_k. */
typedef void (*FieldFn)(const PetscReal x[2], PetscReal u[2], PetscReal g[4]);

static const char smooth_text[] = "sin(3*x+y), exp(x)*cos(2*y)";

static void SmoothFn(const PetscReal x[2], PetscReal u[2], PetscReal g[4])
{
  u[0] = sin(3 * x[0] + x[1]);
  u[1] = exp(x[0]) * cos(2 * x[1]);
  g[0] = 3 * cos(3 * x[0] + x[1]);
  g[1] = u[1];
  g[2] = cos(3 * x[0] + x[1]);
  g[3] = -2 * exp(x[0]) * sin(2 * x[1]);
}

/* Real and imaginary part of sqrt(x + i y), whose derivative is 1 / (2 sqrt(x + i y)). */
static const char root_text[] = "sqrt((sqrt(x^2+y^2)+x)/2), sqrt((sqrt(x^2+y^2)-x)/2)";

static void RootFn(const PetscReal x[2], PetscReal u[2], PetscReal g[4])
{
  const PetscReal r = sqrt(x[0] * x[0] + x[1] * x[1]);

  u[0] = sqrt((r + x[0]) / 2);
  u[1] = sqrt((r - x[0]) / 2);
  g[0] = u[0] / (2 * r);
  g[1] = -u[1] / (2 * r);
  g[2] = -g[1];
  g[3] = g[0];
}

/* Nodes of a cell of size [h, h * ratio], turned by an angle, its corner at a point; cells of second order are bent. */
static void MakeCell(ElementType type, PetscReal h, PetscReal ratio, PetscReal angle, const PetscReal corner[2],
                     PetscReal X[])
{
  const PetscReal bend = ElementOrder(type) > 1 ? 0.1 : 0;

  for (PetscInt a = 0; a < ElementNumNodes(type); ++a) {
    const PetscReal *xi = ElementNode(type, a), s = xi[0], t = xi[1] + bend * s * (1 - s);

    X[2 * a]     = corner[0] + h * (cos(angle) * s - sin(angle) * ratio * t);
    X[2 * a + 1] = corner[1] + h * (sin(angle) * s + cos(angle) * ratio * t);
  }
}

/* Largest error of the gradient over a cell's quadrature points, relative to its size there. */
static PetscReal GradientError(Expression e, FieldFn field, ElementType type, const PetscReal X[])
{
  PetscReal      xi[2 * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS], phi[ELEMENT_MAX_NODES], worst = 0;
  const PetscInt n = QuadratureRule(type, 8, xi, w);

  CHECK(n > 0);
  for (PetscInt q = 0; q < n; ++q) {
    PetscReal       x[2], u[2], g[4], true_u[2], true_g[4], grad[2 * ELEMENT_MAX_NODES], size = 0, error = 0;
    const CellPoint at = {type, X, &xi[2 * q], grad, 1};

    ElementMap(type, X, &xi[2 * q], x, phi, grad);
    CHECK(!ExactEvaluate(e, &at, u, g));
    field(x, true_u, true_g);
    for (PetscInt i = 0; i < 2; ++i) CHECK_NEAR(u[i], true_u[i], 1e-14);
    for (PetscInt j = 0; j < 4; ++j) {
      size  = PetscMax(size, PetscAbsReal(true_g[j]));
      error = PetscMax(error, PetscAbsReal(g[j] - true_g[j]));
    }
    worst = PetscMax(worst, error / size);
  }
  return worst;
}

/* Large and small cells, needles, bent sides; a corner at the point where a root is singular. */
static void TestGradient(void)
{
  static const ElementType types[]   = {ELEMENT_TRI3, ELEMENT_QUAD4, ELEMENT_TRI6, ELEMENT_QUAD9};
  static const PetscReal   inside[2] = {0.3, 0.7}, origin[2] = {0, 0}, sizes[] = {1, 0.1, 1e-3}, ratios[] = {1, 1e-3};
  PetscReal                X[2 * ELEMENT_MAX_NODES], error;
  Expression               smooth, root;

  CHECK(!ExpressionCreate(PETSC_COMM_WORLD, "-smooth", smooth_text, 2, PETSC_FALSE, &smooth));
  CHECK(!ExpressionCreate(PETSC_COMM_WORLD, "-root", root_text, 2, PETSC_FALSE, &root));
  for (size_t t = 0; t < PETSC_STATIC_ARRAY_LENGTH(types); ++t) {
    for (size_t s = 0; s < PETSC_STATIC_ARRAY_LENGTH(sizes); ++s) {
      for (size_t r = 0; r < PETSC_STATIC_ARRAY_LENGTH(ratios); ++r) {
        MakeCell(types[t], sizes[s], ratios[r], 0.4, inside, X);
        error = GradientError(smooth, SmoothFn, types[t], X);
        printf("type %d of %g x %g: %.1e\n", (int)types[t], sizes[s], sizes[s] * ratios[r], error);
        CHECK(error < STEP_ERROR + ROUNDING / (sizes[s] * ratios[r]));
      }
      MakeCell(types[t], sizes[s], 1, 0.4, origin, X);
      error = GradientError(root, RootFn, types[t], X);
      printf("type %d of %g beside a root: %.1e\n", (int)types[t], sizes[s], error);
      CHECK(error < STEP_ERROR);
    }
  }
  CHECK(!ExpressionDestroy(&smooth));
  CHECK(!ExpressionDestroy(&root));
}

/* --- norms -------------------------------------------------------------------------------------------------------- */

/* Two boxes as in two_boxes.h, the upper one over [0,1] x [0,1], the lower one below [0.4,1.6]: cells and orders of one's
   choice, thickness 2. */
typedef struct {
  struct _n_Scene scene;
  SceneBody       bodies[2];
  ScenePair       pair;
  SceneBoundary   boundaries[2];
  Mesh            mesh;
  VI              vi;
} Case;

static PetscErrorCode CaseCreate(Case *c, PetscBool simplex, PetscInt order)
{
  static const PetscReal given[2] = {0, 0};

  PetscFunctionBeginUser;
  PetscCall(SetTwoBoxes(&c->scene, c->bodies, &c->pair));
  SetBox(&c->bodies[0], "upper", 6, 4, 0, 0, 1, 1);
  SetBox(&c->bodies[1], "lower", 6, 4, 0.4, -1, 1.6, 0);
  c->scene.thickness = 2;
  for (PetscInt b = 0; b < 2; b++) {
    c->bodies[b].simplex        = simplex;
    c->bodies[b].order          = order;
    c->boundaries[b]            = (SceneBoundary){BOUNDARY_DISPLACEMENT, (char *)(b ? "bottom" : "top"), NULL};
    c->bodies[b].num_boundaries = 1;
    c->bodies[b].boundaries     = &c->boundaries[b];
    PetscCall(ConstantCreate("-bc", 2, given, &c->boundaries[b].value));
  }
  PetscCall(MeshCreate(&c->scene, &c->mesh));
  PetscCall(MeshSetUp(c->mesh));
  PetscCall(VICreate(&c->scene, c->mesh, &c->vi));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode CaseDestroy(Case *c)
{
  PetscFunctionBeginUser;
  PetscCall(VIDestroy(&c->vi));
  PetscCall(MeshDestroy(&c->mesh));
  for (PetscInt b = 0; b < 2; b++) PetscCall(ExpressionDestroy(&c->bodies[b].exact));
  PetscCall(ExpressionDestroy(&c->pair.exact));
  PetscCall(DestroyTwoBoxes(c->bodies));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* eps : C eps of the material of two_boxes.h. */
static PetscReal Energy(PetscReal xx, PetscReal yy, PetscReal xy)
{
  PetscReal C[9];

  MaterialIsotropic(MODEL_PLANE_STRAIN, 1000, 0.3, C);
  return C[0] * (xx * xx + yy * yy) + 2 * C[1] * xx * yy + C[8] * xy * xy;
}

/* u = (ax x + ay y, by y), which every cell holds. */
static PetscErrorCode Linear(Level *level, PetscReal ax, PetscReal ay, PetscReal by, Vec *u)
{
  PetscScalar *a;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, 2, u));
  PetscCall(VecGetArray(*u, &a));
  for (PetscInt i = 0; i < level->num_owned; ++i) {
    const PetscReal *x = &level->coords[2 * i];

    a[2 * i]     = ax * x[0] + ay * x[1];
    a[2 * i + 1] = by * x[1];
  }
  PetscCall(VecRestoreArray(*u, &a));
  PetscCall(VecGhostUpdateBegin(*u, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGhostUpdateEnd(*u, INSERT_VALUES, SCATTER_FORWARD));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The difference of two linear displacements: integrals of polynomials over the two boxes. */
static PetscErrorCode TestDifference(PetscBool simplex, PetscInt order)
{
  /* u - v = (x + 2 y, 3 y): |.|^2 = x^2 + 4 x y + 13 y^2; of v = (x, 0) it is x^2 */
  const PetscReal third = 1. / 3., thickness = 2, x2 = (4.096 - 0.064) / 3, x1 = (2.56 - 0.16) / 2, width = 1.2;
  const PetscReal l2[]     = {third + 4 * 0.25 + 13 * third, x2 - 4 * x1 / 2 + 13 * third * width};
  const PetscReal size[]   = {third, x2};
  const PetscReal energy[] = {Energy(1, 3, 2), Energy(1, 3, 2) * width}, stiff = Energy(1, 3, 2) / Energy(1, 0, 0);
  Case            c;
  Vec             u, v;
  BodyError       body[2], total;

  PetscFunctionBeginUser;
  PetscCall(CaseCreate(&c, simplex, order));
  PetscCall(Linear(c.vi->level, 2, 2, 3, &u));
  PetscCall(Linear(c.vi->level, 1, 0, 0, &v));
  PetscCall(ErrorsComputeDifference(&c.scene, c.vi->level, u, v, body, &total));
  for (PetscInt b = 0; b < 2; ++b) {
    CHECK_NEAR(PetscSqr(body[b].l2), thickness * l2[b], 1e-12);
    CHECK_NEAR(PetscSqr(body[b].l2_relative), l2[b] / size[b], 1e-11);
    CHECK_NEAR(PetscSqr(body[b].energy) / (thickness * energy[b]), 1, 1e-12);
    CHECK_NEAR(PetscSqr(body[b].energy_relative), stiff, 1e-11);
  }
  CHECK_NEAR(PetscSqr(total.l2), thickness * (l2[0] + l2[1]), 1e-12);
  CHECK_NEAR(PetscSqr(total.l2_relative), (l2[0] + l2[1]) / (size[0] + size[1]), 1e-11);
  CHECK_NEAR(PetscSqr(total.energy_relative), stiff, 1e-11);
  PetscCall(VecDestroy(&u));
  PetscCall(VecDestroy(&v));
  PetscCall(CaseDestroy(&c));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* No displacement and the same pressure everywhere, against formulas: the error is then a polynomial too. */
static PetscErrorCode TestErrors(PetscBool simplex, PetscInt order)
{
  const PetscReal thickness = 2, third = 1. / 3.;
  Case            c;
  Fields          fields;
  Errors          errors;
  Vec             y;
  PetscReal       weight = 0;

  PetscFunctionBeginUser;
  PetscCall(CaseCreate(&c, simplex, order));
  PetscCall(VecDuplicate(c.vi->b, &y));
  PetscCall(VecZeroEntries(y));
  PetscCall(FieldsCreate(c.vi, NULL, y, &fields));
  PetscCall(ErrorsCompute(fields, &errors));
  CHECK(!errors.any);
  PetscCall(ErrorsDestroy(&errors));
  PetscCall(ExpressionCreate(PETSC_COMM_WORLD, "-u", "x^2,x*y", 2, PETSC_FALSE, &c.bodies[0].exact));
  PetscCall(ExpressionCreate(PETSC_COMM_WORLD, "-p", "1", 1, PETSC_FALSE, &c.pair.exact));
  PetscCall(VecSet(fields->u, 0));
  PetscCall(VecGhostUpdateBegin(fields->u, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGhostUpdateEnd(fields->u, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecSet(fields->lambda, 3));
  PetscCall(ErrorsCompute(fields, &errors));
  CHECK(errors.any);
  CHECK_NEAR(PetscSqr(errors.body[0].l2), thickness * (0.2 + third * third), 1e-12);
  /* strains 2x, x, y */
  CHECK_NEAR(PetscSqr(errors.body[0].energy) / (thickness * third * (Energy(2, 1, 0) + Energy(0, 0, 1))), 1, 1e-10);
  CHECK_NEAR(errors.body[0].l2_relative, 1, 1e-14);
  CHECK_NEAR(errors.body[0].energy_relative, 1, 1e-14);
  CHECK(PetscIsNanReal(errors.body[1].l2) && PetscIsNanReal(errors.total.energy)); /* where nothing is known */
  /* facets from x = 1/3 on carry a pressure */
  CHECK_NEAR(PetscSqr(errors.pair[0].l2), thickness * 4 * 2 * third, 1e-12);
  CHECK_NEAR(errors.pair[0].l2_relative, 2, 1e-13);
  for (PetscInt r = 0; r < c.vi->num_rows; ++r) weight += c.vi->row_D[r];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &weight, 1, MPIU_REAL, MPI_SUM, PETSC_COMM_WORLD));
  CHECK_NEAR(PetscSqr(errors.pair[0].weighted), 4 * weight, 1e-12);
  CHECK_NEAR(errors.pair[0].weighted_relative, 2, 1e-13);
  PetscCall(ErrorsDestroy(&errors));
  PetscCall(FieldsDestroy(&fields));
  PetscCall(VecDestroy(&y));
  PetscCall(CaseDestroy(&c));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* An exact solution with strains like r^(-1/2) at a corner: |u|^2 = r, and strains xx = yy = cos(theta/2) / (2 r^(1/2)), xy = 0. */
static PetscErrorCode TestSingular(PetscBool simplex, PetscInt order)
{
  const PetscReal thickness = 2, l = log(1 + sqrt(2.)), l2 = (sqrt(2.) + l) / 3;
  const PetscReal energy = Energy(1, 1, 0) / 4 * (2 * l + PETSC_PI / 4 + log(2.) / 2) / 2;
  Case            c;
  Vec             y;
  Fields          fields;
  Errors          errors;

  PetscFunctionBeginUser;
  PetscCall(CaseCreate(&c, simplex, order));
  PetscCall(ExpressionCreate(PETSC_COMM_WORLD, "-u", root_text, 2, PETSC_FALSE, &c.bodies[0].exact));
  PetscCall(VecDuplicate(c.vi->b, &y));
  PetscCall(VecZeroEntries(y));
  PetscCall(FieldsCreate(c.vi, NULL, y, &fields));
  PetscCall(ErrorsCompute(fields, &errors));
  printf("beside a root: %.1e, %.1e\n", PetscSqr(errors.body[0].l2) / (thickness * l2) - 1,
         PetscSqr(errors.body[0].energy) / (thickness * energy) - 1);
  CHECK_NEAR(PetscSqr(errors.body[0].l2) / (thickness * l2), 1, 1e-7);
  CHECK_NEAR(PetscSqr(errors.body[0].energy) / (thickness * energy), 1, 1e-3);
  PetscCall(ErrorsDestroy(&errors));
  PetscCall(FieldsDestroy(&fields));
  PetscCall(VecDestroy(&y));
  PetscCall(CaseDestroy(&c));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* An exact displacement of the upper body, whose top does not move. */
static PetscErrorCode Check(Case *c, const char text[], const char *const words[3])
{
  PetscErrorCode error;

  PetscFunctionBeginUser;
  PetscCall(ExpressionDestroy(&c->bodies[0].exact));
  PetscCall(ExpressionCreate(PETSC_COMM_WORLD, "-upper_exact_displacement", text, 2, PETSC_FALSE, &c->bodies[0].exact));
  error = ErrorsCheck(c->vi);
  CHECK(error == (words ? MORTISE_ERR_USER : PETSC_SUCCESS));
  for (PetscInt i = 0; words && i < 3; ++i) CHECK(strstr(UserErrorSentence(), words[i]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode TestCheck(void)
{
  static const char *const infinite[] = {"-upper_exact_displacement", "not a finite number", "(0.5, "};
  static const char *const moves[]    = {"-upper_exact_displacement", "upper:top", "along (0, 1)"};
  static const char *const value[]    = {", 1)", "0.001", "gives 0;"};
  Case                     c;

  PetscFunctionBeginUser;
  PetscCall(CaseCreate(&c, PETSC_FALSE, 1));
  PetscCall(ErrorsCheck(c.vi));
  PetscCall(Check(&c, "1-y,x*(1-y)", NULL));
  PetscCall(Check(&c, "1-y,x*(1-y)+1e-7", NULL)); /* numbers as exact as people write them */
  PetscCall(Check(&c, "1-y,x*(1-y)+1e-3", moves));
  PetscCall(Check(&c, "1-y,x*(1-y)+1e-3", value));
  PetscCall(Check(&c, "(1-y)/(x-0.5),0", infinite));
  PetscCall(CaseDestroy(&c));
  PetscFunctionReturn(PETSC_SUCCESS);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(UserErrorInitialize());
  TestGradient();
  for (PetscInt order = 1; order <= 2; ++order) {
    for (PetscInt simplex = 0; simplex < 2; ++simplex) {
      PetscCall(TestDifference((PetscBool)simplex, order));
      PetscCall(TestErrors((PetscBool)simplex, order));
      PetscCall(TestSingular((PetscBool)simplex, order));
    }
  }
  PetscCall(TestCheck());
  PetscCall(PetscFinalize());
  return 0;
}

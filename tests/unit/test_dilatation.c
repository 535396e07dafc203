/* test_dilatation.c -- which cells project their changes of volume, and what they project them to. */
#include "base/compat.h"
#include "kernel/dilatation.h"
#include "kernel/material.h"
#include <test.h>

#include "uniform.h"

enum { NUM_TRIALS = 100, MAX_DOFS = DILATATION_MAX_DOFS };

static const PetscReal EXACT = 1e-12;

/* What a Poisson's ratio asks of each type of cell; NAN is none. */
static void TestChoice(void)
{
  static const struct {
    ElementType    type;
    PetscReal      threshold;
    DilatationKind above;
  } rows[] = {{ELEMENT_TRI3, 0.45, DILATATION_LOCKS},  {ELEMENT_QUAD4, 0.45, DILATATION_MEAN},
              {ELEMENT_TET4, 0.45, DILATATION_LOCKS},  {ELEMENT_HEX8, 0.45, DILATATION_MEAN},
              {ELEMENT_TRI6, 0.49, DILATATION_MEAN},   {ELEMENT_QUAD9, 0.49, DILATATION_LINEAR},
              {ELEMENT_TET10, 0.49, DILATATION_LOCKS}, {ELEMENT_HEX27, 0.49, DILATATION_LINEAR}};

  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(rows); i++) {
    CHECK_NEAR(DilatationThreshold(rows[i].type), rows[i].threshold, 0.);
    CHECK(DilatationChoose(rows[i].type, rows[i].threshold) == DILATATION_POINTWISE);
    CHECK(DilatationChoose(rows[i].type, -0.9) == DILATATION_POINTWISE);
    CHECK(DilatationChoose(rows[i].type, NAN) == DILATATION_POINTWISE);
    CHECK(DilatationChoose(rows[i].type, rows[i].threshold + 1e-9) == rows[i].above);
    CHECK(DilatationChoose(rows[i].type, 0.4999994) == rows[i].above);
  }
}

/* The reference cell with shaken vertices and straight edges, stretched along its last axis. */
static void ShakenCell(ElementType type, PetscReal stretch, PetscReal X[])
{
  const ElementType linear = ElementLinear(type);
  const PetscInt    dim    = ElementDim(type);

  do {
    PetscReal vertices[8 * 3], phi[ELEMENT_MAX_NODES];

    for (PetscInt i = 0; i < ElementNumNodes(linear); i++) {
      for (PetscInt k = 0; k < dim; k++) {
        vertices[i * dim + k] = ElementNode(linear, i)[k] + Uniform(-0.2, 0.2);
        if (k == dim - 1) vertices[i * dim + k] *= stretch;
      }
    }
    for (PetscInt i = 0; i < ElementNumNodes(type); i++)
      ElementMap(linear, vertices, ElementNode(type, i), &X[i * dim], phi, NULL);
  } while (ElementMinJacobian(type, X) < 0.05 * stretch);
}

/* Points of the stiffness rule in a cell. */
typedef struct {
  ElementRule rule;
  PetscReal   x[ELEMENT_MAX_POINTS * 3], w[ELEMENT_MAX_POINTS], grad[ELEMENT_MAX_POINTS * MAX_DOFS];
} Points;

static void PointsSet(ElementType type, const PetscReal X[], Points *p)
{
  const PetscInt dim = ElementDim(type), n = ElementNumNodes(type) * dim;

  ElementRuleSet(type, ElementStiffnessDegree(type), &p->rule);
  for (PetscInt q = 0; q < p->rule.num; q++)
    p->w[q] = p->rule.weight[q] * ElementRuleMap(&p->rule, q, X, &p->x[q * dim], &p->grad[q * n]);
}

/* theta is the nearest function of Q: int (theta - div u) q = 0 for all of Q, for any u, in needles, too. */
static void TestNearest(ElementType type, DilatationKind kind, Points *p)
{
  const PetscInt dim = ElementDim(type), n = ElementNumNodes(type) * dim;

  for (PetscInt trial = 0; trial < NUM_TRIALS; trial++) {
    PetscReal  X[MAX_DOFS], u[MAX_DOFS], rest[DILATATION_MAX_FUNCTIONS] = {0.}, size = 0., q[DILATATION_MAX_FUNCTIONS];
    Dilatation pi;

    ShakenCell(type, trial % 2 ? 1e-3 : 1., X);
    PointsSet(type, X, p);
    DilatationSet(kind, &p->rule, p->x, p->w, p->grad, &pi);
    CHECK(pi.num == (kind == DILATATION_MEAN ? 1 : dim + 1));
    for (PetscInt i = 0; i < n; i++) u[i] = Uniform(-1., 1.);
    for (PetscInt point = 0; point < p->rule.num; point++) {
      PetscReal div = 0.;

      for (PetscInt i = 0; i < n; i++) div += p->grad[point * n + i] * u[i];
      DilatationShape(&pi, &p->x[point * dim], q);
      for (PetscInt a = 0; a < pi.num; a++) {
        rest[a] += p->w[point] * q[a] * (DilatationEvaluate(&pi, &p->x[point * dim], u) - div);
        size = PetscMax(size, PetscAbsReal(p->w[point] * q[a] * div));
      }
    }
    for (PetscInt a = 0; a < pi.num; a++) CHECK_NEAR(rest[a], 0., EXACT * size);
  }
}

/* u = c x + (d.x) x has div u = tr c + (dim + 1) d.x. Cells of order 2 with straight edges have all quadratic
   displacements: a linear theta is div u itself, anywhere in the cell. So is the mean where d = 0. */
static void TestExact(ElementType type, DilatationKind kind, Points *p)
{
  const PetscInt dim = ElementDim(type);

  for (PetscInt trial = 0; trial < NUM_TRIALS; trial++) {
    PetscReal  X[MAX_DOFS], u[MAX_DOFS], c[3][3], d[3], trace = 0.;
    Dilatation pi;

    ShakenCell(type, 1., X);
    PointsSet(type, X, p);
    DilatationSet(kind, &p->rule, p->x, p->w, p->grad, &pi);
    for (PetscInt k = 0; k < dim; k++) {
      d[k] = kind == DILATATION_LINEAR ? Uniform(-1., 1.) : 0.;
      for (PetscInt l = 0; l < dim; l++) c[k][l] = Uniform(-1., 1.);
      trace += c[k][k];
    }
    for (PetscInt i = 0; i < ElementNumNodes(type); i++) {
      const PetscReal *x = &X[i * dim];

      for (PetscInt k = 0; k < dim; k++) {
        u[i * dim + k] = 0.;
        for (PetscInt l = 0; l < dim; l++) u[i * dim + k] += (c[k][l] + d[l] * x[k]) * x[l];
      }
    }
    for (PetscInt point = 0; point < p->rule.num; point++) {
      PetscReal x[3], expected = trace;

      for (PetscInt k = 0; k < dim; k++) {
        x[k] = p->x[point * dim + k] + Uniform(-0.1, 0.1);
        expected += (dim + 1) * d[k] * x[k];
      }
      CHECK_NEAR(DilatationEvaluate(&pi, x, u), expected, 10. * EXACT);
    }
  }
}

/* C = 2 mu dev + bulk 1 1', in all models; dev has three dimensions. */
static void TestBulk(void)
{
  static const ModelKind models[] = {MODEL_PLANE_STRAIN, MODEL_AXISYMMETRIC, MODEL_SOLID};
  const PetscReal        young = 3., poisson = 0.4999, mu = young / (2. * (1. + poisson));

  for (size_t m = 0; m < PETSC_STATIC_ARRAY_LENGTH(models); m++) {
    const PetscInt n = MaterialNumStrains(models[m]);
    PetscReal      C[36], whole[36], e[6];
    PetscReal      bulk, div, energy = 0., square = 0., shear = 0.;

    MaterialIsotropic(models[m], young, poisson, whole);
    MaterialIsotropic(models[m], young, poisson, C);
    bulk = MaterialTakeBulk(n, C);
    CHECK_NEAR(bulk / (young / (3. * (1. - 2. * poisson))), 1., 1e-11);
    for (PetscInt i = 0; i < n; i++) e[i] = Uniform(-1., 1.);
    div = MaterialDilatation(n, e);
    CHECK_NEAR(div, e[0] + e[1] + (n == 3 ? 0. : e[2]), 1e-15);
    for (PetscInt i = 0; i < n; i++) {
      for (PetscInt j = 0; j < n; j++) {
        energy += e[i] * C[i * n + j] * e[j];
        square += e[i] * whole[i * n + j] * e[j];
      }
      shear += i < (n == 3 ? 2 : 3) ? 2. * mu * e[i] * e[i] : mu * e[i] * e[i];
    }
    CHECK_NEAR(energy, shear - 2. / 3. * mu * div * div, EXACT);
    CHECK_NEAR((energy + bulk * div * div) / square, 1., EXACT);
  }
}

int main(int argc, char **argv)
{
  Points *points;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(PetscNew(&points));
  TestChoice();
  TestBulk();
  for (PetscInt t = 0; t < ELEMENT_COUNT; t++) {
    const ElementType    type = (ElementType)t;
    const DilatationKind kind = ElementDim(type) > 1 ? DilatationChoose(type, 0.4999) : DILATATION_LOCKS;

    if (kind == DILATATION_LOCKS) continue;
    TestNearest(type, kind, points);
    TestExact(type, kind, points);
  }
  PetscCall(PetscFree(points));
  PetscCall(PetscFinalize());
  return 0;
}

/* test_arc.c -- curves over straight edges: circles, spheres and cylinders exactly, other curves to fourth order, what is flat not
   at all. */
#include "kernel/arc.h"
#include "kernel/frame.h"
#include "kernel/quadric.h"
#include <test.h>

#include "uniform.h"

static const PetscReal EXACT = 1e-14, TURN = 0.5; // beyond 30 degrees edges are those of polygons

/* Middles of chords of a circle, convex or hollow, come to lie on it. */
static void TestCircle(void)
{
  for (PetscInt trial = 0; trial < 1000; trial++) {
    const PetscReal radius = Uniform(0.1, 2), sign = trial % 2 ? 1 : -1, middle = Uniform(-3, 3),
                    angle[2] = {middle, middle + Uniform(-TURN, TURN)};
    PetscReal X[4], N[4], offset[2], x[2], r;

    for (PetscInt i = 0; i < 2; i++) {
      N[2 * i]     = sign * PetscCosReal(angle[i]);
      N[2 * i + 1] = sign * PetscSinReal(angle[i]);
      for (PetscInt k = 0; k < 2; k++) X[2 * i + k] = sign * radius * N[2 * i + k];
    }
    ArcOffset(2, X, N, &X[2], &N[2], PETSC_FALSE, offset);
    for (PetscInt k = 0; k < 2; k++) x[k] = 0.5 * (X[k] + X[2 + k]) + offset[k];
    r = PetscSqrtReal(x[0] * x[0] + x[1] * x[1]);
    CHECK_NEAR(r, radius, EXACT * radius);
  }
}

/* On a sphere, and on a cylinder between points anywhere on it, in space. */
static void TestSphereAndCylinder(void)
{
  for (PetscInt trial = 0; trial < 1000; trial++) {
    const PetscBool sphere = trial % 2 ? PETSC_TRUE : PETSC_FALSE;
    PetscReal       X[6], N[6], offset[3], square = 0;

    for (PetscInt i = 0; i < 2; i++) {
      for (PetscInt k = 0; k < 3; k++) N[3 * i + k] = i == 0 ? Uniform(-1, 1) : N[k] + Uniform(-0.5, 0.5);
      if (!sphere) N[3 * i + 2] = 0;
      FrameNormalize(3, &N[3 * i]);
      for (PetscInt k = 0; k < 3; k++) X[3 * i + k] = 2 * N[3 * i + k];
      if (!sphere) X[3 * i + 2] = Uniform(-1, 1);
    }
    if (N[0] * N[3] + N[1] * N[4] + N[2] * N[5] < PetscCosReal(TURN)) continue;
    ArcOffset(3, X, N, &X[3], &N[3], PETSC_FALSE, offset);
    for (PetscInt k = 0; k < (sphere ? 3 : 2); k++) square += PetscSqr(0.5 * (X[k] + X[3 + k]) + offset[k]);
    CHECK_NEAR(PetscSqrtReal(square), 2, EXACT * 2);
    if (!sphere) CHECK_NEAR(offset[2], 0, EXACT);
  }
}

/* On an ellipse the middle is off by the fourth power of the edge. */
static void TestEllipse(void)
{
  PetscReal before = 0;

  for (PetscInt level = 0; level < 4; level++) {
    const PetscReal h = 0.2 / (PetscReal)(1 << level);
    PetscReal       X[4], N[4], offset[2], x[2], off;

    for (PetscInt i = 0; i < 2; i++) {
      const PetscReal t = 0.7 + (PetscReal)i * h;

      X[2 * i]     = 2 * PetscCosReal(t);
      X[2 * i + 1] = PetscSinReal(t);
      N[2 * i]     = 0.5 * PetscCosReal(t);
      N[2 * i + 1] = PetscSinReal(t);
      FrameNormalize(2, &N[2 * i]);
    }
    ArcOffset(2, X, N, &X[2], &N[2], PETSC_FALSE, offset);
    for (PetscInt k = 0; k < 2; k++) x[k] = 0.5 * (X[k] + X[2 + k]) + offset[k];
    off = PetscAbsReal(PetscSqrtReal(PetscSqr(x[0] / 2) + PetscSqr(x[1])) - 1);
    CHECK(level == 0 || off < before / 14.5);
    CHECK(off > 0);
    before = off;
  }
}

/* Nothing at all, where one end is straight, where both are to rounding, and where the curve bends both ways. */
static void TestFlat(void)
{
  const PetscReal x0[2] = {0.1, 0.2}, x1[2] = {1.1, 0.2}, up[2] = {0, 1}, nearly[2] = {3e-16, 1};
  PetscReal       tilted[2] = {0.3, 1}, offset[2];

  FrameNormalize(2, tilted);
  ArcOffset(2, x0, up, x1, up, PETSC_FALSE, offset);
  CHECK(offset[0] == 0 && offset[1] == 0);
  ArcOffset(2, x0, up, x1, nearly, PETSC_FALSE, offset);
  CHECK(offset[0] == 0 && offset[1] == 0);
  ArcOffset(2, x0, up, x1, tilted, PETSC_FALSE, offset);
  CHECK(offset[0] == 0 && offset[1] == 0);
  ArcOffset(2, x0, tilted, x1, tilted, PETSC_FALSE, offset);
  CHECK(offset[0] == 0 && offset[1] == 0);
}

/* Points of facets on the unit sphere rise to it to third order in the middle of a quad, fourth in those of edges. */
static void TestBulge(void)
{
  const ElementType types[2] = {ELEMENT_TRI3, ELEMENT_QUAD4};

  for (PetscInt t = 0; t < 2; t++) {
    PetscReal before = 0;

    for (PetscInt level = 0; level < 3; level++) {
      const PetscReal h = 0.4 / (PetscReal)(1 << level), inside[2] = {1. / 3, 1. / 3};
      const PetscInt  num = ElementNumNodes(types[t]);
      PetscReal       X[12], bulge[27], x[3], phi[ELEMENT_MAX_NODES], n[3], off;

      for (PetscInt i = 0; i < num; i++) {
        const PetscReal *node = ElementNode(types[t], i);
        const PetscReal  a = 0.3 + h * node[0], b = 0.4 + 0.8 * h * node[1];

        X[3 * i]     = PetscCosReal(a) * PetscCosReal(b);
        X[3 * i + 1] = PetscSinReal(a) * PetscCosReal(b);
        X[3 * i + 2] = PetscSinReal(b);
      }
      CHECK(ArcBulge(types[t], X, X, NULL, bulge));
      for (PetscInt i = 0; i < 3 * num; i++) CHECK(bulge[i] == 0);
      (void)ElementSurface(types[t], X, inside, x, phi, n);
      off = PetscSqrtReal(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
      for (PetscInt k = 0; k < 3; k++) n[k] = x[k] / off;
      off = PetscAbsReal(off + ArcHeight(types[t], bulge, inside, n) - 1);
      CHECK(level == 0 || off < before / 12);
      CHECK(off < h * h * h * h);
      before = off;
    }
  }
}

/* Arcs are not on a cone; its quadric takes them there, with its normal. Those of a sphere stay as they are. */
static void TestQuadric(void)
{
  const PetscReal t = 0.3, root = PetscSqrtReal(1 + t * t); // of the cone r = 1 + t z
  const Quadric   cone   = {{1, 0, 0}, {0, 1, 0, -t, 0.5, 0, 0, 0.5, 0, -t * t / 2}};
  const Quadric   sphere = {{1, 0, 0}, {0, 1, 0, 0, 0.5, 0, 0, 0.5, 0, 0.5}};
  PetscInt        moved  = 0;

  for (PetscInt trial = 0; trial < 1000; trial++) {
    const PetscReal angle = Uniform(-3, 3), turn = Uniform(0.1, 0.5);
    PetscReal       X[6], N[6], offset[3], normal[3], x[3], r;

    for (PetscInt i = 0; i < 2; i++) {
      const PetscReal a = angle + (PetscReal)i * turn, z = Uniform(-0.3, 0.3);

      for (PetscInt k = 0; k < 2; k++) {
        N[3 * i + k] = (k ? PetscSinReal(a) : PetscCosReal(a)) / root;
        X[3 * i + k] = (1 + t * z) * N[3 * i + k] * root;
      }
      N[3 * i + 2] = -t / root;
      X[3 * i + 2] = z;
    }
    ArcOffset(3, X, N, &X[3], &N[3], PETSC_FALSE, offset);
    if (QuadricTakeArc(&cone, X, &X[3], offset, normal)) {
      for (PetscInt k = 0; k < 3; k++) x[k] = (X[k] + X[3 + k]) / 2 + offset[k];
      r = PetscSqrtReal(x[0] * x[0] + x[1] * x[1]);
      CHECK_NEAR(r, 1 + t * x[2], 1e-12);
      CHECK_NEAR((normal[0] * x[0] + normal[1] * x[1]) / r, 1 / root, 1e-12);
      moved++;
    }
    for (PetscInt i = 0; i < 2; i++) (void)FrameNormalize(3, &X[3 * i]);
    ArcOffset(3, X, X, &X[3], &X[3], PETSC_FALSE, offset);
    CHECK(!QuadricTakeArc(&sphere, X, &X[3], offset, NULL));
  }
  CHECK(moved > 500);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  TestCircle();
  TestSphereAndCylinder();
  TestEllipse();
  TestFlat();
  TestBulge();
  TestQuadric();
  PetscCall(PetscFinalize());
  return 0;
}

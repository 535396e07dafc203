/* test_frame.c -- normals on circles and spheres, frames of random directions. */
#include "kernel/element.h"
#include "kernel/frame.h"
#include <test.h>

#include "uniform.h"

static const PetscReal EXACT = 1e-13;

/* Max's weights in 2D: nodes on a circle get its radial direction, whatever the spacing. */
static void TestCircle(void)
{
  for (PetscInt trial = 0; trial < 1000; trial++) {
    const PetscReal centre[2] = {Uniform(-1., 1.), Uniform(-1., 1.)}, radius = Uniform(0.1, 2.),
                    middle   = Uniform(-3., 3.);
    const PetscReal angle[3] = {middle - Uniform(0.01, 1.), middle, middle + Uniform(0.01, 1.)};
    PetscReal       X[3][2], N[3][2] = {{0.}};

    for (PetscInt i = 0; i < 3; i++) {
      X[i][0] = centre[0] + radius * PetscCosReal(angle[i]);
      X[i][1] = centre[1] + radius * PetscSinReal(angle[i]);
    }
    FrameAddFacetNormal(2, 2, X[0], N[0]);
    FrameAddFacetNormal(2, 2, X[1], N[1]);
    CHECK(FrameNormalize(2, N[1]) > 0.);
    CHECK_NEAR(N[1][0], PetscCosReal(middle), EXACT);
    CHECK_NEAR(N[1][1], PetscSinReal(middle), EXACT);
  }
}

/* Quadratic facets of unequal length with their nodes on the unit circle: exact at all nodes but the two ends. */
static void TestCircleQuadratic(void)
{
  const PetscReal lengths[2] = {0.4, 0.25};
  PetscReal       angle[5] = {0.3}, N[5][2] = {{0.}};

  for (PetscInt f = 0; f < 2; f++) {
    const PetscInt nodes[3] = {2 * f, 2 * f + 2, 2 * f + 1};
    PetscReal      X[6], own[6] = {0.};

    angle[2 * f + 1] = angle[2 * f] + 0.6 * lengths[f];
    angle[2 * f + 2] = angle[2 * f] + lengths[f];
    for (PetscInt i = 0; i < 3; i++) {
      X[2 * i]     = PetscCosReal(angle[nodes[i]]);
      X[2 * i + 1] = PetscSinReal(angle[nodes[i]]);
    }
    FrameAddFacetNormal(2, 3, X, own);
    for (PetscInt i = 0; i < 6; i++) N[nodes[i / 2]][i % 2] += own[i];
  }
  for (PetscInt i = 1; i < 4; i++) {
    FrameNormalize(2, N[i]);
    CHECK_NEAR(N[i][0], PetscCosReal(angle[i]), EXACT);
    CHECK_NEAR(N[i][1], PetscSinReal(angle[i]), EXACT);
  }
}

/* The body is on the left of its facets, so the outward normal of a facet from (0,0) to (h,0) is (0,-1). */
static void TestSegment(void)
{
  const PetscReal X[] = {0., 0., 0.25, 0.};
  PetscReal       N[] = {0., 0., 0., 0.};

  FrameAddFacetNormal(2, 2, X, N);
  for (PetscInt i = 0; i < 2; i++) {
    CHECK_NEAR(N[2 * i], 0., 0.);
    CHECK_NEAR(N[2 * i + 1], -4., EXACT); /* nu / h */
  }
}

/* A point of the unit sphere at polar distance theta from the direction of row 0 of Q. */
static void SpherePoint(const PetscReal Q[], PetscReal theta, PetscReal azimuth, PetscReal x[])
{
  for (PetscInt k = 0; k < 3; k++) {
    x[k] = PetscCosReal(theta) * Q[k] +
           PetscSinReal(theta) * (PetscCosReal(azimuth) * Q[3 + k] + PetscSinReal(azimuth) * Q[6 + k]);
  }
}

/* Random direction by rejection from the cube. */
static void RandomDirection(PetscReal n[])
{
  PetscReal length;

  do {
    for (PetscInt k = 0; k < 3; k++) n[k] = Uniform(-1., 1.);
    length = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
  } while (length > 1. || length < 0.01);
  FrameNormalize(3, n);
}

/* A closed ring of triangles or quads around n has the normal n if all its corners lie on a sphere, whatever its
   shape. */
static void TestSphere(PetscInt num_nodes)
{
  for (PetscInt trial = 0; trial < 1000; trial++) {
    const PetscInt num_facets = 3 + trial % 5;
    PetscReal      n[3], Q[9], ring[8][3], across[8][3], sum[3] = {0.};

    RandomDirection(n);
    FrameFromNormal(3, n, Q);
    for (PetscInt f = 0; f < num_facets; f++) {
      const PetscReal azimuth = 2. * PETSC_PI * (f + Uniform(-0.3, 0.3)) / num_facets;

      SpherePoint(Q, Uniform(0.05, 0.6), azimuth, ring[f]);
      SpherePoint(Q, Uniform(0.7, 0.9), azimuth + 0.3, across[f]);
    }
    for (PetscInt f = 0; f < num_facets; f++) {
      const PetscReal *corner[4] = {n, ring[f], across[f], ring[(f + 1) % num_facets]};
      PetscReal        X[12], N[12] = {0.};

      if (num_nodes == 3) corner[2] = corner[3];
      for (PetscInt i = 0; i < num_nodes; i++) {
        for (PetscInt k = 0; k < 3; k++) X[3 * i + k] = corner[i][k];
      }
      FrameAddFacetNormal(3, num_nodes, X, N);
      for (PetscInt k = 0; k < 3; k++) sum[k] += N[k];
    }
    FrameNormalize(3, sum);
    for (PetscInt k = 0; k < 3; k++) CHECK_NEAR(sum[k], n[k], EXACT);
  }
}

/* A distorted quad9 with its nodes on the unit sphere. The node in its middle has a ring of parts around it,
   and an exact normal. */
static void TestSphereQuadratic(void)
{
  const PetscReal P[8] = {-0.5, -0.4, 0.6, -0.5, 0.4, 0.5, -0.3, 0.5};
  PetscReal       X[27], N[27] = {0.};

  for (PetscInt i = 0; i < 9; i++) {
    PetscReal p[2], phi[ELEMENT_MAX_NODES], *x = &X[3 * i];

    ElementMap(ELEMENT_QUAD4, P, ElementNode(ELEMENT_QUAD9, i), p, phi, NULL);
    x[0] = p[0];
    x[1] = p[1];
    x[2] = PetscSqrtReal(1. - x[0] * x[0] - x[1] * x[1]);
  }
  FrameAddFacetNormal(3, 9, X, N);
  FrameNormalize(3, &N[24]);
  for (PetscInt k = 0; k < 3; k++) CHECK_NEAR(N[24 + k], X[24 + k], EXACT);
}

/* Rows orthonormal and right-handed, the first one being n. */
static void CheckFrame(PetscInt dim, const PetscReal n[])
{
  PetscReal Q[9], det;

  FrameFromNormal(dim, n, Q);
  for (PetscInt k = 0; k < dim; k++) CHECK_NEAR(Q[k], n[k], 0.);
  for (PetscInt i = 0; i < dim; i++) {
    for (PetscInt j = 0; j < dim; j++) {
      PetscReal dot = 0.;

      for (PetscInt k = 0; k < dim; k++) dot += Q[i * dim + k] * Q[j * dim + k];
      CHECK_NEAR(dot, i == j ? 1. : 0., 4. * PETSC_MACHINE_EPSILON);
    }
  }
  if (dim == 2) {
    det = Q[0] * Q[3] - Q[1] * Q[2];
  } else {
    det = Q[0] * (Q[4] * Q[8] - Q[5] * Q[7]) - Q[1] * (Q[3] * Q[8] - Q[5] * Q[6]) + Q[2] * (Q[3] * Q[7] - Q[4] * Q[6]);
  }
  CHECK_NEAR(det, 1., 8. * PETSC_MACHINE_EPSILON);
}

/* Directions of all kinds, with those at which frames are known to break. */
static void TestFrames(void)
{
  const PetscReal down[] = {0., 0., -1.}, up[] = {0., 0., 1.}, minus_zero[] = {1., 0., -0.},
                  nearly_down[] = {1e-9, 0., -1.};

  CheckFrame(3, down);
  CheckFrame(3, up);
  CheckFrame(3, minus_zero);
  CheckFrame(3, nearly_down);
  for (PetscInt trial = 0; trial < 10000; trial++) {
    const PetscReal angle = Uniform(-4., 4.), plane[2] = {PetscCosReal(angle), PetscSinReal(angle)};
    PetscReal       n[3];

    RandomDirection(n);
    CheckFrame(3, n);
    CheckFrame(2, plane);
  }
}

static void TestNormalize(void)
{
  PetscReal n[] = {3., 4.}, zero[] = {0., 0., 0.};

  CHECK_NEAR(FrameNormalize(2, n), 5., 0.);
  CHECK_NEAR(n[0], 0.6, PETSC_MACHINE_EPSILON);
  CHECK_NEAR(n[1], 0.8, PETSC_MACHINE_EPSILON);
  CHECK_NEAR(FrameNormalize(3, zero), 0., 0.);
  for (PetscInt k = 0; k < 3; k++) CHECK_NEAR(zero[k], 0., 0.);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  TestSegment();
  TestCircle();
  TestCircleQuadratic();
  TestSphere(3);
  TestSphere(4);
  TestSphereQuadratic();
  TestFrames();
  TestNormalize();
  PetscCall(PetscFinalize());
  return 0;
}

/* test_rise.c -- rises of facets: circles to sixth order, tori to fourth order; polygons have none. */
#include "kernel/arc.h"
#include "kernel/rise.h"
#include <test.h>

enum { F = ELEMENT_MAX_FACET_NODES, SAMPLES = 9, RING = 3 };

/* A point of a torus with a tube of radius 1, its normal and its shape operator. */
static void Torus(PetscReal tube, PetscReal turn, PetscReal x[3], PetscReal n[3], PetscReal S[9])
{
  const PetscReal c = PetscCosReal(tube), s = PetscSinReal(tube), C = PetscCosReal(turn), D = PetscSinReal(turn);
  const PetscReal along[3] = {-s * C, -s * D, c}, around[3] = {-D, C, 0};

  n[0] = c * C;
  n[1] = c * D;
  n[2] = s;
  x[0] = (RING + c) * C;
  x[1] = (RING + c) * D;
  x[2] = s;
  for (PetscInt k = 0; k < 9; k++) S[k] = along[k / 3] * along[k % 3] + c / (RING + c) * around[k / 3] * around[k % 3];
}

/* Distance of a place from the circle or torus. */
static PetscReal Distance(PetscInt dim, const PetscReal x[])
{
  if (dim == 2) return PetscAbsReal(PetscSqrtReal(x[0] * x[0] + x[1] * x[1]) - 1);
  return PetscAbsReal(PetscSqrtReal(PetscSqr(PetscSqrtReal(x[0] * x[0] + x[1] * x[1]) - RING) + x[2] * x[2]) - 1);
}

/* Nodes of a facet of size h, with the middle nodes of second order on the surface, moved along it. */
static void Place(ElementType type, PetscReal h, PetscReal X[], PetscReal N[], PetscReal S[])
{
  for (PetscInt i = 0; i < ElementNumNodes(type); i++) {
    const PetscReal *xi   = ElementNode(type, i);
    const PetscReal  tube = 2.5 + h * (xi[0] + (ElementDim(type) == 2 ? 0.3 * xi[1] : 0));

    if (ElementDim(type) == 1) {
      X[2 * i] = N[2 * i] = PetscCosReal(tube);
      X[2 * i + 1] = N[2 * i + 1] = PetscSinReal(tube);
    } else {
      Torus(tube, 0.4 + h * (0.4 * xi[1] - 0.1 * xi[0]), &X[3 * i], &N[3 * i], &S[9 * i]);
    }
  }
}

/* The largest distance of the risen facet, in points of a lattice. [in] complete - with D, or by parabolas */
static PetscReal Error(ElementType type, PetscReal h, PetscBool complete)
{
  const PetscInt dim       = ElementDim(type) + 1;
  PetscBool      smooth[F] = {dim == 3, dim == 3, dim == 3, dim == 3};
  PetscReal      X[3 * F], N[3 * F], S[9 * F], rise[3 * RISE_TERMS] = {0}, most = 0;
  RiseFacet      facet = {.X = X, .normal = N, .curvature = dim == 3 ? S : NULL};

  Place(type, h, X, N, S);
  if (ElementOrder(type) == 1) CHECK(ArcBulge(type, X, N, smooth, rise));
  if (complete) RiseComplete(type, &facet, rise);
  for (PetscInt p = 0; p < SAMPLES * SAMPLES; p++) {
    const PetscReal xi[2] = {(PetscReal)(p % SAMPLES) / (SAMPLES - 1), (PetscReal)(p / SAMPLES) / (SAMPLES - 1)};
    PetscReal       x[3], at[3], phi[ELEMENT_MAX_NODES];

    if (ElementLinear(type) == ELEMENT_TRI3 && xi[0] + xi[1] > 1) continue;
    (void)ElementSurface(type, X, xi, x, phi, NULL);
    RiseAt(type, rise, xi, at);
    for (PetscInt k = 0; k < dim; k++) x[k] += at[k];
    most = PetscMax(most, Distance(dim, x));
  }
  return most;
}

/* Errors fall by the power of the size, and are below those of parabolas. */
static void TestOrder(ElementType type, PetscReal order, PetscReal share)
{
  const PetscReal coarse = Error(type, 0.4, PETSC_TRUE), fine = Error(type, 0.2, PETSC_TRUE);

  CHECK(coarse / fine > PetscPowReal(2, order));
  CHECK(fine < share * Error(type, 0.2, PETSC_FALSE));
}

/* Straight facets of second order are those of a polygon, whatever their normals. */
static void TestPolygon(void)
{
  PetscReal       X[6] = {0, 0, 1, 0, 0.5, 0}, N[6] = {-0.2, 1, 0.2, 1, 0, 1}, rise[2 * RISE_TERMS] = {0};
  const RiseFacet facet = {.X = X, .normal = N};

  RiseComplete(ELEMENT_LINE3, &facet, rise);
  CHECK(!RiseIsAny(ELEMENT_LINE3, rise));
  X[5] = 0.05;
  RiseComplete(ELEMENT_LINE3, &facet, rise);
  CHECK(RiseIsAny(ELEMENT_LINE3, rise) == PETSC_FALSE); // the parabola has these normals
  X[5] = 0.06;
  RiseComplete(ELEMENT_LINE3, &facet, rise);
  CHECK(RiseIsAny(ELEMENT_LINE3, rise));
}

/* Distance of the middle of a triangle from a sphere. */
static PetscReal OffSphere(PetscBool complete)
{
  const Quadric   sphere   = {.origin = {1, 0, 0}, .c = {0, 2, 0, 0, 1, 0, 0, 1, 0, 1}};
  const PetscReal third[2] = {1. / 3, 1. / 3};
  PetscReal       X[9], rise[3 * RISE_TERMS] = {0}, x[3], at[3], phi[ELEMENT_MAX_NODES];
  const RiseFacet facet = {.X = X, .normal = X, .quadric = &sphere};

  for (PetscInt i = 0; i < 3; i++) {
    const PetscReal a = 0.2 * (PetscReal)(i == 1), b = 0.3 * (PetscReal)(i == 2);

    X[3 * i]     = PetscCosReal(a) * PetscCosReal(b);
    X[3 * i + 1] = PetscSinReal(a) * PetscCosReal(b);
    X[3 * i + 2] = PetscSinReal(b);
  }
  CHECK(ArcBulge(ELEMENT_TRI3, X, X, NULL, rise));
  if (complete) RiseComplete(ELEMENT_TRI3, &facet, rise);
  (void)ElementSurface(ELEMENT_TRI3, X, third, x, phi, NULL);
  RiseAt(ELEMENT_TRI3, rise, third, at);
  for (PetscInt k = 0; k < 3; k++) x[k] += at[k];
  return PetscAbsReal(PetscSqrtReal(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) - 1);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  TestOrder(ELEMENT_LINE2, 5.5, 0.05);
  TestOrder(ELEMENT_LINE3, 5.5, 0.05);
  TestOrder(ELEMENT_TRI3, 3.5, 0.1);
  TestOrder(ELEMENT_TRI6, 5.5, 0.01);
  TestOrder(ELEMENT_QUAD4, 3.5, 0.6);
  TestOrder(ELEMENT_QUAD9, 3.5, 0.6);
  TestPolygon();
  CHECK(OffSphere(PETSC_TRUE) < OffSphere(PETSC_FALSE) / 100);
  PetscCall(PetscFinalize());
  return 0;
}

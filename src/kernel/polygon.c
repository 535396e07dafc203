/* polygon.c -- the common part of two convex polygons.

   A point counts as inside of an edge up to a small distance on its other side. Thus roundoff cannot cut off
   a common vertex or edge of two polygons. Neighbours of a tiling measure the distance from the same line,
   their common edge: each part belongs to one of them.

   Reference:
     [1] I. E. Sutherland, G. W. Hodgman, Reentrant polygon clipping, Comm. ACM 17 (1974). */
#include "kernel/polygon.h"

PetscReal PolygonArea(PetscInt n, const PetscReal P[])
{
  PetscReal area = 0.;

  for (PetscInt i = 1; i + 1 < n; i++) { /* from the first vertex, so that a polygon far away loses no digits */
    const PetscReal a[2] = {P[2 * i] - P[0], P[2 * i + 1] - P[1]};
    const PetscReal b[2] = {P[2 * i + 2] - P[0], P[2 * i + 3] - P[1]};

    area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
  }
  return area;
}

/* Distance of p from the line through a and b, positive on its left. */
static PetscReal PolygonLineDistance_Private(const PetscReal a[], const PetscReal b[], const PetscReal p[])
{
  const PetscReal e[2] = {b[0] - a[0], b[1] - a[1]}, length = PetscSqrtReal(e[0] * e[0] + e[1] * e[1]);

  return length > 0. ? (e[0] * (p[1] - a[1]) - e[1] * (p[0] - a[0])) / length : 0.;
}

/* The part of a polygon left of the line through a and b, which has at most one vertex more than a convex
   polygon.
   [in] P - [n][2]; [out] Q - [n + 1][2] */
static PetscInt PolygonCutByLine_Private(PetscInt n, const PetscReal P[], const PetscReal a[], const PetscReal b[],
                                         PetscReal tolerance, PetscReal Q[])
{
  PetscReal d[POLYGON_MAX_VERTICES];
  PetscInt  num = 0;

  for (PetscInt i = 0; i < n; i++) d[i] = PolygonLineDistance_Private(a, b, &P[2 * i]);
  for (PetscInt i = 0; i < n; i++) {
    const PetscInt  j        = (i + 1) % n;
    const PetscBool inside_i = d[i] >= -tolerance ? PETSC_TRUE : PETSC_FALSE;
    const PetscBool inside_j = d[j] >= -tolerance ? PETSC_TRUE : PETSC_FALSE;

    if (inside_i && num < POLYGON_MAX_VERTICES) {
      Q[2 * num]       = P[2 * i];
      Q[2 * num++ + 1] = P[2 * i + 1];
    }
    if (inside_i != inside_j && num < POLYGON_MAX_VERTICES) {
      const PetscReal t = PetscMin(PetscMax(d[i] / (d[i] - d[j]), 0.), 1.);

      Q[2 * num]       = (1. - t) * P[2 * i] + t * P[2 * j];
      Q[2 * num++ + 1] = (1. - t) * P[2 * i + 1] + t * P[2 * j + 1];
    }
  }
  return num;
}

/* Drops every vertex that is closer than the tolerance to the one before it. [in,out] P - [n][2] */
static PetscInt PolygonMergeVertices_Private(PetscInt n, PetscReal tolerance, PetscReal P[])
{
  PetscInt num = 0;

  for (PetscInt i = 0; i < n; i++) {
    const PetscReal *before = num ? &P[2 * (num - 1)] : &P[2 * (n - 1)];
    const PetscReal  d[2]   = {P[2 * i] - before[0], P[2 * i + 1] - before[1]};

    if (d[0] * d[0] + d[1] * d[1] <= tolerance * tolerance) continue;
    P[2 * num]       = P[2 * i];
    P[2 * num++ + 1] = P[2 * i + 1];
  }
  return num;
}

PetscInt PolygonIntersect(PetscInt num_a, const PetscReal A[], PetscInt num_b, const PetscReal B[], PetscReal tolerance,
                          PetscReal P[])
{
  PetscInt n = num_a;

  for (PetscInt i = 0; i < 2 * num_a; i++) P[i] = A[i];
  for (PetscInt e = 0; e < num_b && n; e++) {
    PetscReal Q[2 * POLYGON_MAX_VERTICES];

    n = PolygonCutByLine_Private(n, P, &B[2 * e], &B[2 * ((e + 1) % num_b)], tolerance, Q);
    for (PetscInt i = 0; i < 2 * n; i++) P[i] = Q[i];
  }
  n = PolygonMergeVertices_Private(n, tolerance, P);
  return n >= 3 ? n : 0;
}

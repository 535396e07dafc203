/* closest.c -- the point of a facet that is nearest to a given one, by Gauss-Newton steps.

   On a straight line or a flat triangle one step is exact. A point whose foot is beyond the facet has its
   nearest point on an edge. */
#include "kernel/closest.h"
#include "kernel/vector.h"

enum { MAX_STEPS = 30, MAX_EDGES = 4 };

/* Steps on the reference cell, and distances from its edges, below these are roundoff. */
static const PetscReal SMALL_STEP = 1e-14, ON_EDGE = 1e-12;

/* A line in the reference cell. */
typedef struct {
  PetscReal from[2], along[2];
} Segment;

/* y(eta) - x, and the derivatives of y. [out] J - [ElementDim][dim] */
static void ClosestPointOffset_Private(PetscInt dim, ElementType type, const PetscReal X[], const PetscReal x[],
                                       const PetscReal eta[], PetscReal r[], PetscReal J[])
{
  const PetscInt num = ElementDim(type);
  PetscReal      phi[ELEMENT_MAX_NODES], dphi[2 * ELEMENT_MAX_NODES];

  ElementShape(type, eta, phi, dphi);
  for (PetscInt k = 0; k < dim; k++) {
    r[k] = -x[k];
    for (PetscInt a = 0; a < num; a++) J[a * dim + k] = 0;
    for (PetscInt i = 0; i < ElementNumNodes(type); i++) {
      r[k] += phi[i] * X[i * dim + k];
      for (PetscInt a = 0; a < num; a++) J[a * dim + k] += dphi[i * num + a] * X[i * dim + k];
    }
  }
}

/* The nearest point on a segment of the reference cell. Returns its squared distance.
   [out] eta - [ElementDim] */
static PetscReal ClosestPointOnSegment_Private(PetscInt dim, ElementType type, const PetscReal X[], const PetscReal x[],
                                               const Segment *segment, PetscReal eta[])
{
  const PetscInt num = ElementDim(type);
  PetscReal      s   = 0.5, r[3], J[6], t[3];

  for (PetscInt step = 0; step <= MAX_STEPS; step++) {
    PetscReal next;

    for (PetscInt a = 0; a < num; a++) eta[a] = segment->from[a] + s * segment->along[a];
    ClosestPointOffset_Private(dim, type, X, x, eta, r, J);
    for (PetscInt k = 0; k < dim; k++) {
      t[k] = 0;
      for (PetscInt a = 0; a < num; a++) t[k] += J[a * dim + k] * segment->along[a];
    }
    next = PetscMax(0, PetscMin(1, s - VectorDot(dim, r, t) / VectorDot(dim, t, t)));
    if (PetscAbsReal(next - s) <= SMALL_STEP) break;
    s = next;
  }
  return VectorDot(dim, r, r);
}

/* The foot of the perpendicular within a facet in space, without its edges. Returns whether there is one. */
static PetscBool ClosestPointFindFoot_Private(ElementType type, const PetscReal X[], const PetscReal x[],
                                              PetscReal eta[], PetscReal *square)
{
  const PetscBool simplex = (PetscBool)(ElementNumNodes(ElementLinear(type)) == 3);
  PetscReal       r[3], J[6], step[2];

  eta[0] = eta[1] = simplex ? 1. / 3 : 0.5;
  for (PetscInt n = 0; n <= MAX_STEPS; n++) {
    PetscReal a, b, c, d, e, det;

    ClosestPointOffset_Private(3, type, X, x, eta, r, J);
    a       = VectorDot(3, J, J);
    b       = VectorDot(3, J, &J[3]);
    c       = VectorDot(3, &J[3], &J[3]);
    d       = -VectorDot(3, J, r);
    e       = -VectorDot(3, &J[3], r);
    det     = a * c - b * b;
    step[0] = (d * c - e * b) / det;
    step[1] = (e * a - d * b) / det;
    if (PetscMax(PetscAbsReal(step[0]), PetscAbsReal(step[1])) <= SMALL_STEP) break;
    eta[0] += step[0];
    eta[1] += step[1];
    if (!(PetscMax(PetscAbsReal(eta[0]), PetscAbsReal(eta[1])) < 2)) return PETSC_FALSE; // an edge is nearer
  }
  *square = VectorDot(3, r, r);
  if (eta[0] < -ON_EDGE || eta[1] < -ON_EDGE) return PETSC_FALSE;
  return (PetscBool)(simplex ? eta[0] + eta[1] <= 1 + ON_EDGE : PetscMax(eta[0], eta[1]) <= 1 + ON_EDGE);
}

PetscReal ClosestPointOnFacet(PetscInt dim, ElementType type, const PetscReal X[], const PetscReal x[], PetscReal eta[])
{
  static const Segment line            = {{0}, {1}};
  static const Segment triangle[3]     = {{{0, 0}, {1, 0}}, {{1, 0}, {-1, 1}}, {{0, 1}, {0, -1}}};
  static const Segment quad[MAX_EDGES] = {{{0, 0}, {1, 0}}, {{1, 0}, {0, 1}}, {{1, 1}, {-1, 0}}, {{0, 1}, {0, -1}}};
  const PetscInt       num_edges       = ElementNumNodes(ElementLinear(type));
  PetscReal            square, nearest = PETSC_MAX_REAL;

  if (dim == 2) return ClosestPointOnSegment_Private(dim, type, X, x, &line, eta);
  if (ClosestPointFindFoot_Private(type, X, x, eta, &square)) return square;
  for (PetscInt e = 0; e < num_edges; e++) {
    PetscReal at[2];

    square = ClosestPointOnSegment_Private(dim, type, X, x, num_edges == 3 ? &triangle[e] : &quad[e], at);
    if (square >= nearest) continue;
    nearest = square;
    eta[0]  = at[0];
    eta[1]  = at[1];
  }
  return nearest;
}

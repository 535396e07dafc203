/* arc.c -- the curve that nodal normals make of a straight edge.

   Let d = x1 - x0, and 2 gamma the angle between the normals at the ends. An arc of a circle rises above its
   chord by d.(n1 - n0) / (4 (1 + cos gamma)), along n0 + n1. On a cylinder d.(n1 - n0) omits the part of d
   along the axis, so that the same holds. Each end has half of the sum: b = d.n1 and a = -d.n0 are equal on
   circles. Elsewhere half their sum counts, less a part rho^4 with rho = (b - a) / (b + a): nothing is left
   where one of them vanishes. rho is of the order of the edge, so that the part is beyond the error of any
   curve through two points and normals. Where a surface is nearly flat along an edge, rho^2 would not be.
   Between convex and concave directions of a surface rho is large: where it is smooth, all of it counts. */
#include "kernel/arc.h"
#include "base/compat.h"
#include "kernel/vector.h"

/* Edges that turn by less between their ends are straight: roundoff of normals. */
static const PetscReal STRAIGHT_ARC = 1e-11;
/* Edges that turn by 31 degrees and more are those of polygons: |n0 + n1| is 2 cos 15.5 degrees there. Twelve
   edges of a circle have 30 degrees: a curve, whatever their rounding. */
static const PetscReal SMOOTH_ARC = 1.927260906417246;

void ArcOffset(PetscInt dim, const PetscReal x0[], const PetscReal n0[], const PetscReal x1[], const PetscReal n1[],
               PetscBool smooth, PetscReal offset[])
{
  PetscReal d[3], n[3], a = 0, b = 0, dd = 0, nn = 0, along = 0, rho, rise;

  for (PetscInt k = 0; k < dim; k++) {
    offset[k] = 0;
    d[k]      = x1[k] - x0[k];
    n[k]      = n0[k] + n1[k];
    a -= d[k] * n0[k];
    b += d[k] * n1[k];
    dd += d[k] * d[k];
    nn += n[k] * n[k];
  }
  if (nn < PetscSqr(SMOOTH_ARC)) return;
  if (PetscAbsReal(a + b) <= 2 * STRAIGHT_ARC * PetscSqrtReal(dd)) return;
  if (!smooth && (a * b <= 0 || PetscMin(PetscAbsReal(a), PetscAbsReal(b)) <= STRAIGHT_ARC * PetscSqrtReal(dd))) return;
  rho  = smooth ? 0 : (b - a) / (b + a);
  rise = (1 - PetscSqr(PetscSqr(rho))) * (a + b) / 2 / (2 + PetscSqrtReal(nn));
  for (PetscInt k = 0; k < dim; k++) along += n[k] * d[k] / dd;
  for (PetscInt k = 0; k < dim; k++) n[k] -= along * d[k];
  nn = VectorDot(dim, n, n);
  for (PetscInt k = 0; k < dim && nn > 0; k++) offset[k] = rise / PetscSqrtReal(nn) * n[k];
}

PetscBool ArcBulge(ElementType type, const PetscReal X[], const PetscReal N[], const PetscBool smooth[],
                   PetscReal bulge[])
{
  const PetscInt dim = ElementDim(type) + 1, num = ElementNumNodes(type), num_edges = ElementNumEdges(type);
  const PetscInt num_all = ElementNumNodes(ElementOfOrder(type, 2));
  PetscBool      any     = PETSC_FALSE;

  for (PetscInt i = 0; i < num_all * dim; i++) bulge[i] = 0;
  for (PetscInt e = 0; e < num_edges; e++) {
    const PetscInt  a = ElementEdgeNodes(type, e)[0], b = ElementEdgeNodes(type, e)[1];
    const PetscBool both = (PetscBool)(smooth && smooth[a] && smooth[b]);
    PetscReal      *mine = &bulge[(num + e) * dim];

    ArcOffset(dim, &X[a * dim], &N[a * dim], &X[b * dim], &N[b * dim], both, mine);
    for (PetscInt k = 0; k < dim; k++) {
      if (mine[k] != 0) any = PETSC_TRUE;
      if (num_all > num + num_edges) bulge[(num + num_edges) * dim + k] += mine[k] / 2;
    }
  }
  return any;
}

PetscReal ArcHeight(ElementType type, const PetscReal bulge[], const PetscReal xi[], const PetscReal n[])
{
  const ElementType curved = ElementOfOrder(type, 2);
  const PetscInt    dim    = ElementDim(type) + 1;
  PetscReal         phi[ELEMENT_MAX_NODES], height = 0;

  ElementShape(curved, xi, phi, NULL);
  for (PetscInt i = 0; i < ElementNumNodes(curved); i++) height += phi[i] * VectorDot(dim, &bulge[i * dim], n);
  return height;
}

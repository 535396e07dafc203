/* leverarm.c -- constraint rows across a gap: the rotation of the link of a tied point, and the line of
   action of a contact row. */
#include "base/compat.h"
#include "contact/leverarm.h"
#include "kernel/vector.h"

/* Sides closer than this share of a facet touch: the gap is roundoff of coordinates. */
static const PetscReal TOUCHING = 1e-10;
/* A facet of a smaller measure than this share of its size squared, or in a plane of its size, has no tangent
   plane. */
static const PetscReal DEGENERATE = 1e-12;
/* Unit vectors that differ by less are equal. */
static const PetscReal TURN_TOLERANCE = 1e-12;

/* Gradients of shape functions along a facet, g_i = sum_ab dphi_ia G^-1_ab t_b. Returns PETSC_FALSE for a
   facet without a tangent plane. [out] g - [num_nodes][dim] */
static PetscBool LeverArmSurfaceGradients_Private(PetscInt dim, const ClipFacet *facet, const PetscReal dphi[],
                                                  PetscReal g[])
{
  const PetscInt  n = ElementNumNodes(facet->type), m = dim - 1;
  const PetscReal size    = ElementLongestEdge(facet->type, dim, facet->X);
  PetscReal       t[2][3] = {{0}}, G[3] = {0, 0, 1}, det;

  for (PetscInt i = 0; i < n; i++)
    for (PetscInt a = 0; a < m; a++)
      for (PetscInt k = 0; k < dim; k++) t[a][k] += dphi[i * m + a] * facet->X[i * dim + k];
  for (PetscInt k = 0; k < dim; k++) G[0] += t[0][k] * t[0][k];
  if (m == 2) {
    G[2] = 0;
    for (PetscInt k = 0; k < dim; k++) {
      G[1] += t[0][k] * t[1][k];
      G[2] += t[1][k] * t[1][k];
    }
  }
  det = G[0] * G[2] - G[1] * G[1];
  if (!(PetscSqrtReal(PetscMax(det, 0)) > DEGENERATE * (m == 2 ? size * size : size))) return PETSC_FALSE;
  for (PetscInt i = 0; i < n; i++) {
    const PetscReal d0 = dphi[i * m], d1 = m == 2 ? dphi[i * m + 1] : 0;

    for (PetscInt k = 0; k < dim; k++)
      g[i * dim + k] = ((G[2] * d0 - G[1] * d1) * t[0][k] + (G[0] * d1 - G[1] * d0) * t[1][k]) / det;
  }
  return PETSC_TRUE;
}

PetscBool LeverArmAtPoint(PetscInt dim, const ClipFacet *facet, const ClipFacet *mortar, const ClipPoint *point,
                          PetscReal size, PetscReal blocks[])
{
  PetscReal phi[ELEMENT_MAX_NODES], dphi[2 * ELEMENT_MAX_NODES], g[3 * ELEMENT_MAX_FACET_NODES], x[3], y[3], n[3], v[3];
  PetscReal square = 0, across = 0;

  ElementSurface(facet->type, facet->X, point->xi, x, phi, NULL);
  ElementSurface(mortar->type, mortar->X, point->eta, y, phi, n);
  for (PetscInt k = 0; k < dim; k++) {
    v[k] = x[k] - y[k];
    square += v[k] * v[k];
    across += v[k] * n[k];
  }
  if (square <= PetscSqr(TOUCHING * size)) return PETSC_FALSE;
  ElementShape(mortar->type, point->eta, phi, dphi);
  if (!LeverArmSurfaceGradients_Private(dim, mortar, dphi, g)) return PETSC_FALSE;
  for (PetscInt i = 0; i < ElementNumNodes(mortar->type); i++) {
    const PetscReal along = VectorDot(dim, v, &g[i * dim]);

    for (PetscInt k = 0; k < dim; k++)
      for (PetscInt l = 0; l < dim; l++)
        blocks[(i * dim + k) * dim + l] = (k == l ? along : 0) - across * g[i * dim + k] * n[l];
  }
  return PETSC_TRUE;
}

PetscBool LeverArmDirectionsDiffer(PetscInt dim, const ClipFacet *facet)
{
  for (PetscInt i = dim; i < ElementNumNodes(facet->type) * dim; i++)
    if (PetscAbsReal(facet->N[i] - facet->N[i % dim]) > TURN_TOLERANCE) return PETSC_TRUE;
  return PETSC_FALSE;
}

PetscBool LeverArmAlongRows(PetscInt dim, PetscInt num_rows, const PetscReal rows[], const ClipFacet *facet,
                            const ClipFacet *mortar, const ClipPoint *point, PetscReal extra[])
{
  const PetscInt num = ElementNumNodes(mortar->type);
  PetscReal      phi[ELEMENT_MAX_NODES], dphi[2 * ELEMENT_MAX_NODES], g[3 * ELEMENT_MAX_FACET_NODES], x[3], y[3], n[3];
  PetscReal      across = 0, facing = 0;

  ElementSurface(facet->type, facet->X, point->xi, x, phi, NULL);
  ElementSurface(mortar->type, mortar->X, point->eta, y, phi, n);
  ElementShape(mortar->type, point->eta, phi, dphi);
  if (!LeverArmSurfaceGradients_Private(dim, mortar, dphi, g)) return PETSC_FALSE;
  for (PetscInt k = 0; k < dim; k++) {
    across += (y[k] - x[k]) * n[k];
    facing += n[k] * facet->N[k];
  }
  if (facing > 0) { // the order of a facet's nodes may turn its normal inwards
    across = -across;
    for (PetscInt k = 0; k < dim; k++) n[k] = -n[k];
  }
  for (PetscInt i = 0; i < num_rows; i++) {
    const PetscReal *na     = &rows[i * dim];
    const PetscReal  cosine = VectorDot(dim, na, n);

    for (PetscInt j = 0; j < num; j++) {
      extra[i * num + j] = 0;
      for (PetscInt k = 0; k < dim && cosine < FACING; k++)
        extra[i * num + j] += g[j * dim + k] * (x[k] + across / cosine * na[k] - y[k]);
    }
  }
  return PETSC_TRUE;
}

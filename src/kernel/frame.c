/* frame.c -- nodal normals from the facets around a node, and a frame for each normal.

   Normals are an input of the method, not a detail: an error in them is an error in the gap of a curved surface. The
   weights used here are exact where a surface is a circle or a sphere; means weighted by angle or area are not.

   References:
     [1] N. Max, Weights for computing vertex normals from facet normals, J. Graphics Tools 4 (1999).
     [2] T. Duff et al., Building an orthonormal basis, revisited, J. Computer Graphics Techniques 6 (2017). */
#include <mortise/element.h>
#include <mortise/frame.h>

enum { MAX_CORNERS = 4 }; /* of facets of first order in space */

static PetscReal Dot_Private(PetscInt dim, const PetscReal a[], const PetscReal b[])
{
  PetscReal sum = 0.;

  for (PetscInt k = 0; k < dim; k++) sum += a[k] * b[k];
  return sum;
}

/* Each node gets nu / h, with nu the normal of the curve at the node and h the chord (T13): a chord of a circle is tilted
   from the tangent at its end in proportion to its length, so that these weights cancel the tilts of two chords for any
   spacing. A parabola through three points of a circle is tilted by no more than h^3 at its ends. */
static void AddLine_Private(PetscInt num_nodes, const PetscReal X[], PetscReal N[])
{
  const ElementType type  = num_nodes == 2 ? ELEMENT_LINE2 : ELEMENT_LINE3;
  const PetscReal   chord = PetscSqrtReal(PetscSqr(X[2] - X[0]) + PetscSqr(X[3] - X[1]));

  for (PetscInt i = 0; i < num_nodes; i++) {
    PetscReal phi[ELEMENT_MAX_NODES], nu[2];

    ElementSurface(type, X, ElementNode(type, i), NULL, phi, nu);
    for (PetscInt k = 0; k < 2; k++) N[2 * i + k] += nu[k] / chord;
  }
}

/* The corner i gets e1 x e2 / (|e1|^2 |e2|^2) with e1 and e2 the facet's edges to the next and the previous corner:
   the sum is exact where all the corners lie on a sphere [1]. */
static void AddPolygon_Private(PetscInt num_nodes, const PetscReal X[], PetscReal N[])
{
  for (PetscInt i = 0; i < num_nodes; i++) {
    const PetscReal *x = &X[3 * i], *next = &X[3 * ((i + 1) % num_nodes)];
    const PetscReal *previous = &X[3 * ((i + num_nodes - 1) % num_nodes)];
    PetscReal        e1[3], e2[3], weight;

    for (PetscInt k = 0; k < 3; k++) {
      e1[k] = next[k] - x[k];
      e2[k] = previous[k] - x[k];
    }
    weight = 1. / (Dot_Private(3, e1, e1) * Dot_Private(3, e2, e2));
    for (PetscInt k = 0; k < 3; k++) {
      const PetscInt l = (k + 1) % 3, m = (k + 2) % 3;

      N[3 * i + k] += weight * (e1[l] * e2[m] - e1[m] * e2[l]);
    }
  }
}

/* Each node of tri6 or quad9 gets the normal of the curved facet there, weighted so that smaller facets, which are closer to
   the surface that they stand for, count more. */
static void AddCurved_Private(ElementType type, const PetscReal X[], PetscReal N[])
{
  for (PetscInt i = 0; i < ElementNumNodes(type); i++) {
    PetscReal       phi[ELEMENT_MAX_NODES], nu[3];
    const PetscReal measure = ElementSurface(type, X, ElementNode(type, i), NULL, phi, nu);

    for (PetscInt k = 0; k < 3; k++) N[3 * i + k] += nu[k] / measure;
  }
}

void FrameAddFacetNormal(PetscInt dim, PetscInt num_nodes, const PetscReal X[], PetscReal N[])
{
  if (dim == 2)
    AddLine_Private(num_nodes, X, N);
  else if (num_nodes <= MAX_CORNERS)
    AddPolygon_Private(num_nodes, X, N);
  else
    AddCurved_Private(num_nodes == ElementNumNodes(ELEMENT_TRI6) ? ELEMENT_TRI6 : ELEMENT_QUAD9, X, N);
}

PetscReal FrameNormalize(PetscInt dim, PetscReal n[])
{
  const PetscReal length = PetscSqrtReal(Dot_Private(dim, n, n));

  if (length > 0.) {
    for (PetscInt k = 0; k < dim; k++) n[k] /= length;
  }
  return length;
}

void FrameFromNormal(PetscInt dim, const PetscReal n[], PetscReal Q[])
{
  for (PetscInt k = 0; k < dim; k++) Q[k] = n[k];
  if (dim == 2) {
    Q[2] = -n[1];
    Q[3] = n[0];
  } else {
    /* [2]: the sign keeps the denominator s + n_z away from zero, so that no direction is special */
    const PetscReal s = n[2] >= 0. ? 1. : -1., a = -1. / (s + n[2]), b = n[0] * n[1] * a;

    Q[3] = 1. + s * n[0] * n[0] * a;
    Q[4] = s * b;
    Q[5] = -s * n[0];
    Q[6] = b;
    Q[7] = s + n[1] * n[1] * a;
    Q[8] = -n[1];
  }
}

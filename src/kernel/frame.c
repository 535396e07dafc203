/* frame.c -- nodal normals from the facets around a node, and a frame for each normal.

   An error of the normals is an error of the gap of a curved surface. The weights used here are exact where a
   surface is a circle or a sphere; means weighted by angle or area are not. Facets of second order are taken
   as the straight ones between their nodes: the slopes of parabolas would err by h^3 on a circle.

   References:
     [1] N. Max, Weights for computing vertex normals from facet normals, J. Graphics Tools 4 (1999).
     [2] T. Duff et al., Building an orthonormal basis, revisited, J. Computer Graphics Techniques 6
     (2017). */
#include "kernel/frame.h"
#include "kernel/vector.h"

/* Both ends get nu / h of their chord. The angle between a chord of a circle and the tangent at its end is
   proportional to its length. So these weights cancel the angles of two chords for any spacing (eq. 4.1). */
static void FrameAddChord_Private(PetscInt from, PetscInt to, const PetscReal X[], PetscReal N[])
{
  const PetscReal dx = X[2 * to] - X[2 * from], dy = X[2 * to + 1] - X[2 * from + 1], square = dx * dx + dy * dy;
  const PetscInt  ends[2] = {from, to};

  for (PetscInt i = 0; i < 2; i++) {
    N[2 * ends[i]] += dy / square;
    N[2 * ends[i] + 1] -= dx / square;
  }
}

/* Each corner gets e1 x e2 / (|e1|^2 |e2|^2), e1 and e2 being the edges to the next and the previous corner.
   The sum is exact where all corners lie on a sphere [1]. [in] corners - nodes, anticlockwise [num] */
static void FrameAddPolygon_Private(PetscInt num, const PetscInt corners[], const PetscReal X[], PetscReal N[])
{
  for (PetscInt i = 0; i < num; i++) {
    const PetscInt   own = corners[i];
    const PetscReal *x = &X[3 * own], *next = &X[3 * corners[(i + 1) % num]];
    const PetscReal *previous = &X[3 * corners[(i + num - 1) % num]];
    PetscReal        e1[3], e2[3], cross[3], weight;

    for (PetscInt k = 0; k < 3; k++) {
      e1[k] = next[k] - x[k];
      e2[k] = previous[k] - x[k];
    }
    weight = 1. / (VectorDot(3, e1, e1) * VectorDot(3, e2, e2));
    VectorCross(e1, e2, cross);
    for (PetscInt k = 0; k < 3; k++) N[3 * own + k] += weight * cross[k];
  }
}

void FrameGetParts(PetscInt num_nodes, PetscInt *num, PetscInt *num_corners, const PetscInt **corners)
{
  static const PetscInt whole[4]  = {0, 1, 2, 3};
  static const PetscInt tri6[12]  = {0, 3, 5, 3, 1, 4, 5, 4, 2, 3, 4, 5};
  static const PetscInt quad9[16] = {0, 4, 8, 7, 4, 1, 5, 8, 8, 5, 2, 6, 7, 8, 6, 3};

  *num         = num_nodes > 4 ? 4 : 1;
  *num_corners = num_nodes > 4 ? (num_nodes == 6 ? 3 : 4) : num_nodes;
  *corners     = num_nodes > 4 ? (num_nodes == 6 ? tri6 : quad9) : whole;
}

void FrameAddFacetNormal(PetscInt dim, PetscInt num_nodes, const PetscReal X[], PetscReal N[])
{
  const PetscInt *corners;
  PetscInt        num, num_corners;

  if (dim == 2 && num_nodes == 2) FrameAddChord_Private(0, 1, X, N);
  if (dim == 2 && num_nodes == 3) {
    FrameAddChord_Private(0, 2, X, N);
    FrameAddChord_Private(2, 1, X, N);
  }
  if (dim == 2) return;
  FrameGetParts(num_nodes, &num, &num_corners, &corners);
  for (PetscInt part = 0; part < num; part++) FrameAddPolygon_Private(num_corners, &corners[part * num_corners], X, N);
}

PetscReal FrameNormalize(PetscInt dim, PetscReal n[])
{
  const PetscReal length = VectorNorm(dim, n);

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

/* rise.c -- curves of degree 4 over the edges of a facet.

   Let t run from 0 to 1 along an edge. A parabola has the curve's middle, but not the normals at its ends.
   With D = t (1 - t) (1 - 2t) (p + q (1 - 2t)) it has both: D' is p + q at the first end, p - q at the
   second. Over a triangle with the coordinates l of its vertices, t (1 - t) becomes l_i l_j, and 1 - 2t
   becomes l_i - l_j. Over a quadrilateral D fades out towards the opposite edge (Coons 1967). With l_1 l_2
   l_3 times a linear function a triangle has all polynomials of degree 4. The function is determined by
   three points inside. On a quadric they are known. Else lines from a vertex to the middle of the opposite
   edge tell the height z over the plane of the vertices. Along them s is -1 to 1/2, and z(-1/4) = (12
   z'(-1) + 9/4 z''(-1) + 10 z(1/2) - 3 z'(1/2)) / 32 is exact for degree 4. */
#include "kernel/rise.h"
#include "base/compat.h"
#include "kernel/frame.h"
#include "kernel/vector.h"

/* The slopes of D are below this share of those of the parabola. A polygon has nothing but D. */
static const PetscReal LARGEST_SHARE = 0.5;

/* The middle of the parabola over an edge, from that of the edge. [out] way - the edge; middle - [dim] */
static void RiseGetEdge_Private(ElementType type, PetscInt e, const PetscReal X[], const PetscReal rise[],
                                PetscReal way[], PetscReal middle[])
{
  const PetscInt  dim = ElementDim(type) + 1, at = (ElementNumNodes(ElementLinear(type)) + e) * dim;
  const PetscInt *ends = ElementEdgeNodes(ElementLinear(type), e);

  for (PetscInt k = 0; k < dim; k++) {
    const PetscReal a = X[ends[0] * dim + k], b = X[ends[1] * dim + k];

    way[k]    = b - a;
    middle[k] = ElementOrder(type) > 1 ? X[at + k] - (a + b) / 2 : rise[at + k];
  }
}

/* p and q of an edge. [in] largest - of the slopes that they may add */
static void RiseSetEdge_Private(ElementType type, PetscInt e, const RiseFacet *facet, PetscReal largest,
                                PetscReal rise[])
{
  const PetscInt  dim  = ElementDim(type) + 1;
  const PetscInt *ends = ElementEdgeNodes(ElementLinear(type), e);
  PetscReal       way[3], middle[3], n[3], end[2], along;

  RiseGetEdge_Private(type, e, facet->X, rise, way, middle);
  for (PetscInt k = 0; k < dim; k++) n[k] = facet->normal[ends[0] * dim + k] + facet->normal[ends[1] * dim + k];
  along = VectorDot(dim, n, way) / VectorDot(dim, way, way);
  for (PetscInt k = 0; k < dim; k++) n[k] -= along * way[k];
  FrameNormalize(dim, n);
  for (PetscInt i = 0; i < 2; i++) {
    const PetscReal *own = &facet->normal[ends[i] * dim];
    PetscReal        slope[3];

    for (PetscInt k = 0; k < dim; k++) slope[k] = way[k] + (i ? -4 : 4) * middle[k];
    end[i] = -VectorDot(dim, slope, own) / VectorDot(dim, n, own);
    if (!(PetscAbsReal(end[i]) <= largest)) return;
  }
  for (PetscInt k = 0; k < dim; k++) {
    rise[(RISE_CUBIC + 2 * e) * dim + k]     = (end[0] + end[1]) / 2 * n[k];
    rise[(RISE_CUBIC + 2 * e + 1) * dim + k] = (end[0] - end[1]) / 2 * n[k];
  }
}

/* p and q of all edges. Where curvatures are known, the facet is smooth: an edge that hardly bends may be one
   between convex and concave directions. */
static void RiseSetEdges_Private(ElementType type, const RiseFacet *facet, PetscReal rise[])
{
  const PetscInt dim = ElementDim(type) + 1, num = ElementNumEdges(ElementLinear(type));
  PetscReal      slope[RISE_EDGES], most         = 0, way[3], middle[3];

  for (PetscInt e = 0; e < num; e++) {
    RiseGetEdge_Private(type, e, facet->X, rise, way, middle);
    slope[e] = 4 * VectorNorm(dim, middle);
    most     = PetscMax(most, slope[e]);
  }
  for (PetscInt e = 0; e < num; e++)
    RiseSetEdge_Private(type, e, facet, LARGEST_SHARE * (facet->curvature ? most : slope[e]), rise);
}

/* A normal and a shape operator at a place of the side. */
typedef struct {
  PetscReal normal[3], curvature[9]; /* the normal of any length */
} RisePlace;

/* The slope of the side along a, over a plane with the normal n. */
static PetscReal RiseSlope_Private(const RisePlace *at, const PetscReal n[3], const PetscReal a[3])
{
  return -VectorDot(3, at->normal, a) / VectorDot(3, at->normal, n);
}

/* The second derivative of the height over this plane along a and b, which are in it: the tangents t have
   -t_a.S t_b, in the direction of the normal. */
static PetscReal RiseBend_Private(const RisePlace *at, const PetscReal n[3], const PetscReal a[3], const PetscReal b[3])
{
  const PetscReal up = VectorDot(3, at->normal, n) / VectorNorm(3, at->normal);
  PetscReal       s[3], t[3], St[3];

  for (PetscInt k = 0; k < 3; k++) {
    s[k] = a[k] + RiseSlope_Private(at, n, a) * n[k];
    t[k] = b[k] + RiseSlope_Private(at, n, b) * n[k];
  }
  for (PetscInt k = 0; k < 3; k++) St[k] = VectorDot(3, &at->curvature[3 * k], t);
  return -VectorDot(3, s, St) / up;
}

/* What is known at nodes, by weights. [in] num - of the first nodes */
static RisePlace RiseMean_Private(const RiseFacet *facet, PetscInt num, const PetscReal weight[])
{
  RisePlace at = {{0}, {0}};

  for (PetscInt i = 0; i < num; i++) {
    for (PetscInt k = 0; k < 3; k++) at.normal[k] += weight[i] * facet->normal[3 * i + k];
    for (PetscInt k = 0; k < 9; k++) at.curvature[k] += weight[i] * facet->curvature[9 * i + k];
  }
  return at;
}

/* The middle of an edge: the node, else that of a cubic of the normals with the curvatures at the ends. */
static RisePlace RiseEdgeMiddle_Private(ElementType type, PetscInt e, const RiseFacet *facet)
{
  const PetscInt *ends = ElementEdgeNodes(ElementLinear(type), e), a = ends[0], b = ends[1];
  PetscReal       weight[ELEMENT_MAX_FACET_NODES] = {0}, d[3];
  RisePlace       at;

  if (ElementOrder(type) > 1) {
    weight[3 + e] = 1;
    return RiseMean_Private(facet, 6, weight);
  }
  weight[a] = weight[b] = 0.5;
  at                    = RiseMean_Private(facet, 3, weight);
  for (PetscInt k = 0; k < 3; k++) d[k] = (facet->X[3 * b + k] - facet->X[3 * a + k]) / 8;
  for (PetscInt k = 0; k < 3; k++)
    at.normal[k] +=
        VectorDot(3, &facet->curvature[9 * a + 3 * k], d) - VectorDot(3, &facet->curvature[9 * b + 3 * k], d);
  return at;
}

/* The part of a way from one place to another in the plane. Returns the part along its normal n. */
static PetscReal RiseSplit_Private(const PetscReal n[3], const PetscReal from[3], const PetscReal to[3],
                                   PetscReal off[3])
{
  PetscReal above;

  for (PetscInt k = 0; k < 3; k++) off[k] = to[k] - from[k];
  above = VectorDot(3, off, n);
  for (PetscInt k = 0; k < 3; k++) off[k] -= above * n[k];
  return above;
}

/* Height of the side over the plane of a triangle, on the line from the middle of edge e to the opposite
   vertex i, where l_i is 1/2. [in] n, flat - of the plane, the middle of the vertices; [in] x - in the middle
   of the edge, on the side. It need not be over the middle of the chord. */
static PetscReal RiseLine_Private(ElementType type, PetscInt e, const RiseFacet *facet, const PetscReal n[3],
                                  const PetscReal flat[3], const PetscReal x[3])
{
  const PetscInt  i         = (e + 2) % 3;
  const PetscReal weight[3] = {i == 0, i == 1, i == 2};
  const RisePlace vertex = RiseMean_Private(facet, 3, weight), middle = RiseEdgeMiddle_Private(type, e, facet);
  PetscReal       d[3], chord[3], off[3], above, slope;

  for (PetscInt k = 0; k < 3; k++) {
    d[k]     = flat[k] - facet->X[3 * i + k];
    chord[k] = flat[k] + d[k] / 2;
  }
  above = RiseSplit_Private(n, chord, x, off);
  above += RiseBend_Private(&middle, n, off, off) / 2 - RiseSlope_Private(&middle, n, off);
  slope = RiseSlope_Private(&middle, n, d) - RiseBend_Private(&middle, n, d, off);
  return (12 * RiseSlope_Private(&vertex, n, d) + 9 * RiseBend_Private(&vertex, n, d, d) / 4 + 10 * above - 3 * slope) /
         32;
}

/* A place of a triangle: on the plane of the vertices, and on the side as far as it is known.
   [out] flat, x - [3]; n - of the plane, optional, may be NULL */
static void RiseGetPlace_Private(ElementType type, const PetscReal X[], const PetscReal rise[], const PetscReal xi[],
                                 PetscReal flat[3], PetscReal x[3], PetscReal n[3])
{
  PetscReal phi[ELEMENT_MAX_NODES], at[3];

  (void)ElementSurface(ElementLinear(type), X, xi, flat, phi, n);
  (void)ElementSurface(type, X, xi, x, phi, NULL);
  RiseAt(type, rise, xi, at);
  for (PetscInt k = 0; k < 3; k++) x[k] += at[k];
}

/* Height of the side above a place x inside, opposite to edge e, by what is known at the vertices and on the
   edges. [in] n - of the plane of the vertices; [in] xi - of the place in this plane below x */
static PetscReal RiseHeight_Private(ElementType type, PetscInt e, const RiseFacet *facet, const PetscReal rise[],
                                    const PetscReal n[3], const PetscReal xi[], const PetscReal x[3])
{
  static const PetscReal centre[2] = {1. / 3, 1. / 3};
  PetscReal              middle[3], side[3], below[3], off[3], phi[ELEMENT_MAX_NODES], flat[3], above;
  RisePlace              at;

  RiseGetPlace_Private(type, facet->X, rise, ElementNode(ELEMENT_TRI6, 3 + e), below, side, NULL);
  RiseGetPlace_Private(type, facet->X, rise, centre, middle, below, NULL);
  (void)ElementSurface(ElementLinear(type), facet->X, xi, flat, phi, NULL);
  ElementShape(type, xi, phi, NULL);
  at    = RiseMean_Private(facet, ElementNumNodes(type), phi);
  above = RiseSplit_Private(n, flat, x, off);
  return RiseLine_Private(type, e, facet, n, middle, side) + RiseSlope_Private(&at, n, off) -
         RiseBend_Private(&at, n, off, off) / 2 - above;
}

/* The inside of a triangle. */
static void RiseSetInside_Private(ElementType type, const RiseFacet *facet, PetscReal rise[])
{
  PetscReal way[9] = {0}, sum[3] = {0};

  for (PetscInt e = 0; e < 3; e++) {
    const PetscInt  i       = (e + 2) % 3;
    const PetscReal xi[2]   = {i == 1 ? 0.5 : 0.25, i == 2 ? 0.5 : 0.25};
    PetscReal       flat[3] = {0, 0, 0}, x[3], n[3], offset[3];

    RiseGetPlace_Private(type, facet->X, rise, xi, flat, x, n);
    for (PetscInt k = 0; k < 3; k++) offset[k] = x[k] - flat[k];
    if (facet->quadric) {
      if (!QuadricTakeArc(facet->quadric, flat, flat, offset, n)) continue;
      for (PetscInt k = 0; k < 3; k++) offset[k] += flat[k] - x[k];
      for (PetscInt k = 0; k < 3; k++) way[3 * i + k] = VectorDot(3, offset, n) * n[k]; // not along the quadric
    } else {
      const PetscReal height = RiseHeight_Private(type, e, facet, rise, n, xi, x);

      if (!(PetscAbsReal(height) <= LARGEST_SHARE * VectorNorm(3, offset))) return;
      for (PetscInt k = 0; k < 3; k++) way[3 * i + k] = height * n[k];
    }
  }
  for (PetscInt k = 0; k < 9; k++) sum[k % 3] += way[k];
  for (PetscInt k = 0; k < 9; k++) rise[RISE_INSIDE * 3 + k] = 128 * way[k] - 32 * sum[k % 3];
}

void RiseComplete(ElementType type, const RiseFacet *facet, PetscReal rise[])
{
  RiseSetEdges_Private(type, facet, rise);
  if (ElementLinear(type) == ELEMENT_TRI3 && (facet->quadric || facet->curvature))
    RiseSetInside_Private(type, facet, rise);
}

void RiseAt(ElementType type, const PetscReal rise[], const PetscReal xi[], PetscReal at[])
{
  const ElementType linear = ElementLinear(type), high = ElementOfOrder(linear, 2);
  const PetscInt    dim = ElementDim(type) + 1, num = ElementNumNodes(linear);
  PetscReal         phi[ELEMENT_MAX_NODES], l[ELEMENT_MAX_NODES];

  ElementShape(high, xi, phi, NULL);
  ElementShape(linear, xi, l, NULL);
  for (PetscInt k = 0; k < dim; k++) at[k] = 0;
  for (PetscInt i = 0; i < ElementNumNodes(high) * dim; i++) at[i % dim] += phi[i / dim] * rise[i];
  for (PetscInt e = 0; e < ElementNumEdges(linear); e++) {
    const PetscInt  *ends = ElementEdgeNodes(linear, e), a = ends[0], b = ends[1];
    const PetscReal *p     = &rise[(RISE_CUBIC + 2 * e) * dim];
    const PetscReal  t     = num == 4 ? l[b] + l[(b + 1) % 4 == a ? (b + 3) % 4 : (b + 1) % 4] : 0;
    const PetscReal  turn  = num == 4 ? 1 - 2 * t : l[a] - l[b];
    const PetscReal  cubic = (num == 4 ? (l[a] + l[b]) * t * (1 - t) : l[a] * l[b]) * turn;

    for (PetscInt k = 0; k < dim; k++) at[k] += cubic * (p[k] + turn * p[dim + k]);
  }
  for (PetscInt k = 0; k < 9 && num == 3; k++) at[k % 3] += l[0] * l[1] * l[2] * l[k / 3] * rise[RISE_INSIDE * 3 + k];
}

PetscReal RiseAlong(ElementType type, const PetscReal rise[], const PetscReal xi[], const PetscReal n[])
{
  PetscReal at[3];

  RiseAt(type, rise, xi, at);
  return VectorDot(ElementDim(type) + 1, at, n);
}

PetscBool RiseIsAny(ElementType type, const PetscReal rise[])
{
  for (PetscInt i = 0; i < RISE_TERMS * (ElementDim(type) + 1); i++)
    if (rise[i] != 0) return PETSC_TRUE;
  return PETSC_FALSE;
}

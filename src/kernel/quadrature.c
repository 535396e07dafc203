/* quadrature.c -- quadrature rules on the reference cells of element.h.

   Tables and closed forms rather than a library: a rule is needed once per facet or piece. There its
   construction would cost more than its use.

   References:
     [1] G. R. Cowper, Gaussian quadrature formulas for triangles, Int. J. Numer. Meth. Engng 7 (1973).
     [2] A. H. Stroud, Approximate Calculation of Multiple Integrals (1971), T2:5-1.
     [3] N. J. Walkington, Quadrature on simplices of arbitrary dimension (2000). */
#include "kernel/element.h"

enum { GAUSS_MAX = 8, GAUSS_HALF = 4, MORE = 2, MORE_HALF = 8 };

/* Gauss-Legendre on [0,1]: points up to the middle and their weights; the rest follows by mirroring. */
static const PetscReal GAUSS_POINTS[GAUSS_MAX][GAUSS_HALF] = {
    {0.5},
    {0.21132486540518711775},
    {0.11270166537925831148, 0.5},
    {0.069431844202973712388, 0.3300094782075718676},
    {0.046910077030668003601, 0.23076534494715845448, 0.5},
    {0.033765242898423986094, 0.16939530676686774317, 0.38069040695840154568},
    {0.025446043828620737737, 0.12923440720030278007, 0.29707742431130141655, 0.5},
    {0.019855071751231884158, 0.1016667612931866302, 0.23723379504183550709, 0.40828267875217509753}};
static const PetscReal GAUSS_WEIGHTS[GAUSS_MAX][GAUSS_HALF] = {
    {1.},
    {0.5},
    {0.27777777777777777778, 0.44444444444444444444},
    {0.17392742256872692869, 0.32607257743127307131},
    {0.11846344252809454376, 0.23931433524968323402, 0.28444444444444444444},
    {0.08566224618958517252, 0.18038078652406930378, 0.23395696728634552369},
    {0.064742483084434846635, 0.13985269574463833395, 0.19091502525255947248, 0.20897959183673469388},
    {0.050614268145188129576, 0.11119051722668723527, 0.15685332293894364367, 0.18134189168918099148}};

/* The same with more points: columns of MORE_POINTS. */
static const PetscInt  MORE_POINTS[MORE]                  = {12, 16};
static const PetscReal MORE_GAUSS_POINTS[MORE][MORE_HALF] = {
    {0.0092196828766403746547, 0.047941371814762571661, 0.11504866290284765648, 0.20634102285669127635,
     0.31608425050090990312, 0.43738329574426554226},
    {0.0052995325041750337019, 0.027712488463383711961, 0.067184398806084128060, 0.12229779582249848305,
     0.19106187779867812578, 0.27099161117138630683, 0.35919822461037054338, 0.45249374508118127991}};
static const PetscReal MORE_GAUSS_WEIGHTS[MORE][MORE_HALF] = {
    {0.023587668193255913597, 0.053469662997659215480, 0.080039164271673113167, 0.10158371336153296087,
     0.11674626826917740438, 0.12457352290670139250},
    {0.013576229705877047426, 0.031126761969323946431, 0.047579255841246392405, 0.062314485627766936026,
     0.074797994408288366041, 0.084578259697501269095, 0.091301707522461794433, 0.094725305227534248143}};

PetscInt QuadratureLine(PetscInt n, PetscReal points[], PetscReal weights[])
{
  const PetscReal *p = n <= GAUSS_MAX ? GAUSS_POINTS[n - 1] : MORE_GAUSS_POINTS[n > MORE_POINTS[0]];
  const PetscReal *w = n <= GAUSS_MAX ? GAUSS_WEIGHTS[n - 1] : MORE_GAUSS_WEIGHTS[n > MORE_POINTS[0]];

  for (PetscInt i = 0; i < (n + 1) / 2; i++) {
    points[n - 1 - i] = 1. - p[i];
    points[i]         = p[i];
    weights[i] = weights[n - 1 - i] = w[i];
  }
  return n;
}

/* n Gauss points are exact to degree 2n - 1. */
static PetscInt QuadratureNumGauss_Private(PetscInt degree)
{
  return PetscMax(degree, 0) / 2 + 1;
}

/* The product of line rules, the first coordinate running fastest: exact for x^a y^b z^c up to the degree of
   each direction. [in] degree - [dim] */
static PetscInt QuadratureProductRule_Private(PetscInt dim, const PetscInt degree[], PetscReal points[],
                                              PetscReal weights[])
{
  PetscReal x[3][GAUSS_MAX], w[3][GAUSS_MAX];
  PetscInt  n[3], num = 1;

  for (PetscInt k = 0; k < dim; k++) {
    n[k] = QuadratureNumGauss_Private(degree[k]);
    if (n[k] > GAUSS_MAX) return 0;
    QuadratureLine(n[k], x[k], w[k]);
    num *= n[k];
  }
  if (num > ELEMENT_MAX_POINTS) return 0;
  for (PetscInt q = 0; q < num; q++) {
    PetscInt digits = q;

    weights[q] = 1.;
    for (PetscInt k = 0; k < dim; k++) {
      points[dim * q + k] = x[k][digits % n[k]];
      weights[q] *= w[k][digits % n[k]];
      digits /= n[k];
    }
  }
  return num;
}

/* The three points with barycentric coordinates (1 - 2a, a, a) in every order. */
static void QuadratureOrbit_Private(PetscReal a, PetscReal weight, PetscReal points[], PetscReal weights[])
{
  for (PetscInt i = 0; i < 3; i++) {
    points[2 * i]     = i == 1 ? 1. - 2. * a : a;
    points[2 * i + 1] = i == 2 ? 1. - 2. * a : a;
    weights[i]        = weight;
  }
}

/* The rule of the square or cube, collapsed into a corner of the simplex: each coordinate is scaled by 1 - t
   of those behind it. The Jacobian reduces the degree of the line rule by one for y, by two for z. */
static PetscInt QuadratureCollapsedRule_Private(PetscInt dim, PetscInt degree, PetscReal points[], PetscReal weights[])
{
  const PetscInt degrees[3] = {degree, degree + 1, degree + 2};
  const PetscInt n          = QuadratureProductRule_Private(dim, degrees, points, weights);

  for (PetscInt q = 0; q < n; q++) {
    for (PetscInt k = 1; k < dim; k++) {
      const PetscReal narrow = 1. - points[dim * q + k];

      for (PetscInt l = 0; l < k; l++) {
        points[dim * q + l] *= narrow;
        weights[q] *= narrow;
      }
    }
  }
  return n;
}

/* Symmetric rules with positive weights and inner points: 1, 3, 6 [1] and 7 points [2]; beyond them, the
   square's. */
static PetscInt QuadratureTriangleRule_Private(PetscInt degree, PetscReal points[], PetscReal weights[])
{
  const PetscReal area = 0.5, third = 1. / 3.;

  if (degree <= 1) {
    points[0] = points[1] = third;
    weights[0]            = area;
    return 1;
  }
  if (degree == 2) { /* not at the middles of the edges: no load is evaluated on a side */
    QuadratureOrbit_Private(1. / 6., area / 3., points, weights);
    return 3;
  }
  if (degree <= 4) { /* also for degree 3, where four points would need a negative weight */
    const PetscReal base = 8. - PetscSqrtReal(10.), root = PetscSqrtReal(38. - 44. * PetscSqrtReal(0.4));
    const PetscReal skew = PetscSqrtReal(213125. - 53320. * PetscSqrtReal(10.));

    QuadratureOrbit_Private((base + root) / 18., area * (620. + skew) / 3720., points, weights);
    QuadratureOrbit_Private((base - root) / 18., area * (620. - skew) / 3720., &points[6], &weights[3]);
    return 6;
  }
  if (degree == 5) {
    const PetscReal root = PetscSqrtReal(15.);

    QuadratureOrbit_Private((6. + root) / 21., area * (155. + root) / 1200., points, weights);
    QuadratureOrbit_Private((6. - root) / 21., area * (155. - root) / 1200., &points[6], &weights[3]);
    points[12] = points[13] = third;
    weights[6]              = area * 9. / 40.;
    return 7;
  }
  return QuadratureCollapsedRule_Private(2, degree, points, weights);
}

/* The four points with barycentric coordinates (1 - 3a, a, a, a) in every order. */
static void QuadratureCornerOrbit_Private(PetscReal a, PetscReal weight, PetscReal points[], PetscReal weights[])
{
  for (PetscInt i = 0; i < 4; i++) {
    for (PetscInt k = 0; k < 3; k++) points[3 * i + k] = i == k + 1 ? 1. - 3. * a : a;
    weights[i] = weight;
  }
}

/* The six points with barycentric coordinates (1/2 - a, 1/2 - a, a, a) in every order. */
static void QuadratureEdgeOrbit_Private(PetscReal a, PetscReal weight, PetscReal points[], PetscReal weights[])
{
  static const PetscInt pair[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};

  for (PetscInt i = 0; i < 6; i++) {
    for (PetscInt k = 0; k < 3; k++) points[3 * i + k] = pair[i][0] == k + 1 || pair[i][1] == k + 1 ? 0.5 - a : a;
    weights[i] = weight;
  }
}

/* Eight points, exact to degree 3. Let t = 1 - 4a be the place of an orbit between the centroid and the
   vertices. Weights of two orbits fulfil W_1 + W_2 = 1, sum W t^2 = 1/5, sum W t^3 = 1/15. Of the solutions,
   Stroud's has points on the facets (t = -1/3), this one has them all inside. */
static PetscInt QuadratureTetrahedronCubic_Private(PetscReal points[], PetscReal weights[])
{
  const PetscReal volume = 1. / 6., s = 0.32, ratio = (1. / 15. + s * s * s) / (1. / 5. - s * s),
                  mean = 0.5 * (s + ratio);
  const PetscReal t = mean - PetscSqrtReal(mean * mean - s * s - ratio * s), W = (1. / 5. - s * s) / (t * t - s * s);

  QuadratureCornerOrbit_Private(0.25 * (1. - t), volume * W / 4., points, weights);
  QuadratureCornerOrbit_Private(0.25 * (1. + s), volume * (1. - W) / 4., &points[12], &weights[4]);
  return 8;
}

/* Symmetric rules with positive weights and inner points: 1, 4, 8 and 14 points [3]; beyond them, the
   cube's. */
static PetscInt QuadratureTetrahedronRule_Private(PetscInt degree, PetscReal points[], PetscReal weights[])
{
  const PetscReal volume = 1. / 6.;

  if (degree <= 1) {
    points[0] = points[1] = points[2] = 0.25;
    weights[0]                        = volume;
    return 1;
  }
  if (degree == 2) {
    QuadratureCornerOrbit_Private(0.25 - 0.05 * PetscSqrtReal(5.), volume / 4., points, weights);
    return 4;
  }
  if (degree == 3) return QuadratureTetrahedronCubic_Private(points, weights);
  if (degree <= 5) {
    QuadratureCornerOrbit_Private(0.31088591926330060980, 0.018781320953002641800, points, weights);
    QuadratureCornerOrbit_Private(0.092735250310891226402, 0.012248840519393658257, &points[12], &weights[4]);
    QuadratureEdgeOrbit_Private(0.045503704125649649492, 0.0070910034628469110730, &points[24], &weights[8]);
    return 14;
  }
  return QuadratureCollapsedRule_Private(3, degree, points, weights);
}

PetscInt QuadratureRule(ElementType type, PetscInt degree, PetscReal points[], PetscReal weights[])
{
  const PetscInt degrees[3] = {degree, degree, degree};

  switch (ElementLinear(type)) {
  case ELEMENT_TRI3: return QuadratureTriangleRule_Private(degree, points, weights);
  case ELEMENT_TET4: return QuadratureTetrahedronRule_Private(degree, points, weights);
  default: return QuadratureProductRule_Private(ElementDim(type), degrees, points, weights);
  }
}

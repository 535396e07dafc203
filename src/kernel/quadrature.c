/* quadrature.c -- quadrature rules on the reference cells of element.h.

   Tables and closed forms rather than a library's rules: they are asked for once per facet or piece, where making a
   rule anew would cost more than using it.

   References:
     [1] G. R. Cowper, Gaussian quadrature formulas for triangles, Int. J. Numer. Meth. Engng 7 (1973).
     [2] A. H. Stroud, Approximate Calculation of Multiple Integrals (1971), T2:5-1. */
#include <mortise/element.h>

enum { GAUSS_MAX = 8, GAUSS_HALF = 4 };

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

PetscInt GaussLine(PetscInt n, PetscReal points[], PetscReal weights[])
{
  for (PetscInt i = 0; i < (n + 1) / 2; i++) {
    points[n - 1 - i] = 1. - GAUSS_POINTS[n - 1][i];
    points[i]         = GAUSS_POINTS[n - 1][i];
    weights[i] = weights[n - 1 - i] = GAUSS_WEIGHTS[n - 1][i];
  }
  return n;
}

/* n Gauss points are exact to degree 2n - 1. */
static PetscInt NumGauss_Private(PetscInt degree)
{
  return PetscMax(degree, 0) / 2 + 1;
}

static PetscInt LineRule_Private(PetscInt degree, PetscReal points[], PetscReal weights[])
{
  const PetscInt n = NumGauss_Private(degree);

  return n <= GAUSS_MAX ? GaussLine(n, points, weights) : 0;
}

/* The line's rule in both directions: exact for x^a y^b with a and b up to the degree. */
static PetscInt QuadRule_Private(PetscInt degree, PetscReal points[], PetscReal weights[])
{
  const PetscInt n = NumGauss_Private(degree);
  PetscReal      x[GAUSS_MAX], w[GAUSS_MAX];

  if (n * n > ELEMENT_MAX_POINTS) return 0;
  GaussLine(n, x, w);
  for (PetscInt j = 0; j < n; j++) {
    for (PetscInt i = 0; i < n; i++) {
      points[2 * (j * n + i)]     = x[i];
      points[2 * (j * n + i) + 1] = x[j];
      weights[j * n + i]          = w[i] * w[j];
    }
  }
  return n * n;
}

/* The three points with barycentric coordinates (1 - 2a, a, a) in every order. */
static void Orbit_Private(PetscReal a, PetscReal weight, PetscReal points[], PetscReal weights[])
{
  for (PetscInt i = 0; i < 3; i++) {
    points[2 * i]     = i == 1 ? 1. - 2. * a : a;
    points[2 * i + 1] = i == 2 ? 1. - 2. * a : a;
    weights[i]        = weight;
  }
}

/* The square's rule, its upper side drawn together into a corner: x = s (1 - t), y = t, whose Jacobian 1 - t takes one
   degree of what the line's rule can do. */
static PetscInt CollapsedRule_Private(PetscInt degree, PetscReal points[], PetscReal weights[])
{
  const PetscInt n = QuadRule_Private(degree + 1, points, weights);

  for (PetscInt q = 0; q < n; q++) {
    const PetscReal narrow = 1. - points[2 * q + 1];

    points[2 * q] *= narrow;
    weights[q] *= narrow;
  }
  return n;
}

/* Symmetric rules with positive weights and inner points: 1, 3, 6 [1] and 7 points [2]; beyond them, the square's. */
static PetscInt TriangleRule_Private(PetscInt degree, PetscReal points[], PetscReal weights[])
{
  const PetscReal area = 0.5, third = 1. / 3.;

  if (degree <= 1) {
    points[0] = points[1] = third;
    weights[0]            = area;
    return 1;
  }
  if (degree == 2) { /* points inside rather than at the middles of the edges, so that no load is evaluated on a side */
    Orbit_Private(1. / 6., area / 3., points, weights);
    return 3;
  }
  if (degree <= 4) { /* also for degree 3, where four points would need a negative weight */
    const PetscReal base = 8. - PetscSqrtReal(10.), root = PetscSqrtReal(38. - 44. * PetscSqrtReal(0.4));
    const PetscReal skew = PetscSqrtReal(213125. - 53320. * PetscSqrtReal(10.));

    Orbit_Private((base + root) / 18., area * (620. + skew) / 3720., points, weights);
    Orbit_Private((base - root) / 18., area * (620. - skew) / 3720., &points[6], &weights[3]);
    return 6;
  }
  if (degree == 5) {
    const PetscReal root = PetscSqrtReal(15.);

    Orbit_Private((6. + root) / 21., area * (155. + root) / 1200., points, weights);
    Orbit_Private((6. - root) / 21., area * (155. - root) / 1200., &points[6], &weights[3]);
    points[12] = points[13] = third;
    weights[6]              = area * 9. / 40.;
    return 7;
  }
  return CollapsedRule_Private(degree, points, weights);
}

PetscInt ElementQuadrature(ElementType type, PetscInt degree, PetscReal points[], PetscReal weights[])
{
  switch (ElementLinear(type)) {
  case ELEMENT_LINE2: return LineRule_Private(degree, points, weights);
  case ELEMENT_TRI3: return TriangleRule_Private(degree, points, weights);
  case ELEMENT_QUAD4: return QuadRule_Private(degree, points, weights);
  default: return 0;
  }
}

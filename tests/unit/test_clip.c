/* test_clip.c -- overlaps of line facets: reference values, chains without holes, and wild normals against sampling. */
#include "kernel/clip.h"
#include "kernel/dual.h"
#include "kernel/element.h"
#include "kernel/frame.h"
#include <test.h>

#include "chain.h"

static const PetscReal EXACT = 1e-13;

/* Two straight facets without their structs. [in] X, N, Y - [2][2] */
static PetscInt Clip(const PetscReal X[], const PetscReal N[], const PetscReal Y[], PetscInt num_gauss,
                     ClipPoint points[])
{
  const ClipFacet facet = {ELEMENT_LINE2, X, N}, other = {ELEMENT_LINE2, Y, NULL};

  return ClipLines(&facet, &other, num_gauss, points);
}

/* Two halves against three thirds, and a facet against one that is shifted by a quarter: exact fractions by hand. */
static void TestReferenceValues(void)
{
  Chain           halves = {.n = 3, .X = {{0., 0.}, {0.5, 0.}, {1., 0.}}};
  Chain           thirds = {.n = 4, .X = {{0., 0.}, {1. / 3., 0.}, {2. / 3., 0.}, {1., 0.}}};
  Chain           whole = {.n = 2, .X = {{0., 0.}, {1., 0.}}}, shifted = {.n = 2, .X = {{0.25, 0.}, {1.25, 0.}}};
  const PetscReal D[] = {1. / 4., 1. / 2., 1. / 4.}, M_cut[2][2] = {{45. / 128., -9. / 128.}, {15. / 128., 45. / 128.}};
  const PetscReal M[3][4] = {{2. / 9., 1. / 18., -1. / 36., 0.},
                             {-1. / 18., 11. / 36., 11. / 36., -1. / 18.},
                             {0., -1. / 36., 1. / 18., 2. / 9.}};
  Coupling        pair;

  ChainSetNormals(&halves);
  Couple(&halves, &thirds, NUM_GAUSS, &pair);
  for (PetscInt a = 0; a < 3; a++) {
    CHECK_NEAR(pair.D[a], D[a], EXACT);
    for (PetscInt b = 0; b < 4; b++) CHECK_NEAR(pair.M[a][b], M[a][b], EXACT);
  }
  ChainSetNormals(&whole);
  Couple(&whole, &shifted, NUM_GAUSS, &pair);
  CHECK_NEAR(pair.D[0], 9. / 32., EXACT);
  CHECK_NEAR(pair.D[1], 15. / 32., EXACT);
  for (PetscInt a = 0; a < 2; a++) {
    for (PetscInt b = 0; b < 2; b++) CHECK_NEAR(pair.M[a][b], M_cut[a][b], EXACT);
  }
}

/* Rough surfaces, cut at random ends: sum_b M_ab = D_aa and M x_m - D x_s = int psi g n, whatever the normals do. */
static void TestCoupling(PetscReal roughness)
{
  for (PetscInt trial = 0; trial < 1000; trial++) {
    const PetscReal distance = Uniform(-0.05, 0.3);
    Chain           nonmortar, mortar;
    Coupling        pair;

    RandomChain(PETSC_FALSE, 2 + trial % 7, 0., 1., 0., roughness, &nonmortar);
    RandomChain(PETSC_FALSE, 2 + trial % 11, Uniform(-0.5, 0.3), Uniform(0.6, 1.5), -distance, roughness, &mortar);
    Couple(&nonmortar, &mortar, NUM_GAUSS, &pair);
    for (PetscInt a = 0; a < nonmortar.n; a++) {
      PetscReal row = 0., moved[2] = {0., 0.};

      for (PetscInt b = 0; b < mortar.n; b++) {
        row += pair.M[a][b];
        for (PetscInt k = 0; k < 2; k++) moved[k] += pair.M[a][b] * mortar.X[b][k];
      }
      CHECK_NEAR(row, pair.D[a], EXACT);
      for (PetscInt k = 0; k < 2; k++) CHECK_NEAR(moved[k] - pair.D[a] * nonmortar.X[a][k], pair.gap[a][k], EXACT);
      if (roughness == 0.) CHECK_NEAR(pair.gap[a][1], -pair.D[a] * distance, EXACT); /* the normal looks down */
    }
  }
}

static void Swap(const PetscReal V[], PetscReal swapped[])
{
  for (PetscInt k = 0; k < 2; k++) {
    swapped[k]     = V[2 + k];
    swapped[2 + k] = V[k];
  }
}

/* The ends of either facet may be given in either order. */
static void TestOrder(void)
{
  for (PetscInt trial = 0; trial < 200; trial++) {
    const PetscReal Y[] = {Uniform(-0.5, 0.5), Uniform(-0.3, 0.), Uniform(0.6, 1.5), Uniform(-0.3, 0.)};
    PetscReal       turned_X[4], turned_N[4], turned_Y[4];
    ClipPoint       points[CLIP_MAX_POINTS], other[CLIP_MAX_POINTS];
    PetscInt        n;
    Chain           facet;

    RandomChain(PETSC_FALSE, 2, 0., 1., 0., 0., &facet);
    for (PetscInt i = 0; i < 2; i++) facet.N[i][0] = Uniform(-0.3, 0.3);
    Swap(facet.X[0], turned_X);
    Swap(facet.N[0], turned_N);
    Swap(Y, turned_Y);
    n = Clip(facet.X[0], facet.N[0], Y, NUM_GAUSS, points);
    CHECK(n == NUM_GAUSS);
    CHECK(n == Clip(facet.X[0], facet.N[0], turned_Y, NUM_GAUSS, other));
    for (PetscInt q = 0; q < n; q++) {
      CHECK_NEAR(other[q].xi[0], points[q].xi[0], EXACT);
      CHECK_NEAR(other[q].eta[0], 1. - points[q].eta[0], EXACT);
      CHECK_NEAR(other[q].gap, points[q].gap, EXACT);
    }
    CHECK(n == Clip(turned_X, turned_N, Y, NUM_GAUSS, other));
    for (PetscInt q = 0; q < n; q++) {
      CHECK_NEAR(other[n - 1 - q].xi[0], 1. - points[q].xi[0], EXACT);
      CHECK_NEAR(other[n - 1 - q].eta[0], points[q].eta[0], EXACT);
      CHECK_NEAR(other[n - 1 - q].gap, points[q].gap, EXACT);
    }
  }
}

/* The pieces on one facet from one-point rules: their middle and length tell their ends. Sorted by where they begin. */
static PetscInt SortedPieces(const Chain *nonmortar, PetscInt facet, const Chain *mortar, PetscReal ends[][2])
{
  const PetscReal *X      = nonmortar->X[facet];
  const PetscReal  length = PetscSqrtReal(PetscSqr(X[2] - X[0]) + PetscSqr(X[3] - X[1]));
  ClipPoint        points[MAX_NODES * CLIP_MAX_POINTS];
  PetscInt         facets[MAX_NODES * CLIP_MAX_POINTS];
  const PetscInt   num = ChainClip(nonmortar, facet, mortar, 1, points, facets);

  for (PetscInt q = 0; q < num; q++) {
    const PetscReal half = 0.5 * points[q].weight / length;
    PetscInt        p    = q;

    for (; p > 0 && ends[p - 1][0] > points[q].xi[0] - half; p--) {
      ends[p][0] = ends[p - 1][0];
      ends[p][1] = ends[p - 1][1];
    }
    ends[p][0] = points[q].xi[0] - half;
    ends[p][1] = points[q].xi[0] + half;
  }
  return num;
}

/* Where the ray through y leaves a chain of one segment: Newton's method for cross(x(xi) - y, n(xi)) = 0. */
static PetscReal Project(const Chain *facet, const PetscReal y[])
{
  PetscReal xi = 0.5;

  for (PetscInt it = 0; it < 8; it++) {
    PetscReal r[2], n[2], E[2], dN[2];

    for (PetscInt k = 0; k < 2; k++) {
      E[k]  = facet->X[1][k] - facet->X[0][k];
      dN[k] = facet->N[1][k] - facet->N[0][k];
      r[k]  = facet->X[0][k] + xi * E[k] - y[k];
      n[k]  = facet->N[0][k] + xi * dN[k];
    }
    xi -= (r[0] * n[1] - r[1] * n[0]) / (E[0] * n[1] - E[1] * n[0] + r[0] * dN[1] - r[1] * dN[0]);
  }
  return xi;
}

/* Mortar surfaces too flat to fold back along a ray: reaching beyond both ends, one covers the whole facet
   without holes or overlaps. A narrow one covers what lies between the projections of its ends. */
static void TestCover(PetscReal begin, PetscReal end)
{
  for (PetscInt trial = 0; trial < 3000; trial++) {
    const PetscInt num_nodes = 2 + trial % (MAX_NODES - 2);
    Chain          nonmortar, mortar;
    PetscReal      ends[MAX_NODES * 3][2], from = 0., to = 1.;
    PetscInt       num;

    RandomChain(PETSC_FALSE, 2, 0., 1., 0., 0.2, &nonmortar);
    RandomChain(PETSC_FALSE, num_nodes, begin, end, -Uniform(0., 0.5), 0.1 * (end - begin) / num_nodes, &mortar);
    for (PetscInt i = 0; i < 2; i++) nonmortar.N[i][0] += Uniform(-0.5, 0.5);
    for (PetscInt i = 0; i < 2; i++) FrameNormalize(2, nonmortar.N[i]);
    if (trial % 2) { /* facing bodies run in opposite directions */
      for (PetscInt i = 0; i < mortar.n / 2; i++) {
        PetscReal both[4] = {mortar.X[i][0], mortar.X[i][1], mortar.X[mortar.n - 1 - i][0],
                             mortar.X[mortar.n - 1 - i][1]};

        for (PetscInt k = 0; k < 2; k++) {
          mortar.X[i][k]                = both[2 + k];
          mortar.X[mortar.n - 1 - i][k] = both[k];
        }
      }
    }
    if (begin > 0.) {
      from = PetscMax(Project(&nonmortar, mortar.X[trial % 2 ? mortar.n - 1 : 0]), 0.);
      to   = PetscMin(Project(&nonmortar, mortar.X[trial % 2 ? 0 : mortar.n - 1]), 1.);
    }
    num = SortedPieces(&nonmortar, 0, &mortar, ends);
    CHECK(num >= 1);
    CHECK_NEAR(ends[0][0], from, 1e-14);
    CHECK_NEAR(ends[num - 1][1], to, 1e-14);
    for (PetscInt p = 1; p < num; p++) CHECK_NEAR(ends[p][0], ends[p - 1][1], 1e-14);
  }
}

/* Facets on an arc, seen by facets on a concentric one, on either side: every length is covered. */
static void TestArcs(void)
{
  const PetscReal radii[] = {0.8, 0.99, 1.01, 1.5};

  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(radii); k++) {
    Chain     disc = {.n = 9}, around = {.n = 14};
    Coupling  pair;
    PetscReal length = 0.;

    for (PetscInt i = 0; i < disc.n; i++) {
      disc.X[i][0] = PetscCosReal(0.2 * i);
      disc.X[i][1] = PetscSinReal(0.2 * i);
    }
    for (PetscInt i = 0; i < around.n; i++) {
      around.X[i][0] = radii[k] * PetscCosReal(0.15 * i - 0.2);
      around.X[i][1] = radii[k] * PetscSinReal(0.15 * i - 0.2);
    }
    ChainSetNormals(&disc);
    for (PetscInt i = 0; i + 1 < disc.n; i++) length += 2. * PetscSinReal(0.1);
    Couple(&disc, &around, NUM_GAUSS, &pair);
    CHECK_NEAR(pair.length, length, EXACT);
  }
}

/* Where the rays of both ends meet: every other ray of the facet passes it, too, or nearly so. */
static void Focus(const Chain *facet, PetscReal y[])
{
  const PetscReal *n = facet->N[0], *m = facet->N[1];
  const PetscReal  E[2] = {facet->X[1][0] - facet->X[0][0], facet->X[1][1] - facet->X[0][1]};
  const PetscReal  t    = (E[0] * m[1] - E[1] * m[0]) / (n[0] * m[1] - n[1] * m[0]);

  for (PetscInt k = 0; k < 2; k++) y[k] = facet->X[0][k] + t * n[k];
}

/* A facet with normals up to 85 degrees off its own, and a mortar facet anywhere, often in a special place. */
static void RandomWild(PetscInt trial, Chain *facet, PetscReal Y[])
{
  const PetscReal steepest = 85. * PETSC_PI / 180., scale = trial % 7 ? 2. : 1e6;

  RandomChain(PETSC_FALSE, 2, 0., 1., 0., 0.5, facet);
  for (PetscInt i = 0; i < 2; i++) {
    const PetscReal angle = Uniform(-steepest, steepest), c = PetscCosReal(angle), s = PetscSinReal(angle);
    const PetscReal x = facet->N[i][0], y = facet->N[i][1];

    facet->N[i][0] = c * x - s * y;
    facet->N[i][1] = s * x + c * y;
  }
  for (PetscInt k = 0; k < 4; k++) Y[k] = Uniform(-scale, scale);
  if (trial % 23 == 6) Focus(facet, Y);
  for (PetscInt k = 0; k < 2; k++) {
    if (trial % 5 == 1) Y[k] = facet->X[0][k];                                      /* shares a node */
    if (trial % 11 == 2) Y[2 + k] = facet->X[1][k];                                 /* or two */
    if (trial % 13 == 3) Y[2 + k] = Y[k];                                           /* has no length */
    if (trial % 17 == 4) Y[k] = 3. * facet->X[1][k] - 2. * facet->X[0][k];          /* lies on the same line */
    if (trial % 19 == 5) Y[k] = facet->X[0][k] + Uniform(-2., 2.) * facet->N[0][k]; /* ends on an end's ray */
  }
}

/* Every point lies on its ray and on both facets; what is covered is where sampled rays pass between the mortar ends.
   */
static void TestWild(void)
{
  enum { NUM_SAMPLES = 101 };

  for (PetscInt trial = 0; trial < 200000; trial++) {
    Chain     facet;
    PetscReal Y[4], covered = 0., length, scale;
    ClipPoint points[CLIP_MAX_POINTS], middles[CLIP_MAX_POINTS];
    PetscInt  num, num_pieces;

    RandomWild(trial, &facet, Y);
    num        = Clip(facet.X[0], facet.N[0], Y, 8, points);
    num_pieces = Clip(facet.X[0], facet.N[0], Y, 1, middles);
    CHECK(num == 8 * num_pieces && num <= CLIP_MAX_POINTS);
    length = PetscSqrtReal(PetscSqr(facet.X[1][0] - facet.X[0][0]) + PetscSqr(facet.X[1][1] - facet.X[0][1]));
    scale  = 1.;
    for (PetscInt k = 0; k < 4; k++) scale = PetscMax(scale, PetscAbsReal(Y[k]));
    for (PetscInt q = 0; q < num; q++) {
      const PetscReal xi = points[q].xi[0], eta = points[q].eta[0];

      CHECK(xi > 0. && xi < 1. && eta >= 0. && eta <= 1. && points[q].weight > 0.);
      covered += points[q].weight;
      for (PetscInt k = 0; k < 2; k++) {
        const PetscReal n[2] = {(1. - xi) * facet.N[0][0] + xi * facet.N[1][0],
                                (1. - xi) * facet.N[0][1] + xi * facet.N[1][1]};
        const PetscReal ray  = (1. - xi) * facet.X[0][k] + xi * facet.X[1][k] +
                              points[q].gap * n[k] / PetscSqrtReal(n[0] * n[0] + n[1] * n[1]);

        CHECK_NEAR(ray, (1. - eta) * Y[k] + eta * Y[2 + k], 1e-11 * scale);
      }
    }
    CHECK(covered <= length * (1. + EXACT));
    for (PetscInt s = 0; s < NUM_SAMPLES; s++) {
      const PetscReal xi = (s + 0.5) / NUM_SAMPLES;
      PetscReal       side[2], nearest = 1.;
      PetscBool       seen = PETSC_FALSE;

      for (PetscInt i = 0; i < 2; i++) {
        side[i] = ((1. - xi) * facet.X[0][0] + xi * facet.X[1][0] - Y[2 * i]) *
                      ((1. - xi) * facet.N[0][1] + xi * facet.N[1][1]) -
                  ((1. - xi) * facet.X[0][1] + xi * facet.X[1][1] - Y[2 * i + 1]) *
                      ((1. - xi) * facet.N[0][0] + xi * facet.N[1][0]);
        nearest = PetscMin(nearest, PetscAbsReal(side[i]) / scale);
      }
      for (PetscInt p = 0; p < num_pieces; p++) {
        if (PetscAbsReal(xi - middles[p].xi[0]) <= 0.5 * middles[p].weight / length) seen = PETSC_TRUE;
      }
      if (nearest > 1e-9) CHECK(seen == (side[0] * side[1] < 0. ? PETSC_TRUE : PETSC_FALSE));
    }
  }
}

/* What is shorter than 1e-12 of the facet, or only touches it, gives nothing. */
static void TestSlivers(void)
{
  const PetscReal X[] = {0., 0., 1., 0.}, N[] = {0., -1., 0., -1.};
  const PetscReal beside[] = {1., -0.1, 2., -0.1}, sliver[] = {-1., -0.1, 0.5e-12, -0.1},
                  thin[]    = {-1., -0.1, 2e-12, -0.1};
  const PetscReal upright[] = {0.5, 0., 0.5, -1.}, point[] = {0.5, -0.1, 0.5, -0.1};
  ClipPoint       points[CLIP_MAX_POINTS];

  CHECK(Clip(X, N, beside, NUM_GAUSS, points) == 0);
  CHECK(Clip(X, N, sliver, NUM_GAUSS, points) == 0);
  CHECK(Clip(X, N, upright, NUM_GAUSS, points) == 0);
  CHECK(Clip(X, N, point, NUM_GAUSS, points) == 0);
  CHECK(Clip(X, N, thin, 1, points) == 1);
  CHECK_NEAR(points[0].weight, 2e-12, 1e-15);
  CHECK_NEAR(points[0].gap, 0.1, 1e-16);
}

/* Facets in one plane across an axis touch to the last bit, wherever this plane is: a stiff body feels the rest. */
static void TestFarFromOrigin(void)
{
  const PetscReal h = 1e6 + 0.1, N[] = {0., -1., 0., -1., 0., -1.};
  const PetscReal X[] = {7. / 3., h, 8. / 3., h, 5. / 2., h}, Y[] = {19. / 7., h, 12. / 5., h, 179. / 70., h};
  const ClipFacet facet = {ELEMENT_LINE3, X, N}, other = {ELEMENT_LINE3, Y, NULL};
  ClipPoint       points[CLIP_MAX_POINTS];
  const PetscInt  num = ClipLines(&facet, &other, 3, points);

  CHECK(num == 3);
  for (PetscInt p = 0; p < num; p++) CHECK(points[p].gap == 0.);
}

/* The ends of what is covered, of lines and of quads. */
static void TestCorners(void)
{
  const PetscReal X[4] = {0., 0., 2., 0.}, N[4] = {0., -1., 0., -1.}, Y[4] = {3., -0.1, 0.5, -0.1};
  const PetscReal Q[12]         = {0., 0., 0., 0., 1., 0., 1., 1., 0., 1., 0., 0.},
                  up[12]        = {0., 0., 1., 0., 0., 1., 0., 0., 1., 0., 0., 1.};
  const PetscReal R[12]         = {0.25, -1., 0.1, 1.25, -1., 0.1, 1.25, 0.5, 0.1, 0.25, 0.5, 0.1};
  const PetscReal corners[4][2] = {{0., 0.25}, {0., 1.}, {0.5, 1.}, {0.5, 0.25}}; /* the first axis of the facet is y */
  const ClipFacet line = {ELEMENT_LINE2, X, N}, other = {ELEMENT_LINE2, Y, NULL}, quad = {ELEMENT_QUAD4, Q, up},
                  shifted = {ELEMENT_QUAD4, R, NULL};
  PetscReal xi[2 * CLIP_MAX_CORNERS];

  CHECK(ClipCorners(&line, &other, xi) == 2);
  CHECK_NEAR(xi[0], 0.25, EXACT);
  CHECK_NEAR(xi[2], 1., EXACT);
  CHECK(ClipCorners(&quad, &shifted, xi) == 4);
  for (PetscInt i = 0; i < 4; i++) {
    PetscReal nearest = 1.;

    for (PetscInt j = 0; j < 4; j++)
      nearest =
          PetscMin(nearest, PetscAbsReal(xi[2 * j] - corners[i][0]) + PetscAbsReal(xi[2 * j + 1] - corners[i][1]));
    CHECK_NEAR(nearest, 0., EXACT);
  }
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  TestReferenceValues();
  TestCoupling(0.);
  TestCoupling(0.05);
  CheckRigidMotion(PETSC_FALSE, 6, NUM_GAUSS, EXACT);
  TestOrder();
  TestCover(-1.5, 2.5);
  TestCover(0.3, 0.7);
  TestArcs();
  TestWild();
  TestSlivers();
  TestFarFromOrigin();
  TestCorners();
  PetscCall(PetscFinalize());
  return 0;
}

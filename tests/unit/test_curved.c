/* test_curved.c -- overlaps and couplings of quadratic facets: what holds exactly, and how fast curved sides converge. */
#include "chain.h"

static const PetscReal EXACT = 1e-13;

enum { CURVED_GAUSS = 6 };

/* A chain of nodes on an arc of the circle around the origin, the body inside it. */
static void ArcChain(PetscInt num_facets, PetscReal radius, PetscReal from, PetscReal to, Chain *chain)
{
  chain->quadratic = PETSC_TRUE;
  chain->n         = 2 * num_facets + 1;
  for (PetscInt i = 0; i < chain->n; i++) {
    const PetscReal angle = from + (to - from) * i / (chain->n - 1);

    chain->X[i][0] = radius * PetscCosReal(angle);
    chain->X[i][1] = radius * PetscSinReal(angle);
  }
  ChainSetNormals(chain);
}

static PetscReal MaxCoord(const Chain *chain)
{
  PetscReal largest = 0.;

  for (PetscInt i = 0; i < chain->n; i++)
    largest = PetscMax(largest, PetscMax(PetscAbsReal(chain->X[i][0]), PetscAbsReal(chain->X[i][1])));
  return largest;
}

/* Rough surfaces of either order, cut at random ends: sum_b M_ab = D_aa and M x_m - D x_s = int psi g n. On flat ones the
   projection carries whatever both sides can hold: quadratic functions from line3 to line3, linear ones else. */
static void TestCoupling(PetscBool quadratic_s, PetscBool quadratic_m, PetscReal roughness)
{
  for (PetscInt trial = 0; trial < 500; trial++) {
    const PetscReal distance = Uniform(-0.05, 0.3);
    const PetscInt  powers   = quadratic_s && quadratic_m && roughness == 0. ? 3 : 1;
    Chain           nonmortar, mortar;
    Coupling        pair;

    RandomChain(quadratic_s, 3 + 2 * (trial % 4), 0., 1., 0., roughness, &nonmortar);
    RandomChain(quadratic_m, 3 + 2 * (trial % 6), Uniform(-0.5, 0.2), Uniform(0.6, 1.5), -distance, roughness, &mortar);
    Couple(&nonmortar, &mortar, NUM_GAUSS, &pair);
    for (PetscInt a = 0; a < nonmortar.n; a++) {
      PetscReal size = 0.; /* of what cancels: large where a facet is covered on a small part */

      for (PetscInt b = 0; b < mortar.n; b++) size += PetscAbsReal(pair.M[a][b]) * MaxCoord(&mortar);
      for (PetscInt power = 0; power < powers; power++) {
        PetscReal sum = 0.;

        for (PetscInt b = 0; b < mortar.n; b++) sum += pair.M[a][b] * PetscPowRealInt(mortar.X[b][0], power);
        CHECK_NEAR(sum, pair.D[a] * PetscPowRealInt(nonmortar.X[a][0], power), EXACT * PetscMax(1., 10. * size));
      }
      for (PetscInt k = 0; k < 2; k++) {
        PetscReal moved = -pair.D[a] * nonmortar.X[a][k];

        for (PetscInt b = 0; b < mortar.n; b++) moved += pair.M[a][b] * mortar.X[b][k];
        CHECK_NEAR(moved, pair.gap[a][k], EXACT * PetscMax(1., 10. * size));
      }
    }
  }
}

/* One whole straight facet against itself: D = L (1/6, 1/6, 2/3), M = D on the diagonal. */
static void TestReferenceValues(void)
{
  const PetscReal D[]   = {1. / 3., 4. / 3., 1. / 3.};
  Chain           facet = {.n = 3, .quadratic = PETSC_TRUE, .X = {{0., 0.}, {1., 0.}, {2., 0.}}};
  Coupling        pair;

  ChainSetNormals(&facet);
  Couple(&facet, &facet, NUM_GAUSS, &pair);
  for (PetscInt a = 0; a < 3; a++) {
    CHECK_NEAR(pair.D[a], D[a], EXACT);
    for (PetscInt b = 0; b < 3; b++) CHECK_NEAR(pair.M[a][b], a == b ? D[a] : 0., EXACT);
  }
}

/* A facet with normals far off its own against any facet: every point lies on its ray and on both facets.
   What is covered is where sampled rays pass between the mortar ends. */
static void TestWild(void)
{
  enum { NUM_SAMPLES = 101 };

  for (PetscInt trial = 0; trial < 50000; trial++) {
    const PetscReal steepest = 60. * PETSC_PI / 180.;
    Chain           facet, other;
    ChainFacet      s, m;
    ClipPoint       points[CLIP_MAX_POINTS], ends[CLIP_MAX_POINTS];
    PetscInt        num, num_pieces;

    RandomChain(PETSC_TRUE, 3, 0., 1., 0., 0.15, &facet);
    for (PetscInt i = 0; i < 3; i++) {
      const PetscReal angle = Uniform(-steepest, steepest), c = PetscCosReal(angle), d = PetscSinReal(angle);
      const PetscReal x = facet.N[i][0], y = facet.N[i][1];

      facet.N[i][0] = c * x - d * y;
      facet.N[i][1] = d * x + c * y;
    }
    RandomChain(trial % 2 ? PETSC_TRUE : PETSC_FALSE, trial % 2 ? 3 : 2, Uniform(-1., 1.), Uniform(-1., 2.),
                Uniform(-1., 1.), 0.3, &other);
    ChainGetFacet(&facet, 0, &s);
    ChainGetFacet(&other, 0, &m);
    num        = ClipLines(&s.facet, &m.facet, 8, points);
    num_pieces = ClipLines(&s.facet, &m.facet, 2, ends) / 2;
    CHECK(num == 8 * num_pieces && num <= CLIP_MAX_POINTS);
    for (PetscInt q = 0; q < num; q++) {
      PetscReal x[2], y[2], n[2] = {0., 0.}, phi[3];

      CHECK(points[q].xi[0] > 0. && points[q].xi[0] < 1. && points[q].eta[0] >= 0. && points[q].eta[0] <= 1.);
      ElementSurface(m.facet.type, m.X, points[q].eta, y, phi, NULL);
      ElementSurface(ELEMENT_LINE3, s.X, points[q].xi, x, phi, NULL);
      for (PetscInt i = 0; i < 6; i++) n[i % 2] += phi[i / 2] * s.N[i];
      FrameNormalize(2, n);
      for (PetscInt k = 0; k < 2; k++) CHECK_NEAR(x[k] + points[q].gap * n[k], y[k], 1e-11);
    }
    for (PetscInt i = 0; i < NUM_SAMPLES; i++) {
      const PetscReal xi = (i + 0.5) / NUM_SAMPLES;
      PetscReal       x[2], n[2] = {0., 0.}, phi[3], side[2];
      PetscBool       seen = PETSC_FALSE;

      ElementSurface(ELEMENT_LINE3, s.X, &xi, x, phi, NULL);
      for (PetscInt j = 0; j < 6; j++) n[j % 2] += phi[j / 2] * s.N[j];
      for (PetscInt e = 0; e < 2; e++) side[e] = (x[0] - m.X[2 * e]) * n[1] - (x[1] - m.X[2 * e + 1]) * n[0];
      for (PetscInt p = 0; p < num_pieces; p++) {
        const PetscReal first = ends[2 * p].xi[0], last = ends[2 * p + 1].xi[0];
        const PetscReal half = 0.5 * (last - first) * PetscSqrtReal(3.); /* two Gauss points are 1/sqrt(3) apart */

        if (PetscAbsReal(xi - 0.5 * (first + last)) <= half) seen = PETSC_TRUE;
      }
      if (PetscMin(PetscAbsReal(side[0]), PetscAbsReal(side[1])) > 1e-9)
        CHECK(seen == (side[0] * side[1] < 0. ? PETSC_TRUE : PETSC_FALSE));
    }
  }
}

/* Facets on an arc, seen by others on concentric arcs: all of the curve is covered, sum D is its length. */
static void TestArcs(void)
{
  const PetscReal radii[] = {0.8, 0.99, 1., 1.01, 1.5};

  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(radii); k++) {
    PetscReal length = 0., sum = 0., points[8], weights[8];
    Chain     disc, around;
    Coupling  pair;

    ArcChain(5, 1., 0., 1.6, &disc);
    ArcChain(7, radii[k], -0.2, 1.8, &around);
    QuadratureLine(8, points, weights);
    for (PetscInt f = 0; f < 5; f++) {
      ChainFacet side;
      PetscReal  phi[3];

      ChainGetFacet(&disc, f, &side);
      for (PetscInt q = 0; q < 8; q++)
        length += weights[q] * ElementSurface(ELEMENT_LINE3, side.X, &points[q], NULL, phi, NULL);
    }
    Couple(&disc, &around, CURVED_GAUSS, &pair);
    for (PetscInt a = 0; a < disc.n; a++) sum += pair.D[a];
    CHECK_NEAR(pair.length, length, 1e-11);
    CHECK_NEAR(sum, length, 1e-11);
  }
}

/* Two coincident circles that are cut differently. The nodal gaps, zero in truth, fall with h^4, also at the
   ends of the side, whose normals are one-sided. How the cuts fall makes single steps irregular: four
   halvings are judged. */
static void TestCoincidentArcs(void)
{
  enum { NUM_LEVELS = 5 };
  PetscReal largest[NUM_LEVELS] = {0.};

  for (PetscInt level = 0; level < NUM_LEVELS; level++) {
    const PetscInt num = 3 << level;
    Chain          disc, around;
    Coupling       pair;

    ArcChain(num, 1., 0., 1.5, &disc);
    ArcChain(num + 1, 1., -0.1, 1.6, &around);
    Couple(&disc, &around, CURVED_GAUSS, &pair);
    for (PetscInt a = 0; a < disc.n; a++) {
      for (PetscInt k = 0; k < 2; k++)
        largest[level] = PetscMax(largest[level], PetscAbsReal(pair.gap[a][k] / pair.D[a]));
    }
  }
  CHECK_NEAR(PetscLog2Real(largest[0] / largest[NUM_LEVELS - 1]) / (NUM_LEVELS - 1), 4., 0.2);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  TestReferenceValues();
  for (PetscInt kind = 1; kind < 4; kind++) {
    const PetscBool quadratic_s = (PetscBool)(kind & 1), quadratic_m = (PetscBool)((kind & 2) / 2);

    TestCoupling(quadratic_s, quadratic_m, 0.);
    TestCoupling(quadratic_s, quadratic_m, 0.03);
  }
  CheckRigidMotion(PETSC_TRUE, 7, CURVED_GAUSS, 10. * EXACT);
  TestWild();
  TestArcs();
  TestCoincidentArcs();
  PetscCall(PetscFinalize());
  return 0;
}

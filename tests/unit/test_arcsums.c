/* test_arcsums.c -- offsets of edges between curved facets: on every curve, within flat sides; by hand. */
#include "refinement/arcsums.h"
#include "test.h"

static const PetscReal EXACT = 1e-12;

/* Offsets in the order of a case, each by a number of facets; the normal of a flat side or zero; the answer by hand. */
typedef struct {
  PetscInt  dim, num, repeat;
  PetscReal offset[3][3], plane[3], answer[3], tolerance;
} Case;

/* x, [1]: o.x = |o|^2 for each o, by elimination. x, [2]: within the flat side it is parallel to the part t of o there, and
   x = t |o|^2 / |t|^2; |t|^2 counts as a quarter of |o|^2 at least. */
static const Case Cases[] = {
    /* one curve, by one facet or by several */
    {2, 1, 1, {{0.3, -0.1}}, {0}, {0.3, -0.1}, 1e-12},
    {3, 1, 1, {{0.3, -0.1, 0.2}}, {0}, {0.3, -0.1, 0.2}, 1e-12},
    {3, 2, 2, {{0.3, -0.1, 0.2}, {0.3, -0.1, 0.2}}, {0}, {0.3, -0.1, 0.2}, 1e-12},
    /* two curves and three, [1]; how many facets each has does not count */
    {2, 2, 1, {{1, 0}, {1, 2}}, {0}, {1, 2}, 1e-12},
    {3, 2, 1, {{0, 0, 3}, {4, 0, 0}}, {0}, {4, 0, 3}, 1e-12},
    {3, 2, 5, {{1, 0, 0}, {1, 1, 0}}, {0}, {1, 1, 0}, 1e-12},
    {3, 3, 3, {{1, 0, 0}, {1, 1, 0}, {1, 1, 1}}, {0}, {1, 1, 1}, 1e-12},
    {3, 2, 1, {{1, 0, 0.05}, {1.1, 0, -0.055}}, {0}, {1.05 * 1.0025, 0, -1.0025}, 1e-12},
    /* two curves of one patch, whose offsets differ by an error: a multiple of their mean, not 1.01 / 0.002 times their difference */
    {3, 2, 1, {{1, 0, 0.001}, {1.01, 0, -0.001}}, {0}, {1.005, 0, 0}, 1e-3},
    /* a flat side, [2]: normal to the curve's offset; oblique; steep, where the quarter counts: t 1.25 / 0.3125 */
    {3, 1, 1, {{0.2, 0, 0}}, {0, 0, 1}, {0.2, 0, 0}, 1e-12},
    {2, 1, 2, {{0.2, 0.1}}, {0, 3}, {0.25, 0}, 1e-12},
    {3, 1, 1, {{0.2, 0, 0.1}}, {0, 0, -2}, {0.25, 0, 0}, 1e-12},
    {3, 1, 1, {{0, 0.5, 1}}, {0, 0, 1}, {0, 2, 0}, 1e-12},
};

static PetscBool Solve(const Case *c, PetscReal scale, PetscReal x[3])
{
  PetscScalar sums[ARC_SUMS] = {0};

  for (PetscInt o = 0; o < c->num; o++) {
    const PetscInt  times     = o ? c->repeat : 1;
    const PetscReal offset[3] = {scale * c->offset[o][0], scale * c->offset[o][1], scale * c->offset[o][2]};

    for (PetscInt i = 0; i < times; i++) ArcSumsAddOffset(c->dim, offset, sums);
  }
  ArcSumsAddPlane(c->dim, c->plane, sums);
  return ArcSumsToOffset(c->dim, sums, x);
}

/* All cases, in units of 1 and of 1e-6. */
static void TestOffsets(void)
{
  for (size_t i = 0; i < sizeof(Cases) / sizeof(Cases[0]); i++) {
    for (PetscReal scale = 1; scale > 1e-7; scale *= 1e-6) {
      PetscReal x[3];

      CHECK(Solve(&Cases[i], scale, x));
      for (PetscInt k = 0; k < Cases[i].dim; k++) CHECK_NEAR(x[k] / scale, Cases[i].answer[k], Cases[i].tolerance);
    }
  }
}

/* A straight edge has no offset, with and without a flat side. */
static void TestNone(void)
{
  const Case none = {.dim = 3, .num = 2, .repeat = 1}, flat = {.dim = 3, .num = 2, .repeat = 1, .plane = {0, 1, 0}};
  PetscReal  x[3];

  CHECK(!Solve(&none, 1, x));
  CHECK(!Solve(&flat, 1, x));
}

/* A circle of radius 1 where a cone of slope 0.5 ends on the plane z = 0. The middle of a chord moves along its radius to the
   circle. Its way to the cone leaves the plane. */
static void TestCone(void)
{
  const PetscReal slope = 0.5, turn = 1e-3, s = 1 - PetscCosReal(turn), c2 = 1 / (1 + slope * slope);
  PetscScalar     sums[ARC_SUMS] = {0};
  PetscReal       x[3];

  ArcSumsAddOffset(3, (PetscReal[]){s * c2, 0, s * slope * c2}, sums);
  ArcSumsAddPlane(3, (PetscReal[]){0, 0, 1}, sums);
  CHECK(ArcSumsToOffset(3, sums, x));
  CHECK_NEAR(x[0] / s, 1, EXACT);
  CHECK_NEAR(x[1], 0, 0);
  CHECK_NEAR(x[2], 0, EXACT * s);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  TestOffsets();
  TestNone();
  TestCone();
  PetscCall(PetscFinalize());
  return 0;
}

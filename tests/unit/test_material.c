/* test_material.c -- Hooke's law: closed forms, rotations against tensors, definiteness. */
#include "kernel/material.h"
#include <test.h>

#include "uniform.h"

static const PetscReal EXACT = 1e-13;

static const PetscReal YOUNG = 2.5, POISSON = 0.3;

enum { NUM_TRIALS = 200 };

/* The upper triangle of C row by row. */
static void UpperOf(PetscInt n, const PetscReal C[], PetscReal upper[])
{
  for (PetscInt i = 0, entry = 0; i < n; i++) {
    for (PetscInt j = i; j < n; j++) upper[entry++] = C[i * n + j];
  }
}

/* A stiff diagonal with random couplings: no symmetry but the one of C. */
static void RandomUpper(PetscInt n, PetscReal upper[])
{
  for (PetscInt i = 0, entry = 0; i < n; i++) {
    for (PetscInt j = i; j < n; j++) upper[entry++] = i == j ? Uniform(4., 8.) : Uniform(-0.5, 0.5);
  }
}

static void TestIsotropic(void)
{
  const PetscReal strained = YOUNG / ((1. + POISSON) * (1. - 2. * POISSON)), mu = YOUNG / (2. * (1. + POISSON));
  const PetscReal stressed = YOUNG / (1. - POISSON * POISSON), lambda = strained * POISSON;
  const PetscReal plane_strain[] = {
      strained * (1. - POISSON), lambda, 0., lambda, strained * (1. - POISSON), 0., 0., 0., mu};
  const PetscReal plane_stress[] = {stressed, stressed * POISSON, 0., stressed * POISSON, stressed, 0., 0., 0., mu};
  PetscReal       C[36];

  CHECK(MaterialNumStrains(MODEL_PLANE_STRAIN) == 3);
  CHECK(MaterialNumStrains(MODEL_PLANE_STRESS) == 3);
  CHECK(MaterialNumStrains(MODEL_SOLID) == 6);
  MaterialIsotropic(MODEL_PLANE_STRAIN, YOUNG, POISSON, C);
  for (PetscInt i = 0; i < 9; i++) CHECK_NEAR(C[i], plane_strain[i], EXACT);
  MaterialIsotropic(MODEL_PLANE_STRESS, YOUNG, POISSON, C);
  for (PetscInt i = 0; i < 9; i++) CHECK_NEAR(C[i], plane_stress[i], EXACT);
  MaterialIsotropic(MODEL_SOLID, YOUNG, POISSON, C);
  for (PetscInt i = 0; i < 6; i++) {
    for (PetscInt j = 0; j < 6; j++) {
      const PetscReal direct = i == j ? lambda + 2. * mu : lambda, shear = i == j ? mu : 0.;

      CHECK_NEAR(C[6 * i + j], i < 3 && j < 3 ? direct : shear, EXACT);
    }
  }
}

/* Pulled in x and free to contract, a body shows Young's modulus and Poisson's ratio in every model. */
static void TestUniaxial(void)
{
  const PetscReal solid_strain[] = {1., -POISSON, -POISSON, 0., 0., 0.}, stress_strain[] = {1., -POISSON, 0.};
  const PetscReal contraction      = POISSON / (1. - POISSON); /* of plane strain, where zz is held */
  const PetscReal strain_strain[]  = {1., -contraction, 0.};
  const PetscReal strain_modulus   = YOUNG / (1. - POISSON * POISSON);
  const PetscReal expected_solid[] = {YOUNG, 0., 0., 0., 0., 0.};
  PetscReal       C[36], stress[6];

  MaterialIsotropic(MODEL_SOLID, YOUNG, POISSON, C);
  MaterialStress(MODEL_SOLID, C, POISSON, solid_strain, stress);
  for (PetscInt i = 0; i < 6; i++) CHECK_NEAR(stress[i], expected_solid[i], EXACT);
  MaterialIsotropic(MODEL_PLANE_STRESS, YOUNG, POISSON, C);
  MaterialStress(MODEL_PLANE_STRESS, C, POISSON, stress_strain, stress);
  for (PetscInt i = 0; i < 6; i++) CHECK_NEAR(stress[i], expected_solid[i], EXACT);
  MaterialIsotropic(MODEL_PLANE_STRAIN, YOUNG, POISSON, C);
  MaterialStress(MODEL_PLANE_STRAIN, C, POISSON, strain_strain, stress);
  CHECK_NEAR(stress[0], strain_modulus, EXACT);
  CHECK_NEAR(stress[1], 0., EXACT);
  CHECK_NEAR(stress[2], POISSON * strain_modulus, EXACT);
}

/* Axisymmetric: three direct strains and one shear of a solid; turning does not touch what is around the axis. */
static void TestRing(void)
{
  const PetscReal quarter[] = {90.}, strain[] = {1., 2., 3., 4.}, solid_strain[] = {1., 2., 3., 0., 0., 4.};
  const PetscReal ring[10]   = {10., 1., 2., 0., 4., 3., 0., 6., 0., 9.}; /* C11 C12 C13 C14 C22 C23 C24 C33 C34 C44 */
  const PetscReal turned[10] = {4., 1., 3., 0., 10., 2., 0., 6., 0., 9.};
  PetscReal       C[36], stress[6], solid_stress[6], upper[21];

  CHECK(MaterialNumStrains(MODEL_AXISYMMETRIC) == 4);
  MaterialIsotropic(MODEL_AXISYMMETRIC, YOUNG, POISSON, C);
  MaterialStress(MODEL_AXISYMMETRIC, C, POISSON, strain, stress);
  MaterialIsotropic(MODEL_SOLID, YOUNG, POISSON, C);
  MaterialStress(MODEL_SOLID, C, POISSON, solid_strain, solid_stress);
  for (PetscInt i = 0; i < 6; i++) CHECK_NEAR(stress[i], solid_stress[i], EXACT);
  MaterialAnisotropic(MODEL_AXISYMMETRIC, ring, quarter, C);
  UpperOf(4, C, upper);
  for (PetscInt i = 0; i < 10; i++) CHECK_NEAR(upper[i], turned[i], EXACT);
}

/* Shear lands in the last component; zz of a 2D tensor that leaves it open is not invented. */
static void TestStressPlaces(void)
{
  const PetscReal strain[] = {0., 0., 0.5}, mu = YOUNG / (2. * (1. + POISSON));
  PetscReal       C[9], stress[6];

  MaterialIsotropic(MODEL_PLANE_STRAIN, YOUNG, POISSON, C);
  MaterialStress(MODEL_PLANE_STRAIN, C, NAN, strain, stress);
  CHECK(PetscIsNanReal(stress[2]));
  CHECK_NEAR(stress[3], 0., 0.);
  CHECK_NEAR(stress[4], 0., 0.);
  CHECK_NEAR(stress[5], 0.5 * mu, EXACT);
  MaterialStress(MODEL_PLANE_STRESS, C, NAN, strain, stress);
  CHECK_NEAR(stress[2], 0., 0.);
}

static void TestVonMises(void)
{
  const PetscReal pull[] = {0., -3., 0., 0., 0., 0.}, shear[] = {0., 0., 0., 0., 0., 2.},
                  hydrostatic[] = {5., 5., 5., 0., 0., 0.};
  const PetscReal shears[]      = {0., 0., 0., 1., 2., 2.};

  CHECK_NEAR(MaterialVonMises(pull), 3., EXACT);
  CHECK_NEAR(MaterialVonMises(shear), 2. * PetscSqrtReal(3.), EXACT);
  CHECK_NEAR(MaterialVonMises(shears), 3. * PetscSqrtReal(3.), EXACT);
  CHECK_NEAR(MaterialVonMises(hydrostatic), 0., 0.);
}

static void TestNoTurn(ModelKind model)
{
  const PetscInt  n          = MaterialNumStrains(model);
  const PetscReal no_angle[] = {0., 0., 0.},
                  angle[]    = {Uniform(-180., 180.), Uniform(-180., 180.), Uniform(-180., 180.)};
  PetscReal upper[21], again[21], isotropic[36], C[36];

  RandomUpper(n, upper);
  MaterialAnisotropic(model, upper, no_angle, C);
  UpperOf(n, C, again);
  for (PetscInt i = 0; i < n * (n + 1) / 2; i++) CHECK_NEAR(again[i], upper[i], 0.);
  MaterialIsotropic(model, YOUNG, POISSON, isotropic);
  UpperOf(n, isotropic, upper);
  MaterialAnisotropic(model, upper, angle, C);
  for (PetscInt i = 0; i < n * n; i++) CHECK_NEAR(C[i], isotropic[i], EXACT);
}

/* A quarter turn about z exchanges the axes x and y: the indices 1 and 2 of C, and 4 and 5 in 3D. */
static void TestQuarterTurn(void)
{
  const PetscReal quarter[] = {90., 0., 0.}, about_x[] = {0., 90., 0.};
  const PetscReal plane[]   = {10., 1., 0., 4., 0., 2.}; /* C11 C12 C13 C22 C23 C33 */
  const PetscReal turned[]  = {4., 1., 0., 10., 0., 2.};
  const PetscReal solid[21] = {10., 1., 2., 0., 0., 0., 4., 3., 0., 0., 0., 6., 0., 0., 0., 7., 0., 0., 8., 0., 9.};
  PetscReal       C[36], upper[21];

  MaterialAnisotropic(MODEL_PLANE_STRESS, plane, quarter, C);
  UpperOf(3, C, upper);
  for (PetscInt i = 0; i < 6; i++) CHECK_NEAR(upper[i], turned[i], EXACT);
  MaterialAnisotropic(MODEL_SOLID, solid, quarter, C);
  CHECK_NEAR(C[0], 4., EXACT);
  CHECK_NEAR(C[7], 10., EXACT);
  CHECK_NEAR(C[2], 3., EXACT);  /* xx-zz was yy-zz */
  CHECK_NEAR(C[8], 2., EXACT);  /* yy-zz was xx-zz */
  CHECK_NEAR(C[21], 8., EXACT); /* yz was xz */
  CHECK_NEAR(C[28], 7., EXACT);
  CHECK_NEAR(C[35], 9., EXACT);
  MaterialAnisotropic(MODEL_SOLID, solid, about_x, C);
  CHECK_NEAR(C[0], 10., EXACT);
  CHECK_NEAR(C[7], 6., EXACT); /* yy was zz */
  CHECK_NEAR(C[14], 4., EXACT);
}

/* out = R e R' with R a turn by degrees in the plane of axes a and b */
static void TurnTensor(PetscReal e[3][3], PetscInt a, PetscInt b, PetscReal degrees)
{
  const PetscReal c = PetscCosReal(degrees * PETSC_PI / 180.), s = PetscSinReal(degrees * PETSC_PI / 180.);

  for (PetscInt k = 0; k < 3; k++) {
    const PetscReal first = e[a][k], second = e[b][k];

    e[a][k] = c * first - s * second;
    e[b][k] = s * first + c * second;
  }
  for (PetscInt k = 0; k < 3; k++) {
    const PetscReal first = e[k][a], second = e[k][b];

    e[k][a] = c * first - s * second;
    e[k][b] = s * first + c * second;
  }
}

static PetscReal Energy(ModelKind model, const PetscReal C[], PetscReal e[3][3])
{
  const PetscInt   n        = MaterialNumStrains(model);
  const PetscReal  solid[6] = {e[0][0], e[1][1], e[2][2], 2. * e[1][2], 2. * e[0][2], 2. * e[0][1]};
  const PetscReal  plane[3] = {e[0][0], e[1][1], 2. * e[0][1]}, ring[4] = {e[0][0], e[1][1], e[2][2], 2. * e[0][1]};
  const PetscReal *strain = n == 6 ? solid : (n == 4 ? ring : plane);
  PetscReal        energy = 0.;

  for (PetscInt i = 0; i < n; i++) {
    for (PetscInt j = 0; j < n; j++) energy += 0.5 * strain[i] * strain[j] * C[i * n + j];
  }
  return energy;
}

/* A strain that turns with the material stores the same energy. The intrinsic angles z-x-z turn about the fixed axes in
   the opposite order. */
static void TestEnergy(ModelKind model)
{
  const PetscReal no_angle[] = {0., 0., 0.};
  const PetscInt  n          = MaterialNumStrains(model);

  for (PetscInt trial = 0; trial < NUM_TRIALS; trial++) {
    const PetscReal angle[] = {Uniform(-180., 180.), Uniform(-180., 180.), Uniform(-180., 180.)};
    PetscReal       upper[21], before[36], after[36], e[3][3] = {{0.}}, energy;

    RandomUpper(n, upper);
    MaterialAnisotropic(model, upper, no_angle, before);
    MaterialAnisotropic(model, upper, angle, after);
    for (PetscInt i = 0; i < (n == 6 ? 3 : 2); i++) {
      for (PetscInt j = 0; j <= i; j++) e[i][j] = e[j][i] = Uniform(-1., 1.);
    }
    energy = Energy(model, before, e);
    if (n == 6) {
      TurnTensor(e, 0, 1, angle[2]);
      TurnTensor(e, 1, 2, angle[1]);
    }
    TurnTensor(e, 0, 1, angle[0]);
    CHECK_NEAR(Energy(model, after, e), energy, EXACT * PetscMax(1., energy));
    CHECK(MaterialDefiniteness(n, before) > 0. && MaterialDefiniteness(n, after) > 0.);
  }
}

/* The eigenvalues of an isotropic solid are E/(1-2nu), 2 mu and mu (engineering shear). */
static void TestDefiniteness(void)
{
  const PetscReal indefinite[] = {1., 2., 0., 2., 1., 0., 0., 0., 1.},
                  singular[]   = {1., 1., 0., 1., 1., 0., 0., 0., 1.};
  const PetscReal negative[] = {-1., 0., 0., 0., -1., 0., 0., 0., -1.}, mu = YOUNG / (2. * (1. + POISSON));
  PetscReal       C[36];

  MaterialIsotropic(MODEL_SOLID, YOUNG, POISSON, C);
  CHECK_NEAR(MaterialDefiniteness(6, C), mu / (YOUNG / (1. - 2. * POISSON)), EXACT);
  CHECK_NEAR(MaterialDefiniteness(3, indefinite), -1. / 3., EXACT);
  CHECK_NEAR(MaterialDefiniteness(3, singular), 0., EXACT);
  CHECK(MaterialDefiniteness(3, negative) < 0.);
}

static void TestContactModulus(void)
{
  const PetscReal soft_in_y[] = {10., 0., 0., 0., 4., 0., 0., 0., 2.}, no_angle[] = {0., 0., 0.};
  const PetscReal soft_in_z[] = {9., 0., 0.5, 0., 0., 0., 8., 1., 0., 0., 0., 3., 0., 0., 0., 1., 0., 0., 1., 0., 1.};
  PetscReal       C[36];

  MaterialIsotropic(MODEL_PLANE_STRAIN, YOUNG, POISSON, C);
  CHECK_NEAR(MaterialContactModulus(3, C), YOUNG / (1. - POISSON * POISSON), EXACT);
  MaterialIsotropic(MODEL_PLANE_STRESS, YOUNG, POISSON, C);
  CHECK_NEAR(MaterialContactModulus(3, C), YOUNG, EXACT);
  CHECK_NEAR(MaterialContactModulus(3, soft_in_y), 4., EXACT);
  MaterialIsotropic(MODEL_AXISYMMETRIC, YOUNG, POISSON, C);
  CHECK_NEAR(MaterialContactModulus(4, C), YOUNG / (1. - POISSON * POISSON), EXACT);
  MaterialIsotropic(MODEL_SOLID, YOUNG, POISSON, C);
  CHECK_NEAR(MaterialContactModulus(6, C), YOUNG / (1. - POISSON * POISSON), EXACT);
  /* in space z is the softest axis; with y held C_zz - C_xz^2 / C_xx is left of it, with x held C_zz - C_yz^2 / C_yy */
  MaterialAnisotropic(MODEL_SOLID, soft_in_z, no_angle, C);
  CHECK_NEAR(MaterialContactModulus(6, C), 3. - 1. / 8., EXACT);
}

/* Of states whose principal stresses are known, and of one turned about z by 30 degrees. */
static void TestPrincipal(void)
{
  static const PetscReal pull[] = {3., 0., 0., 0., 0., 0.}, shear[] = {0., 0., 0., 0., 0., 2.};
  static const PetscReal pressure[] = {-5., -5., -5., 0., 0., 0.}, shears[] = {1., 1., 1., 2., 2., 2.};
  static const PetscReal turned[] = {2.5, 1.5, -4., 0., 0., 0.8660254037844386}, unknown[] = {1., 2., NAN, 0., 0., 0.};
  const struct {
    const PetscReal *stress, expected[3];
  } cases[] = {{pull, {3., 0., 0.}},
               {shear, {2., 0., -2.}},
               {pressure, {-5., -5., -5.}},
               {shears, {5., -1., -1.}},
               {turned, {3., 1., -4.}}};
  PetscReal principal[3];

  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(cases); i++) {
    MaterialPrincipal(cases[i].stress, principal);
    for (PetscInt k = 0; k < 3; k++) CHECK_NEAR(principal[k], cases[i].expected[k], EXACT);
  }
  MaterialPrincipal(unknown, principal);
  for (PetscInt k = 0; k < 3; k++) CHECK(PetscIsNanReal(principal[k]));
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  TestIsotropic();
  TestUniaxial();
  TestRing();
  TestStressPlaces();
  TestVonMises();
  TestPrincipal();
  TestNoTurn(MODEL_PLANE_STRAIN);
  TestNoTurn(MODEL_AXISYMMETRIC);
  TestNoTurn(MODEL_SOLID);
  TestQuarterTurn();
  TestEnergy(MODEL_PLANE_STRAIN);
  TestEnergy(MODEL_AXISYMMETRIC);
  TestEnergy(MODEL_SOLID);
  TestDefiniteness();
  TestContactModulus();
  PetscCall(PetscFinalize());
  return 0;
}

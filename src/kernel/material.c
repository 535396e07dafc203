/* material.c -- Hooke's law in Voigt's order with engineering shear: sigma = C eps (eq. 8.1).

   Voigt's vectors are no vectors: stresses and strains rotate with different matrices, because shear is
   counted twice in a strain. Rotations are therefore written with the two tensor indices of each of Voigt's.

   Reference:
     [1] B. A. Auld, Acoustic Fields and Waves in Solids I (1973), section 3.D: Bond's matrices. */
#include "kernel/dense.h"
#include "kernel/material.h"

enum { STRAINS_PLANE = 3, STRAINS_RING = 4, STRAINS_3D = 6 };

/* The two tensor indices behind each of the six strains. */
static const PetscInt VOIGT[STRAINS_3D][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
/* Which of the six a model with so many strains carries; the others are 0. */
static const PetscInt CARRIED[STRAINS_3D + 1][STRAINS_3D] = {
    [STRAINS_PLANE] = {0, 1, 5}, [STRAINS_RING] = {0, 1, 2, 5}, [STRAINS_3D] = {0, 1, 2, 3, 4, 5}};

PetscInt MaterialNumStrains(ModelKind model)
{
  if (model == MODEL_AXISYMMETRIC) return STRAINS_RING;
  return model == MODEL_SOLID ? STRAINS_3D : STRAINS_PLANE;
}

/* The direct strains come first. */
static PetscInt MaterialNumDirectStrains_Private(PetscInt num_strains)
{
  return num_strains == STRAINS_PLANE ? 2 : 3;
}

/* sigma_ij = lambda eps_kk delta_ij + 2 mu eps_ij, and gamma = 2 eps for shear. Plane stress has the same
   form with the lambda that makes sigma_zz vanish. */
void MaterialIsotropic(ModelKind model, PetscReal young, PetscReal poisson, PetscReal C[])
{
  const PetscInt  num_strains = MaterialNumStrains(model), num_direct = MaterialNumDirectStrains_Private(num_strains);
  const PetscReal mu     = young / (2. * (1. + poisson));
  const PetscReal lambda = model == MODEL_PLANE_STRESS ? young * poisson / (1. - poisson * poisson)
                                                       : young * poisson / ((1. + poisson) * (1. - 2. * poisson));

  for (PetscInt i = 0; i < num_strains; i++) {
    for (PetscInt j = 0; j < num_strains; j++) {
      C[i * num_strains + j] = i < num_direct && j < num_direct ? lambda : 0.;
      if (i == j) C[i * num_strains + j] += i < num_direct ? 2. * mu : mu;
    }
  }
}

/* R takes components along the material axes to global ones: R = R_z(angle_0) R_x(angle_1) R_z(angle_2), of
   which a model in a plane has the first. */
static void MaterialRotationMatrix_Private(PetscInt num_angles, const PetscReal angle[], PetscReal R[9])
{
  PetscReal c[3] = {1., 1., 1.}, s[3] = {0., 0., 0.};

  for (PetscInt k = 0; k < num_angles; k++) {
    c[k] = PetscCosReal(angle[k] * PETSC_PI / 180.);
    s[k] = PetscSinReal(angle[k] * PETSC_PI / 180.);
  }
  R[0] = c[0] * c[2] - s[0] * c[1] * s[2];
  R[1] = -c[0] * s[2] - s[0] * c[1] * c[2];
  R[2] = s[0] * s[1];
  R[3] = s[0] * c[2] + c[0] * c[1] * s[2];
  R[4] = -s[0] * s[2] + c[0] * c[1] * c[2];
  R[5] = -c[0] * s[1];
  R[6] = s[1] * s[2];
  R[7] = s[1] * c[2];
  R[8] = c[1];
}

/* Bond's matrix T with (R sigma R') = T sigma for the n components that a model carries [1].
   [out] T - [n][n] */
static void MaterialBondMatrix_Private(PetscInt n, const PetscReal R[9], PetscReal T[])
{
  for (PetscInt row = 0; row < n; row++) {
    for (PetscInt column = 0; column < n; column++) {
      const PetscInt *ij = VOIGT[CARRIED[n][row]], *kl = VOIGT[CARRIED[n][column]];

      T[row * n + column] = R[ij[0] * 3 + kl[0]] * R[ij[1] * 3 + kl[1]];
      if (kl[0] != kl[1]) T[row * n + column] += R[ij[0] * 3 + kl[1]] * R[ij[1] * 3 + kl[0]];
    }
  }
}

/* C = T C_material T': stresses turn with T and, since the energy stays, engineering strains with its inverse
   transpose. */
void MaterialAnisotropic(ModelKind model, const PetscReal upper[], const PetscReal angle[], PetscReal C[])
{
  const PetscInt n = MaterialNumStrains(model);
  PetscReal      R[9], T[STRAINS_3D * STRAINS_3D], material[STRAINS_3D * STRAINS_3D], CT[STRAINS_3D * STRAINS_3D];

  for (PetscInt i = 0, entry = 0; i < n; i++) {
    for (PetscInt j = i; j < n; j++) material[i * n + j] = material[j * n + i] = upper[entry++];
  }
  MaterialRotationMatrix_Private(model == MODEL_SOLID ? 3 : 1, angle, R);
  MaterialBondMatrix_Private(n, R, T);
  for (PetscInt i = 0; i < n; i++) {
    for (PetscInt j = 0; j < n; j++) {
      CT[i * n + j] = 0.;
      for (PetscInt k = 0; k < n; k++) CT[i * n + j] += material[i * n + k] * T[j * n + k];
    }
  }
  for (PetscInt i = 0; i < n; i++) {
    for (PetscInt j = i; j < n; j++) { /* exactly symmetric in spite of roundoff */
      C[i * n + j] = 0.;
      for (PetscInt k = 0; k < n; k++) C[i * n + j] += T[i * n + k] * CT[k * n + j];
      C[j * n + i] = C[i * n + j];
    }
  }
}

/* eps = R diag(axial) R', engineering shear. */
void MaterialAxialStrain(ModelKind model, const PetscReal axial[], const PetscReal angle[], PetscReal strain[6])
{
  PetscReal R[9];

  MaterialRotationMatrix_Private(model == MODEL_SOLID ? 3 : 1, angle, R);
  for (PetscInt s = 0; s < STRAINS_3D; s++) {
    const PetscInt i = VOIGT[s][0], j = VOIGT[s][1];

    strain[s] = 0.;
    for (PetscInt k = 0; k < 3; k++) strain[s] += (i == j ? 1. : 2.) * R[i * 3 + k] * axial[k] * R[j * 3 + k];
  }
}

void MaterialPickStrains(ModelKind model, const PetscReal all[6], PetscReal strain[])
{
  const PetscInt n = MaterialNumStrains(model);

  for (PetscInt i = 0; i < n; i++) strain[i] = all[CARRIED[n][i]];
}

PetscReal MaterialDefiniteness(PetscInt num_strains, const PetscReal C[])
{
  PetscReal smallest, largest;

  DenseEigenRange(num_strains, C, &smallest, &largest);
  return largest > 0. ? smallest / largest : -1.;
}

void MaterialStress(ModelKind model, const PetscReal C[], PetscReal poisson, const PetscReal strain[],
                    PetscReal stress[6])
{
  const PetscInt n = MaterialNumStrains(model);

  for (PetscInt i = 0; i < STRAINS_3D; i++) stress[i] = 0.;
  for (PetscInt i = 0; i < n; i++) {
    for (PetscInt j = 0; j < n; j++) stress[CARRIED[n][i]] += C[i * n + j] * strain[j];
  }
  if (model == MODEL_PLANE_STRAIN) stress[2] = poisson * (stress[0] + stress[1]); /* eps_zz = 0 */
}

/* mu is the last of C; lambda = -2/3 mu is written anew, since next to a large one its digits are lost. */
PetscReal MaterialTakeBulk(PetscInt num_strains, PetscReal C[])
{
  const PetscInt  num_direct = MaterialNumDirectStrains_Private(num_strains);
  const PetscReal mu = C[num_strains * num_strains - 1], bulk = C[1] + 2. / 3. * mu;

  for (PetscInt i = 0; i < num_direct; i++) {
    for (PetscInt j = 0; j < num_direct; j++) C[i * num_strains + j] = (i == j ? 4. / 3. : -2. / 3.) * mu;
  }
  return bulk;
}

PetscReal MaterialDilatation(PetscInt num_strains, const PetscReal strain[])
{
  PetscReal trace = 0.;

  for (PetscInt i = 0; i < MaterialNumDirectStrains_Private(num_strains); i++) trace += strain[i];
  return trace;
}

/* sqrt(3/2 s:s) with the deviator s, written with differences, which cancel a pressure of any size. */
PetscReal MaterialVonMises(const PetscReal stress[6])
{
  const PetscReal xy = stress[0] - stress[1], yz = stress[1] - stress[2], zx = stress[2] - stress[0];
  const PetscReal shear = stress[3] * stress[3] + stress[4] * stress[4] + stress[5] * stress[5];

  return PetscSqrtReal(0.5 * (xy * xy + yz * yz + zx * zx) + 3. * shear);
}

void MaterialPrincipal(const PetscReal stress[6], PetscReal principal[3])
{
  const PetscReal tensor[9] = {stress[0], stress[5], stress[4], stress[5], stress[1],
                               stress[3], stress[4], stress[3], stress[2]};
  PetscReal       sum       = 0.;

  for (PetscInt k = 0; k < 6; k++) sum += stress[k];
  for (PetscInt k = 0; k < 3; k++) principal[k] = NAN;
  if (!PetscIsInfOrNanReal(sum)) DenseEigenvalues(3, tensor, principal);
}

/* Indentation depends on the compliance S = C^-1, not on C: in plane strain S_xx = (1 - nu^2)/E. In space the
   material beside the contact constrains one direction across it. With eps_j = 0, eps_i = (S_ii - S_ij^2 /
   S_jj) sigma_i, the same value. */
PetscReal MaterialContactModulus(PetscInt num_strains, const PetscReal C[])
{
  const PetscInt num_direct = MaterialNumDirectStrains_Private(num_strains);
  PetscReal      L[STRAINS_3D * STRAINS_3D], S[STRAINS_3D][STRAINS_3D], compliance = 0.;

  for (PetscInt i = 0; i < num_strains * num_strains; i++) L[i] = C[i];
  if (!DenseCholesky(num_strains, L)) return 0.; /* not a material; MaterialDefiniteness() tells the user */
  for (PetscInt i = 0; i < num_direct; i++) {
    for (PetscInt j = 0; j < num_strains; j++) S[i][j] = i == j ? 1. : 0.;
    DenseCholeskySolve(num_strains, L, S[i]);
  }
  for (PetscInt i = 0; i < num_direct; i++) {
    for (PetscInt j = 0; j < num_direct; j++) {
      if (num_direct == 2) compliance = PetscMax(compliance, S[i][i]);
      if (num_direct == 3 && i != j) compliance = PetscMax(compliance, S[i][i] - S[i][j] * S[i][j] / S[j][j]);
    }
  }
  return 1. / compliance;
}

PetscReal MaterialEnergyDensity(PetscInt num_strains, const PetscReal C[], const PetscReal strain[])
{
  PetscReal density = 0;

  for (PetscInt r = 0; r < num_strains; r++)
    for (PetscInt s = 0; s < num_strains; s++) density += strain[r] * C[r * num_strains + s] * strain[s];
  return density;
}

/* compliance.c -- factors of Hooke tensors. */
#include "result/compliance.h"
#include "base/compat.h"
#include "kernel/dense.h"
#include "kernel/vector.h"
#include "problem/elasticity.h"

PetscErrorCode ComplianceCreate(Scene scene, Compliance *compliance)
{
  const PetscInt num = MaterialNumStrains(scene->model), materials = scene->num_bodies + scene->num_regions;

  PetscFunctionBeginUser;
  compliance->scene = scene;
  compliance->num   = num;
  PetscCall(PetscMalloc1((materials + 1) * num * num, &compliance->L));
  PetscCall(PetscCalloc1(materials, &compliance->known));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ComplianceDestroy(Compliance *compliance)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(compliance->L));
  PetscCall(PetscFree(compliance->known));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ComplianceGet(Compliance *compliance, PetscInt material, const PetscReal x[], const PetscReal **L)
{
  const Scene     scene    = compliance->scene;
  const PetscBool constant = ElasticityHookeIsConstant(scene, material);
  const PetscInt  place    = constant ? material : scene->num_bodies + scene->num_regions;
  PetscReal      *factor   = &compliance->L[place * compliance->num * compliance->num], poisson;

  PetscFunctionBeginUser;
  *L = factor;
  if (constant && compliance->known[material]) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ElasticityHooke(scene, material, x, factor, &poisson));
  (void)DenseCholesky(compliance->num, factor); // C was found positive definite
  if (constant) compliance->known[material] = PETSC_TRUE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* [out] s - L^-1 of the stress [num] */
static void ComplianceSolveLower_Private(const Compliance *compliance, const PetscReal L[],
                                         const PetscReal stress[CELL_STRESSES], PetscReal s[])
{
  const PetscInt num = compliance->num;

  MaterialPickStrains(compliance->scene->model, stress, s);
  for (PetscInt i = 0; i < num; i++) {
    for (PetscInt k = 0; k < i; k++) s[i] -= L[i * num + k] * s[k];
    s[i] /= L[i * num + i];
  }
}

PetscReal ComplianceProduct(const Compliance *compliance, const PetscReal L[], const PetscReal stress[CELL_STRESSES],
                            const PetscReal other[CELL_STRESSES])
{
  PetscReal s[COMPLIANCE_MAX_STRAINS], r[COMPLIANCE_MAX_STRAINS];

  ComplianceSolveLower_Private(compliance, L, stress, s);
  ComplianceSolveLower_Private(compliance, L, other, r);
  return VectorDot(compliance->num, s, r);
}

PetscReal ComplianceEnergy(const Compliance *compliance, const PetscReal L[], const PetscReal stress[CELL_STRESSES])
{
  PetscReal s[COMPLIANCE_MAX_STRAINS];

  ComplianceSolveLower_Private(compliance, L, stress, s);
  return VectorDot(compliance->num, s, s);
}

PetscReal ComplianceStrain(const Compliance *compliance, const PetscReal L[], const PetscReal stress[CELL_STRESSES])
{
  const PetscInt num = compliance->num;
  PetscReal      s[COMPLIANCE_MAX_STRAINS], largest = 0;

  ComplianceSolveLower_Private(compliance, L, stress, s);
  for (PetscInt i = num - 1; i >= 0; i--) {
    for (PetscInt k = i + 1; k < num; k++) s[i] -= L[k * num + i] * s[k];
    s[i] /= L[i * num + i];
    largest = PetscMax(largest, PetscAbsReal(s[i]));
  }
  return largest;
}

void ComplianceDyad(PetscInt dim, const PetscReal n[], PetscReal dyad[CELL_STRESSES])
{
  const PetscReal z = dim == 3 ? n[2] : 0;

  dyad[0] = n[0] * n[0];
  dyad[1] = n[1] * n[1];
  dyad[2] = z * z;
  dyad[3] = n[1] * z;
  dyad[4] = n[0] * z;
  dyad[5] = n[0] * n[1];
}

PetscErrorCode ComplianceModulus(Compliance *compliance, PetscInt material, const PetscReal x[], const PetscReal n[],
                                 PetscReal *modulus)
{
  PetscReal        nn[CELL_STRESSES];
  const PetscReal *L;

  PetscFunctionBeginUser;
  PetscCall(ComplianceGet(compliance, material, x, &L));
  ComplianceDyad(compliance->scene->dim, n, nn);
  *modulus = 1 / ComplianceEnergy(compliance, L, nn);
  PetscFunctionReturn(PETSC_SUCCESS);
}

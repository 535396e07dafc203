/* unseencubic.c -- third derivatives of displacements along the axes of a cell.

   Functions of order 2 in each coordinate xi of the cell hold all cubic displacements but xi^3. On equal
   cells the discrete solution nearly meets the exact one at their nodes. What it lacks in the slope along xi
   is (3 t^2 - 1)/24 of the third derivative, t = 2 xi - 1. Strains tell third derivatives of displacements:
   u_i,jkl is eps_ij,kl + eps_ik,jl - eps_jk,il. */
#include "result/unseencubic.h"
#include "base/compat.h"
#include "kernel/dense.h"
#include "problem/elasticity.h"

enum { DIM = CELL_MAX_DIM, STRAINS = COMPLIANCE_MAX_STRAINS };

static const PetscReal LEFT = 1. / 720; /* mean square of (3 t^2 - 1)/24 */

/* Where a component stands among xx,yy,zz,yz,xz,xy, and its part of engineering shear. */
static const PetscInt  PLACE[DIM][DIM] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};
static const PetscReal SHARE[DIM][DIM] = {{1, .5, .5}, {.5, 1, .5}, {.5, .5, 1}};

/* Second derivatives of strains. [in] L - of ComplianceGet() */
static void UnseenCubicSetStrains_Private(const UnseenCubic *cubic, ModelKind model, const PetscReal L[],
                                          PetscReal second[DIM][DIM][STRAINS])
{
  const PetscInt  num          = MaterialNumStrains(model);
  const PetscReal all[STRAINS] = {0, 1, 2, 3, 4, 5};
  PetscReal       place[STRAINS], strain[STRAINS];

  MaterialPickStrains(model, all, place);
  for (PetscInt k = 0; k < cubic->dim; k++)
    for (PetscInt l = 0; l < cubic->dim; l++) {
      MaterialPickStrains(model, cubic->second[k][l], strain);
      DenseCholeskySolve(num, L, strain);
      for (PetscInt s = 0; s < num; s++) second[k][l][(PetscInt)place[s]] = strain[s];
    }
}

/* The third derivative of the displacement along an edge. [in] second - of strains; [out] third - [dim] */
static void UnseenCubicGetThird_Private(PetscInt dim, const PetscReal axis[], PetscReal second[DIM][DIM][STRAINS],
                                        PetscReal third[])
{
  for (PetscInt i = 0; i < dim; i++) {
    third[i] = 0;
    for (PetscInt j = 0; j < dim; j++)
      for (PetscInt k = 0; k < dim; k++)
        for (PetscInt l = 0; l < dim; l++)
          third[i] += axis[j] * axis[k] * axis[l] *
                      (2 * SHARE[i][j] * second[k][l][PLACE[i][j]] -
                       SHARE[j][k] * (second[i][l][PLACE[j][k]] + second[l][i][PLACE[j][k]]) / 2);
  }
}

PetscErrorCode UnseenCubicEnergy(const UnseenCubic *cubic, PetscBool shear, Compliance *compliance, PetscReal *mean)
{
  const Scene      scene                     = compliance->scene;
  const PetscInt   dim                       = cubic->dim;
  PetscReal        second[DIM][DIM][STRAINS] = {{{0}}}, third[DIM], all[STRAINS] = {0}, strain[STRAINS], poisson;
  PetscReal        C[STRAINS * STRAINS];
  const PetscReal *L;

  PetscFunctionBeginUser;
  *mean = 0;
  PetscCall(ComplianceGet(compliance, cubic->material, cubic->middle, &L));
  UnseenCubicSetStrains_Private(cubic, scene->model, L, second);
  PetscCall(ElasticityHooke(scene, cubic->material, cubic->middle, C, &poisson));
  if (shear) (void)MaterialTakeBulk(compliance->num, C);
  for (PetscInt j = 0; j < dim; j++) {
    UnseenCubicGetThird_Private(dim, cubic->axis[j], second, third);
    for (PetscInt k = 0; k < dim; k++)
      for (PetscInt l = k; l < dim; l++)
        all[PLACE[k][l]] = k == l ? third[k] * cubic->gradient[j][k]
                                  : third[k] * cubic->gradient[j][l] + third[l] * cubic->gradient[j][k];
    MaterialPickStrains(scene->model, all, strain);
    *mean += LEFT * MaterialEnergyDensity(compliance->num, C, strain);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

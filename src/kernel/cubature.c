/* cubature.c -- product rules over reference cells, as the unit cube: simplices with collapsed coordinates (nested.c). */
#include "base/compat.h"
#include "kernel/nested.h"
#include "kernel/referencecell.h"

const PetscReal CUBATURE_POINT[CUBATURE_POINTS] = {
    0.,  0.069431844202973712388, 0.17267316464601142810, 0.33000947820757186760,
    0.5, 0.66999052179242813240,  0.82732683535398857190, 0.93056815579702628761,
    1.};
const PetscReal CUBATURE_WEIGHT[CUBATURE_POINTS] = {
    0.05,       0.17392742256872692869, 49. / 180., 0.32607257743127307131, 16. / 45., 0.32607257743127307131,
    49. / 180., 0.17392742256872692869, 0.05};

PetscErrorCode CubatureEvaluate(Cubature *cubature, const PetscReal u[], PetscReal value[])
{
  const Reference *cell = &REFERENCE[cubature->type];
  PetscReal        xi[3], jacobian = 1., left = 1.;

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < cell->dim; k++) {
    xi[k] = u[k] * left;
    if (!cell->simplex) continue;
    jacobian *= left;
    left *= 1. - u[k];
  }
  PetscCall(cubature->integrand(cubature->ctx, xi, value));
  for (PetscInt i = 0; i < cubature->size; i++) value[i] *= jacobian;
  cubature->count++;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A product of equal rules on [0,1]. [in] s, w - [num] */
static PetscErrorCode Product_Private(Cubature *cubature, PetscInt num, const PetscReal s[], const PetscReal w[],
                                      PetscReal value[])
{
  const PetscInt dim = REFERENCE[cubature->type].dim, size = cubature->size;
  PetscReal      v[CUBATURE_MAX_SIZE];
  PetscInt       total = 1;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(value, size));
  for (PetscInt k = 0; k < dim; k++) total *= num;
  for (PetscInt q = 0; q < total; q++) {
    PetscReal u[3], weight = 1.;

    for (PetscInt k = 0, digits = q; k < dim; k++, digits /= num) {
      u[k] = s[digits % num];
      weight *= w[digits % num];
    }
    PetscCall(CubatureEvaluate(cubature, u, v));
    for (PetscInt i = 0; i < size; i++) value[i] += weight * v[i];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CubatureGauss(Cubature *cubature, PetscInt num, PetscReal value[])
{
  PetscReal s[CUBATURE_MAX_GAUSS], w[CUBATURE_MAX_GAUSS];

  PetscFunctionBeginUser;
  GaussLine(num, s, w);
  PetscCall(Product_Private(cubature, num, s, w, value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CubatureLobatto(Cubature *cubature, PetscReal value[])
{
  const PetscInt  pieces = cubature->pieces;
  const PetscReal inset = cubature->inset, length = (1. - 2. * inset) / pieces;
  PetscReal s[(CUBATURE_LOBATTO - 1) * CUBATURE_MAX_PIECES + 1], w[(CUBATURE_LOBATTO - 1) * CUBATURE_MAX_PIECES + 1];
  PetscInt  num = 1;

  PetscFunctionBeginUser;
  w[0] = 0.;
  for (PetscInt i = 0; i < pieces; i++) { /* neighbours share a point */
    s[num - 1] = inset + length * i;
    w[num - 1] += CUBATURE_WEIGHT[0] / pieces;
    for (PetscInt j = 1; j < CUBATURE_LOBATTO; j++, num++) {
      s[num] = inset + length * (i + CUBATURE_POINT[2 * j]);
      w[num] = CUBATURE_WEIGHT[2 * j] / pieces;
    }
  }
  PetscCall(Product_Private(cubature, num, s, w, value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* exact.c -- gradients of formulas by differences of fourth order along the axes of a cell,

       df/dxi = (8 (f(xi+s) - f(xi-s)) - (f(xi+2s) - f(xi-2s))) / (12 s) + O(s^4),

   turned into gradients in space by the cell's own map. Going along the axes of the reference cell keeps all points inside
   the cell, where the formula is sure to hold, and makes steps as long and as short as the cell, be it a needle.

   The step balances the two errors of a difference. What is left of f^(5) is s^4 / 30 times its size in the cell; rounding
   costs 1.5 eps / s times the value, which weighs as much as the value weighs against its change over a cell. With
   s = 2e-4 the first is 5e-17 where f changes over a length of one cell, and stays below 1e-9 at a tenth of a hundredth of
   a cell from a point where f behaves like r^(1/2); the second is 2e-12 times the number of cells over which f changes.
   Quadrature points of element.h lie 1e-3 of a cell and more from its facets, further than two steps. */
#include "exact.h"
#include <mortise/compat.h>

static const PetscReal STEP = 2e-4;

/* u at a point of the reference cell. */
static PetscErrorCode Value_Private(Expression exact, ElementType type, const PetscReal X[], const PetscReal xi[],
                                    PetscReal u[])
{
  const PetscInt dim = ElementDim(type), n    = ElementNumNodes(type);
  PetscReal      phi[ELEMENT_MAX_NODES], x[3] = {0, 0, 0};

  PetscFunctionBeginUser;
  ElementShape(type, xi, phi, NULL);
  for (PetscInt i = 0; i < n; ++i)
    for (PetscInt k = 0; k < dim; ++k) x[k] += phi[i] * X[i * dim + k];
  PetscCall(ExpressionEvaluate(exact, dim, x, u));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* d[i] = d u_i / d xi_k */
static PetscErrorCode Derivative_Private(Expression exact, ElementType type, const PetscReal X[], const PetscReal xi[],
                                         PetscInt k, PetscReal d[])
{
  static const PetscReal offset[] = {-2, -1, 1, 2}, weight[] = {1, -8, 8, -1};
  const PetscInt         dim = ElementDim(type);
  PetscReal              at[3], u[3];

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(d, dim));
  for (size_t j = 0; j < PETSC_STATIC_ARRAY_LENGTH(offset); ++j) {
    PetscCall(PetscArraycpy(at, xi, dim));
    at[k] += offset[j] * STEP;
    PetscCall(Value_Private(exact, type, X, at, u));
    for (PetscInt i = 0; i < dim; ++i) d[i] += weight[j] * u[i] / (12 * STEP);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ExactEvaluate(Expression exact, ElementType type, const PetscReal X[], const PetscReal xi[],
                             const PetscReal grad[], PetscReal u[], PetscReal g[])
{
  const PetscInt dim = ElementDim(type), n = ElementNumNodes(type);
  PetscReal      d[3];

  PetscFunctionBeginUser;
  PetscCall(Value_Private(exact, type, X, xi, u));
  PetscCall(PetscArrayzero(g, dim * dim));
  if (ExpressionIsConstant(exact)) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt j = 0; j < dim; ++j) {
    PetscReal slope[3] = {0, 0, 0}; // d xi_j / d x_k: shape functions give back what is linear, xi_j itself among it

    for (PetscInt a = 0; a < n; ++a)
      for (PetscInt k = 0; k < dim; ++k) slope[k] += ElementNode(type, a)[j] * grad[a * dim + k];
    PetscCall(Derivative_Private(exact, type, X, xi, j, d));
    for (PetscInt i = 0; i < dim; ++i)
      for (PetscInt k = 0; k < dim; ++k) g[k * dim + i] += d[i] * slope[k];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

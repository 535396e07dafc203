/* exact.c -- gradients of formulas by differences of fourth order along the axes of a cell,

       df/dxi = (8 (f(xi+s) - f(xi-s)) - (f(xi+2s) - f(xi-2s))) / (12 s) + O(s^4),

   turned into gradients in space by the cell's own map. Steps along the axes of the reference cell keep all
   points inside the cell, where the formula is valid. They are as long and as short as the cell.

   The step balances the two errors of a difference. The error of truncation is s^4 / 30 times f^(5) in the
   cell. With s = 5e-4 this is 2e-15 if f changes over the length of one cell. It is below 1e-9 at a twentieth
   of a cell from a point where f behaves like r^(1/2). The error of rounding is 1.5 eps / s of the value.
   Relative to the change of f over a cell it is 1e-12 times the number of cells over which f changes. */
#include "result/exact.h"
#include "base/compat.h"

/* Relative to the size of the part that contains the point. Quadrature points of degree 8 and less lie 2e-3
   and more from the boundary, on triangles as on boxes: further than two steps. */
static const PetscReal STEP = 5e-4;

/* On tetrahedra they come nearer: steps are kept to this part of the way that is left. */
static const PetscReal SHARE_OF_WAY = 1. / 3;

/* The distances from a point to the boundary of the reference cell, in both directions of axis j. */
static PetscReal ExactGetPath_Private(const CellPoint *at, PetscInt j)
{
  const PetscInt dim   = ElementDim(at->type);
  PetscReal      ahead = 1;

  if (ElementNumNodes(ElementLinear(at->type)) > dim + 1)
    ahead -= at->xi[j];
  else
    for (PetscInt k = 0; k < dim; k++) ahead -= at->xi[k];
  return PetscMin(ahead, at->xi[j]);
}

/* u at another point of the cell, xi. */
static PetscErrorCode ExactGetValue_Private(Expression exact, const CellPoint *at, const PetscReal xi[], PetscReal u[])
{
  const PetscInt dim = ElementDim(at->type), n = ElementNumNodes(at->type);
  PetscReal      phi[ELEMENT_MAX_NODES], x[3]  = {0, 0, 0};

  PetscFunctionBeginUser;
  ElementShape(at->type, xi, phi, NULL);
  for (PetscInt a = 0; a < n; a++)
    for (PetscInt k = 0; k < dim; k++) x[k] += phi[a] * at->X[a * dim + k];
  PetscCall(ExpressionEvaluate(exact, dim, x, u));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* d[i] = d u_i / d xi_j */
static PetscErrorCode ExactGetDerivative_Private(Expression exact, const CellPoint *at, PetscInt j, PetscReal d[])
{
  static const PetscReal offset[] = {-2, -1, 1, 2}, weight[] = {1, -8, 8, -1};
  const PetscInt         dim  = ElementDim(at->type);
  const PetscReal        step = PetscMin(STEP * at->size, SHARE_OF_WAY * ExactGetPath_Private(at, j));
  PetscReal              xi[3], u[3];

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(d, dim));
  PetscCall(PetscArraycpy(xi, at->xi, dim));
  for (size_t s = 0; s < PETSC_STATIC_ARRAY_LENGTH(offset); s++) {
    xi[j] = at->xi[j] + offset[s] * step;
    PetscCall(ExactGetValue_Private(exact, at, xi, u));
    for (PetscInt i = 0; i < dim; i++) d[i] += weight[s] * u[i] / (12 * step);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ExactEvaluate(Expression exact, const CellPoint *at, PetscReal u[], PetscReal g[])
{
  const PetscInt dim = ElementDim(at->type), n = ElementNumNodes(at->type);
  PetscReal      d[3];

  PetscFunctionBeginUser;
  PetscCall(ExactGetValue_Private(exact, at, at->xi, u));
  PetscCall(PetscArrayzero(g, dim * dim));
  if (ExpressionIsConstant(exact)) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt j = 0; j < dim; j++) {
    PetscReal slope[3] = {0, 0, 0}; // d xi_j / d x_k: shape functions give back what is linear, xi_j itself among it

    for (PetscInt a = 0; a < n; a++)
      for (PetscInt k = 0; k < dim; k++) slope[k] += ElementNode(at->type, a)[j] * at->grad[a * dim + k];
    PetscCall(ExactGetDerivative_Private(exact, at, j, d));
    for (PetscInt i = 0; i < dim; i++)
      for (PetscInt k = 0; k < dim; k++) g[k * dim + i] += d[i] * slope[k];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

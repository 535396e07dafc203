/* cellforce.c -- a force per volume on the nodes of one cell.

   A formula may have a kink or a jump inside a cell, where any rule loses its order: an error of the load that falls no faster
   than h^2 hides behind the discretisation in the energy norm, but not in L2. Two rules tell: where they differ by more than
   they would for a smooth load, the cell is cut, as often as they do. The cells along a kink are few. Cells in space are not cut:
   there a kink costs the load its order. */
#include <mortise/compat.h>
#include "cellforce.h"

enum { MAX_CELL_DOFS = 3 * ELEMENT_MAX_NODES, MAX_DEPTH = 5, LOWER = 2 };

/* Two rules that differ by less than this part of the load on the cell are both right. On a smooth load with twenty cells to a
   wave they do. A kink leaves an eighth of its error with every cut: a few of them make it as small. */
static const PetscReal SAME = 1e-6;

/* A cell and what is known of it. */
typedef struct {
  Scene            scene;
  Expression       force;
  ElementType      type;
  PetscInt         dim, degree;
  const PetscReal *X;    /* [num_nodes][dim] */
  PetscReal        size; /* of the load on the whole cell: sum_i |int phi_i b| */
} Cell;

/* fe = the integrals over a piece, by one rule. */
static PetscErrorCode Integrate_Private(const Cell *cell, const ElementPiece *piece, PetscInt degree, PetscReal fe[])
{
  const PetscInt dim = cell->dim, n = ElementNumNodes(cell->type);
  PetscReal      points[3 * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS], phi[ELEMENT_MAX_NODES], xi[3], x[3], b[3];
  const PetscInt num = ElementQuadrature(cell->type, degree, points, w);

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(fe, n * dim));
  for (PetscInt q = 0; q < num; q++) {
    PetscReal dx;

    ElementPiecePoint(cell->type, piece, &points[q * dim], xi);
    dx = piece->measure * w[q] * ElementMap(cell->type, cell->X, xi, x, phi, NULL);
    dx *= SceneMeasure(cell->scene, x);
    PetscCall(ExpressionEvaluate(cell->force, dim, x, b));
    for (PetscInt i = 0; i < n; i++) {
      for (PetscInt k = 0; k < dim; k++) fe[i * dim + k] += dx * phi[i] * b[k];
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Largest difference of two loads. */
static PetscReal Difference_Private(PetscInt n, const PetscReal a[], const PetscReal b[])
{
  PetscReal largest = 0;

  for (PetscInt i = 0; i < n; i++) largest = PetscMax(largest, PetscAbsReal(a[i] - b[i]));
  return largest;
}

/* fe += the integrals over a piece, or over its parts where two rules differ. */
static PetscErrorCode AddPiece_Private(const Cell *cell, const ElementPiece *piece, PetscInt depth, PetscReal fe[])
{
  const PetscInt n = cell->dim * ElementNumNodes(cell->type);
  PetscReal      fine[MAX_CELL_DOFS], coarse[MAX_CELL_DOFS];
  ElementPiece   parts[ELEMENT_MAX_PIECES];

  PetscFunctionBeginUser;
  PetscCall(Integrate_Private(cell, piece, cell->degree, fine));
  PetscCall(Integrate_Private(cell, piece, cell->degree - LOWER, coarse));
  if (depth == MAX_DEPTH || !(Difference_Private(n, fine, coarse) > SAME * cell->size)) {
    for (PetscInt i = 0; i < n; i++) fe[i] += fine[i];
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  for (PetscInt i = 0, num = ElementPieceCut(cell->type, piece, parts); i < num; i++)
    PetscCall(AddPiece_Private(cell, &parts[i], depth + 1, fe));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CellForceIntegrate(Scene scene, const Level *level, PetscInt c, PetscInt degree, PetscReal fe[])
{
  const ElementType  type = (ElementType)level->cell_type[c];
  const PetscInt     dim = level->dim, nn = ElementNumNodes(type);
  const PetscInt    *nodes = &level->cell_nodes[level->cell_start[c]];
  const ElementPiece whole = ElementPieceWhole();
  PetscReal          X[MAX_CELL_DOFS];
  Cell               cell = {.scene  = scene,
                             .force  = scene->bodies[level->cell_body[c]].body_force,
                             .type   = type,
                             .dim    = dim,
                             .degree = degree,
                             .X      = X};

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < nn; i++) PetscCall(PetscArraycpy(&X[i * dim], &level->coords[nodes[i] * dim], dim));
  PetscCall(Integrate_Private(&cell, &whole, degree, fe));
  if (ExpressionIsConstant(cell.force) || dim > 2) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt i = 0; i < nn * dim; i++) cell.size += PetscAbsReal(fe[i]);
  PetscCall(PetscArrayzero(fe, nn * dim));
  PetscCall(AddPiece_Private(&cell, &whole, 0, fe));
  PetscFunctionReturn(PETSC_SUCCESS);
}

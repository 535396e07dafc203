/* congruentcells.c -- matrices of cells that are translations of each other.

   Boxes consist of them: refined cells begin at each corner of the coarse ones, so that as many cells differ
   as a cell has corners. */
#include "problem/congruentcells.h"
#include "base/compat.h"

enum {
  MAX_SHAPES  = 16,  /* that are kept: some boxes */
  TRIED_CELLS = 256, /* of a material, before it is given up */
  MAX_X       = 3 * ELEMENT_MAX_NODES
};

/* Positions that differ by less than this part of the largest coordinate are the same up to rounding. */
static const PetscReal SAME_POSITION = 4 * PETSC_MACHINE_EPSILON;

/* A cell with its matrix. */
typedef struct {
  ElementType type;
  PetscInt    material;
  PetscReal   X[MAX_X]; /* from the first node [num_nodes][dim] */
  PetscReal   Ke[MAX_X * MAX_X];
} CellShape;

struct _n_CongruentCells {
  PetscInt  dim, num, next; /* shapes; the one that is compared first, or replaced */
  PetscInt  material, tried, found;
  CellShape shape[MAX_SHAPES];
};

PetscErrorCode CongruentCellsCreate(PetscInt dim, CongruentCells *cells)
{
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(1, cells)); // untouched pages take no memory
  (*cells)->dim = dim;
  (*cells)->num = (*cells)->next = (*cells)->tried = (*cells)->found = 0;
  (*cells)->material                                                 = -1;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CongruentCellsDestroy(CongruentCells *cells)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(*cells));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a cell has this shape. [in] tolerance - of positions */
static PetscBool CellShapeMatches_Private(const CellShape *shape, PetscInt dim, ElementType type, PetscInt material,
                                          const PetscReal X[], PetscReal tolerance)
{
  if (shape->type != type || shape->material != material) return PETSC_FALSE;
  for (PetscInt i = 1; i < ElementNumNodes(type); i++) {
    for (PetscInt k = 0; k < dim; k++)
      if (!(PetscAbsReal(X[i * dim + k] - X[k] - shape->X[i * dim + k]) <= tolerance)) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

/* Shapes follow each other in the same order again and again. Materials whose cells differ are given up. */
const PetscReal *CongruentCellsFind(CongruentCells cells, ElementType type, PetscInt material, const PetscReal X[])
{
  PetscReal largest = 0;

  if (cells->material != material) cells->tried = cells->found = 0;
  cells->material = material;
  if (cells->tried >= TRIED_CELLS && 2 * cells->found < cells->tried) return NULL;
  cells->tried++;
  for (PetscInt i = 0; i < cells->dim * ElementNumNodes(type); i++) largest = PetscMax(largest, PetscAbsReal(X[i]));
  for (PetscInt i = 0; i < cells->num; i++) {
    const PetscInt at = (cells->next + i) % cells->num;

    if (!CellShapeMatches_Private(&cells->shape[at], cells->dim, type, material, X, SAME_POSITION * largest)) continue;
    cells->next = (at + 1) % cells->num;
    cells->found++;
    return cells->shape[at].Ke;
  }
  return NULL;
}

void CongruentCellsAdd(CongruentCells cells, ElementType type, PetscInt material, const PetscReal X[],
                       const PetscReal Ke[])
{
  const PetscInt n     = cells->dim * ElementNumNodes(type);
  CellShape     *shape = &cells->shape[cells->num < MAX_SHAPES ? cells->num++ : cells->next];

  shape->type     = type;
  shape->material = material;
  for (PetscInt i = 0; i < n; i++) shape->X[i] = X[i] - X[i % cells->dim];
  for (PetscInt i = 0; i < n * n; i++) shape->Ke[i] = Ke[i];
  cells->next = (PetscInt)(shape - cells->shape + 1) % cells->num;
}

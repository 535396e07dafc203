/* edgetable.c -- see the header. */
#include "kernel/edgetable.h"
#include "base/compat.h"

enum { FIRST_ROOM = 1024 };

/* The place of an edge, or the one where it belongs. */
static PetscInt *EdgeTablePlace_Private(const EdgeTable *table, PetscInt a, PetscInt b)
{
  const PetscInt low = PetscMin(a, b), high = PetscMax(a, b);
  size_t         k = (size_t)low * 0x9E3779B97F4A7C15U ^ (size_t)high * 0xC2B2AE3D27D4EB4FU;

  for (k ^= k >> 29;; k++) {
    PetscInt *edge = table->edge[k & (size_t)(table->room - 1)];

    if (edge[0] < 0 || (edge[0] == low && edge[1] == high)) return edge;
  }
}

static PetscErrorCode EdgeTableGrow_Private(EdgeTable *table)
{
  EdgeTable old = *table;

  PetscFunctionBeginUser;
  table->room = PetscMax(FIRST_ROOM, 2 * old.room);
  PetscCall(PetscMalloc1(table->room, &table->edge));
  for (PetscInt k = 0; k < table->room; k++) table->edge[k][0] = -1;
  for (PetscInt k = 0; k < old.room; k++) {
    if (old.edge[k][0] >= 0)
      PetscCall(PetscArraycpy(EdgeTablePlace_Private(table, old.edge[k][0], old.edge[k][1]), old.edge[k], 3));
  }
  PetscCall(PetscFree(old.edge));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscInt EdgeTableFind(const EdgeTable *table, PetscInt a, PetscInt b)
{
  const PetscInt *edge = table->room ? EdgeTablePlace_Private(table, a, b) : NULL;

  return edge && edge[0] >= 0 ? edge[2] : -1;
}

PetscErrorCode EdgeTableAdd(EdgeTable *table, PetscInt a, PetscInt b, PetscInt number)
{
  PetscInt *edge;

  PetscFunctionBeginUser;
  if (2 * (table->num + 1) > table->room) PetscCall(EdgeTableGrow_Private(table));
  edge = EdgeTablePlace_Private(table, a, b);
  if (edge[0] >= 0) PetscFunctionReturn(PETSC_SUCCESS);
  edge[0] = PetscMin(a, b);
  edge[1] = PetscMax(a, b);
  edge[2] = number;
  table->num++;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EdgeTableDestroy(EdgeTable *table)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(table->edge));
  *table = (EdgeTable){.room = 0};
  PetscFunctionReturn(PETSC_SUCCESS);
}

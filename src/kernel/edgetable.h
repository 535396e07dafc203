/* edgetable.h -- numbers of edges, found by their ends. */
#ifndef MORTISE_EDGETABLE_H
#define MORTISE_EDGETABLE_H

#include <petscsys.h>

/* Open addressing with linear steps. Begins as zeros; freed by EdgeTableDestroy(). */
typedef struct {
  PetscInt room, num;  /* room is a power of 2 */
  PetscInt (*edge)[3]; /* lower end or -1, upper end, number [room] */
} EdgeTable;

/* The number of an edge, -1 where it has none. Not collective. */
PetscInt EdgeTableFind(const EdgeTable *table, PetscInt a, PetscInt b);
/* Gives an edge a number, unless it has one. */
PetscErrorCode EdgeTableAdd(EdgeTable *table, PetscInt a, PetscInt b, PetscInt number);
PetscErrorCode EdgeTableDestroy(EdgeTable *table);

#endif

/* ghostexchange.h -- values of rows that other ranks own and a matrix refers to. */
#ifndef MORTISE_GHOSTEXCHANGE_H
#define MORTISE_GHOSTEXCHANGE_H

#include <petscmat.h>

/* Rows may be blocks, nodes or unknowns: those of this rank first, then ghosts. */
typedef struct {
  PetscInt   begin, n;    /* of this rank: first row, number of rows */
  PetscInt   num;         /* ghosts: rows of other ranks in the columns */
  PetscInt  *ghost;       /* ascending [num] */
  Vec        own, theirs; /* one value per row */
  VecScatter scatter;
} GhostExchange;

/* Collective. [in] bs - rows of A per row here; columns of other ranks need not come in whole blocks */
PetscErrorCode GhostExchangeCreate(Mat A, PetscInt bs, GhostExchange *ghosts);
/* The ghosts of two exchanges of the same rows, each row split in bs. Collective. */
PetscErrorCode GhostExchangeCreateUnion(const GhostExchange *one, const GhostExchange *other, PetscInt bs,
                                        GhostExchange *ghosts);
PetscErrorCode GhostExchangeDestroy(GhostExchange *ghosts);
/* Copies the owners' values to the ghosts. Collective. [in,out] values - [n + num] */
PetscErrorCode GhostExchangeUpdate(GhostExchange *ghosts, PetscReal values[]);
/* Position of a row among values. Not collective. [in] row - of this rank, or a ghost */
PetscErrorCode GhostExchangeFind(const GhostExchange *ghosts, PetscInt row, PetscInt *at);

#endif

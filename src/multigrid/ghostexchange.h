/* ghostexchange.h -- rows of other ranks that a matrix leads to, and values that belong to them. */
#ifndef MORTISE_GHOSTEXCHANGE_H
#define MORTISE_GHOSTEXCHANGE_H

#include <petscmat.h>

/* Rows are those of blocks, nodes or unknowns: this rank's first, then those of others. */
typedef struct {
  PetscInt   begin, n;    /* of this rank: the first, and how many */
  PetscInt   num;         /* of others that its columns lead to */
  PetscInt  *ghost;       /* ascending [num] */
  Vec        own, theirs; /* one value for each */
  VecScatter scatter;
} GhostExchange;

/* Collective. [in] bs - rows of A to a row here: columns of other ranks come in whole blocks or parts of them */
PetscErrorCode GhostExchangeCreate(Mat A, PetscInt bs, GhostExchange *ghosts);
PetscErrorCode GhostExchangeDestroy(GhostExchange *ghosts);
/* Tells ghosts their owners' values. Collective. [in,out] values - [n + num] */
PetscErrorCode GhostExchangeUpdate(GhostExchange *ghosts, PetscReal values[]);
/* Position of a row among values. Not collective. [in] row - of this rank, or a ghost */
PetscErrorCode GhostExchangeFind(const GhostExchange *ghosts, PetscInt row, PetscInt *at);

#endif

/* rankrows.h -- rows of a matrix that a rank owns, and those of its ghosts; internal. */
#ifndef MORTISE_RANKROWS_H
#define MORTISE_RANKROWS_H

#include "multigrid/ghostexchange.h"

typedef struct {
  Mat                  A;      /* referenced; NULL for a matrix without entries */
  PetscInt             bs;     /* rows of A per row of ghosts */
  const GhostExchange *ghosts; /* borrowed */
  Mat                  theirs; /* rows of ghosts, columns of own rows and ghosts; NULL on one rank */
  PetscInt            *at;     /* positions of the columns of theirs among own ones and ghosts */
  PetscInt             max;    /* room in column and value */
  PetscInt            *column;
  PetscScalar         *value;
} RankRows;

/* Collective.
   [in] A - AIJ, or NULL; [in] ghosts - of its rows in blocks of bs; [out] rows - to be destroyed by the
   caller */
PetscErrorCode RankRowsCreate(Mat A, PetscInt bs, const GhostExchange *ghosts, RankRows *rows);
PetscErrorCode RankRowsDestroy(RankRows *rows);
/* A row: all rows, and all columns, are counted from this rank's first; then come ghosts. Other columns are
   omitted. Not collective.
   [out] column, value - borrowed until the next call [num] */
PetscErrorCode RankRowsGet(RankRows *rows, PetscInt row, PetscInt *num, const PetscInt **column,
                           const PetscScalar **value);

#endif

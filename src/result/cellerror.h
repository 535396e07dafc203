/* cellerror.h -- squared norms of an error and of the exact field. */
#ifndef MORTISE_CELLERROR_H
#define MORTISE_CELLERROR_H

#include "result/errors.h"

/* Of one body, or of all. */
typedef struct {
  PetscReal error_l2, error_energy, size_l2, size_energy;
} ErrorSquares;

/* Integrates u - v and v over the cells of every body. With v = NULL the exact displacements take its place,
   and bodies without one get zeros. User error: an exact displacement that is not finite. Collective.
   [in] u, v - ghosted; [out] squares - [num_bodies], the same on all ranks */
PetscErrorCode CellErrorsIntegrate(Scene scene, Level *level, Vec u, Vec v, ErrorSquares squares[]);

#endif

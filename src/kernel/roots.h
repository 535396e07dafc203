/* roots.h -- real roots of a polynomial between 0 and 1. */
#ifndef MORTISE_ROOTS_H
#define MORTISE_ROOTS_H

#include <petscsys.h>

enum { ROOTS_MAX_DEGREE = 8 };

/* Places strictly between 0 and 1 where c_0 + c_1 t + ... + c_degree t^degree changes its sign, ascending, to
   the last digits that the coefficients allow. Any coefficient may be zero. Returns their number. degree <=
   ROOTS_MAX_DEGREE.
   [in] c - [degree + 1]; [out] roots - [degree] */
PetscInt RootsInside(PetscInt degree, const PetscReal c[], PetscReal roots[]);

#endif

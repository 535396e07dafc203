/* basischange.h -- the change of basis u = T y and what is known of y beforehand (eq. 6.1). */
#ifndef MORTISE_BASISCHANGE_H
#define MORTISE_BASISCHANGE_H

#include "problem/basisfactor.h"
#include "problem/couplings.h"
#include "problem/nodebases.h"

enum { BASIS_FACTORS = 2 };
/* T = (1 + E_0)(1 + E_1) = S R (1 + C). E_0 couples the unknowns of a node, and middle nodes with the ends of
   their edges. C couples to other sides, and has rows of constrained unknowns alone. */
typedef struct {
  Mat         T; /* NULL where it is 1, without factors */
  BasisFactor factor[BASIS_FACTORS];
} BasisChange;

/* Kept with a VI. */
struct _n_VIBasis {
  NodeBases              bases;
  Couplings              couplings;
  BasisChange            change; /* the VI borrows T */
  struct _n_BasisGhosts *ghosts; /* its products, with the ghosts of K; NULL without T */
};

/* T = S (I + E + E E + ..) R with u~ = R y + E u~ (eq. 6.1): R rotates, E adds the displacement of the mortar
   side. The number of powers is the longest sequence of pairs that depend on each other, without cycles
   (cyclicroles.h). Collective.
   [out] change - to be released by BasisChangeDestroy() */
PetscErrorCode BasisChangeCreate(VI vi, const NodeBases *bases, const Couplings *couplings, BasisChange *change);
/* Collective. */
PetscErrorCode BasisChangeDestroy(BasisChange *change);

/* Global unknowns y_i that fixed directions and ties fix, with their values in the user's unit. Collective.
   [out] dofs, values - [*num], owned by the caller */
PetscErrorCode BasisChangeGetFixed(VI vi, const NodeBases *bases, const Couplings *couplings, PetscInt *num,
                                   PetscInt **dofs, PetscReal **values);

#endif

/* basisghosts.h -- products with T and T', factor by factor, with one exchange between ranks each.

   A rank has the rows of all factors that its part of a product K (T x) depends on, also those that others
   own. */
#ifndef MORTISE_BASISGHOSTS_H
#define MORTISE_BASISGHOSTS_H

#include "problem/basischange.h"

typedef struct _n_BasisGhosts *BasisGhosts;

/* Collective. [in] K - a stiffness, or AIJ; its ghosts are those of products; [in] factors - of T
   [BASIS_FACTORS]; [out] ghosts - owned by the caller */
PetscErrorCode BasisGhostsCreate(Mat K, const BasisFactor factors[], BasisGhosts *ghosts);
/* Another owner. Not collective. */
void BasisGhostsReference(BasisGhosts ghosts);
/* NULL is accepted. Collective. */
PetscErrorCode BasisGhostsDestroy(BasisGhosts *ghosts);

/* T x, in the place of x until BasisGhostsRestore(). Collective.
   [in,out] x - may be locked for reading, as the argument of a product is;
   [out] own, others - of unknowns of this rank, and of the ghosts of K; borrowed as long */
PetscErrorCode BasisGhostsMult(BasisGhosts ghosts, Vec x, const PetscScalar **own, const PetscScalar **others);
/* x again, bit by bit. Not collective. [in] own - of BasisGhostsMult(); NULL afterwards */
PetscErrorCode BasisGhostsRestore(BasisGhosts ghosts, Vec x, const PetscScalar **own);
/* y <- T'y. Collective. [in,out] y */
PetscErrorCode BasisGhostsMultTranspose(BasisGhosts ghosts, Vec y);
/* Adds to a region all that T moves by it. Collective. [in,out] region - not 0 at unknowns in it */
PetscErrorCode BasisGhostsReach(BasisGhosts ghosts, Vec region);

#endif

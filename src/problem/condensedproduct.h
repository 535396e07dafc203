/* condensedproduct.h -- products with T'KT, one factor of T after the other.

   T'KT has many entries beside contact: a node of the nonmortar side couples all that it depends on. Its
   factors have few. */
#ifndef MORTISE_CONDENSEDPRODUCT_H
#define MORTISE_CONDENSEDPRODUCT_H

#include "problem/vi.h"

/* P = T'S T of a symmetric S. Collective.
   [in] S - referenced; vi - with T, whose factors are referenced;
   [out] P - a shell that knows MatMult(), owned by the caller; S itself where T = 1 */
PetscErrorCode CondensedProductCreate(Mat S, VI vi, Mat *P);
/* As StiffnessRestrict(), of P. Collective. */
PetscErrorCode CondensedProductRestrict(Mat P, Vec region, PetscReal *part);

#endif

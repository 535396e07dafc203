/* pairintegrals.h -- search and integrals of one pair. */
#ifndef MORTISE_PAIRINTEGRALS_H
#define MORTISE_PAIRINTEGRALS_H

#include "contact/pairassembly.h"

/* Searches and integrates one pair. Collective.
   [in,out] pair - with its spec and level; [in,out] assembly - zero except for gap_only and displacement;
   then complete before MultiplierStatusResolve(); owned by the caller, PairAssemblyDestroy() */
PetscErrorCode PairIntegralsCompute(Scene scene, Level *level, const Support *support, Pair pair,
                                    PairAssembly *assembly);
#endif

/* nestediteration.h -- from the coarsest level to the next to finest one; internal (eq. 14.3). */
#ifndef MORTISE_NESTEDITERATION_H
#define MORTISE_NESTEDITERATION_H

#include "solve/meshlevels.h"
#include "solve/proximal.h"

/* Solves on all levels but the finest, each from what the one before found, and takes that to the finest level. Collective.
   [in] snes - that solves on the finest level, ready for it; of type pdas where there are springs; [in,out] springs - of the finest level; [out] y - displacement to begin
   with, where springs rest; [out] active - 1 or 0: set to begin with, in the layout of y; [out] gained - twice the energy that y has less than
   the displacement of the next coarser level; [out] found - whether there is such a beginning: not where no coarser level has a solution */
PetscErrorCode NestedIterationStart(MeshLevels levels, SNES snes, Proximal *proximal, Vec y, Vec active,
                                    PetscReal *energy_decrease, PetscBool *found);

#endif

/* nestediteration.h -- nested iteration from the coarsest level to the finest; internal (eq. 14.3). */
#ifndef MORTISE_NESTEDITERATION_H
#define MORTISE_NESTEDITERATION_H

#include "solve/proximal.h"

/* Solves on all mesh levels but the finest, each from the solution of the one before, and prolongs to the
   finest level. Collective.
   [in] snes - of the finest level, configured; of type pdas with a proximal term; [in,out] proximal - of the
   finest level; [out] y - initial displacement and centre of the proximal term; [out] active - initial set, 1
   or 0, in the layout of y; [out] energy_decrease - twice the energy that y has less than the displacement of
   the next coarser level; [out] found - false if no coarser level has a solution */
PetscErrorCode NestedIterationStart(MeshLevels levels, SNES snes, Proximal *proximal, Vec y, Vec active,
                                    PetscReal *energy_decrease, PetscBool *found);

/* Improves a displacement that was prolonged from a coarser mesh or extrapolated from load steps, and
   predicts its active set (eqs. 14.1, 14.2). The residual of a prolonged displacement is rough, so that
   (10.1) does not give its set. Collective.
   [in] snes - of the finest level, of type pdas, configured;
   [in] kept - whether it has the preconditioner of the load step before; [in,out] y; [out] active - 1 or 0,
   in the layout of y; [out] found - whether a set is predicted */
PetscErrorCode NestedIterationPredict(MeshLevels levels, SNES snes, VI vi, PetscBool kept, Vec y, Vec active,
                                      PetscBool *found);

#endif

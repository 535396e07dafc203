/* reachcheck.h -- the search radius check. */
#ifndef MORTISE_REACHCHECK_H
#define MORTISE_REACHCHECK_H

#include "study/run.h"

/* Sides that have moved farther than their reach may have passed through what lies beyond it. Looks there, and where bodies
   overlap after the motion, widens the reach in the scene for pairs that chose it themselves, or makes the certificate fail
   for those whose reach was given. Collective. [out] again - whether a reach is wider now, so that all has to be done again */
PetscErrorCode ReachCheckRun(Run run, PetscBool *again);

#endif

/* reachcheck.h -- the search radius check. */
#ifndef MORTISE_REACHCHECK_H
#define MORTISE_REACHCHECK_H

#include "study/run.h"

/* Sides that moved farther than the reach of their pair may have passed through bodies outside it. Searches
   there. Where bodies overlap, widens a reach that was chosen automatically; a reach of the user makes the
   certificate fail. Collective.
   [out] again - whether a reach is wider now: then the problem must be solved again */
PetscErrorCode ReachCheckRun(Run run, PetscBool *again);

#endif

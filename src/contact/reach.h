/* reach.h -- the search radius of a pair. */
#ifndef MORTISE_REACH_H
#define MORTISE_REACH_H

#include "level/level.h"
#include "support/support.h"

/* Chooses the reach: as given, or from the geometry. Collective. [in] mortar - NULL for an obstacle */
PetscErrorCode ReachChoose(const ScenePair *spec, Level *level, const Support *support, const Facets *nonmortar,
                           const Facets *mortar, PetscReal *reach);

/* Widens the reach where bodies initially overlap by more. User error: the reach was given by the user.
   Collective.
   [in,out] reach - of ReachChoose() */
PetscErrorCode ReachWiden(const ScenePair *spec, const Level *level, const Facets *nonmortar, const Facets *mortar,
                          PetscReal *reach);

#endif

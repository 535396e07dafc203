/* knowntraction.h -- the facets of a body's surface at a place, and the tractions that are known there. */
#ifndef MORTISE_KNOWNTRACTION_H
#define MORTISE_KNOWNTRACTION_H

#include "result/fields.h"

typedef struct {
  Facets     facets; /* of this rank's cells that hold the place */
  PetscBool *normal; /* whether the normal part of the traction is known [facets.num] */
  PetscBool *along;  /* whether the part along the facet is [facets.num] */
  PetscReal *given;  /* at the nodes [facets.num][ELEMENT_MAX_FACET_NODES][dim] */
} KnownTraction;

/* Free facets have no traction, loads give theirs. Supports in normal direction, contact without friction and
   the axis of revolution have none along them. Collective.
   [out] known - to be freed by KnownTractionDestroy() */
PetscErrorCode KnownTractionCreate(Level *level, PetscInt body, const PetscReal at[], KnownTraction *known);
PetscErrorCode KnownTractionDestroy(KnownTraction *known);
/* The least stress whose traction is what the recovered one has too much. Not collective.
   [in] f - a facet; i - of its nodes; [out] error - xx,yy,zz,yz,xz,xy [6] */
void KnownTractionGetError(const KnownTraction *known, const Level *level, const NodalStressArrays *recovered,
                           PetscInt f, PetscInt i, PetscReal error[]);

#endif

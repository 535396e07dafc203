/* arcsides.h -- the smooth sides of bodies from files (eq. 4.5), and the curves over their edges. */
#ifndef MORTISE_ARCSIDES_H
#define MORTISE_ARCSIDES_H

#include "level/facets.h"

/* Smooth sides, and sides that must stay flat, of files of first order; normals of facets are outward. */
typedef struct {
  PetscBool any; /* the same on all ranks */
  Facets    round, flat;
} ArcSides;

/* The names of a body's sides that may be smooth, and of those with a fixed normal displacement, joined by
   '+'. Not collective. [out] each owned by the caller, PetscFree(); NULL if there are none */
PetscErrorCode ArcSideNames(Scene scene, PetscInt body, char **round, char **flat);
/* The facets of all bodies of an order that have such sides. Collective. [out] sides - owned by the caller */
PetscErrorCode ArcSidesCreate(Level *level, PetscInt order, ArcSides *sides);
/* Not collective. */
PetscErrorCode ArcSidesDestroy(ArcSides *sides);
/* Whether facets of first order form a curved patch, on any rank. Collective. */
PetscErrorCode LevelHasArcs(Level *level, const ArcSides *sides, PetscBool *any);
/* Moves middle nodes of a level to the curves over its own edges. Positions are those before maps, which the
   level has. Collective. */
PetscErrorCode LevelArcMiddles(Level *level, const ArcSides *sides);

#endif

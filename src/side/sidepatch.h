/* sidepatch.h -- the smooth patches of a side: what fits of normals start from, and their limits. Private. */
#ifndef MORTISE_SIDEPATCH_H
#define MORTISE_SIDEPATCH_H

#include "side/sideplanes.h"
#include "side/sideshape.h"

/* A side whose means over facets are known. All is borrowed. */
typedef struct {
  Level            *level;
  const Facets     *facets; /* of this rank */
  const SideSums   *nodes;  /* of the facets */
  const SidePlanes *planes; /* of symmetry */
  const SideShape  *shape;  /* normals (4.1), ridges */
  const PetscReal  *share;  /* of a full turn, that the patch fills around a node [num][F] */
} SmoothSide;

/* Facets of one patch meet at less than 44 degrees, and so deviate from their mean normal by at most half of
   that. Chamfers, and fillets of two facets, have 45 degrees: edges, whatever their rounding. */
static const PetscReal SMOOTH_SIDE = 0.7193398003386512, SURELY_SMOOTH = 0.9271838545667874;
/* Share of a full turn that the facets of a patch fill around an inner node. An end of a line fills half, a
   corner less than a third. */
static const PetscReal INNER_TURN = 0.8;
/* Differences of unit normals below this are roundoff: flat. */
static const PetscReal FLAT_SIDE = 1e-11;

#endif

/* sidemeasure.h -- stiffness and size of a side. */
#ifndef MORTISE_SIDEMEASURE_H
#define MORTISE_SIDEMEASURE_H

#include "level/level.h"

/* Means over the facets of a side, and over the cells behind them. The same on all ranks. */
typedef struct {
  PetscReal modulus;    /* contact modulus E / (1 - nu^2) behind the facets, as a mean; stress */
  PetscReal facet_size; /* mean length of a facet, of sides in space mean area */
  PetscReal size;       /* length of the side, of sides in space area */
} SideMeasure;

/* Computes these means. User errors: formulas of moduli. Collective. [out] measure */
PetscErrorCode SideMeasureCompute(Scene scene, Level *level, const SceneSide *side, SideMeasure *measure);
/* h_a of the nodes of a side: the largest length of a facet at node a, in space the square root of its area;
   0 elsewhere.
   Collective. [out] sizes - one value per node, ghosted, owned by the caller */
PetscErrorCode SideMeasureNodeSizes(Scene scene, Level *level, const SceneSide *side, Vec *sizes);

#endif

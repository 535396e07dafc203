/* bodycurves.h -- curved edges of files under bodies of order 1. */
#ifndef MORTISE_BODYCURVES_H
#define MORTISE_BODYCURVES_H

#include "refinement/curves.h"

typedef struct _n_MeshShape *MeshShape;

/* Makes the curves of the coarsest level; nothing without such bodies. Collective.
   [out] shape - owned by the caller, NULL where there are none */
PetscErrorCode MeshShapeCreate(Scene scene, const Level *level, const Curves *curves, MeshShape *shape);
/* Refines them with the level, and moves its nodes to them. NULL is accepted. Collective.
   [in,out] fine - its coordinates */
PetscErrorCode MeshShapeRefine(MeshShape shape, Level *fine);
/* Collective. */
PetscErrorCode MeshShapeDestroy(MeshShape *shape);

#endif

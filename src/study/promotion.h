/* promotion.h -- interpolation of a displacement to finer levels. */
#ifndef MORTISE_PROMOTION_H
#define MORTISE_PROMOTION_H

#include "mesh/mesh.h"

/* v = P u for each component. Collective.
   [in] P - from node values to node values of level; [out] v - ghosted, owned by the caller */
PetscErrorCode PromotionProlong(Mat P, Level *level, Vec u, Vec *v);
/* Interpolates a displacement by the prolongations of a mesh. Collective.
   [in] u - on the level of index from; [out] v - on that of index to, ghosted, owned by the caller */
PetscErrorCode PromotionApply(Mesh mesh, PetscInt from, PetscInt to, Vec u, Vec *v);

#endif

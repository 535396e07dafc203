/* promotion.h -- a displacement on finer levels of a mesh. */
#ifndef MORTISE_PROMOTION_H
#define MORTISE_PROMOTION_H

#include "mesh/mesh.h"

/* v = P u for each component, with ghosts. Collective. [in] P - node values to node values of `level`; [out] v - ghosted, owned by the caller */
PetscErrorCode PromotionProlong(Mat P, Level *level, Vec u, Vec *v);
/* Brings a displacement up by prolongations. Collective. [in] u - on level `from` of mesh; [out] v - ghosted, on level `to`; owned by the caller */
PetscErrorCode PromotionApply(Mesh mesh, PetscInt from, PetscInt to, Vec u, Vec *v);

#endif

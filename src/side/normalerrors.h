/* normalerrors.h -- what is not known of the sides of a file between its nodes. Private.

   The normals of a file's mesh have errors. Finer meshes follow its curves, and inherit them. */
#ifndef MORTISE_NORMALERRORS_H
#define MORTISE_NORMALERRORS_H

#include "side/sideshape.h"

/* Sets level->normal_errors at the nodes of facets, where these are not 0. Others keep theirs. Collective.
   [in] facets - of first or second order; [in] shape - of them */
PetscErrorCode LevelAddNormalErrors(Level *level, const Facets *facets, const SideShape *shape);
/* Interpolates those of the coarser level. Collective. [in,out] fine - with its prolongation */
PetscErrorCode LevelFollowNormalErrors(const Level *coarse, Level *fine);

#endif

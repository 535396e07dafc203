/* sidejets.h -- normals of sides in space, of fourth order. Private. */
#ifndef MORTISE_SIDEJETS_H
#define MORTISE_SIDEJETS_H

#include "side/sidepatch.h"

/* What is known of a side better than means over facets are, at the corners of its facets. */
typedef struct {
  PetscReal *normal;    /* zero where none is known [num][F][dim] */
  PetscReal *curvature; /* of polynomials, zero where there is none; NULL in the plane [num][F][dim][dim] */
  PetscReal *spread;    /* of normals at ends: how much those of neighbours differ there [num][F] */
  PetscReal *error;     /* of normals of polynomials, in radians, estimated [num][F] */
} SideFit;

/* Normals of polynomials of degree 4 through the nodes of a patch (eq. 4.1c), where none is known yet. Means
   over facets are of first order on triangles in no order. Collective. [in,out] fit - with curvatures */
PetscErrorCode SideJetsGetNormals(const SmoothSide *side, SideFit *fit);

#endif

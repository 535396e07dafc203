/* arcextract.h -- smooth sides of a body while its file's mesh is refined (eq. 4.5).
   Nothing is collective. */
#ifndef MORTISE_ARCEXTRACT_H
#define MORTISE_ARCEXTRACT_H

#include "bodies/fileextract.h"
#include "refinement/arcsides.h"

/* Sides that are taken for smooth on the level as it is; positions before the map are kept where there are
   some. [out] sides - owned by the caller */
PetscErrorCode ExtractArcSides(Extract *x, Scene scene, PetscInt body, ArcSides *sides);
/* The same for a file of second order: which facets are on arcs; their middle nodes after a refinement. */
PetscErrorCode ExtractMarkParabolas(Extract *x, Scene scene, PetscInt body);
PetscErrorCode ExtractCurveMiddles(Extract *x, Scene scene, PetscInt body);

#endif

/* sagitta.h -- facets that approximate a curve, and its distance from them. */
#ifndef MORTISE_SAGITTA_H
#define MORTISE_SAGITTA_H

#include "level/facets.h"

/* Boundary facets of this rank whose nodes lie on a curve that finer meshes approximate better. */
typedef struct {
  Facets     facets;
  PetscReal *height; /* mean distance of the curve outward of the facet [facets.num] */
} Sagittas;

/* Finds these facets. They are those of the boundary of a body with a map, or of a body of order 1 from a
   file of second order. Also those of the sides of pairs of a file of first order, unless they are
   polygonal. Curves are those of the map, or of the nodal normals (eq. 4.5). Distances from a cell of order 2
   are those from its own curve. Collective. [out] sagittas - owned by the caller */
PetscErrorCode SagittasCreate(Level *level, Sagittas *sagittas);
PetscErrorCode SagittasDestroy(Sagittas *sagittas);

#endif

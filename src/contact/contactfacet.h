/* contactfacet.h -- one facet of a side: its nodes, a box around it, its size. */
#ifndef MORTISE_CONTACTFACET_H
#define MORTISE_CONTACTFACET_H

#include "level/level.h"

/* Largest cosine between the normals of two facets that face each other: an angle above 107 degrees. The same
   holds for a facet's normal and a ray that meets it. */
static const PetscReal FACING = -0.3;

/* Coordinates of a facet's nodes, [num_nodes][dim]. Not collective. */
void ContactFacetCoordinates(const Level *level, const Facets *facets, PetscInt f, PetscReal X[]);
/* The Bezier points of a facet, whose convex hull contains it, curved or not; and a box that contains it. The
   same holds for any field that is interpolated at its nodes. Not collective.
   [in] X - [num_nodes][dim]; [out] hull - [num_nodes][dim];
   [out] box - lower, upper corner [2][dim] */
void ContactFacetHull(PetscInt dim, ElementType type, const PetscReal X[], PetscReal hull[]);
void ContactFacetBox(PetscInt dim, ElementType type, const PetscReal X[], PetscReal box[]);
/* The longest edge of all facets of a side. Collective. */
PetscErrorCode ContactFacetMaxSize(const Level *level, const Facets *facets, PetscReal *size);

#endif

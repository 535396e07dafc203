/* facetpolygon.h -- facets in space as polygons in the plane of one of them. */
#ifndef MORTISE_FACETPOLYGON_H
#define MORTISE_FACETPOLYGON_H

#include "kernel/clip.h"
#include "kernel/polygon.h"

/* A part of a facet; its corners run anticlockwise in the plane. */
typedef struct {
  ElementType type;                               /* tri3 or quad4 */
  PetscBool   affine;                             /* a triangle or a parallelogram */
  PetscReal   reference[2 * POLYGON_MAX_CORNERS]; /* corners in the facet's reference cell */
  PetscReal   plane[2 * POLYGON_MAX_CORNERS];     /* and in the plane */
  PetscReal   to_reference[8], to_plane[8];       /* of (1, s, t, s t), s and t from 0 to 1, [4][2] */
} FacetPart;

/* A facet as the plane sees it. */
typedef struct {
  const ClipFacet *facet;
  PetscReal        plane[2 * ELEMENT_MAX_FACET_NODES]; /* its nodes */
  PetscReal        area;                               /* of all parts in the plane */
  PetscInt         num_parts;
  FacetPart        parts[CLIP_MAX_PARTS];
} FacetPolygon;

typedef struct {
  PetscReal origin[3], Q[9]; /* normal and two tangents */
  PetscReal size;            /* of the nonmortar facet */
} FacetPlane;

/* The plane through a facet that is normal to the sum of its nodal normals. */
void FacetPolygonSetPlane(const ClipFacet *nonmortar, FacetPlane *plane);
/* Places of nodes in the plane. [in] X - [n][3]; [out] P - [n][2] */
void FacetPolygonProjectPoints(const FacetPlane *plane, PetscInt n, const PetscReal X[], PetscReal P[]);

/* A facet's nodes in the plane, then its parts. */
void FacetPolygonProject(const FacetPlane *plane, const ClipFacet *facet, FacetPolygon *shadow);
void FacetPolygonSplit(const FacetPlane *plane, FacetPolygon *shadow);
/* Whether the boxes around the nodes of two shadows meet; before they are cut. */
PetscBool FacetPolygonsMeet(const FacetPolygon *a, const FacetPolygon *b);

#endif

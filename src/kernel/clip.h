/* clip.h -- overlap of a nonmortar facet with mortar facets as quadrature points (eq. 4.4).

   2D: the nonmortar facet x(xi) = sum phi_i X_i, xi in [0,1], has the normal field n(xi) = sum phi_i N_i.
   Shape functions are linear or quadratic. The ends of a mortar facet are projected along it. Between them
   the rays x + t n/|n| meet the mortar facet, which may be curved itself, at eta with gap t. Rays that meet
   it from behind (t < 0) or after crossing each other count as well: orientation and distance are judged by
   the caller. All nodal normals lie within a right angle of the facet's own, so that n(xi) never vanishes.

   3D: both facets are projected onto the plane that is normal to the sum of the nonmortar facet's nodal
   normals. There the polygons of their nodes are intersected. The gap is measured along this plane's
   normal. */
#ifndef MORTISE_CLIP_H
#define MORTISE_CLIP_H

#include "kernel/element.h"

enum {
  CLIP_MAX_GAUSS  = 8, /* points on a piece */
  CLIP_MAX_PIECES = 5, /* of a mortar facet under strongly turning normals: two ends, four roots of each */
  CLIP_MAX_POINTS = CLIP_MAX_PIECES * CLIP_MAX_GAUSS,

  CLIP_MAX_PARTS          = 8,  /* of a facet in space: the quads of a quad9, halved where not convex */
  CLIP_MAX_RULE           = 25, /* points of a triangle's rule where both facets have parts; others have few parts */
  CLIP_MAX_POLYGON_POINTS = CLIP_MAX_PARTS * CLIP_MAX_PARTS * 6 * CLIP_MAX_RULE,
  CLIP_MAX_CORNERS        = CLIP_MAX_PARTS * CLIP_MAX_PARTS * 8 /* of two quads */
};

/* One quadrature point of an overlap. */
typedef struct {
  PetscReal xi[2];  /* on the nonmortar facet's reference cell */
  PetscReal eta[2]; /* on the mortar facet's reference cell */
  PetscReal weight; /* length or area on the nonmortar facet itself, curved or not */
  PetscReal gap;    /* signed, along the nonmortar normal, open > 0 */
  PetscReal share;  /* of the nonmortar facet: of its reference cell in 2D, of its shadow on the plane in 3D */
} ClipPoint;

/* One side of an overlap; the arrays are borrowed. */
typedef struct {
  ElementType      type;
  const PetscReal *X; /* nodes [num_nodes][dim] */
  const PetscReal *N; /* unit normals at them [num_nodes][dim]; not needed of a mortar facet */
} ClipFacet;

/* Quadrature points of the overlap of two line facets, piece by piece along the nonmortar one, num_gauss on
   each. Returns their number, 0 where the facets do not overlap. The pieces over a chain of mortar facets
   share their ends exactly. Pieces shorter than 1e-12 of the facet are skipped. Mortar ends run opposite to
   the nonmortar ends on facing bodies; either order is accepted.
   [in] num_gauss - 1..CLIP_MAX_GAUSS; [out] points - [CLIP_MAX_POINTS] */
PetscInt ClipLines(const ClipFacet *nonmortar, const ClipFacet *mortar, PetscInt num_gauss, ClipPoint points[]);

/* The same for facets in space, tri3, quad4, tri6, quad9 in any combination. The rule on the triangles of the
   overlap is exact to the degree. Returns the number of points, 0 where the facets do not overlap. Facets of
   second order are cut as polygons through their nodes; all xi lie in the reference cell. If a tiling covers
   a facet once, so do the xi. eta may lie a little outside of curved mortar facets. For flat facets the
   weights sum up to the area of the overlap, and shares to at most 1 where the facet is covered once. Either
   side of the mortar facet may face the nonmortar one. Not collective.
   [out] points - [CLIP_MAX_POLYGON_POINTS] */
PetscInt ClipPolygons(const ClipFacet *nonmortar, const ClipFacet *mortar, PetscInt degree, ClipPoint points[]);

/* The boundary of the overlap of two facets: ends of its pieces for lines, corners of its polygons in space.
   Returns their number; some occur more than once. Not collective.
   [out] xi - on the nonmortar facet's reference cell [CLIP_MAX_CORNERS][2] */
PetscInt ClipCorners(const ClipFacet *nonmortar, const ClipFacet *mortar, PetscReal xi[]);

/* Whether a line meets the inside of a mortar facet, and the gap there. The line goes through x(xi) of a
   nonmortar facet in space, along its plane's normal. Decides which of several facets is hidden. Not
   collective.
   [in] xi - [2] */
PetscBool ClipSees(const ClipFacet *nonmortar, const ClipFacet *mortar, const PetscReal xi[], PetscReal *gap);

/* The degree for products of two nonmortar shape functions, and of one of each facet: exact for
   parallelograms and triangles. Not collective. */
PetscInt ClipDegree(ElementType nonmortar, ElementType mortar);

#endif

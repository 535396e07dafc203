/* clip.h -- overlap of a nonmortar facet with mortar facets as quadrature points (floor 1; T14).

   2D: the nonmortar facet x(xi) = sum phi_i X_i, xi in [0,1], carries the normal field n(xi) = sum phi_i N_i with the
   same shape functions, linear or quadratic. The ends of a mortar facet are projected along it; between them the rays
   x + t n/|n| meet the mortar facet, which may be curved itself, at eta with gap t. Rays that meet it from behind (t < 0)
   or after crossing each other count as well: orientation and distance are judged by the caller. All nodal normals lie
   within a right angle of the facet's own, so that n(xi) never vanishes. */
#ifndef MORTISE_CLIP_H
#define MORTISE_CLIP_H

#include <mortise/element.h>

enum {
  CLIP_MAX_GAUSS  = 8, /* points on a piece */
  CLIP_MAX_PIECES = 5, /* strongly turning normals can see a mortar facet in several: two ends, four roots of each */
  CLIP_MAX_POINTS = CLIP_MAX_PIECES * CLIP_MAX_GAUSS
};

/* One quadrature point of an overlap. */
typedef struct {
  PetscReal xi[2];  /* on the nonmortar facet's reference cell */
  PetscReal eta[2]; /* on the mortar facet's reference cell */
  PetscReal weight; /* length or area on the nonmortar facet */
  PetscReal gap;    /* signed, along the nonmortar normal, open > 0 */
} ClipPoint;

/* One side of an overlap; the arrays are borrowed. */
typedef struct {
  ElementType      type;
  const PetscReal *X; /* nodes [num_nodes][dim] */
  const PetscReal *N; /* unit normals at them [num_nodes][dim]; not needed of a mortar facet */
} ClipFacet;

/* Quadrature points of the overlap of two line facets, piece by piece along the nonmortar one, num_gauss on each;
   returns their number, 0 where the facets do not overlap. The pieces over a chain of mortar facets share their ends
   exactly. Pieces shorter than 1e-12 of the facet are skipped. Mortar ends run opposite to the nonmortar ends on facing
   bodies; either order is accepted. [in] num_gauss - 1..CLIP_MAX_GAUSS; [out] points - [CLIP_MAX_POINTS] */
PetscInt ClipLines(const ClipFacet *nonmortar, const ClipFacet *mortar, PetscInt num_gauss, ClipPoint points[]);

#endif

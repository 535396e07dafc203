/* clip.h -- overlap of a nonmortar facet with mortar facets as quadrature points (floor 1; T14).

   2D: the nonmortar facet x(xi), xi in [0,1], carries the normal field n(xi) = (1-xi) n_1 + xi n_2. The ends of a
   mortar facet are projected along it; between them the rays x + t n/|n| meet the mortar facet at eta with gap t.
   Rays that meet it from behind (t < 0) or after crossing each other count as well: orientation and distance are
   judged by the caller. Both nodal normals lie within a right angle of the facet's own normal, so that n(xi) never
   vanishes. */
#ifndef MORTISE_CLIP_H
#define MORTISE_CLIP_H

#include <petscsys.h>

enum {
  CLIP_MAX_GAUSS  = 8,                 /* points on a piece */
  CLIP_MAX_POINTS = 3 * CLIP_MAX_GAUSS /* strongly turning normals can see a mortar facet in up to three pieces */
};

/* One quadrature point of an overlap. */
typedef struct {
  PetscReal xi[2];  /* on the nonmortar facet's reference cell */
  PetscReal eta[2]; /* on the mortar facet's reference cell */
  PetscReal weight; /* length or area on the nonmortar facet */
  PetscReal gap;    /* signed, along the nonmortar normal, open > 0 */
} ClipPoint;

/* Solves cross(x(xi) - y, n(xi)) = 0 for xi on the line through a facet. Of two roots it is the one whose ray has not
   crossed its neighbours before it reaches y. Returns PETSC_FALSE, xi untouched, if there is none near.
   [in] X - nonmortar ends [2][2]; [in] N - unit normals at them [2][2]; [in] y - [2]; [out] xi */
PetscBool ClipProject(const PetscReal X[], const PetscReal N[], const PetscReal y[], PetscReal *xi);

/* Quadrature points of the overlap of two line facets; returns their number, 0 where they do not overlap.
   The pieces over a chain of mortar facets share their ends exactly. Pieces shorter than 1e-12 of the facet are
   skipped. Mortar ends run opposite to the nonmortar ends on facing bodies; either order is accepted.
   [in] X, N - nonmortar ends and their unit normals [2][2]; [in] Y - mortar ends [2][2]
   [in] num_gauss - Gauss points on a piece, 1..CLIP_MAX_GAUSS; [out] points - [CLIP_MAX_POINTS] */
PetscInt ClipLines(const PetscReal X[], const PetscReal N[], const PetscReal Y[], PetscInt num_gauss,
                   ClipPoint points[]);

#endif

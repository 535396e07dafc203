/* frame.h -- nodal normals and orthonormal frames (eq. 4.1). */
#ifndef MORTISE_FRAME_H
#define MORTISE_FRAME_H

#include <petscsys.h>

/* Adds one facet's weighted normal to its nodes (Max 1999; in 2D nu / h). Exact on circles for any spacing of
   nodes, and on spheres for any ring of facets. Facets of second order count as the straight parts between
   their nodes. 2D: line2 or line3 with the outward normal (dy,-dx). 3D: tri3, quad4, tri6 or quad9,
   anticlockwise seen from outside. No edge has zero length.
   [in] X - [num_nodes][dim]; [in,out] N - [num_nodes][dim], not normalized */
void FrameAddFacetNormal(PetscInt dim, PetscInt num_nodes, const PetscReal X[], PetscReal N[]);

/* The parts with straight edges of a facet in space, tri3, quad4, tri6 or quad9: those between its nodes.
   [out] num, num_corners - of parts, and of each; [out] corners - nodes, anticlockwise [num][num_corners] */
void FrameGetParts(PetscInt num_nodes, PetscInt *num, PetscInt *num_corners, const PetscInt **corners);

/* n / |n|; returns |n| before. Zero stays zero. [in,out] n - [dim] */
PetscReal FrameNormalize(PetscInt dim, PetscReal n[]);

/* Rows (n, t) in 2D with t = (-n_y, n_x), (n, t1, t2) in 3D by the branch-free formula of Duff et al. (2017).
   [in] n - unit [dim]; [out] Q - [dim][dim] */
void FrameFromNormal(PetscInt dim, const PetscReal n[], PetscReal Q[]);

#endif

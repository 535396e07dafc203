/* frame.h -- nodal normals and orthonormal frames (floor 1; numerics.md 2). */
#ifndef MORTISE_FRAME_H
#define MORTISE_FRAME_H

#include <petscsys.h>

/* Adds one facet's weighted normal to its nodes (Max 1999; in 2D nu_f / h_f: exact on circles for any spacing).
   2D: facet ends X [2][2] with the outward normal (dy,-dx). [in,out] N - [num_nodes][dim], not normalised */
void FrameAddFacetNormal(PetscInt dim, PetscInt num_nodes, const PetscReal X[], PetscReal N[]);

/* n / |n|; returns |n| before. [in,out] n - [dim] */
PetscReal FrameNormalize(PetscInt dim, PetscReal n[]);

/* Rows (n, t) in 2D with t = (-n_y, n_x), (n, t1, t2) in 3D by the branch-free formula of Duff et al. (2017).
   [in] n - unit [dim]; [out] Q - [dim][dim] */
void FrameFromNormal(PetscInt dim, const PetscReal n[], PetscReal Q[]);

#endif

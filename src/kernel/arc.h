/* arc.h -- the curve that nodal normals make of a straight edge, and of a facet of first order (eq. 4.5). */
#ifndef MORTISE_ARC_H
#define MORTISE_ARC_H

#include "kernel/element.h"

/* Offset from the middle of a chord to the middle of the curve with these unit normals at the ends, across
   the chord. Exact on circles, spheres and cylinders along any direction. Exactly zero where the edge is
   straight at one end: a flat side that ends in a fillet, or at another flat one, stays flat. Also zero where
   it bends both ways, or turns by 31 degrees and more. Not collective.
   [in] x0, n0, x1, n1 - [dim]; [in] smooth - whether the surface around both ends is smooth: it may bend both
   ways; [out] offset - [dim] */
void ArcOffset(PetscInt dim, const PetscReal x0[], const PetscReal n0[], const PetscReal x1[], const PetscReal n1[],
               PetscBool smooth, PetscReal offset[]);

/* Offsets of a facet of first order to the curves over its edges, at the nodes of the facet of second order.
   They are zero at vertices, those of the edges in their middles, half of the sum of these in the middle of a
   quad (Coons 1967). Returns whether any is not zero. Not collective.
   [in] X, N - nodes and unit normals [num_nodes][dim]; [in] smooth - where the surface is smooth [num_nodes],
   or NULL;
   [out] bulge - [nodes of the facet of second order][dim] */
PetscBool ArcBulge(ElementType type, const PetscReal X[], const PetscReal N[], const PetscBool smooth[],
                   PetscReal bulge[]);

/* This offset at xi, along a direction. Not collective.
   [in] type - of first order; bulge - also at vertices; [in] n - [dim] */
PetscReal ArcHeight(ElementType type, const PetscReal bulge[], const PetscReal xi[], const PetscReal n[]);

#endif

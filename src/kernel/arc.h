/* arc.h -- the curve that nodal normals make of a straight edge, and of a facet of first order (eq. 4.5). */
#ifndef MORTISE_ARC_H
#define MORTISE_ARC_H

#include "kernel/element.h"

/* From the middle of the chord between two points to the middle of the curve that has these unit normals there, across the
   chord: exact on circles, spheres and cylinders along any direction. Nothing, exactly, where the edge is straight at one of its
   ends: a flat side that ends in a fillet, or at another flat one, stays flat. Also where it bends both ways, or turns by 30 degrees and more.
   [in] x0, n0, x1, n1 - [dim]; [out] offset - [dim] */
void ArcOffset(PetscInt dim, const PetscReal x0[], const PetscReal n0[], const PetscReal x1[], const PetscReal n1[],
               PetscReal offset[]);

/* What the curves over the edges of a facet of first order add to its points, as values at the nodes of the facet of second
   order: nothing at vertices, the offsets in the middles of edges, half of their sum in that of a quad (Coons 1967). Returns
   whether there is any. [in] X, N - nodes and unit normals [num_nodes][dim]; [out] bulge - [nodes of the facet of second order][dim] */
PetscBool ArcBulge(ElementType type, const PetscReal X[], const PetscReal N[], PetscReal bulge[]);

/* That at xi, along a direction. [in] type - of first order; n - [dim] */
PetscReal ArcHeight(ElementType type, const PetscReal bulge[], const PetscReal xi[], const PetscReal n[]);

#endif

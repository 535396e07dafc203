/* dual.h -- dual basis of one facet or of its covered part.

   psi = A phi with A = D_e M_e^-1, M_e = int_cov phi phi^T, D_e = diag(int_cov phi) (eq. 3.4; Wohlmuth 2000,
   Cichosz & Bischoff 2011 for cut facets). So int_cov psi_i phi_j = delta_ij int_cov phi_j and sum_i psi_i =
   1. The integrals have the same points as M and the gap.

   On tri6 int phi vanishes at vertices, and phi stands for the functions phi~ of DualShape() (Popp et al.
   2012). Their unknowns are u~ with u_v = u~_v, and u_e = (1 - 2 a) u~_e + a (u~_v + u~_w) in the middle e of
   the edge from v to w, a = DualShare(). This is done edge by edge, hence continuous. */
#ifndef MORTISE_DUAL_H
#define MORTISE_DUAL_H

#include "kernel/element.h"

enum { DUAL_MAX = ELEMENT_MAX_FACET_NODES };

/* Plain data. psi = C L, where L_j(xi) = phi_j((xi - lower) / size) are the shape functions of the box around
   the covered part. They span the polynomials of the facet, and are well conditioned however small that part
   is. */
typedef struct {
  ElementType type;
  PetscReal   lower[2], size[2];      /* box [ElementDim] */
  PetscReal   C[DUAL_MAX * DUAL_MAX]; /* [n][n], n = ElementNumNodes(type) */
  PetscReal   D[DUAL_MAX];            /* int_cov phi_i = int_cov psi_i [n]; may be negative on cut quadratic facets */
} DualBasis;

/* Functions of a facet beside hanging nodes: phi = S' times its shape functions. A function that belongs to a
   node outside of the facet takes the slot of one that hangs. */
typedef struct {
  PetscReal S[DUAL_MAX * DUAL_MAX]; /* values of the functions at the facet's nodes: a row for each node [n][n] */
  PetscReal place[DUAL_MAX][2];     /* where the nodes of the functions are, in the facet's coordinates */
} DualNodes;

/* a: 1/5 on tri6, 0 on the others, where phi~ = phi. */
PetscReal DualShare(ElementType type);
/* phi~ from phi: a facet's shape functions at a point, or any sums of them. [in,out] phi - [n] */
void DualShape(ElementType type, PetscReal phi[]);

/* Creates the basis from weighted points on the facet's reference cell. Returns PETSC_FALSE where shape
   functions are dependent at these points; D is set all the same. Not collective.
   [in] xi - [num_points][2], unused coordinates ignored; [in] w - [num_points]; [in] nodes - of functions
   that are not the facet's own, or NULL; not of tri6 */
PetscBool DualBasisCreate(ElementType type, PetscInt num_points, const PetscReal xi[], const PetscReal w[],
                          const DualNodes *nodes, DualBasis *basis);
/* Integrals of these functions, from those of the facet's own. [in,out] D - [n] */
void DualNodesApply(PetscInt n, const DualNodes *nodes, PetscReal D[]);

/* psi at a point. [in] xi - [2]; [out] psi - [n] */
void DualBasisEvaluate(const DualBasis *basis, const PetscReal xi[], PetscReal psi[]);

#endif

/* dual.h -- dual basis of one facet or of its covered part.

   psi = A phi with A = D_e M_e^-1, M_e = int_cov phi phi^T, D_e = diag(int_cov phi), so that
   int_cov psi_i phi_j = delta_ij int_cov phi_j and sum_i psi_i = 1 (eq. 3.4; Wohlmuth 2000, Cichosz & Bischoff 2011 for cut
   facets). The integrals come from the very points that later integrate M and the gap.

   On tri6, where int phi vanishes at vertices, phi stands for the functions phi~ of DualShape() (Popp et al. 2012): they
   belong to the unknowns u~ with u_e = (1 - 2 a) u~_e + a (u~_v + u~_w) in the middle e of the edge from v to w, and
   u_v = u~_v, where a is DualShare(). Edge by edge, hence continuous. */
#ifndef MORTISE_DUAL_H
#define MORTISE_DUAL_H

#include "kernel/element.h"

enum { DUAL_MAX = ELEMENT_MAX_FACET_NODES };

/* Plain data. psi = C L, where L_j(xi) = phi_j((xi - lower) / size) are the shape functions of the box around the covered
   part: the same polynomials as those of the facet, but well conditioned however small that part is. */
typedef struct {
  ElementType type;
  PetscReal   lower[2], size[2];      /* box [ElementDim] */
  PetscReal   C[DUAL_MAX * DUAL_MAX]; /* [n][n], n = ElementNumNodes(type) */
  PetscReal   D[DUAL_MAX];            /* int_cov phi_i = int_cov psi_i [n]; may be negative on cut quadratic facets */
} DualBasis;

/* a: 1/5 on tri6, 0 on the others, where phi~ = phi. */
PetscReal DualShare(ElementType type);
/* phi~ from phi: a facet's shape functions at a point, or any sums of them. [in,out] phi - [n] */
void DualShape(ElementType type, PetscReal phi[]);

/* From weighted points on the facet's reference cell. Returns PETSC_FALSE where they cannot tell the shape functions
   apart; D is set all the same. [in] xi - [num_points][2], unused coordinates ignored; [in] w - [num_points] */
PetscBool DualBasisCreate(ElementType type, PetscInt num_points, const PetscReal xi[], const PetscReal w[],
                          DualBasis *basis);

/* psi at a point. [in] xi - [2]; [out] psi - [n] */
void DualBasisEvaluate(const DualBasis *basis, const PetscReal xi[], PetscReal psi[]);

#endif

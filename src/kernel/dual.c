/* dual.c -- the dual basis (eq. 3.4) of one facet from the quadrature points that cover it.

   Where only a small part of a facet is covered its shape functions are nearly dependent there. For quadratic
   ones on the share e the condition number of M_e is of the order of e^-4. But psi_i / D_i is defined by one
   property: its product with a polynomial, integrated over the covered part, is the value at the node i. This
   holds in any basis of the polynomials. In the basis L of the covered part, psi_i = D_i sum_jk L_j(node i)
   (int_cov L L^T)^-1_jk L_k. No digits are lost: L_j(node i) is a value outside of the box, large but exact.

   Beside hanging nodes, functions of the mesh are not those of the facet, and some belong to nodes outside of
   it. On the facet they span the same polynomials. The value of a polynomial at such a node is that of its
   continuation: so these functionals, too, are values at places.

   On tri6 int phi is zero at vertices, and so would be psi. There the unknowns of edges are u~_e with u_e =
   (1 - 2 a) u~_e + a (u~_v + u~_w) at the ends v and w [3]. The functions phi~ of u~ span the same
   polynomials. All of the above holds for them, with u~_i in place of the value at the node i.

   References:
     [1] B. Wohlmuth, A mortar finite element method using dual spaces for the Lagrange multiplier (2000).
     [2] T. Cichosz, M. Bischoff, Consistent treatment of boundaries with mortar contact formulations (2011).
     [3] A. Popp, B. Wohlmuth, M. W. Gee, W. A. Wall, Dual quadratic mortar finite element methods for 3D
     finite
         deformation contact, SIAM J. Sci. Comput. 34 (2012). */
#include "kernel/dense.h"
#include "kernel/dual.h"

/* Any share between 0 and 1/2 makes the integrals positive; with this one they are of similar size. */
static const PetscReal TRI6_SHARE = 1. / 5.;

PetscReal DualShare(ElementType type)
{
  return type == ELEMENT_TRI6 ? TRI6_SHARE : 0.;
}

void DualShape(ElementType type, PetscReal phi[])
{
  const PetscInt  num_vertices = ElementNumNodes(ElementLinear(type));
  const PetscReal share        = DualShare(type);

  for (PetscInt middle = num_vertices; middle < ElementNumNodes(type) && share > 0.; middle++) {
    const PetscInt *ends = ElementEdgeNodes(type, middle - num_vertices);

    for (PetscInt k = 0; k < 2; k++) phi[ends[k]] += share * phi[middle];
    phi[middle] *= 1. - 2. * share;
  }
}

/* The box around the points, as wide as they are. Returns whether it has any width in every direction. */
static PetscBool DualFindBox_Private(PetscInt dim, PetscInt num_points, const PetscReal xi[], DualBasis *basis)
{
  if (!num_points) return PETSC_FALSE;
  for (PetscInt k = 0; k < dim; k++) {
    PetscReal upper = xi[k];

    basis->lower[k] = xi[k];
    for (PetscInt q = 1; q < num_points; q++) {
      basis->lower[k] = PetscMin(basis->lower[k], xi[2 * q + k]);
      upper           = PetscMax(upper, xi[2 * q + k]);
    }
    basis->size[k] = upper - basis->lower[k];
    if (!(basis->size[k] > 0.)) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

/* L at a point. [in] xi - [ElementDim] */
static void DualLocalShape_Private(const DualBasis *basis, const PetscReal xi[], PetscReal L[])
{
  PetscReal zeta[2];

  for (PetscInt k = 0; k < ElementDim(basis->type); k++) zeta[k] = (xi[k] - basis->lower[k]) / basis->size[k];
  ElementShape(basis->type, zeta, L, NULL);
}

void DualNodesApply(PetscInt n, const DualNodes *nodes, PetscReal D[])
{
  PetscReal sums[DUAL_MAX] = {0.};

  for (PetscInt k = 0; k < n * n; k++) sums[k % n] += nodes->S[k] * D[k / n];
  for (PetscInt i = 0; i < n; i++) D[i] = sums[i];
}

/* The functionals that give u~_i, on every L. [out] C - rows, one for each i [n][n] */
static void DualFunctionals_Private(const DualBasis *basis, const DualNodes *nodes, PetscReal C[])
{
  const PetscInt  n = ElementNumNodes(basis->type), num_vertices = ElementNumNodes(ElementLinear(basis->type));
  const PetscReal share = DualShare(basis->type);

  for (PetscInt i = 0; i < n; i++)
    DualLocalShape_Private(basis, nodes ? nodes->place[i] : ElementNode(basis->type, i), &C[i * n]);
  for (PetscInt i = num_vertices; i < n && share > 0.; i++) {
    const PetscInt *ends = ElementEdgeNodes(basis->type, i - num_vertices);

    for (PetscInt j = 0; j < n; j++)
      C[i * n + j] = (C[i * n + j] - share * (C[ends[0] * n + j] + C[ends[1] * n + j])) / (1. - 2. * share);
  }
}

PetscBool DualBasisCreate(ElementType type, PetscInt num_points, const PetscReal xi[], const PetscReal w[],
                          const DualNodes *nodes, DualBasis *basis)
{
  const PetscInt n                      = ElementNumNodes(type);
  PetscReal      M[DUAL_MAX * DUAL_MAX] = {0.}, phi[DUAL_MAX];

  basis->type = type;
  for (PetscInt i = 0; i < n; i++) basis->D[i] = 0.;
  for (PetscInt q = 0; q < num_points; q++) {
    ElementShape(type, &xi[2 * q], phi, NULL);
    DualShape(type, phi);
    for (PetscInt i = 0; i < n; i++) basis->D[i] += w[q] * phi[i];
  }
  if (nodes) DualNodesApply(n, nodes, basis->D);
  if (!DualFindBox_Private(ElementDim(type), num_points, xi, basis)) return PETSC_FALSE;
  /* Full coverage and cut facets are the same case here: the points lie on what is covered [2]. */
  for (PetscInt q = 0; q < num_points; q++) {
    DualLocalShape_Private(basis, &xi[2 * q], phi);
    for (PetscInt i = 0; i < n; i++) {
      for (PetscInt j = 0; j < n; j++) M[i * n + j] += w[q] * phi[i] * phi[j];
    }
  }
  if (!DenseCholesky(n, M)) return PETSC_FALSE;
  DualFunctionals_Private(basis, nodes, basis->C);
  for (PetscInt i = 0; i < n; i++) {
    for (PetscInt j = 0; j < n; j++) basis->C[i * n + j] *= basis->D[i];
    DenseCholeskySolve(n, M, &basis->C[i * n]);
  }
  return PETSC_TRUE;
}

void DualBasisEvaluate(const DualBasis *basis, const PetscReal xi[], PetscReal psi[])
{
  const PetscInt n = ElementNumNodes(basis->type);
  PetscReal      L[DUAL_MAX];

  DualLocalShape_Private(basis, xi, L);
  for (PetscInt i = 0; i < n; i++) {
    psi[i] = 0.;
    for (PetscInt j = 0; j < n; j++) psi[i] += basis->C[i * n + j] * L[j];
  }
}

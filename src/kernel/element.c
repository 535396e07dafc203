/* element.c -- access to the table of reference cells, and the geometry of cells by loops that are the same
   for every row.

   Reference:
     [1] T. J. R. Hughes, The Finite Element Method (1987), chapter 3. */
#include "kernel/referencecell.h"
#include "kernel/vector.h"

enum { MAX_DIM = REFERENCE_MAX_DIM, NEWTON_MAX_STEPS = 25 };

static const PetscReal ELEMENT_NEWTON_STEP =
    1e-10; /* convergence is quadratic: after such a step only roundoff is left */

PetscInt ElementDim(ElementType type)
{
  return REFERENCE[type].dim;
}

PetscInt ElementOrder(ElementType type)
{
  return REFERENCE[type].order;
}

ElementType ElementLinear(ElementType type)
{
  return REFERENCE[type].linear;
}

ElementType ElementOfOrder(ElementType linear, PetscInt order)
{
  ElementType type = linear;

  for (PetscInt t = 0; t < ELEMENT_COUNT; t++) {
    if (REFERENCE[t].linear == linear && REFERENCE[t].order == order) type = (ElementType)t;
  }
  return type;
}

const PetscReal *ElementNode(ElementType type, PetscInt node)
{
  return REFERENCE[type].nodes[node];
}

PetscInt ElementNumNodes(ElementType type)
{
  return REFERENCE[type].num_nodes;
}

PetscInt ElementNumFacets(ElementType type)
{
  return REFERENCE[type].num_facets;
}

PetscInt ElementNumEdges(ElementType type)
{
  return REFERENCE[type].num_edges;
}

const PetscInt *ElementEdgeNodes(ElementType type, PetscInt edge)
{
  return REFERENCE[type].edges[edge];
}

static PetscReal ElementEdgeLength_Private(ElementType type, PetscInt dim, const PetscReal X[], PetscInt edge)
{
  const PetscInt *ends = ElementEdgeNodes(type, edge);

  return VectorDistance(dim, &X[ends[0] * dim], &X[ends[1] * dim]);
}

PetscReal ElementShortestEdge(ElementType type, PetscInt dim, const PetscReal X[])
{
  PetscReal least = PETSC_MAX_REAL;

  for (PetscInt e = 0; e < ElementNumEdges(type); e++)
    least = PetscMin(least, ElementEdgeLength_Private(type, dim, X, e));
  return least;
}

PetscReal ElementLongestEdge(ElementType type, PetscInt dim, const PetscReal X[])
{
  PetscReal most = 0;

  for (PetscInt e = 0; e < ElementNumEdges(type); e++)
    most = PetscMax(most, ElementEdgeLength_Private(type, dim, X, e));
  return most;
}

ElementType ElementFacetType(ElementType type)
{
  return REFERENCE[type].facet_type;
}

const PetscInt *ElementFacetNodes(ElementType type, PetscInt facet)
{
  return REFERENCE[type].facets[facet];
}

PetscInt ElementStiffnessDegree(ElementType type)
{
  return REFERENCE[type].stiffness_degree;
}

void ElementShape(ElementType type, const PetscReal xi[], PetscReal phi[], PetscReal dphi[])
{
  PetscReal unwanted[ELEMENT_MAX_NODES * MAX_DIM];

  REFERENCE[type].shape(xi, phi, dphi ? dphi : unwanted);
}

/* J[k][l] = d x_k / d xi_l and, where it is regular, its inverse: cofactors by det J; returns det J. */
static inline PetscReal ElementJacobian_Private(PetscInt dim, PetscInt num_nodes, const PetscReal X[],
                                                const PetscReal dphi[], PetscReal inverse[])
{
  PetscReal J[MAX_DIM * MAX_DIM] = {0.}, det = 0.;

  for (PetscInt i = 0; i < num_nodes; i++) {
    for (PetscInt k = 0; k < dim; k++) {
      for (PetscInt l = 0; l < dim; l++) J[k * dim + l] += X[i * dim + k] * dphi[i * dim + l];
    }
  }
  if (dim == 1) {
    inverse[0] = 1.;
    det        = J[0];
  } else if (dim == 2) {
    inverse[0] = J[3];
    inverse[1] = -J[1];
    inverse[2] = -J[2];
    inverse[3] = J[0];
    det        = J[0] * J[3] - J[1] * J[2];
  } else {
    for (PetscInt k = 0; k < 3; k++) {
      PetscReal cofactors[3];

      VectorCross(&J[3 * ((k + 1) % 3)], &J[3 * ((k + 2) % 3)], cofactors);
      for (PetscInt l = 0; l < 3; l++) inverse[3 * l + k] = cofactors[l];
      det += J[3 * k] * cofactors[0];
    }
  }
  if (det == 0.) return det;
  for (PetscInt k = 0; k < dim * dim; k++) inverse[k] /= det;
  return det;
}

/* ElementMap() with the shape functions and their derivatives on the reference cell. It takes most of the
   time of an assembly: to be inlined where dim is known, so that its short loops are unrolled. */
static inline PetscReal ElementMap_Private(PetscInt dim, PetscInt num_nodes, const PetscReal X[], const PetscReal phi[],
                                           const PetscReal dphi[], PetscReal x[], PetscReal grad[])
{
  PetscReal       inverse[MAX_DIM * MAX_DIM] = {0.};
  const PetscReal det                        = ElementJacobian_Private(dim, num_nodes, X, dphi, inverse);

  if (x) {
    for (PetscInt k = 0; k < dim; k++) {
      x[k] = 0.;
      for (PetscInt i = 0; i < num_nodes; i++) x[k] += phi[i] * X[i * dim + k];
    }
  }
  if (grad) { /* d phi / d x_k = sum_l d phi / d xi_l  d xi_l / d x_k */
    for (PetscInt i = 0; i < num_nodes; i++) {
      for (PetscInt k = 0; k < dim; k++) {
        grad[i * dim + k] = 0.;
        for (PetscInt l = 0; l < dim; l++) grad[i * dim + k] += dphi[i * dim + l] * inverse[l * dim + k];
      }
    }
  }
  return det;
}

static PetscReal ElementMapCell_Private(const Reference *cell, const PetscReal X[], const PetscReal phi[],
                                        const PetscReal dphi[], PetscReal x[], PetscReal grad[])
{
  const PetscInt n = cell->num_nodes;

  if (cell->dim == 1) return ElementMap_Private(1, n, X, phi, dphi, x, grad);
  return cell->dim == 2 ? ElementMap_Private(2, n, X, phi, dphi, x, grad)
                        : ElementMap_Private(3, n, X, phi, dphi, x, grad);
}

PetscReal ElementMap(ElementType type, const PetscReal X[], const PetscReal xi[], PetscReal x[], PetscReal phi[],
                     PetscReal grad[])
{
  PetscReal dphi[ELEMENT_MAX_NODES * MAX_DIM];

  REFERENCE[type].shape(xi, phi, dphi);
  return ElementMapCell_Private(&REFERENCE[type], X, phi, dphi, x, grad);
}

void ElementRuleSet(ElementType type, PetscInt degree, ElementRule *rule)
{
  const Reference *cell = &REFERENCE[type];
  const PetscInt   n    = cell->num_nodes;
  PetscReal        xi[ELEMENT_MAX_POINTS * MAX_DIM];

  rule->type = type;
  rule->num  = QuadratureRule(type, degree, xi, rule->weight);
  for (PetscInt q = 0; q < rule->num; q++)
    cell->shape(&xi[q * cell->dim], &rule->phi[q * n], &rule->dphi[q * n * cell->dim]);
}

PetscReal ElementRuleMap(const ElementRule *rule, PetscInt q, const PetscReal X[], PetscReal x[], PetscReal grad[])
{
  const Reference *cell = &REFERENCE[rule->type];
  const PetscInt   n    = cell->num_nodes;

  return ElementMapCell_Private(cell, X, &rule->phi[q * n], &rule->dphi[q * n * cell->dim], x, grad);
}

/* To be inlined where dim is known. */
static inline PetscReal ElementGradient_Private(PetscInt dim, PetscInt num_nodes, const PetscReal X[],
                                                const PetscReal v[], const PetscReal dphi[], PetscReal H[])
{
  PetscReal       inverse[MAX_DIM * MAX_DIM] = {0.}, reference[MAX_DIM * MAX_DIM] = {0.};
  const PetscReal det = ElementJacobian_Private(dim, num_nodes, X, dphi, inverse);

  for (PetscInt i = 0; i < num_nodes; i++) {
    for (PetscInt k = 0; k < dim; k++) {
      for (PetscInt l = 0; l < dim; l++) reference[k * dim + l] += v[i * dim + k] * dphi[i * dim + l];
    }
  }
  for (PetscInt k = 0; k < dim; k++) {
    for (PetscInt l = 0; l < dim; l++) {
      H[k * dim + l] = 0.;
      for (PetscInt m = 0; m < dim; m++) H[k * dim + l] += reference[k * dim + m] * inverse[m * dim + l];
    }
  }
  return det;
}

PetscReal ElementRuleGradient(const ElementRule *rule, PetscInt q, const PetscReal X[], const PetscReal v[],
                              PetscReal x[], PetscReal H[])
{
  const Reference *cell = &REFERENCE[rule->type];
  const PetscInt   n = cell->num_nodes, dim = cell->dim;
  const PetscReal *dphi = &rule->dphi[q * n * dim];

  for (PetscInt k = 0; x && k < dim; k++) {
    x[k] = 0.;
    for (PetscInt i = 0; i < n; i++) x[k] += rule->phi[q * n + i] * X[i * dim + k];
  }
  if (dim == 1) return ElementGradient_Private(1, n, X, v, dphi, H);
  return dim == 2 ? ElementGradient_Private(2, n, X, v, dphi, H) : ElementGradient_Private(3, n, X, v, dphi, H);
}

PetscReal ElementSurface(ElementType type, const PetscReal X[], const PetscReal xi[], PetscReal x[], PetscReal phi[],
                         PetscReal normal[])
{
  const Reference *facet = &REFERENCE[type];
  const PetscInt   dim   = facet->dim + 1;
  PetscReal        dphi[ELEMENT_MAX_NODES * MAX_DIM], t[2][3] = {{0.}}, n[3], measure;

  facet->shape(xi, phi, dphi);
  if (x) {
    for (PetscInt k = 0; k < dim; k++) {
      x[k] = 0.;
      for (PetscInt i = 0; i < facet->num_nodes; i++) x[k] += phi[i] * X[i * dim + k];
    }
  }
  t[1][2] = facet->dim == 1 ? 1. : 0.; /* a line in the plane stands for a strip of depth one */
  for (PetscInt l = 0; l < facet->dim; l++) {
    for (PetscInt i = 0; i < facet->num_nodes; i++) {
      for (PetscInt k = 0; k < dim; k++) t[l][k] += dphi[i * facet->dim + l] * X[i * dim + k];
    }
  }
  VectorCross(t[0], t[1], n);
  measure = VectorNorm(3, n);
  for (PetscInt k = 0; normal && k < dim; k++) normal[k] = n[k] / measure;
  return measure;
}

/* Upper bound on sum_i |d phi_i / d xi_l| in the cell. Of functions that are linear on simplices it is
   attained at a vertex. Those of boxes are products of 8, of a line, and 5/4 in each other direction. */
static PetscReal ElementSteepness_Private(const Reference *cell)
{
  if (cell->order == 1) return 2.;
  return cell->simplex ? 10. : 8. * PetscPowRealInt(1.25, (int)cell->dim - 1);
}

/* Compares with the affine cell of the first vertex and its neighbours, with axes a_l. If nodes differ by at
   most e, columns of J differ from a_l by at most e times the steepness. */
PetscReal ElementBoundJacobian(ElementType type, const PetscReal X[])
{
  const Reference *cell             = &REFERENCE[type];
  const PetscInt   dim              = cell->dim;
  PetscReal        axis[MAX_DIM][3] = {{0.}}, e = 0., lengths = 1., product = 1., normal[3], det;

  for (PetscInt i = 0; i < ElementNumNodes(cell->linear); i++) {
    PetscInt ones = 0, along = 0;

    for (PetscInt l = 0; l < dim; l++) {
      if (cell->nodes[i][l] == 1.) along = l;
      ones += cell->nodes[i][l] == 1.;
    }
    for (PetscInt k = 0; k < dim && ones == 1; k++) axis[along][k] = X[i * dim + k] - X[k];
  }
  for (PetscInt i = 0; i < cell->num_nodes; i++) {
    PetscReal square = 0.;

    for (PetscInt k = 0; k < dim; k++) {
      PetscReal off = X[i * dim + k] - X[k];

      for (PetscInt l = 0; l < dim; l++) off -= cell->nodes[i][l] * axis[l][k];
      square += off * off;
    }
    e = PetscMax(e, square);
  }
  e = PetscSqrtReal(e) * ElementSteepness_Private(cell);
  if (dim == 2) axis[2][2] = 1.;
  VectorCross(axis[1], axis[2], normal);
  det = dim == 1 ? axis[0][0] : VectorDot(3, axis[0], normal);
  for (PetscInt l = 0; l < dim; l++) {
    lengths *= VectorNorm(3, axis[l]);
    product *= VectorNorm(3, axis[l]) + e;
  }
  return det - (product - lengths);
}

/* det J of tri3 and tet4 is constant and that of quad4 is linear in xi: its extremes are at nodes. If it is
   positive at every corner, a quad is convex and runs anticlockwise. In hex8 and cells of second order the
   minimum may be anywhere. There it is taken on a lattice that contains the nodes, sides included: curved
   cells become singular there first. */
PetscReal ElementMinJacobian(ElementType type, const PetscReal X[])
{
  const Reference *cell      = &REFERENCE[type];
  const PetscInt   intervals = cell->lattice;
  PetscReal        smallest  = PETSC_MAX_REAL, phi[ELEMENT_MAX_NODES];
  PetscInt         num       = 1;

  for (PetscInt k = 0; k < cell->dim; k++) num *= intervals + 1;
  for (PetscInt i = 0; i < num; i++) {
    PetscReal xi[MAX_DIM], sum = 0.;
    PetscInt  digits = i;

    for (PetscInt k = 0; k < cell->dim; k++) {
      xi[k] = (PetscReal)(digits % (intervals + 1)) / intervals;
      sum += xi[k];
      digits /= intervals + 1;
    }
    if (cell->simplex && sum > 1. + PETSC_SMALL) continue;
    smallest = PetscMin(smallest, ElementMap(type, X, xi, NULL, phi, NULL));
  }
  return smallest;
}

void ElementStrainMatrix(PetscInt dim, PetscInt num_nodes, const PetscReal grad[], const PetscReal hoop[],
                         PetscReal B[])
{
  static const PetscInt shear_2d[1][2] = {{0, 1}}, shear_3d[3][2] = {{1, 2}, {0, 2}, {0, 1}};
  const PetscInt        num_shear = dim == 2 ? 1 : 3, num_direct = dim + (hoop ? 1 : 0), row = num_nodes * dim;
  const PetscInt(*shear)[2] = dim == 2 ? shear_2d : shear_3d;

  for (PetscInt k = 0; k < (num_direct + num_shear) * row; k++) B[k] = 0.;
  for (PetscInt i = 0; i < num_nodes; i++) {
    const PetscReal *d = &grad[i * dim];

    for (PetscInt k = 0; k < dim; k++) B[k * row + i * dim + k] = d[k];
    if (hoop) B[dim * row + i * dim] = hoop[i];
    for (PetscInt s = 0; s < num_shear; s++) { /* gamma_kl = d u_k / d x_l + d u_l / d x_k */
      const PetscInt k = shear[s][0], l = shear[s][1];

      B[(num_direct + s) * row + i * dim + k] = d[l];
      B[(num_direct + s) * row + i * dim + l] = d[k];
    }
  }
}

/* Whether xi lies in the reference cell, enlarged by the tolerance. */
static PetscBool ElementIsInside_Private(const Reference *cell, const PetscReal xi[], PetscReal tolerance)
{
  PetscReal sum = 0.;

  for (PetscInt k = 0; k < cell->dim; k++) {
    if (!(xi[k] >= -tolerance && xi[k] <= 1. + tolerance)) return PETSC_FALSE;
    sum += xi[k];
  }
  return !cell->simplex || sum <= 1. + tolerance ? PETSC_TRUE : PETSC_FALSE;
}

/* Newton's method for x(xi) = x from the start xi. Returns whether it converged. After a step of
   ELEMENT_NEWTON_STEP only roundoff is left. In needles of 1 : 1000 this is more than the last digits, so
   that a smaller bound may be out of reach. */
static PetscBool ElementNewton_Private(const Reference *cell, const PetscReal X[], const PetscReal x[], PetscReal xi[])
{
  const PetscInt dim  = cell->dim;
  PetscReal      step = PETSC_MAX_REAL;

  for (PetscInt it = 0; it < NEWTON_MAX_STEPS && step > ELEMENT_NEWTON_STEP; it++) {
    PetscReal dphi[ELEMENT_MAX_NODES * MAX_DIM], phi[ELEMENT_MAX_NODES], inverse[MAX_DIM * MAX_DIM], r[MAX_DIM];

    cell->shape(xi, phi, dphi);
    if (ElementJacobian_Private(dim, cell->num_nodes, X, dphi, inverse) == 0.)
      return PETSC_FALSE; /* flat, or far outside */
    for (PetscInt k = 0; k < dim; k++) {
      r[k] = x[k];
      for (PetscInt i = 0; i < cell->num_nodes; i++) r[k] -= phi[i] * X[i * dim + k];
    }
    step = 0.;
    for (PetscInt k = 0; k < dim; k++) {
      const PetscReal before = xi[k];

      for (PetscInt l = 0; l < dim; l++) xi[k] += inverse[k * dim + l] * r[l];
      step = PetscMax(step, PetscAbsReal(xi[k] - before));
    }
  }
  return step <= ELEMENT_NEWTON_STEP ? PETSC_TRUE : PETSC_FALSE;
}

/* Newton takes one step in a simplex. From the middle of a convex quad it finds every point inside; failure
   for a point outside is the right answer. In a cell with curved sides, hex8 among them, it may converge to a
   root outside. Then the search is repeated from every node, one of which is near enough. */
PetscBool ElementLocate(ElementType type, const PetscReal X[], const PetscReal x[], PetscReal tolerance, PetscReal xi[])
{
  const Reference *cell       = &REFERENCE[type];
  const PetscInt   num_starts = cell->lattice > 1 ? cell->num_nodes : 0;

  for (PetscInt i = -1; i < num_starts; i++) {
    for (PetscInt k = 0; k < cell->dim; k++)
      xi[k] = i >= 0 ? cell->nodes[i][k] : (cell->simplex ? 1. / (1. + cell->dim) : 0.5);
    if (ElementNewton_Private(cell, X, x, xi) && ElementIsInside_Private(cell, xi, tolerance)) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

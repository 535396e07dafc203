/* element.h -- shape functions, quadrature and cell stiffness.

   Plain tables and loops: no MPI, no objects, nothing allocated. Reference cells are PETSc's order of
   vertices: line2 on [0,1]; tri3 (0,0),(1,0),(0,1); quad4 (0,0),(1,0),(1,1),(0,1) on [0,1]^2; tet4 the corner
   of the unit cube; hex8 the quad4 below (z = 0), then above (z = 1). 2D cells run anticlockwise; so do the
   facets of 3D cells seen from outside. Cells of second order have, behind their vertices, a node in the
   middle of each edge, in the order of the edges. hex27 then has one in the middle of each facet. line3,
   quad9 and hex27 have one in their own middle, which a line shares with its edge. Sides may be curved: the
   geometry is isoparametric. */
#ifndef MORTISE_ELEMENT_H
#define MORTISE_ELEMENT_H

#include <petscsys.h>

typedef enum {
  ELEMENT_LINE2,
  ELEMENT_TRI3,
  ELEMENT_QUAD4,
  ELEMENT_TET4,
  ELEMENT_HEX8,
  ELEMENT_LINE3,
  ELEMENT_TRI6,
  ELEMENT_QUAD9,
  ELEMENT_TET10,
  ELEMENT_HEX27,
  ELEMENT_COUNT
} ElementType;

enum {
  ELEMENT_MAX_NODES       = 27, /* of a cell */
  ELEMENT_MAX_FACET_NODES = 9,  /* of a facet */
  ELEMENT_MAX_POINTS      = 252 /* of a quadrature rule: 6 x 6 x 7 */
};

/* Reference dimension, nodes, facets, and the type of each facet. Not collective. */
PetscInt    ElementDim(ElementType type);
PetscInt    ElementNumNodes(ElementType type);
PetscInt    ElementNumFacets(ElementType type);
ElementType ElementFacetType(ElementType type);
/* Polynomial order, 1 or 2; the cell of order 1 with the same vertices (whose number is ElementNumNodes() of
   it); and the other way round. Not collective. */
PetscInt    ElementOrder(ElementType type);
ElementType ElementLinear(ElementType type);
ElementType ElementOfOrder(ElementType linear, PetscInt order);
/* Reference coordinates of a node, [ElementDim]; borrowed. */
const PetscReal *ElementNode(ElementType type, PetscInt node);
/* Local node numbers of one facet in the order of its type: the normal of ElementSurface() is outward, in 2D
   (dy, -dx) along the facet. Not collective. Borrowed. */
const PetscInt *ElementFacetNodes(ElementType type, PetscInt facet);

/* Edges: the facets of a plane cell, a line's only one. The cell's local numbers of an edge's two vertices.
   The node in its middle, in cells of second order, is the edge's number behind the vertices. Not
   collective. */
PetscInt        ElementNumEdges(ElementType type);
const PetscInt *ElementEdgeNodes(ElementType type, PetscInt edge);
/* Distances of the ends of edges. Not collective. [in] X - [num_nodes][dim] */
PetscReal ElementShortestEdge(ElementType type, PetscInt dim, const PetscReal X[]);
PetscReal ElementLongestEdge(ElementType type, PetscInt dim, const PetscReal X[]);
/* Distances of the ends of edges. Not collective. [in] X - [num_nodes][dim] */
PetscReal ElementShortestEdge(ElementType type, PetscInt dim, const PetscReal X[]);
PetscReal ElementLongestEdge(ElementType type, PetscInt dim, const PetscReal X[]);

/* phi = shape functions at xi; dphi[i][k] = d phi_i / d xi_k (dphi may be NULL).
   [in] xi - array of shape [ElementDim]; [out] phi - [num_nodes]; [out] dphi - [num_nodes][ElementDim] */
void ElementShape(ElementType type, const PetscReal xi[], PetscReal phi[], PetscReal dphi[]);

/* A rule on the reference cell that is exact for polynomials up to degree (tensor degree on quads and hexes).
   Highest degree: 15 on lines and quads, 14 on triangles, 11 on hexes, 10 on tets. Returns n, 0 beyond.
   [out] points - [n][ElementDim]; [out] weights - [n], summing to the reference measure */
PetscInt QuadratureRule(ElementType type, PetscInt degree, PetscReal points[], PetscReal weights[]);

/* n Gauss-Legendre points on [0,1], n = 1..8, 12 or 16: exact to degree 2n-1. Returns n. */
PetscInt QuadratureLine(PetscInt n, PetscReal points[], PetscReal weights[]);

/* Geometry at xi of a cell with nodes at X: x and the gradients d phi_i / d x_k (either may be NULL); returns
   det J.
   [in] X - [num_nodes][dim], dim = ElementDim; [out] x - [dim]; [out] phi - [num_nodes];
   [out] grad - [num_nodes][dim] */
PetscReal ElementMap(ElementType type, const PetscReal X[], const PetscReal xi[], PetscReal x[], PetscReal phi[],
                     PetscReal grad[]);

/* The same for a facet in ElementDim + 1 dimensions: x, the shape functions and the unit normal. It is
   outward with nodes in the order of ElementFacetNodes(). Returns |dx/dxi|, the ratio of measures. Not
   collective.
   [in] X - [num_nodes][dim];
   [out] x - [dim], may be NULL; [out] phi - [num_nodes]; [out] normal - [dim], may be NULL */
PetscReal ElementSurface(ElementType type, const PetscReal X[], const PetscReal xi[], PetscReal x[], PetscReal phi[],
                         PetscReal normal[]);

/* A part of a reference cell, an affine image of it: xi = origin + sum_k xi'_k axes_k with xi' in the
   reference cell. */
typedef struct {
  PetscReal origin[3], axes[3][3];
  PetscReal size;    /* of the whole cell: 1, 1/2, 1/4, ... */
  PetscReal measure; /* of the whole cell's measure */
} CellPiece;

enum { ELEMENT_MAX_PIECES = 8 };

/* The whole cell as a piece. */
CellPiece CellPieceWhole(void);
/* xi of a point xi' of the piece, [ElementDim] each. */
void CellPiecePoint(ElementType type, const CellPiece *piece, const PetscReal inside[], PetscReal xi[]);
/* Cuts a piece of a 2D or 3D cell through the middles of its edges into parts of equal measure; returns their
   number. Triangles and boxes fall into parts like themselves; of a tetrahedron its corners are cut off, and
   what is left is cut along a diagonal. [out] parts - [ELEMENT_MAX_PIECES] */
PetscInt CellPieceCut(ElementType type, const CellPiece *piece, CellPiece parts[]);

/* A rule on the reference cell with the shape functions at its points, the same for all cells. */
typedef struct {
  ElementType type;
  PetscInt    num;                                              /* points */
  PetscReal   weight[ELEMENT_MAX_POINTS];                       /* [num] */
  PetscReal   phi[ELEMENT_MAX_POINTS * ELEMENT_MAX_NODES];      /* [num][num_nodes] */
  PetscReal   dphi[ELEMENT_MAX_POINTS * ELEMENT_MAX_NODES * 3]; /* [num][num_nodes][ElementDim] */
} ElementRule;

/* As QuadratureRule(); num is 0 beyond the highest degree. */
void ElementRuleSet(ElementType type, PetscInt degree, ElementRule *rule);
/* ElementMap() at point q; x and grad may be NULL. */
PetscReal ElementRuleMap(const ElementRule *rule, PetscInt q, const PetscReal X[], PetscReal x[], PetscReal grad[]);

/* Gradient of a displacement at point q, H[k][l] = d v_k / d x_l; returns det J. Cheaper than the gradients
   of all shape functions.
   [in] v - at the nodes [num_nodes][dim]; [out] x - [dim], may be NULL; [out] H - [dim][dim] */
PetscReal ElementRuleGradient(const ElementRule *rule, PetscInt q, const PetscReal X[], const PetscReal v[],
                              PetscReal x[], PetscReal H[]);

/* A lower bound on det J in the cell: near it where the cell is nearly affine, far below, even negative,
   where it is not. */
PetscReal ElementBoundJacobian(ElementType type, const PetscReal X[]);
/* Smallest det J in the cell: <= 0 for a degenerate or tangled one. In hex8 and cells of second order it is
   the smallest on a lattice that holds the nodes. */
PetscReal ElementMinJacobian(ElementType type, const PetscReal X[]);

/* Finds xi with x(xi) = x by Newton; returns whether x lies in the cell to within tolerance (relative to the
   cell). xi is of no use outside. [in] X - [num_nodes][dim]; [in] x - [dim]; [out] xi - [dim] */
PetscBool ElementLocate(ElementType type, const PetscReal X[], const PetscReal x[], PetscReal tolerance,
                        PetscReal xi[]);

/* Strain-displacement matrix at a point, engineering shear, rows (xx,yy,xy) in 2D, (xx,yy,zz,yz,xz,xy) in 3D.
   Axisymmetric cells have (xx,yy,zz,xy), zz = sum_i phi_i / r u_i,x around the axis.
   [in] grad - [num_nodes][dim]; [in] hoop - phi_i / r [num_nodes], NULL unless axisymmetric;
   [out] B - [num_strains][num_nodes*dim] */
void ElementStrainMatrix(PetscInt dim, PetscInt num_nodes, const PetscReal grad[], const PetscReal hoop[],
                         PetscReal B[]);

/* The degree of quadrature for the stiffness, exact on affine and parallelogram cells. Its points are 2 in
   each direction for quad4 and hex8, 3 for quad9 and hex27. For tri3 and tet4 it has 1, for tri6 6, for tet10
   8. */
PetscInt ElementStiffnessDegree(ElementType type);

#endif

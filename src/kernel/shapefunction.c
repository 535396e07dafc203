/* shapefunction.c -- shape functions of the reference cells: Lagrange polynomials of their nodes. */
#include "kernel/shapefunction.h"

void ShapeFunctionLine2(const PetscReal xi[], PetscReal phi[], PetscReal dphi[])
{
  phi[0]  = 1. - xi[0];
  phi[1]  = xi[0];
  dphi[0] = -1.;
  dphi[1] = 1.;
}

/* Ends, then the middle. */
void ShapeFunctionLine3(const PetscReal xi[], PetscReal phi[], PetscReal dphi[])
{
  const PetscReal s = xi[0];

  phi[0]  = (1. - s) * (1. - 2. * s);
  phi[1]  = s * (2. * s - 1.);
  phi[2]  = 4. * s * (1. - s);
  dphi[0] = 4. * s - 3.;
  dphi[1] = 4. * s - 1.;
  dphi[2] = 4. - 8. * s;
}

void ShapeFunctionTri3(const PetscReal xi[], PetscReal phi[], PetscReal dphi[])
{
  phi[0]  = 1. - xi[0] - xi[1];
  phi[1]  = xi[0];
  phi[2]  = xi[1];
  dphi[0] = dphi[1] = -1.;
  dphi[2] = dphi[5] = 1.;
  dphi[3] = dphi[4] = 0.;
}

void ShapeFunctionTet4(const PetscReal xi[], PetscReal phi[], PetscReal dphi[])
{
  phi[0] = 1. - xi[0] - xi[1] - xi[2];
  for (PetscInt k = 0; k < 3; k++) {
    phi[1 + k] = xi[k];
    dphi[k]    = -1.;
    for (PetscInt l = 0; l < 3; l++) dphi[3 * (1 + k) + l] = k == l ? 1. : 0.;
  }
}

/* In barycentric coordinates l: l_i (2 l_i - 1) at vertices, 4 l_i l_j in the middles of edges.
   [in] edge - [][2] */
static void ShapeFunctionSimplex_Private(PetscInt dim, PetscInt num_edges, const PetscInt edge[][2],
                                         const PetscReal l[], const PetscReal dl[], PetscReal phi[], PetscReal dphi[])
{
  for (PetscInt i = 0; i <= dim; i++) {
    phi[i] = l[i] * (2. * l[i] - 1.);
    for (PetscInt k = 0; k < dim; k++) dphi[dim * i + k] = (4. * l[i] - 1.) * dl[dim * i + k];
  }
  for (PetscInt e = 0; e < num_edges; e++) {
    const PetscInt i = edge[e][0], j = edge[e][1], node = dim + 1 + e;

    phi[node] = 4. * l[i] * l[j];
    for (PetscInt k = 0; k < dim; k++) dphi[dim * node + k] = 4. * (l[i] * dl[dim * j + k] + l[j] * dl[dim * i + k]);
  }
}

void ShapeFunctionTri6(const PetscReal xi[], PetscReal phi[], PetscReal dphi[])
{
  static const PetscInt edge[3][2] = {{0, 1}, {1, 2}, {2, 0}};
  PetscReal             l[3], dl[6];

  ShapeFunctionTri3(xi, l, dl);
  ShapeFunctionSimplex_Private(2, 3, edge, l, dl, phi, dphi);
}

void ShapeFunctionTet10(const PetscReal xi[], PetscReal phi[], PetscReal dphi[])
{
  static const PetscInt edge[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  PetscReal             l[4], dl[12];

  ShapeFunctionTet4(xi, l, dl);
  ShapeFunctionSimplex_Private(3, 6, edge, l, dl, phi, dphi);
}

/* Products phi_a(x) phi_b(y) of the line's functions. [in] node - a, b of every node [num_nodes][2] */
static void ShapeFunctionProduct_Private(ShapeFn *line, PetscInt num_nodes, const PetscInt node[][2],
                                         const PetscReal xi[], PetscReal phi[], PetscReal dphi[])
{
  PetscReal x[3], y[3], dx[3], dy[3];

  line(&xi[0], x, dx);
  line(&xi[1], y, dy);
  for (PetscInt i = 0; i < num_nodes; i++) {
    const PetscInt a = node[i][0], b = node[i][1];

    phi[i]          = x[a] * y[b];
    dphi[2 * i]     = dx[a] * y[b];
    dphi[2 * i + 1] = x[a] * dy[b];
  }
}

void ShapeFunctionQuad4(const PetscReal xi[], PetscReal phi[], PetscReal dphi[])
{
  static const PetscInt node[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

  ShapeFunctionProduct_Private(ShapeFunctionLine2, 4, node, xi, phi, dphi);
}

void ShapeFunctionQuad9(const PetscReal xi[], PetscReal phi[], PetscReal dphi[])
{
  static const PetscInt node[9][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}, {1, 2}, {2, 1}, {0, 2}, {2, 2}};

  ShapeFunctionProduct_Private(ShapeFunctionLine3, 9, node, xi, phi, dphi);
}

/* Products phi_a(x) phi_b(y) phi_c(z) of the line's functions.
   [in] node - a, b, c of every node [num_nodes][3] */
static void ShapeFunctionProduct3_Private(ShapeFn *line, PetscInt num_nodes, const PetscInt node[][3],
                                          const PetscReal xi[], PetscReal phi[], PetscReal dphi[])
{
  PetscReal x[3], y[3], z[3], dx[3], dy[3], dz[3];

  line(&xi[0], x, dx);
  line(&xi[1], y, dy);
  line(&xi[2], z, dz);
  for (PetscInt i = 0; i < num_nodes; i++) {
    const PetscInt a = node[i][0], b = node[i][1], c = node[i][2];

    phi[i]          = x[a] * y[b] * z[c];
    dphi[3 * i]     = dx[a] * y[b] * z[c];
    dphi[3 * i + 1] = x[a] * dy[b] * z[c];
    dphi[3 * i + 2] = x[a] * y[b] * dz[c];
  }
}

void ShapeFunctionHex8(const PetscReal xi[], PetscReal phi[], PetscReal dphi[])
{
  static const PetscInt node[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                      {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

  ShapeFunctionProduct3_Private(ShapeFunctionLine2, 8, node, xi, phi, dphi);
}

/* Vertices; edges of the lower and the upper facet, then upright ones; facets below, above, in front, right,
   back, left. */
void ShapeFunctionHex27(const PetscReal xi[], PetscReal phi[], PetscReal dphi[])
{
  static const PetscInt node[27][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1},
                                       {0, 1, 1}, {2, 0, 0}, {1, 2, 0}, {2, 1, 0}, {0, 2, 0}, {2, 0, 1}, {1, 2, 1},
                                       {2, 1, 1}, {0, 2, 1}, {0, 0, 2}, {1, 0, 2}, {1, 1, 2}, {0, 1, 2}, {2, 2, 0},
                                       {2, 2, 1}, {2, 0, 2}, {1, 2, 2}, {2, 1, 2}, {0, 2, 2}, {2, 2, 2}};

  ShapeFunctionProduct3_Private(ShapeFunctionLine3, 27, node, xi, phi, dphi);
}

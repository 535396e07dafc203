/* shape.c -- shape functions of the reference cells: Lagrange polynomials of their nodes. */
#include "shape.h"

void ShapeLine2(const PetscReal xi[], PetscReal phi[], PetscReal dphi[])
{
  phi[0]  = 1. - xi[0];
  phi[1]  = xi[0];
  dphi[0] = -1.;
  dphi[1] = 1.;
}

/* Ends, then the middle. */
void ShapeLine3(const PetscReal xi[], PetscReal phi[], PetscReal dphi[])
{
  const PetscReal s = xi[0];

  phi[0]  = (1. - s) * (1. - 2. * s);
  phi[1]  = s * (2. * s - 1.);
  phi[2]  = 4. * s * (1. - s);
  dphi[0] = 4. * s - 3.;
  dphi[1] = 4. * s - 1.;
  dphi[2] = 4. - 8. * s;
}

void ShapeTri3(const PetscReal xi[], PetscReal phi[], PetscReal dphi[])
{
  phi[0]  = 1. - xi[0] - xi[1];
  phi[1]  = xi[0];
  phi[2]  = xi[1];
  dphi[0] = dphi[1] = -1.;
  dphi[2] = dphi[5] = 1.;
  dphi[3] = dphi[4] = 0.;
}

/* In barycentric coordinates l: l_i (2 l_i - 1) at vertices, 4 l_i l_j in the middles of edges. */
void ShapeTri6(const PetscReal xi[], PetscReal phi[], PetscReal dphi[])
{
  PetscReal l[3], dl[6];

  ShapeTri3(xi, l, dl);
  for (PetscInt i = 0; i < 3; i++) {
    const PetscInt j = (i + 1) % 3;

    phi[i]     = l[i] * (2. * l[i] - 1.);
    phi[3 + i] = 4. * l[i] * l[j];
    for (PetscInt k = 0; k < 2; k++) {
      dphi[2 * i + k]       = (4. * l[i] - 1.) * dl[2 * i + k];
      dphi[2 * (3 + i) + k] = 4. * (l[i] * dl[2 * j + k] + l[j] * dl[2 * i + k]);
    }
  }
}

/* Products phi_a(x) phi_b(y) of the line's functions. [in] node - a, b of every node [num_nodes][2] */
static void Product_Private(ShapeFn *line, PetscInt num_nodes, const PetscInt node[][2], const PetscReal xi[],
                            PetscReal phi[], PetscReal dphi[])
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

void ShapeQuad4(const PetscReal xi[], PetscReal phi[], PetscReal dphi[])
{
  static const PetscInt node[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

  Product_Private(ShapeLine2, 4, node, xi, phi, dphi);
}

void ShapeQuad9(const PetscReal xi[], PetscReal phi[], PetscReal dphi[])
{
  static const PetscInt node[9][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}, {1, 2}, {2, 1}, {0, 2}, {2, 2}};

  Product_Private(ShapeLine3, 9, node, xi, phi, dphi);
}

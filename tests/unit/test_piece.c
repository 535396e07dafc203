/* test_piece.c -- parts of reference cells: together they are the cell, and no part of it twice. */
#include "kernel/element.h"
#include <test.h>

static const PetscReal EXACT = 1e-13;

enum { MAX_DIM = 3, DEPTH = 2, DEGREE = 7 };

static const ElementType TYPES[] = {ELEMENT_TRI3, ELEMENT_QUAD4, ELEMENT_TET4,  ELEMENT_HEX8,
                                    ELEMENT_TRI6, ELEMENT_QUAD9, ELEMENT_TET10, ELEMENT_HEX27};

/* A polynomial of degree 7 without symmetries. */
static PetscReal Polynomial(PetscInt dim, const PetscReal xi[])
{
  static const PetscReal slope[] = {1.3, -0.7, 2.1};
  PetscReal              sum     = 0.4;

  for (PetscInt k = 0; k < dim; k++) sum += slope[k] * xi[k];
  return PetscPowRealInt(sum, DEGREE);
}

/* int polynomial over a piece, and its measure, cut to a depth. */
static void Integrate(ElementType type, const CellPiece *piece, PetscInt depth, PetscReal *integral, PetscReal *size)
{
  const PetscInt dim = ElementDim(type);
  PetscReal      points[MAX_DIM * ELEMENT_MAX_POINTS], weights[ELEMENT_MAX_POINTS], xi[MAX_DIM];
  const PetscInt num = QuadratureRule(type, DEGREE, points, weights);
  CellPiece      parts[ELEMENT_MAX_PIECES];

  if (depth) {
    const PetscInt num_parts = CellPieceCut(type, piece, parts);

    CHECK(num_parts == 1 << dim);
    for (PetscInt i = 0; i < num_parts; i++) Integrate(type, &parts[i], depth - 1, integral, size);
    return;
  }
  CHECK_NEAR(piece->size, PetscPowReal(piece->measure, 1. / dim), EXACT);
  for (PetscInt q = 0; q < num; q++) {
    PetscReal sum = 0.;

    CellPiecePoint(type, piece, &points[q * dim], xi);
    for (PetscInt k = 0; k < dim; k++) {
      CHECK(xi[k] > 0. && xi[k] < 1.);
      sum += xi[k];
    }
    CHECK(sum < 1. || ElementNumNodes(ElementLinear(type)) > dim + 1);
    *integral += weights[q] * piece->measure * Polynomial(dim, xi);
    *size += weights[q] * piece->measure;
  }
}

/* Parts that overlapped or left something out could not give the same integral. */
int main(int argc, char **argv)
{
  const CellPiece whole = CellPieceWhole();

  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (size_t t = 0; t < PETSC_STATIC_ARRAY_LENGTH(TYPES); t++) {
    PetscReal expected = 0., full = 0.;

    Integrate(TYPES[t], &whole, 0, &expected, &full);
    for (PetscInt depth = 1; depth <= DEPTH; depth++) {
      PetscReal integral = 0., size = 0.;

      Integrate(TYPES[t], &whole, depth, &integral, &size);
      CHECK_NEAR(size / full, 1., EXACT);
      CHECK_NEAR(integral / expected, 1., EXACT);
    }
  }
  PetscCall(PetscFinalize());
  return 0;
}

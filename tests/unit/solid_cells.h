/* solid_cells.h -- random cells in space, and what is known of them, for the tests of elements. */
#ifndef MORTISE_SOLID_CELLS_H
#define MORTISE_SOLID_CELLS_H

#include "kernel/element.h"

#include "uniform.h"

static const PetscReal EXACT = 1e-13;

enum { NUM_TRIALS = 200, DIM = 3, NUM_TYPES = 4, NUM_STRAINS = 6, MAX_DOFS = ELEMENT_MAX_NODES * DIM };

static const ElementType TYPES[NUM_TYPES] = {ELEMENT_TET4, ELEMENT_HEX8, ELEMENT_TET10, ELEMENT_HEX27};

static inline PetscBool IsTetrahedron(ElementType type)
{
  return ElementLinear(type) == ELEMENT_TET4 ? PETSC_TRUE : PETSC_FALSE;
}

static inline void RandomPoint(ElementType type, PetscReal xi[])
{
  do {
    for (PetscInt k = 0; k < DIM; k++) xi[k] = Uniform(0., 1.);
  } while (IsTetrahedron(type) && xi[0] + xi[1] + xi[2] > 1.);
}

/* Three orthonormal rows, right-handed. */
static inline void RandomRotation(PetscReal Q[])
{
  const PetscReal a = Uniform(0., 6.), b = Uniform(0., 3.), c = Uniform(0., 6.);
  const PetscReal ca = PetscCosReal(a), sa = PetscSinReal(a), cb = PetscCosReal(b), sb = PetscSinReal(b);
  const PetscReal cc = PetscCosReal(c), sc = PetscSinReal(c);
  const PetscReal rows[] = {ca * cc - sa * cb * sc,
                            -ca * sc - sa * cb * cc,
                            sa * sb,
                            sa * cc + ca * cb * sc, //
                            -sa * sc + ca * cb * cc,
                            -ca * sb,
                            sb * sc,
                            sb * cc,
                            cb};

  for (PetscInt i = 0; i < 9; i++) Q[i] = rows[i];
}

/* The reference cell with its vertices shaken, what lies between them bent, stretched and turned, but not tangled. */
static inline void RandomCell(ElementType type, PetscReal decades, PetscReal X[])
{
  const ElementType linear = ElementLinear(type);
  PetscReal         stretch;

  do {
    PetscReal vertices[8 * DIM], Q[9];

    stretch = PetscPowReal(10., Uniform(-decades, decades));
    RandomRotation(Q);
    for (PetscInt i = 0; i < ElementNumNodes(linear) * DIM; i++)
      vertices[i] = ElementNode(type, i / DIM)[i % DIM] + Uniform(-0.2, 0.2);
    for (PetscInt i = 0; i < ElementNumNodes(type); i++) {
      PetscReal x[DIM], phi[ELEMENT_MAX_NODES];

      ElementMap(linear, vertices, ElementNode(type, i), x, phi, NULL);
      for (PetscInt k = 0; k < DIM && i >= ElementNumNodes(linear); k++) x[k] += Uniform(-0.04, 0.04);
      x[2] *= stretch;
      for (PetscInt k = 0; k < DIM; k++) X[DIM * i + k] = Q[3 * k] * x[0] + Q[3 * k + 1] * x[1] + Q[3 * k + 2] * x[2];
    }
  } while (ElementMinJacobian(type, X) < 0.05 * stretch);
}

/* Nodes of one facet. [out] Y - [num_nodes][3] */
static inline void ContactFacetCoordinates(ElementType type, PetscInt facet, const PetscReal X[], PetscReal Y[])
{
  const PetscInt *nodes = ElementFacetNodes(type, facet);

  for (PetscInt i = 0; i < DIM * ElementNumNodes(ElementFacetType(type)); i++) Y[i] = X[DIM * nodes[i / DIM] + i % DIM];
}

/* Volume by Gauss's theorem from the facets alone, where int n must vanish. */
static inline PetscReal Volume(ElementType type, const PetscReal X[])
{
  const ElementType facet  = ElementFacetType(type);
  PetscReal         volume = 0., closed[DIM] = {0.}, points[2 * ELEMENT_MAX_POINTS], weights[ELEMENT_MAX_POINTS];
  const PetscInt    num_points = QuadratureRule(facet, 7, points, weights);

  for (PetscInt f = 0; f < ElementNumFacets(type); f++) {
    PetscReal Y[DIM * ELEMENT_MAX_FACET_NODES];

    ContactFacetCoordinates(type, f, X, Y);
    for (PetscInt q = 0; q < num_points; q++) {
      PetscReal       x[DIM], n[DIM], phi[ELEMENT_MAX_NODES];
      const PetscReal ds = weights[q] * ElementSurface(facet, Y, &points[2 * q], x, phi, n);

      CHECK_NEAR(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1., EXACT);
      volume += ds * (x[0] * n[0] + x[1] * n[1] + x[2] * n[2]) / DIM;
      for (PetscInt k = 0; k < DIM; k++) closed[k] += ds * n[k];
    }
  }
  for (PetscInt k = 0; k < DIM; k++) CHECK_NEAR(closed[k], 0., EXACT);
  return volume;
}

#endif

/* plane_cells.h -- random cells of the plane, and what is known of them, for the tests of elements. */
#ifndef MORTISE_PLANE_CELLS_H
#define MORTISE_PLANE_CELLS_H

#include "kernel/element.h"

#include "uniform.h"

static const PetscReal EXACT = 1e-13;

enum { NUM_TRIALS = 500, MAX_DIM = 2, MAX_DOFS = ELEMENT_MAX_NODES * MAX_DIM, NUM_STRAINS = 3 };

/* A point of the reference cell. */
static inline void RandomPoint(ElementType type, PetscReal xi[])
{
  do {
    for (PetscInt k = 0; k < ElementDim(type); k++) xi[k] = Uniform(0., 1.);
  } while (ElementLinear(type) == ELEMENT_TRI3 && xi[0] + xi[1] > 1.);
}

/* Puts the middles of facets near the middles of the chords, and that of a cell near the mean of its vertices. Sides are
   then curved by up to bend, in parts of a side. */
static inline void BendSides(ElementType type, PetscReal bend, PetscReal X[])
{
  const PetscInt dim = ElementDim(type), num_vertices = ElementNumNodes(ElementLinear(type));

  for (PetscInt i = num_vertices; i < ElementNumNodes(type); i++) {
    const PetscInt facet      = i - num_vertices;
    const PetscInt whole      = dim == 1 || facet == ElementNumFacets(type); /* the mean of all vertices */
    const PetscInt num_around = whole ? num_vertices : 2;

    for (PetscInt k = 0; k < dim; k++) {
      X[i * dim + k] = Uniform(-bend, bend);
      for (PetscInt j = 0; j < num_around; j++) {
        const PetscInt vertex = whole ? j : ElementFacetNodes(type, facet)[j];

        X[i * dim + k] += X[vertex * dim + k] / num_around;
      }
    }
  }
}

/* The reference cell with its vertices shaken, its sides bent, turned and stretched up to 10^decades times, but not
   tangled. */
static inline void RandomCell(ElementType type, PetscReal decades, PetscReal X[])
{
  const PetscInt  dim  = ElementDim(type);
  const PetscReal bend = 0.1;
  PetscReal       stretch, turn;

  do {
    stretch = PetscPowReal(10., Uniform(-decades, decades));
    turn    = Uniform(0., 2. * PETSC_PI);
    for (PetscInt i = 0; i < ElementNumNodes(ElementLinear(type)); i++) {
      for (PetscInt k = 0; k < dim; k++) X[i * dim + k] = ElementNode(type, i)[k] + Uniform(-0.4, 0.4);
    }
    BendSides(type, bend, X);
    for (PetscInt i = 0; i < ElementNumNodes(type) && dim == 2; i++) {
      const PetscReal x = X[2 * i], y = stretch * X[2 * i + 1];

      X[2 * i]     = PetscCosReal(turn) * x - PetscSinReal(turn) * y;
      X[2 * i + 1] = PetscSinReal(turn) * x + PetscCosReal(turn) * y;
    }
  } while (ElementMinJacobian(type, X) < 0.05 * (dim == 2 ? stretch : 1.));
}

/* The area inside a polygon run anticlockwise. */
static inline PetscReal PolygonArea(PetscInt n, const PetscReal X[])
{
  PetscReal area = 0.;

  for (PetscInt i = 0; i < n; i++) {
    const PetscReal *a = &X[2 * i], *b = &X[2 * ((i + 1) % n)];

    area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
  }
  return area;
}

/* The area of a cell: that of the polygon of its vertices and, by Archimedes, 4/3 of the triangle of end, middle and end
   for every side that is a parabola. */
static inline PetscReal CellArea(ElementType type, const PetscReal X[])
{
  PetscReal area = PolygonArea(ElementNumNodes(ElementLinear(type)), X);

  for (PetscInt f = 0; f < ElementNumFacets(type) && ElementOrder(type) == 2; f++) {
    const PetscInt *nodes = ElementFacetNodes(type, f);
    PetscReal       triangle[6];

    for (PetscInt k = 0; k < 2; k++) {
      triangle[k]     = X[2 * nodes[0] + k];
      triangle[2 + k] = X[2 * nodes[2] + k];
      triangle[4 + k] = X[2 * nodes[1] + k];
    }
    area += 4. / 3. * PolygonArea(3, triangle);
  }
  return area;
}

#endif

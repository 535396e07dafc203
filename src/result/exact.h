/* exact.h -- values and gradients of an exact solution in a cell. */
#ifndef MORTISE_EXACT_H
#define MORTISE_EXACT_H

#include "kernel/element.h"
#include "base/expression.h"

/* A point of a cell. */
typedef struct {
  ElementType      type;
  const PetscReal *X;    /* [num_nodes][dim] */
  const PetscReal *xi;   /* [dim] */
  const PetscReal *grad; /* of the shape functions there, by ElementMap() [num_nodes][dim] */
  PetscReal        size; /* of the part of the cell that the point is in, 1 for all of it */
} CellPoint;

/* u = exact(x) and its gradient g[k][i] = d u_i / d x_k. Not collective; whether values are finite is told by
   ExpressionCheck(). [out] u - [dim]; [out] g - [dim][dim] */
PetscErrorCode ExactEvaluate(Expression exact, const CellPoint *at, PetscReal u[], PetscReal g[]);

#endif

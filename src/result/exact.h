/* exact.h -- values and gradients of an exact solution in a cell (floor 7, private to this room). */
#ifndef MORTISE_RESULT_EXACT_H
#define MORTISE_RESULT_EXACT_H

#include <mortise/element.h>
#include <mortise/expression.h>

/* u = exact(x(xi)) and its gradient g[k][i] = d u_i / d x_k in a cell. Not collective; whether values are finite is told by
   ExpressionCheck(). [in] X - [num_nodes][dim]; [in] xi - in the cell, 1e-3 of it from its boundary, [dim];
   [in] grad - of the shape functions there, by ElementMap() [num_nodes][dim]; [out] u - [dim]; [out] g - [dim][dim] */
PetscErrorCode ExactEvaluate(Expression exact, ElementType type, const PetscReal X[], const PetscReal xi[],
                             const PetscReal grad[], PetscReal u[], PetscReal g[]);

#endif

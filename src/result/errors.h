/* errors.h -- errors against exact solutions.

   With e = u_h - u. The error of integration is negligible, also near singular points of the exact solution.
   Over a body
       l2^2 = int |e|^2,   energy^2 = int eps(e) : C eps(e),
   and for the pressure p_h = sum p_a phi_a that is written out, over the facets of the nonmortar side that
   carry one (eq. 15.1),
       l2^2 = int (p_h - p)^2,   weighted^2 = sum D_aa (p_a - p(x_a))^2.
   Relative means: over the same norm of the exact solution. Everything is for the scene's thickness. */
#ifndef MORTISE_ERRORS_H
#define MORTISE_ERRORS_H

#include "result/fields.h"

/* NAN where no exact solution is known; relative ones also where the exact solution is zero. */
typedef struct {
  PetscReal l2, l2_relative, energy, energy_relative;
} BodyError;

typedef struct {
  PetscReal l2, l2_relative, weighted, weighted_relative;
} PressureError;

typedef struct {
  PetscBool      any;   /* whether the scene gives any exact solution; nothing is computed otherwise */
  BodyError     *body;  /* [num_bodies] */
  PressureError *pair;  /* [num_pairs] */
  BodyError      total; /* of all bodies together; NAN unless all of them have an exact displacement */
} Errors;

/* User errors: an exact displacement that contradicts the given ones; an exact solution that is not finite at
   a node. Call it before the solve, so that no work is lost. Collective. */
PetscErrorCode ErrorsCheck(VI vi);
/* Computes the errors. User error: an exact solution is not finite at a quadrature point. Collective.
   [out] errors - owned by the caller, ErrorsDestroy() */
PetscErrorCode ErrorsCompute(Fields fields, Errors *errors);
PetscErrorCode ErrorsDestroy(Errors *errors);

/* The same norms of the difference of two displacements on one level. They are l2 and energy of u - v over
   each body, relative to those of v. Collective. [in] u, v - ghosted; [out] body - [num_bodies]; [out] total
   - of all bodies together */
PetscErrorCode ErrorsComputeDifference(Scene scene, Level *level, Vec u, Vec v, BodyError body[], BodyError *total);

#endif

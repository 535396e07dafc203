/* frictionimpl.h -- the reduced problem with friction, on the first rank (eq. 16.3).

   After the elimination of all other unknowns,  r = g - S y  at the bounded unknowns and their tangents, S dense, symmetric and positive
   definite. A unit is one bounded unknown with its tangents, of which frictionless contact has none. */
#ifndef MORTISE_FRICTIONIMPL_H
#define MORTISE_FRICTIONIMPL_H

#include "pdas/friction.h"
#include "pdas/pdasimpl.h"

typedef enum { UNIT_FREE, UNIT_STICK, UNIT_SLIP } UnitStatus;

typedef struct {
  PetscInt   normal;                          /* position in y */
  PetscInt   num, tangent[FRICTION_TANGENTS]; /* tangents, their positions */
  PetscReal  upper, coefficient, bound, origin[FRICTION_TANGENTS];
  PetscReal  stiffness, resistance;        /* diagonal of A, normal and the largest tangential one */
  PetscBool  closed;                       /* y_n = upper */
  UnitStatus status;                       /* of the tangents; UNIT_FREE: no force */
  PetscReal  direction[FRICTION_TANGENTS]; /* of slip, unit */
  PetscReal  turning;                      /* force over slip across that direction */
} FrictionUnit;

typedef struct {
  PetscInt      N, num; /* unknowns; units */
  FrictionUnit *unit;   /* [num] */
  PetscScalar  *S;      /* borrowed [N][N] */
  PetscReal    *g;      /* [N] */
  PetscReal    *y, *r;  /* [N] */
  PetscInt     *place;  /* of an unknown among the free ones, -1 where it is fixed [N] */
  PetscInt      num_free;
  PetscScalar  *M;     /* the system of the free unknowns, then its factors [N][N] */
  PetscBLASInt *pivot; /* [N] */
  PetscScalar  *x;     /* [N] */
} FrictionProblem;

/* |r_t| may be this much. */
static inline PetscReal FrictionUnitLimit(const FrictionUnit *unit, PetscReal pressing)
{
  return unit->bound + unit->coefficient * PetscMax(pressing, 0);
}

/* Gathers the units of all ranks on the first one, which gets memory for the rest. Collective. [in] S, N - of the first rank */
PetscErrorCode FrictionProblemCreate(const ActiveSet *set, const FrictionLaw *law, PetscScalar S[],
                                     FrictionProblem *problem);
PetscErrorCode FrictionProblemDestroy(FrictionProblem *problem);
/* r = g - S y. First rank, as all below. */
PetscErrorCode FrictionProblemSetForces(FrictionProblem *problem);
/* g += S y. */
PetscErrorCode FrictionProblemAddProduct(FrictionProblem *problem);
/* The residual of the law, in the norm of diag(A)^-1, and what it is compared with. [out] size - of the forces, with roundoff */
void FrictionProblemResidual(const FrictionProblem *problem, PetscReal *residual, PetscReal *size);

/* Decides from y and r what every unit does. [out] changed - units that do something else than before */
void FrictionSystemDecide(FrictionProblem *problem, PetscInt *changed);
/* Factors the linear system of these decisions. [in] coupled - whether limits follow the pressure, as in Newton's method, or are given;
   [out] singular */
PetscErrorCode FrictionSystemFactor(FrictionProblem *problem, PetscBool coupled, PetscBool *singular);
/* One Newton step: y and r of the decisions. [out] singular - then they are as before */
PetscErrorCode FrictionSystemSolve(FrictionProblem *problem, PetscBool *singular);
/* rho of FrictionReport, by power iteration. */
PetscErrorCode FrictionSystemGetRho(FrictionProblem *problem, PetscReal *rho);

/* Sweeps of nonlinear Gauss-Seidel: each unit in turn minimizes with the limit that it has now, along its own gradient (eq. 16.4). */
PetscErrorCode FrictionSweep(FrictionProblem *problem, PetscInt sweeps);

/* Solves contact with friction by solver, a SchurSolver: sets pdas->converged or pdas->failure, and what PDASGetFriction() tells. Collective.
   [in,out] y - initial guess, solution */
PetscErrorCode FrictionIterate(SNES snes, PDAS *pdas, ActiveSolver solver, Vec y);

#endif

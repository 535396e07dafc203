/* frictionlinear.h -- the linear systems of Newton steps for contact with friction at full size; internal. */
#ifndef MORTISE_FRICTIONLINEAR_H
#define MORTISE_FRICTIONLINEAR_H

#include "pdas/frictionimpl.h"

typedef struct {
  ActiveSolver         solver;  /* with its multigrid; borrowed */
  const FrictionUnits *units;   /* borrowed */
  PetscBool           *fixed;   /* unknowns that the decisions fix, set by the caller [n] */
  PetscBool           *left;    /* those that the cycle omits [n] */
  PetscBool            added;   /* the cycle has the resistance to turning */
  PetscBool            coupled; /* whether limits follow the pressure; set by the caller */
  PetscReal            largest; /* eigenvalue of diag(A)^-1 A, 0 until it is needed */
  KSP                  ksp;     /* flexible GMRES; its matrix and preconditioner are shells */
  Mat                  A;
  Vec                  work;
} FrictionLinear;

/* The position of an unknown of the set in arrays of vectors. */
static inline PetscInt FrictionLinearAt(const FrictionLinear *linear, PetscInt i)
{
  return linear->solver->set->dof[i] - linear->solver->set->dof_begin;
}

/* force = turning (1 - d d') s of a unit that slips. */
void FrictionUnitTurn(const FrictionUnit *unit, const PetscReal s[], PetscReal force[]);

/* Collective. [in] solver - a FullSolver with multigrid; [out] linear - not to be moved */
PetscErrorCode FrictionLinearCreate(ActiveSolver solver, const FrictionUnits *units, FrictionLinear *linear);
PetscErrorCode FrictionLinearDestroy(FrictionLinear *linear);
/* Sets the decisions in the cycle. Collective. */
PetscErrorCode FrictionLinearTell(FrictionLinear *linear);
/* Solves for d; reduces the residual by rtol. Collective. [in,out] iterations - its iterations are added */
PetscErrorCode FrictionLinearSolve(FrictionLinear *linear, PetscReal rtol, Vec f, Vec d, PetscInt *iterations);
/* Accelerated proximal steps. Collective. [in,out] units, y, r - values and forces, of units and of all
   unknowns; [out] before, work - overwritten */
PetscErrorCode FrictionProximalApply(FrictionLinear *linear, FrictionUnits *units, Vec y, Vec r, Vec before, Vec work);

#endif

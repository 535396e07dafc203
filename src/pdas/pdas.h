/* pdas.h -- primal-dual active set method as a SNES type ((eq. 10.1), (eq. 10.2); Hueber & Wohlmuth 2005).

   Solves  min 1/2 y'A y - b'y,  y <= upper,  for any SNES with the function A y - b and the Jacobian A (SPD).
   SNESVISetVariableBounds() is called after the type is set. The type is independent of contact. Built on
   SNESSHELL with public headers. */
#ifndef MORTISE_PDAS_H
#define MORTISE_PDAS_H

#include <petscsnes.h>

#define SNESPDAS "pdas"

/* Registers the type; call once after PetscInitialize(). Not collective. Options: -snes_pdas_c <1>,
   -snes_pdas_start <empty> (empty|full|gap|previous), -snes_max_it, -snes_rtol (of the linear residual),
   -snes_pdas_reduce <auto>: whether one factorization serves all active sets (dense Schur complement of the
   bounded unknowns). By itself pdas reduces when the KSP is a plain MUMPS Cholesky solve and the bounded
   unknowns are few. */
PetscErrorCode PDASRegister(void);

/* What happened, valid after SNESSolve() with type pdas and in monitors. Not collective, the same on all
   ranks.
   [out] active - size of the present set;
   [out] changed - borrowed [iterations]; [out] safeguarded - whether it had to be cured of cycling */
PetscErrorCode PDASGetHistory(SNES snes, PetscInt *iterations, PetscInt *active, const PetscInt *changed[],
                              PetscBool *safeguarded);
/* The linear systems of the last solve; SNESGetLinearSolveIterations() has no public way to know.
   Not collective, the same on all ranks.
   [out] iterations - of all systems;
   [out] residual - relative, of the last one; [out] reduced - whether by Schur complement */
PetscErrorCode PDASGetLinear(SNES snes, PetscInt *iterations, PetscReal *residual, PetscBool *reduced);
/* Why the last solve did not converge, as a sentence; "" if it did. Borrowed. Not collective. */
PetscErrorCode PDASGetFailure(SNES snes, const char *sentence[]);

/* 0/1 per unknown: the final active set. Not collective; borrowed. */
PetscErrorCode PDASGetActive(SNES snes, Vec *active);
/* The set that -snes_pdas_start previous begins with; copied. Without one it begins with the set that
   eq. 10.1 makes of the initial guess. Collective. */
PetscErrorCode PDASSetStart(SNES snes, Vec active);

/* Areas of the bounded unknowns. Forces over them are pressures, and an iterative solver then ends only where
   those of free unknowns are negligible as well as their forces. Collective. [in] areas - referenced */
PetscErrorCode PDASSetAreas(SNES snes, Vec areas);

/* Whether matrix and bounds stay as they are from one solve to the next, so that factors serve again.
   Collective. */
PetscErrorCode PDASSetKeep(SNES snes, PetscBool keep);
/* Tells that bounds have new values in their Vec, and the function a new right-hand side. The next solve
   begins with the set of its initial guess by eq. 10.1, unless -snes_pdas_start gives another. What was kept
   is used again. Collective. */
PetscErrorCode PDASRestart(SNES snes);

#endif

/* pdas.h -- primal-dual active set method as a SNES type (floor 6; numerics.md 6; Hueber & Wohlmuth 2005).

   Solves  min 1/2 y'A y - b'y,  y <= upper,  for any SNES whose function is A y - b, whose Jacobian is A (SPD) and whose
   bounds were set by SNESVISetVariableBounds(). Knows nothing of contact. Built on SNESSHELL with public headers. */
#ifndef MORTISE_PDAS_H
#define MORTISE_PDAS_H

#include <petscsnes.h>

#define SNESPDAS "pdas"

/* Registers the type; call once after PetscInitialize(). Not collective.
   Options: -snes_pdas_c <1>, -snes_pdas_start <empty> (empty|full|gap|previous), -snes_max_it, -snes_rtol (of the linear residual),
   -snes_pdas_reduce <auto>: whether one factorisation serves all active sets (dense Schur complement of the bounded unknowns). */
PetscErrorCode PDASRegister(void);

/* What happened, valid after SNESSolve() with type pdas. Not collective, the same on all ranks.
   [out] active - size of the final set; [out] changed - borrowed [iterations]; [out] safeguarded - whether cycling was cured */
PetscErrorCode PDASGetHistory(SNES snes, PetscInt *iterations, PetscInt *active, const PetscInt *changed[], PetscBool *safeguarded);

/* 0/1 per unknown: the final active set. Borrowed. */
PetscErrorCode PDASGetActive(SNES snes, Vec *active);
/* The set that -snes_pdas_start previous begins with; copied. */
PetscErrorCode PDASSetStart(SNES snes, Vec active);

#endif

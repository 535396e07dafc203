/* proximal.h -- the proximal point iteration where contact alone holds bodies; internal (eq. 12.6). */
#ifndef MORTISE_PROXIMAL_H
#define MORTISE_PROXIMAL_H

#include "rigid/solvability.h"
#include "solve/meshlevels.h"
#include "solve/solver.h"

/* The inequality that is solved instead: with springs W on the diagonal of A that rest at y_0, A + W and b + W y_0, for y counted from
   where bodies touch. Without bodies that need them it is the original one. */
typedef struct {
  Inequality  solved;      /* what to solve; A, b and upper are owned where they are not those of vi */
  Solvability solvability; /* borrowed; NULL where supports hold all bodies */
  Vec         rest;        /* y_0 */
  Vec         pull, scale; /* W (y - y_0); diag(A)^(-1/2) */
  PetscReal   last;        /* pull that the last sweep left, in parts of the forces */
  PetscReal   relaxed;     /* pull that does not matter */
  PetscInt    weaker;      /* how often they were made weaker */
} Proximal;

/* Makes what is to be solved, with springs at rest at 0. Collective. [out] springs - to be ended by ProximalEnd() */
PetscErrorCode ProximalBegin(VI vi, Solvability solvability, Proximal *proximal);
/* Lets springs rest at a guess if there is one, and begins with contacts that balance the loads if not. Collective.
   [in] snes - that is to solve, with its tolerances */
PetscErrorCode ProximalSetStart(Proximal *proximal, Vec guess, SNES snes, PetscBool pdas);
/* Lets springs rest at y. Collective. [in,out] y - of vi; of what is solved */
PetscErrorCode ProximalSetCenter(Proximal *proximal, Vec y);
/* Whether the pull of the springs is nothing beside the forces; if not, they rest at y from now on. Collective.
   [in,out] report - fails if there is no end to it; [out] done - also after a failure */
PetscErrorCode ProximalCheck(Proximal *proximal, SNES snes, Vec y, SolverReport *report, PetscBool *done);
/* [in,out] y - of what was solved; of vi. Collective. */
PetscErrorCode ProximalEnd(Proximal *proximal, Vec y);

#endif

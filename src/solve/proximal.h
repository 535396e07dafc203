/* proximal.h -- the proximal point iteration where contact alone holds bodies; internal (eq. 12.6). */
#ifndef MORTISE_PROXIMAL_H
#define MORTISE_PROXIMAL_H

#include "rigid/solvability.h"
#include "solve/meshlevels.h"
#include "solve/solver.h"

/* The inequality with a proximal term: A + W and b + W y_0 with the centre y_0. y is counted from the
   approach (the rigid motion until bodies touch). Without solvability it is the original one. */
typedef struct {
  Inequality  solved;         /* what to solve; A, b and upper are owned if they differ from those of vi */
  Solvability solvability;    /* borrowed; NULL where supports hold all bodies */
  Vec         rest;           /* y_0 */
  Vec         pull, scale;    /* W (y - y_0); diag(A)^(-1/2) */
  PetscReal   last;           /* size of the proximal term after the last step, relative to the forces */
  PetscReal   tolerance;      /* tolerance for it */
  PetscReal   loose;          /* what the solve may leave of the law of friction; 0 for a solution */
  PetscInt    num_reductions; /* how often W was reduced */
  Vec         before;         /* pull of the step before, with the same W; zero without one. NULL without friction */
  PetscReal   ratio;          /* of pulls of successive steps in one direction; 0 if unknown */
} Proximal;

/* Creates what is to be solved, with the centre 0. Collective.
   [out] proximal - to be ended by ProximalEnd() */
PetscErrorCode ProximalBegin(VI vi, Solvability solvability, Proximal *proximal);
/* Sets the centre to a guess; without one sets the initial active set to contacts that balance the loads.
   Collective. [in] snes - that solves, with its tolerances */
PetscErrorCode ProximalSetStart(Proximal *proximal, Vec guess, SNES snes, PetscBool pdas);
/* Sets the centre to y. Collective. [in,out] y - of vi; of what is solved */
PetscErrorCode ProximalSetCenter(Proximal *proximal, Vec y);
/* Tests whether the proximal term is negligible beside the forces; if not, y becomes the centre. Collective.
   [in,out] report - fails after too many steps; [out] done - also after a failure */
PetscErrorCode ProximalCheck(Proximal *proximal, SNES snes, Vec y, SolverReport *report, PetscBool *done);
/* After bodies slid on and on: sets solvability if their motion shows that there is no solution. Collective.
   [in] friction - coupling and turning; [in] y - the last one */
PetscErrorCode ProximalTestSliding(const Proximal *proximal, const FrictionReport *friction, Vec y);
/* Takes bounds, loads and approach anew; the centre is 0 again. Collective. */
PetscErrorCode ProximalUpdate(Proximal *proximal);
/* [in,out] y - of what was solved; of vi. Collective. */
PetscErrorCode ProximalFinish(const Proximal *proximal, Vec y);
/* The same, and destroys what belongs to it. [in,out] y - of what was solved; of vi. Collective. */
PetscErrorCode ProximalEnd(Proximal *proximal, Vec y);

#endif

/* goals.h -- the goals of -adapt_goal: numbers that meshes are refined for. */
#ifndef MORTISE_GOALS_H
#define MORTISE_GOALS_H

#include "study/run.h"

/* One goal on one mesh. */
typedef struct {
  PetscReal value;   /* Q, as in the summary */
  PetscReal product; /* sum_T eta_T(u) eta_T(z) (eq. 15.6) */
  PetscInt  body;    /* with the position of a stress or a pressure; -1 without a position */
  PetscReal at[3];   /* that position */
  PetscReal bar;     /* the larger one of product and the bar of eq. 15.5; NAN where there is none */
} GoalState;

/* Solves the dual problems of all goals on the mesh of a run. Collective.
   [out] states - product, body and at; value and bar are NAN [num_goals];
   [out] indicators - weights of cells for marking,
       eta_T(u)^2 / |eta(u)|^2 + eta_T(z)^2 / |eta(z)|^2,
   [num_goals][num_cells], owned by the caller; [out] solved - whether all dual problems are */
PetscErrorCode GoalsSolve(Run run, GoalState states[], PetscReal **indicators, PetscBool *solved);
/* Puts the larger bars into the block of the summary, and values and bars into the states. Not collective.
   [in] row - of SummaryCreateStep(); [in,out] bars - of BarsCreate(); [in,out] states - [num_goals] */
PetscErrorCode GoalsRaiseBars(Scene scene, const cJSON *row, cJSON *bars, GoalState states[]);
/* Whether the bars of all goals, or of one, are as small as asked for. Not collective. */
PetscBool GoalsAreMet(Scene scene, const GoalState states[]);
PetscBool GoalIsMet(Scene scene, const GoalState *state);
/* Marks cells for the goals that are not met, and for the energy norm. If only the bar of eq. 15.5 of a goal
   is too large, cells at its position are marked as well: the floor of that bar is local. Collective.
   [in] energy - whether cells are marked for the energy norm;
   [in] indicators - of GoalsSolve(); [out] marked, growth - as of MarkingCreate() */
PetscErrorCode GoalsMark(Run run, PetscBool energy, const GoalState states[], const PetscReal indicators[],
                         PetscInt **marked, PetscReal *growth);

#endif

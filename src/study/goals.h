/* goals.h -- numbers that adaptive meshes are made for. */
#ifndef MORTISE_GOALS_H
#define MORTISE_GOALS_H

#include "study/run.h"

/* One goal on one mesh. */
typedef struct {
  PetscReal value;   /* Q, as the summary tells it */
  PetscReal product; /* sum_T eta_T(u) eta_T(z) (eq. 15.6) */
  PetscInt  body;    /* that has the place of a stress or a pressure, or -1 */
  PetscReal at[3];
  PetscReal bar; /* the larger one of that and of the bar of eq. 15.5; NAN where there is none */
} GoalState;

/* Dual solutions of all goals on the mesh of a run. Collective. [out] states - value and product [num_goals]; [out] indicators - owned by
   the caller: of each of its cells the weight for marking, the sum over goals whose bar is too large,
       eta_T(u)^2 / |eta(u)|^2 + eta_T(z)^2 / |eta(z)|^2,   which GoalsMark() adds up [num_goals][num_cells];
   [out] solved - whether all dual problems are */
PetscErrorCode GoalsSolve(Run run, GoalState states[], PetscReal **indicators, PetscBool *solved);
/* Puts the larger bars into the block of the summary, and values and bars into the states. Not collective. [in] row - of SummaryCreateStep();
   [in,out] bars - of BarsCreate() */
PetscErrorCode GoalsRaiseBars(Scene scene, const cJSON *row, cJSON *bars, GoalState states[]);
/* Whether a goal is known as well as is asked for. Not collective. */
PetscBool GoalsAreMet(Scene scene, const GoalState states[]);
PetscBool GoalIsMet(Scene scene, const GoalState *state);
/* Marks cells for the goals that are not met, and for the energy norm where it counts. If only the bar of eq. 15.5 is too large, it also marks
   the cells at the place of the goal: the floor of that bar is local. Collective.
   [in] energy - whether it counts as well; [in] indicators - of GoalsSolve(); [out] marked - owned by the caller [num_cells] */
PetscErrorCode GoalsMark(Run run, PetscBool energy, const GoalState states[], const PetscReal indicators[],
                         PetscInt **marked);

#endif

/* goal.h -- a number as a functional of the displacement, and its dual solution.

   The dual solution z of a number Q has a(v, z) = Q'(v) for all v that keep the active constraints. If Q is a
   force, z moves the active nodes by 1 along the normal. With the error e of the displacement and no change
   of the active set,
       Q(u) - Q(u_h) = a(e, z - z_h)  <=  sum_T eta_T(u) eta_T(z)                         (eq. 15.6). */
#ifndef MORTISE_GOAL_H
#define MORTISE_GOAL_H

#include "result/estimate.h"

/* Q' of one solution. Stresses and pressures are means with the weight w = (1 - r^2 / R^2)^2 about their
   place, r < R. */
typedef struct {
  Fields    fields; /* borrowed: of the solution */
  PetscInt  pair;   /* whose nodes z moves, or -1 */
  PetscInt  body;   /* that has the place, or -1 for a force */
  PetscReal at[3];  /* the place */
  PetscReal radius; /* R; infinite for a force */
  PetscReal scale;  /* z moves a node at distance r by scale * w along the normal */
  Vec       q;      /* Q' at nodes: ghosted, dim per node; NULL where z is moved by its nodes alone */
  Vec       lift;   /* what z is in the active unknowns of pair: layout of vi->b; 0 elsewhere */
} Goal;

/* Collective. [in] fields - of a solution; [out] goal - to be freed by GoalDestroy() */
PetscErrorCode GoalCreate(Fields fields, const SceneGoal *spec, Goal *goal);
PetscErrorCode GoalDestroy(Goal *goal);
/* What A z = b has on its right-hand side with the lift taken off: T'(q - K T lift) / stiffness, 0 where
   unknowns are fixed. Collective.
   [out] b - layout of vi->b, created by the caller */
PetscErrorCode GoalLoad(const Goal *goal, Vec b);
/* eta_T(z)^2 (eq. 15.3) of z + lift. Collective. [in] z - layout of vi->b, 0 in active unknowns; [out]
   estimate - owned by the caller */
PetscErrorCode GoalEstimate(Goal *goal, Vec z, Estimate *estimate);

#endif

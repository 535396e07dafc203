/* pretension.c -- bodies with pretension: their strain along the axis for a given force.

   The strains alpha along the axes are further unknowns of a convex energy: min over u and alpha of E(u,
   alpha) + sum F L alpha. For fixed alpha it is a contact problem with the same matrices: factors are kept.
   The mean forces are the gradient of a convex function of alpha: monotone, and linear while the contact
   state is the same. Broyden's method [1] finds alpha; its first tangent is the stiffness of the bodies
   alone. For one body it is the secant method, exact after two steps within one contact state.

   Reference:
     [1] C. G. Broyden, A class of methods for solving nonlinear simultaneous equations (1965). */
#include "base/compat.h"
#include "problem/eigenstrain.h"
#include "study/pretension.h"

enum { MAX_SOLVES = 60, MAX_SLACK = 8 }; /* solutions; doublings of a step that changes no force */

/* Relative error of the forces that ends the iteration, and the largest one accepted: iterative solvers may
   leave more. */
static const PetscReal WANTED = 1e-11, ACCEPTED = 1e-6;
/* A step s has changed no force, since bodies are slack, if s'H y is below this part of s's. */
static const PetscReal SLACK = 0.01;

/* The bodies with pretension; [num] each but for the inverse tangent, [num][num]. */
typedef struct {
  PetscInt   num;
  PetscInt  *body;
  PetscReal *given, *force, *inverse; /* inverse: d alpha / d force */
  PetscReal *step, *change;
} Tightening;

static PetscErrorCode PretensionCreate_Private(Scene scene, Tightening *t)
{
  const PetscReal origin[3] = {0, 0, 0};

  PetscFunctionBeginUser;
  t->num = 0;
  for (PetscInt b = 0; b < scene->num_bodies; b++) t->num += scene->bodies[b].pretension ? 1 : 0;
  PetscCall(PetscCalloc6(t->num, &t->body, t->num, &t->given, t->num, &t->force, t->num * t->num, &t->inverse, t->num,
                         &t->step, t->num, &t->change));
  for (PetscInt b = 0, i = 0; b < scene->num_bodies; b++) {
    if (!scene->bodies[b].pretension) continue;
    t->body[i] = b;
    PetscCall(ExpressionEvaluate(scene->bodies[b].pretension, scene->dim, origin, &t->given[i++]));
    PetscCall(ExpressionCheck(scene->comm, scene->bodies[b].pretension));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode PretensionDestroy_Private(Tightening *t)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree6(t->body, t->given, t->force, t->inverse, t->step, t->change));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Computes the forces of a displacement.
   [in] first - whether to set the tangent too, to that of bodies with fixed ends */
static PetscErrorCode PretensionMeasure_Private(VI vi, Vec u, PetscBool first, Tightening *t)
{
  PetscReal stiffness;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < t->num; i++) {
    PetscCall(EigenstrainAxialForce(vi->scene, vi->level, t->body[i], u, &t->force[i], &stiffness));
    if (first) t->inverse[i * t->num + i] = -1 / stiffness;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The largest error of a force, relative to the largest given force. [out] worst - index of that body in t */
static PetscReal PretensionError_Private(const Tightening *t, PetscInt *worst)
{
  PetscReal error = -1, size = 0;

  for (PetscInt i = 0; i < t->num; i++) {
    const PetscReal miss = PetscAbsReal(t->force[i] - t->given[i]);

    size = PetscMax(size, PetscAbsReal(t->given[i]));
    if (miss > error) *worst = i;
    error = PetscMax(error, miss);
  }
  return size > 0 ? error / size : error;
}

/* alpha += H (given - force) */
static void PretensionStep_Private(Scene scene, Tightening *t)
{
  for (PetscInt i = 0; i < t->num; i++) {
    t->step[i] = 0;
    for (PetscInt j = 0; j < t->num; j++) t->step[i] += t->inverse[i * t->num + j] * (t->given[j] - t->force[j]);
    scene->bodies[t->body[i]].tightening += t->step[i];
    t->change[i] = t->force[i]; // until the next forces are known
  }
}

/* H += (s - H y) s'H / s'H y with the step s and the change y of the forces. If bodies are slack after the
   step, forces have not changed: then H is doubled, and PETSC_FALSE returned.
   [out] Hy, sH - work space [num] */
static PetscBool PretensionUpdateTangent_Private(Tightening *t, PetscReal Hy[], PetscReal sH[])
{
  const PetscInt n     = t->num;
  PetscReal      along = 0, size = 0;

  for (PetscInt i = 0; i < n; i++) t->change[i] = t->force[i] - t->change[i];
  for (PetscInt i = 0; i < n; i++) {
    Hy[i] = sH[i] = 0;
    for (PetscInt j = 0; j < n; j++) {
      Hy[i] += t->inverse[i * n + j] * t->change[j];
      sH[i] += t->step[j] * t->inverse[j * n + i];
    }
    along += t->step[i] * Hy[i];
    size += PetscSqr(t->step[i]);
  }
  if (!(along > SLACK * size)) {
    for (PetscInt i = 0; i < n * n; i++) t->inverse[i] *= 2;
    return PETSC_FALSE;
  }
  for (PetscInt i = 0; i < n; i++)
    for (PetscInt j = 0; j < n; j++) t->inverse[i * n + j] += (t->step[i] - Hy[i]) * sH[j] / along;
  return PETSC_TRUE;
}

/* Solves with the present strains.
   [in,out] u - the initial guess, then the displacement found; [in] guess - whether u is a guess */
static PetscErrorCode PretensionSolveOnce_Private(VI vi, Solvability solvability, Solver solver, PetscBool guess, Vec u,
                                                  Vec y, SolverReport *report)
{
  PetscBool updated;

  PetscFunctionBeginUser;
  PetscCall(VIUpdate(vi, DATUM_TEMPERATURE, &updated));
  PetscCall(SolvabilityUpdate(vi, solvability));
  PetscCall(SolverUpdate(solver));
  PetscCall(SolverSolve(solver, guess ? u : NULL, y, report));
  PetscCall(VIRecoverDisplacement(vi, y, u));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Broyden's method.
   [in,out] u - the initial guess, then the displacement found; [in] guess - whether u is a guess, else it is
   zero */
static PetscErrorCode PretensionFind_Private(VI vi, Solvability solvability, Solver solver, PetscBool guess, Vec u,
                                             Vec y, SolverReport *report)
{
  PetscInt   worst = 0, slack = 0;
  PetscBool  tight = PETSC_FALSE;
  PetscReal *work, error = PETSC_INFINITY, before;
  Tightening t;

  PetscFunctionBeginUser;
  PetscCall(PretensionCreate_Private(vi->scene, &t));
  PetscCall(PetscMalloc1(2 * t.num, &work));
  for (PetscInt i = 0; i < t.num; i++) tight = (PetscBool)(tight || vi->scene->bodies[t.body[i]].tightening != 0);
  if (tight)
    PetscCall(PretensionSolveOnce_Private(vi, solvability, solver, guess, u, y, report)); // the loads have changed
  PetscCall(PretensionMeasure_Private(vi, u, PETSC_TRUE, &t));
  for (PetscInt solves = 0; solves < MAX_SOLVES; solves++) {
    PretensionStep_Private(vi->scene, &t);
    PetscCall(
        PretensionSolveOnce_Private(vi, solvability, solver, (PetscBool)(guess || tight || solves), u, y, report));
    if (!report->converged) break;
    PetscCall(PretensionMeasure_Private(vi, u, PETSC_FALSE, &t));
    before = error;
    error  = PretensionError_Private(&t, &worst);
    if (error <= WANTED || (error <= ACCEPTED && error > 0.5 * before)) break;
    slack = PretensionUpdateTangent_Private(&t, work, &work[t.num]) ? 0 : slack + 1;
    if (slack == MAX_SLACK) break;
  }
  if (report->converged && !(error <= ACCEPTED)) {
    report->converged = PETSC_FALSE;
    PetscCall(
        PetscSNPrintf(report->reason, sizeof(report->reason),
                      "-%s_pretension: no strain along the axis gives the body this force, it carries %g; nothing "
                      "clamps it, or the loads pull it harder",
                      vi->scene->bodies[t.body[worst]].name, (double)t.force[worst]));
  }
  PetscCall(PetscFree(work));
  PetscCall(PretensionDestroy_Private(&t));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PretensionSolve(VI vi, Solvability solvability, Solver solver, Vec guess, Vec y, SolverReport *report)
{
  const Scene     scene = vi->scene;
  const PetscBool keep  = scene->keep;
  PetscBool       any   = PETSC_FALSE;
  Vec             u;

  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < scene->num_bodies; b++) any = (PetscBool)(any || scene->bodies[b].pretension);
  if (!any || !scene->tighten) {
    PetscCall(SolverSolve(solver, guess, y, report));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(LevelCreateVec(vi->level, vi->level->dim, &u));
  if (guess) {
    PetscCall(VecCopy(guess, u));
    PetscCall(LevelShareVec(u, INSERT_VALUES));
  }
  scene->keep = PETSC_TRUE; // all these solves have the same matrices
  PetscCall(PretensionFind_Private(vi, solvability, solver, (PetscBool)(guess != NULL), u, y, report));
  scene->keep = keep;
  PetscCall(VecDestroy(&u));
  PetscFunctionReturn(PETSC_SUCCESS);
}

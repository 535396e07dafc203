/* run.c -- one problem from its mesh to its certificate. */
#include "base/compat.h"
#include "base/log.h"
#include "study/run.h"
#include "base/usererror.h"
#include "base/warning.h"
#include "problem/lostload.h"
#include "study/pretension.h"
#include "study/reachcheck.h"

/* Attempts with wider reaches. After each, bodies move less, or meet other sides; four times other sides is
   not expected. */
enum { MAX_TRIES = 4 };

/* Sets the report and the certificate of a run that solves nothing: with -check, or without a solution. */
static PetscErrorCode RunLeaveUnsolved_Private(Run run)
{
  const Solvability s = run->solvability;
  Certificate      *c = &run->certificate;

  PetscFunctionBeginUser;
  c->rounding = c->equilibrium = c->gap = c->pressure = c->complementarity = c->force = c->moment = c->pair_moment =
      c->pull = c->energy_norm = c->limit = NAN;
  c->friction                             = (FrictionResidual){NAN, NAN, NAN};
  run->report.linear_residual = run->report.bound.value = NAN;
  if (run->checked) {
    PetscCall(PetscStrncpy(run->report.reason, "-check: nothing was solved", sizeof(run->report.reason)));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PetscSNPrintf(run->report.reason, sizeof(run->report.reason), "there is no solution%s: %s",
                          s->coarse ? " on this mesh" : "", s->motion.sentence));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Solves and judges. [out] again - whether a wider reach is needed */
static PetscErrorCode RunSolve_Private(Run run, Vec guess, PetscBool *again)
{
  const Scene scene = run->scene;

  PetscFunctionBeginUser;
  PetscCall(LogStageBegin(STAGE_SOLVE));
  PetscCall(VecDuplicate(run->vi->b, &run->y));
  PetscCall(PretensionSolve(run->vi, run->solvability, run->solver, guess, run->y, &run->report));
  if (scene->cross_check && run->report.converged)
    PetscCall(SolverCrossCheck(run->solver, run->y, &run->report, &run->check));
  PetscCall(LogStageEnd(STAGE_SOLVE));
  run->refused = (PetscBool)(run->solvability && run->solvability->status == SOLVABLE_NOT);
  if (run->refused) { // bodies that slide on and on
    PetscCall(SceneCheckUnused(scene, PETSC_FALSE));
    PetscCall(RunLeaveUnsolved_Private(run));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  if (scene->measure_linear && run->report.converged) PetscCall(SolverSolveLinear(run->solver, run->y, &run->report));
  if (scene->infsup && !run->inf_sup) { // depends on matrices alone, which load steps keep
    PetscCall(PetscMalloc1(run->vi->num_pairs, &run->inf_sup));
    PetscCall(InfSupCompute(run->vi, run->solvability, run->inf_sup));
  }
  PetscCall(SceneCheckUnused(scene, PETSC_FALSE));

  PetscCall(LogStageBegin(STAGE_OUTPUT));
  PetscCall(FieldsCreate(run->vi, run->solvability, run->y, &run->fields));
  run->fields->solver = run->solver;
  run->fields->report = &run->report;
  run->fields->y      = run->y;
  PetscCall(CertificateCompute(run->fields, &run->certificate, &run->reactions));
  PetscCall(LogStageEnd(STAGE_OUTPUT));
  if (run->certificate.holds) PetscCall(ReachCheckRun(run, again));
  PetscCall(ErrorsCompute(run->fields, &run->errors)); // in no stage: not part of the solution
  /* a second solver that does not converge is a warning: the first one has its certificate */
  run->solved = (PetscBool)(run->report.converged && run->certificate.holds &&
                            (!run->check.done || !run->check.other.converged || run->check.agree));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Creates the inequality and its solver, from those of a coarser level if there are any.
   [in,out] older - run of the coarser level, destroyed; or NULL */
static PetscErrorCode RunSetUp_Private(Run run, Run *older)
{
  PetscFunctionBeginUser;
  PetscCall(*older ? VICreateFiner((*older)->vi, &run->vi) : VICreate(run->scene, run->mesh, &run->vi));
  PetscCall(SolvabilityCreate(run->vi, &run->solvability));
  if (!run->scene->check) PetscCall(SolverCreate(run->vi, run->solvability, &run->solver));
  if (*older && (*older)->solver && run->solver) PetscCall(SolverExtend(run->solver, (*older)->solver, &(*older)->vi));
  PetscCall(RunDestroy(older));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* One attempt, with the present reaches of the scene.
   [in] history - displacement from which slip counts, or NULL; [in,out] older - of RunSetUp_Private();
   [out] again - of ReachCheckRun() */
static PetscErrorCode RunCreateOnce_Private(Scene scene, Mesh mesh, Run *older, Vec guess, Vec history, Run *run_out,
                                            PetscBool *again)
{
  Run run;

  PetscFunctionBeginUser;
  *again = PETSC_FALSE;
  WarningBeginRun();
  PetscCall(PetscNew(&run));
  run->scene     = scene;
  run->mesh      = mesh;
  scene->changed = 0;
  PetscCall(RunSetUp_Private(run, older));
  if (history) PetscCall(VISetSlipOrigin(run->vi, history));
  WarningMark();
  if (scene->view) {
    PetscCall(SceneView(scene));
    PetscCall(MeshViewPrint(run->vi, run->solvability));
    if (run->solver) PetscCall(SolverView(run->solver));
  }
  PetscCall(ErrorsCheck(run->vi));
  run->checked = scene->check;
  run->refused = (PetscBool)(!run->checked && run->solvability && run->solvability->status == SOLVABLE_NOT);
  if (run->checked) PetscCall(SetupCheckCompute(run->vi, &run->setup));
  if (run->refused || run->checked)
    PetscCall(RunLeaveUnsolved_Private(run));
  else
    PetscCall(RunSolve_Private(run, guess, again));
  *run_out = run;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Raises a user error for a pair without partner. It is raised after the solution: where bodies moved farther
   than their reach, a partner may have been found. With load steps it is a warning only, since a later step
   may close the gap. Collective. */
static PetscErrorCode RunCheckEmptyPairs_Private(const Run run)
{
  if (run->scene->steps.num || (!run->refused && !run->certificate.holds))
    return PETSC_SUCCESS; // a failed certificate has its own sentence
  for (PetscInt p = 0; p < run->vi->num_pairs; p++) {
    const Pair       pair = run->vi->pairs[p];
    const ScenePair *spec = pair->spec;

    if (pair->num_multipliers || pair->num_removed || spec->allow_empty) continue;
    return UserErrorRaise(
        run->scene->comm,
        "the pair %s: no part of %s:%s faces its partner within the reach %.6g, across a gap or in an "
        "overlap; check the sides of the pair and the positions of the bodies, give a larger "
        "-%s_reach, or -%s_allow_empty if they need not meet",
        spec->name, run->scene->bodies[spec->nonmortar.body].name, spec->nonmortar.side, (double)pair->reach,
        spec->name, spec->name);
  }
  return PETSC_SUCCESS;
}

/* Makes the certificate fail: contact was missed in the last attempt as well. */
static PetscErrorCode RunGiveUp_Private(Run run)
{
  PetscFunctionBeginUser;
  run->solved            = PETSC_FALSE;
  run->certificate.holds = PETSC_FALSE;
  PetscCall(PetscStrncpy(run->certificate.failure,
                         "contact was missed: bodies moved farther than -<pair>_reach in each of 4 attempts; give "
                         "the pairs a larger -<pair>_reach",
                         sizeof(run->certificate.failure)));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Repeats RunCreateOnce_Private() until no wider reach is needed; then warns about the result.
   [in] history, [in,out] older - of RunCreateOnce_Private(); [in] again - whether an attempt is needed;
   [in,out] run - of the last attempt, or NULL */
static PetscErrorCode RunTry_Private(Scene scene, Mesh mesh, Vec guess, Vec history, PetscBool again, Run older,
                                     Run *run)
{
  SummaryInput known;

  PetscFunctionBeginUser;
  for (PetscInt tries = 0; again && tries < MAX_TRIES; tries++) {
    PetscCall(RunDestroy(run));
    PetscCall(RunCreateOnce_Private(scene, mesh, &older, guess, history, run, &again));
  }
  if (again) PetscCall(RunGiveUp_Private(*run));
  PetscCall(RunCheckEmptyPairs_Private(*run));
  PetscCall(LostLoadsWarn(scene, (*run)->vi->level));
  known = RunSummary(*run);
  PetscCall(SummaryWarn(&known));
  WarningEndRun();
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the summary has the energy balance of load steps. */
static PetscBool RunIsBalanced_Private(const Run run)
{
  return (PetscBool)(run->scene->steps.num && SceneHasFriction(run->scene));
}

/* Keeps a solution for the initial guess of the next one, and computes its energy balance. */
static PetscErrorCode RunRemember_Private(Run run)
{
  PetscFunctionBeginUser;
  if (!run->solved) PetscFunctionReturn(PETSC_SUCCESS);
  if (RunIsBalanced_Private(run))
    PetscCall(EnergyBalanceAdvance(run->fields, run->reactions, &run->energy, &run->balance));
  PetscCall(VecDestroy(&run->past[1].u));
  PetscCall(VecDestroy(&run->past[1].b));
  run->past[1]   = run->past[0];
  run->past[0].b = NULL;
  if (run->vi->friction) {
    PetscCall(VecDuplicate(run->vi->b, &run->past[0].b));
    PetscCall(VecCopy(run->vi->b, run->past[0].b));
  }
  PetscCall(PetscObjectReference((PetscObject)run->fields->u));
  run->past[0].u = run->fields->u;
  run->past[0].t = run->scene->time;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RunCreate(Scene scene, Mesh mesh, Vec guess, Run *run)
{
  PetscFunctionBeginUser;
  *run           = NULL;
  scene->tighten = PETSC_TRUE;
  PetscCall(RunTry_Private(scene, mesh, guess, NULL, PETSC_TRUE, NULL, run));
  (*run)->energy.rest = PETSC_TRUE;
  PetscCall(RunRemember_Private(*run));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RunCreateAfter(Scene scene, Mesh mesh, Vec last, PetscReal t, Run *run)
{
  PetscFunctionBeginUser;
  *run           = NULL;
  scene->tighten = PETSC_TRUE;
  PetscCall(RunTry_Private(scene, mesh, last, last, PETSC_TRUE, NULL, run));
  PetscCall(PetscObjectReference((PetscObject)last));
  (*run)->past[0].u = last;
  (*run)->past[0].t = t;
  PetscCall(RunRemember_Private(*run));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RunCreateTightened(Scene scene, Mesh mesh, Vec guess, Run *run)
{
  PetscFunctionBeginUser;
  *run           = NULL;
  scene->tighten = PETSC_FALSE;
  PetscCall(RunTry_Private(scene, mesh, guess, NULL, PETSC_TRUE, NULL, run));
  PetscCall(RunRemember_Private(*run));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Extrapolates u to the present time from the last solutions: linearly from two of them, or proportionally to
   t, or the last one. [out] guess - ghosted, owned by the caller; NULL without a solution */
static PetscErrorCode RunExtrapolate_Private(Run run, Vec *guess)
{
  const PetscReal t = run->scene->time, last = run->past[0].t, before = run->past[1].t;
  Vec             local, other;

  PetscFunctionBeginUser;
  *guess = NULL;
  if (!run->past[0].u) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecDuplicate(run->past[0].u, guess));
  PetscCall(VecGhostGetLocalForm(*guess, &local));
  PetscCall(VecGhostGetLocalForm(run->past[0].u, &other));
  PetscCall(VecCopy(other, local));
  PetscCall(VecGhostRestoreLocalForm(run->past[0].u, &other));
  if (run->past[1].u && before != last) {
    const PetscReal along = (t - last) / (last - before);

    PetscCall(VecScale(local, 1 + along));
    PetscCall(VecGhostGetLocalForm(run->past[1].u, &other));
    PetscCall(VecAXPY(local, -along, other));
    PetscCall(VecGhostRestoreLocalForm(run->past[1].u, &other));
  } else if (run->scene->scaled && last != 0) {
    PetscCall(VecScale(local, t / last));
  }
  PetscCall(VecGhostRestoreLocalForm(*guess, &local));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Takes back what the extrapolation of a guess has too much, where loads grow less than time, or turn.
   Friction does not turn with them: it is released first. [in,out] guess - of RunExtrapolate_Private() */
static PetscErrorCode RunFollowLoads_Private(Run run, Vec guess)
{
  const PetscReal last = run->past[0].t, before = run->past[1].t;
  PetscReal       along;
  PetscScalar     product, size;
  Vec             change, growth, diagonal, local, other;

  PetscFunctionBeginUser;
  if (!run->past[0].b || !run->past[1].b || before == last) PetscFunctionReturn(PETSC_SUCCESS);
  along = (run->scene->time - last) / (last - before);
  PetscCall(VecDuplicate(run->vi->b, &change));
  PetscCall(VecDuplicate(run->vi->b, &growth));
  PetscCall(VecDuplicate(run->vi->b, &diagonal));
  PetscCall(MatGetDiagonal(run->vi->A, diagonal));
  PetscCall(VecWAXPY(change, -1, run->past[0].b, run->vi->b));
  PetscCall(VecWAXPY(growth, -1, run->past[1].b, run->past[0].b));
  PetscCall(VecPointwiseDivide(diagonal, growth, diagonal));
  PetscCall(VecDot(change, diagonal, &product));
  PetscCall(VecDot(growth, diagonal, &size));
  if (PetscRealPart(size) > 0 && PetscRealPart(product) < along * PetscRealPart(size)) {
    const PetscReal more = along - PetscMax(PetscRealPart(product) / PetscRealPart(size), 0);

    PetscCall(VecGhostGetLocalForm(guess, &local));
    for (int i = 0; i < 2; i++) {
      PetscCall(VecGhostGetLocalForm(run->past[i].u, &other));
      PetscCall(VecAXPY(local, i ? more : -more, other));
      PetscCall(VecGhostRestoreLocalForm(run->past[i].u, &other));
    }
    PetscCall(VecGhostRestoreLocalForm(guess, &local));
  }
  PetscCall(VecDestroy(&change));
  PetscCall(VecDestroy(&growth));
  PetscCall(VecDestroy(&diagonal));
  PetscFunctionReturn(PETSC_SUCCESS);
}

void RunForgetBlocks(Run run)
{
  cJSON_Delete(run->estimate);
  cJSON_Delete(run->bars);
  run->estimate = run->bars = NULL;
}

/* Deletes the results of the last solution. */
static PetscErrorCode RunForget_Private(Run run)
{
  PetscFunctionBeginUser;
  RunForgetBlocks(run);
  PetscCall(VecDestroy(&run->reactions));
  run->balance = (EnergyBalance){NAN, NAN, NAN, NAN};
  PetscCall(VecDestroy(&run->y));
  PetscCall(ErrorsDestroy(&run->errors));
  PetscCall(FieldsDestroy(&run->fields));
  PetscCall(PetscMemzero(&run->report, sizeof(run->report)));
  PetscCall(PetscMemzero(&run->check, sizeof(run->check)));
  PetscCall(PetscMemzero(&run->certificate, sizeof(run->certificate)));
  run->refused = run->solved = PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Solves again with the present matrices and contact. [in] extrapolated - the guess is; [out] again - whether
   all must be made anew */
static PetscErrorCode RunAdvanceOnce_Private(Run run, Vec guess, PetscBool extrapolated, PetscBool *again)
{
  const int changed = run->scene->changed;
  PetscBool updated;

  PetscFunctionBeginUser;
  run->scene->changed = 0;
  PetscCall(VIUpdate(run->vi, changed, &updated));
  *again = (PetscBool)!updated;
  if (*again) PetscFunctionReturn(PETSC_SUCCESS);
  if (extrapolated) PetscCall(RunFollowLoads_Private(run, guess));
  if (run->past[0].u) PetscCall(VISetSlipOrigin(run->vi, run->past[0].u));
  PetscCall(SolvabilityUpdate(run->vi, run->solvability));
  PetscCall(ErrorsCheck(run->vi));
  run->refused = (PetscBool)(run->solvability && run->solvability->status == SOLVABLE_NOT);
  if (run->refused) {
    PetscCall(RunLeaveUnsolved_Private(run));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(SolverUpdate(run->solver));
  PetscCall(RunSolve_Private(run, guess, again));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RunAdvance(Vec guess, Run *run)
{
  const Scene scene = (*run)->scene;
  const Mesh  mesh  = (*run)->mesh;
  Vec         past[2], loads[2], own = NULL;
  PetscReal   t[2];
  PetscBool   again;

  PetscFunctionBeginUser;
  scene->tighten = (PetscBool)((scene->changed & DATUM_PRETENSION) != 0); // pretension is applied once
  if (!guess) PetscCall(RunExtrapolate_Private(*run, &own));
  WarningBeginAgain();
  PetscCall(RunForget_Private(*run));
  PetscCall(RunAdvanceOnce_Private(*run, guess ? guess : own, (PetscBool)(own != NULL), &again));
  for (int i = 0; i < 2; i++) {
    past[i]           = (*run)->past[i].u;
    loads[i]          = (*run)->past[i].b;
    t[i]              = (*run)->past[i].t;
    (*run)->past[i].u = (*run)->past[i].b = NULL;
  }
  PetscCall(RunTry_Private(scene, mesh, guess ? guess : own, past[0], again, NULL, run));
  for (int i = 0; i < 2; i++) {
    (*run)->past[i].u = past[i];
    (*run)->past[i].b = loads[i];
    (*run)->past[i].t = t[i];
  }
  PetscCall(RunRemember_Private(*run));
  PetscCall(VecDestroy(&own));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RunExtend(Vec guess, Run *run)
{
  const Scene scene = (*run)->scene;
  const Mesh  mesh  = (*run)->mesh;
  Run         older = *run;

  PetscFunctionBeginUser;
  *run = NULL;
  PetscCall(RunForget_Private(older));
  PetscCall(RunTry_Private(scene, mesh, guess, NULL, PETSC_TRUE, older, run));
  PetscCall(RunRemember_Private(*run));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RunDestroy(Run *run)
{
  PetscFunctionBeginUser;
  if (!*run) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(RunForget_Private(*run));
  for (int i = 0; i < 2; i++) {
    PetscCall(VecDestroy(&(*run)->past[i].u));
    PetscCall(VecDestroy(&(*run)->past[i].b));
  }
  PetscCall(EnergyStateForget(&(*run)->energy));
  PetscCall(SetupCheckDestroy(&(*run)->setup));
  PetscCall(PetscFree((*run)->inf_sup));
  if ((*run)->solver) PetscCall(SolverDestroy(&(*run)->solver));
  PetscCall(SolvabilityDestroy(&(*run)->solvability));
  PetscCall(VIDestroy(&(*run)->vi));
  PetscCall(PetscFree(*run));
  PetscFunctionReturn(PETSC_SUCCESS);
}

const char *RunGetFailure(Run run)
{
  if (!run->report.converged) return run->report.reason;
  return run->certificate.holds ? "the two solvers of -cross_check disagree" : run->certificate.failure;
}

SummaryInput RunSummary(Run run)
{
  return (SummaryInput){.scene       = run->scene,
                        .mesh        = run->mesh,
                        .vi          = run->vi,
                        .solvability = run->solvability,
                        .setup       = run->checked ? &run->setup : NULL,
                        .fields      = run->fields,
                        .report      = &run->report,
                        .check       = &run->check,
                        .inf_sup     = run->inf_sup,
                        .certificate = &run->certificate,
                        .errors      = &run->errors,
                        .reactions   = run->reactions,
                        .balance     = RunIsBalanced_Private(run) ? &run->balance : NULL,
                        .estimate    = run->estimate,
                        .bars        = run->bars,
                        .solved      = run->solved};
}

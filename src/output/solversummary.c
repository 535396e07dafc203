/* solversummary.c -- the block "solver" of the summary: steps, residuals of the uncondensed KKT system,
   bounds, cross-check. */
#include "base/compat.h"
#include "base/json.h"
#include "output/solversummary.h"

static void SolverSummaryAddCrossCheck_Private(const CrossCheck *check, cJSON *solver)
{
  cJSON *object;

  if (!check->done) return;
  object = cJSON_AddObjectToObject(solver, "cross_check");
  cJSON_AddStringToObject(object, "type", check->other.type);
  cJSON_AddBoolToObject(object, "converged", check->other.converged);
  cJSON_AddBoolToObject(object, "agree", check->agree);
  cJSON_AddStringToObject(object, "linear", check->other.linear);
  JSONAddInt(object, "iterations", check->other.iterations);
  JSONAddInt(object, "linear_iterations", check->other.linear_iterations);
  JSONAddReal(object, "work_units", check->other.work > 0 ? check->other.work : NAN);
  JSONAddInt(object, "active_difference", check->active_difference);
  JSONAddReal(object, "displacement_difference", check->displacement_difference);
}

/* Bound of the algebraic error: absolute, and relative to the displacement. */
static void SolverSummaryAddBound_Private(const SummaryInput *in, cJSON *solver)
{
  const EnergyBound *bound  = &in->report->bound;
  const PetscBool    known  = (PetscBool)!PetscIsInfOrNanReal(bound->value);
  cJSON             *object = cJSON_AddObjectToObject(solver, "energy_bound");

  JSONAddReal(object, "absolute", bound->value);
  JSONAddReal(object, "relative", CertificateRelative(in->certificate, bound->value));
  if (known)
    cJSON_AddStringToObject(object, "kind", bound->estimated ? "estimated" : "exact");
  else
    cJSON_AddNullToObject(object, "kind");
}

/* The discretisation error at which the solver stopped; null where it stopped at its residual. */
static void SolverSummaryAddDiscretisation_Private(const SummaryInput *in, cJSON *solver)
{
  const PetscReal error = in->report->discretisation;
  cJSON          *object;

  if (!isgreater(error, 0)) {
    cJSON_AddNullToObject(solver, "discretisation_error");
    return;
  }
  object = cJSON_AddObjectToObject(solver, "discretisation_error");
  JSONAddReal(object, "absolute", error);
  JSONAddReal(object, "relative", CertificateRelative(in->certificate, error));
}

/* One linear solve, for comparison; null without -measure_linear. */
static void SolverSummaryAddReference_Private(const SolverReport *report, cJSON *solver)
{
  const LinearReference *reference = &report->reference;
  cJSON                 *object;

  if (!reference->done) {
    cJSON_AddNullToObject(solver, "linear_reference");
    return;
  }
  object = cJSON_AddObjectToObject(solver, "linear_reference");
  JSONAddInt(object, "iterations", reference->iterations);
  JSONAddReal(object, "work_units", reference->work > 0 ? reference->work : NAN);
  JSONAddReal(object, "contact_ratio", reference->seconds > 0 ? report->seconds / reference->seconds : NAN);
}

/* Friction: uniqueness, and the residual of its law; null without it. */
static void SolverSummaryAddFriction_Private(const SummaryInput *in, cJSON *solver)
{
  const FrictionReport   *report   = &in->report->friction;
  const FrictionResidual *residual = &in->certificate->friction;
  cJSON                  *object;

  if (!in->vi->friction || !in->fields) {
    cJSON_AddNullToObject(solver, "friction");
    return;
  }
  object = cJSON_AddObjectToObject(solver, "friction");
  JSONAddReal(object, "rho", report->rho);
  JSONAddReal(object, "rho_error", report->rho_error);
  cJSON_AddBoolToObject(object, "unique", report->rho < 1 && !report->others);
  cJSON_AddBoolToObject(object, "others", report->others);
  cJSON_AddStringToObject(object, "rho_mesh", report->coarser ? "coarser" : "own");
  JSONAddInt(object, "slipping", report->slipping);
  JSONAddInt(object, "sticking", report->sticking);
  JSONAddInt(object, "relaxations", report->shortened);
  JSONAddReal(object, "cone", residual->cone);
  JSONAddReal(object, "slip", residual->slip);
  JSONAddReal(object, "dissipation", residual->dissipation);
}

void SolverSummaryAdd(const SummaryInput *in, cJSON *root)
{
  const SolverReport *report = in->report;
  const Certificate  *c      = in->certificate;
  cJSON              *solver = cJSON_AddObjectToObject(root, "solver"), *object;

  cJSON_AddStringToObject(solver, "type", report->type);
  cJSON_AddStringToObject(solver, "linear", report->linear);
  JSONAddInt(solver, "iterations", report->iterations);
  JSONAddInt(solver, "active", report->active);
  if (report->num_changed) {
    object = cJSON_AddArrayToObject(solver, "changed");
    for (PetscInt i = 0; i < report->num_changed; i++)
      cJSON_AddItemToArray(object, cJSON_CreateNumber(report->changed[i]));
  } else {
    cJSON_AddNullToObject(solver, "changed");
  }
  JSONAddInt(solver, "sweeps", report->proximal_steps);
  JSONAddInt(solver, "linear_iterations", report->linear_iterations);
  JSONAddReal(solver, "linear_residual", report->linear_residual);
  JSONAddReal(solver, "work_units", report->work > 0 ? report->work : NAN);
  cJSON_AddBoolToObject(solver, "gave_way", report->gave_way);
  SolverSummaryAddReference_Private(report, solver);
  cJSON_AddBoolToObject(solver, "converged", report->converged);
  cJSON_AddBoolToObject(solver, "safeguarded", report->safeguarded);
  cJSON_AddBoolToObject(solver, "certified", c->holds);
  JSONAddReal(solver, "certificate_limit", c->limit);
  cJSON_AddStringToObject(solver, "failure", report->converged ? c->failure : report->reason);
  object = cJSON_AddObjectToObject(solver, "kkt");
  JSONAddReal(object, "equilibrium", c->equilibrium);
  JSONAddReal(object, "gap", c->gap);
  JSONAddReal(object, "pressure", c->pressure);
  JSONAddReal(object, "complementarity", c->complementarity);
  JSONAddReal(object, "pull", c->pull);
  JSONAddReal(object, "rounding", c->rounding);
  object = cJSON_AddObjectToObject(solver, "balance");
  JSONAddReal(object, "force", c->force);
  JSONAddReal(object, "moment", c->moment);
  JSONAddReal(object, "pair_moment", c->pair_moment);
  SolverSummaryAddBound_Private(in, solver);
  SolverSummaryAddDiscretisation_Private(in, solver);
  SolverSummaryAddFriction_Private(in, solver);
  SolverSummaryAddCrossCheck_Private(in->check, solver);
}

/* summary.c -- the JSON summary. Every scene has all keys of the interface. A value that could not be
   computed is null. */
#include <string.h>
#include "output/summary.h"
#include "base/json.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/options.h"
#include "output/patchsummary.h"
#include "problem/eigenstrain.h"
#include "problem/loads.h"
#include "result/sideerrors.h"
#include "result/frictionfields.h"
#include "result/pairsum.h"
#include "result/probes.h"
#include "result/reactions.h"
#include "base/compat.h"
#include "base/warning.h"
#include "output/bodycounts.h"
#include "checks/gapdiscontinuity.h"
#include "output/setupreport.h"
#include "output/errorreport.h"
#include "output/solversummary.h"
#include "checks/solvabilityreport.h"
#include "checks/validity.h"

enum { SCHEMA = 2 }; /* version of the meaning of keys; new keys do not change it */

static const char *SummaryStatus_Private(const SummaryInput *in)
{
  return in->setup ? "checked" : in->solved ? "solved" : in->fields ? "not_converged" : "no_solution";
}

static PetscErrorCode SummaryAddMortise_Private(const SummaryInput *in, cJSON *root)
{
  cJSON      *object = cJSON_AddObjectToObject(root, "mortise");
  const char *file   = OptionsFileName();
  char        petsc[64];
  PetscMPIInt ranks;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(in->scene->comm, &ranks));
  PetscCall(PetscSNPrintf(petsc, sizeof(petsc), "%d.%d.%d", PETSC_VERSION_MAJOR, PETSC_VERSION_MINOR,
                          PETSC_VERSION_SUBMINOR));
  cJSON_AddStringToObject(object, "version", MORTISE_VERSION);
  cJSON_AddStringToObject(object, "petsc", petsc);
  JSONAddInt(object, "ranks", ranks);
  cJSON_AddItemToObject(object, "options_file", file ? cJSON_CreateString(file) : cJSON_CreateNull());
  cJSON_AddStringToObject(root, "status", SummaryStatus_Private(in));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The user's options. */
static PetscErrorCode SummaryAddOptions_Private(cJSON *root)
{
  cJSON       *object = cJSON_AddObjectToObject(root, "options");
  OptionGiven *given;
  PetscInt     num;

  PetscFunctionBeginUser;
  PetscCall(OptionsGetGiven(&num, &given));
  for (PetscInt i = 0; i < num; i++) cJSON_AddStringToObject(object, given[i].name, given[i].value);
  PetscCall(PetscFree(given));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A modulus that is a plain number; null where there is none, or a formula. */
static void SummaryAddModulus_Private(cJSON *object, const char key[], Scene scene, Expression e)
{
  const PetscReal origin[3] = {0, 0, 0};
  PetscReal       value     = NAN;

  if (e && ExpressionIsConstant(e) && ExpressionEvaluate(e, scene->dim, origin, &value)) value = NAN;
  JSONAddReal(object, key, value);
}

/* Regions of a body that has some. */
static void SummaryAddRegions_Private(const SummaryInput *in, PetscInt body, PetscInt num, const RegionCount counts[],
                                      cJSON *object)
{
  cJSON *regions;

  if (!in->scene->bodies[body].num_regions) return;
  regions = cJSON_AddArrayToObject(object, "regions");
  for (const RegionCount *count = counts; count < counts + num; count++) {
    cJSON *one;

    if (count->body != body) continue;
    one = cJSON_CreateObject();
    cJSON_AddItemToArray(regions, one);
    cJSON_AddItemToObject(one, "name", count->name ? cJSON_CreateString(count->name) : cJSON_CreateNull());
    JSONAddInt(one, "cells", count->cells);
    JSONAddReal(one, "volume", count->volume);
    SummaryAddModulus_Private(one, "young", in->scene, count->material->young);
    SummaryAddModulus_Private(one, "poisson", in->scene, count->material->poisson);
  }
}

static PetscErrorCode SummaryAddBodies_Private(const SummaryInput *in, cJSON *scene)
{
  cJSON       *bodies = cJSON_AddObjectToObject(scene, "bodies");
  const Level *level  = in->vi->level;
  BodyCount   *counts;
  RegionCount *regions;
  PetscInt     num_regions;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(in->scene->num_bodies, &counts));
  PetscCall(BodyCountsCompute(level, in->scene->num_bodies, counts));
  PetscCall(RegionCountsCompute(in->scene, level, &num_regions, &regions));
  for (PetscInt b = 0; b < in->scene->num_bodies; b++) {
    cJSON *body = cJSON_AddObjectToObject(bodies, in->scene->bodies[b].name);

    JSONAddInt(body, "cells", counts[b].cells);
    JSONAddInt(body, "nodes", counts[b].nodes);
    JSONAddInt(body, "dofs", counts[b].nodes * level->dim);
    JSONAddInt(body, "order", in->scene->bodies[b].order);
    JSONAddInt(body, "pieces", ComponentsOfBody(&in->vi->rigid_modes.components, b));
    cJSON_AddBoolToObject(body, "floating", in->vi->rigid_modes.floating[b]);
    SummaryAddRegions_Private(in, b, num_regions, regions, body);
  }
  PetscCall(PetscFree(regions));
  PetscCall(PetscFree(counts));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* "body:side", or the kind of obstacle. */
static void SummaryAddSide_Private(const SummaryInput *in, cJSON *object, const char key[], const ScenePair *pair,
                                   const SceneSide *side)
{
  static const char *const obstacles[] = {"", "plane", "ball", "cylinder", "parabola", "expression"};
  char                     text[PETSC_MAX_PATH_LEN];

  if (side->body >= 0) {
    snprintf(text, sizeof(text), "%s:%s", in->scene->bodies[side->body].name, side->side);
  } else {
    snprintf(text, sizeof(text), "%s", obstacles[pair->obstacle.kind]);
  }
  cJSON_AddStringToObject(object, key, text);
}

/* The units, or null. */
static void SummaryAddUnits_Private(Scene scene, cJSON *object)
{
  static const char *const names[] = {"length", "force", "stress", "temperature"};
  cJSON                   *units   = scene->units[0] ? cJSON_CreateObject() : cJSON_CreateNull();

  for (PetscInt i = 0; i < 4 && scene->units[i]; i++) cJSON_AddStringToObject(units, names[i], scene->units[i]);
  cJSON_AddItemToObject(object, "units", units);
}

static PetscErrorCode SummaryAddScene_Private(const SummaryInput *in, cJSON *root)
{
  static const char *const models[] = {"plane_strain", "plane_stress", "axisymmetric", "solid"};
  cJSON                   *scene    = cJSON_AddObjectToObject(root, "scene"), *pairs;

  PetscFunctionBeginUser;
  cJSON_AddStringToObject(scene, "title", in->scene->title);
  cJSON_AddStringToObject(scene, "model", models[in->scene->model]);
  JSONAddInt(scene, "dimension", in->scene->dim);
  SummaryAddUnits_Private(in->scene, scene);
  PetscCall(SummaryAddBodies_Private(in, scene));
  pairs = cJSON_AddObjectToObject(scene, "pairs");
  for (PetscInt p = 0; p < in->vi->num_pairs; p++) {
    const ScenePair *spec = in->vi->pairs[p]->spec;
    cJSON           *pair = cJSON_AddObjectToObject(pairs, spec->name);

    SummaryAddSide_Private(in, pair, "nonmortar", spec, &spec->nonmortar);
    SummaryAddSide_Private(in, pair, "mortar", spec, &spec->mortar);
    JSONAddInt(pair, "candidates", in->vi->pairs[p]->num_multipliers);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode SummaryAddEnergy_Private(const SummaryInput *in, cJSON *root)
{
  cJSON *energy = cJSON_AddObjectToObject(root, "energy"), *strain = cJSON_AddObjectToObject(energy, "strain"),
        *balance;
  PetscReal *bodies, potential;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(in->scene->num_bodies, &bodies));
  potential = NAN;
  for (PetscInt b = 0; b < in->scene->num_bodies; b++) bodies[b] = NAN;
  if (in->fields) PetscCall(FieldsEnergy(in->fields, bodies, &potential));
  for (PetscInt b = 0; b < in->scene->num_bodies; b++) JSONAddReal(strain, in->scene->bodies[b].name, bodies[b]);
  JSONAddReal(energy, "potential", potential);
  PetscCall(PetscFree(bodies));
  if (!in->balance) PetscFunctionReturn(PETSC_SUCCESS);
  balance = cJSON_AddObjectToObject(energy, "balance");
  JSONAddReal(balance, "work", in->balance->work);
  JSONAddReal(balance, "stored", in->balance->stored);
  JSONAddReal(balance, "dissipation", in->balance->dissipation);
  JSONAddReal(balance, "defect", in->balance->defect);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Friction of a pair; null without it. */
static PetscErrorCode SummaryAddFriction_Private(const SummaryInput *in, PetscInt p, cJSON *pair)
{
  FrictionSum sum = {.slip_share = NAN, .max_slip = NAN, .dissipation = NAN};

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < 3; k++) sum.force[k] = NAN;
  if (in->fields && in->fields->lambda && ScenePairHasFriction(in->vi->pairs[p]->spec))
    PetscCall(FrictionSumCompute(in->fields, p, &sum));
  JSONAddReals(pair, "tangential_force", in->scene->dim, sum.force);
  JSONAddReal(pair, "slip_share", sum.slip_share);
  JSONAddReal(pair, "max_slip", sum.max_slip);
  JSONAddReal(pair, "dissipation", sum.dissipation);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What is not known of the curved sides of a pair, if there is such. Collective. */
static PetscErrorCode SummaryAddSideErrors_Private(const SummaryInput *in, PetscInt p, cJSON *pair)
{
  SideErrors errors = {.normal = 0};
  cJSON     *object;

  PetscFunctionBeginUser;
  if (in->fields) PetscCall(SideErrorsGet(in->fields, p, &errors));
  if (!(errors.normal > 0)) PetscFunctionReturn(PETSC_SUCCESS);
  object = cJSON_AddObjectToObject(pair, "side_error");
  JSONAddReal(object, "normal", errors.normal);
  JSONAddReal(object, "pressure", errors.pressure);
  JSONAddReal(object, "max_pressure", errors.largest);
  JSONAddReals(object, "max_pressure_at", in->scene->dim, errors.at);
  JSONAddReal(object, "potential", errors.potential);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The inf-sup number of a pair; nothing without -infsup. */
static void SummaryAddInfSup_Private(const SummaryInput *in, PetscInt p, cJSON *pair)
{
  cJSON *object;

  if (!in->inf_sup) return;
  object = cJSON_AddObjectToObject(pair, "inf_sup");
  JSONAddReal(object, "number", in->inf_sup[p].number);
  JSONAddReal(object, "condition", in->inf_sup[p].condition);
}

static PetscErrorCode SummaryAddPairs_Private(const SummaryInput *in, cJSON *root)
{
  cJSON         *pairs = cJSON_AddObjectToObject(root, "pairs");
  const PetscInt dim   = in->scene->dim;

  PetscFunctionBeginUser;
  for (PetscInt p = 0; p < in->vi->num_pairs; p++) {
    cJSON  *pair = cJSON_AddObjectToObject(pairs, in->vi->pairs[p]->spec->name), *extent;
    PairSum sum;

    if (in->fields)
      PetscCall(PairSumCompute(in->fields, p, &sum));
    else
      sum = PairSumUnknown();
    JSONAddReals(pair, "force", dim, sum.force);
    JSONAddReal(pair, "normal_force", sum.normal_force);
    JSONAddReal(pair, "area", sum.area);
    JSONAddReal(pair, "mean_pressure", sum.area > 0 ? sum.normal_force / sum.area : NAN);
    JSONAddReal(pair, "max_pressure", sum.max_pressure);
    JSONAddReals(pair, "max_pressure_at", dim, sum.max_pressure_at);
    JSONAddReal(pair, "max_pressure_covered", sum.max_covered);
    JSONAddReal(pair, "min_gap", sum.min_gap);
    JSONAddInt(pair, "active_nodes", sum.active);
    extent = cJSON_AddObjectToObject(pair, "extent");
    JSONAddReals(extent, "lower", dim, sum.lower);
    JSONAddReals(extent, "upper", dim, sum.upper);
    JSONAddReals(pair, "centre_of_pressure", dim, sum.centre);
    JSONAddReal(pair, "moment_imbalance", sum.moment_imbalance);
    PetscCall(SummaryAddFriction_Private(in, p, pair));
    SummaryAddInfSup_Private(in, p, pair);
    PetscCall(GapDiscontinuityAdd(in->fields, p, dim, pair));
    PetscCall(SummaryAddSideErrors_Private(in, p, pair));
    PetscCall(PatchSummaryAdd(in->fields, p, pair));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Reactions by side. */
static PetscErrorCode SummaryAddReactions_Private(const SummaryInput *in, cJSON *root)
{
  cJSON         *reactions = cJSON_AddObjectToObject(root, "reactions");
  const PetscInt dim       = in->scene->dim;
  PetscReal     *sums, *next;

  PetscFunctionBeginUser;
  PetscCall(ReactionsCreate(in->scene, in->fields, in->reactions, &sums, NULL));
  next = sums;
  for (PetscInt b = 0; b < in->scene->num_bodies; b++) {
    const SceneBody *body = &in->scene->bodies[b];

    for (PetscInt i = 0; i < body->num_boundaries; i++) {
      const BoundaryKind kind = body->boundaries[i].kind;
      char               key[PETSC_MAX_PATH_LEN];

      if (kind != BOUNDARY_DISPLACEMENT && kind != BOUNDARY_NORMAL) continue;
      PetscCall(PetscSNPrintf(key, sizeof(key), "%s:%s", body->name, body->boundaries[i].side));
      JSONAddReals(reactions, key, dim, &next[i * dim]);
    }
    next += body->num_boundaries * dim;
  }
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sums of the loads on sides, one entry for each side. */
static PetscErrorCode SummaryAddLoads_Private(const SummaryInput *in, cJSON *root)
{
  cJSON         *loads = cJSON_AddObjectToObject(root, "loads");
  const PetscInt dim   = in->scene->dim;

  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < in->scene->num_bodies; b++) {
    const SceneBody *body = &in->scene->bodies[b];

    for (PetscInt i = 0; i < body->num_boundaries; i++) {
      PetscBool known = PETSC_FALSE;
      LoadSum   sum;
      cJSON    *load;
      char      key[PETSC_MAX_PATH_LEN];

      if (!SceneBoundaryIsLoad(&body->boundaries[i])) continue;
      for (PetscInt j = 0; j < i; j++)
        known = (PetscBool)(known || (SceneBoundaryIsLoad(&body->boundaries[j]) &&
                                      !strcmp(body->boundaries[i].side, body->boundaries[j].side)));
      if (known) continue;
      PetscCall(LoadSumsCompute(in->scene, in->vi->level, b, body->boundaries[i].side, &sum));
      PetscCall(PetscSNPrintf(key, sizeof(key), "%s:%s", body->name, body->boundaries[i].side));
      load = cJSON_AddObjectToObject(loads, key);
      JSONAddReals(load, "force", dim, sum.force);
      if (dim == 3)
        JSONAddReals(load, "moment", dim, sum.moment);
      else
        JSONAddReal(load, "moment", in->scene->model == MODEL_AXISYMMETRIC ? NAN : sum.moment[2]);
      JSONAddReals(load, "centroid", dim, sum.centre);
      JSONAddReal(load, "area", sum.area);
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Forces of bodies with pretension, and the strain of their tightening. */
static PetscErrorCode SummaryAddPretension_Private(const SummaryInput *in, cJSON *root)
{
  cJSON *all = NULL;

  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < in->scene->num_bodies; b++) {
    const SceneBody *body  = &in->scene->bodies[b];
    PetscReal        force = NAN, stiffness;
    cJSON           *object;

    if (!body->pretension) continue;
    if (!all) all = cJSON_AddObjectToObject(root, "pretension");
    object = cJSON_AddObjectToObject(all, body->name);
    if (in->fields) PetscCall(EigenstrainAxialForce(in->scene, in->vi->level, b, in->fields->u, &force, &stiffness));
    JSONAddReal(object, "force", force);
    JSONAddReal(object, "strain", in->fields ? body->tightening : NAN);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode SummaryAddProbes_Private(const SummaryInput *in, cJSON *root)
{
  cJSON *probes = cJSON_AddObjectToObject(root, "probes");

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < in->scene->num_probes; i++) {
    const SceneProbe *spec  = &in->scene->probes[i];
    cJSON            *probe = cJSON_AddObjectToObject(probes, spec->name);
    PetscReal         u[3] = {NAN, NAN, NAN}, stress[6] = {NAN, NAN, NAN, NAN, NAN, NAN}, principal[3];

    if (in->fields) PetscCall(ProbesEvaluate(in->fields, spec, u, stress));
    JSONAddReals(probe, "at", in->scene->dim, spec->at);
    JSONAddReals(probe, "displacement", in->scene->dim, u);
    JSONAddReals(probe, "stress", 6, stress);
    JSONAddReal(probe, "von_mises", MaterialVonMises(stress));
    MaterialPrincipal(stress, principal);
    JSONAddReals(probe, "principal", 3, principal);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static void SummaryAddBodyError_Private(cJSON *object, const BodyError *error)
{
  JSONAddReal(object, "l2", error->l2);
  JSONAddReal(object, "l2_relative", error->l2_relative);
  JSONAddReal(object, "energy", error->energy);
  JSONAddReal(object, "energy_relative", error->energy_relative);
}

/* Errors of bodies and pairs with an exact solution. */
static void SummaryAddErrors_Private(const SummaryInput *in, cJSON *root)
{
  cJSON *errors;

  if (!in->errors->any) return;
  errors = cJSON_AddObjectToObject(root, "errors");
  for (PetscInt b = 0; b < in->scene->num_bodies; b++) {
    if (!in->scene->bodies[b].exact) continue;
    SummaryAddBodyError_Private(cJSON_AddObjectToObject(errors, in->scene->bodies[b].name), &in->errors->body[b]);
  }
  for (PetscInt p = 0; p < in->vi->num_pairs; p++) {
    const PressureError *error = &in->errors->pair[p];
    cJSON               *pair;

    if (!in->vi->pairs[p]->spec->exact) continue;
    pair = cJSON_AddObjectToObject(errors, in->vi->pairs[p]->spec->name);
    JSONAddReal(pair, "pressure_l2", error->l2);
    JSONAddReal(pair, "pressure_l2_relative", error->l2_relative);
    JSONAddReal(pair, "pressure_weighted", error->weighted);
    JSONAddReal(pair, "pressure_weighted_relative", error->weighted_relative);
  }
  SummaryAddBodyError_Private(cJSON_AddObjectToObject(root, "errors_total"), &in->errors->total);
}

/* Seconds of the slowest rank in each stage; peak memory of all ranks together, and of the one that held
   most. */
static PetscErrorCode SummaryAddCost_Private(const SummaryInput *in, cJSON *root)
{
  static const char *const names[STAGE_COUNT] = {"setup", "mortar", "assembly", "condense", "solve", "output"};
  cJSON    *timing = cJSON_AddObjectToObject(root, "timing"), *memory = cJSON_AddObjectToObject(root, "memory");
  PetscReal seconds[STAGE_COUNT + 1], bytes, largest;

  PetscFunctionBeginUser;
  for (int stage = 0; stage < STAGE_COUNT; stage++) seconds[stage] = LogStageSeconds((LogStage)stage);
  seconds[STAGE_COUNT] = LogTotalSeconds();
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, seconds, STAGE_COUNT + 1, MPIU_REAL, MPI_MAX, in->scene->comm));
  for (int stage = 0; stage < STAGE_COUNT; stage++) JSONAddReal(timing, names[stage], seconds[stage]);
  JSONAddReal(timing, "total", seconds[STAGE_COUNT]);
  JSONAddReal(timing, "linear_reference", in->report->reference.done ? in->report->reference.seconds : NAN);
  PetscCall(MemoryPeak(in->scene->comm, &bytes, &largest));
  JSONAddReal(memory, "peak_bytes", bytes);
  JSONAddReal(memory, "largest_rank_bytes", largest);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SummaryCreateStep(const SummaryInput *input, cJSON **row)
{
  PetscReal seconds = LogTotalSeconds();

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &seconds, 1, MPIU_REAL, MPI_MAX, input->scene->comm));
  *row = cJSON_CreateObject();
  JSONAddReal(*row, "t", input->scene->time);
  cJSON_AddStringToObject(*row, "status", SummaryStatus_Private(input));
  JSONAddInt(*row, "iterations", input->report->iterations);
  JSONAddInt(*row, "linear_iterations", input->report->linear_iterations);
  JSONAddReal(*row, "seconds", seconds);
  PetscCall(SummaryAddEnergy_Private(input, *row));
  PetscCall(SummaryAddPairs_Private(input, *row));
  PetscCall(SummaryAddReactions_Private(input, *row));
  PetscCall(SummaryAddPretension_Private(input, *row));
  PetscCall(SummaryAddProbes_Private(input, *row));
  PetscCall(ValidityAdd(input->fields, *row));
  cJSON_AddBoolToObject(*row, "certificate", input->certificate->holds);
  if (input->estimate) cJSON_AddItemToObject(*row, "estimate", cJSON_Duplicate(input->estimate, cJSON_True));
  if (input->bars) cJSON_AddItemToObject(*row, "bars", cJSON_Duplicate(input->bars, cJSON_True));
  cJSON_AddItemToObject(*row, "warnings", WarningList());
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SummaryCreateTree(const SummaryInput *input, cJSON **tree)
{
  cJSON *root = cJSON_CreateObject();

  PetscFunctionBeginUser;
  JSONAddInt(root, "schema", SCHEMA);
  PetscCall(SummaryAddMortise_Private(input, root));
  cJSON_AddItemToObject(root, "warnings", WarningList());
  PetscCall(SummaryAddOptions_Private(root));
  PetscCall(SummaryAddScene_Private(input, root));
  SolvabilityReportAdd(input->vi, input->solvability, root);
  SolverSummaryAdd(input, root);
  PetscCall(SummaryAddEnergy_Private(input, root));
  PetscCall(SummaryAddPairs_Private(input, root));
  PetscCall(SummaryAddReactions_Private(input, root));
  PetscCall(SummaryAddLoads_Private(input, root));
  PetscCall(SummaryAddPretension_Private(input, root));
  PetscCall(SummaryAddProbes_Private(input, root));
  SummaryAddErrors_Private(input, root);
  if (input->setup) PetscCall(SetupReportAdd(input->vi, input->setup, root));
  PetscCall(ErrorReportAdd(input, root));
  PetscCall(ValidityAdd(input->fields, root));
  PetscCall(SummaryAddCost_Private(input, root));
  if (input->steps) cJSON_AddItemToObject(root, "steps", cJSON_Duplicate(input->steps, cJSON_True));
  *tree = root;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SummaryCreate(const SummaryInput *input, char **text)
{
  cJSON      *root;
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  PetscCall(SummaryCreateTree(input, &root));
  PetscCallMPI(MPI_Comm_rank(input->scene->comm, &rank));
  *text = rank == 0 ? cJSON_Print(root) : NULL;
  cJSON_Delete(root);
  PetscFunctionReturn(PETSC_SUCCESS);
}

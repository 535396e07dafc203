/* validity.c -- indicators of the small-displacement model: their limits, the warning and the summary. */
#include <string.h>
#include "base/compat.h"
#include "base/json.h"
#include "base/warning.h"
#include "checks/validityimpl.h"

/* An indicator is green below the first number and red above the second: errors of one and of some per cent;
   a slip of half a facet and of two, where nodes face other facets than those that they are coupled with. */
static const struct {
  const char *name, *what;
  PetscReal   green, red;
} KINDS[VALIDITY_COUNT] = {
    {"strain", "neglected share of the strain", VALIDITY_GREEN_STRAIN, 0.05},
    {"rotation", "rotation", 0.02, 0.1},
    {"gap", "error of the gap", VALIDITY_GREEN_GAP, 0.05},
    {"slip_cell", "slip over facet", 0.5, 2},
    {"slip_contact", "slip over the sizes of the contact", 0.02, 0.1},
    {"normal", "turn of normals", 0.02, 0.1},
};
static const char *const COLOURS[] = {"unknown", "green", "amber", "red"};
/* Gaps below this part of the displacements are closed. */
static const PetscReal NO_GAP = 1e-9;
/* A value that exceeds a limit by no more than this part of it is the limit, as where a uniform strain is. */
static const PetscReal LIMIT_ROUNDING = 1e-9;

/* Friction, as a share of twice the strain energy: of the work that loads in proportion do. Collective. */
static PetscErrorCode ValiditySetFriction_Private(Fields fields, PetscReal sliding, Validity v)
{
  const PetscInt num_bodies = fields->vi->scene->num_bodies;
  PetscReal     *strain, potential, work = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(num_bodies, &strain));
  PetscCall(FieldsEnergy(fields, strain, &potential));
  for (PetscInt b = 0; b < num_bodies; b++) work += 2 * strain[b];
  PetscCall(PetscFree(strain));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &sliding, 1, MPIU_REAL, MPI_SUM, fields->vi->level->comm));
  v->friction = v->indicator[VALIDITY_SLIP_CELL].colour != VALIDITY_UNKNOWN && work > 0 ? sliding / work : NAN;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Colours, and the factor of the loads at which the first indicator is red. */
static void ValidityJudge_Private(PetscInt dim, const Largest largest[], Validity v)
{
  v->load_factor = PETSC_INFINITY;
  v->worst       = VALIDITY_GREEN;
  for (PetscInt k = 0; k < VALIDITY_COUNT; k++) {
    ValidityIndicator *indicator = &v->indicator[k];
    const PetscReal    value     = largest[k].value;
    const PetscBool    cells     = (PetscBool)(k == VALIDITY_STRAIN || k == VALIDITY_ROTATION);

    *indicator = (ValidityIndicator){.value = NAN, .at = {NAN, NAN, NAN}, .body = -1, .pair = -1};
    if (!(value >= 0)) continue;
    indicator->value = value;
    for (PetscInt i = 0; i < dim; i++) indicator->at[i] = largest[k].at[i];
    *(cells ? &indicator->body : &indicator->pair) = (PetscInt)largest[k].owner;
    indicator->colour                              = value <= (1 + LIMIT_ROUNDING) * KINDS[k].green ? VALIDITY_GREEN
                                                     : value > KINDS[k].red                         ? VALIDITY_RED
                                                                                                    : VALIDITY_AMBER;
    v->worst                                       = PetscMax(v->worst, indicator->colour);
    if (value > 0) v->load_factor = PetscMin(v->load_factor, KINDS[k].red / value);
  }
  if (PetscIsInfReal(v->load_factor)) v->load_factor = NAN;
}

/* Whether all sides touch to begin with where they may meet. Collective. */
static PetscErrorCode ValiditySetHomogeneous_Private(Fields fields, Validity v)
{
  const VI  vi  = fields->vi;
  PetscReal gap = 0;

  PetscFunctionBeginUser;
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    for (PetscInt a = 0; a < vi->pairs[p]->num; a++) gap = PetscMax(gap, PetscAbsReal(vi->pairs[p]->gap[a]));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &gap, 1, MPIU_REAL, MPIU_MAX, vi->level->comm));
  v->homogeneous = (PetscBool)(gap <= NO_GAP * fields->u_ref);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The indicators, which are computed once for each solution. Collective.
   [out] validity - borrowed from the fields */
static PetscErrorCode ValidityGet_Private(Fields fields, Validity *validity)
{
  const VI  vi = fields->vi;
  Largest   largest[VALIDITY_COUNT], left;
  PetscReal sliding = 0, strain = 0;
  GapErrors errors;
  Validity  v;

  PetscFunctionBeginUser;
  *validity = fields->validity;
  if (*validity) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscNew(&v));
  for (PetscInt k = 0; k < VALIDITY_COUNT; k++) largest[k] = (Largest){.value = -1};
  PetscCall(ValidityCellsMeasure(fields, largest, &strain));
  PetscCall(GapErrorsCreate(fields, &errors));
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    if (vi->pairs[p]->num_multipliers) PetscCall(ValidityPairMeasure(fields, p, strain, largest, &sliding, &errors));
  }
  PetscCall(LargestReduce(vi->level->comm, vi->level->dim, VALIDITY_COUNT - VALIDITY_GAP, &largest[VALIDITY_GAP]));
  if (largest[VALIDITY_GAP].value > VALIDITY_GREEN_GAP) {
    PetscCall(GapErrorsFollow(fields, &errors, &left));
    if (left.value < 0) largest[VALIDITY_GAP].value = 0; // no contact, and none by the errors
    if (left.value >= 0 && left.value < largest[VALIDITY_GAP].value) largest[VALIDITY_GAP] = left;
  }
  PetscCall(GapErrorsDestroy(&errors));
  ValidityJudge_Private(vi->level->dim, largest, v);
  PetscCall(ValiditySetFriction_Private(fields, sliding, v));
  PetscCall(ValiditySetHomogeneous_Private(fields, v));
  fields->validity = *validity = v;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* "rotation 0.182 at (1, 2)" */
static PetscErrorCode ValidityDescribe_Private(PetscInt dim, const Validity v, PetscInt k, char text[], size_t len)
{
  const ValidityIndicator *indicator = &v->indicator[k];

  PetscFunctionBeginUser;
  PetscCall(PetscSNPrintf(text, len, "%s %.3g at (%.4g, %.4g", KINDS[k].what, (double)indicator->value,
                          (double)indicator->at[0], (double)indicator->at[1]));
  if (dim == 3) {
    const size_t end = strlen(text);

    PetscCall(PetscSNPrintf(text + end, len - end, ", %.4g", (double)indicator->at[2]));
  }
  PetscCall(PetscStrlcat(text, ")", len));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ValidityWarn(Fields fields)
{
  const Scene              scene = fields->vi->scene;
  const ValidityIndicator *first;
  PetscInt                 leading = 0, others = 0;
  char                     text[256];
  Warning                  limit = {.code = "model_limit", .dim = scene->dim};
  Validity                 v;

  PetscFunctionBeginUser;
  PetscCall(ValidityGet_Private(fields, &v));
  if (v->worst < VALIDITY_AMBER) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt k = 1; k < VALIDITY_COUNT; k++) {
    if (v->indicator[k].colour == VALIDITY_UNKNOWN) continue;
    if (v->indicator[k].value / KINDS[k].red > (1 - LIMIT_ROUNDING) * v->indicator[leading].value / KINDS[leading].red)
      leading = k;
  }
  for (PetscInt k = 0; k < VALIDITY_COUNT; k++) others += k != leading && v->indicator[k].colour >= VALIDITY_AMBER;
  first = &v->indicator[leading];
  if (first->body >= 0) limit.body = scene->bodies[first->body].name;
  if (first->pair >= 0) limit.pair = scene->pairs[first->pair].name;
  PetscCall(PetscArraycpy(limit.at, first->at, scene->dim));
  limit.grave  = (PetscBool)(v->worst == VALIDITY_RED);
  limit.advice = limit.grave ? "check the units of loads, lengths and moduli, or reduce the loads"
                             : "expect errors of some per cent beside those of the mesh";
  PetscCall(ValidityDescribe_Private(scene->dim, v, leading, text, sizeof(text)));
  PetscCall(
      WarningAdd(&limit, "small displacements %s: %s in %s, limit %.3g%s; the model holds up to %.3g times these loads",
                 limit.grave ? "are exceeded" : "hold roughly", text, limit.body ? limit.body : limit.pair,
                 (double)KINDS[leading].red, others ? " (and others, see validity)" : "", (double)v->load_factor));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ValidityAdd(Fields fields, cJSON *root)
{
  cJSON   *object = cJSON_AddObjectToObject(root, "validity"), *all = cJSON_AddObjectToObject(object, "indicators");
  Validity v = NULL;

  PetscFunctionBeginUser;
  if (fields) PetscCall(ValidityGet_Private(fields, &v));
  for (PetscInt k = 0; k < VALIDITY_COUNT; k++) {
    cJSON          *item  = cJSON_AddObjectToObject(all, KINDS[k].name);
    const PetscBool known = (PetscBool)(v && v->indicator[k].colour != VALIDITY_UNKNOWN);

    JSONAddReal(item, "value", known ? v->indicator[k].value : NAN);
    if (known)
      JSONAddReals(item, "at", fields->vi->level->dim, v->indicator[k].at);
    else
      cJSON_AddNullToObject(item, "at");
    if (known)
      cJSON_AddStringToObject(item, "colour", COLOURS[v->indicator[k].colour]);
    else
      cJSON_AddNullToObject(item, "colour");
    JSONAddReal(item, "red", KINDS[k].red);
  }
  JSONAddReal(object, "load_factor", v ? v->load_factor : NAN);
  if (v)
    cJSON_AddBoolToObject(object, "homogeneous", v->homogeneous);
  else
    cJSON_AddNullToObject(object, "homogeneous");
  JSONAddReal(object, "friction_neglected", v ? v->friction : NAN);
  PetscFunctionReturn(PETSC_SUCCESS);
}

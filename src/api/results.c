/* results.c -- getters of the last solution of a handle. */
#include "api/apiimpl.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "base/compat.h"
#include "base/log.h"
#include "base/options.h"
#include "result/pairsum.h"

static PetscErrorCode ResultsNeedFields_Private(Mortise m, const char function[])
{
  PetscFunctionBeginUser;
  PetscCall(ApiNeedRun(m, function));
  if (m->run->checked) PetscCall(UserErrorRaise(m->comm, "%s(): %s; omit the option", function, m->run->report.reason));
  if (!m->run->fields)
    PetscCall(UserErrorRaise(m->comm, "%s(): the scene has no solution: %s", function, m->run->report.reason));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Index of a pair. User error: there is none of that name. */
static PetscErrorCode ResultsFindPair_Private(Mortise m, const char function[], const char pair[], PetscInt *p)
{
  const Scene  scene = m->scene;
  const char **names, *near;
  char         suggestion[PETSC_MAX_OPTION_NAME] = "";

  PetscFunctionBeginUser;
  PetscCall(ApiNeedName(m, function, pair, "pair"));
  for (*p = 0; *p < scene->num_pairs; ++*p)
    if (!strcmp(scene->pairs[*p].name, pair)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(scene->num_pairs, &names));
  for (PetscInt i = 0; i < scene->num_pairs; ++i) names[i] = scene->pairs[i].name;
  near = UserErrorNearest(pair, scene->num_pairs, names);
  PetscCall(PetscFree(names));
  if (near) PetscCall(PetscSNPrintf(suggestion, sizeof(suggestion), "; did you mean %s?", near));
  PetscCall(UserErrorRaise(m->comm, "%s(): -pairs has no pair %s%s", function, pair, suggestion));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortiseGetStatus(Mortise m, int *exit_code)
{
  PetscErrorCode error = PETSC_SUCCESS;

  PetscFunctionBeginUser;
  API_VALID(m);
  PetscCall(ApiBegin(m));
  *exit_code = (int)m->verdict;
  if (!m->solved_once) error = ApiNeedRun(m, "MortiseGetStatus");
  PetscCall(ApiEnd(m, error));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortiseGetReason(Mortise m, const char **sentence)
{
  PetscErrorCode error;

  PetscFunctionBeginUser;
  *sentence = "";
  API_VALID(m);
  PetscCall(ApiBegin(m));
  error = ApiNeedRun(m, "MortiseGetReason");
  PetscCall(ApiEnd(m, error));
  if (m->run->report.reason[0])
    *sentence = m->run->report.reason;
  else if (!m->run->certificate.holds && m->run->fields)
    *sentence = m->run->certificate.failure;
  else if (!m->run->solved)
    *sentence = "the solvers of -cross_check disagree";
  else if (m->verdict != MORTISE_SOLVED)
    *sentence = "there are warnings, and -warnings error";
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* --- files and lines ------------------------------------------------------------------------------------ */

/* The summary lists the options of this handle. */
static PetscErrorCode ResultsListOptions_Private(Mortise m)
{
  PetscFunctionBeginUser;
  if (m->options || ApiJoined()) PetscCall(OptionsListDatabase());
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode ResultsWrite_Private(Mortise m)
{
  const Run    run = m->run;
  Output       output;
  SummaryInput input;

  PetscFunctionBeginUser;
  /* a study or load steps have written their files */
  if (m->solved_once && (!run || m->scene->steps.num)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ApiNeedRun(m, "MortiseWrite"));
  PetscCall(ResultsListOptions_Private(m));
  PetscCall(OutputCreate(m->comm, &output));
  if (m->scene->output) {
    PetscCall(LogStageBegin(STAGE_OUTPUT));
    if (run->checked)
      PetscCall(OutputAddSetup(output, run->vi, &run->setup));
    else
      PetscCall(run->refused ? OutputAddMotion(output, run->vi, &run->solvability->motion)
                             : OutputAddFields(output, run->fields));
    PetscCall(LogStageEnd(STAGE_OUTPUT));
  }
  input = RunSummary(run);
  PetscCall(SummaryWrite(&input, &output));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortiseWrite(Mortise m)
{
  PetscErrorCode error;

  PetscFunctionBeginUser;
  API_VALID(m);
  PetscCall(ApiBegin(m));
  error = ResultsWrite_Private(m);
  PetscCall(ApiEnd(m, error));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode ResultsView_Private(Mortise m)
{
  SummaryInput input;

  PetscFunctionBeginUser;
  PetscCall(ApiNeedScene(m, "MortiseView"));
  if (!m->run) {
    PetscCall(SceneView(m->scene));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  input = RunSummary(m->run);
  PetscCall(SummaryPrint(&input));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* PetscPrintf(), by which everything is printed, writes to PETSC_STDOUT. */
PetscErrorCode MortiseView(Mortise m, PetscViewer viewer)
{
  FILE *const    before = PETSC_STDOUT;
  PetscBool      ascii  = PETSC_TRUE;
  PetscErrorCode error;

  PetscFunctionBeginUser;
  API_VALID(m);
  PetscCall(ApiBegin(m));
  if (viewer) PetscCall(PetscObjectTypeCompare((PetscObject)viewer, PETSCVIEWERASCII, &ascii));
  if (viewer && ascii) {
    PetscCall(PetscViewerFlush(viewer));
    PetscCall(PetscViewerASCIIGetPointer(viewer, &PETSC_STDOUT));
  }
  error = ascii ? ResultsView_Private(m) : UserErrorRaise(m->comm, "MortiseView(): the viewer is not of type ascii");
  if (viewer && ascii && PETSC_STDOUT) (void)fflush(PETSC_STDOUT);
  PETSC_STDOUT = before;
  PetscCall(ApiEnd(m, error));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* --- the summary ---------------------------------------------------------------------------------------- */

/* The summary on all ranks. */
static PetscErrorCode ResultsCreateSummary_Private(Mortise m, const char function[])
{
  SummaryInput input;
  PetscMPIInt  rank;
  int          size = 0;

  PetscFunctionBeginUser;
  PetscCall(ApiNeedRun(m, function));
  if (m->summary) PetscFunctionReturn(PETSC_SUCCESS);
  input = RunSummary(m->run);
  PetscCall(ResultsListOptions_Private(m));
  PetscCall(SummaryCreate(&input, &m->summary));
  PetscCallMPI(MPI_Comm_rank(m->comm, &rank));
  if (m->summary) size = (int)strlen(m->summary) + 1;
  PetscCallMPI(MPI_Bcast(&size, 1, MPI_INT, 0, m->comm));
  if (rank) m->summary = malloc((size_t)size);
  PetscCheck(m->summary, PETSC_COMM_SELF, PETSC_ERR_MEM, "No memory for the summary");
  PetscCallMPI(MPI_Bcast(m->summary, size, MPI_CHAR, 0, m->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortiseGetSummary(Mortise m, const char **json)
{
  PetscErrorCode error;

  PetscFunctionBeginUser;
  API_VALID(m);
  PetscCall(ApiBegin(m));
  error = ResultsCreateSummary_Private(m, "MortiseGetSummary");
  PetscCall(ApiEnd(m, error));
  *json = m->summary;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The item of a path, or NULL. */
static const cJSON *ResultsFindItem_Private(const cJSON *item, const char path[])
{
  char key[PETSC_MAX_PATH_LEN];

  while (item && *path) {
    const size_t length = strcspn(path, "/");
    char        *end;
    long         place;

    snprintf(key, sizeof(key), "%.*s", (int)length, path);
    place = strtol(key, &end, 10);
    if (!cJSON_IsArray(item))
      item = cJSON_GetObjectItemCaseSensitive(item, key);
    else
      item = *end || place < 0 || place >= cJSON_GetArraySize(item) ? NULL : cJSON_GetArrayItem(item, (int)place);
    path += length + (path[length] == '/');
  }
  return item;
}

static PetscBool ResultsIsNumber_Private(const cJSON *item)
{
  return (PetscBool)(cJSON_IsNumber(item) || cJSON_IsBool(item) || cJSON_IsNull(item));
}

/* Numbers of an item: 1, or those of a list; 0 where there is anything else. */
static PetscInt ResultsCountNumbers_Private(const cJSON *item)
{
  const PetscInt size = cJSON_IsArray(item) ? cJSON_GetArraySize(item) : 0;

  for (PetscInt i = 0; i < size; ++i) {
    if (!ResultsIsNumber_Private(cJSON_GetArrayItem(item, (int)i))) return 0;
  }
  return ResultsIsNumber_Private(item) ? 1 : size;
}

static PetscErrorCode ResultsGetNumbers_Private(Mortise m, const char path[], PetscInt num, PetscReal values[])
{
  const cJSON *item;
  PetscInt     size;

  PetscFunctionBeginUser;
  PetscCall(ResultsCreateSummary_Private(m, "MortiseGetNumbers"));
  PetscCall(ApiNeedName(m, "MortiseGetNumbers", path, "number"));
  if (!m->numbers) m->numbers = cJSON_Parse(m->summary);
  item = ResultsFindItem_Private(m->numbers, path);
  if (!item) PetscCall(UserErrorRaise(m->comm, "MortiseGetNumbers(): the summary has nothing at %s", path));
  size = ResultsCountNumbers_Private(item);
  if (size != num)
    PetscCall(UserErrorRaise(
        m->comm, "MortiseGetNumbers(): %" PetscInt_FMT " numbers wanted at %s of the summary, there %s %" PetscInt_FMT,
        num, path, size == 1 ? "is" : "are", size));
  for (PetscInt i = 0; i < num; ++i) {
    const cJSON *one = cJSON_IsArray(item) ? cJSON_GetArrayItem(item, (int)i) : item;

    values[i] = cJSON_IsNumber(one) ? one->valuedouble : cJSON_IsBool(one) ? cJSON_IsTrue(one) : NAN;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortiseGetNumbers(Mortise m, const char path[], PetscInt num, PetscReal values[])
{
  PetscErrorCode error;

  PetscFunctionBeginUser;
  API_VALID(m);
  PetscCall(ApiBegin(m));
  error = ResultsGetNumbers_Private(m, path, num, values);
  PetscCall(ApiEnd(m, error));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* --- numbers -------------------------------------------------------------------------------------------- */

static PetscErrorCode ResultsGetForce_Private(Mortise m, const char pair[], PairSum *sum)
{
  PetscInt p;

  PetscFunctionBeginUser;
  PetscCall(ApiNeedRun(m, "MortiseGetPairForce"));
  PetscCall(ResultsFindPair_Private(m, "MortiseGetPairForce", pair, &p));
  *sum = PairSumUnknown();
  if (m->run->fields) PetscCall(PairSumCompute(m->run->fields, p, sum));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortiseGetPairForce(Mortise m, const char pair[], PetscReal force[3], PetscReal *normal)
{
  PairSum        sum;
  PetscErrorCode error;

  PetscFunctionBeginUser;
  API_VALID(m);
  PetscCall(ApiBegin(m));
  error = ResultsGetForce_Private(m, pair, &sum);
  PetscCall(ApiEnd(m, error));
  for (PetscInt k = 0; force && k < 3; ++k) force[k] = k < m->scene->dim ? sum.force[k] : 0;
  if (normal) *normal = sum.normal_force;
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode ResultsGetEnergy_Private(Mortise m, PetscReal *strain, PetscReal *potential)
{
  const PetscInt num = m->scene ? m->scene->num_bodies : 0;
  PetscReal     *bodies;

  PetscFunctionBeginUser;
  PetscCall(ApiNeedRun(m, "MortiseGetEnergy"));
  *strain = *potential = NAN;
  if (!m->run->fields) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(num, &bodies));
  PetscCall(FieldsEnergy(m->run->fields, bodies, potential));
  *strain = 0;
  for (PetscInt b = 0; b < num; ++b) *strain += bodies[b];
  PetscCall(PetscFree(bodies));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortiseGetEnergy(Mortise m, PetscReal *strain, PetscReal *potential)
{
  PetscReal      values[2];
  PetscErrorCode error;

  PetscFunctionBeginUser;
  API_VALID(m);
  PetscCall(ApiBegin(m));
  error = ResultsGetEnergy_Private(m, &values[0], &values[1]);
  PetscCall(ApiEnd(m, error));
  if (strain) *strain = values[0];
  if (potential) *potential = values[1];
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortiseGetCertificate(Mortise m, MortiseCertificate *certificate)
{
  PetscErrorCode     error;
  const Certificate *c;
  PetscReal          friction;

  PetscFunctionBeginUser;
  API_VALID(m);
  PetscCall(ApiBegin(m));
  error = ApiNeedRun(m, "MortiseGetCertificate");
  PetscCall(ApiEnd(m, error));
  c            = &m->run->certificate;
  friction     = PetscMax(c->friction.cone, PetscMax(c->friction.slip, c->friction.dissipation));
  *certificate = (MortiseCertificate){.rounding        = c->rounding,
                                      .equilibrium     = c->equilibrium,
                                      .gap             = c->gap,
                                      .pressure        = c->pressure,
                                      .complementarity = c->complementarity,
                                      .force           = c->force,
                                      .moment          = c->moment,
                                      .friction        = friction,
                                      .limit           = c->limit,
                                      .holds           = c->holds};
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* --- fields --------------------------------------------------------------------------------------------- */

static PetscErrorCode ResultsNeedMesh_Private(Mortise m, const char function[])
{
  PetscFunctionBeginUser;
  if (!m->mesh) PetscCall(UserErrorRaise(m->comm, "%s(): there is no mesh yet; call MortiseSetUp() before", function));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortiseGetDM(Mortise m, DM *dm)
{
  PetscErrorCode error;

  PetscFunctionBeginUser;
  API_VALID(m);
  PetscCall(ApiBegin(m));
  error = ResultsNeedMesh_Private(m, "MortiseGetDM");
  PetscCall(ApiEnd(m, error));
  *dm = MeshFinest(m->mesh)->dm;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A Vec of nodal values in the layout of the finest level, from values of this rank's nodes.
   [in] values - [num_owned][bs] */
static PetscErrorCode ResultsCreateNodal_Private(const Level *level, PetscInt bs, const PetscReal values[], Vec *v)
{
  PetscScalar *array;

  PetscFunctionBeginUser;
  PetscCall(VecCreate(level->comm, v));
  PetscCall(VecSetSizes(*v, bs * level->num_owned, bs * level->num_global));
  PetscCall(VecSetBlockSize(*v, bs));
  PetscCall(VecSetType(*v, VECSTANDARD));
  PetscCall(VecGetArrayWrite(*v, &array));
  for (PetscInt i = 0; i < bs * level->num_owned; ++i) array[i] = values[i];
  PetscCall(VecRestoreArrayWrite(*v, &array));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode ResultsGetCoordinates_Private(Mortise m)
{
  const Level *level;

  PetscFunctionBeginUser;
  PetscCall(ResultsNeedMesh_Private(m, "MortiseGetCoordinates"));
  level = MeshFinest(m->mesh);
  if (!m->coordinates) PetscCall(ResultsCreateNodal_Private(level, level->dim, level->coords, &m->coordinates));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortiseGetCoordinates(Mortise m, Vec *x)
{
  PetscErrorCode error;

  PetscFunctionBeginUser;
  API_VALID(m);
  PetscCall(ApiBegin(m));
  error = ResultsGetCoordinates_Private(m);
  PetscCall(ApiEnd(m, error));
  *x = m->coordinates;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortiseGetDisplacement(Mortise m, Vec *u)
{
  PetscErrorCode error;

  PetscFunctionBeginUser;
  API_VALID(m);
  PetscCall(ApiBegin(m));
  error = ResultsNeedFields_Private(m, "MortiseGetDisplacement");
  PetscCall(ApiEnd(m, error));
  *u = m->run->fields->u;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Values of a pair, made once. [out] values - borrowed */
static PetscErrorCode ResultsGetPair_Private(Mortise m, const char function[], const char pair[], PairValues **values)
{
  const Level *level;
  PetscInt     p;

  PetscFunctionBeginUser;
  PetscCall(ResultsNeedFields_Private(m, function));
  PetscCall(ResultsFindPair_Private(m, function, pair, &p));
  *values = &m->pairs[p];
  if ((*values)->known) PetscFunctionReturn(PETSC_SUCCESS);
  level = m->run->vi->level;
  PetscCall(PairFieldsCreate(m->run->fields, p, &(*values)->nodal));
  PairFieldsOmitBeyond(m->run->vi->pairs[p], &(*values)->nodal);
  PetscCall(ResultsCreateNodal_Private(level, 1, (*values)->nodal.pressure, &(*values)->pressure));
  PetscCall(ResultsCreateNodal_Private(level, 1, (*values)->nodal.gap, &(*values)->gap));
  (*values)->known = PETSC_TRUE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortiseGetPressure(Mortise m, const char pair[], Vec *p)
{
  PairValues    *values = NULL;
  PetscErrorCode error;

  PetscFunctionBeginUser;
  API_VALID(m);
  PetscCall(ApiBegin(m));
  error = ResultsGetPair_Private(m, "MortiseGetPressure", pair, &values);
  PetscCall(ApiEnd(m, error));
  *p = values->pressure;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortiseGetGap(Mortise m, const char pair[], Vec *g)
{
  PairValues    *values = NULL;
  PetscErrorCode error;

  PetscFunctionBeginUser;
  API_VALID(m);
  PetscCall(ApiBegin(m));
  error = ResultsGetPair_Private(m, "MortiseGetGap", pair, &values);
  PetscCall(ApiEnd(m, error));
  *g = values->gap;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortiseGetPairStatus(Mortise m, const char pair[], PetscInt *num, const PetscInt *status[])
{
  PairValues    *values = NULL;
  PetscErrorCode error;

  PetscFunctionBeginUser;
  API_VALID(m);
  PetscCall(ApiBegin(m));
  error = ResultsGetPair_Private(m, "MortiseGetPairStatus", pair, &values);
  PetscCall(ApiEnd(m, error));
  *num    = m->run->vi->level->num_owned;
  *status = values->nodal.status;
  PetscFunctionReturn(PETSC_SUCCESS);
}

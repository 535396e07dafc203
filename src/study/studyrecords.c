/* studyrecords.c -- records of the runs of a study. */
#include <math.h>
#include "base/compat.h"
#include "result/errors.h"
#include "result/estimate.h"
#include "base/memory.h"
#include "result/pairsum.h"
#include "result/probes.h"
#include "study/studyimpl.h"

static const char *const axes[] = {"x", "y", "z"};

/* --- names ---------------------------------------------------------------------------------------------- */

/* Appends a quantity whose size is its own value. [in] owner, axis - may be "" */
static Quantity *StudyAddQuantity_Private(Study study, const char key[], const char label[], const char owner[],
                                          const char axis[])
{
  Quantity *quantity = &study->quantities[study->num_quantities];

  quantity->size = study->num_quantities++;

  snprintf(quantity->name, sizeof(quantity->name), "%s%s%s%s", owner, owner[0] ? "_" : "", key, axis);
  snprintf(quantity->label, sizeof(quantity->label), "%s%s%s%s", owner, owner[0] ? ": " : "", label, axis);
  return quantity;
}

/* Names the quantities, in the order of RecordValues_Private(). */
static PetscErrorCode StudyNameQuantities_Private(Study study)
{
  const Scene    scene = study->scene;
  const PetscInt dim   = scene->dim;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(1 + scene->num_bodies + scene->num_pairs * (1 + dim) + scene->num_probes * (dim + 1),
                         &study->quantities));
  StudyAddQuantity_Private(study, "potential", "potential energy", "", "");
  for (PetscInt b = 0; b < scene->num_bodies; b++)
    StudyAddQuantity_Private(study, "strain_energy", "strain energy", scene->bodies[b].name, "");
  for (PetscInt p = 0; p < scene->num_pairs; p++) {
    const PetscInt normal =
        StudyAddQuantity_Private(study, "normal_force", "normal force", scene->pairs[p].name, "")->size;

    for (PetscInt k = 0; k < dim; k++)
      StudyAddQuantity_Private(study, "force_", "force ", scene->pairs[p].name, axes[k])->size = normal;
  }
  for (PetscInt i = 0; i < scene->num_probes; i++) {
    const PetscInt first = study->num_quantities;

    for (PetscInt k = 0; k < dim; k++)
      StudyAddQuantity_Private(study, "displacement_", "displacement ", scene->probes[i].name, axes[k])->size = first;
    StudyAddQuantity_Private(study, "von_mises", "von Mises stress", scene->probes[i].name, "");
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static void StudyAddErrors_Private(Study study, const char owner[], const char first[], const char second[])
{
  const char *const kinds[] = {first, second};

  for (int i = 0; i < 2; i++) {
    ErrorName *error = &study->errors[study->num_errors++];

    snprintf(error->name, sizeof(error->name), "%s%s%s", owner, owner[0] ? "_" : "", kinds[i]);
  }
}

/* Names the errors, in the order of RecordErrors_Private(): of all bodies together, or of those with an exact
   solution. */
static PetscErrorCode StudyNameErrors_Private(Study study)
{
  const Scene scene = study->scene;
  PetscInt    known = 0;

  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < scene->num_bodies; b++) known += scene->bodies[b].exact != NULL;
  study->exact = (PetscBool)(known > 0);
  for (PetscInt p = 0; p < scene->num_pairs; p++) study->exact = (PetscBool)(study->exact || scene->pairs[p].exact);
  PetscCall(PetscCalloc1(2 * (1 + known + scene->num_pairs), &study->errors));
  if (!study->exact || known == scene->num_bodies) {
    StudyAddErrors_Private(study, "", "energy_error", "l2_error");
  } else {
    for (PetscInt b = 0; b < scene->num_bodies; b++) {
      if (scene->bodies[b].exact) StudyAddErrors_Private(study, scene->bodies[b].name, "energy_error", "l2_error");
    }
  }
  for (PetscInt p = 0; p < scene->num_pairs; p++) {
    if (scene->pairs[p].exact)
      StudyAddErrors_Private(study, scene->pairs[p].name, "pressure_l2_error", "pressure_weighted_error");
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* --- create and destroy --------------------------------------------------------------------------------- */

PetscErrorCode StudyCreate(Scene scene, Study *study_out)
{
  Study study;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&study));
  study->scene      = scene;
  study->num_orders = scene->study.num_orders;
  study->reference = study->best = -1;
  study->capacity                = scene->study.num_orders * scene->study.levels;
  PetscCall(PetscMalloc1(scene->num_bodies, &study->own_orders));
  for (PetscInt b = 0; b < scene->num_bodies; b++) study->own_orders[b] = scene->bodies[b].order;
  PetscCall(PetscCalloc1(study->capacity, &study->records));
  PetscCall(StudyNameQuantities_Private(study));
  PetscCall(StudyNameErrors_Private(study));
  *study_out = study;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode StudyDestroy(Study *study)
{
  PetscFunctionBeginUser;
  if (!*study) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt r = 0; r < (*study)->num; r++) {
    PetscCall(PetscFree2((*study)->records[r].values, (*study)->records[r].errors));
    PetscCall(VecDestroy(&(*study)->records[r].u));
  }
  for (PetscInt o = 0; o < STUDY_MAX_ORDERS; o++) {
    PetscCall(MeshDestroy(&(*study)->mesh[o]));
    PetscCall(PetscFree((*study)->marked[o]));
    PetscCall(MeshHistoryDestroy(&(*study)->history[o]));
  }
  PetscCall(PetscFree((*study)->own_orders));
  PetscCall(PetscFree((*study)->records));
  PetscCall(PetscFree((*study)->quantities));
  PetscCall(PetscFree((*study)->errors));
  cJSON_Delete((*study)->summary);
  PetscCall(PetscFree(*study));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode StudyAddRecord(Study study, PetscInt order, PetscInt level, Record **record)
{
  Record *r = &study->records[study->num++];

  PetscFunctionBeginUser;
  PetscCheck(study->num <= study->capacity, PETSC_COMM_SELF, PETSC_ERR_PLIB, "More runs than levels times orders");
  *r = (Record){.order = order, .level = level, .state = RECORD_SKIPPED, .cells = -1, .iterations = -1};
  r->linear_iterations = r->active = -1;
  r->h = r->estimate = r->total = r->with_coarser = r->rank_seconds = r->processor = r->forecast = r->memory =
      r->own_memory                                                                              = NAN;
  for (int s = 0; s < STAGE_COUNT; s++) r->seconds[s] = NAN;
  PetscCall(PetscMalloc2(study->num_quantities, &r->values, study->num_errors, &r->errors));
  for (PetscInt q = 0; q < study->num_quantities; q++) r->values[q] = NAN;
  for (PetscInt e = 0; e < study->num_errors; e++) r->errors[e] = (RecordError){NAN, NAN, NAN};
  *record = r;
  PetscFunctionReturn(PETSC_SUCCESS);
}

Record *StudyFindCoarser(Study study, PetscInt order, PetscInt level)
{
  Record *found = NULL;

  for (PetscInt r = 0; r < study->num; r++) {
    Record *record = &study->records[r];

    if (record->order != order || record->level >= level || record->state != RECORD_SOLVED) continue;
    if (!found || record->level > found->level) found = record;
  }
  return found;
}

/* --- results of a run ----------------------------------------------------------------------------------- */

PetscErrorCode RecordMesh(Record *record, Level *level)
{
  PetscReal square = 0;
  PetscInt  cells  = level->num_cells;

  PetscFunctionBeginUser;
  for (PetscInt c = 0; c < level->num_cells; c++) {
    for (PetscInt i = level->cell_start[c]; i < level->cell_start[c + 1]; i++) {
      for (PetscInt j = level->cell_start[c]; j < i; j++) {
        const PetscReal *a = &level->coords[level->cell_nodes[i] * level->dim];
        const PetscReal *b = &level->coords[level->cell_nodes[j] * level->dim];
        PetscReal        d = 0;

        for (PetscInt k = 0; k < level->dim; k++) d += PetscSqr(a[k] - b[k]);
        square = PetscMax(square, d);
      }
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &square, 1, MPIU_REAL, MPIU_MAX, level->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &cells, 1, MPIU_INT, MPI_SUM, level->comm));
  record->cells    = cells;
  record->unknowns = level->num_global * level->dim;
  record->h        = PetscSqrtReal(square);
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode RecordValues_Private(Study study, Run run, PetscReal values[])
{
  const Scene    scene = study->scene;
  const PetscInt dim   = scene->dim;
  PetscReal     *next  = values;

  PetscFunctionBeginUser;
  PetscCall(FieldsEnergy(run->fields, &values[1], next));
  next += 1 + scene->num_bodies;
  for (PetscInt p = 0; p < scene->num_pairs; p++) {
    PairSum sum;

    PetscCall(PairSumCompute(run->fields, p, &sum));
    *next++ = sum.normal_force;
    for (PetscInt k = 0; k < dim; k++) *next++ = sum.force[k];
  }
  for (PetscInt i = 0; i < scene->num_probes; i++) {
    PetscReal u[3], stress[6];

    PetscCall(ProbesEvaluate(run->fields, &scene->probes[i], u, stress));
    for (PetscInt k = 0; k < dim; k++) *next++ = u[k];
    *next++ = MaterialVonMises(stress);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static RecordError *RecordSetError_Private(RecordError *next, PetscReal absolute, PetscReal relative)
{
  *next = (RecordError){.absolute = absolute, .relative = relative, .rate = NAN};
  return next + 1;
}

static void RecordErrors_Private(Study study, const Errors *errors, RecordError *next)
{
  const Scene scene = study->scene;
  PetscInt    known = 0;

  for (PetscInt b = 0; b < scene->num_bodies; b++) known += scene->bodies[b].exact != NULL;
  for (PetscInt b = -1; b < scene->num_bodies; b++) {
    const PetscBool  all   = (PetscBool)(known == scene->num_bodies);
    const BodyError *error = b < 0 ? &errors->total : &errors->body[b];

    if (b < 0 ? !all : all || !scene->bodies[b].exact) continue;
    next = RecordSetError_Private(next, error->energy, error->energy_relative);
    next = RecordSetError_Private(next, error->l2, error->l2_relative);
  }
  for (PetscInt p = 0; p < scene->num_pairs; p++) {
    if (!scene->pairs[p].exact) continue;
    next = RecordSetError_Private(next, errors->pair[p].l2, errors->pair[p].l2_relative);
    next = RecordSetError_Private(next, errors->pair[p].weighted, errors->pair[p].weighted_relative);
  }
}

/* Sets times and memory of a run. Collective. */
static PetscErrorCode RecordCost_Private(Study study, Record *record)
{
  const MPI_Comm comm    = study->scene->comm;
  const Record  *coarser = StudyFindCoarser(study, record->order, record->level);
  PetscReal      before  = 0;
  PetscMPIInt    ranks;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(comm, &ranks));
  for (int s = 0; s < STAGE_COUNT; s++) record->seconds[s] = LogStageSeconds((LogStage)s);
  record->processor = LogProcessorSeconds();
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, record->seconds, STAGE_COUNT, MPIU_REAL, MPIU_MAX, comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &record->processor, 1, MPIU_REAL, MPIU_SUM, comm));
  record->total = 0;
  for (int s = 0; s < STAGE_COUNT; s++) record->total += record->seconds[s];
  if (coarser) before = coarser->with_coarser;
  record->with_coarser = before + record->total;
  record->rank_seconds = record->total * ranks;
  PetscCall(MemoryPeak(comm, &record->memory, NULL));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RecordRun(Study study, Run run, Record *record)
{
  const SolverReport *report = &run->report;

  PetscFunctionBeginUser;
  PetscCall(RecordCost_Private(study, record));
  record->state             = run->solved ? RECORD_SOLVED : RECORD_NOT_SOLVED;
  record->iterations        = report->iterations;
  record->linear_iterations = report->linear_iterations;
  record->active            = report->active;
  if (!run->solved) PetscCall(PetscStrncpy(record->reason, RunGetFailure(run), sizeof(record->reason)));
  if (!run->refused) {
    Estimate estimate;

    PetscCall(RecordValues_Private(study, run, record->values));
    PetscCall(EstimateGet(run->fields, &estimate));
    record->estimate = EstimateGetError(estimate, estimate->standard);
  }
  if (run->errors.any) RecordErrors_Private(study, &run->errors, record->errors);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* --- orders of convergence ------------------------------------------------------------------------------ */

/* Number of halvings of h between two meshes; for adaptive meshes, between uniform ones with as many
   unknowns. */
static PetscReal RecordHalvings_Private(Study study, const Record *coarser, const Record *record)
{
  if (study->scene->study.kind == STUDY_UNIFORM) return record->level - coarser->level;
  return PetscLog2Real((PetscReal)record->unknowns / coarser->unknowns) / study->scene->dim;
}

/* The rate is that of e_coarse / e = 2^(rate halvings). */
void StudyComputeRates(Study study)
{
  for (PetscInt r = 0; r < study->num; r++) {
    Record       *record  = &study->records[r];
    const Record *coarser = StudyFindCoarser(study, record->order, record->level);

    for (PetscInt e = 0; e < study->num_errors; e++) {
      RecordError *error = &record->errors[e];

      error->rate = NAN;
      if (!coarser || !(error->absolute > 0) || !(coarser->errors[e].absolute > 0)) continue;
      error->rate =
          PetscLog2Real(coarser->errors[e].absolute / error->absolute) / RecordHalvings_Private(study, coarser, record);
    }
  }
}

void RecordOrderText(const Record *record, char text[])
{
  if (record->order == STUDY_OWN_ORDERS)
    snprintf(text, ERROR_TEXT, "own orders");
  else
    snprintf(text, ERROR_TEXT, "order %" PetscInt_FMT, record->order);
}

/* meshcomparison.c -- differences between the solutions of a study and its reference. */
#include <math.h>
#include "base/compat.h"
#include "refinement/levelrefine.h"
#include "result/errors.h"
#include "study/promotion.h"
#include "study/studyimpl.h"

/* Position of an order in the study. */
static PetscInt MeshComparisonOrderIndex_Private(Study study, PetscInt order)
{
  PetscInt o = 0;

  while (o + 1 < study->num_orders && study->scene->study.orders[o] != order) o++;
  return o;
}

/* The finest solved run of the highest order with a solved run, -1 for none. */
static PetscInt MeshComparisonFindReference_Private(Study study)
{
  PetscInt found = -1;

  for (PetscInt r = 0; r < study->num; r++) {
    const Record *record = &study->records[r], *best = found < 0 ? NULL : &study->records[found];

    if (record->state != RECORD_SOLVED) continue;
    if (!best || record->order > best->order || (record->order == best->order && record->level > best->level))
      found = r;
  }
  return found;
}

/* Interpolates the displacement of a record to the mesh of the reference.
   [out] v - ghosted, owned by the caller; NULL if the record is not solved, or on a finer level */
static PetscErrorCode MeshComparisonPromoteRecord_Private(Study study, const Record *record, const Record *reference,
                                                          Vec *v)
{
  const Mesh     mesh  = study->mesh[MeshComparisonOrderIndex_Private(study, record->order)];
  const Mesh     goal  = study->mesh[MeshComparisonOrderIndex_Private(study, reference->order)];
  const PetscInt first = goal->own, to = first + reference->level; // meshes of all orders have the same levels
  Vec            low;
  Mat            embedding;

  PetscFunctionBeginUser;
  *v = NULL;
  if (record->state != RECORD_SOLVED || record->level > reference->level || mesh->num_levels <= to)
    PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PromotionApply(mesh, first + record->level, to, record->u, v));
  if (mesh == goal) PetscFunctionReturn(PETSC_SUCCESS);
  low = *v;
  PetscCall(LevelCreateEmbedding(&mesh->levels[to], &goal->levels[to], &embedding));
  PetscCall(PromotionProlong(embedding, &goal->levels[to], low, v));
  PetscCall(MatDestroy(&embedding));
  PetscCall(VecDestroy(&low));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshComparisonRun(Study study)
{
  const Scene scene = study->scene;
  BodyError  *bodies, total;
  Level      *level;

  PetscFunctionBeginUser;
  if (study->exact) PetscFunctionReturn(PETSC_SUCCESS);
  study->reference = MeshComparisonFindReference_Private(study);
  if (study->reference < 0) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(scene->num_bodies, &bodies));
  for (PetscInt r = 0; r < study->num; r++) {
    const Record *reference = &study->records[study->reference];
    const Mesh    mesh      = study->mesh[MeshComparisonOrderIndex_Private(study, reference->order)];
    Record       *record    = &study->records[r];
    Vec           v         = NULL;

    record->errors[0] = record->errors[1] = (RecordError){NAN, NAN, NAN};
    level                                 = &mesh->levels[mesh->own + reference->level];
    if (record != reference) PetscCall(MeshComparisonPromoteRecord_Private(study, record, reference, &v));
    if (!v) continue;
    PetscCall(ErrorsComputeDifference(scene, level, v, reference->u, bodies, &total));
    record->errors[0] = (RecordError){.absolute = total.energy, .relative = total.energy_relative, .rate = NAN};
    record->errors[1] = (RecordError){.absolute = total.l2, .relative = total.l2_relative, .rate = NAN};
    PetscCall(VecDestroy(&v));
  }
  PetscCall(PetscFree(bodies));
  PetscFunctionReturn(PETSC_SUCCESS);
}

void MeshComparisonReferenceText(Study study, char text[])
{
  text[0] = '\0';
  if (study->exact) {
    snprintf(text, ERROR_TEXT, "exact");
  } else if (study->reference >= 0) {
    const Record *record = &study->records[study->reference];
    char          order[ERROR_TEXT];

    RecordOrderText(record, order);
    snprintf(text, ERROR_TEXT, "%.30s, level %" PetscInt_FMT, order, record->level);
  }
}

/* envelope.c -- the largest errors of all load steps on the same mesh. */
#include "study/envelope.h"
#include "base/compat.h"
#include "study/marking.h"

/* Displacements below this part of earlier ones are rounding. */
static const PetscReal ROUNDING = 1e-12;

PetscErrorCode EnvelopeCreate(PetscInt num, Envelope *envelope)
{
  PetscFunctionBeginUser;
  *envelope = (Envelope){.num = num};
  PetscCall(PetscCalloc1(num, &envelope->step));
  PetscCall(PetscCalloc1(num, &envelope->u));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EnvelopeDestroy(Envelope *envelope)
{
  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < envelope->num; i++) {
    PetscCall(MeshHistoryDestroy(&envelope->step[i]));
    PetscCall(VecDestroy(&envelope->u[i]));
  }
  PetscCall(PetscFree(envelope->step));
  PetscCall(PetscFree(envelope->u));
  PetscCall(PetscFree(envelope->cell));
  envelope->num = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

static const SolvedMesh *EnvelopeGetLast_Private(const Envelope *envelope, PetscInt i)
{
  return &envelope->step[i].mesh[envelope->step[i].num - 1];
}

/* A solution that is rounding of an earlier one, as where a body is let go, has no error. Collective. */
static PetscErrorCode EnvelopeDropRounding_Private(Envelope *envelope, PetscInt i)
{
  SolvedMesh *mesh    = &envelope->step[i].mesh[envelope->step[i].num - 1];
  PetscReal   largest = 0, size;

  PetscFunctionBeginUser;
  for (PetscInt j = 0; j <= i; j++) {
    PetscCall(VecNorm(envelope->u[j], NORM_INFINITY, &size));
    largest = PetscMax(largest, size);
  }
  if (size <= ROUNDING * largest) {
    mesh->norm   = 0;
    mesh->missed = PETSC_FALSE;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscReal EnvelopeGetError(const Envelope *envelope, PetscInt i)
{
  return SolvedMeshGetError(EnvelopeGetLast_Private(envelope, i));
}

PetscReal EnvelopeGetSeconds(const Envelope *envelope)
{
  PetscReal sum = 0;

  for (PetscInt i = 0; i < envelope->num; i++) sum += EnvelopeGetLast_Private(envelope, i)->seconds;
  return sum;
}

/* Takes the relative errors of cells, where they are the largest so far. A solution that is rounding has
   none, unless contact was missed. */
static PetscErrorCode EnvelopeTakeCells_Private(Envelope *envelope, const SolvedMesh *mesh, Run run)
{
  const PetscInt cells = run->vi->level->num_cells;
  Estimate       estimate;
  PetscReal      whole;

  PetscFunctionBeginUser;
  PetscCall(EstimateGet(run->fields, &estimate));
  whole = mesh->norm > 0 ? mesh->norm : mesh->missed ? estimate->squared : 0;
  for (PetscInt c = 0; c < cells && whole > 0; c++)
    envelope->cell[c] = PetscMax(envelope->cell[c], estimate->cell[c] / whole);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EnvelopeAdd(Envelope *envelope, PetscInt i, Run run, PetscReal seconds)
{
  PetscFunctionBeginUser;
  if (!i) {
    PetscCall(PetscFree(envelope->cell));
    PetscCall(PetscCalloc1(run->vi->level->num_cells, &envelope->cell));
    envelope->worst = 0;
  }
  PetscCall(PetscObjectReference((PetscObject)run->fields->u));
  PetscCall(VecDestroy(&envelope->u[i]));
  envelope->u[i] = run->fields->u;
  PetscCall(MeshHistoryAdd(&envelope->step[i], run, seconds));
  PetscCall(EnvelopeDropRounding_Private(envelope, i));
  PetscCall(MeshHistoryDescribe(&envelope->step[i], run));
  if (EnvelopeGetError(envelope, i) > EnvelopeGetError(envelope, envelope->worst)) envelope->worst = i;
  PetscCall(EnvelopeTakeCells_Private(envelope, EnvelopeGetLast_Private(envelope, i), run));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EnvelopeReturn(Envelope *envelope, PetscInt *meshes)
{
  PetscFunctionBeginUser;
  *meshes = envelope->step[0].num;
  for (PetscInt i = 1; i < envelope->num; i++) *meshes = PetscMin(*meshes, envelope->step[i].num);
  for (PetscInt i = 0; i < envelope->num && *meshes; i++)
    PetscCall(MeshHistoryTruncate(&envelope->step[i], *meshes - 1));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EnvelopeMark(const Envelope *envelope, const Level *level, PetscReal share, PetscInt **marked,
                            PetscReal *growth)
{
  return MarkingCreate(level, envelope->cell, 1, share, PETSC_FALSE, marked, growth);
}

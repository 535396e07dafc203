/* energybalance.c -- work, stored energy and dissipation of a load step.

   The strain energy of linear bodies changes by the mean of the internal forces K u before and after, times
   the change of the displacement. This is exact. The work of the contact forces is computed in the same way;
   its part beyond the dissipation is the defect. */
#include "base/compat.h"
#include "result/energybalance.h"
#include "result/frictionfields.h"

PetscErrorCode EnergyStateForget(EnergyState *state)
{
  PetscFunctionBeginUser;
  PetscCall(VecDestroy(&state->u));
  PetscCall(VecDestroy(&state->force));
  PetscCall(VecDestroy(&state->lambda));
  PetscCall(VecDestroy(&state->G));
  *state = (EnergyState){.rest = PETSC_FALSE};
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Energies of the present fields, and their forces. [out] state - owned by the caller */
static PetscErrorCode EnergyStateCreate_Private(Fields fields, Vec reactions, EnergyState *state)
{
  const VI    vi = fields->vi;
  PetscReal  *strain, potential;
  PetscScalar work;
  Vec         product;

  PetscFunctionBeginUser;
  *state = (EnergyState){.rest = PETSC_FALSE};
  PetscCall(PetscMalloc1(vi->scene->num_bodies, &strain));
  PetscCall(FieldsEnergy(fields, strain, &potential));
  for (PetscInt b = 0; b < vi->scene->num_bodies; b++) state->stored += strain[b];
  PetscCall(PetscFree(strain));
  PetscCall(MatCreateVecs(vi->K, NULL, &product));
  PetscCall(MatMult(vi->K, fields->u, product));
  PetscCall(VecDot(product, fields->u, &work));
  PetscCall(VecDestroy(&product));
  state->elastic = PetscRealPart(work) / 2;
  PetscCall(PetscObjectReference((PetscObject)fields->u));
  state->u = fields->u;
  PetscCall(VecDuplicate(vi->f, &state->force));
  PetscCall(VecWAXPY(state->force, 1, vi->f, reactions));
  if (!fields->lambda) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscObjectReference((PetscObject)fields->lambda));
  state->lambda = fields->lambda;
  PetscCall(VecDuplicate(vi->G, &state->G));
  PetscCall(VecCopy(vi->G, state->G));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* (before + after).change / 2. [in] before, from - NULL where they are zero */
static PetscErrorCode EnergyBalanceGetWork_Private(Vec before, Vec after, Vec from, Vec to, PetscReal *work)
{
  Vec         mean, change;
  PetscScalar product;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(after, &mean));
  PetscCall(VecDuplicate(to, &change));
  PetscCall(VecCopy(after, mean));
  PetscCall(VecCopy(to, change));
  if (before) PetscCall(VecAXPY(mean, 1, before));
  if (from) PetscCall(VecAXPY(change, -1, from));
  PetscCall(VecDot(mean, change, &product));
  PetscCall(VecDestroy(&mean));
  PetscCall(VecDestroy(&change));
  *work = PetscRealPart(product) / 2;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Work of moving partners and interferences: -lambda times the change of the gap, in rows without slip. At
   rest no gap is negative, and ties are closed. */
static PetscErrorCode EnergyBalanceGetGapWork_Private(VI vi, const EnergyState *before, const EnergyState *after,
                                                      PetscReal *work)
{
  const PetscReal *old = NULL, *held = NULL, *lambda, *gap;

  PetscFunctionBeginUser;
  *work = 0;
  if (!after->lambda) PetscFunctionReturn(PETSC_SUCCESS);
  if (before->lambda) {
    PetscCall(VecGetArrayRead(before->lambda, &held));
    PetscCall(VecGetArrayRead(before->G, &old));
  }
  PetscCall(VecGetArrayRead(after->lambda, &lambda));
  PetscCall(VecGetArrayRead(after->G, &gap));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const PetscBool tied = (PetscBool)(vi->pairs[vi->row_pair[r]]->spec->type == PAIR_TIED);
    const PetscReal rest = tied ? 0 : PetscMax(gap[r], 0);

    if (!tied && vi->row_direction[r]) continue;
    *work -= (lambda[r] + (held ? held[r] : 0)) / 2 * (gap[r] - (old ? old[r] : rest));
  }
  PetscCall(VecRestoreArrayRead(after->G, &gap));
  PetscCall(VecRestoreArrayRead(after->lambda, &lambda));
  if (before->lambda) {
    PetscCall(VecRestoreArrayRead(before->G, &old));
    PetscCall(VecRestoreArrayRead(before->lambda, &held));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, work, 1, MPIU_REAL, MPI_SUM, vi->level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Of two known states. */
static PetscErrorCode EnergyBalanceCompute_Private(Fields fields, const EnergyState *before, const EnergyState *after,
                                                   EnergyBalance *balance)
{
  const VI  vi     = fields->vi;
  PetscReal forces = 0, gaps = 0;

  PetscFunctionBeginUser;
  PetscCall(EnergyBalanceGetWork_Private(before->force, after->force, before->u, after->u, &forces));
  PetscCall(EnergyBalanceGetGapWork_Private(vi, before, after, &gaps));
  balance->stored = after->stored - before->stored;
  /* f has the forces of eigenstrains: their work and the change of the elastic energy are the change of the
     stored one */
  balance->work        = forces + gaps + balance->stored - (after->elastic - before->elastic);
  balance->dissipation = 0;
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    FrictionSum sum;

    if (!fields->lambda || !ScenePairHasFriction(vi->pairs[p]->spec)) continue;
    PetscCall(FrictionSumCompute(fields, p, &sum));
    balance->dissipation += sum.dissipation;
  }
  balance->defect = balance->work - balance->stored - balance->dissipation;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EnergyBalanceAdvance(Fields fields, Vec reactions, EnergyState *state, EnergyBalance *balance)
{
  EnergyState now;

  PetscFunctionBeginUser;
  *balance = (EnergyBalance){NAN, NAN, NAN, NAN};
  PetscCall(EnergyStateCreate_Private(fields, reactions, &now));
  if (state->rest || state->u) PetscCall(EnergyBalanceCompute_Private(fields, state, &now, balance));
  PetscCall(EnergyStateForget(state));
  *state = now;
  PetscFunctionReturn(PETSC_SUCCESS);
}

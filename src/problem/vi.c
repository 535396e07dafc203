/* vi.c -- from a scene and a mesh to one bound-constrained variational inequality, and back.

   Stages: supports and pairs (mortar), K and f (assembly), B, T, A and bounds (condense). Fixed unknowns are
   eliminated from A here, so that a solver sees inequalities only. */
#include "base/compat.h"
#include "contact/pairs.h"
#include "contact/slidingnodes.h"
#include "problem/elasticity.h"
#include "base/log.h"
#include "problem/vi.h"
#include "base/warning.h"
#include "problem/basisghosts.h"
#include "problem/kktsystem.h"
#include "problem/stiffness.h"
#include "problem/cyclicroles.h"
#include "problem/condensation.h"
#include "problem/condensedproduct.h"
#include "problem/loads.h"
#include "problem/frictionlaw.h"

/* The mean diagonal of K. */
static PetscErrorCode VIChooseStiffness_Private(VI vi)
{
  PetscScalar sum;
  PetscInt    n;

  PetscFunctionBeginUser;
  PetscCall(VecSum(vi->diagonal, &sum));
  PetscCall(VecGetSize(vi->diagonal, &n));
  vi->stiffness = PetscRealPart(sum) / n;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The expected size of the displacement: prescribed, by interference, or by the loads. */
static PetscErrorCode VIChooseLength_Private(VI vi)
{
  PetscReal force, interference = 0;

  PetscFunctionBeginUser;
  PetscCall(VecNorm(vi->f, NORM_1, &force));
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    for (PetscInt k = 0; k < vi->pairs[p]->num; k++) interference = PetscMax(interference, -vi->pairs[p]->gap[k]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &interference, 1, MPIU_REAL, MPIU_MAX, vi->level->comm));
  vi->length = PetscMax(force / vi->stiffness, PetscMax(interference, vi->support.max_value));
  if (vi->length <= 0) vi->length = 1; // no load, displacement or overlap: the solution is zero in any unit
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* b = T'f / (stiffness length) without the fixed unknowns, whose values are on the right-hand side.
   [in] values - [vi->num_fixed] */
static PetscErrorCode VISetLoad_Private(VI vi, const PetscReal values[])
{
  const PetscInt first = vi->level->dim * vi->level->node_begin;
  Vec            y, Ay;
  PetscScalar   *a;

  PetscFunctionBeginUser;
  if (vi->T)
    PetscCall(MatMultTranspose(vi->T, vi->f, vi->b));
  else
    PetscCall(VecCopy(vi->f, vi->b));
  PetscCall(VecScale(vi->b, 1 / (vi->stiffness * vi->length)));
  PetscCall(MatCreateVecs(vi->K, &y, &Ay));
  PetscCall(VecZeroEntries(y));
  PetscCall(VecGetArray(y, &a));
  for (PetscInt i = 0; i < vi->num_fixed; i++) a[vi->fixed[i] - first] = values[i] / vi->length;
  PetscCall(VecRestoreArray(y, &a));
  PetscCall(MatMult(vi->K, y, Ay));
  PetscCall(VecAXPY(vi->b, -1 / vi->stiffness, Ay));
  if (vi->Z) {
    PetscCall(MatMult(vi->Z, y, Ay));
    PetscCall(VecAXPY(vi->b, -1, Ay));
  }
  PetscCall(VecGetArray(vi->b, &a));
  for (PetscInt i = 0; i < vi->num_fixed; i++) a[vi->fixed[i] - first] = values[i] / vi->length;
  PetscCall(VecRestoreArray(vi->b, &a));
  PetscCall(VecDestroy(&y));
  PetscCall(VecDestroy(&Ay));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A = T'KT / stiffness with unit rows for the fixed unknowns, and b. [in] values - [vi->num_fixed] */
static PetscErrorCode VICondense_Private(VI vi, const PetscReal values[])
{
  const PetscInt first = vi->level->dim * vi->level->node_begin;
  Mat            scaled;

  PetscFunctionBeginUser;
  if (vi->T) {
    PetscCall(CondensationCreate(vi->K, vi->basis->change.factor, &vi->Z));
    PetscCall(BasisGhostsCreate(vi->K, vi->basis->change.factor, &vi->basis->ghosts));
  }
  if (vi->Z) PetscCall(MatScale(vi->Z, 1 / vi->stiffness));
  PetscCall(StiffnessCreateScaled(vi->K, 1 / vi->stiffness, &scaled));
  PetscCall(CondensedProductCreate(scaled, vi, &vi->S));
  PetscCall(MatDestroy(&scaled));
  PetscCall(VecDuplicate(vi->f, &vi->b));
  PetscCall(VISetLoad_Private(vi, values));
  PetscCall(PetscMalloc1(vi->num_fixed, &vi->fixed_local));
  for (PetscInt i = 0; i < vi->num_fixed; i++) vi->fixed_local[i] = vi->fixed[i] - first;
  PetscCall(CondensedMatrixCreateShell(vi, NULL, &vi->A));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode VIAssemble(VI vi)
{
  if (vi->assembled) return PETSC_SUCCESS;
  PetscFunctionBeginUser;
  PetscCall(LogStageBegin(STAGE_CONDENSE));
  PetscCall(MatDestroy(&vi->A));
  PetscCall(CondensedMatrixAssemble(vi->K, vi->stiffness, vi->Z, vi->num_fixed, vi->fixed, &vi->A));
  vi->assembled = PETSC_TRUE;
  PetscCall(LogStageEnd(STAGE_CONDENSE));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode VICreateRegularized(VI vi, Vec regularization, Mat *A)
{
  PetscFunctionBeginUser;
  if (vi->assembled) {
    PetscCall(MatDuplicate(vi->A, MAT_COPY_VALUES, A));
    PetscCall(MatDiagonalSet(*A, regularization, ADD_VALUES));
    PetscCall(MatSetOption(*A, MAT_SPD, PETSC_TRUE));
  } else {
    PetscCall(CondensedMatrixCreateShell(vi, regularization, A));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode VICreateUntied(VI vi, PetscInt p, Vec regularization, Mat *A)
{
  PetscInt *fixed, num = vi->num_fixed;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(vi->num_fixed, &fixed));
  for (PetscInt r = 0; r < vi->num_rows; r++) num -= vi->pairs[vi->row_pair[r]]->spec->type == PAIR_TIED ? 1 : 0;
  PetscCall(PetscArraycpy(fixed, vi->fixed, num)); // supports come first, then tied rows
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    if (vi->row_pair[r] != p && vi->pairs[vi->row_pair[r]]->spec->type == PAIR_TIED) fixed[num++] = vi->row_dof[r];
  }
  PetscCall(CondensedMatrixAssemble(vi->K, vi->stiffness, vi->Z, num, fixed, A));
  if (regularization) PetscCall(MatDiagonalSet(*A, regularization, ADD_VALUES));
  PetscCall(MatSetOption(*A, MAT_SPD, PETSC_TRUE));
  PetscCall(PetscFree(fixed));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* y_i <= nodal gap for contact rows. */
static PetscErrorCode VISetBounds_Private(VI vi)
{
  PetscFunctionBeginUser;
  PetscCall(VecSet(vi->upper, PETSC_INFINITY));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const Pair pair = vi->pairs[vi->row_pair[r]];
    if (pair->spec->type == PAIR_TIED || vi->row_direction[r]) continue;
    PetscCall(VecSetValue(vi->upper, vi->row_dof[r], pair->gap[vi->row_node[r]] / vi->length, INSERT_VALUES));
  }
  PetscCall(VecAssemblyBegin(vi->upper));
  PetscCall(VecAssemblyEnd(vi->upper));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Supports, contact and the matrices of one level.
   [in] scales - an inequality whose scales it shares, or NULL;
   [in] K - AIJ, in place of the level's own, or NULL */
static PetscErrorCode VICreateOnLevel_Private(Scene scene, Mesh mesh, Level *level, VI scales, Mat K, VI *vi_out)
{
  VI         vi;
  VIBasis    basis;
  PetscReal *values;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&vi));
  PetscCall(PetscNew(&basis));
  vi->scene = scene;
  vi->mesh  = mesh;
  vi->level = level;
  vi->basis = basis;
  PetscCall(LogStageBegin(STAGE_MORTAR));
  PetscCall(SupportCreate(level, scene, &vi->support));
  PetscCall(RigidModesCreate(level, &vi->support, scene->num_bodies, &vi->rigid_modes));
  vi->num_pairs = scene->num_pairs;
  PetscCall(PetscCalloc1(vi->num_pairs, &vi->pairs));
  PetscCall(PairsCreate(scene, level, &vi->support, vi->pairs));
  PetscCall(LogStageEnd(STAGE_MORTAR));
  PetscCall(LogStageBegin(STAGE_ASSEMBLY));
  PetscCall(ElasticityAssemble(scene, level, K ? NULL : &vi->K, &vi->f));
  if (K) PetscCall(PetscObjectReference((PetscObject)K));
  if (K) vi->K = K;
  PetscCall(MatCreateVecs(vi->K, &vi->diagonal, NULL));
  PetscCall(MatGetDiagonal(vi->K, vi->diagonal));
  PetscCall(LogStageEnd(STAGE_ASSEMBLY));
  PetscCall(LogStageBegin(STAGE_CONDENSE));
  PetscCall(CyclicRolesCheck(vi));
  PetscCall(NodeBasesCreate(vi, &basis->bases));
  PetscCall(CouplingsCreate(vi, &basis->couplings));
  PetscCall(KKTSystemCreate(vi, &basis->bases, &basis->couplings));
  PetscCall(BasisChangeCreate(vi, &basis->bases, &basis->couplings, &basis->change));
  vi->T = basis->change.T;
  if (scales) {
    vi->length    = scales->length;
    vi->stiffness = scales->stiffness;
  } else {
    PetscCall(VIChooseStiffness_Private(vi));
    PetscCall(VIChooseLength_Private(vi));
  }
  PetscCall(MatCreateVecs(vi->K, &vi->upper, &vi->lower));
  PetscCall(VecSet(vi->lower, PETSC_NINFINITY));
  PetscCall(VISetBounds_Private(vi));
  PetscCall(FrictionLawCreate(vi));
  PetscCall(BasisChangeGetFixed(vi, &basis->bases, &basis->couplings, &vi->num_fixed, &vi->fixed, &values));
  PetscCall(VICondense_Private(vi, values));
  PetscCall(PetscFree(values));
  PetscCall(LogStageEnd(STAGE_CONDENSE));
  *vi_out = vi;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode VICreate(Scene scene, Mesh mesh, VI *vi)
{
  PetscFunctionBeginUser;
  PetscCall(VICreateOnLevel_Private(scene, mesh, MeshFinest(mesh), NULL, NULL, vi));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode VICreateFiner(VI vi, VI *fine)
{
  PetscFunctionBeginUser;
  PetscCall(VICreateOnLevel_Private(vi->scene, vi->mesh, MeshFinest(vi->mesh), vi, NULL, fine));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode VIReplaceStiffness(VI vi, Mat K)
{
  PetscReal *values;

  PetscFunctionBeginUser;
  PetscCall(LogStageBegin(STAGE_CONDENSE));
  PetscCall(MatDestroy(&vi->K));
  PetscCall(MatDestroy(&vi->A));
  PetscCall(MatDestroy(&vi->S));
  PetscCall(MatDestroy(&vi->Z));
  PetscCall(BasisGhostsDestroy(&vi->basis->ghosts));
  PetscCall(VecDestroy(&vi->b));
  PetscCall(PetscFree(vi->fixed_local));
  PetscCall(PetscFree(vi->fixed));
  PetscCall(PetscObjectReference((PetscObject)K));
  vi->K         = K;
  vi->assembled = PETSC_FALSE;
  PetscCall(MatGetDiagonal(vi->K, vi->diagonal));
  PetscCall(BasisChangeGetFixed(vi, &vi->basis->bases, &vi->basis->couplings, &vi->num_fixed, &vi->fixed, &values));
  PetscCall(VICondense_Private(vi, values));
  PetscCall(PetscFree(values));
  PetscCall(LogStageEnd(STAGE_CONDENSE));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode VIUpdate(VI vi, int changed, PetscBool *updated)
{
  PetscReal *values;
  PetscInt   num_fixed, *fixed;

  PetscFunctionBeginUser;
  *updated = (PetscBool) !(changed & (DATUM_MATERIAL | DATUM_MESH));
  if (!*updated) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(LogStageBegin(STAGE_MORTAR));
  if (changed & DATUM_DISPLACEMENT) {
    PetscBool elsewhere;

    PetscCall(SupportUpdate(vi->level, vi->scene, &vi->support));
    PetscCall(SlidingNodesElsewhere(vi->level, &vi->support, vi->num_pairs, vi->pairs, &elsewhere));
    *updated = (PetscBool)!elsewhere;
  }
  if (*updated && changed & DATUM_GAP)
    PetscCall(PairsUpdateGaps(vi->scene, vi->level, &vi->support, vi->pairs, updated));
  PetscCall(LogStageEnd(STAGE_MORTAR));
  if (!*updated) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(LogStageBegin(STAGE_ASSEMBLY));
  if (changed & (DATUM_LOAD | DATUM_TEMPERATURE)) PetscCall(LoadsAssemble(vi->scene, vi->level, vi->f));
  PetscCall(LogStageEnd(STAGE_ASSEMBLY));
  PetscCall(LogStageBegin(STAGE_CONDENSE));
  PetscCall(KKTSystemSetGaps(vi));
  PetscCall(VIChooseLength_Private(vi));
  PetscCall(VISetBounds_Private(vi));
  PetscCall(FrictionLawUpdate(vi));
  PetscCall(BasisChangeGetFixed(vi, &vi->basis->bases, &vi->basis->couplings, &num_fixed, &fixed, &values));
  PetscCall(VISetLoad_Private(vi, values));
  PetscCall(PetscFree(fixed));
  PetscCall(PetscFree(values));
  PetscCall(LogStageEnd(STAGE_CONDENSE));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode VISetSlipOrigin(VI vi, Vec u)
{
  const PetscScalar *moved;
  Vec                relative;

  PetscFunctionBeginUser;
  if (!vi->friction || !vi->B) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatCreateVecs(vi->B, NULL, &relative));
  PetscCall(MatMult(vi->B, u, relative));
  PetscCall(PetscObjectReference((PetscObject)u));
  PetscCall(VecDestroy(&vi->slip_from));
  vi->slip_from = u;
  if (!vi->slip_origin) PetscCall(PetscCalloc1(vi->num_rows, &vi->slip_origin));
  PetscCall(VecGetArrayRead(relative, &moved));
  for (PetscInt r = 0; r < vi->num_rows; r++)
    vi->slip_origin[r] = vi->row_direction[r] ? PetscRealPart(moved[r]) / vi->row_D[r] : 0;
  PetscCall(VecRestoreArrayRead(relative, &moved));
  PetscCall(VecDestroy(&relative));
  PetscCall(FrictionLawUpdate(vi));
  PetscCall(KKTSystemSetGaps(vi));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode VICreateCoarse(VI vi, PetscInt l, Mat K, VI *coarse)
{
  PetscFunctionBeginUser;
  WarningMute(); // warnings of a coarser level do not concern the solution
  PetscCall(VICreateOnLevel_Private(vi->scene, vi->mesh, &vi->mesh->levels[l], vi, K, coarse));
  WarningUnmute();
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode VIDestroy(VI *vi_in)
{
  VI vi = *vi_in;

  PetscFunctionBeginUser;
  if (!vi) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt p = 0; p < vi->num_pairs; p++) PetscCall(PairDestroy(&vi->pairs[p]));
  PetscCall(PetscFree(vi->pairs));
  if (vi->basis) {
    PetscCall(CouplingsDestroy(&vi->basis->couplings));
    PetscCall(NodeBasesDestroy(&vi->basis->bases));
    PetscCall(BasisChangeDestroy(&vi->basis->change));
    PetscCall(BasisGhostsDestroy(&vi->basis->ghosts));
  }
  PetscCall(PetscFree(vi->basis));
  PetscCall(PetscFree(vi->fixed));
  PetscCall(PetscFree(vi->fixed_local));
  PetscCall(SupportDestroy(&vi->support));
  PetscCall(RigidModesDestroy(&vi->rigid_modes));
  PetscCall(FrictionLawDestroy(&vi->friction));
  PetscCall(PetscFree(vi->slip_origin));
  PetscCall(VecDestroy(&vi->slip_from));
  PetscCall(PetscFree5(vi->row_pair, vi->row_node, vi->row_direction, vi->row_dof, vi->row_D));
  PetscCall(MatDestroy(&vi->B));
  PetscCall(MatDestroy(&vi->K));
  PetscCall(MatDestroy(&vi->A));
  PetscCall(MatDestroy(&vi->Z));
  PetscCall(MatDestroy(&vi->S));
  PetscCall(VecDestroy(&vi->diagonal));
  PetscCall(VecDestroy(&vi->f));
  PetscCall(VecDestroy(&vi->G));
  PetscCall(VecDestroy(&vi->b));
  PetscCall(VecDestroy(&vi->upper));
  PetscCall(VecDestroy(&vi->lower));
  PetscCall(PetscFree(*vi_in));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode VIRecoverDisplacement(VI vi, Vec y, Vec u)
{
  PetscFunctionBeginUser;
  if (vi->T)
    PetscCall(MatMult(vi->T, y, u));
  else
    PetscCall(VecCopy(y, u));
  PetscCall(VecScale(u, vi->length));
  PetscCall(LevelConform(vi->level, vi->level->dim, u)); // exactly, though solvers stop
  PetscCall(LevelShareVec(u, INSERT_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode VIRecoverMultiplier(VI vi, Vec u, Vec lambda)
{
  const PetscInt     first = vi->level->dim * vi->level->node_begin;
  const PetscScalar *ra;
  PetscScalar       *la;
  Vec                residual, r;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(vi->upper, &residual));
  PetscCall(VecDuplicate(vi->upper, &r));
  PetscCall(MatMult(vi->K, u, residual));
  PetscCall(VecAYPX(residual, -1.0, vi->f));
  if (vi->T)
    PetscCall(MatMultTranspose(vi->T, residual, r));
  else
    PetscCall(VecCopy(residual, r));
  PetscCall(VecGetArrayRead(r, &ra));
  PetscCall(VecGetArray(lambda, &la));
  for (PetscInt i = 0; i < vi->num_rows; i++) la[i] = ra[vi->row_dof[i] - first] / vi->row_D[i];
  PetscCall(VecRestoreArray(lambda, &la));
  PetscCall(VecRestoreArrayRead(r, &ra));
  PetscCall(VecDestroy(&r));
  PetscCall(VecDestroy(&residual));
  PetscFunctionReturn(PETSC_SUCCESS);
}

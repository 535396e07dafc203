/* gaperrors.c -- errors of gaps in contact: how far bodies follow them, and what forces change by that.

   A contact that slides as a whole along curved sides has an error of the gap that is linear over the patch.
   Its inclination shifts the contact along the sides; no pressure changes. Its least value moves the bodies
   apart or together. A floating body follows that without a force, a slender one by bending. One linear
   problem with the final active set tells the forces of that. */
#include "base/compat.h"
#include "checks/gaperrors.h"
#include "kernel/dense.h"
#include "kernel/vector.h"
#include "solve/dualsolve.h"

/* The square of the extent, over the largest, of directions in which a patch is flat. */
static const PetscReal FLAT = 1e-3;

enum { TERMS = 4, SUMS = TERMS * (TERMS + 1) }; /* 1 and coordinates; sums of their products, and with a value */
enum { POWERS = 3, POWER_SUMS = POWERS * (POWERS + 1) }; /* 1, s, s^2/2; the same of these */

PetscErrorCode GapErrorsCreate(Fields fields, GapErrors *errors)
{
  PetscFunctionBeginUser;
  errors->rest = (Largest){.value = -1};
  PetscCall(PetscCalloc2(fields->vi->num_rows, &errors->error, fields->vi->num_pairs, &errors->scale));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GapErrorsDestroy(GapErrors *errors)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree2(errors->error, errors->scale));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* 1 and the coordinates from the middle of the patch, over its extent.
   [in] a - node of the pair; [out] term - [TERMS] */
static void GapErrorsGetTerms_Private(const Pair pair, PetscInt a, const ContactPatch *patch, PetscReal term[])
{
  const PetscInt   dim = pair->level->dim;
  const PetscReal *x   = &pair->level->coords[pair->nodes[a] * dim];

  term[0] = 1;
  for (PetscInt k = 0; k < TERMS - 1; k++) term[1 + k] = k < dim ? (x[k] - patch->centre[k]) / patch->extent[0] : 0;
}

/* Adds products of terms, and of these with a value. [in,out] sums - [num][num], then [num] */
static void GapErrorsAddProducts_Private(PetscInt num, const PetscReal term[], PetscReal value, PetscReal weight,
                                         PetscReal sums[])
{
  for (PetscInt j = 0; j < num; j++) {
    for (PetscInt k = 0; k < num; k++) sums[j * num + k] += weight * term[j] * term[k];
    sums[num * num + j] += weight * term[j] * value;
  }
}

/* Coefficients of the linear function that is nearest to the errors of a patch. [in] sums - of products
   [SUMS]; [out] coefficient - [TERMS] */
static void GapErrorsFitTerms_Private(const PetscReal sums[], PetscReal coefficient[])
{
  PetscReal A[TERMS * TERMS], V[TERMS * TERMS], values[TERMS], most = 0;

  for (PetscInt i = 0; i < TERMS * TERMS; i++) A[i] = sums[i];
  DenseEigen(TERMS, A, values, V);
  for (PetscInt i = 0; i < TERMS; i++) most = PetscMax(most, values[i]);
  for (PetscInt i = 0; i < TERMS; i++) coefficient[i] = 0;
  for (PetscInt j = 0; j < TERMS; j++) {
    PetscReal along = 0;

    if (values[j] <= FLAT * most) continue;
    for (PetscInt i = 0; i < TERMS; i++) along += V[i * TERMS + j] * sums[TERMS * TERMS + i];
    for (PetscInt i = 0; i < TERMS; i++) coefficient[i] += along / values[j] * V[i * TERMS + j];
  }
}

/* The linear function of each patch that is nearest to the errors of its nodes, by force. Collective.
   [out] coefficients - [patches->num][TERMS] */
static PetscErrorCode GapErrorsFit_Private(Fields fields, PetscInt p, const ContactPatches *patches,
                                           const PetscReal error[], PetscReal coefficients[])
{
  const VI         vi = fields->vi;
  const PetscReal *lambda;
  PetscReal       *sums, term[TERMS];

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(patches->num * SUMS, &sums));
  PetscCall(VecGetArrayRead(fields->lambda, &lambda));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const PetscInt i = patches->row_patch[r], a = vi->row_node[r];

    if (i < 0 || PetscIsNanReal(error[a])) continue;
    GapErrorsGetTerms_Private(vi->pairs[p], a, &patches->patch[i], term);
    GapErrorsAddProducts_Private(TERMS, term, error[a], lambda[r] * fields->row_weight[r], &sums[i * SUMS]);
  }
  PetscCall(VecRestoreArrayRead(fields->lambda, &lambda));
  PetscCallMPI(
      MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)(patches->num * SUMS), MPIU_REAL, MPIU_SUM, vi->level->comm));
  for (PetscInt i = 0; i < patches->num; i++) GapErrorsFitTerms_Private(&sums[i * SUMS], &coefficients[i * TERMS]);
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* By how much the least gap of a patch of curvature kappa falls if it inclines by m: m^2 / (2 kappa). The
   curvature is that of the gaps before any motion. Patches that would shift by more than their extent are
   flat, and have 0. Collective. [in] coefficients - of GapErrorsFit_Private(); [out] fall - [patches->num] */
static PetscErrorCode GapErrorsGetFalls_Private(Fields fields, PetscInt p, const ContactPatches *patches,
                                                const PetscReal coefficients[], PetscReal fall[])
{
  const VI   vi   = fields->vi;
  const Pair pair = vi->pairs[p];
  PetscReal *sums, term[TERMS];

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(patches->num * POWER_SUMS, &sums));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const PetscInt   i = patches->row_patch[r], a = vi->row_node[r];
    const PetscReal *gradient = i < 0 ? NULL : &coefficients[i * TERMS + 1];
    PetscReal        s;

    if (i < 0 || VectorNorm(TERMS - 1, gradient) == 0) continue;
    GapErrorsGetTerms_Private(pair, a, &patches->patch[i], term);
    s = VectorDot(TERMS - 1, gradient, &term[1]) / VectorNorm(TERMS - 1, gradient);
    GapErrorsAddProducts_Private(POWERS, (PetscReal[POWERS]){1, s, s * s / 2}, pair->gap[a], 1, &sums[i * POWER_SUMS]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)(patches->num * POWER_SUMS), MPIU_REAL, MPIU_SUM,
                             vi->level->comm));
  for (PetscInt i = 0; i < patches->num; i++) {
    const PetscReal m   = VectorNorm(TERMS - 1, &coefficients[i * TERMS + 1]);
    PetscReal      *sum = &sums[i * POWER_SUMS], *b = &sum[POWERS * POWERS];

    fall[i] = 0;
    if (m == 0 || !DenseCholesky(POWERS, sum)) continue;
    DenseCholeskySolve(POWERS, sum, b);
    if (b[2] > m) fall[i] = m * m / (2 * b[2]);
  }
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a node is at the edge of a patch: it closes or opens as the contact shifts. [in] a - of the pair */
static PetscBool GapErrorsIsBeside_Private(const Pair pair, PetscInt a, const ContactPatches *patches)
{
  const PetscInt dim = pair->level->dim;

  for (PetscInt i = 0; i < patches->num; i++) {
    const ContactPatch *patch = &patches->patch[i];
    PetscReal           way[3];

    for (PetscInt k = 0; k < dim; k++) way[k] = pair->level->coords[pair->nodes[a] * dim + k] - patch->centre[k];
    if (VectorNorm(dim, way) < patch->extent[0] + patch->facet_size) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* Takes the mean square of rests, by force, over the scale. Collective. [in] squares - of each patch, of this
   rank: sums of force, and of force times the square of the rest [num][2]; [in,out] rest - of this rank */
static PetscErrorCode GapErrorsTakeRests_Private(const Pair pair, PetscInt p, const ContactPatches *patches,
                                                 PetscReal scale, PetscReal squares[], Largest *rest)
{
  PetscFunctionBeginUser;
  PetscCallMPI(
      MPI_Allreduce(MPI_IN_PLACE, squares, (PetscMPIInt)(2 * patches->num), MPIU_REAL, MPIU_SUM, pair->level->comm));
  for (PetscInt i = 0; i < patches->num; i++)
    if (squares[2 * i] > 0)
      LargestTake(rest, PetscSqrtReal(squares[2 * i + 1] / squares[2 * i]) / scale, pair->level->dim,
                  patches->patch[i].centre, p);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GapErrorsAdd(Fields fields, PetscInt p, const ContactPatches *patches, const PetscReal error[],
                            PetscReal scale, GapErrors *errors)
{
  const VI         vi   = fields->vi;
  const Pair       pair = vi->pairs[p];
  const PetscReal *lambda;
  PetscReal       *coefficients, *fall, *squares, term[TERMS];

  PetscFunctionBeginUser;
  if (!(scale > 0)) PetscFunctionReturn(PETSC_SUCCESS);
  errors->scale[p] = scale;
  for (PetscInt a = 0; a < pair->num && pair->spec->type == PAIR_TIED; a++)
    LargestTake(&errors->rest, PetscAbsReal(error[a]) / scale, vi->level->dim,
                &vi->level->coords[pair->nodes[a] * vi->level->dim], p);
  PetscCall(PetscMalloc2(patches->num * TERMS, &coefficients, patches->num, &fall));
  PetscCall(PetscCalloc1(2 * patches->num, &squares));
  PetscCall(GapErrorsFit_Private(fields, p, patches, error, coefficients));
  PetscCall(GapErrorsGetFalls_Private(fields, p, patches, coefficients, fall));
  PetscCall(VecGetArrayRead(fields->lambda, &lambda));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const PetscInt i = patches->row_patch[r], a = vi->row_node[r];

    if (vi->row_pair[r] != p || vi->row_direction[r] || PetscIsNanReal(error[a])) continue;
    if (i >= 0) {
      const PetscReal force = lambda[r] * fields->row_weight[r];
      PetscReal       linear;

      GapErrorsGetTerms_Private(pair, a, &patches->patch[i], term);
      linear           = VectorDot(TERMS, &coefficients[i * TERMS], term);
      errors->error[r] = linear - fall[i];
      squares[2 * i] += force;
      squares[2 * i + 1] += force * PetscSqr(error[a] - linear);
    } else if (fields->row_status[r] == STATUS_OPEN && !GapErrorsIsBeside_Private(pair, a, patches)) {
      errors->error[r] = error[a];
    }
  }
  PetscCall(VecRestoreArrayRead(fields->lambda, &lambda));
  PetscCall(GapErrorsTakeRests_Private(pair, p, patches, scale, squares, &errors->rest));
  PetscCall(PetscFree(squares));
  PetscCall(PetscFree2(coefficients, fall));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* y of the bodies that follow the errors of rows in contact. Collective.
   [out] y - layout of vi->b; [out] solved - false where that failed */
static PetscErrorCode GapErrorsSolve_Private(Fields fields, const GapErrors *errors, Vec y, PetscBool *solved)
{
  const VI     vi = fields->vi;
  PetscScalar *a;
  PetscInt     first;
  Vec          given, b;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(y, &given));
  PetscCall(VecDuplicate(y, &b));
  PetscCall(VecZeroEntries(given));
  PetscCall(VecGetOwnershipRange(given, &first, NULL));
  PetscCall(VecGetArray(given, &a));
  for (PetscInt r = 0; r < vi->num_rows; r++)
    if (fields->row_status[r] == STATUS_CONTACT) a[vi->row_dof[r] - first] = errors->error[r] / vi->length;
  PetscCall(VecRestoreArray(given, &a));
  PetscCall(MatMult(vi->A, given, b));
  PetscCall(VecScale(b, -1));
  PetscCall(VecGetArray(b, &a));
  for (PetscInt i = 0; i < vi->num_fixed; i++) a[vi->fixed_local[i]] = 0;
  PetscCall(VecRestoreArray(b, &a));
  PetscCall(DualSolve(fields->solver, fields->report, fields->y, 1, &b, &y, solved));
  PetscCall(VecAXPY(y, 1, given));
  PetscCall(VecDestroy(&b));
  PetscCall(VecDestroy(&given));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Changes of the nodal forces of contact. Collective. [in] y - of GapErrorsSolve_Private(); [out] change -
   [vi->num_rows] */
static PetscErrorCode GapErrorsGetForces_Private(Fields fields, Vec y, PetscReal change[])
{
  const VI         vi = fields->vi;
  const PetscReal *product;
  PetscInt         first;
  Vec              Ay;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(y, &Ay));
  PetscCall(MatMult(vi->A, y, Ay));
  PetscCall(VecGetOwnershipRange(y, &first, NULL));
  PetscCall(VecGetArrayRead(Ay, &product));
  for (PetscInt r = 0; r < vi->num_rows; r++)
    change[r] = vi->stiffness * vi->length * product[vi->row_dof[r] - first] / vi->row_D[r] * fields->row_weight[r];
  PetscCall(VecRestoreArrayRead(Ay, &product));
  PetscCall(VecDestroy(&Ay));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Twice the largest distance of the nodes of a pair from their mean. Collective. */
static PetscErrorCode GapErrorsGetExtent_Private(const Pair pair, PetscReal *extent)
{
  const PetscInt dim    = pair->level->dim;
  PetscReal      sum[4] = {0, 0, 0, 0}; // number, positions

  PetscFunctionBeginUser;
  *extent = 0;
  for (PetscInt a = 0; a < pair->num; a++) {
    sum[0] += 1;
    for (PetscInt k = 0; k < dim; k++) sum[1 + k] += pair->level->coords[pair->nodes[a] * dim + k];
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 4, MPIU_REAL, MPIU_SUM, pair->level->comm));
  for (PetscInt a = 0; a < pair->num; a++) {
    PetscReal way[3];

    for (PetscInt k = 0; k < dim; k++) way[k] = pair->level->coords[pair->nodes[a] * dim + k] - sum[1 + k] / sum[0];
    *extent = PetscMax(*extent, 2 * VectorNorm(dim, way));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, extent, 1, MPIU_REAL, MPIU_MAX, pair->level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Takes changes of the forces of a pair's patches over these, and of their moments over forces times the
   extent of the side. Collective.
   [in] change - of GapErrorsGetForces_Private(); [in,out] left - of this rank */
static PetscErrorCode GapErrorsTakePatches_Private(Fields fields, PetscInt p, const PetscReal change[], Largest *left)
{
  const VI       vi   = fields->vi;
  const Pair     pair = vi->pairs[p];
  const PetscInt dim  = vi->level->dim;
  PetscReal     *sums, extent; // force and first moments of each patch
  ContactPatches patches;

  PetscFunctionBeginUser;
  PetscCall(ContactPatchesCreate(fields, p, &patches));
  PetscCall(GapErrorsGetExtent_Private(pair, &extent));
  PetscCall(PetscCalloc1(patches.num * TERMS, &sums));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const PetscInt i = patches.row_patch[r];
    PetscReal      term[TERMS];

    if (i < 0) continue;
    GapErrorsGetTerms_Private(pair, vi->row_node[r], &patches.patch[i], term);
    for (PetscInt k = 0; k < TERMS; k++) sums[i * TERMS + k] += change[r] * term[k];
  }
  PetscCallMPI(
      MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)(TERMS * patches.num), MPIU_REAL, MPIU_SUM, vi->level->comm));
  for (PetscInt i = 0; i < patches.num; i++) {
    const ContactPatch *patch = &patches.patch[i];
    const PetscReal     moved = VectorNorm(TERMS - 1, &sums[i * TERMS + 1]) * patch->extent[0] / extent;

    LargestTake(left, (PetscAbsReal(sums[i * TERMS]) + moved) / patch->normal_force, dim, patch->centre, p);
  }
  PetscCall(PetscFree(sums));
  PetscCall(ContactPatchesDestroy(&patches));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Takes overlaps of open nodes over their scale. Not collective. [in] y - of GapErrorsSolve_Private();
   [in,out] left - of this rank */
static PetscErrorCode GapErrorsTakeOpen_Private(Fields fields, const GapErrors *errors, Vec y, Largest *left)
{
  const VI         vi  = fields->vi;
  const PetscInt   dim = vi->level->dim;
  const PetscReal *slack, *values;
  PetscInt         first;

  PetscFunctionBeginUser;
  PetscCall(VecGetOwnershipRange(y, &first, NULL));
  PetscCall(VecGetArrayRead(y, &values));
  PetscCall(VecGetArrayRead(fields->slack, &slack));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const PetscInt p = vi->row_pair[r], node = vi->pairs[p]->nodes[vi->row_node[r]];
    PetscReal      gap;

    if (fields->row_status[r] != STATUS_OPEN || !(errors->error[r] < 0) || !(errors->scale[p] > 0)) continue;
    gap = slack[r] + errors->error[r] - vi->length * values[vi->row_dof[r] - first];
    LargestTake(left, -gap / errors->scale[p], dim, &vi->level->coords[node * dim], p);
  }
  PetscCall(VecRestoreArrayRead(fields->slack, &slack));
  PetscCall(VecRestoreArrayRead(y, &values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GapErrorsFollow(Fields fields, const GapErrors *errors, Largest *left)
{
  const VI   vi     = fields->vi;
  PetscBool  solved = PETSC_FALSE;
  PetscReal *change;
  Vec        y;

  PetscFunctionBeginUser;
  *left = errors->rest;
  if (fields->solver && !vi->friction) {
    PetscCall(VecDuplicate(fields->y, &y));
    PetscCall(PetscMalloc1(vi->num_rows, &change));
    PetscCall(GapErrorsSolve_Private(fields, errors, y, &solved));
    PetscCall(GapErrorsGetForces_Private(fields, y, change));
    for (PetscInt p = 0; p < vi->num_pairs; p++)
      if (vi->pairs[p]->num_multipliers) PetscCall(GapErrorsTakePatches_Private(fields, p, change, left));
    PetscCall(GapErrorsTakeOpen_Private(fields, errors, y, left));
    PetscCall(PetscFree(change));
    PetscCall(VecDestroy(&y));
  }
  PetscCall(LargestReduce(vi->level->comm, vi->level->dim, 1, left));
  if (!solved) left->value = NAN;
  PetscFunctionReturn(PETSC_SUCCESS);
}

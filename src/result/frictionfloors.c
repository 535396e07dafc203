/* frictionfloors.c -- floors of error bars of numbers of friction.

   A pair that sticks on all meshes tells nothing of the slip that finer ones may have, as at its ends. It is
   the error of a displacement. Slip is often largest where contact ends. Then it is known as well as that
   place, whatever the error of the displacement. A node that a plane of symmetry holds along the side has no
   friction there. Where the sides slip away from the plane the traction jumps at it. Then the force lacks
   what the part of the node would have, which changes from mesh to mesh only when facets there do. */
#include "base/compat.h"
#include "contact/pairpoints.h"
#include "kernel/vector.h"
#include "result/frictionfields.h"
#include "result/frictionfloors.h"

enum { F = ELEMENT_MAX_FACET_NODES };

/* Contact ends on the facet behind the last active node, or on less than half of the one after it. */
static const PetscReal END_FACETS = 1.5;

/* Forces along the side, and whether a node slips, of all ranks. Collective. */
static PetscErrorCode FrictionFloorsSetSlip_Private(Fields fields, PetscInt p, PetscReal relative,
                                                    FrictionFloors *floors)
{
  const VI         vi      = fields->vi;
  PetscReal        sums[2] = {0, 0}; // nodes that slip; components of forces along the side
  const PetscReal *lambda;

  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(fields->lambda, &lambda));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    if (vi->row_pair[r] != p) continue;
    if (vi->row_direction[r])
      sums[1] += PetscAbsReal(lambda[r] * fields->row_weight[r]);
    else
      sums[0] += fields->row_status[r] == STATUS_SLIP;
  }
  PetscCall(VecRestoreArrayRead(fields->lambda, &lambda));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPIU_REAL, MPI_SUM, vi->level->comm));
  if (sums[0] == 0) floors->slip = relative * fields->body_max[vi->pairs[p]->spec->nonmortar.body];
  floors->work = floors->slip * sums[1];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The tangent that has no row, at nodes in contact where a support holds one. Collective.
   [out] tangents - 0 elsewhere, ghosted, dim per node, owned by the caller */
static PetscErrorCode FrictionFloorsCreateHeld_Private(Fields fields, PetscInt p, Vec *tangents)
{
  const VI       vi   = fields->vi;
  const Pair     pair = vi->pairs[p];
  const PetscInt dim  = vi->level->dim;
  PetscScalar   *t;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(vi->level, dim, tangents));
  PetscCall(VecGetArray(*tangents, &t));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const PetscInt a     = vi->row_node[r];
    PetscBool      has[] = {PETSC_TRUE, PETSC_FALSE, PETSC_FALSE};
    PetscInt       num   = 0;

    if (vi->row_pair[r] != p || vi->row_direction[r] || !StatusIsContact(fields->row_status[r])) continue;
    for (PetscInt next = r + 1; next < vi->num_rows && vi->row_pair[next] == p && vi->row_node[next] == a;
         next++, num++)
      has[vi->row_direction[next]] = PETSC_TRUE;
    for (PetscInt i = 1; i < dim && num == dim - 2; i++)
      for (PetscInt k = 0; k < dim && !has[i]; k++) t[pair->nodes[a] * dim + k] = pair->frame[(a * dim + i) * dim + k];
  }
  PetscCall(VecRestoreArray(*tangents, &t));
  PetscCall(LevelShareVec(*tangents, INSERT_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The largest traction along these tangents at other nodes of the facets around. Collective.
   [in] held - of FrictionFloorsCreateHeld_Private(); [in,out] beside - zero, ghosted, one per node */
static PetscErrorCode FrictionFloorsLookBeside_Private(Fields fields, PetscInt p, Vec held, Vec beside)
{
  const Facets      *facets = &fields->vi->pairs[p]->points->facets;
  const PetscInt     dim    = fields->vi->level->dim;
  const PetscScalar *d, *t;
  PetscScalar       *b;
  Vec                traction, local[3];

  PetscFunctionBeginUser;
  PetscCall(PairTractionCreate(fields, p, fields->row_status, &traction));
  PetscCall(VecGhostGetLocalForm(held, &local[0]));
  PetscCall(VecGhostGetLocalForm(traction, &local[1]));
  PetscCall(VecGhostGetLocalForm(beside, &local[2]));
  PetscCall(VecGetArrayRead(local[0], &d));
  PetscCall(VecGetArrayRead(local[1], &t));
  PetscCall(VecGetArray(local[2], &b));
  for (PetscInt f = 0; f < facets->num; f++) {
    const PetscInt *nodes = &facets->nodes[f * F], num = ElementNumNodes(facets->type[f]);

    for (PetscInt i = 0; i < num; i++)
      for (PetscInt j = 0; j < num; j++)
        b[nodes[i]] = PetscMax(b[nodes[i]], PetscAbsReal(VectorDot(dim, &d[nodes[i] * dim], &t[nodes[j] * dim])));
  }
  PetscCall(VecRestoreArray(local[2], &b));
  PetscCall(VecRestoreArrayRead(local[1], &t));
  PetscCall(VecRestoreArrayRead(local[0], &d));
  PetscCall(VecGhostRestoreLocalForm(beside, &local[2]));
  PetscCall(VecGhostRestoreLocalForm(traction, &local[1]));
  PetscCall(VecGhostRestoreLocalForm(held, &local[0]));
  PetscCall(VecDestroy(&traction));
  PetscCall(LevelShareVec(beside, MAX_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode FrictionFloorsSetHeld_Private(Fields fields, PetscInt p, FrictionFloors *floors)
{
  const VI           vi = fields->vi;
  const PetscScalar *b;
  Vec                held, beside;

  PetscFunctionBeginUser;
  PetscCall(FrictionFloorsCreateHeld_Private(fields, p, &held));
  PetscCall(LevelCreateVec(vi->level, 1, &beside));
  PetscCall(FrictionFloorsLookBeside_Private(fields, p, held, beside));
  PetscCall(VecGetArrayRead(beside, &b));
  for (PetscInt r = 0; r < vi->num_rows; r++)
    if (vi->row_pair[r] == p && !vi->row_direction[r])
      floors->held += PetscAbsReal(b[vi->pairs[p]->nodes[vi->row_node[r]]] * fields->row_weight[r]);
  PetscCall(VecRestoreArrayRead(beside, &b));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &floors->held, 1, MPIU_REAL, MPI_SUM, vi->level->comm));
  PetscCall(VecDestroy(&beside));
  PetscCall(VecDestroy(&held));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* At owned nodes of a side: slip, whether it is in contact, and the work of friction on it. Collective.
   [out] slips - ghosted, dim + 2 per node, owned by the caller;
   [out] largest - slip in contact, of all ranks */
static PetscErrorCode FrictionFloorsCreateSlips_Private(Fields fields, PetscInt p, Vec *slips, PetscReal *largest)
{
  const VI       vi  = fields->vi;
  const PetscInt dim = vi->level->dim, n = vi->level->num_owned;
  const Pair     pair = vi->pairs[p];
  PetscReal     *traction, *slip;
  PetscScalar   *a;

  PetscFunctionBeginUser;
  *largest = 0;
  PetscCall(LevelCreateVec(vi->level, dim + 2, slips));
  PetscCall(PetscMalloc2(n * dim, &traction, n * dim, &slip));
  PetscCall(FrictionFieldsGet(fields, p, traction, slip));
  PetscCall(VecGetArray(*slips, &a));
  for (PetscInt i = 0; i < n; i++)
    for (PetscInt k = 0; k < dim; k++) a[i * (dim + 2) + k] = slip[i * dim + k];
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const PetscInt i = pair->nodes[vi->row_node[r]];

    if (vi->row_pair[r] != p || vi->row_direction[r] || !StatusIsContact(fields->row_status[r])) continue;
    a[i * (dim + 2) + dim] = 1;
    a[i * (dim + 2) + dim + 1] =
        fields->row_weight[r] * PetscAbsReal(VectorDot(dim, &traction[i * dim], &slip[i * dim]));
    *largest = PetscMax(*largest, VectorNorm(dim, &slip[i * dim]));
  }
  PetscCall(VecRestoreArray(*slips, &a));
  PetscCall(PetscFree2(traction, slip));
  PetscCall(LevelShareVec(*slips, INSERT_VALUES));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, largest, 1, MPIU_REAL, MPI_MAX, vi->level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Where contact ends on a facet: how much slip differs on it from the largest one of all, if it has
   that; and half of its work. [in] a - of FrictionFloorsCreateSlips_Private(); num - nodes of the facet */
static void FrictionFloorsAddEnd_Private(PetscInt dim, const PetscScalar a[], PetscInt num, const PetscInt nodes[],
                                         PetscReal largest, PetscReal *slip, PetscReal *work)
{
  const PetscScalar *peak = NULL;
  PetscBool          open = PETSC_FALSE;
  PetscReal          sum  = 0;

  for (PetscInt i = 0; i < num; i++) {
    const PetscScalar *at = &a[nodes[i] * (dim + 2)];

    open = (PetscBool)(open || at[dim] == 0);
    sum += at[dim + 1] / 2;
    if (at[dim] != 0 && VectorNorm(dim, at) >= largest) peak = at;
  }
  if (open) *work += sum;
  for (PetscInt i = 0; i < num && peak && open; i++) {
    const PetscScalar *at = &a[nodes[i] * (dim + 2)];

    if (!PetscIsNanReal(at[0])) *slip = PetscMax(*slip, END_FACETS * VectorDistance(dim, at, peak));
  }
}

/* Where slip is largest at an end of contact. Collective. */
static PetscErrorCode FrictionFloorsSetEnd_Private(Fields fields, PetscInt p, FrictionFloors *floors)
{
  const Facets      *facets = &fields->vi->pairs[p]->points->facets;
  const PetscScalar *a;
  PetscReal          largest, slip = 0, work = 0;
  Vec                slips, local;

  PetscFunctionBeginUser;
  PetscCall(FrictionFloorsCreateSlips_Private(fields, p, &slips, &largest));
  PetscCall(VecGhostGetLocalForm(slips, &local));
  PetscCall(VecGetArrayRead(local, &a));
  for (PetscInt f = 0; f < facets->num; f++)
    FrictionFloorsAddEnd_Private(fields->vi->level->dim, a, ElementNumNodes(facets->type[f]), &facets->nodes[f * F],
                                 largest, &slip, &work);
  PetscCall(VecRestoreArrayRead(local, &a));
  PetscCall(VecGhostRestoreLocalForm(slips, &local));
  PetscCall(VecDestroy(&slips));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &slip, 1, MPIU_REAL, MPI_MAX, fields->vi->level->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &work, 1, MPIU_REAL, MPI_SUM, fields->vi->level->comm));
  floors->slip = PetscMax(floors->slip, slip);
  if (slip > 0) floors->work = work;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionFloorsCompute(Fields fields, PetscInt p, PetscReal relative, FrictionFloors *floors)
{
  PetscFunctionBeginUser;
  *floors = (FrictionFloors){0};
  if (!ScenePairHasFriction(fields->vi->pairs[p]->spec)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(FrictionFloorsSetSlip_Private(fields, p, relative, floors));
  if (floors->slip == 0) PetscCall(FrictionFloorsSetEnd_Private(fields, p, floors));
  PetscCall(FrictionFloorsSetHeld_Private(fields, p, floors));
  PetscFunctionReturn(PETSC_SUCCESS);
}

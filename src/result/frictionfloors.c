/* frictionfloors.c -- floors of error bars of numbers of friction.

   A pair that sticks on all meshes tells nothing of the slip that finer ones may have, as at its ends. It is
   the error of a displacement. A node that a plane of symmetry holds along the side has no friction there.
   Where the sides slip away from the plane the traction jumps at it. Then the force lacks what the part of
   the node would have, which changes from mesh to mesh only when facets there do. */
#include "base/compat.h"
#include "contact/pairpoints.h"
#include "kernel/vector.h"
#include "result/frictionfloors.h"

enum { F = ELEMENT_MAX_FACET_NODES };

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
  PetscCall(PairTractionCreate(fields, p, &traction));
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

PetscErrorCode FrictionFloorsCompute(Fields fields, PetscInt p, PetscReal relative, FrictionFloors *floors)
{
  PetscFunctionBeginUser;
  *floors = (FrictionFloors){0};
  if (!ScenePairHasFriction(fields->vi->pairs[p]->spec)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(FrictionFloorsSetSlip_Private(fields, p, relative, floors));
  PetscCall(FrictionFloorsSetHeld_Private(fields, p, floors));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* fates.c -- which nodes of the nonmortar sides carry a multiplier.

   A node is uncovered, or removed (its row is spread over its neighbours), or kept. Removed are slivers of coverage, whose
   pressure could not be recovered accurately, nodes whose normal direction is held, and nodes that another pair serves. */
#include <mortise/compat.h>
#include <mortise/fault.h>
#include <mortise/frame.h>
#include "draft.h"

/* A normal whose free part is shorter than this is held: no multiplier. */
static const PetscReal HELD_NORMAL = 0.1;
/* Covered share of a node's support below which its pressure could not be recovered accurately, on linear and on quadratic
   facets, whose share e covers e^2 / 2 of a far end or 3 e^2 of a middle node. The far end of a quadratic facet is
   covered negatively where less than three quarters of the facet are. */
static const PetscReal SLIVER_LINEAR = 1e-3, SLIVER_QUADRATIC = 5e-2;
/* Covered share that is nothing but roundoff. */
static const PetscReal NOTHING = 1e-13;
/* Two constraints at one node need normals that differ by at least 20 degrees. */
static const PetscReal SAME_DIRECTION = 0.93969262078590838;

/* n := Pi n / |Pi n| with Pi the projection onto the free directions of a node. Returns whether n is free at all. */
static PetscBool ProjectNormal_Private(const Support *held, PetscInt node, PetscReal n[])
{
  const PetscInt dim = held->dim;

  for (PetscInt j = 0; j < held->count[node]; j++) {
    const PetscReal *d   = &held->directions[(node * dim + j) * dim];
    PetscReal        dot = 0;
    for (PetscInt k = 0; k < dim; k++) dot += d[k] * n[k];
    for (PetscInt k = 0; k < dim; k++) n[k] -= dot * d[k];
  }
  if (held->count[node] == 0) return PETSC_TRUE;
  return (PetscBool)(held->count[node] < dim && FrameNormalize(dim, n) >= HELD_NORMAL);
}

PetscErrorCode NormalsProject(const Level *level, const Support *held, Vec normals)
{
  PetscReal    n[3];
  PetscScalar *N;
  Vec          local;

  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(normals, &local));
  PetscCall(VecGetArray(local, &N));
  for (PetscInt i = 0; i < level->num_nodes; i++) {
    PetscCall(PetscArraycpy(n, &N[i * level->dim], level->dim));
    if (ProjectNormal_Private(held, i, n)) PetscCall(PetscArraycpy(&N[i * level->dim], n, level->dim));
  }
  PetscCall(VecRestoreArray(local, &N));
  PetscCall(VecGhostRestoreLocalForm(normals, &local));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The share that a node of the draft's nonmortar side needs. */
static PetscReal LeastShare_Private(const Level *level, const ScenePair *spec)
{
  const PetscBool quadratic =
      (PetscBool)(level->scene->bodies[spec->nonmortar.body].order == 2 && spec->multipliers == MULTIPLIERS_NODES);

  return quadratic ? SLIVER_QUADRATIC : SLIVER_LINEAR;
}

PetscErrorCode FatesDecide(const Level *level, const Support *held, PairDraft *draft)
{
  const PetscInt     dim   = level->dim;
  const PetscReal    least = LeastShare_Private(level, draft->spec);
  const PetscScalar *D, *full;
  PetscScalar       *N;
  Vec                local_D, local_full, local_N;

  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(draft->sums.D, &local_D));
  PetscCall(VecGhostGetLocalForm(draft->sums.full, &local_full));
  PetscCall(VecGhostGetLocalForm(draft->normals, &local_N));
  PetscCall(VecGetArrayRead(local_D, &D));
  PetscCall(VecGetArrayRead(local_full, &full));
  PetscCall(VecGetArray(local_N, &N));
  for (PetscInt i = 0; i < level->num_nodes; i++) {
    const PetscReal share = full[i] > 0 ? D[i] / full[i] : 0;
    PetscBool       keep  = PETSC_FALSE;
    if (PetscAbsReal(share) > NOTHING)
      keep = (PetscBool)(ProjectNormal_Private(held, i, &N[i * dim]) && share >= least);
    if (draft->spec->type == PAIR_TIED && held->count[i] > 0) keep = PETSC_FALSE; // a tie needs all directions
    draft->fate[i] = PetscAbsReal(share) <= NOTHING ? NODE_UNCOVERED : (keep ? NODE_KEPT : NODE_REMOVED);
  }
  PetscCall(VecRestoreArray(local_N, &N));
  PetscCall(VecRestoreArrayRead(local_full, &full));
  PetscCall(VecRestoreArrayRead(local_D, &D));
  PetscCall(VecGhostRestoreLocalForm(draft->normals, &local_N));
  PetscCall(VecGhostRestoreLocalForm(draft->sums.full, &local_full));
  PetscCall(VecGhostRestoreLocalForm(draft->sums.D, &local_D));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Removes from a later pair the nodes that an earlier one serves. */
static PetscErrorCode LoseNodes_Private(const Level *level, const PairDraft *earlier, PairDraft *later)
{
  const PetscInt     dim  = level->dim;
  const PetscBool    tied = (PetscBool)(earlier->spec->type == PAIR_TIED || later->spec->type == PAIR_TIED);
  Vec                local[2];
  const PetscScalar *n, *m;

  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(earlier->normals, &local[0]));
  PetscCall(VecGhostGetLocalForm(later->normals, &local[1]));
  PetscCall(VecGetArrayRead(local[0], &n));
  PetscCall(VecGetArrayRead(local[1], &m));
  for (PetscInt i = 0; i < level->num_nodes; i++) {
    PetscReal dot = 0;
    if (earlier->fate[i] != NODE_KEPT || later->fate[i] != NODE_KEPT) continue;
    for (PetscInt k = 0; k < dim; k++) dot += n[i * dim + k] * m[i * dim + k];
    if (tied || PetscAbsReal(dot) > SAME_DIRECTION) later->fate[i] = NODE_REMOVED;
  }
  PetscCall(VecRestoreArrayRead(local[0], &n));
  PetscCall(VecRestoreArrayRead(local[1], &m));
  PetscCall(VecGhostRestoreLocalForm(earlier->normals, &local[0]));
  PetscCall(VecGhostRestoreLocalForm(later->normals, &local[1]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a pair keeps a node on any rank. Collective. */
static PetscErrorCode KeepsAny_Private(const Level *level, const PairDraft *draft, PetscBool *any)
{
  PetscFunctionBeginUser;
  *any = PETSC_FALSE;
  for (PetscInt i = 0; i < level->num_nodes; i++) *any = (PetscBool)(*any || draft->fate[i] == NODE_KEPT);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, any, 1, MPIU_BOOL, MPI_LOR, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FatesSettle(const Level *level, PetscInt num, PairDraft drafts[])
{
  PetscBool before, after;

  PetscFunctionBeginUser;
  for (PetscInt p = 1; p < num; p++) {
    PetscCall(KeepsAny_Private(level, &drafts[p], &before));
    for (PetscInt q = 0; q < p; q++) PetscCall(LoseNodes_Private(level, &drafts[q], &drafts[p]));
    PetscCall(KeepsAny_Private(level, &drafts[p], &after));
    if (before && !after) {
      PetscCall(FaultRaise(
          level->comm,
          "-pairs: every node that pair '%s' could use already serves an earlier pair, so that it would have no "
          "say; refine its nonmortar side '%s', or swap its sides",
          drafts[p].spec->name, drafts[p].spec->nonmortar.side));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

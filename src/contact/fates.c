/* fates.c -- which nodes of the nonmortar sides carry a multiplier.

   A node is uncovered, or removed (its row is spread over its neighbours), or kept. Removed are slivers of coverage, whose
   pressure could not be recovered accurately, nodes whose normal direction is held, and nodes that another pair serves. */
#include <mortise/compat.h>
#include <mortise/frame.h>
#include "draft.h"

/* A normal whose free part is shorter than this is held: no multiplier. */
static const PetscReal HELD_NORMAL = 0.1;
/* Covered share of a node's support below which its pressure could not be recovered accurately. */
static const PetscReal SLIVER = 1e-3;
/* Covered share that is nothing but roundoff. */
static const PetscReal NOTHING = 1e-13;
/* Two constraints at one node need normals that differ by at least 20 degrees. */
static const PetscReal SAME_DIRECTION = 0.93969262078590838;
/* Coverages that differ by less are equal, whatever the order of summation: the first pair wins. */
static const PetscReal EQUAL_COVER = 1e-9;

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

PetscErrorCode FatesDecide(const Level *level, const Support *held, PairDraft *draft)
{
  const PetscInt     dim = level->dim;
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
    if (share > NOTHING) keep = (PetscBool)(ProjectNormal_Private(held, i, &N[i * dim]) && share >= SLIVER);
    if (draft->spec->type == PAIR_TIED && held->count[i] > 0) keep = PETSC_FALSE; // a tie needs all directions
    draft->fate[i] = share <= NOTHING ? NODE_UNCOVERED : (keep ? NODE_KEPT : NODE_REMOVED);
  }
  PetscCall(VecRestoreArray(local_N, &N));
  PetscCall(VecRestoreArrayRead(local_full, &full));
  PetscCall(VecRestoreArrayRead(local_D, &D));
  PetscCall(VecGhostRestoreLocalForm(draft->normals, &local_N));
  PetscCall(VecGhostRestoreLocalForm(draft->sums.full, &local_full));
  PetscCall(VecGhostRestoreLocalForm(draft->sums.D, &local_D));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Marks in lost the nodes of p that q serves. [in] first - whether q comes before p; [in,out] lost - [num_nodes] */
static PetscErrorCode LoseNodes_Private(const Level *level, const PairDraft *p, const PairDraft *q, PetscBool first,
                                        PetscBool lost[])
{
  const PetscInt     dim  = level->dim;
  const PetscBool    tied = (PetscBool)(p->spec->type == PAIR_TIED || q->spec->type == PAIR_TIED);
  Vec                v[4] = {p->sums.D, q->sums.D, p->normals, q->normals}, local[4];
  const PetscScalar *a[4];

  PetscFunctionBeginUser;
  for (PetscInt j = 0; j < 4; j++) {
    PetscCall(VecGhostGetLocalForm(v[j], &local[j]));
    PetscCall(VecGetArrayRead(local[j], &a[j]));
  }
  for (PetscInt i = 0; i < level->num_nodes; i++) {
    PetscReal dot = 0;
    if (p->fate[i] != NODE_KEPT || q->fate[i] != NODE_KEPT) continue;
    for (PetscInt k = 0; k < dim; k++) dot += a[2][i * dim + k] * a[3][i * dim + k];
    if (!tied && PetscAbsReal(dot) <= SAME_DIRECTION) continue;
    if (a[1][i] > a[0][i] * (first ? 1 - EQUAL_COVER : 1 + EQUAL_COVER)) lost[i] = PETSC_TRUE;
  }
  for (PetscInt j = 0; j < 4; j++) {
    PetscCall(VecRestoreArrayRead(local[j], &a[j]));
    PetscCall(VecGhostRestoreLocalForm(v[j], &local[j]));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FatesSettle(const Level *level, PetscInt num, PairDraft drafts[])
{
  PetscBool *lost;

  PetscFunctionBeginUser;
  if (num < 2) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscCalloc1(num * level->num_nodes, &lost));
  for (PetscInt p = 0; p < num; p++) {
    for (PetscInt q = 0; q < num; q++) {
      if (p != q)
        PetscCall(LoseNodes_Private(level, &drafts[p], &drafts[q], (PetscBool)(q < p), &lost[p * level->num_nodes]));
    }
  }
  for (PetscInt p = 0; p < num; p++) { // only now: every decision was taken with the fates before
    for (PetscInt i = 0; i < level->num_nodes; i++) {
      if (lost[p * level->num_nodes + i]) drafts[p].fate[i] = NODE_REMOVED;
    }
  }
  PetscCall(PetscFree(lost));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* cyclicroles.c -- cyclic dependencies of roles in the graph of the pairs.

   Pair p depends on pair q if a row of p has, on its mortar side, a node with a multiplier of q. In a cycle,
   the displacement of a node would be determined by itself. The powers of the coupling do not show this: at a
   point that three bodies share they may decrease slowly. */
#include "base/compat.h"
#include "base/usererror.h"
#include "problem/cyclicroles.h"

/* Entries of M below this part of the whole are roundoff. */
static const PetscReal ENTRY_ROUNDOFF = 1e-12;

/* 1 at the nodes that carry a multiplier of a pair, 0 elsewhere. [in,out] marks - bs of each node */
static PetscErrorCode CyclicRolesMarkNodes_Private(const Pair pair, PetscInt bs, Vec marks)
{
  PetscScalar *mark;

  PetscFunctionBeginUser;
  PetscCall(VecZeroEntries(marks));
  PetscCall(VecGetArray(marks, &mark));
  for (PetscInt k = 0; k < bs * pair->num; k++) mark[bs * pair->nodes[k / bs] + k % bs] = 1;
  PetscCall(VecRestoreArray(marks, &mark));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether rows of p hold nodes of q: |diag(marks of p) M diag(marks of q)| > 0.
   [in] M - that of p, or its arm: bs rows of each node */
static PetscErrorCode CyclicRolesLeads_Private(const Pair p, const Pair q, Mat M, PetscInt bs, PetscBool *leads)
{
  PetscReal all, common;
  Vec       rows, columns;
  Mat       part;

  PetscFunctionBeginUser;
  PetscCall(MatCreateVecs(M, &columns, &rows));
  PetscCall(CyclicRolesMarkNodes_Private(p, bs, rows));
  PetscCall(CyclicRolesMarkNodes_Private(q, bs, columns));
  PetscCall(MatDuplicate(M, MAT_COPY_VALUES, &part));
  PetscCall(MatDiagonalScale(part, rows, columns));
  PetscCall(MatNorm(M, NORM_FROBENIUS, &all));
  PetscCall(MatNorm(part, NORM_FROBENIUS, &common));
  *leads = (PetscBool)(common > ENTRY_ROUNDOFF * all);
  PetscCall(MatDestroy(&part));
  PetscCall(VecDestroy(&rows));
  PetscCall(VecDestroy(&columns));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Transitive closure of the dependencies (Warshall). [in,out] leads - [n][n] */
static void CyclicRolesCloseTransitively_Private(PetscInt n, PetscBool leads[])
{
  for (PetscInt over = 0; over < n; over++) {
    for (PetscInt from = 0; from < n; from++) {
      for (PetscInt to = 0; to < n; to++) {
        if (leads[from * n + over] && leads[over * n + to]) leads[from * n + to] = PETSC_TRUE;
      }
    }
  }
}

/* Raises the user error for the pairs that depend on themselves. */
static PetscErrorCode CyclicRolesRaise_Private(VI vi, const PetscBool leads[])
{
  const PetscInt n          = vi->num_pairs;
  char           names[512] = "";

  PetscFunctionBeginUser;
  for (PetscInt p = 0; p < n; p++) {
    if (!leads[p * n + p]) continue;
    PetscCall(PetscStrlcat(names, names[0] ? ", " : "", sizeof(names)));
    PetscCall(PetscStrlcat(names, vi->pairs[p]->spec->name, sizeof(names)));
  }
  if (!names[0]) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(UserErrorRaise(
      vi->level->comm,
      "the pairs %s depend on each other in a cycle (each nonmortar side meets a mortar side that is nonmortar in the "
      "next pair); exchange -<pair>_nonmortar and -<pair>_mortar of one of them",
      names));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CyclicRolesCheck(VI vi)
{
  const PetscInt n = vi->num_pairs;
  PetscBool     *leads;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(n * n, &leads));
  for (PetscInt p = 0; p < n; p++) {
    for (PetscInt q = 0; q < n; q++) {
      const Pair from = vi->pairs[p], to = vi->pairs[q];

      if (p == q || !from->M || !to->M) continue;
      PetscCall(CyclicRolesLeads_Private(from, to, from->M, 1, &leads[p * n + q]));
      if (from->arm && !leads[p * n + q])
        PetscCall(CyclicRolesLeads_Private(from, to, from->arm, vi->level->dim, &leads[p * n + q]));
    }
  }
  CyclicRolesCloseTransitively_Private(n, leads);
  PetscCall(CyclicRolesRaise_Private(vi, leads));
  PetscCall(PetscFree(leads));
  PetscFunctionReturn(PETSC_SUCCESS);
}

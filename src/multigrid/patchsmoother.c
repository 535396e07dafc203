/* patchsmoother.c -- additive smoother over small patches of nodes.

   In a nearly incompressible body, displacements without change of volume have little energy, and others
   much. A smoother must reduce errors of the first kind without adding errors of the second. Node by node
   this fails: no displacement of one node keeps the volume of all cells around it. Displacements of a patch
   can keep it, and every displacement that keeps the volume is a sum of such ones [1].

   Patches overlap, and (R_p A R_p')^-1 is kept as a matrix (patchinverse.c). Unknowns are scaled by the roots
   of the diagonal of A: single precision then suits soft bodies beside stiff ones. With other active unknowns
   only the patches with a changed entry are inverted again.

   References: [1] Schoeberl, Multigrid methods for a parameter dependent problem in primal variables,
   1999. */
#include "base/compat.h"
#include "multigrid/eigenvalue.h"
#include "multigrid/graphpatches.h"
#include "multigrid/patchinverse.h"
#include "multigrid/patchlinks.h"
#include "multigrid/patchsmoother.h"

/* Data of all shells of one level. */
typedef struct {
  PetscInt      references;
  PetscInt      dim, largest;     /* unknowns of a patch at most */
  PetscReal     stiffness, scale; /* of K; of S^-1 */
  PetscReal     part[2];          /* factors of patches and of the inverse diagonal */
  GhostExchange nodes, unknowns;
  RankRows      K, Z;
  GraphPatches  patches;
  PetscReal    *root; /* 1 / sqrt of the diagonal of A [own unknowns, then ghosts] */
  PetscReal    *W;    /* on the diagonal of A [own unknowns, then ghosts] */
  PetscReal    *size; /* diagonal of A where no patch is, else 0 [own unknowns] */
} Patches;

typedef struct {
  Patches      *shared;
  PatchInverse *block; /* of the scaled matrices [patches] */
  PetscReal    *diag;  /* inverse diagonal, 0 in patches [own unknowns] */
  PetscInt      num, *fixed;
  PetscReal    *r, *z; /* scaled [own unknowns, then ghosts] */
} PatchSmoother;

/* Room for the blocks of patches. */
typedef struct {
  PetscInt     *at, *unknown; /* places in the patch, -1 elsewhere; [largest] */
  PetscReal    *matrix;       /* [largest][largest] */
  PatchInverses inverses;
} PatchesWork;

static PetscInt PatchesRoom_Private(const Patches *shared)
{
  return shared->unknowns.n + shared->unknowns.num;
}

static PetscErrorCode PatchesDestroy_Private(Patches *shared)
{
  PetscFunctionBeginUser;
  if (--shared->references) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(GhostExchangeDestroy(&shared->nodes));
  PetscCall(GhostExchangeDestroy(&shared->unknowns));
  PetscCall(RankRowsDestroy(&shared->K));
  PetscCall(RankRowsDestroy(&shared->Z));
  PetscCall(GraphPatchesDestroy(&shared->patches));
  PetscCall(PetscFree(shared->root));
  PetscCall(PetscFree(shared->W));
  PetscCall(PetscFree(shared->size));
  PetscCall(PetscFree(shared));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Destroy_PatchSmoother(Mat S)
{
  PatchSmoother *patch;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(S, &patch));
  for (PetscInt p = 0; p < patch->shared->patches.num; p++) PetscCall(PatchInverseDestroy(&patch->block[p]));
  PetscCall(PetscFree(patch->block));
  PetscCall(PetscFree(patch->diag));
  PetscCall(PetscFree(patch->fixed));
  PetscCall(PetscFree2(patch->r, patch->z));
  PetscCall(PatchesDestroy_Private(patch->shared));
  PetscCall(PetscFree(patch));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Unknowns of a patch. [out] unknown - [return value] */
static PetscInt PatchesGet_Private(const Patches *shared, PetscInt p, PetscInt unknown[])
{
  PetscInt num = 0;

  for (PetscInt i = shared->patches.start[p]; i < shared->patches.start[p + 1]; i++)
    for (PetscInt k = 0; k < shared->dim; k++) unknown[num++] = shared->dim * shared->patches.node[i] + k;
  return num;
}

static PetscInt PatchesLargest_Private(const Patches *shared)
{
  PetscInt max = 0;

  for (PetscInt p = 0; p < shared->patches.num; p++)
    max = PetscMax(max, shared->dim * (shared->patches.start[p + 1] - shared->patches.start[p]));
  return max;
}

/* Adds the values of ghosts to their owners. [in,out] z - own unknowns, then ghosts */
static PetscErrorCode PatchSmootherShare_Private(GhostExchange *unknowns, PetscReal z[])
{
  PetscScalar *a;

  PetscFunctionBeginUser;
  PetscCall(VecGetArrayWrite(unknowns->own, &a));
  for (PetscInt i = 0; i < unknowns->n; i++) a[i] = z[i];
  PetscCall(VecRestoreArrayWrite(unknowns->own, &a));
  PetscCall(VecGetArrayWrite(unknowns->theirs, &a));
  for (PetscInt i = 0; i < unknowns->num; i++) a[i] = z[unknowns->n + i];
  PetscCall(VecRestoreArrayWrite(unknowns->theirs, &a));
  PetscCall(VecScatterBegin(unknowns->scatter, unknowns->theirs, unknowns->own, ADD_VALUES, SCATTER_REVERSE));
  PetscCall(VecScatterEnd(unknowns->scatter, unknowns->theirs, unknowns->own, ADD_VALUES, SCATTER_REVERSE));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* z = S^-1 r, for r that is 0 where fixed */
static PetscErrorCode Mult_PatchSmoother(Mat S, Vec r, Vec z)
{
  PatchSmoother     *patch;
  Patches           *shared;
  float             *work;
  const PetscScalar *ra, *sum;
  PetscScalar       *za;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(S, &patch));
  shared = patch->shared;
  PetscCall(PetscMalloc1(PatchInverseWork(shared->largest), &work));
  PetscCall(VecGetArrayRead(r, &ra));
  for (PetscInt i = 0; i < shared->unknowns.n; i++) patch->r[i] = shared->root[i] * PetscRealPart(ra[i]);
  PetscCall(GhostExchangeUpdate(&shared->unknowns, patch->r));
  PetscCall(PetscArrayzero(patch->z, PatchesRoom_Private(shared)));
  PatchInverseAdd(&shared->patches, patch->block, shared->dim, patch->r, patch->z, work);
  PetscCall(PatchSmootherShare_Private(&shared->unknowns, patch->z));
  PetscCall(VecGetArrayRead(shared->unknowns.own, &sum));
  PetscCall(VecGetArrayWrite(z, &za));
  for (PetscInt i = 0; i < shared->unknowns.n; i++)
    za[i] = shared->scale * (shared->part[0] * shared->root[i] * sum[i] + shared->part[1] * patch->diag[i] * ra[i]);
  for (PetscInt i = 0; i < patch->num; i++) za[patch->fixed[i]] = 0;
  PetscCall(VecRestoreArrayWrite(z, &za));
  PetscCall(VecRestoreArrayRead(shared->unknowns.own, &sum));
  PetscCall(VecRestoreArrayRead(r, &ra));
  PetscCall(PetscFree(work));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds factor times the entries of a matrix among unknowns.
   [in] at - place of each unknown in the patch, or -1; [in,out] a - [num][num] */
static PetscErrorCode PatchesAddEntries_Private(RankRows *rows, PetscReal factor, PetscInt num,
                                                const PetscInt unknown[], const PetscInt at[], PetscReal a[])
{
  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < num; i++) {
    PetscInt           length;
    const PetscInt    *column;
    const PetscScalar *value;

    PetscCall(RankRowsGet(rows, unknown[i], &length, &column, &value));
    for (PetscInt j = 0; j < length; j++)
      if (at[column[j]] >= 0) a[i * num + at[column[j]]] += factor * PetscRealPart(value[j]);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The block of one patch; rows of fixed unknowns are 0.
   [in] change - rows of the matrix added to A, or NULL; [in] gone - fixed unknowns */
static PetscErrorCode PatchesSetBlock_Private(Patches *shared, RankRows *change, PetscInt p, const PetscReal gone[],
                                              PatchesWork *work, PatchInverse *block)
{
  const PetscInt num = PatchesGet_Private(shared, p, work->unknown), *unknown = work->unknown;
  PetscInt      *at = work->at;
  PetscReal     *a  = work->matrix;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(a, num * num));
  for (PetscInt i = 0; i < num; i++) at[unknown[i]] = gone[unknown[i]] != 0 ? -1 : i;
  PetscCall(PatchesAddEntries_Private(&shared->K, 1 / shared->stiffness, num, unknown, at, a));
  PetscCall(PatchesAddEntries_Private(&shared->Z, 1, num, unknown, at, a));
  if (change) PetscCall(PatchesAddEntries_Private(change, 1, num, unknown, at, a));
  for (PetscInt i = 0; i < num; i++) {
    const PetscBool out = (PetscBool)(at[unknown[i]] < 0);

    if (!out) a[i * num + i] += shared->W[unknown[i]];
    for (PetscInt j = 0; j < num; j++) {
      if (out) a[i * num + j] = a[j * num + i] = 0;
      a[i * num + j] *= shared->root[unknown[i]] * shared->root[unknown[j]];
    }
  }
  PetscCall(PatchInverseDestroy(block));
  PetscCall(PatchInversesGet(work->inverses, num, a, block));
  for (PetscInt i = 0; i < num; i++) at[unknown[i]] = -1;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Blocks of patches with a changed unknown. [in] changed - NULL for all */
static PetscErrorCode PatchSmootherSetBlocks_Private(PatchSmoother *patch, RankRows *change, const PetscReal gone[],
                                                     const PetscReal changed[])
{
  Patches       *shared  = patch->shared;
  const PetscInt largest = shared->largest, room = PatchesRoom_Private(shared);
  PatchesWork    work;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(room, &work.at, largest * largest, &work.matrix, largest, &work.unknown));
  PetscCall(PatchInversesCreate(largest, &work.inverses));
  for (PetscInt i = 0; i < room; i++) work.at[i] = -1;
  for (PetscInt p = 0; p < shared->patches.num; p++) {
    const PetscInt num = PatchesGet_Private(shared, p, work.unknown);
    PetscBool      due = (PetscBool)!changed;

    for (PetscInt i = 0; i < num && !due; i++) due = (PetscBool)(changed[work.unknown[i]] != 0);
    if (due) PetscCall(PatchesSetBlock_Private(shared, change, p, gone, &work, &patch->block[p]));
  }
  PetscCall(PatchInversesDestroy(&work.inverses));
  PetscCall(PetscFree3(work.at, work.matrix, work.unknown));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* An empty shell. [in] shared - one reference more */
static PetscErrorCode PatchSmootherBegin_Private(Patches *shared, MPI_Comm comm, PatchSmoother **patch, Mat *inverse)
{
  const PetscInt n = shared->unknowns.n;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(patch));
  shared->references++;
  (*patch)->shared = shared;
  PetscCall(PetscCalloc1(shared->patches.num, &(*patch)->block));
  PetscCall(PetscCalloc1(n, &(*patch)->diag));
  PetscCall(PetscMalloc2(PatchesRoom_Private(shared), &(*patch)->r, PatchesRoom_Private(shared), &(*patch)->z));
  PetscCall(MatCreateShell(comm, n, n, PETSC_DETERMINE, PETSC_DETERMINE, *patch, inverse));
  PetscCall(MatShellSetOperation(*inverse, MATOP_MULT, (void (*)(void))Mult_PatchSmoother));
  PetscCall(MatShellSetOperation(*inverse, MATOP_DESTROY, (void (*)(void))Destroy_PatchSmoother));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The diagonal of A, where no patch is and as roots, and W. */
static PetscErrorCode PatchesSetDiagonal_Private(const Operator *op, Patches *shared)
{
  const PetscInt     n = shared->unknowns.n;
  const PetscScalar *a;
  PetscReal         *covered;
  Vec                diag;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(PatchesRoom_Private(shared), &shared->root));
  PetscCall(PetscCalloc1(PatchesRoom_Private(shared), &shared->W));
  PetscCall(PetscCalloc1(n, &shared->size));
  PetscCall(PetscCalloc1(PatchesRoom_Private(shared), &covered));
  for (PetscInt i = 0; i < (shared->patches.num ? shared->patches.start[shared->patches.num] : 0); i++)
    for (PetscInt k = 0; k < shared->dim; k++) covered[shared->dim * shared->patches.node[i] + k] = 1;
  PetscCall(PatchSmootherShare_Private(&shared->unknowns, covered));
  PetscCall(VecGetArrayRead(shared->unknowns.own, &a));
  for (PetscInt i = 0; i < n; i++) covered[i] = PetscRealPart(a[i]);
  PetscCall(VecRestoreArrayRead(shared->unknowns.own, &a));
  PetscCall(MatCreateVecs(op->K, &diag, NULL));
  PetscCall(MatGetDiagonal(op->A, diag));
  PetscCall(VecGetArrayRead(diag, &a));
  for (PetscInt i = 0; i < n; i++) shared->size[i] = covered[i] == 0 ? PetscRealPart(a[i]) : 0;
  for (PetscInt i = 0; i < n; i++) shared->root[i] = 1 / PetscSqrtReal(PetscRealPart(a[i]));
  PetscCall(GhostExchangeUpdate(&shared->unknowns, shared->root));
  PetscCall(VecRestoreArrayRead(diag, &a));
  PetscCall(VecDestroy(&diag));
  PetscCall(PetscFree(covered));
  if (!op->W) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecGetArrayRead(op->W, &a));
  for (PetscInt i = 0; i < n; i++) shared->W[i] = PetscRealPart(a[i]);
  PetscCall(VecRestoreArrayRead(op->W, &a));
  PetscCall(GhostExchangeUpdate(&shared->unknowns, shared->W));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Fixed unknowns on own unknowns, then ghosts. */
static PetscErrorCode PatchesMark_Private(Patches *shared, PetscInt num, const PetscInt fixed[], PetscReal gone[])
{
  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(gone, PatchesRoom_Private(shared)));
  for (PetscInt i = 0; i < num; i++) gone[fixed[i]] = 1;
  PetscCall(GhostExchangeUpdate(&shared->unknowns, gone));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Inverse diagonal where no patch is. [in] more - added to it, or NULL */
static PetscErrorCode PatchSmootherSetDiagonal_Private(PatchSmoother *patch, Mat more)
{
  const Patches     *shared = patch->shared;
  const PetscScalar *a      = NULL;
  Vec                diag   = NULL;

  PetscFunctionBeginUser;
  if (more) {
    PetscCall(MatCreateVecs(more, &diag, NULL));
    PetscCall(MatGetDiagonal(more, diag));
    PetscCall(VecGetArrayRead(diag, &a));
  }
  for (PetscInt i = 0; i < shared->unknowns.n; i++)
    if (shared->size[i] > 0) patch->diag[i] = 1 / (shared->size[i] + (a ? PetscRealPart(a[i]) : 0));
  if (diag) PetscCall(VecRestoreArrayRead(diag, &a));
  PetscCall(VecDestroy(&diag));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode PatchSmootherFix_Private(PatchSmoother *patch, PetscInt num, const PetscInt fixed[])
{
  PetscFunctionBeginUser;
  patch->num = num;
  PetscCall(PetscMalloc1(num, &patch->fixed));
  PetscCall(PetscArraycpy(patch->fixed, fixed, num));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Where patches overlap, their largest eigenvalue is several times that of a diagonal. Both get the same one,
   for nodes without a patch beside them. */
static PetscErrorCode PatchSmootherBalance_Private(const Operator *op, Patches *shared, Mat inverse)
{
  PetscInt  alone = 0;
  PetscReal largest[2];

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < shared->unknowns.n; i++) alone += shared->size[i] > 0;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &alone, 1, MPIU_INT, MPI_SUM, PetscObjectComm((PetscObject)inverse)));
  if (!alone) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt k = 0; k < 2; k++) {
    shared->part[k]     = 1;
    shared->part[1 - k] = 0;
    PetscCall(EigenvalueLargest(op->A, inverse, NULL, &largest[k]));
  }
  for (PetscInt k = 0; k < 2; k++) shared->part[k] = largest[k] > 0 ? 1 / largest[k] : 1;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Marks nodes that have marked ones in their rows. [in,out] marked - own nodes, then ghosts */
static PetscErrorCode PatchesSpreadMarks_Private(GhostExchange *nodes, RankRows *rows, PetscReal marked[])
{
  PetscReal *before;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(nodes->n + nodes->num, &before));
  PetscCall(PetscArraycpy(before, marked, nodes->n + nodes->num));
  for (PetscInt i = 0; i < nodes->n; i++) {
    PetscInt           num;
    const PetscInt    *column;
    const PetscScalar *value;

    PetscCall(RankRowsGet(rows, rows->bs * i, &num, &column, &value));
    for (PetscInt j = 0; j < num; j++) marked[i] = PetscMax(marked[i], before[column[j] / rows->bs]);
  }
  PetscCall(PetscFree(before));
  PetscCall(GhostExchangeUpdate(nodes, marked));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Patches of marked nodes, and of those around mortar nodes that move such nodes.
   [in] links - nodes and those that they move; or NULL */
static PetscErrorCode PatchesFindMarked_Private(const Operator *op, Patches *shared, RankRows *links)
{
  const PetscInt num = shared->nodes.n + shared->nodes.num;
  PetscReal     *marked, *beside;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(num, &marked, num, &beside));
  for (PetscInt i = 0; i < shared->nodes.n; i++) marked[i] = op->tight[i] ? 1 : 0;
  PetscCall(GhostExchangeUpdate(&shared->nodes, marked));
  if (links) {
    PetscCall(PetscArraycpy(beside, marked, num));
    PetscCall(PatchesSpreadMarks_Private(&shared->nodes, links, beside));
    for (PetscInt i = 0; i < num; i++) beside[i] -= marked[i];
    PetscCall(PatchesSpreadMarks_Private(&shared->nodes, &shared->K, beside));
    for (PetscInt i = 0; i < num; i++) marked[i] = PetscMax(marked[i], beside[i]);
  }
  PetscCall(GraphPatchesCreate(&shared->K, op->dim, &shared->nodes, marked, &shared->patches));
  if (links) PetscCall(GraphPatchesExtend(&shared->nodes, links, &shared->patches));
  PetscCall(PetscFree2(marked, beside));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a node comes before another one by its first coordinate that differs. [in] x - [dim][nodes] */
static PetscBool PatchesPrecedes_Private(const Patches *shared, PetscReal *const x[], PetscReal same, PetscInt a,
                                         PetscInt b)
{
  for (PetscInt k = 0; k < shared->dim; k++)
    if (PetscAbsReal(x[k][a] - x[k][b]) > same) return (PetscBool)(x[k][a] < x[k][b]);
  return PETSC_FALSE;
}

/* Orders the nodes of each patch by their coordinates: patches that are translations of each other then have
   the same matrix. */
static PetscErrorCode PatchesSort_Private(const Operator *op, Patches *shared)
{
  static const PetscReal SAME_COORDINATE = 1e-6; /* relative to the width of a patch */
  const PetscInt         all             = shared->nodes.n + shared->nodes.num;
  PetscReal             *x[3];

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < shared->dim; k++) {
    PetscCall(PetscMalloc1(all, &x[k]));
    for (PetscInt i = 0; i < shared->nodes.n; i++) x[k][i] = op->coords[i * shared->dim + k];
    PetscCall(GhostExchangeUpdate(&shared->nodes, x[k]));
  }
  for (PetscInt p = 0; p < shared->patches.num; p++) {
    PetscInt *node = &shared->patches.node[shared->patches.start[p]];
    PetscInt  num  = shared->patches.start[p + 1] - shared->patches.start[p];
    PetscReal same = 0;

    for (PetscInt i = 1; i < num; i++)
      for (PetscInt k = 0; k < shared->dim; k++)
        same = PetscMax(same, SAME_COORDINATE * PetscAbsReal(x[k][node[i]] - x[k][node[0]]));
    for (PetscInt i = 1; i < num; i++)
      for (PetscInt j = i; j && PatchesPrecedes_Private(shared, x, same, node[j], node[j - 1]); j--) {
        const PetscInt first = node[j];

        node[j]     = node[j - 1];
        node[j - 1] = first;
      }
  }
  for (PetscInt k = 0; k < shared->dim; k++) PetscCall(PetscFree(x[k]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Patches, the nodes of both sides of contact among them. */
static PetscErrorCode PatchesFind_Private(const Operator *op, Patches *shared)
{
  GhostExchange near, far;
  Mat           links = NULL;
  RankRows      rows;

  PetscFunctionBeginUser;
  PetscCall(GhostExchangeCreate(op->K, op->dim, &near));
  if (op->T) {
    PetscCall(PatchLinksCreate(op, near.n, &links));
    PetscCall(GhostExchangeCreate(links, 1, &far));
  }
  PetscCall(GhostExchangeCreateUnion(&near, op->T ? &far : &near, 1, &shared->nodes));
  PetscCall(GhostExchangeCreateUnion(&near, op->T ? &far : &near, op->dim, &shared->unknowns));
  PetscCall(RankRowsCreate(op->K, op->dim, &shared->nodes, &shared->K));
  PetscCall(RankRowsCreate(op->Z, op->dim, &shared->nodes, &shared->Z));
  PetscCall(RankRowsCreate(links, 1, &shared->nodes, &rows));
  PetscCall(PatchesFindMarked_Private(op, shared, links ? &rows : NULL));
  PetscCall(PatchesSort_Private(op, shared));
  PetscCall(RankRowsDestroy(&rows));
  if (op->T) PetscCall(GhostExchangeDestroy(&far));
  PetscCall(MatDestroy(&links));
  PetscCall(GhostExchangeDestroy(&near));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PatchSmootherCreate(const Operator *op, Mat *inverse)
{
  PetscReal     *gone;
  Patches       *shared;
  PatchSmoother *patch;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&shared));
  shared->dim       = op->dim;
  shared->stiffness = op->stiffness;
  shared->scale = shared->part[0] = shared->part[1] = 1;
  PetscCall(PatchesFind_Private(op, shared));
  shared->largest = PatchesLargest_Private(shared);
  PetscCall(PatchesSetDiagonal_Private(op, shared));
  PetscCall(PatchSmootherBegin_Private(shared, PetscObjectComm((PetscObject)op->K), &patch, inverse));
  PetscCall(PetscMalloc1(PatchesRoom_Private(shared), &gone));
  PetscCall(PatchesMark_Private(shared, op->num_fixed, op->fixed, gone));
  PetscCall(PatchSmootherSetBlocks_Private(patch, NULL, gone, NULL));
  PetscCall(PetscFree(gone));
  PetscCall(PatchSmootherSetDiagonal_Private(patch, NULL));
  PetscCall(PatchSmootherFix_Private(patch, op->num_fixed, op->fixed));
  PetscCall(PatchSmootherBalance_Private(op, shared, *inverse));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PatchSmootherIs(Mat S, PetscBool *is, PetscBool *cells)
{
  void (*mult)(void);
  PatchSmoother *patch;

  PetscFunctionBeginUser;
  PetscCall(PetscObjectTypeCompare((PetscObject)S, MATSHELL, is));
  if (!*is) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatShellGetOperation(S, MATOP_MULT, &mult));
  *is = (PetscBool)(mult == (void (*)(void))Mult_PatchSmoother);
  if (!*is || !cells) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatShellGetContext(S, &patch));
  *cells = patch->shared->patches.cells;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PatchSmootherScale(Mat inverse, PetscReal factor)
{
  PatchSmoother *patch;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(inverse, &patch));
  patch->shared->scale /= factor;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Marks unknowns in whose rows a matrix has entries. */
static PetscErrorCode PatchesMarkRows_Private(Patches *shared, RankRows *rows, PetscReal changed[])
{
  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < shared->unknowns.n; i++) {
    PetscInt           length;
    const PetscInt    *column;
    const PetscScalar *value;

    PetscCall(RankRowsGet(rows, i, &length, &column, &value));
    if (length) changed[i] = 1;
  }
  PetscCall(GhostExchangeUpdate(&shared->unknowns, changed));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PatchSmootherSetFixed(Mat from, Mat change, PetscInt num, const PetscInt fixed[], Mat *inverse)
{
  PatchSmoother *base, *patch;
  Patches       *shared;
  RankRows       rows;
  PetscReal     *gone, *changed;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(from, &base));
  shared = base->shared;
  PetscCall(PatchSmootherBegin_Private(shared, PetscObjectComm((PetscObject)from), &patch, inverse));
  for (PetscInt p = 0; p < shared->patches.num; p++) patch->block[p] = PatchInverseReference(base->block[p]);
  PetscCall(RankRowsCreate(change, shared->dim, &shared->nodes, &rows));
  PetscCall(PetscMalloc2(PatchesRoom_Private(shared), &gone, PatchesRoom_Private(shared), &changed));
  PetscCall(PatchesMark_Private(shared, base->num, base->fixed, changed));
  PetscCall(PatchesMark_Private(shared, num, fixed, gone));
  for (PetscInt i = 0; i < PatchesRoom_Private(shared); i++) {
    const PetscBool new = (PetscBool)(gone[i] != changed[i]);

    gone[i]    = PetscMax(gone[i], changed[i]);
    changed[i] = new ? 1 : 0;
  }
  if (change) PetscCall(PatchesMarkRows_Private(shared, &rows, changed));
  PetscCall(PatchSmootherSetBlocks_Private(patch, change ? &rows : NULL, gone, changed));
  PetscCall(PetscFree2(gone, changed));
  PetscCall(RankRowsDestroy(&rows));
  PetscCall(PatchSmootherSetDiagonal_Private(patch, change));
  PetscCall(PatchSmootherFix_Private(patch, num, fixed));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* graphcomponents.c -- the connected components of a matrix graph across ranks.

   Each rank joins its own rows. Then the smallest row numbers pass from rank to rank along the cut couplings
   until none changes. */
#include "base/compat.h"
#include "base/gather.h"
#include "multigrid/graphcomponents.h"
#include "multigrid/ghostexchange.h"
#include "kernel/disjointsets.h"

/* The components of this rank's rows as trees; the root is the first row. */
typedef struct {
  PetscInt *parent;       /* [n] */
  PetscInt  num_cut, max; /* couplings with other ranks' rows */
  PetscInt *near, *far;   /* row, ghost [num_cut] */
} Forest;

static PetscErrorCode GraphComponentsAddCut_Private(Forest *forest, PetscInt near, PetscInt far)
{
  PetscFunctionBeginUser;
  if (forest->num_cut == forest->max) {
    forest->max = 2 * forest->max + 128;
    PetscCall(PetscRealloc(forest->max * sizeof(PetscInt), &forest->near));
    PetscCall(PetscRealloc(forest->max * sizeof(PetscInt), &forest->far));
  }
  forest->near[forest->num_cut]  = near;
  forest->far[forest->num_cut++] = far;
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode GraphComponentsJoin_Private(Mat A, const GhostExchange *ghosts, Forest *forest)
{
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(ghosts->n, &forest->parent));
  DisjointSetsInitialize(ghosts->n, forest->parent);
  for (PetscInt i = 0; i < ghosts->n; i++) {
    PetscInt           num;
    const PetscInt    *columns;
    const PetscScalar *values;

    PetscCall(MatGetRow(A, ghosts->begin + i, &num, &columns, &values));
    for (PetscInt c = 0; c < num; c++) {
      PetscInt at;

      if (values[c] == 0) continue;
      PetscCall(GhostExchangeFind(ghosts, columns[c], &at));
      if (at < ghosts->n)
        DisjointSetsUnite(forest->parent, i, at);
      else
        PetscCall(GraphComponentsAddCut_Private(forest, i, at));
    }
    PetscCall(MatRestoreRow(A, ghosts->begin + i, &num, &columns, &values));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GraphComponentsLabel(Mat A, PetscReal label[])
{
  const MPI_Comm comm   = PetscObjectComm((PetscObject)A);
  Forest         forest = {.num_cut = 0};
  PetscReal     *first, *all; /* of the component of a root's tree; labels of all rows and ghosts */
  PetscBool      changed;
  GhostExchange  ghosts;

  PetscFunctionBeginUser;
  PetscCall(GhostExchangeCreate(A, 1, &ghosts));
  PetscCall(GraphComponentsJoin_Private(A, &ghosts, &forest));
  PetscCall(PetscMalloc2(ghosts.n, &first, ghosts.n + ghosts.num, &all));
  for (PetscInt i = 0; i < ghosts.n; i++) first[i] = (PetscReal)(ghosts.begin + i);
  do {
    for (PetscInt i = 0; i < ghosts.n; i++) all[i] = first[DisjointSetsFind(forest.parent, i)];
    PetscCall(GhostExchangeUpdate(&ghosts, all));
    changed = PETSC_FALSE;
    for (PetscInt c = 0; c < forest.num_cut; c++) {
      const PetscInt root = DisjointSetsFind(forest.parent, forest.near[c]);

      if (all[forest.far[c]] >= first[root]) continue;
      first[root] = all[forest.far[c]];
      changed     = PETSC_TRUE;
    }
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &changed, 1, MPIU_BOOL, MPI_LOR, comm));
  } while (changed);
  PetscCall(PetscArraycpy(label, all, ghosts.n));
  PetscCall(PetscFree2(first, all));
  PetscCall(PetscFree(forest.parent));
  PetscCall(PetscFree(forest.near));
  PetscCall(PetscFree(forest.far));
  PetscCall(GhostExchangeDestroy(&ghosts));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Rows that each rank has of the components with a label of this rank.
   [in] label - distinct ones of a rank, with their numbers of rows [num]; [out] shares - AIJ, labels by
   ranks */
static PetscErrorCode GraphComponentsShare_Private(Vec own, PetscInt num, PetscInt label[], const PetscScalar count[],
                                                   Mat *shares)
{
  const MPI_Comm comm = PetscObjectComm((PetscObject)own);
  PetscMPIInt    size, me;
  PetscInt       n, *rank, *row;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCallMPI(MPI_Comm_rank(comm, &me));
  PetscCall(VecGetLocalSize(own, &n));
  PetscCall(PetscMalloc2(num, &rank, num, &row));
  for (PetscInt i = 0; i < num; i++) rank[i] = me;
  PetscCall(PetscArraycpy(row, label, num)); // PETSc may change it
  PetscCall(MatCreate(comm, shares));
  PetscCall(MatSetSizes(*shares, n, PETSC_DECIDE, PETSC_DETERMINE, size));
  PetscCall(MatSetType(*shares, MATAIJ));
  PetscCall(MatSetPreallocationCOO(*shares, num, row, rank));
  PetscCall(MatSetValuesCOO(*shares, count, INSERT_VALUES));
  PetscCall(PetscFree2(rank, row));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The rank of each label. What is due to a rank is its rows of the components so far, less all rows of those
   that it was given. A component goes to that one of its ranks to which most is due.
   [out] winner - 0 where a row is no label */
static PetscErrorCode GraphComponentsElect_Private(Mat shares, Vec winner)
{
  PetscMPIInt  size;
  PetscInt     begin, end;
  PetscReal   *due; /* [size] */
  PetscScalar *w;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(PetscObjectComm((PetscObject)shares), &size));
  PetscCall(PetscCalloc1(size, &due));
  PetscCall(MatGetOwnershipRange(shares, &begin, &end));
  PetscCall(VecGetArrayWrite(winner, &w));
  for (PetscInt row = begin; row < end; row++) {
    PetscInt           num, most = 0;
    PetscReal          rows = 0;
    const PetscInt    *rank;
    const PetscScalar *count;

    PetscCall(MatGetRow(shares, row, &num, &rank, &count));
    for (PetscInt k = 0; k < num; k++) {
      due[rank[k]] += PetscRealPart(count[k]);
      rows += PetscRealPart(count[k]);
      if (due[rank[k]] > due[rank[most]]) most = k;
    }
    if (num) due[rank[most]] -= rows;
    w[row - begin] = num ? rank[most] : 0;
    PetscCall(MatRestoreRow(shares, row, &num, &rank, &count));
  }
  PetscCall(VecRestoreArrayWrite(winner, &w));
  PetscCall(PetscFree(due));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The rank of each row. [in] label - [n]; [out] rank - [n] */
static PetscErrorCode GraphComponentsAssign_Private(Vec own, PetscInt n, const PetscReal label[], PetscInt rank[])
{
  PetscInt           num = n, *distinct, at;
  PetscScalar       *count;
  const PetscScalar *result;
  Mat                shares;
  Vec                winner, mine;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(n, &distinct));
  PetscCall(PetscCalloc1(n, &count));
  for (PetscInt i = 0; i < n; i++) distinct[i] = (PetscInt)label[i];
  PetscCall(PetscSortRemoveDupsInt(&num, distinct));
  for (PetscInt i = 0; i < n; i++) {
    PetscCall(PetscFindInt((PetscInt)label[i], num, distinct, &at));
    rank[i] = at;
    count[at] += 1;
  }
  PetscCall(GraphComponentsShare_Private(own, num, distinct, count, &shares));
  PetscCall(VecDuplicate(own, &winner));
  PetscCall(GraphComponentsElect_Private(shares, winner));
  PetscCall(GatherEntries(winner, num, distinct, &mine));
  PetscCall(VecGetArrayRead(mine, &result));
  for (PetscInt i = 0; i < n; i++) rank[i] = (PetscInt)PetscRealPart(result[rank[i]]);
  PetscCall(VecRestoreArrayRead(mine, &result));
  PetscCall(VecDestroy(&mine));
  PetscCall(VecDestroy(&winner));
  PetscCall(MatDestroy(&shares));
  PetscCall(PetscFree(distinct));
  PetscCall(PetscFree(count));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GraphComponentsDeal(Vec own, const PetscReal label[], IS *rows)
{
  PetscInt n, *rank;
  IS       to;

  PetscFunctionBeginUser;
  PetscCall(VecGetLocalSize(own, &n));
  PetscCall(PetscMalloc1(n, &rank));
  PetscCall(GraphComponentsAssign_Private(own, n, label, rank));
  PetscCall(ISCreateGeneral(PetscObjectComm((PetscObject)own), n, rank, PETSC_COPY_VALUES, &to));
  PetscCall(ISBuildTwoSided(to, NULL, rows));
  PetscCall(ISSort(*rows));
  PetscCall(ISDestroy(&to));
  PetscCall(PetscFree(rank));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GraphComponentsGather(Mat A, IS *rows)
{
  PetscInt   n;
  PetscReal *label;
  Vec        own;

  PetscFunctionBeginUser;
  PetscCall(MatGetLocalSize(A, &n, NULL));
  PetscCall(PetscMalloc1(n, &label));
  PetscCall(GraphComponentsLabel(A, label));
  PetscCall(MatCreateVecs(A, NULL, &own));
  PetscCall(GraphComponentsDeal(own, label, rows));
  PetscCall(VecDestroy(&own));
  PetscCall(PetscFree(label));
  PetscFunctionReturn(PETSC_SUCCESS);
}

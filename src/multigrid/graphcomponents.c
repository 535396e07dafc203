/* graphcomponents.c -- the connected components of a matrix graph across ranks.

   Each rank joins its own rows. Then the smallest row numbers pass from rank to rank along the cut couplings
   until none changes. */
#include "base/compat.h"
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

/* The rank that owns most rows of each component, the first one if several do. [in] label - [n]; [out] rank -
   [n] */
static PetscErrorCode GraphComponentsElect_Private(Mat A, PetscInt n, const PetscReal label[], PetscInt rank[])
{
  const MPI_Comm     comm = PetscObjectComm((PetscObject)A);
  PetscMPIInt        size, me;
  PetscInt           num, *distinct, *count, at;
  PetscScalar       *vote;
  const PetscScalar *result;
  Vec                ballot, votes; /* by label: number of rows, combined with the rank in the lower digits */
  IS                 which;
  VecScatter         scatter;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCallMPI(MPI_Comm_rank(comm, &me));
  PetscCall(PetscMalloc2(n, &distinct, n, &count));
  for (PetscInt i = 0; i < n; i++) distinct[i] = (PetscInt)label[i];
  num = n;
  PetscCall(PetscSortRemoveDupsInt(&num, distinct));
  PetscCall(PetscArrayzero(count, num));
  for (PetscInt i = 0; i < n; i++) {
    PetscCall(PetscFindInt((PetscInt)label[i], num, distinct, &at));
    count[at]++;
  }
  PetscCall(MatCreateVecs(A, NULL, &ballot));
  PetscCall(VecZeroEntries(ballot));
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, num, &votes));
  PetscCall(VecGetArrayWrite(votes, &vote));
  for (PetscInt i = 0; i < num; i++) vote[i] = (PetscScalar)count[i] * size + (size - 1 - me);
  PetscCall(VecRestoreArrayWrite(votes, &vote));
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, num, distinct, PETSC_USE_POINTER, &which));
  PetscCall(VecScatterCreate(ballot, which, votes, NULL, &scatter));
  PetscCall(VecScatterBegin(scatter, votes, ballot, MAX_VALUES, SCATTER_REVERSE));
  PetscCall(VecScatterEnd(scatter, votes, ballot, MAX_VALUES, SCATTER_REVERSE));
  PetscCall(VecScatterBegin(scatter, ballot, votes, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(scatter, ballot, votes, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGetArrayRead(votes, &result));
  for (PetscInt i = 0; i < n; i++) {
    PetscCall(PetscFindInt((PetscInt)label[i], num, distinct, &at));
    rank[i] = size - 1 - (PetscInt)PetscRealPart(result[at]) % size;
  }
  PetscCall(VecRestoreArrayRead(votes, &result));
  PetscCall(VecScatterDestroy(&scatter));
  PetscCall(ISDestroy(&which));
  PetscCall(VecDestroy(&votes));
  PetscCall(VecDestroy(&ballot));
  PetscCall(PetscFree2(distinct, count));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GraphComponentsGather(Mat A, IS *rows)
{
  PetscInt   n, *rank;
  PetscReal *label;
  IS         to;

  PetscFunctionBeginUser;
  PetscCall(MatGetLocalSize(A, &n, NULL));
  PetscCall(PetscMalloc2(n, &label, n, &rank));
  PetscCall(GraphComponentsLabel(A, label));
  PetscCall(GraphComponentsElect_Private(A, n, label, rank));
  PetscCall(ISCreateGeneral(PetscObjectComm((PetscObject)A), n, rank, PETSC_COPY_VALUES, &to));
  PetscCall(ISBuildTwoSided(to, NULL, rows));
  PetscCall(ISSort(*rows));
  PetscCall(ISDestroy(&to));
  PetscCall(PetscFree2(label, rank));
  PetscFunctionReturn(PETSC_SUCCESS);
}

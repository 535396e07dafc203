/* redundantsolve.c -- redundant factorization of a small matrix: on every rank, or for larger ones on the
   first of each group of ranks.

   A distributed factorization would take mostly messages. Ranks of one machine share its caches. If the
   factors of all would exceed them, one rank of a group solves while the others wait. PETSc's PCREDUNDANT
   does not pass on that the matrix is positive definite: its factorization searches pivots, and results
   differ from those of one rank. */
#include "base/compat.h"
#include "multigrid/redundantsolve.h"

enum {
  GROUP_RANKS  = 8,   /* which share a factorization */
  GROUP_FACTOR = 4000 /* unknowns from which they do: the factors have some megabytes */
};

/* Name of the PC. */
static const char NAME[] = "redundant factorization";

typedef struct {
  PetscBool        gathered; /* whether `whole` is newer than its factors */
  Mat              of;       /* the matrix gathered last, or NULL, and which nonzeros it had */
  PetscObjectState nonzeros;
  Mat             *parts, whole;    /* a copy of it on ranks that solve, else NULL; as MatCreateSubMatrices() has it */
  PC               pc;              /* of it */
  Vec              b, x;            /* whole */
  MPI_Comm         group, solvers;  /* solvers: MPI_COMM_NULL on ranks that do not solve */
  PetscMPIInt     *counts, *begins; /* rows of the ranks of this group, on its first [ranks of the group] */
  PetscMPIInt     *blocks, *firsts; /* rows of the groups, on those that solve [groups] */
} RedundantSolve;

static PetscErrorCode RedundantSolveRelease_Private(RedundantSolve *redundant)
{
  PetscFunctionBeginUser;
  if (redundant->parts) PetscCall(MatDestroySubMatrices(redundant->whole ? 1 : 0, &redundant->parts));
  redundant->whole = NULL;
  PetscCall(MatDestroy(&redundant->of));
  PetscCall(VecDestroy(&redundant->b));
  PetscCall(VecDestroy(&redundant->x));
  if (redundant->group != MPI_COMM_NULL) PetscCallMPI(MPI_Comm_free(&redundant->group));
  if (redundant->solvers != MPI_COMM_NULL) PetscCallMPI(MPI_Comm_free(&redundant->solvers));
  redundant->group = redundant->solvers = MPI_COMM_NULL;
  PetscCall(PetscFree4(redundant->counts, redundant->begins, redundant->blocks, redundant->firsts));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Groups of consecutive ranks, and the positions of their rows. Collective. */
static PetscErrorCode RedundantSolveSetGroups_Private(Mat A, RedundantSolve *redundant)
{
  const MPI_Comm comm = PetscObjectComm((PetscObject)A);
  PetscInt       n, num;
  PetscMPIInt    rank, size, mine, own, groups, sum = 0;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCall(MatGetSize(A, &num, NULL));
  PetscCall(MatGetLocalSize(A, &n, NULL));
  PetscCall(PetscMPIIntCast(n, &mine));
  own = num < GROUP_FACTOR ? 1 : GROUP_RANKS;
  PetscCallMPI(MPI_Comm_split(comm, rank / own, rank, &redundant->group));
  PetscCallMPI(MPI_Comm_split(comm, rank % own ? MPI_UNDEFINED : 0, rank, &redundant->solvers));
  PetscCallMPI(MPI_Comm_size(redundant->group, &size));
  groups = 0;
  if (redundant->solvers != MPI_COMM_NULL) PetscCallMPI(MPI_Comm_size(redundant->solvers, &groups));
  PetscCall(PetscMalloc4(size, &redundant->counts, size, &redundant->begins, groups, &redundant->blocks, groups,
                         &redundant->firsts));
  PetscCallMPI(MPI_Gather(&mine, 1, MPI_INT, redundant->counts, 1, MPI_INT, 0, redundant->group));
  if (redundant->solvers == MPI_COMM_NULL) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscMPIInt r = 0; r < size; r++) {
    redundant->begins[r] = sum;
    sum += redundant->counts[r];
  }
  PetscCallMPI(MPI_Allgather(&sum, 1, MPI_INT, redundant->blocks, 1, MPI_INT, redundant->solvers));
  for (PetscMPIInt g = 0; g < groups; g++)
    redundant->firsts[g] = g ? redundant->firsts[g - 1] + redundant->blocks[g - 1] : 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The whole matrix on ranks that solve. Collective. [in] reuse - whether only its numbers are new */
static PetscErrorCode RedundantSolveSetMatrix_Private(Mat A, MatReuse reuse, RedundantSolve *redundant)
{
  const PetscInt solves = redundant->solvers != MPI_COMM_NULL;
  PetscInt       num;
  IS             all;

  PetscFunctionBeginUser;
  PetscCall(MatGetSize(A, &num, NULL));
  PetscCall(ISCreateStride(PETSC_COMM_SELF, solves ? num : 0, 0, 1, &all));
  PetscCall(MatCreateSubMatrices(A, solves, &all, &all, reuse, &redundant->parts));
  PetscCall(ISDestroy(&all));
  if (!solves) PetscFunctionReturn(PETSC_SUCCESS);
  if (reuse == MAT_REUSE_MATRIX) { // PETSc 3.18 does not note that all rows have changed
    PetscCall(MatAssemblyBegin(redundant->whole, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(redundant->whole, MAT_FINAL_ASSEMBLY));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  redundant->whole = redundant->parts[0];
  PetscCall(MatSetOption(redundant->whole, MAT_SPD, PETSC_TRUE));
  PetscCall(MatCreateVecs(redundant->whole, &redundant->x, &redundant->b));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RedundantSolveGather(PC pc)
{
  RedundantSolve  *redundant;
  PetscObjectState nonzeros;
  const char      *name = NULL;
  PetscBool        same;
  Mat              A;

  PetscFunctionBeginUser;
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCSHELL, &same));
  if (same) PetscCall(PCShellGetName(pc, &name));
  if (same) PetscCall(PetscStrcmp(name, NAME, &same));
  if (!same) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PCShellGetContext(pc, &redundant));
  PetscCall(PCGetOperators(pc, NULL, &A));
  PetscCall(MatGetNonzeroState(A, &nonzeros));
  redundant->gathered = PETSC_TRUE;
  if (redundant->of == A && redundant->nonzeros == nonzeros) { // factors keep their symbolic part
    PetscCall(RedundantSolveSetMatrix_Private(A, MAT_REUSE_MATRIX, redundant));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(RedundantSolveRelease_Private(redundant));
  PetscCall(RedundantSolveSetGroups_Private(A, redundant));
  PetscCall(RedundantSolveSetMatrix_Private(A, MAT_INITIAL_MATRIX, redundant));
  PetscCall(PetscObjectReference((PetscObject)A));
  redundant->of       = A;
  redundant->nonzeros = nonzeros;
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode SetUp_RedundantSolve(PC pc)
{
  RedundantSolve *redundant;
  PCFailedReason  failed = PC_NOERROR;
  int             worst;

  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(pc, &redundant));
  if (!redundant->gathered) PetscCall(RedundantSolveGather(pc));
  redundant->gathered = PETSC_FALSE;
  if (redundant->whole) {
    PetscCall(PCSetOperators(redundant->pc, redundant->whole, redundant->whole));
    PetscCall(PCSetUp(redundant->pc));
    PetscCall(PCGetFailedReason(redundant->pc, &failed));
  }
  worst = (int)failed;
  PetscCallMPI(MPI_Bcast(&worst, 1, MPI_INT, 0, redundant->group));
  PetscCall(PCSetFailedReason(pc, (PCFailedReason)worst));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Apply_RedundantSolve(PC pc, Vec r, Vec z)
{
  RedundantSolve    *redundant;
  PetscMPIInt        n, sum = 0, group = 0;
  const PetscScalar *x = NULL, *rows;
  PetscScalar       *b = NULL, *own;
  PetscInt           size;

  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(pc, &redundant));
  PetscCall(VecGetLocalSize(r, &size));
  PetscCall(PetscMPIIntCast(size, &n));
  PetscCall(VecGetArrayRead(r, &rows));
  if (redundant->whole) {
    PetscCallMPI(MPI_Comm_rank(redundant->solvers, &group));
    PetscCall(VecGetArrayWrite(redundant->b, &b));
    sum = redundant->firsts[group];
  }
  PetscCallMPI(MPI_Gatherv(rows, n, MPIU_SCALAR, b ? b + sum : NULL, redundant->counts, redundant->begins, MPIU_SCALAR,
                           0, redundant->group));
  PetscCall(VecRestoreArrayRead(r, &rows));
  if (redundant->whole) {
    PetscCallMPI(MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, b, redundant->blocks, redundant->firsts,
                                MPIU_SCALAR, redundant->solvers));
    PetscCall(VecRestoreArrayWrite(redundant->b, &b));
    PetscCall(PCApply(redundant->pc, redundant->b, redundant->x));
    PetscCall(VecGetArrayRead(redundant->x, &x));
  }
  PetscCall(VecGetArrayWrite(z, &own));
  PetscCallMPI(MPI_Scatterv(x ? x + sum : NULL, redundant->counts, redundant->begins, MPIU_SCALAR, own, n, MPIU_SCALAR,
                            0, redundant->group));
  PetscCall(VecRestoreArrayWrite(z, &own));
  if (x) PetscCall(VecRestoreArrayRead(redundant->x, &x));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Destroy_RedundantSolve(PC pc)
{
  RedundantSolve *redundant;

  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(pc, &redundant));
  PetscCall(RedundantSolveRelease_Private(redundant));
  PetscCall(PCDestroy(&redundant->pc));
  PetscCall(PetscFree(redundant));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The factorization. */
static PetscErrorCode RedundantSolveSetFactor_Private(PC pc)
{
  PetscFunctionBeginUser;
  PetscCall(PCSetType(pc, PCCHOLESKY));
  PetscCall(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RedundantSolveSetPC(PC pc)
{
  RedundantSolve *redundant;
  PetscMPIInt     size;
  const char     *prefix;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(PetscObjectComm((PetscObject)pc), &size));
  if (size == 1) {
    PetscCall(RedundantSolveSetFactor_Private(pc));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PetscNew(&redundant));
  redundant->group = redundant->solvers = MPI_COMM_NULL;
  PetscCall(PCCreate(PETSC_COMM_SELF, &redundant->pc));
  PetscCall(PCGetOptionsPrefix(pc, &prefix));
  PetscCall(PCSetOptionsPrefix(redundant->pc, prefix));
  PetscCall(RedundantSolveSetFactor_Private(redundant->pc));
  PetscCall(PCSetType(pc, PCSHELL));
  PetscCall(PCShellSetName(pc, NAME));
  PetscCall(PCShellSetContext(pc, redundant));
  PetscCall(PCShellSetSetUp(pc, SetUp_RedundantSolve));
  PetscCall(PCShellSetApply(pc, Apply_RedundantSolve));
  PetscCall(PCShellSetDestroy(pc, Destroy_RedundantSolve));
  PetscFunctionReturn(PETSC_SUCCESS);
}

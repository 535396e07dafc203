/* smoother.c -- couplings that smoothing must not cut.

   Where cells are much longer than wide, an error may vary slowly along the short way and be no smooth function on the coarser level,
   which is as long and wide [1]: smoothing has to solve for the couplings along the short way, lines of nodes. Couplings of nodes are
   dim x dim blocks. The strong ones go into
       S_ij = -B_ij,   S_ii = sum_j B_ij + [A_ii - sum_j B_ij]+,   B_ij = [-(A_ij + A_ij')/2]+,
   [.]+ by eigenvalues, so that S is a sum of semidefinite parts; lines cross rarely, and S has factors as sparse as itself.

   These are couplings of displacements u. What is solved for is y, u = T y, in which moving a mortar side's unknown moves the nonmortar side
   as well: much stiffness in rows of the mortar side where the other one is stiff, and lines that go on across contact. T'S T has all of it, and
   its eigenvalues with T'K T are those of S with K.

   Couplings between ranks are left out.

   References: [1] Trottenberg, Oosterlee, Schueller, Multigrid, 2001, section 5.1. */
#include <mortise/compat.h>
#include <mortise/dense.h>
#include "apart.h"
#include "smoother.h"

enum { DIM_MAX = 3 };

/* A coupling is strong from here on, its trace by the geometric mean of those of both nodes: long cells tend to 1/2, squares have 1/8. */
static const PetscReal STRONG = 0.4;
/* What is left at least of a node's own stiffness, for definiteness. */
static const PetscReal LEAST = 1e-6;
/* A nonmortar side is stiff where condensing adds so much to the diagonal of what was there; equal sides: 1. */
static const PetscReal STIFFER = 2;

/* One node's couplings to nodes of this rank. */
typedef struct {
  VI         vi;
  PetscInt   dim, begin, n; /* nodes of this rank */
  PetscReal *trace;         /* of K's diagonal blocks [n] */
  PetscInt   num, max;
  PetscInt  *node;  /* neighbours, counted from this rank's first [num] */
  PetscReal *block; /* rows of the centre, columns of the neighbour [num][dim][dim] */
  PetscInt  *at;    /* position in node, or -1 [n] */
} Star;

/* The place of a neighbour's block, a new one if need be. */
static PetscErrorCode Place_Private(Star *star, PetscInt node, PetscInt *at)
{
  const PetscInt size = star->dim * star->dim;

  PetscFunctionBeginUser;
  if (star->at[node] < 0) {
    if (star->num == star->max) {
      star->max = 2 * star->max + 128;
      PetscCall(PetscRealloc(star->max * sizeof(PetscInt), &star->node));
      PetscCall(PetscRealloc(star->max * size * sizeof(PetscReal), &star->block));
    }
    PetscCall(PetscArrayzero(&star->block[star->num * size], size));
    star->at[node]          = star->num;
    star->node[star->num++] = node;
  }
  *at = star->at[node];
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Gather_Private(Star *star, PetscInt node)
{
  const PetscInt  dim    = star->dim;
  const PetscReal factor = 1 / star->vi->stiffness;
  PetscInt        at;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < star->num; i++) star->at[star->node[i]] = -1;
  star->num = 0;
  PetscCall(Place_Private(star, node, &at)); // the first
  for (PetscInt r = 0; r < dim; r++) {
    const PetscInt     row = dim * (star->begin + node) + r;
    PetscInt           num;
    const PetscInt    *columns;
    const PetscScalar *values;

    PetscCall(MatGetRow(star->vi->K, row, &num, &columns, &values));
    for (PetscInt c = 0; c < num; c++) {
      const PetscInt column = columns[c] - dim * star->begin;

      if (column < 0 || column >= dim * star->n) continue;
      PetscCall(Place_Private(star, column / dim, &at));
      star->block[(at * dim + r) * dim + column % dim] += factor * PetscRealPart(values[c]);
    }
    PetscCall(MatRestoreRow(star->vi->K, row, &num, &columns, &values));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* X := sum over eigenvectors of max(eigenvalue, least) v v' */
static void Clip_Private(PetscInt dim, PetscReal X[], PetscReal least)
{
  PetscReal values[DIM_MAX], V[DIM_MAX * DIM_MAX];

  DenseEigen(dim, X, values, V);
  for (PetscInt i = 0; i < dim; i++) values[i] = PetscMax(values[i], least);
  for (PetscInt r = 0; r < dim; r++)
    for (PetscInt c = 0; c < dim; c++) {
      X[r * dim + c] = 0;
      for (PetscInt i = 0; i < dim; i++) X[r * dim + c] += values[i] * V[r * dim + i] * V[c * dim + i];
    }
}

/* Sorts the couplings of the star at node.
   [out] strong - positions [num_strong]; [out] stretched - whether one is strong beside the stiffest neighbour too, as those along free
   surfaces, where diagonals are halves, are not */
static PetscErrorCode FindStrong_Private(const Star *star, PetscInt node, PetscInt strong[], PetscInt *num_strong,
                                         PetscBool *stretched)
{
  PetscReal most = 0;

  PetscFunctionBeginUser;
  *num_strong = 0;
  *stretched  = PETSC_FALSE;
  for (PetscInt n = 0; n < star->num; n++) most = PetscMax(most, star->trace[star->node[n]]);
  for (PetscInt n = 1; n < star->num; n++) {
    PetscReal trace = 0;

    for (PetscInt r = 0; r < star->dim; r++) trace += star->block[(n * star->dim + r) * star->dim + r];
    trace = -trace;
    if (trace <= STRONG * PetscSqrtReal(star->trace[node] * star->trace[star->node[n]])) continue;
    strong[(*num_strong)++] = n;
    if (trace > STRONG * most) *stretched = PETSC_TRUE;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode SetBlock_Private(const Star *star, PetscInt row, PetscInt column, const PetscReal block[], Mat S)
{
  PetscInt rows[DIM_MAX], columns[DIM_MAX];

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < star->dim; k++) {
    rows[k]    = star->dim * (star->begin + row) + k;
    columns[k] = star->dim * (star->begin + column) + k;
  }
  PetscCall(MatSetValues(S, star->dim, rows, star->dim, columns, block, INSERT_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The rows of S at a node without lines: the diagonal. */
static PetscErrorCode SetPoint_Private(const Star *star, PetscInt node, Mat S)
{
  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < star->dim; k++) {
    const PetscInt row = star->dim * (star->begin + node) + k;

    PetscCall(MatSetValue(S, row, row, star->block[k * star->dim + k], INSERT_VALUES));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The rows of S that lines of nodes make at one node. */
static PetscErrorCode SetLines_Private(const Star *star, PetscInt node, PetscInt num, const PetscInt strong[], Mat S)
{
  const PetscInt dim = star->dim, size                          = dim * dim;
  PetscReal      own[DIM_MAX * DIM_MAX], sum[DIM_MAX * DIM_MAX] = {0};

  PetscFunctionBeginUser;
  for (PetscInt n = 0; n < num; n++) {
    const PetscReal *block = &star->block[strong[n] * size];
    PetscReal        B[DIM_MAX * DIM_MAX];

    for (PetscInt r = 0; r < dim; r++)
      for (PetscInt c = 0; c < dim; c++) B[r * dim + c] = -(block[r * dim + c] + block[c * dim + r]) / 2;
    Clip_Private(dim, B, 0);
    for (PetscInt k = 0; k < size; k++) sum[k] += B[k];
    for (PetscInt k = 0; k < size; k++) B[k] = -B[k];
    PetscCall(SetBlock_Private(star, node, star->node[strong[n]], B, S));
  }
  for (PetscInt k = 0; k < size; k++) own[k] = star->block[k] - sum[k];
  Clip_Private(dim, own, LEAST * star->trace[node] / dim);
  for (PetscInt k = 0; k < size; k++) own[k] += sum[k];
  PetscCall(SetBlock_Private(star, node, node, own, S));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a nonmortar side of this rank weighs on a mortar side that is much softer. */
static PetscErrorCode Weighs_Private(VI vi, PetscBool *weighs)
{
  const PetscInt     n = vi->level->dim * vi->level->num_owned, begin = vi->level->dim * vi->level->node_begin;
  const PetscScalar *z, *k;
  PetscBool         *apart; /* unknowns that are not the mortar side's, or eliminated */
  Vec                diag[2];

  PetscFunctionBeginUser;
  *weighs = PETSC_FALSE;
  if (!vi->Z) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscCalloc1(n, &apart));
  for (PetscInt r = 0; r < vi->num_rows; r++) apart[vi->row_dof[r] - begin] = PETSC_TRUE;
  for (PetscInt i = 0; i < vi->num_fixed; i++) apart[vi->fixed_local[i]] = PETSC_TRUE;
  for (PetscInt i = 0; i < 2; i++) {
    PetscCall(MatCreateVecs(vi->K, &diag[i], NULL));
    PetscCall(MatGetDiagonal(i ? vi->K : vi->Z, diag[i]));
  }
  PetscCall(VecGetArrayRead(diag[0], &z));
  PetscCall(VecGetArrayRead(diag[1], &k));
  for (PetscInt i = 0; i < n; i++)
    if (!apart[i] && PetscRealPart(z[i]) > STIFFER * PetscRealPart(k[i]) / vi->stiffness) *weighs = PETSC_TRUE;
  PetscCall(VecRestoreArrayRead(diag[0], &z));
  PetscCall(VecRestoreArrayRead(diag[1], &k));
  PetscCall(VecDestroy(&diag[0]));
  PetscCall(VecDestroy(&diag[1]));
  PetscCall(PetscFree(apart));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* S, or how many entries its rows have, and whether it is needed at all. */
static PetscErrorCode Fill_Private(Star *star, Mat S, PetscInt count[], PetscBool *needed)
{
  PetscInt *strong = NULL, max = 0;

  PetscFunctionBeginUser;
  for (PetscInt node = 0; node < star->n; node++) {
    PetscInt  num;
    PetscBool stretched;

    PetscCall(Gather_Private(star, node));
    if (star->max > max) PetscCall(PetscRealloc((max = star->max) * sizeof(PetscInt), &strong));
    PetscCall(FindStrong_Private(star, node, strong, &num, &stretched));
    for (PetscInt r = 0; count && r < star->dim; r++) count[star->dim * node + r] = num ? star->dim * (1 + num) : 1;
    if (count && stretched) *needed = PETSC_TRUE;
    if (S && num) PetscCall(SetLines_Private(star, node, num, strong, S));
    if (S && !num) PetscCall(SetPoint_Private(star, node, S));
  }
  PetscCall(PetscFree(strong));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* S with what condensing adds to the diagonal. */
static PetscErrorCode AddDiagonal_Private(VI vi, Mat S)
{
  Vec more, zero;

  PetscFunctionBeginUser;
  PetscCall(MatCreateVecs(vi->K, &more, &zero));
  PetscCall(MatGetDiagonal(vi->Z, more));
  PetscCall(VecZeroEntries(zero));
  PetscCall(VecPointwiseMax(more, more, zero));
  PetscCall(MatDiagonalSet(S, more, ADD_VALUES));
  PetscCall(VecDestroy(&more));
  PetscCall(VecDestroy(&zero));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* T'S T without eliminated unknowns; not where it would be a dense matrix, since few nodes of one side face very many of the other.
   [in,out] S */
static PetscErrorCode Condense_Private(VI vi, Mat *S)
{
  Mat     product;
  MatInfo mine, whole;

  PetscFunctionBeginUser;
  if (vi->T) {
    PetscCall(MatPtAP(*S, vi->T, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &product));
    PetscCall(MatProductClear(product)); // it would keep its factors
    PetscCall(MatGetInfo(product, MAT_GLOBAL_SUM, &mine));
    PetscCall(MatGetInfo(vi->K, MAT_GLOBAL_SUM, &whole));
    if (mine.nz_used > whole.nz_used) {
      PetscCall(MatDestroy(&product));
      PetscCall(AddDiagonal_Private(vi, *S));
    } else {
      PetscCall(MatDestroy(S));
      *S = product;
    }
  }
  PetscCall(MatZeroRowsColumns(*S, vi->num_fixed, vi->fixed, 1, NULL, NULL));
  PetscCall(MatSetOption(*S, MAT_SPD, PETSC_TRUE));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SmootherCreate(VI vi, PetscBool finest, Mat *S)
{
  const PetscInt     dim = vi->level->dim, n = vi->level->num_owned, N = vi->level->num_global;
  Star               star = {.vi = vi, .dim = dim, .begin = vi->level->node_begin, .n = n};
  const PetscScalar *d;
  PetscInt          *count;
  PetscBool          weighs, needed;
  Vec                diag;

  PetscFunctionBeginUser;
  *S = NULL;
  PetscCall(Weighs_Private(vi, &weighs));
  needed = (PetscBool)(weighs && !finest);
  PetscCall(PetscCalloc3(n, &star.trace, n, &star.at, dim * n, &count));
  for (PetscInt i = 0; i < n; i++) star.at[i] = -1;
  PetscCall(MatCreateVecs(vi->K, &diag, NULL));
  PetscCall(MatGetDiagonal(vi->K, diag));
  PetscCall(VecGetArrayRead(diag, &d));
  for (PetscInt i = 0; i < dim * n; i++) star.trace[i / dim] += PetscRealPart(d[i]) / vi->stiffness;
  PetscCall(VecRestoreArrayRead(diag, &d));
  PetscCall(VecDestroy(&diag));
  PetscCall(Fill_Private(&star, NULL, count, &needed));
  PetscCall(MPIU_Allreduce(MPI_IN_PLACE, &needed, 1, MPIU_BOOL, MPI_LOR, vi->level->comm));
  PetscCall(MPIU_Allreduce(MPI_IN_PLACE, &weighs, 1, MPIU_BOOL, MPI_LOR, vi->level->comm));
  if (needed) {
    PetscCall(MatCreateAIJ(vi->level->comm, dim * n, dim * n, dim * N, dim * N, 0, count, 0, NULL, S));
    PetscCall(Fill_Private(&star, *S, NULL, &needed));
    PetscCall(MatAssemblyBegin(*S, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(*S, MAT_FINAL_ASSEMBLY));
    PetscCall(Condense_Private(vi, S));
  } else if (finest && vi->T && (weighs || vi->mesh->num_levels == 1)) {
    PetscCall(ApartCreate(vi, S));
  }
  PetscCall(PetscFree3(star.trace, star.at, count));
  PetscCall(PetscFree(star.node));
  PetscCall(PetscFree(star.block));
  PetscFunctionReturn(PETSC_SUCCESS);
}

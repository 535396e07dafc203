/* smoother.c -- couplings that smoothing must not cut.

   Where cells are much longer than wide, an error may vary slowly along the short way and be no smooth function on the coarser level,
   which is as long and wide [1]: smoothing has to solve for the couplings along the short way, lines of nodes. Couplings of nodes are
   dim x dim blocks. The strong ones go into
       S_ij = -B_ij,   S_ii = sum_j B_ij + [A_ii - sum_j B_ij]+,   B_ij = [-(A_ij + A_ij')/2]+,
   [.]+ by eigenvalues, so that S is a sum of semidefinite parts; lines cross rarely, and S has factors as sparse as itself.

   Where the nonmortar side is stiff, moving a mortar side's unknown moves it as well: much stiffness in rows of the soft side, and what
   the soft side does alone takes unknowns of both sides at once. There S has all couplings of these unknowns to each other: a strip
   along the contact, as small as that.

   Couplings between ranks are left out.

   References: [1] Trottenberg, Oosterlee, Schueller, Multigrid, 2001, section 5.1. */
#include <mortise/compat.h>
#include <mortise/dense.h>
#include "smoother.h"

enum { DIM_MAX = 3 };

/* A coupling is strong from here on, its trace by the geometric mean of those of both nodes: long cells tend to 1/2, squares have 1/8. */
static const PetscReal STRONG = 0.4;
/* What is left at least of a node's own stiffness, for definiteness. */
static const PetscReal LEAST = 1e-6;
/* A mortar side's row belongs to the strip if what condensing adds to its diagonal is so much of what was there; equal sides: 1. */
static const PetscReal STIFFER = 2;

/* One node's couplings to nodes of this rank. */
typedef struct {
  VI               vi;
  PetscInt         dim, begin, n; /* nodes of this rank */
  PetscReal       *trace;         /* of A's diagonal blocks without eliminated unknowns [n] */
  PetscBool       *fixed;         /* whether eliminated [dim * n] */
  const PetscBool *strip;         /* [dim * n] */
  PetscInt         num, max;
  PetscInt        *node;  /* neighbours, counted from this rank's first [num] */
  PetscReal       *block; /* rows of the centre, columns of the neighbour [num][dim][dim] */
  PetscInt        *at;    /* position in node, or -1 [n] */
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

/* Adds factor * X. */
static PetscErrorCode AddBlocks_Private(Star *star, Mat X, PetscReal factor, PetscInt node)
{
  const PetscInt dim = star->dim;

  PetscFunctionBeginUser;
  for (PetscInt r = 0; r < dim; r++) {
    const PetscInt     row = dim * (star->begin + node) + r;
    PetscInt           num, at;
    const PetscInt    *columns;
    const PetscScalar *values;

    if (star->fixed[dim * node + r]) continue;
    PetscCall(MatGetRow(X, row, &num, &columns, &values));
    for (PetscInt c = 0; c < num; c++) {
      const PetscInt column = columns[c] - dim * star->begin;
      if (column < 0 || column >= dim * star->n || star->fixed[column]) continue;
      PetscCall(Place_Private(star, column / dim, &at));
      star->block[(at * dim + r) * dim + column % dim] += factor * PetscRealPart(values[c]);
    }
    PetscCall(MatRestoreRow(X, row, &num, &columns, &values));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Gather_Private(Star *star, PetscInt node)
{
  PetscInt at;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < star->num; i++) star->at[star->node[i]] = -1;
  star->num = 0;
  PetscCall(Place_Private(star, node, &at)); // the first
  PetscCall(AddBlocks_Private(star, star->vi->K, 1 / star->vi->stiffness, node));
  if (star->vi->Z) PetscCall(AddBlocks_Private(star, star->vi->Z, 1, node));
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

/* Sets a block of S but for rows and columns of the strip and eliminated unknowns; for these, 1 on the diagonal. */
static PetscErrorCode SetBlock_Private(const Star *star, PetscInt row, PetscInt column, const PetscReal block[], Mat S)
{
  const PetscInt dim = star->dim, first = dim * star->begin;

  PetscFunctionBeginUser;
  for (PetscInt r = 0; r < dim; r++) {
    const PetscInt i = dim * row + r;

    for (PetscInt c = 0; c < dim; c++) {
      const PetscInt j = dim * column + c;

      if (!star->strip[i] && !star->strip[j] && !star->fixed[i] && !star->fixed[j])
        PetscCall(MatSetValue(S, first + i, first + j, block[r * dim + c], INSERT_VALUES));
      else if (i == j)
        PetscCall(MatSetValue(S, first + i, first + j, 1, INSERT_VALUES));
    }
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
  if (num) Clip_Private(dim, own, LEAST * star->trace[node] / dim);
  for (PetscInt k = 0; k < size; k++) own[k] += sum[k];
  PetscCall(SetBlock_Private(star, node, node, own, S));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The rows of S that the strip makes at one node, or how many entries they have. */
static PetscErrorCode SetStrip_Private(const Star *star, PetscInt node, Mat S, PetscInt count[])
{
  const PetscInt dim = star->dim, first = dim * star->begin;

  PetscFunctionBeginUser;
  for (PetscInt r = 0; r < dim; r++) {
    if (!star->strip[dim * node + r]) continue;
    for (PetscInt n = 0; n < star->num; n++) {
      for (PetscInt c = 0; c < dim; c++) {
        const PetscInt column = dim * star->node[n] + c;

        if (!star->strip[column]) continue;
        if (count) count[r]++;
        if (S)
          PetscCall(MatSetValue(S, first + dim * node + r, first + column, star->block[(n * dim + r) * dim + c],
                                INSERT_VALUES));
      }
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The unknowns of mortar sides that stiff nonmortar sides weigh on, and of multipliers that go with them. */
static PetscErrorCode FindStrip_Private(VI vi, const PetscBool fixed[], PetscBool strip[])
{
  const PetscInt     dim = vi->level->dim, n = dim * vi->level->num_owned, begin = dim * vi->level->node_begin;
  const PetscScalar *z, *k;
  PetscBool         *contact;
  Vec                diag[2];

  PetscFunctionBeginUser;
  if (!vi->Z) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscCalloc1(n, &contact));
  for (PetscInt r = 0; r < vi->num_rows; r++) contact[vi->row_dof[r] - begin] = PETSC_TRUE;
  for (PetscInt i = 0; i < n; i++) contact[i] = (PetscBool)(contact[i] && !fixed[i]);
  for (PetscInt i = 0; i < 2; i++) {
    PetscCall(MatCreateVecs(vi->K, &diag[i], NULL));
    PetscCall(MatGetDiagonal(i ? vi->K : vi->Z, diag[i]));
  }
  PetscCall(VecGetArrayRead(diag[0], &z));
  PetscCall(VecGetArrayRead(diag[1], &k));
  for (PetscInt i = 0; i < n; i++) {
    PetscInt           num;
    const PetscInt    *columns;
    const PetscScalar *values;

    if (fixed[i] || contact[i] || PetscRealPart(z[i]) <= STIFFER * PetscRealPart(k[i]) / vi->stiffness) continue;
    strip[i] = PETSC_TRUE;
    PetscCall(MatGetRow(vi->Z, begin + i, &num, &columns, &values));
    for (PetscInt c = 0; c < num; c++)
      if (columns[c] >= begin && columns[c] < begin + n && contact[columns[c] - begin])
        strip[columns[c] - begin] = PETSC_TRUE;
    PetscCall(MatRestoreRow(vi->Z, begin + i, &num, &columns, &values));
  }
  PetscCall(VecRestoreArrayRead(diag[0], &z));
  PetscCall(VecRestoreArrayRead(diag[1], &k));
  PetscCall(VecDestroy(&diag[0]));
  PetscCall(VecDestroy(&diag[1]));
  PetscCall(PetscFree(contact));
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
    if (count) {
      for (PetscInt r = 0; r < star->dim; r++) {
        count[star->dim * node + r] = star->dim * (1 + num);
        if (star->strip[star->dim * node + r]) stretched = PETSC_TRUE;
      }
      if (stretched) *needed = PETSC_TRUE;
    }
    if (S) PetscCall(SetLines_Private(star, node, num, strong, S));
    PetscCall(SetStrip_Private(star, node, S, count ? &count[star->dim * node] : NULL));
  }
  PetscCall(PetscFree(strong));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SmootherCreate(VI vi, Vec diag, Smoother *smoother)
{
  const PetscInt     dim = vi->level->dim, n = vi->level->num_owned, N = vi->level->num_global;
  Star               star = {.vi = vi, .dim = dim, .begin = vi->level->node_begin, .n = n};
  const PetscScalar *d;
  PetscInt          *count;
  PetscBool          needed = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(dim * n, &smoother->strip));
  PetscCall(PetscCalloc4(n, &star.trace, dim * n, &star.fixed, n, &star.at, dim * n, &count));
  for (PetscInt i = 0; i < vi->num_fixed; i++) star.fixed[vi->fixed_local[i]] = PETSC_TRUE;
  for (PetscInt i = 0; i < n; i++) star.at[i] = -1;
  PetscCall(VecGetArrayRead(diag, &d));
  for (PetscInt i = 0; i < dim * n; i++) star.trace[i / dim] += star.fixed[i] ? 0 : PetscRealPart(d[i]);
  PetscCall(VecRestoreArrayRead(diag, &d));
  PetscCall(FindStrip_Private(vi, star.fixed, smoother->strip));
  star.strip = smoother->strip;
  PetscCall(Fill_Private(&star, NULL, count, &needed));
  PetscCall(MPIU_Allreduce(MPI_IN_PLACE, &needed, 1, MPIU_BOOL, MPI_LOR, vi->level->comm));
  if (needed) {
    PetscCall(MatCreateAIJ(vi->level->comm, dim * n, dim * n, dim * N, dim * N, 0, count, 0, NULL, &smoother->S));
    PetscCall(MatSetOption(smoother->S, MAT_SPD, PETSC_TRUE));
    PetscCall(Fill_Private(&star, smoother->S, NULL, &needed));
    PetscCall(MatAssemblyBegin(smoother->S, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(smoother->S, MAT_FINAL_ASSEMBLY));
  } else {
    PetscCall(PetscFree(smoother->strip));
  }
  PetscCall(PetscFree4(star.trace, star.fixed, star.at, count));
  PetscCall(PetscFree(star.node));
  PetscCall(PetscFree(star.block));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* blocksmoother.c -- lines and planes of nodes that are coupled more strongly among themselves than with
   other nodes.

   For cells of sizes h and H along two axes the couplings scale with 1/h^2 and 1/H^2. Relative to the
   strongest coupling of a node, those to other lines or planes are a half for H = 1.5 h and a third for H =
   2.5 h (bilinear cells, 2D and 3D). Whether chosen couplings lead along all axes follows from

       F = sum_chosen d d' - FLAT_EXTENT sum_all d d',   d = x_j - x_i:

   they do if F is positive definite (eq. 13.4). The coupling of two nodes is the trace of their block of K,
   divided by the roots of the traces of both diagonal blocks. These halve along free surfaces. A coupling
   counts if it is strong at both ends. The nodes it connects form a block if few of them have neighbours of
   the block along all axes. Otherwise its factors would not be sparse, and it is split by a higher
   threshold. */
#include "base/compat.h"
#include "base/csrmatrix.h"
#include "base/gather.h"
#include "kernel/dense.h"
#include "multigrid/blocksmoother.h"
#include "multigrid/graphcomponents.h"

enum { DIM_MAX = 3 };

/* Threshold of strong couplings relative to the strongest of the node, its increment where blocks are no
   lines or planes, and its end. */
static const PetscReal STRONG_FROM = 0.5, STRONG_STEP = 0.1, STRONG_END = 0.85;
/* Threshold at which couplings show that cells are long. */
static const PetscReal LONG_FROM = 1. / 3;
/* Limit of the chosen couplings' extent along an axis, in squares, relative to all couplings. */
static const PetscReal FLAT_EXTENT = 0.05;
/* Least part of all nodes with long cells; largest part of a block's nodes with neighbours of the block along
   all axes. */
static const PetscReal MIN_LONG_PART = 0.01, MAX_THICK_PART = 0.2;

/* The couplings of all nodes, and of one of them. */
typedef struct {
  const Operator      *op;
  PetscInt             dim;
  const GhostExchange *ghosts;
  PetscReal           *x;             /* positions [n + num][dim] */
  PetscReal           *scale;         /* 1 / root of the diagonal [n + num] */
  PetscReal           *cut;           /* threshold [n + num] */
  PetscInt            *start;         /* [n + 1] */
  PetscInt            *all_nodes;     /* [start[n]] */
  PetscReal           *all_strengths; /* [start[n]] */
  PetscReal           *limit;         /* FLAT_EXTENT sum_all d d' [n][dim][dim] */
  PetscInt             num;
  const PetscInt      *node;     /* neighbours and the node itself [num] */
  const PetscReal     *strength; /* negative for the node itself [num] */
  PetscBool           *chosen;   /* chosen ones [num] */
} Stencil;

static PetscErrorCode BlockSmootherScale_Private(Stencil *stencil, GhostExchange *ghosts)
{
  const PetscScalar *d;

  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(stencil->op->diagonal, &d));
  for (PetscInt i = 0; i < ghosts->n; i++) {
    PetscReal trace = 0;

    for (PetscInt k = 0; k < stencil->dim; k++) trace += PetscRealPart(d[i * stencil->dim + k]);
    stencil->scale[i] = 1 / PetscSqrtReal(trace);
  }
  PetscCall(VecRestoreArrayRead(stencil->op->diagonal, &d));
  PetscCall(GhostExchangeUpdate(ghosts, stencil->scale));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Strengths of the couplings of all nodes. K has full blocks: all rows of a node have the same columns. */
static PetscErrorCode BlockSmootherGather_Private(Stencil *stencil)
{
  const PetscInt dim = stencil->dim, begin = dim * stencil->ghosts->begin, n = stencil->ghosts->n;
  PetscInt       num, longest = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(n + 1, &stencil->start));
  stencil->start[0] = 0;
  for (PetscInt i = 0; i < n; i++) {
    PetscCall(MatGetRow(stencil->op->K, begin + dim * i, &num, NULL, NULL));
    stencil->start[i + 1] = stencil->start[i] + num / dim;
    longest               = PetscMax(longest, num / dim);
    PetscCall(MatRestoreRow(stencil->op->K, begin + dim * i, &num, NULL, NULL));
  }
  PetscCall(PetscMalloc1(stencil->start[n], &stencil->all_nodes));
  PetscCall(PetscCalloc1(stencil->start[n], &stencil->all_strengths));
  PetscCall(PetscMalloc1(longest, &stencil->chosen));
  for (PetscInt i = 0; i < n; i++) {
    PetscInt  *node     = &stencil->all_nodes[stencil->start[i]];
    PetscReal *strength = &stencil->all_strengths[stencil->start[i]];

    for (PetscInt r = 0; r < dim; r++) {
      const PetscInt    *columns;
      const PetscScalar *values;

      PetscCall(MatGetRow(stencil->op->K, begin + dim * i + r, &num, &columns, &values));
      for (PetscInt j = 0; j < num / dim; j++) {
        if (!r) PetscCall(GhostExchangeFind(stencil->ghosts, columns[j * dim] / dim, &node[j]));
        strength[j] -= PetscRealPart(values[j * dim + r]) * stencil->scale[i] * stencil->scale[node[j]];
      }
      PetscCall(MatRestoreRow(stencil->op->K, begin + dim * i + r, &num, &columns, &values));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The couplings of one node. */
static void BlockSmootherSelect_Private(Stencil *stencil, PetscInt node)
{
  stencil->num      = stencil->start[node + 1] - stencil->start[node];
  stencil->node     = &stencil->all_nodes[stencil->start[node]];
  stencil->strength = &stencil->all_strengths[stencil->start[node]];
}

/* F += weight d d' for two nodes. */
static void BlockSmootherAddDirection_Private(const Stencil *stencil, PetscInt node, PetscInt other, PetscReal weight,
                                              PetscReal F[])
{
  const PetscInt dim = stencil->dim;
  PetscReal      d[DIM_MAX];

  for (PetscInt k = 0; k < dim; k++) d[k] = stencil->x[other * dim + k] - stencil->x[node * dim + k];
  for (PetscInt r = 0; r < dim; r++)
    for (PetscInt c = 0; c < dim; c++) F[r * dim + c] += weight * d[r] * d[c];
}

static PetscErrorCode BlockSmootherSetLimits_Private(Stencil *stencil)
{
  const PetscInt n = stencil->ghosts->n, square = stencil->dim * stencil->dim;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(n * square, &stencil->limit));
  for (PetscInt i = 0; i < n; i++)
    for (PetscInt j = stencil->start[i]; j < stencil->start[i + 1]; j++)
      BlockSmootherAddDirection_Private(stencil, i, stencil->all_nodes[j], FLAT_EXTENT, &stencil->limit[i * square]);
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode BlockSmootherBeginStencil_Private(const Operator *op, GhostExchange *ghosts, Stencil *stencil)
{
  const PetscInt dim = op->dim, num = ghosts->n + ghosts->num;
  PetscReal     *along;

  PetscFunctionBeginUser;
  *stencil = (Stencil){.op = op, .dim = dim, .ghosts = ghosts};
  PetscCall(PetscMalloc1(num, &along));
  PetscCall(PetscMalloc1(num * dim, &stencil->x));
  PetscCall(PetscMalloc2(num, &stencil->scale, num, &stencil->cut));
  for (PetscInt k = 0; k < dim; k++) {
    for (PetscInt i = 0; i < ghosts->n; i++) along[i] = op->coords[i * dim + k];
    PetscCall(GhostExchangeUpdate(ghosts, along));
    for (PetscInt i = 0; i < num; i++) stencil->x[i * dim + k] = along[i];
  }
  PetscCall(PetscFree(along));
  PetscCall(BlockSmootherScale_Private(stencil, ghosts));
  PetscCall(BlockSmootherGather_Private(stencil));
  PetscCall(BlockSmootherSetLimits_Private(stencil));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode BlockSmootherEndStencil_Private(Stencil *stencil)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(stencil->x));
  PetscCall(PetscFree2(stencil->scale, stencil->cut));
  PetscCall(PetscFree(stencil->start));
  PetscCall(PetscFree(stencil->all_nodes));
  PetscCall(PetscFree(stencil->all_strengths));
  PetscCall(PetscFree(stencil->limit));
  PetscCall(PetscFree(stencil->chosen));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the chosen couplings lead along fewer axes than all. */
static PetscBool BlockSmootherIsFlat_Private(const Stencil *stencil, PetscInt node)
{
  const PetscInt   dim   = stencil->dim;
  const PetscReal *limit = &stencil->limit[node * dim * dim];
  PetscReal        F[DIM_MAX * DIM_MAX];

  for (PetscInt k = 0; k < dim * dim; k++) F[k] = -limit[k];
  for (PetscInt j = 0; j < stencil->num; j++)
    if (stencil->chosen[j]) BlockSmootherAddDirection_Private(stencil, node, stencil->node[j], 1, F);
  return (PetscBool)!DenseCholesky(dim, F);
}

/* The same for couplings above a threshold. */
static PetscBool BlockSmootherIsFlatFrom_Private(Stencil *stencil, PetscInt node, PetscReal strong)
{
  for (PetscInt j = 0; j < stencil->num; j++) stencil->chosen[j] = (PetscBool)(stencil->strength[j] > strong);
  return BlockSmootherIsFlat_Private(stencil, node);
}

/* Thresholds at nodes that are open, relative to their strongest coupling; none at others. [out] part -
   of all nodes, with long cells */
static PetscErrorCode BlockSmootherSetThresholds_Private(Stencil *stencil, GhostExchange *ghosts,
                                                         const PetscBool open[], PetscReal strong, PetscReal *part)
{
  PetscReal count[2] = {0, ghosts->n};

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < ghosts->n; i++) {
    PetscReal strongest = 0;

    stencil->cut[i] = PETSC_MAX_REAL;
    if (!open[i]) continue;
    BlockSmootherSelect_Private(stencil, i);
    for (PetscInt j = 0; j < stencil->num; j++) strongest = PetscMax(strongest, stencil->strength[j]);
    if (!BlockSmootherIsFlatFrom_Private(stencil, i, strong * strongest)) continue;
    stencil->cut[i] = strong * strongest;
    if (BlockSmootherIsFlatFrom_Private(stencil, i, LONG_FROM * strongest)) count[0]++;
  }
  PetscCall(GhostExchangeUpdate(ghosts, stencil->cut));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, count, 2, MPIU_REAL, MPI_SUM, PetscObjectComm((PetscObject)stencil->op->K)));
  *part = count[0] / count[1];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The graph of strong couplings. */
static PetscErrorCode BlockSmootherCreateGraph_Private(Stencil *stencil, Mat *graph)
{
  const GhostExchange *ghosts = stencil->ghosts;
  PetscInt            *start, *column;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(ghosts->n + 1, &start));
  PetscCall(PetscMalloc1(stencil->start[ghosts->n], &column));
  start[0] = 0;
  for (PetscInt i = 0; i < ghosts->n; i++) {
    BlockSmootherSelect_Private(stencil, i);
    start[i + 1] = start[i];
    for (PetscInt j = 0; j < stencil->num; j++) {
      const PetscInt at = stencil->node[j];

      if (stencil->strength[j] > PetscMax(stencil->cut[i], stencil->cut[at]))
        column[start[i + 1]++] = at < ghosts->n ? ghosts->begin + at : ghosts->ghost[at - ghosts->n];
    }
  }
  PetscCall(CSRMatrixCreate(PetscObjectComm((PetscObject)stencil->op->K),
                            &(CSRRows){1, ghosts->n, ghosts->n, start, column, NULL}, graph));
  PetscCall(PetscFree(start));
  PetscCall(PetscFree(column));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Number of nodes of each label with neighbours of it along all axes, less MAX_THICK_PART times all. It is on
   the rank of the node whose number is the label. [in] label - own nodes, then ghosts */
static PetscErrorCode BlockSmootherSumThick_Private(Stencil *stencil, const PetscReal label[], Vec sum)
{
  PetscFunctionBeginUser;
  PetscCall(VecZeroEntries(sum));
  for (PetscInt i = 0; i < stencil->ghosts->n; i++) {
    BlockSmootherSelect_Private(stencil, i);
    for (PetscInt j = 0; j < stencil->num; j++) stencil->chosen[j] = (PetscBool)(label[stencil->node[j]] == label[i]);
    PetscCall(VecSetValue(sum, (PetscInt)label[i], (BlockSmootherIsFlat_Private(stencil, i) ? 0 : 1) - MAX_THICK_PART,
                          ADD_VALUES));
  }
  PetscCall(VecAssemblyBegin(sum));
  PetscCall(VecAssemblyEnd(sum));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Accepts blocks that are lines or planes: labels their nodes and closes them. [in] part - components of the
   graph, own nodes, then ghosts; [in,out] label, open - [n]; [out] any - whether open nodes remain */
static PetscErrorCode BlockSmootherAcceptBlocks_Private(Stencil *stencil, GhostExchange *ghosts, const PetscReal part[],
                                                        PetscReal label[], PetscBool open[], PetscBool *any)
{
  PetscInt          *which;
  const PetscScalar *surplus;
  Vec                sum, mine;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(ghosts->own, &sum));
  PetscCall(BlockSmootherSumThick_Private(stencil, part, sum));
  PetscCall(PetscMalloc1(ghosts->n, &which));
  for (PetscInt i = 0; i < ghosts->n; i++) which[i] = (PetscInt)part[i];
  PetscCall(GatherEntries(sum, ghosts->n, which, &mine));
  PetscCall(PetscFree(which));
  PetscCall(VecGetArrayRead(mine, &surplus));
  *any = PETSC_FALSE;
  for (PetscInt i = 0; i < ghosts->n; i++) {
    if (!open[i]) continue;
    if (PetscRealPart(surplus[i]) <= 0) {
      label[i] = part[i];
      open[i]  = PETSC_FALSE;
    } else {
      *any = PETSC_TRUE;
    }
  }
  PetscCall(VecRestoreArrayRead(mine, &surplus));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, any, 1, MPIU_BOOL, MPI_LOR, PetscObjectComm((PetscObject)stencil->op->K)));
  PetscCall(VecDestroy(&mine));
  PetscCall(VecDestroy(&sum));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BlockSmootherLabel(const Operator *op, GhostExchange *ghosts, PetscBool wanted, PetscReal label[],
                                  PetscBool *found, PetscBool *round)
{
  Stencil    stencil;
  Mat        graph;
  PetscReal *part, part_long;
  PetscBool *open, any = PETSC_TRUE;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(ghosts->n, &open, ghosts->n + ghosts->num, &part));
  for (PetscInt i = 0; i < ghosts->n; i++) open[i] = PETSC_TRUE;
  for (PetscInt i = 0; i < ghosts->n; i++) label[i] = (PetscReal)(ghosts->begin + i);
  PetscCall(BlockSmootherBeginStencil_Private(op, ghosts, &stencil));
  PetscCall(BlockSmootherSetThresholds_Private(&stencil, ghosts, open, STRONG_FROM, &part_long));
  *found = (PetscBool)(part_long > MIN_LONG_PART || wanted);
  *round = (PetscBool)(part_long == 0);
  for (PetscReal strong = STRONG_FROM; *found && any && strong < STRONG_END; strong += STRONG_STEP) {
    if (strong > STRONG_FROM) PetscCall(BlockSmootherSetThresholds_Private(&stencil, ghosts, open, strong, &part_long));
    PetscCall(BlockSmootherCreateGraph_Private(&stencil, &graph));
    PetscCall(GraphComponentsLabel(graph, part));
    PetscCall(MatDestroy(&graph));
    PetscCall(GhostExchangeUpdate(ghosts, part));
    PetscCall(BlockSmootherAcceptBlocks_Private(&stencil, ghosts, part, label, open, &any));
  }
  PetscCall(GhostExchangeUpdate(ghosts, label));
  PetscCall(BlockSmootherEndStencil_Private(&stencil));
  PetscCall(PetscFree2(open, part));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* aggregate.c -- smoothed aggregation [1].

   Nodes that hang together strongly are taken together, some ten to thirty of them; what a coarser level can do to such an aggregate is to
   move it as a whole, by the motions that the matrix does not resist: orthonormal on each aggregate by Gram and Schmidt, with what is left
   of the motions in these terms as the motions of the coarser level. Where aggregates meet this tears; one step of Jacobi's iteration,
       P = ( 1 - omega D^-1 A ) P_0,   omega = 4 / (3 largest eigenvalue),
   mends most of that. Aggregates do not cross ranks.

   References: [1] Vanek, Mandel, Brezina, Algebraic multigrid by smoothed aggregation for second and fourth order elliptic problems,
               Computing 56, 1996. */
#include "aggregate.h"

/* What is left of a motion on an aggregate, by its length before, if it is not one of those before it. */
static const PetscReal DEPENDENT = 1e-7;
static const PetscReal DAMPING   = 4.0 / 3;

/* Strong couplings between nodes of this rank. */
typedef struct {
  PetscInt   num;
  PetscInt  *start, *node; /* [num+1], [start[num]] */
  PetscReal *weight;       /* [start[num]] */
} Graph;

PetscErrorCode FabricDestroy(Fabric *fabric)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(fabric->motion));
  PetscCall(PetscFree(fabric->held));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Squares of the couplings of one node. [in,out] at - -1 everywhere before and after; [out] node, square - [*num], the node itself first */
static PetscErrorCode Gather_Private(const Fabric *fabric, PetscInt i, PetscInt at[], PetscInt *num, PetscInt node[],
                                     PetscReal square[])
{
  const PetscInt bs = fabric->bs;
  PetscInt       begin, end;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(fabric->A, &begin, &end));
  node[0]   = i;
  square[0] = 0;
  at[i]     = 0;
  *num      = 1;
  for (PetscInt r = 0; r < bs; r++) {
    PetscInt           n;
    const PetscInt    *columns;
    const PetscScalar *values;

    if (fabric->held[bs * i + r]) continue;
    PetscCall(MatGetRow(fabric->A, begin + bs * i + r, &n, &columns, &values));
    for (PetscInt c = 0; c < n; c++) {
      const PetscInt column = columns[c] - begin, j = column / bs;

      if (column < 0 || columns[c] >= end || fabric->held[column]) continue;
      if (at[j] < 0) {
        at[j]         = (*num)++;
        node[at[j]]   = j;
        square[at[j]] = 0;
      }
      square[at[j]] += PetscRealPart(values[c] * values[c]);
    }
    PetscCall(MatRestoreRow(fabric->A, begin + bs * i + r, &n, &columns, &values));
  }
  for (PetscInt k = 0; k < *num; k++) at[node[k]] = -1;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The most couplings that a row has. */
static PetscErrorCode LongestRow_Private(Mat A, PetscInt *longest)
{
  PetscInt begin, end;

  PetscFunctionBeginUser;
  *longest = 0;
  PetscCall(MatGetOwnershipRange(A, &begin, &end));
  for (PetscInt row = begin; row < end; row++) {
    PetscInt n;

    PetscCall(MatGetRow(A, row, &n, NULL, NULL));
    *longest = PetscMax(*longest, n);
    PetscCall(MatRestoreRow(A, row, &n, NULL, NULL));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode GraphCreate_Private(const Fabric *fabric, Graph *graph)
{
  PetscInt   n, longest, most, *at, *node, max;
  PetscReal *square, *own;

  PetscFunctionBeginUser;
  PetscCall(MatGetLocalSize(fabric->A, &n, NULL));
  graph->num = n / fabric->bs;
  PetscCall(LongestRow_Private(fabric->A, &longest));
  most = fabric->bs * longest + 1;
  max  = graph->num * (longest / fabric->bs + 1);
  PetscCall(PetscMalloc4(graph->num, &at, most, &node, most, &square, graph->num, &own));
  for (PetscInt i = 0; i < graph->num; i++) at[i] = -1;
  for (PetscInt i = 0; i < graph->num; i++) {
    PetscInt num;

    PetscCall(Gather_Private(fabric, i, at, &num, node, square));
    own[i] = PetscSqrtReal(square[0]);
  }
  PetscCall(PetscMalloc1(graph->num + 1, &graph->start));
  PetscCall(PetscMalloc1(max, &graph->node));
  PetscCall(PetscMalloc1(max, &graph->weight));
  graph->start[0] = 0;
  for (PetscInt i = 0; i < graph->num; i++) {
    PetscInt num, end = graph->start[i];

    PetscCall(Gather_Private(fabric, i, at, &num, node, square));
    if (end + num > max) {
      max = 2 * max + num;
      PetscCall(PetscRealloc(max * sizeof(PetscInt), &graph->node));
      PetscCall(PetscRealloc(max * sizeof(PetscReal), &graph->weight));
    }
    for (PetscInt k = 1; k < num; k++) {
      const PetscReal weight = PetscSqrtReal(square[k]) / PetscSqrtReal(own[i] * own[node[k]]);

      if (!(weight > fabric->stronger)) continue;
      graph->node[end]     = node[k];
      graph->weight[end++] = weight;
    }
    graph->start[i + 1] = end;
  }
  PetscCall(PetscFree4(at, node, square, own));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode GraphDestroy_Private(Graph *graph)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(graph->start));
  PetscCall(PetscFree(graph->node));
  PetscCall(PetscFree(graph->weight));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A node and all its neighbours, where none of them belongs to an aggregate yet. [in,out] of - aggregate of each node, -1 for none [num] */
static void Seed_Private(const Graph *graph, PetscInt of[], PetscInt *num)
{
  for (PetscInt i = 0; i < graph->num; i++) {
    PetscBool whole = (PetscBool)(of[i] < 0 && graph->start[i + 1] > graph->start[i]);

    for (PetscInt k = graph->start[i]; whole && k < graph->start[i + 1]; k++)
      if (of[graph->node[k]] >= 0) whole = PETSC_FALSE;
    if (!whole) continue;
    of[i] = *num;
    for (PetscInt k = graph->start[i]; k < graph->start[i + 1]; k++) of[graph->node[k]] = *num;
    (*num)++;
  }
}

/* What is left joins the aggregate that it hangs on most, of those that there were. [in] seeds - what there is now [num] */
static void Join_Private(const Graph *graph, const PetscInt seeds[], PetscInt of[])
{
  for (PetscInt i = 0; i < graph->num; i++) {
    PetscReal most = 0;

    if (seeds[i] >= 0) continue;
    for (PetscInt k = graph->start[i]; k < graph->start[i + 1]; k++) {
      if (seeds[graph->node[k]] < 0 || graph->weight[k] <= most) continue;
      most  = graph->weight[k];
      of[i] = seeds[graph->node[k]];
    }
  }
}

/* Aggregates: nodes far enough from each other with what is around them, then what lies between. [out] of - [graph->num], -1 for nodes
   that are held altogether */
static PetscErrorCode Aggregate_Private(const Fabric *fabric, const Graph *graph, PetscInt of[], PetscInt *num)
{
  const PetscInt bs = fabric->bs;
  PetscInt      *seeds;

  PetscFunctionBeginUser;
  *num = 0;
  for (PetscInt i = 0; i < graph->num; i++) of[i] = -1;
  Seed_Private(graph, of, num);
  PetscCall(PetscMalloc1(graph->num, &seeds));
  PetscCall(PetscArraycpy(seeds, of, graph->num));
  Join_Private(graph, seeds, of);
  PetscCall(PetscFree(seeds));
  for (PetscInt i = 0; i < graph->num; i++) { // with no neighbour in one: by themselves
    PetscBool held = PETSC_TRUE;

    for (PetscInt r = 0; r < bs; r++) held = (PetscBool)(held && fabric->held[bs * i + r]);
    if (of[i] >= 0 || held) continue;
    of[i] = *num;
    for (PetscInt k = graph->start[i]; k < graph->start[i + 1]; k++)
      if (of[graph->node[k]] < 0) of[graph->node[k]] = *num;
    (*num)++;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Orthonormalises the columns of Q. [in,out] Q - [rows][num]; [out] R - Q before is Q after times R [num][num]; a column that depends on those
   before it is 0, and its row of R */
static void Orthonormalize_Private(PetscInt rows, PetscInt num, PetscReal Q[], PetscReal R[])
{
  for (PetscInt k = 0; k < num * num; k++) R[k] = 0;
  for (PetscInt k = 0; k < num; k++) {
    PetscReal before = 0, after = 0;

    for (PetscInt i = 0; i < rows; i++) before += PetscSqr(Q[i * num + k]);
    for (PetscInt pass = 0; pass < 2; pass++) {
      for (PetscInt j = 0; j < k; j++) {
        PetscReal dot = 0;

        for (PetscInt i = 0; i < rows; i++) dot += Q[i * num + j] * Q[i * num + k];
        for (PetscInt i = 0; i < rows; i++) Q[i * num + k] -= dot * Q[i * num + j];
        R[j * num + k] += dot;
      }
    }
    for (PetscInt i = 0; i < rows; i++) after += PetscSqr(Q[i * num + k]);
    after = PetscSqrtReal(after);
    if (after <= DEPENDENT * PetscSqrtReal(before)) after = 0;
    R[k * num + k] = after;
    for (PetscInt i = 0; i < rows; i++) Q[i * num + k] = after > 0 ? Q[i * num + k] / after : 0;
  }
}

/* The nodes of each aggregate. [out] start - [num+1]; [out] list - [start[num]] */
static PetscErrorCode List_Private(PetscInt nodes, const PetscInt of[], PetscInt num, PetscInt **start, PetscInt **list)
{
  PetscInt *next;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(num + 1, start));
  for (PetscInt i = 0; i < nodes; i++)
    if (of[i] >= 0) (*start)[of[i] + 1]++;
  for (PetscInt a = 0; a < num; a++) (*start)[a + 1] += (*start)[a];
  PetscCall(PetscMalloc1((*start)[num], list));
  PetscCall(PetscMalloc1(num, &next));
  PetscCall(PetscArraycpy(next, *start, num));
  for (PetscInt i = 0; i < nodes; i++)
    if (of[i] >= 0) (*list)[next[of[i]]++] = i;
  PetscCall(PetscFree(next));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* P_0, and the motions of aggregates. [in] of - aggregate of each node, -1 for none; [out] coarse - motions, and as held unknowns that do
   nothing */
static PetscErrorCode CreateTentative_Private(const Fabric *fabric, PetscInt nodes, const PetscInt of[], PetscInt num,
                                              Mat *P, Fabric *coarse)
{
  const PetscInt bs = fabric->bs, modes = fabric->num;
  PetscInt      *start, *list, begin, row, columns[16];
  PetscReal     *Q;

  PetscFunctionBeginUser;
  PetscCheck(modes <= (PetscInt)PETSC_STATIC_ARRAY_LENGTH(columns), PETSC_COMM_SELF, PETSC_ERR_SUP,
             "More motions than a body has");
  PetscCall(List_Private(nodes, of, num, &start, &list));
  PetscCall(MatCreate(PetscObjectComm((PetscObject)fabric->A), P));
  PetscCall(MatSetSizes(*P, bs * nodes, modes * num, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetType(*P, MATAIJ));
  PetscCall(MatSeqAIJSetPreallocation(*P, modes, NULL)); // one of the two does nothing
  PetscCall(MatMPIAIJSetPreallocation(*P, modes, NULL, 0, NULL));
  PetscCall(MatGetOwnershipRange(*P, &row, NULL));
  PetscCall(MatGetOwnershipRangeColumn(*P, &begin, NULL));
  PetscCall(PetscCalloc1(modes * num * modes, &coarse->motion));
  PetscCall(PetscCalloc1(modes * num, &coarse->held));
  for (PetscInt a = 0; a < num; a++) {
    const PetscInt size = start[a + 1] - start[a];
    PetscReal     *R    = &coarse->motion[a * modes * modes];

    PetscCall(PetscMalloc1(size * bs * modes, &Q));
    for (PetscInt i = 0; i < size; i++)
      PetscCall(PetscArraycpy(&Q[i * bs * modes], &fabric->motion[list[start[a] + i] * bs * modes], bs * modes));
    Orthonormalize_Private(size * bs, modes, Q, R);
    for (PetscInt k = 0; k < modes; k++) {
      columns[k]                  = begin + a * modes + k;
      coarse->held[a * modes + k] = (PetscBool)(R[k * modes + k] == 0);
    }
    for (PetscInt i = 0; i < size * bs; i++) {
      const PetscInt r = row + list[start[a] + i / bs] * bs + i % bs;

      PetscCall(MatSetValues(*P, 1, &r, modes, columns, &Q[i * modes], INSERT_VALUES));
    }
    PetscCall(PetscFree(Q));
  }
  PetscCall(MatAssemblyBegin(*P, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*P, MAT_FINAL_ASSEMBLY));
  PetscCall(PetscFree(start));
  PetscCall(PetscFree(list));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* (1 - omega M D^-1 A) P_0, M = 0 where held */
static PetscErrorCode Smooth_Private(const Fabric *fabric, PetscReal largest, Mat *P)
{
  Mat          AP;
  Vec          scale;
  PetscScalar *s;
  PetscInt     n;

  PetscFunctionBeginUser;
  PetscCall(MatCreateVecs(fabric->A, &scale, NULL));
  PetscCall(MatGetDiagonal(fabric->A, scale));
  PetscCall(VecGetLocalSize(scale, &n));
  PetscCall(VecGetArray(scale, &s));
  for (PetscInt i = 0; i < n; i++) s[i] = fabric->held[i] ? 0 : -DAMPING / largest / s[i];
  PetscCall(VecRestoreArray(scale, &s));
  PetscCall(MatMatMult(fabric->A, *P, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &AP));
  PetscCall(MatProductClear(AP)); // it would keep its factors
  PetscCall(MatDiagonalScale(AP, scale, NULL));
  PetscCall(MatAXPY(AP, 1, *P, SUBSET_NONZERO_PATTERN));
  PetscCall(MatDestroy(P));
  *P = AP;
  PetscCall(VecDestroy(&scale));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FabricCoarsen(const Fabric *fabric, PetscReal largest, Mat *P, Fabric *coarse)
{
  Graph     graph;
  PetscInt *of, num;

  PetscFunctionBeginUser;
  *coarse = (Fabric){.bs = fabric->num, .num = fabric->num, .stronger = fabric->stronger};
  PetscCall(GraphCreate_Private(fabric, &graph));
  PetscCall(PetscMalloc1(graph.num, &of));
  PetscCall(Aggregate_Private(fabric, &graph, of, &num));
  PetscCall(CreateTentative_Private(fabric, graph.num, of, num, P, coarse));
  PetscCall(GraphDestroy_Private(&graph));
  PetscCall(PetscFree(of));
  PetscCall(Smooth_Private(fabric, largest, P));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* nodecoarsening.c -- node-based coarsening.

   No two coarse nodes are coupled. Corners are chosen first, then nodes on edges and faces, since nodes
   outside of all coarse ones need extrapolation [1]. Every other node interpolates its displacement from a
   few coarse nodes nearby, exactly for linear functions (barycentric.c). So the coarse level has the rigid
   body modes and uniform strains of the finer one. A node without such an interpolation becomes a coarse
   node. Each rank chooses among its own nodes, and interpolates from those of other ranks, too.

   References: [1] Adams, Demmel, Parallel multigrid solver for 3D unstructured finite element problems,
   1999. */
#include "base/csrmatrix.h"
#include "multigrid/barycentric.h"
#include "multigrid/ghostexchange.h"
#include "multigrid/nodecoarsening.h"
#include "kernel/vector.h"

enum { DIM_MAX = 3, TERMS = NODE_TERMS };

/* Couplings weaker than this part of the geometric mean of both nodes' diagonal blocks are ignored. */
static const PetscReal COUPLED_FROM = 0.02;
/* Length of the mean direction of a node's couplings: above these limits the node is on a face, on an edge,
   in a corner. */
static const PetscReal BOUNDARY_FROM[] = {0.3, 0.53, 0.65};
enum { KINDS = 1 + PETSC_STATIC_ARRAY_LENGTH(BOUNDARY_FROM) };
/* Weights below this are roundoff. */
static const PetscReal WEIGHT_ROUNDOFF = 1e-8;

/* The graph of nodes: those of this rank, then ghosts. */
typedef struct {
  PetscInt      dim;
  GhostExchange ghosts;
  PetscInt     *start, *node; /* strong couplings of nodes of this rank [n+1], [start[n]] */
  PetscReal    *x;            /* [n + num][dim] */
  PetscReal    *chosen;       /* 1 or 0; later 1 + the number on the coarser level [n + num] */
  PetscInt     *seen;         /* the last node of this rank that visited it [n + num] */
} Net;

PetscErrorCode NodeCoarseningDestroy(NodeSet *nodes)
{
  PetscFunctionBeginUser;
  PetscCall(MatDestroy(&nodes->A));
  PetscCall(PetscFree(nodes->x));
  PetscCall(PetscFree(nodes->fixed));
  PetscCall(PetscFree3(nodes->count, nodes->from, nodes->weight));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode NodeCoarseningShare_Private(Net *net, const PetscReal x[])
{
  const PetscInt all = net->ghosts.n + net->ghosts.num;
  PetscReal     *along;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(all, &along));
  for (PetscInt k = 0; k < net->dim; k++) {
    for (PetscInt i = 0; i < net->ghosts.n; i++) along[i] = x[i * net->dim + k];
    PetscCall(GhostExchangeUpdate(&net->ghosts, along));
    for (PetscInt i = 0; i < all; i++) net->x[i * net->dim + k] = along[i];
  }
  PetscCall(PetscFree(along));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Squared norms of the blocks of a node's rows. [in,out] at - -1 for every node before and after; [out] node,
   square - of coupled nodes, itself among them [*num] */
static PetscErrorCode NodeCoarseningSquares_Private(const NodeSet *nodes, const GhostExchange *ghosts, PetscInt i,
                                                    PetscInt at[], PetscInt *num, PetscInt node[], PetscReal square[])
{
  const PetscInt dim = nodes->dim, first = dim * (ghosts->begin + i);

  PetscFunctionBeginUser;
  *num = 0;
  for (PetscInt row = first; row < first + dim; row++) {
    PetscInt           length, j;
    const PetscInt    *columns;
    const PetscScalar *values;

    PetscCall(MatGetRow(nodes->A, row, &length, &columns, &values));
    for (PetscInt c = 0; c < length; c++) {
      PetscCall(GhostExchangeFind(ghosts, columns[c] / dim, &j));
      if (at[j] < 0) {
        at[j]         = (*num)++;
        node[at[j]]   = j;
        square[at[j]] = 0;
      }
      square[at[j]] += PetscRealPart(values[c] * values[c]);
    }
    PetscCall(MatRestoreRow(nodes->A, row, &length, &columns, &values));
  }
  for (PetscInt k = 0; k < *num; k++) at[node[k]] = -1;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The largest number of entries in the rows of one node. */
static PetscErrorCode NodeCoarseningLongest_Private(const NodeSet *nodes, const GhostExchange *ghosts,
                                                    PetscInt *longest)
{
  PetscFunctionBeginUser;
  *longest = 0;
  for (PetscInt i = 0; i < ghosts->n; i++) {
    PetscInt sum = 0, length;

    for (PetscInt r = 0; r < nodes->dim; r++) {
      PetscCall(MatGetRow(nodes->A, nodes->dim * (ghosts->begin + i) + r, &length, NULL, NULL));
      sum += length;
      PetscCall(MatRestoreRow(nodes->A, nodes->dim * (ghosts->begin + i) + r, &length, NULL, NULL));
    }
    *longest = PetscMax(*longest, sum);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Strong couplings. */
static PetscErrorCode NodeCoarseningConnect_Private(const NodeSet *nodes, Net *net)
{
  GhostExchange *ghosts = &net->ghosts;
  const PetscInt all    = ghosts->n + ghosts->num;
  PetscInt       longest, num, max = 0, *at, *node;
  PetscReal     *square, *own;

  PetscFunctionBeginUser;
  PetscCall(NodeCoarseningLongest_Private(nodes, ghosts, &longest));
  PetscCall(PetscMalloc4(longest, &node, longest, &square, all, &own, all, &at));
  PetscCall(PetscMalloc1(ghosts->n + 1, &net->start));
  for (PetscInt i = 0; i < all; i++) at[i] = -1;
  for (PetscInt i = 0; i < ghosts->n; i++) {
    own[i] = 0;
    PetscCall(NodeCoarseningSquares_Private(nodes, ghosts, i, at, &num, node, square));
    for (PetscInt j = 0; j < num; j++)
      if (node[j] == i) own[i] = PetscSqrtReal(square[j]);
  }
  PetscCall(GhostExchangeUpdate(ghosts, own));
  net->start[0] = 0;
  for (PetscInt i = 0; i < ghosts->n; i++) {
    PetscInt end = net->start[i];

    PetscCall(NodeCoarseningSquares_Private(nodes, ghosts, i, at, &num, node, square));
    if (end + num > max) {
      max = 2 * (end + num);
      PetscCall(PetscRealloc(max * sizeof(PetscInt), &net->node));
    }
    for (PetscInt j = 0; j < num; j++)
      if (node[j] != i && square[j] > PetscSqr(COUPLED_FROM) * own[i] * own[node[j]]) net->node[end++] = node[j];
    net->start[i + 1] = end;
  }
  PetscCall(PetscFree4(node, square, own, at));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* 0 inside of a body, 1 on faces, 2 on edges, 3 in corners and for nodes without couplings. */
static PetscInt NodeCoarseningGetKind_Private(const Net *net, PetscInt i)
{
  const PetscInt dim = net->dim, num = net->start[i + 1] - net->start[i];
  PetscReal      sum[DIM_MAX] = {0}, size;
  PetscInt       kind         = 0;

  for (PetscInt k = net->start[i]; k < net->start[i + 1]; k++) {
    PetscReal d[DIM_MAX], length = 0;

    for (PetscInt a = 0; a < dim; a++) {
      d[a] = net->x[net->node[k] * dim + a] - net->x[i * dim + a];
      length += d[a] * d[a];
    }
    for (PetscInt a = 0; a < dim && length > 0; a++) sum[a] += d[a] / PetscSqrtReal(length);
  }
  size = num ? VectorNorm(dim, sum) / num : 1;
  while (kind < KINDS - 1 && size > BOUNDARY_FROM[kind]) kind++;
  return kind;
}

/* Chooses coarse nodes: corners first. */
static PetscErrorCode NodeCoarseningChoose_Private(Net *net)
{
  const PetscInt n = net->ghosts.n;
  PetscInt      *kind;
  PetscBool     *near;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(n, &kind));
  PetscCall(PetscCalloc1(n, &near));
  for (PetscInt i = 0; i < n; i++) kind[i] = NodeCoarseningGetKind_Private(net, i);
  for (PetscInt i = 0; i < n; i++) net->chosen[i] = 0;
  for (PetscInt k = KINDS - 1; k >= 0; k--)
    for (PetscInt i = 0; i < n; i++) {
      if (kind[i] != k || near[i]) continue;
      net->chosen[i] = 1;
      for (PetscInt j = net->start[i]; j < net->start[i + 1]; j++)
        if (net->node[j] < n) near[net->node[j]] = PETSC_TRUE;
    }
  PetscCall(PetscFree(kind));
  PetscCall(PetscFree(near));
  PetscCall(GhostExchangeUpdate(&net->ghosts, net->chosen));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds a coarse node to the candidates, in place of the farthest if there are too many.
   [in,out] from, d, num */
static void NodeCoarseningAddCandidate_Private(const Net *net, PetscInt i, PetscInt node, PetscInt *num,
                                               PetscInt from[], PetscReal d[])
{
  const PetscInt dim = net->dim;
  PetscInt       at  = *num;
  PetscReal      own = 0, most = 0;

  if (net->seen[node] == i) return;
  net->seen[node] = i;
  if (net->chosen[node] == 0) return;
  for (PetscInt k = 0; k < dim; k++) own += PetscSqr(net->x[node * dim + k] - net->x[i * dim + k]);
  for (PetscInt j = 0; j < *num && *num == BARYCENTRIC_MAX; j++) {
    const PetscReal square = VectorDot(dim, &d[j * dim], &d[j * dim]);

    if (square <= most) continue;
    most = square;
    at   = j;
  }
  if (at == BARYCENTRIC_MAX || (*num == BARYCENTRIC_MAX && own >= most)) return;
  from[at] = node;
  for (PetscInt k = 0; k < dim; k++) d[at * dim + k] = net->x[node * dim + k] - net->x[i * dim + k];
  if (at == *num) ++*num;
}

/* Interpolation of a node from coarse nodes that are coupled to it or to its neighbours of this rank; a
   coarse node if there is none. [out] num, from, weight - [TERMS] */
static void NodeCoarseningWeigh_Private(Net *net, PetscInt i, PetscInt *num, PetscInt from[], PetscReal weight[])
{
  PetscInt  many = 0, near[BARYCENTRIC_MAX];
  PetscReal d[BARYCENTRIC_MAX * DIM_MAX], w[BARYCENTRIC_MAX];

  *num = 0;
  if (net->chosen[i] == 0) {
    net->seen[i] = i;
    for (PetscInt k = net->start[i]; k < net->start[i + 1]; k++)
      NodeCoarseningAddCandidate_Private(net, i, net->node[k], &many, near, d);
    for (PetscInt k = net->start[i]; k < net->start[i + 1]; k++) {
      const PetscInt j = net->node[k];

      for (PetscInt q = j < net->ghosts.n ? net->start[j] : 0; j < net->ghosts.n && q < net->start[j + 1]; q++)
        NodeCoarseningAddCandidate_Private(net, i, net->node[q], &many, near, d);
    }
    if (BarycentricWeights(net->dim, many, d, w)) {
      for (PetscInt j = 0; j < many; j++) {
        if (PetscAbsReal(w[j]) <= WEIGHT_ROUNDOFF) continue;
        from[*num]       = near[j];
        weight[(*num)++] = w[j];
      }
    }
  }
  if (*num) return;
  net->chosen[i] = 1;
  *num           = 1;
  from[0]        = i;
  weight[0]      = 1;
}

/* The known interpolation. [out] count - [n]; [out] from, weight - [n][TERMS] */
static PetscErrorCode NodeCoarseningAdopt_Private(const NodeSet *nodes, Net *net, PetscInt count[], PetscInt from[],
                                                  PetscReal weight[])
{
  const PetscInt n = net->ghosts.n;

  PetscFunctionBeginUser;
  PetscCall(PetscArraycpy(count, nodes->count, n));
  PetscCall(PetscArraycpy(weight, nodes->weight, n * TERMS));
  for (PetscInt i = 0; i < n; i++) {
    for (PetscInt j = 0; j < count[i]; j++)
      PetscCall(GhostExchangeFind(&net->ghosts, nodes->from[i * TERMS + j], &from[i * TERMS + j]));
    net->chosen[i] = from[i * TERMS] == i ? 1 : 0;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Numbers the coarse nodes and copies their data. [out] coarse; [out] num - coarse nodes of this rank */
static PetscErrorCode NodeCoarseningNumber_Private(const NodeSet *nodes, Net *net, NodeSet *coarse, PetscInt *num)
{
  const PetscInt dim = net->dim;
  PetscInt       end;

  PetscFunctionBeginUser;
  *num = 0;
  for (PetscInt i = 0; i < net->ghosts.n; i++) *num += net->chosen[i] != 0;
  PetscCallMPI(MPI_Scan(num, &end, 1, MPIU_INT, MPI_SUM, PetscObjectComm((PetscObject)nodes->A)));
  *coarse = (NodeSet){.dim = dim};
  PetscCall(PetscMalloc1(*num * dim, &coarse->x));
  PetscCall(PetscMalloc1(*num * dim, &coarse->fixed));
  for (PetscInt i = 0, c = 0; i < net->ghosts.n; i++) {
    if (net->chosen[i] == 0) continue;
    PetscCall(PetscArraycpy(&coarse->x[c * dim], &nodes->x[i * dim], dim));
    PetscCall(PetscArraycpy(&coarse->fixed[c * dim], &nodes->fixed[i * dim], dim));
    net->chosen[i] = (PetscReal)(end - *num + ++c);
  }
  PetscCall(GhostExchangeUpdate(&net->ghosts, net->chosen));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Fixed components of nodes, as bits. [out] fixed - [n + num] */
static PetscErrorCode NodeCoarseningShareHeld_Private(const NodeSet *nodes, Net *net, PetscReal fixed[])
{
  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < net->ghosts.n; i++) {
    PetscInt bits = 0;

    for (PetscInt k = 0; k < net->dim; k++) bits |= nodes->fixed[i * net->dim + k] ? 1 << k : 0;
    fixed[i] = (PetscReal)bits;
  }
  PetscCall(GhostExchangeUpdate(&net->ghosts, fixed));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* P of the interpolation. [in] count - [n]; [in] from, weight - [n][TERMS]; [in] num - coarse nodes of this
   rank */
static PetscErrorCode NodeCoarseningCreateP_Private(const NodeSet *nodes, Net *net, const PetscInt count[],
                                                    const PetscInt from[], const PetscReal weight[], PetscInt num,
                                                    Mat *P)
{
  const PetscInt dim = net->dim, n = net->ghosts.n;
  PetscInt      *start, *column, at = 0;
  PetscScalar   *value;
  PetscReal     *fixed;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(n + net->ghosts.num, &fixed));
  PetscCall(NodeCoarseningShareHeld_Private(nodes, net, fixed));
  PetscCall(PetscMalloc3(dim * n + 1, &start, dim * n * TERMS, &column, dim * n * TERMS, &value));
  start[0] = 0;
  for (PetscInt i = 0; i < n; i++) {
    for (PetscInt k = 0; k < dim; k++) {
      for (PetscInt j = 0; j < count[i]; j++) { // zeros as well: the pattern needs a diagonal
        const PetscInt  other = from[i * TERMS + j];
        const PetscBool stays = (PetscBool)(((PetscInt)fixed[i] | (PetscInt)fixed[other]) >> k & 1);

        column[at]  = dim * ((PetscInt)net->chosen[other] - 1) + k;
        value[at++] = stays ? 0 : weight[i * TERMS + j];
      }
      start[dim * i + k + 1] = at;
    }
  }
  PetscCall(CSRMatrixCreate(PetscObjectComm((PetscObject)nodes->A),
                            &(CSRRows){1, dim * n, dim * num, start, column, value}, P));
  PetscCall(PetscFree3(start, column, value));
  PetscCall(PetscFree(fixed));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode NodeCoarseningApply(const NodeSet *nodes, Mat *P, NodeSet *coarse)
{
  Net        net = {.dim = nodes->dim};
  PetscInt   n, all, num, *count, *from;
  PetscReal *weight;

  PetscFunctionBeginUser;
  PetscCall(GhostExchangeCreate(nodes->A, net.dim, &net.ghosts));
  n   = net.ghosts.n;
  all = n + net.ghosts.num;
  PetscCall(PetscMalloc3(all * net.dim, &net.x, all, &net.chosen, all, &net.seen));
  PetscCall(PetscMalloc3(n, &count, n * TERMS, &from, n * TERMS, &weight));
  for (PetscInt i = 0; i < all; i++) net.seen[i] = -1;
  PetscCall(NodeCoarseningShare_Private(&net, nodes->x));
  if (nodes->count) {
    PetscCall(NodeCoarseningAdopt_Private(nodes, &net, count, from, weight));
  } else {
    PetscCall(NodeCoarseningConnect_Private(nodes, &net));
    PetscCall(NodeCoarseningChoose_Private(&net));
    for (PetscInt i = 0; i < n; i++)
      NodeCoarseningWeigh_Private(&net, i, &count[i], &from[i * TERMS], &weight[i * TERMS]);
  }
  PetscCall(NodeCoarseningNumber_Private(nodes, &net, coarse, &num));
  PetscCall(NodeCoarseningCreateP_Private(nodes, &net, count, from, weight, num, P));
  PetscCall(PetscFree3(count, from, weight));
  PetscCall(PetscFree3(net.x, net.chosen, net.seen));
  PetscCall(PetscFree(net.start));
  PetscCall(PetscFree(net.node));
  PetscCall(GhostExchangeDestroy(&net.ghosts));
  PetscFunctionReturn(PETSC_SUCCESS);
}

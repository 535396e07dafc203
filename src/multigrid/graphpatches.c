/* graphpatches.c -- stars and cells in the graph of K.

   N(i) are the nodes that share a cell with i, and i. Cells of order 2 have nodes other than vertices: a node
   j with N(j) in N(v) has no cell without the vertex v, and

       star of v = { j : N(j) in N(v) },   for nodes v with N(v) in no other N(w),

   is v with all nodes inside of the cells around it. In cells of order 1 a star is v alone. There a patch is
   a cell: the common neighbours of two nodes that share one cell only, which are all neighbours of each
   other.

   A node of a mortar side moves nodes of the nonmortar side, which changes the volume of cells there. Nodes
   that can compensate the change join its patches (patchlinks.c). */
#include "base/compat.h"
#include "multigrid/graphpatches.h"

/* Neighbourhoods of own nodes and of ghosts, without other nodes. */
typedef struct {
  const GhostExchange *ghosts;
  PetscInt            *start, *next; /* neighbours, the node itself among them [start[n + num]] */
  PetscReal           *degree;       /* on their owner [n + num] */
  PetscInt            *stamp;        /* [n + num] */
} Graph;

static PetscErrorCode GraphBegin_Private(RankRows *rows, PetscInt bs, GhostExchange *ghosts, Graph *graph)
{
  const PetscInt     num = ghosts->n + ghosts->num;
  PetscInt           length, max = 0;
  const PetscInt    *column;
  const PetscScalar *value;

  PetscFunctionBeginUser;
  *graph = (Graph){.ghosts = ghosts};
  PetscCall(PetscMalloc3(num + 1, &graph->start, num, &graph->degree, num, &graph->stamp));
  graph->start[0] = 0;
  for (PetscInt i = 0; i < num; i++) {
    PetscCall(RankRowsGet(rows, bs * i, &length, &column, &value));
    if (graph->start[i] + length / bs > max) {
      max = 2 * (graph->start[i] + length / bs);
      PetscCall(PetscRealloc((size_t)max * sizeof(PetscInt), &graph->next));
    }
    graph->stamp[i]     = -1;
    graph->degree[i]    = (PetscReal)(length / bs);
    graph->start[i + 1] = graph->start[i];
    for (PetscInt j = 0; j < length; j += bs) graph->next[graph->start[i + 1]++] = column[j] / bs;
  }
  PetscCall(GhostExchangeUpdate(ghosts, graph->degree));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode GraphEnd_Private(Graph *graph)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(graph->next));
  PetscCall(PetscFree3(graph->start, graph->degree, graph->stamp));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Global number of a node. */
static PetscInt GraphNumber_Private(const Graph *graph, PetscInt node)
{
  const GhostExchange *ghosts = graph->ghosts;

  return node < ghosts->n ? ghosts->begin + node : ghosts->ghost[node - ghosts->n];
}

/* Neighbours of a node that are stamped. [out] which - NULL, or [degree] */
static PetscInt GraphCommon_Private(const Graph *graph, PetscInt node, PetscInt stamp, PetscInt which[])
{
  PetscInt num = 0;

  for (PetscInt k = graph->start[node]; k < graph->start[node + 1]; k++) {
    if (graph->stamp[graph->next[k]] != stamp) continue;
    if (which) which[num] = graph->next[k];
    num++;
  }
  return num;
}

/* The star of a node; none if its neighbourhood is part of another one's. [out] star - [degree] */
static PetscInt GraphStar_Private(Graph *graph, PetscInt v, PetscInt star[])
{
  const PetscInt begin = graph->start[v], end = graph->start[v + 1], degree = end - begin;
  PetscInt       num = 0;

  for (PetscInt k = begin; k < end; k++) graph->stamp[graph->next[k]] = v;
  for (PetscInt k = begin; k < end; k++) {
    const PetscInt j = graph->next[k], common = GraphCommon_Private(graph, j, v, NULL);
    const PetscInt theirs = (PetscInt)graph->degree[j];

    if (common == degree && (theirs > degree || GraphNumber_Private(graph, j) < GraphNumber_Private(graph, v)))
      return 0;
    if (common == theirs) star[num++] = j;
  }
  return num;
}

/* Whether nodes are all neighbours of each other, and node v is the first of them. Overwrites stamps by a
   number that no node has. */
static PetscBool GraphIsCell_Private(Graph *graph, PetscInt v, PetscInt num, const PetscInt node[])
{
  const PetscInt mark = -2 - v;
  PetscBool      is   = PETSC_TRUE;

  for (PetscInt i = 0; i < num; i++)
    if (GraphNumber_Private(graph, node[i]) < GraphNumber_Private(graph, v)) return PETSC_FALSE;
  for (PetscInt i = 0; i < num; i++) graph->stamp[node[i]] = mark;
  for (PetscInt i = 0; i < num && is; i++) is = (PetscBool)(GraphCommon_Private(graph, node[i], mark, NULL) == num);
  for (PetscInt i = 0; i < num; i++) graph->stamp[node[i]] = v;
  return is;
}

/* Whether all nodes are marked. */
static PetscBool GraphPatchesAreMarked_Private(PetscInt num, const PetscInt node[], const PetscReal marked[])
{
  for (PetscInt i = 0; i < num; i++)
    if (marked[node[i]] == 0) return PETSC_FALSE;
  return PETSC_TRUE;
}

static PetscErrorCode GraphPatchesAdd_Private(GraphPatches *patches, PetscInt num, const PetscInt node[],
                                              PetscInt room[2])
{
  PetscFunctionBeginUser;
  if (patches->num + 2 > room[0]) {
    room[0] = 2 * (patches->num + 2);
    PetscCall(PetscRealloc((size_t)room[0] * sizeof(PetscInt), &patches->start));
  }
  if (!patches->num) patches->start[0] = 0;
  if (patches->start[patches->num] + num > room[1]) {
    room[1] = 2 * (patches->start[patches->num] + num);
    PetscCall(PetscRealloc((size_t)room[1] * sizeof(PetscInt), &patches->node));
  }
  PetscCall(PetscArraycpy(&patches->node[patches->start[patches->num]], node, num));
  patches->num++;
  patches->start[patches->num] = patches->start[patches->num - 1] + num;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Cells whose first node is v. [out] cell - [degree] */
static PetscErrorCode GraphPatchesAddCells_Private(Graph *graph, PetscInt v, const PetscReal marked[], PetscInt cell[],
                                                   GraphPatches *patches, PetscInt room[2])
{
  const PetscInt first = patches->num;

  PetscFunctionBeginUser;
  for (PetscInt k = graph->start[v]; k < graph->start[v + 1]; k++) graph->stamp[graph->next[k]] = v;
  for (PetscInt k = graph->start[v]; k < graph->start[v + 1]; k++) {
    const PetscInt j = graph->next[k], num = GraphCommon_Private(graph, j, v, cell);
    PetscBool      known = (PetscBool)(j == v || num < 2);

    for (PetscInt p = first; p < patches->num && !known; p++) // the patch has v and j, and so all common neighbours
      for (PetscInt i = patches->start[p]; i < patches->start[p + 1]; i++)
        known = (PetscBool)(known || (patches->node[i] == j && num == patches->start[p + 1] - patches->start[p]));
    if (known || !GraphIsCell_Private(graph, v, num, cell) || !GraphPatchesAreMarked_Private(num, cell, marked))
      continue;
    PetscCall(GraphPatchesAdd_Private(patches, num, cell, room));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Stars overlap in cells of order 2: an edge has two vertices. In cells of order 1 they do not. */
static const PetscReal STARS_OVERLAP = 1.25;

/* Stars. [out] overlap - whether they do */
static PetscErrorCode GraphPatchesAddStars_Private(Graph *graph, const PetscReal marked[], PetscInt node[],
                                                   GraphPatches *patches, PetscBool *overlap)
{
  const PetscInt n       = graph->ghosts->n + graph->ghosts->num;
  PetscInt       room[2] = {0, 0};
  PetscReal      sum[2]  = {0, 0}; /* nodes of patches, nodes in patches */
  PetscBool     *in;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(n, &in));
  for (PetscInt v = 0; v < graph->ghosts->n; v++) {
    const PetscInt num = marked[v] == 0 ? 0 : GraphStar_Private(graph, v, node);

    for (PetscInt i = 0; i < num; i++) sum[1] += in[node[i]] ? 0 : 1;
    for (PetscInt i = 0; i < num; i++) in[node[i]] = PETSC_TRUE;
    sum[0] += (PetscReal)num;
    if (num) PetscCall(GraphPatchesAdd_Private(patches, num, node, room));
  }
  PetscCall(PetscFree(in));
  PetscCallMPI(
      MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPIU_REAL, MPI_SUM, PetscObjectComm((PetscObject)graph->ghosts->own)));
  *overlap = (PetscBool)(sum[0] > STARS_OVERLAP * sum[1]);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GraphPatchesCreate(RankRows *rows, PetscInt bs, GhostExchange *ghosts, const PetscReal marked[],
                                  GraphPatches *patches)
{
  PetscInt  max = 0, *node, room[2] = {0, 0};
  PetscBool overlap = PETSC_FALSE;
  Graph     graph;

  PetscFunctionBeginUser;
  *patches = (GraphPatches){.cells = PETSC_FALSE};
  PetscCall(GraphBegin_Private(rows, bs, ghosts, &graph));
  for (PetscInt i = 0; i < ghosts->n + ghosts->num; i++) max = PetscMax(max, graph.start[i + 1] - graph.start[i]);
  PetscCall(PetscMalloc1(max, &node));
  PetscCall(GraphPatchesAddStars_Private(&graph, marked, node, patches, &overlap));
  if (!overlap) {
    PetscCall(GraphPatchesDestroy(patches));
    patches->cells = PETSC_TRUE;
    for (PetscInt v = 0; v < ghosts->n; v++)
      if (marked[v] != 0) PetscCall(GraphPatchesAddCells_Private(&graph, v, marked, node, patches, room));
  }
  PetscCall(PetscFree(node));
  PetscCall(GraphEnd_Private(&graph));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GraphPatchesExtend(const GhostExchange *ghosts, RankRows *links, GraphPatches *patches)
{
  const PetscInt num = ghosts->n + ghosts->num;
  GraphPatches   all = {.cells = patches->cells};
  PetscInt      *seen, *node, room[2] = {0, 0};

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(num, &seen, num, &node));
  for (PetscInt i = 0; i < num; i++) seen[i] = -1;
  for (PetscInt p = 0; p < patches->num; p++) {
    PetscInt end = 0;

    for (PetscInt i = patches->start[p]; i < patches->start[p + 1]; i++) seen[patches->node[i]] = p;
    for (PetscInt i = patches->start[p]; i < patches->start[p + 1]; i++) {
      PetscInt           length;
      const PetscInt    *carried;
      const PetscScalar *ones;

      node[end++] = patches->node[i];
      PetscCall(RankRowsGet(links, patches->node[i], &length, &carried, &ones));
      for (PetscInt j = 0; j < length; j++) {
        if (seen[carried[j]] == p) continue;
        seen[carried[j]] = p;
        node[end++]      = carried[j];
      }
    }
    PetscCall(GraphPatchesAdd_Private(&all, end, node, room));
  }
  PetscCall(PetscFree2(seen, node));
  PetscCall(GraphPatchesDestroy(patches));
  *patches = all;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GraphPatchesDestroy(GraphPatches *patches)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(patches->start));
  PetscCall(PetscFree(patches->node));
  patches->num = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

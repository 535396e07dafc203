/* hanging.c -- nodes that hang on an edge or a face of a larger cell.

   Where a cell was split and its neighbour was not, the middle of their edge or face is a vertex of the small
   cells alone. A function is continuous there if nodes of the small cells on this edge or face have the
   values of the large one. Its corners do not hang (bisect.h), so that these values are those of free
   nodes. */
#include "base/compat.h"
#include "level/plexpoints.h"
#include "mesh/hanging.h"
#include "mesh/hungnodes.h"
#include "mesh/meshforest.h"
#include "mesh/tree.h"

enum { FACE = 4 }; /* corners of a face, and its edges */

/* Distances of hanging nodes from a curve, over the size of their edge, that are roundoff. */
static const PetscReal EDGE_ROUNDING = 1e-11;

/* Sets the row of a node. [in] cells - of the tree on its level */
static PetscErrorCode HangingSetRow_Private(Mat S, const HungNode *hung, const ForestCell cells[], PetscInt node)
{
  const ForestCell *whole = &cells[hung->cell];
  PetscReal         phi[ELEMENT_MAX_NODES];
  PetscInt          num, local[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  HungNodeShape(hung, (ElementType)whole->type, &num, local, phi);
  for (PetscInt i = 0; i < num; i++)
    if (phi[i] != 0) PetscCall(MatSetValue(S, node, whole->nodes[local[i]], phi[i], INSERT_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets the rows of all nodes of a tree that hang, and which facets are beside them.
   [in,out] cells - of the tree on its level; hanging - by global node */
static PetscErrorCode HangingSetTree_Private(Mat S, const Tree *tree, ForestCell cells[], PetscBool hanging[])
{
  HungNodes hung;

  PetscFunctionBeginUser;
  PetscCall(HungNodesCreate(tree, cells[0].vertex, (PetscInt)(sizeof(ForestCell) / sizeof(PetscInt)), &hung));
  for (PetscInt c = 0; c < tree->mesh.num_cells && hung.num; c++) {
    const ElementType type = (ElementType)cells[c].type;

    for (PetscInt k = 0; k < ElementNumNodes(type); k++) {
      const PetscInt found = HungNodesFind(&hung, c, k);

      if (found < 0 || hanging[cells[c].nodes[k]]) continue;
      hanging[cells[c].nodes[k]] = PETSC_TRUE;
      PetscCall(HangingSetRow_Private(S, &hung.node[found], cells, cells[c].nodes[k]));
    }
    for (PetscInt f = 0; f < ElementNumFacets(type); f++)
      if (HungNodesHasFacet(&hung, c, f)) cells[c].inner |= 1 << f;
  }
  PetscCall(HungNodesDestroy(&hung));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sends to all ranks which facets of their cells are beside hanging nodes. Collective. */
static PetscErrorCode LevelSetInner_Private(MeshForest forest, Level *level)
{
  PetscInt *all = NULL, *own, *point, begin, end, first;

  PetscFunctionBeginUser;
  if (forest->num_cells) PetscCall(PetscMalloc1(forest->num_cells, &all));
  for (PetscInt i = 0; i < forest->num_cells; i++) all[i] = forest->cell[forest->gathered[i]].inner;
  PetscCall(PetscMalloc1(level->num_cells, &own));
  PetscCallMPI(MPI_Scatterv(all, forest->counts, forest->begins, MPIU_INT, own, (PetscMPIInt)level->num_cells, MPIU_INT,
                            0, level->comm));
  PetscCall(DMPlexGetHeightStratum(level->dm, 0, &first, NULL));
  PetscCall(DMPlexGetHeightStratum(level->dm, 1, &begin, &end));
  PetscCall(PetscCalloc1(end - begin + 1, &level->inner)); // not NULL where a rank has no cells
  PetscCall(LevelGetNodePoints(level, &point));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const PetscInt *nodes = &level->cell_nodes[level->cell_start[c]];

    for (PetscInt f = 0; own[c] >> f; f++) {
      const ElementType type  = ElementLinear((ElementType)level->cell_type[c]);
      const PetscInt   *local = ElementFacetNodes(type, f), num = ElementNumNodes(ElementFacetType(type));
      PetscInt          vertex[ELEMENT_MAX_FACET_NODES], facet;

      if (!(own[c] >> f & 1)) continue;
      for (PetscInt i = 0; i < num; i++) vertex[i] = point[nodes[local[i]]];
      PetscCall(PointFindFacet(level->dm, first + c, num, vertex, &facet));
      level->inner[facet - begin] = PETSC_TRUE;
    }
  }
  PetscCall(PetscFree(point));
  PetscCall(PetscFree(own));
  PetscCall(PetscFree(all));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The distance to where a hanging node was. [in] x - where it was [dim]; [out] rise - [dim] */
static void LevelGetRise_Private(const Level *level, PetscInt node, const PetscReal x[], PetscReal rise[])
{
  const Hanging *hanging = &level->hanging;
  const PetscInt dim = level->dim, first = hanging->node[hanging->start[node]];
  const PetscInt last = hanging->node[hanging->start[node + 1] - 1];
  PetscReal      size = 0, off = 0;

  for (PetscInt d = 0; d < dim; d++) {
    rise[d] = x[d] - level->coords[node * dim + d];
    size    = PetscMax(size, PetscAbsReal(level->coords[last * dim + d] - level->coords[first * dim + d]));
    off     = PetscMax(off, PetscAbsReal(rise[d]));
  }
  for (PetscInt d = 0; d < dim && off <= EDGE_ROUNDING * size; d++) rise[d] = 0;
}

/* Moves hanging nodes to the edges and faces that they hang on: in the box they are there, after a map they
   need not be. */
static PetscErrorCode LevelMoveHanging_Private(Level *level)
{
  const PetscInt dim = level->dim, num = level->num_nodes * dim;
  PetscReal     *before;
  PetscScalar   *a;
  Vec            x, local;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(num, &before));
  PetscCall(PetscArraycpy(before, level->coords, num));
  PetscCall(PetscCalloc1(num, &level->hanging.rise));
  PetscCall(LevelCreateVec(level, dim, &x));
  PetscCall(VecGetArray(x, &a));
  for (PetscInt i = 0; i < level->num_owned * dim; i++) a[i] = level->coords[i];
  PetscCall(VecRestoreArray(x, &a));
  PetscCall(LevelConform(level, dim, x));
  PetscCall(VecGhostGetLocalForm(x, &local));
  PetscCall(VecGetArray(local, &a));
  for (PetscInt i = 0; i < num; i++) level->coords[i] = PetscRealPart(a[i]);
  PetscCall(VecRestoreArray(local, &a));
  PetscCall(VecGhostRestoreLocalForm(x, &local));
  PetscCall(VecDestroy(&x));
  for (PetscInt i = 0; i < level->num_nodes; i++)
    if (LevelNodeHangs(level, i)) LevelGetRise_Private(level, i, &before[i * dim], &level->hanging.rise[i * dim]);
  PetscCall(PetscFree(before));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Values of local nodes, by those of their owners. Collective. [in,out] values - [num_nodes][dim] */
static PetscErrorCode LevelShareValues_Private(Level *level, PetscReal values[])
{
  const PetscInt owned = level->num_owned * level->dim, num = level->num_nodes * level->dim;
  PetscScalar   *a;
  Vec            x, local;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, level->dim, &x));
  PetscCall(VecGetArray(x, &a));
  for (PetscInt i = 0; i < owned; i++) a[i] = values[i];
  PetscCall(VecRestoreArray(x, &a));
  PetscCall(LevelShareVec(x, INSERT_VALUES));
  PetscCall(VecGhostGetLocalForm(x, &local));
  PetscCall(VecGetArray(local, &a));
  for (PetscInt i = 0; i < num; i++) values[i] = PetscRealPart(a[i]);
  PetscCall(VecRestoreArray(local, &a));
  PetscCall(VecGhostRestoreLocalForm(x, &local));
  PetscCall(VecDestroy(&x));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Appends ghosts, nodes of other ranks' cells. Collective. [in] body - of each [num] */
static PetscErrorCode LevelAppendGhosts_Private(Level *level, PetscInt num, const PetscInt global[],
                                                const PetscInt body[])
{
  const PetscInt old = level->num_nodes, all = old + num, dim = level->dim;
  PetscInt      *node_global, *node_body;
  PetscReal     *coords, *unmapped;
  PetscBool      curved = (PetscBool)(level->unmapped != NULL);

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(all, &node_global, all, &node_body, all * dim, &coords));
  PetscCall(PetscArraycpy(node_global, level->node_global, old));
  PetscCall(PetscArraycpy(node_body, level->node_body, old));
  PetscCall(PetscArraycpy(coords, level->coords, old * dim));
  PetscCall(PetscArraycpy(&node_global[old], global, num));
  PetscCall(PetscArraycpy(&node_body[old], body, num));
  PetscCall(PetscFree3(level->node_global, level->node_body, level->coords));
  level->node_global = node_global;
  level->node_body   = node_body;
  level->coords      = coords;
  level->num_nodes   = all;
  PetscCall(LevelShareValues_Private(level, level->coords));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &curved, 1, MPIU_BOOL, MPI_LOR, level->comm));
  if (!curved) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(all * dim + 1, &unmapped));
  if (level->unmapped) PetscCall(PetscArraycpy(unmapped, level->unmapped, old * dim));
  PetscCall(PetscFree(level->unmapped));
  level->unmapped = unmapped;
  PetscCall(LevelShareValues_Private(level, level->unmapped));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Rows of level->conforming of all local nodes. Collective. [out] order - local nodes by global number, which
   the rows follow [num_nodes]; [out] rows - columns are global nodes; both owned by the caller */
static PetscErrorCode LevelGetConformingRows_Private(const Level *level, PetscInt **order, Mat **rows)
{
  const PetscInt num = level->num_nodes;
  PetscInt      *sorted;
  IS             nodes, all;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(num, order));
  PetscCall(PetscMalloc1(num, &sorted));
  PetscCall(PetscArraycpy(sorted, level->node_global, num));
  for (PetscInt i = 0; i < num; i++) (*order)[i] = i;
  PetscCall(PetscSortIntWithArray(num, sorted, *order));
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, num, sorted, PETSC_OWN_POINTER, &nodes));
  PetscCall(ISCreateStride(PETSC_COMM_SELF, level->num_global, 0, 1, &all));
  PetscCall(MatCreateSubMatrices(level->conforming, 1, &nodes, &all, MAT_INITIAL_MATRIX, rows));
  PetscCall(ISDestroy(&all));
  PetscCall(ISDestroy(&nodes));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The local node of a global one, or -1. [in] order - of LevelGetConformingRows_Private() [num] */
static PetscInt LevelFindNode_Private(const Level *level, PetscInt num, const PetscInt order[], PetscInt global)
{
  PetscInt low = 0, high = num;

  while (low < high) {
    const PetscInt middle = (low + high) / 2;

    if (level->node_global[order[middle]] < global)
      low = middle + 1;
    else
      high = middle;
  }
  return low < num && level->node_global[order[low]] == global ? order[low] : -1;
}

/* The table of nodes that hang, at first with global nodes. [in] at - row of each local node [num_nodes] */
static PetscErrorCode LevelListHanging_Private(const Level *level, Mat rows, const PetscInt at[], Hanging *hanging)
{
  PetscInt num = 0;

  PetscFunctionBeginUser;
  for (PetscInt pass = 0; pass < 2; pass++) {
    if (pass) {
      PetscCall(PetscMalloc1(level->num_nodes + 1, &hanging->start));
      PetscCall(PetscMalloc1(num, &hanging->node));
      PetscCall(PetscMalloc1(num, &hanging->weight));
    }
    num = 0;
    for (PetscInt i = 0; i < level->num_nodes; i++) {
      const PetscInt    *columns;
      const PetscScalar *values;
      PetscInt           size;

      if (pass) hanging->start[i] = num;
      PetscCall(MatGetRow(rows, at[i], &size, &columns, &values));
      if (size > 1 || columns[0] != level->node_global[i]) {
        for (PetscInt k = 0; k < size && pass; k++) {
          hanging->node[num + k]   = columns[k];
          hanging->weight[num + k] = PetscRealPart(values[k]);
        }
        num += size;
      }
      PetscCall(MatRestoreRow(rows, at[i], &size, &columns, &values));
    }
    if (pass) hanging->start[level->num_nodes] = num;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Local numbers in place of global nodes of level->hanging. Those of other ranks become ghosts. Collective.
   [in] order - of LevelGetConformingRows_Private() */
static PetscErrorCode LevelLocateHanging_Private(Level *level, const PetscInt order[])
{
  Hanging       *hanging = &level->hanging;
  const PetscInt num = level->num_nodes, all = hanging->start[num];
  PetscInt      *body, *fresh, added = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(all, &fresh, all, &body));
  for (PetscInt k = 0; k < all; k++)
    if (LevelFindNode_Private(level, num, order, hanging->node[k]) < 0) fresh[added++] = hanging->node[k];
  PetscCall(PetscSortRemoveDupsInt(&added, fresh));
  for (PetscInt i = 0; i < num; i++) {
    for (PetscInt k = hanging->start[i]; k < hanging->start[i + 1]; k++) {
      const PetscInt found = LevelFindNode_Private(level, num, order, hanging->node[k]);
      PetscInt       ghost = 0;

      if (found < 0) {
        PetscCall(PetscFindInt(hanging->node[k], added, fresh, &ghost));
        body[ghost] = level->node_body[i];
      }
      hanging->node[k] = found < 0 ? num + ghost : found;
    }
  }
  PetscCall(LevelAppendGhosts_Private(level, added, fresh, body));
  PetscCall(PetscFree2(fresh, body));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* level->hanging; nodes on which others hang become ghosts. Collective. */
static PetscErrorCode LevelSetHanging_Private(Level *level)
{
  Hanging       *hanging = &level->hanging;
  const PetscInt num     = level->num_nodes;
  PetscInt      *order, *at;
  Mat           *rows;

  PetscFunctionBeginUser;
  PetscCall(LevelGetConformingRows_Private(level, &order, &rows));
  PetscCall(PetscMalloc1(num, &at));
  for (PetscInt i = 0; i < num; i++) at[order[i]] = i;
  PetscCall(LevelListHanging_Private(level, rows[0], at, hanging));
  PetscCall(MatDestroySubMatrices(1, &rows));
  PetscCall(LevelLocateHanging_Private(level, order));
  PetscCall(PetscFree(at));
  PetscCall(PetscFree(order));
  PetscCall(PetscMalloc1(level->num_nodes + 1, &at)); // new ghosts do not hang
  for (PetscInt i = 0; i <= level->num_nodes; i++) at[i] = hanging->start[PetscMin(i, num)];
  PetscCall(PetscFree(hanging->start));
  hanging->start = at;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshForestSetHanging(MeshForest forest, Level *level)
{
  const PetscInt most = ElementNumNodes(level->dim == 2 ? ELEMENT_LINE3 : ELEMENT_QUAD9);
  PetscBool     *hanging, any = PETSC_FALSE;
  PetscInt       first = 0;
  Mat            S;

  PetscFunctionBeginUser;
  if (!level->scene->adapt.kept) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatCreateAIJ(level->comm, level->num_owned, level->num_owned, PETSC_DETERMINE, PETSC_DETERMINE, most, NULL,
                         most, NULL, &S));
  PetscCall(PetscCalloc1(forest->num_cells ? level->num_global : 0, &hanging));
  for (PetscInt b = 0; b < forest->num_bodies && forest->num_cells; b++) {
    if (TreeIsKept(&forest->tree[b]))
      PetscCall(HangingSetTree_Private(S, &forest->tree[b], &forest->cell[first], hanging));
    first += forest->tree[b].mesh.num_cells;
  }
  for (PetscInt i = 0; i < level->num_global && forest->num_cells; i++) {
    any = (PetscBool)(any || hanging[i]);
    if (!hanging[i]) PetscCall(MatSetValue(S, i, i, 1, INSERT_VALUES));
  }
  PetscCall(PetscFree(hanging));
  PetscCall(MatAssemblyBegin(S, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(S, MAT_FINAL_ASSEMBLY));
  PetscCallMPI(MPI_Bcast(&any, 1, MPIU_BOOL, 0, level->comm));
  if (any) {
    level->conforming = S;
    PetscCall(LevelSetInner_Private(forest, level));
    PetscCall(LevelSetHanging_Private(level));
    PetscCall(LevelMoveHanging_Private(level));
  } else {
    PetscCall(MatDestroy(&S));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* hanging.c -- nodes that hang on an edge of a larger cell.

   Where a cell was split and its neighbour was not, the middle of their edge is a vertex of the small cells
   alone. A function is continuous there if nodes of the small cells on this edge have the values of the large
   one. The ends of the edge do not hang (bisect.h), so that these values are those of free nodes. */
#include "mesh/forest.h"
#include "base/compat.h"

enum { PARTS = 2 };

PetscErrorCode TreeGetHung(const Tree *tree, EdgeTable *hung)
{
  const Bisection *mesh = &tree->mesh;
  EdgeTable        middles;

  PetscFunctionBeginUser;
  *hung = (EdgeTable){.room = 0};
  if (!TreeIsKept(tree)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(SplitGetMiddles(mesh, &middles));
  for (PetscInt c = 0; c < mesh->num_cells; c++) {
    for (PetscInt k = 0; k < mesh->corners; k++) {
      const PetscInt a = mesh->vertex[c][k], b = mesh->vertex[c][(k + 1) % mesh->corners];

      if (EdgeTableFind(&middles, a, b) >= 0) PetscCall(EdgeTableAdd(hung, a, b, c * mesh->corners + k));
    }
  }
  PetscCall(EdgeTableDestroy(&middles));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscInt TreeFindHalf(const Tree *tree, const EdgeTable *hung, const PetscInt ends[2], PetscInt *middle)
{
  for (*middle = 0; *middle < 2; (*middle)++) {
    const PetscInt *whole = tree->mesh.ends[ends[*middle]], other = ends[1 - *middle];
    const PetscInt  found = other == whole[0] || other == whole[1] ? EdgeTableFind(hung, whole[0], whole[1]) : -1;

    if (found >= 0) return found;
  }
  return -1;
}

/* The nodes of a tree's cells: of vertices, and of the middles of edges in cells of order 2. */
typedef struct {
  PetscInt *vertex; /* [mesh.num_vertices] */
  EdgeTable edge;
} TreeNodes;

/* [in] cells - of the tree on its level; [out] nodes - global */
static PetscErrorCode TreeNodesCreate_Private(const Tree *tree, const ForestCell cells[], TreeNodes *nodes)
{
  PetscFunctionBeginUser;
  nodes->edge = (EdgeTable){.room = 0};
  PetscCall(PetscMalloc1(tree->mesh.num_vertices, &nodes->vertex));
  for (PetscInt c = 0; c < tree->mesh.num_cells; c++) {
    const ElementType type   = (ElementType)cells[c].type;
    const PetscInt   *vertex = cells[c].vertex;

    for (PetscInt i = 0; i < tree->mesh.corners; i++) nodes->vertex[vertex[i]] = cells[c].nodes[i];
    for (PetscInt e = 0; e < ElementNumEdges(type) && ElementOrder(type) > 1; e++) {
      const PetscInt *ends = ElementEdgeNodes(type, e);

      PetscCall(EdgeTableAdd(&nodes->edge, vertex[ends[0]], vertex[ends[1]], cells[c].nodes[tree->mesh.corners + e]));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode TreeNodesDestroy_Private(TreeNodes *nodes)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(nodes->vertex));
  PetscCall(EdgeTableDestroy(&nodes->edge));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets the row of a node at a place of an edge, from 0 to 1.
   [in] from - nodes of the edge; [in,out] hanging - by global node */
static PetscErrorCode HangingSetRow_Private(Mat S, ElementType type, const PetscInt from[], PetscReal place,
                                            PetscInt node, PetscBool hanging[])
{
  PetscReal phi[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  ElementShape(type, &place, phi, NULL);
  for (PetscInt i = 0; i < ElementNumNodes(type); i++)
    if (phi[i] != 0)
      PetscCall(MatSetValue(S, node, from[i], phi[i], INSERT_VALUES)); // places are dyadic: zeros are exact
  hanging[node] = PETSC_TRUE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets the rows of the nodes on an edge whose middle hangs. [in] edge - its ends and its middle, vertices of
   the tree */
static PetscErrorCode HangingSetEdge_Private(Mat S, const TreeNodes *nodes, const PetscInt edge[3], PetscBool hanging[])
{
  const PetscInt    middle  = EdgeTableFind(&nodes->edge, edge[0], edge[1]);
  const PetscInt    from[3] = {nodes->vertex[edge[0]], nodes->vertex[edge[1]], middle};
  const ElementType type    = middle < 0 ? ELEMENT_LINE2 : ELEMENT_LINE3;

  PetscFunctionBeginUser;
  PetscCall(HangingSetRow_Private(S, type, from, 0.5, nodes->vertex[edge[2]], hanging));
  for (PetscInt i = 0; i < PARTS && middle >= 0; i++)
    PetscCall(HangingSetRow_Private(S, type, from, 0.25 + 0.5 * (PetscReal)i,
                                    EdgeTableFind(&nodes->edge, edge[i], edge[2]), hanging));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets the rows of all nodes of a tree that hang, and which facets are beside them.
   [in,out] cells - of the tree on its level */
static PetscErrorCode HangingSetTree_Private(Mat S, const Tree *tree, ForestCell cells[], PetscBool hanging[])
{
  EdgeTable hung;
  TreeNodes nodes;

  PetscFunctionBeginUser;
  PetscCall(TreeGetHung(tree, &hung));
  PetscCall(TreeNodesCreate_Private(tree, cells, &nodes));
  for (PetscInt c = 0; c < tree->mesh.num_cells && hung.num; c++) {
    for (PetscInt e = 0; e < tree->mesh.corners; e++) {
      const PetscInt *local   = ElementEdgeNodes((ElementType)cells[c].type, e);
      const PetscInt  ends[2] = {cells[c].vertex[local[0]], cells[c].vertex[local[1]]};
      PetscInt        middle, whole = TreeFindHalf(tree, &hung, ends, &middle);

      if (whole >= 0) {
        const PetscInt edge[3] = {tree->mesh.ends[ends[middle]][0], tree->mesh.ends[ends[middle]][1], ends[middle]};

        PetscCall(HangingSetEdge_Private(S, &nodes, edge, hanging));
      }
      if (whole >= 0 || EdgeTableFind(&hung, ends[0], ends[1]) >= 0) cells[c].inner |= 1 << e;
    }
  }
  PetscCall(TreeNodesDestroy_Private(&nodes));
  PetscCall(EdgeTableDestroy(&hung));
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

    for (PetscInt e = 0; own[c] >> e; e++) {
      const PetscInt *local   = ElementEdgeNodes((ElementType)level->cell_type[c], e);
      const PetscInt  ends[2] = {point[nodes[local[0]]], point[nodes[local[1]]]};
      PetscInt        facet;

      if (!(own[c] >> e & 1)) continue;
      PetscCall(PointFindFacet(level->dm, first + c, 2, ends, &facet));
      level->inner[facet - begin] = PETSC_TRUE;
    }
  }
  PetscCall(PetscFree(point));
  PetscCall(PetscFree(own));
  PetscCall(PetscFree(all));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelMarkShared(const Level *level, PetscBool **shared)
{
  PetscInt begin, end;

  PetscFunctionBeginUser;
  PetscCall(PointsMarkShared(level->dm, shared));
  PetscCall(DMPlexGetHeightStratum(level->dm, 1, &begin, &end));
  for (PetscInt f = begin; f < end && level->inner; f++)
    (*shared)[f] = (PetscBool)((*shared)[f] || level->inner[f - begin]);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Moves hanging nodes to the edges that they hang on: in the box they are there, after a map they need not
   be. */
static PetscErrorCode LevelMoveHanging_Private(Level *level)
{
  const PetscInt num = level->num_nodes * level->dim;
  PetscScalar   *a;
  Vec            x, local;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, level->dim, &x));
  PetscCall(VecGetArray(x, &a));
  for (PetscInt i = 0; i < level->num_owned * level->dim; i++) a[i] = level->coords[i];
  PetscCall(VecRestoreArray(x, &a));
  PetscCall(LevelConform(level, level->dim, x));
  PetscCall(VecGhostGetLocalForm(x, &local));
  PetscCall(VecGetArray(local, &a));
  for (PetscInt i = 0; i < num; i++) level->coords[i] = PetscRealPart(a[i]);
  PetscCall(VecRestoreArray(local, &a));
  PetscCall(VecGhostRestoreLocalForm(x, &local));
  PetscCall(VecDestroy(&x));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshForestSetHanging(MeshForest forest, Level *level)
{
  const PetscInt most = ElementNumNodes(ELEMENT_LINE3);
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
    PetscCall(LevelMoveHanging_Private(level));
  } else {
    PetscCall(MatDestroy(&S));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* v := S v or S'v */
static PetscErrorCode LevelMultiply_Private(Level *level, PetscInt bs, PetscBool transpose, Vec v)
{
  Mat S;
  Vec product;

  PetscFunctionBeginUser;
  if (!level->conforming) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatCreateMAIJ(level->conforming, bs, &S));
  PetscCall(VecDuplicate(v, &product));
  PetscCall(transpose ? MatMultTranspose(S, v, product) : MatMult(S, v, product));
  PetscCall(VecCopy(product, v));
  PetscCall(VecGhostUpdateBegin(v, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGhostUpdateEnd(v, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecDestroy(&product));
  PetscCall(MatDestroy(&S));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelConform(Level *level, PetscInt bs, Vec v)
{
  PetscFunctionBeginUser;
  PetscCall(LevelMultiply_Private(level, bs, PETSC_FALSE, v));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelConformForces(Level *level, PetscInt bs, Vec v)
{
  PetscFunctionBeginUser;
  PetscCall(LevelMultiply_Private(level, bs, PETSC_TRUE, v));
  PetscFunctionReturn(PETSC_SUCCESS);
}

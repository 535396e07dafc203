/* layout.c -- Vecs and Mats in the layout of a level's nodes.

   A wrong preallocation makes assembly many times slower or an error, DMCreateMatrix() is slower than the
   assembly itself. Here the graph of the nodes is counted from the points of the mesh, without a search and
   with one exchange. */
#include "mesh/meshimpl.h"
#include "base/compat.h"
#include <petscbt.h>
#include <petscsf.h>

PetscErrorCode LevelCreateVec(Level *level, PetscInt bs, Vec *v)
{
  const PetscInt ghosts = level->num_nodes - level->num_owned;

  PetscFunctionBeginUser;
  PetscCall(VecCreateGhostBlock(level->comm, bs, bs * level->num_owned, PETSC_DETERMINE, ghosts,
                                level->node_global + level->num_owned, v));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelShareVec(Vec v, InsertMode mode)
{
  PetscFunctionBeginUser;
  PetscCall(VecGhostUpdateBegin(v, mode, SCATTER_REVERSE));
  PetscCall(VecGhostUpdateEnd(v, mode, SCATTER_REVERSE));
  PetscCall(VecGhostUpdateBegin(v, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGhostUpdateEnd(v, INSERT_VALUES, SCATTER_FORWARD));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The rank that owns each local node. [out] owner - [num_nodes], freed by the caller */
static PetscErrorCode LevelGetOwners_Private(const Level *level, PetscMPIInt **owner)
{
  PetscLayout layout;
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(level->comm, &rank));
  PetscCall(PetscLayoutCreateFromSizes(level->comm, level->num_owned, PETSC_DETERMINE, 1, &layout));
  PetscCall(PetscMalloc1(level->num_nodes, owner));
  for (PetscInt i = 0; i < level->num_owned; i++) (*owner)[i] = rank;
  for (PetscInt i = level->num_owned; i < level->num_nodes; i++)
    PetscCall(PetscLayoutFindOwner(layout, level->node_global[i], &(*owner)[i]));
  PetscCall(PetscLayoutDestroy(&layout));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Pairs of nodes of an element that are not on a common facet. */
typedef struct {
  PetscInt num, node[ELEMENT_MAX_NODES * (ELEMENT_MAX_NODES - 1) / 2][2];
} Pairs;

/* Whether two nodes of an element are on one facet; facets of edges are points. */
static PetscBool NodesShareFacet_Private(ElementType type, PetscInt a, PetscInt b)
{
  if (ElementFacetType(type) == ELEMENT_COUNT) return PETSC_FALSE;
  for (PetscInt f = 0; f < ElementNumFacets(type); f++) {
    const PetscInt *nodes = ElementFacetNodes(type, f);
    PetscInt        found = 0;

    for (PetscInt i = 0; i < ElementNumNodes(ElementFacetType(type)); i++) found += nodes[i] == a || nodes[i] == b;
    if (found == 2) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* [out] pairs - of every type [ELEMENT_COUNT] */
static void NodePairsSet_Private(Pairs pairs[])
{
  for (PetscInt t = 0; t < ELEMENT_COUNT; t++) {
    pairs[t].num = 0;
    for (PetscInt b = 0; b < ElementNumNodes((ElementType)t); b++) {
      for (PetscInt a = 0; a < b; a++) {
        if (NodesShareFacet_Private((ElementType)t, a, b)) continue;
        pairs[t].node[pairs[t].num][0]   = a;
        pairs[t].node[pairs[t].num++][1] = b;
      }
    }
  }
}

/* Counts two nodes as neighbours.
   [in,out] count - neighbours with the same owner, and with another [num_nodes][2] */
static void LevelCountPair_Private(const PetscMPIInt owner[], PetscInt a, PetscInt b, PetscScalar count[])
{
  count[2 * a + (owner[a] != owner[b])] += 1;
  count[2 * b + (owner[a] != owner[b])] += 1;
}

/* Neighbours of the local nodes that this rank answers for. Every pair of nodes in a common cell spans one
   smallest point of the mesh. It is an edge, or a cell of which no facet has both. The rank that owns this
   point counts the pair, so that sums over the ranks are exact. */
static PetscErrorCode LevelCountPairs_Private(Level *level, PetscScalar count[])
{
  const PetscInt *leaves;
  PetscInt        first, last, num_leaves;
  PetscMPIInt    *owner;
  Pairs           pairs[ELEMENT_COUNT];
  PetscSF         sf;
  PetscBT         ghost;

  PetscFunctionBeginUser;
  NodePairsSet_Private(pairs);
  PetscCall(LevelGetOwners_Private(level, &owner));
  for (PetscInt i = 0; i < level->num_owned; i++) count[2 * i] += 1;

  PetscCall(DMPlexGetChart(level->dm, &first, &last));
  PetscCall(PetscBTCreate(last - first, &ghost));
  PetscCall(DMGetPointSF(level->dm, &sf));
  PetscCall(PetscSFGetGraph(sf, NULL, &num_leaves, &leaves, NULL));
  for (PetscInt i = 0; i < num_leaves; i++) PetscCall(PetscBTSet(ghost, (leaves ? leaves[i] : i) - first));
  for (PetscInt depth = 1; depth <= level->dim; depth++) {
    PetscInt begin, end;

    PetscCall(DMPlexGetDepthStratum(level->dm, depth, &begin, &end));
    for (PetscInt p = begin; p < end; p++) {
      PetscInt    nodes[ELEMENT_MAX_NODES];
      ElementType type;

      if (PetscBTLookup(ghost, p - first)) continue;
      PetscCall(PointGetNodes(level, p, &type, nodes));
      for (PetscInt i = 0; i < pairs[type].num; i++)
        LevelCountPair_Private(owner, nodes[pairs[type].node[i][0]], nodes[pairs[type].node[i][1]], count);
    }
  }
  PetscCall(PetscBTDestroy(&ghost));
  PetscCall(PetscFree(owner));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelCreateMat(Level *level, PetscInt bs, Mat *A)
{
  const PetscScalar *total;
  PetscScalar       *count;
  PetscInt          *same, *other; /* blocks per block row */
  Vec                v, local;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, 2, &v)); // carries counts of ghosts to their owners

  PetscCall(VecGhostGetLocalForm(v, &local));
  PetscCall(VecGetArray(local, &count));
  PetscCall(LevelCountPairs_Private(level, count));
  PetscCall(VecRestoreArray(local, &count));
  PetscCall(VecGhostRestoreLocalForm(v, &local));
  PetscCall(LevelShareVec(v, ADD_VALUES));

  PetscCall(PetscMalloc2(level->num_owned, &same, level->num_owned, &other));
  PetscCall(VecGetArrayRead(v, &total));
  for (PetscInt i = 0; i < level->num_owned; i++) {
    same[i]  = (PetscInt)PetscRealPart(total[2 * i]);
    other[i] = (PetscInt)PetscRealPart(total[2 * i + 1]);
  }
  PetscCall(VecRestoreArrayRead(v, &total));
  PetscCall(MatCreate(level->comm, A));
  PetscCall(MatSetSizes(*A, bs * level->num_owned, bs * level->num_owned, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetBlockSize(*A, bs));
  PetscCall(MatSetType(*A, MATAIJ));
  PetscCall(MatXAIJSetPreallocation(*A, bs, same, other, NULL, NULL));
  PetscCall(PetscFree2(same, other));
  PetscCall(VecDestroy(&v));
  PetscFunctionReturn(PETSC_SUCCESS);
}

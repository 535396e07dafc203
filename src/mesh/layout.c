/* layout.c -- Vecs and Mats in the layout of a level's nodes.

   A wrong preallocation makes assembly many times slower or an error, DMCreateMatrix() is slower than the assembly
   itself. Here the graph of the nodes is counted from the points of the mesh, without a search and with one
   exchange. */
#include "room.h"
#include <mortise/compat.h>
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
  for (PetscInt i = 0; i < level->num_owned; ++i) (*owner)[i] = rank;
  for (PetscInt i = level->num_owned; i < level->num_nodes; ++i)
    PetscCall(PetscLayoutFindOwner(layout, level->node_global[i], &(*owner)[i]));
  PetscCall(PetscLayoutDestroy(&layout));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Two nodes are neighbours. [in,out] count - neighbours with the same owner, and with another [num_nodes][2] */
static void CountPair_Private(const PetscMPIInt owner[], PetscInt a, PetscInt b, PetscScalar count[])
{
  count[2 * a + (owner[a] != owner[b])] += 1;
  count[2 * b + (owner[a] != owner[b])] += 1;
}

/* Neighbours of the local nodes that this rank answers for. Every pair of nodes in a common cell spans one smallest
   point of the mesh: a vertex, an edge, or the inside of a quad. The rank that owns this point counts the pair, so
   that sums over the ranks are exact. */
static PetscErrorCode LevelCountPairs_Private(Level *level, PetscScalar count[])
{
  const PetscInt *leaves;
  PetscInt        begin, end, vertex_begin, num_leaves;
  PetscMPIInt    *owner;
  PetscSF         sf;
  PetscBT         ghost;

  PetscFunctionBeginUser;
  PetscCall(LevelGetOwners_Private(level, &owner));
  for (PetscInt i = 0; i < level->num_owned; ++i) count[2 * i] += 1;

  PetscCall(DMPlexGetDepthStratum(level->dm, 0, &vertex_begin, NULL));
  PetscCall(DMPlexGetHeightStratum(level->dm, 1, &begin, &end));
  PetscCall(PetscBTCreate(end - begin, &ghost));
  PetscCall(DMGetPointSF(level->dm, &sf));
  PetscCall(PetscSFGetGraph(sf, NULL, &num_leaves, &leaves, NULL));
  for (PetscInt i = 0; i < num_leaves; ++i) {
    const PetscInt point = leaves ? leaves[i] : i;

    if (point >= begin && point < end) PetscCall(PetscBTSet(ghost, point - begin));
  }
  for (PetscInt e = begin; e < end; ++e) {
    const PetscInt *ends;

    if (PetscBTLookup(ghost, e - begin)) continue;
    PetscCall(DMPlexGetCone(level->dm, e, &ends));
    CountPair_Private(owner, level->vertex_node[ends[0] - vertex_begin], level->vertex_node[ends[1] - vertex_begin],
                      count);
  }
  for (PetscInt c = 0; c < level->num_cells; ++c) {
    const PetscInt *nodes = &level->cell_nodes[level->cell_start[c]];

    if (level->cell_type[c] != ELEMENT_QUAD4) continue;
    CountPair_Private(owner, nodes[0], nodes[2], count);
    CountPair_Private(owner, nodes[1], nodes[3], count);
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
  for (PetscInt i = 0; i < level->num_owned; ++i) {
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

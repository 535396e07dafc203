/* adapt.c -- one more level by bisection or splitting of marked cells.

   The first rank refines, in integer arithmetic. Its new lists of cells become one DMPlex, which is
   partitioned anew: so every level is balanced, and sides that may meet share ranks. For the prolongation,
   the first rank gathers the global nodes of all cells of both levels. It knows the parent of each cell, and
   the position of the cell in it. */
#include "base/compat.h"
#include "level/leveltables.h"
#include "mesh/forest.h"
#include "mesh/hanging.h"
#include "mesh/mesh.h"
#include "mesh/meshforest.h"
#include "mesh/tree.h"
#include "mesh/treenormals.h"
#include "partition/partition.h"
#include "refinement/levelrefine.h"
#include "side/normalerrors.h"

/* Gathers the marks of all ranks. Collective.
   [out] all - in the order of the lists [forest->num_cells] on the first rank, NULL on others; owned by the
   caller */
static PetscErrorCode ForestGatherMarks_Private(MeshForest forest, const Level *level, const PetscInt marked[],
                                                PetscInt **all)
{
  PetscInt *gathered = NULL;

  PetscFunctionBeginUser;
  *all = NULL;
  if (forest->num_cells) PetscCall(PetscMalloc1(forest->num_cells, &gathered));
  PetscCallMPI(MPI_Gatherv(marked, (PetscMPIInt)level->num_cells, MPIU_INT, gathered, forest->counts, forest->begins,
                           MPIU_INT, 0, level->comm));
  if (forest->num_cells) PetscCall(PetscMalloc1(forest->num_cells, all));
  for (PetscInt i = 0; i < forest->num_cells; i++) (*all)[forest->gathered[i]] = gathered[i];
  PetscCall(PetscFree(gathered));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets the rows of the nodes of a child that are not set yet.
   [in] fine, coarse - the child and its parent; [in,out] done - whether a row is set, by global node */
static PetscErrorCode ProlongationSetCell_Private(const Tree *tree, PetscInt child, const ForestCell *fine,
                                                  const ForestCell *coarse, PetscBool done[], Mat P)
{
  const PetscInt num = ElementNumNodes((ElementType)coarse->type);
  PetscReal      weights[ELEMENT_MAX_NODES * ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  TreeWeights(tree, child, fine, coarse, weights);
  for (PetscInt k = 0; k < ElementNumNodes((ElementType)fine->type); k++) {
    if (done[fine->nodes[k]]) continue;
    done[fine->nodes[k]] = PETSC_TRUE;
    for (PetscInt i = 0; i < num; i++) { // weights are dyadic numbers: zeros are exact
      if (weights[k * num + i] != 0)
        PetscCall(MatSetValue(P, fine->nodes[k], coarse->nodes[i], weights[k * num + i], INSERT_VALUES));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Creates the prolongation of the fine level. Collective.
   [in] before - cells of the coarse level, on the first rank */
static PetscErrorCode MeshForestProlong_Private(MeshForest forest, const ForestCell before[], const Level *coarse,
                                                Level *fine)
{
  Mat P;

  PetscFunctionBeginUser;
  PetscCall(MatCreate(fine->comm, &P));
  PetscCall(MatSetSizes(P, fine->num_owned, coarse->num_owned, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetType(P, MATAIJ));
  PetscCall(
      MatSeqAIJSetPreallocation(P, ELEMENT_MAX_NODES, NULL)); // on several ranks this has no effect, on one the next
  PetscCall(MatMPIAIJSetPreallocation(P, ELEMENT_MAX_NODES, NULL, ELEMENT_MAX_NODES, NULL));
  if (forest->num_cells) {
    PetscBool *done;
    PetscInt   first = 0, first_before = 0;

    PetscCall(PetscCalloc1(fine->num_global, &done));
    for (PetscInt b = 0; b < forest->num_bodies; b++) {
      const Tree *tree = &forest->tree[b];

      for (PetscInt c = 0; c < tree->mesh.num_cells; c++)
        PetscCall(ProlongationSetCell_Private(tree, c, &forest->cell[first + c],
                                              &before[first_before + tree->mesh.parent[c]], done, P));
      first += tree->mesh.num_cells;
      first_before += tree->num_before;
    }
    PetscCall(PetscFree(done));
  }
  PetscCall(MatAssemblyBegin(P, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(P, MAT_FINAL_ASSEMBLY));
  fine->prolongation = P;
  if (coarse->conforming) {
    PetscCall(MatMatMult(P, coarse->conforming, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &fine->prolongation));
    PetscCall(MatProductClear(fine->prolongation)); // it would keep its factors
    PetscCall(MatDestroy(&P));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets the ages of the cells of a tree: parents with one child were not bisected.
   [in] before - its cells before; [out] cells */
static PetscErrorCode TreeSetAges_Private(const Tree *tree, const ForestCell before[], ForestCell cells[])
{
  const Bisection *mesh = &tree->mesh;
  PetscInt        *children;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(tree->num_before, &children));
  for (PetscInt c = 0; c < mesh->num_cells; c++) children[mesh->parent[c]]++;
  for (PetscInt c = 0; c < mesh->num_cells; c++) {
    const PetscInt age = before[mesh->parent[c]].age;

    cells[c].age = children[mesh->parent[c]] > 1 ? 0 : age == NOT_BISECTED ? NOT_BISECTED : age + 1;
  }
  PetscCall(PetscFree(children));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sends the ages of all cells to their ranks. Collective.
   [in] before - cells of the coarse level, on the first rank */
static PetscErrorCode MeshForestSetAges_Private(MeshForest forest, const ForestCell before[], Level *fine)
{
  PetscInt *all = NULL, first = 0, first_before = 0;

  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < forest->num_bodies && forest->num_cells; b++) {
    PetscCall(TreeSetAges_Private(&forest->tree[b], &before[first_before], &forest->cell[first]));
    first += forest->tree[b].mesh.num_cells;
    first_before += forest->tree[b].num_before;
  }
  if (forest->num_cells) PetscCall(PetscMalloc1(forest->num_cells, &all));
  for (PetscInt i = 0; i < forest->num_cells; i++) all[i] = forest->cell[forest->gathered[i]].age;
  PetscCall(PetscMalloc1(fine->num_cells, &fine->cell_age));
  PetscCallMPI(MPI_Scatterv(all, forest->counts, forest->begins, MPIU_INT, fine->cell_age, (PetscMPIInt)fine->num_cells,
                            MPIU_INT, 0, fine->comm));
  PetscCall(PetscFree(all));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshAdapt(Mesh mesh, const PetscInt marked[])
{
  MeshForest  forest = mesh->forest;
  ForestCell *before;
  PetscInt   *all;
  PetscInt   *origin, cell = 0, halvings = 0;
  Curves      curves;
  Level      *fine;
  DM          dm;

  PetscFunctionBeginUser;
  PetscCall(ForestGatherMarks_Private(forest, MeshFinest(mesh), marked, &all));
  for (PetscInt c = 0; c < MeshFinest(mesh)->num_cells; c++)
    halvings = PetscMax(halvings, BisectionGetHalvings(marked[c]));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &halvings, 1, MPIU_INT, MPI_MAX, mesh->scene->comm));
  for (PetscInt b = 0; b < forest->num_bodies && all; b++) {
    const PetscInt num = forest->tree[b].mesh.num_cells;

    PetscCall(TreeRefine(&forest->tree[b], &mesh->scene->bodies[b], &all[cell]));
    cell += num;
  }
  PetscCall(PetscFree(all));
  before       = forest->cell;
  forest->cell = NULL;
  PetscCheck(mesh->num_levels < MESH_MAX_ADAPTED, mesh->scene->comm, PETSC_ERR_SUP, "More than %d levels",
             MESH_MAX_ADAPTED);
  fine = &mesh->levels[mesh->num_levels];
  PetscCall(MeshForestMerge(mesh->scene, forest, &dm, &curves));
  PetscCall(PartitionDistribute(mesh->scene, 0, &dm, &curves, &origin));
  PetscCall(LevelCreateFromPlex(mesh->scene, dm, &curves, fine));
  fine->halvings = halvings;
  PetscCall(MeshForestGather(forest, fine, origin));
  PetscCall(MeshForestSetHanging(forest, fine));
  PetscCall(MeshForestSetNormals(forest, fine));
  PetscCall(MeshForestSetAges_Private(forest, before, fine));
  PetscCall(MeshForestProlong_Private(forest, before, fine - 1, fine));
  PetscCall(LevelFollowNormalErrors(fine - 1, fine));
  mesh->num_levels++;
  PetscCall(LevelTurnCells(fine, NULL));
  PetscCall(CurvesDestroy(&curves));
  PetscCall(DMDestroy(&dm));
  PetscCall(PetscFree(origin));
  PetscCall(PetscFree(before));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshReturn(Mesh mesh, PetscInt num_levels)
{
  PetscFunctionBeginUser;
  for (PetscInt l = num_levels; l < mesh->num_levels; l++) PetscCall(LevelDestroy(&mesh->levels[l]));
  mesh->num_levels   = num_levels;
  mesh->forest->lost = PETSC_TRUE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscBool MeshCanAdapt(Mesh mesh)
{
  return (PetscBool)(mesh->forest && !mesh->forest->lost);
}

PetscBool MeshIsCut(Mesh mesh, PetscInt body)
{
  return (PetscBool)(mesh->forest && mesh->forest->cut[body]);
}

PetscErrorCode MeshAdaptAll(Mesh mesh)
{
  const PetscInt num = MeshFinest(mesh)->num_cells;
  PetscInt      *marked;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(num, &marked));
  for (PetscInt c = 0; c < num; c++) marked[c] = 1;
  PetscCall(MeshAdapt(mesh, marked));
  PetscCall(PetscFree(marked));
  PetscFunctionReturn(PETSC_SUCCESS);
}

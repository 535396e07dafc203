/* sidesums.c -- sums over the facets around each node of a side. */
#include "side/sidesums.h"
#include "base/compat.h"
#include "level/ghosted.h"

enum { F = ELEMENT_MAX_FACET_NODES };

PetscReal SideGetPosition(const Level *level, const Facets *facets, PetscInt f, PetscInt i, PetscInt k)
{
  const PetscInt at = facets->nodes[f * F + i] * level->dim + k;

  return level->coords[at] + (level->hanging.rise ? level->hanging.rise[at] : 0);
}

void SideGetWay(const Level *level, const Facets *facets, PetscInt f, PetscInt i, PetscInt j, PetscReal d[])
{
  for (PetscInt k = 0; k < level->dim; k++)
    d[k] = SideGetPosition(level, facets, f, j, k) - SideGetPosition(level, facets, f, i, k);
}

/* Marks local nodes with a facet on any rank by 1, others by 0, then those with one on this rank by 2.
   Collective. [out] mark - [num_nodes], freed by the caller */
static PetscErrorCode LevelMarkSide_Private(Level *level, const Facets *facets, PetscInt **mark)
{
  PetscScalar *a;
  Vec          marks;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(level->num_nodes, mark));
  PetscCall(LevelCreateVec(level, 1, &marks));
  PetscCall(GhostedGetArray(marks, &a));
  for (PetscInt f = 0; f < facets->num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); i++) a[facets->nodes[f * F + i]] = 1;
  }
  PetscCall(GhostedRestoreArray(marks, &a));
  PetscCall(VecGhostUpdateBegin(marks, ADD_VALUES, SCATTER_REVERSE));
  PetscCall(VecGhostUpdateEnd(marks, ADD_VALUES, SCATTER_REVERSE));
  PetscCall(GhostedGetArray(marks, &a));
  for (PetscInt i = 0; i < level->num_nodes; i++) (*mark)[i] = PetscRealPart(a[i]) > 0 ? 1 : 0;
  PetscCall(GhostedRestoreArray(marks, &a));
  for (PetscInt f = 0; f < facets->num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); i++) (*mark)[facets->nodes[f * F + i]] = 2;
  }
  PetscCall(VecDestroy(&marks));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Finds the numbers of nodes of other ranks among the nodes of all. Collective.
   [in] own - number of each local node among those of the side here */
static PetscErrorCode SideSumsJoin_Private(Level *level, const PetscInt own[], const PetscInt mark[], SideSums *sums)
{
  PetscInt     begin, num = 0;
  PetscScalar *a;
  Vec          numbers;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Scan(&sums->num_owned, &begin, 1, MPIU_INT, MPI_SUM, level->comm));
  begin -= sums->num_owned;
  PetscCall(LevelCreateVec(level, 1, &numbers));
  PetscCall(GhostedGetArray(numbers, &a));
  for (PetscInt i = 0; i < level->num_owned; i++) a[i] = (PetscScalar)(begin + own[i]);
  PetscCall(GhostedRestoreArray(numbers, &a));
  PetscCall(LevelShareVec(numbers, INSERT_VALUES));
  PetscCall(GhostedGetArray(numbers, &a));
  PetscCall(PetscMalloc1(sums->num - sums->num_owned, &sums->others));
  for (PetscInt i = level->num_owned; i < level->num_nodes; i++) {
    if (mark[i] == 2) sums->others[num++] = (PetscInt)PetscRealPart(a[i]);
  }
  PetscCall(GhostedRestoreArray(numbers, &a));
  PetscCall(VecDestroy(&numbers));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SideSumsCreate(Level *level, const Facets *facets, SideSums *sums)
{
  PetscInt *mark, *own;

  PetscFunctionBeginUser;
  *sums = (SideSums){.facets = facets, .comm = level->comm};
  PetscCallMPI(MPI_Comm_size(level->comm, &sums->size));
  PetscCall(LevelMarkSide_Private(level, facets, &mark));
  PetscCall(PetscMalloc1(level->num_nodes, &own));
  for (PetscInt i = 0; i < level->num_nodes; i++) {
    own[i] = sums->num;
    sums->num += mark[i] == 2 || (mark[i] && i < level->num_owned) ? 1 : 0;
    if (i < level->num_owned) sums->num_owned = sums->num;
  }
  if (sums->size > 1) PetscCall(SideSumsJoin_Private(level, own, mark, sums));
  PetscCall(PetscCalloc1(facets->num * F, &sums->corner));
  for (PetscInt f = 0; f < facets->num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); i++)
      sums->corner[f * F + i] = own[facets->nodes[f * F + i]];
  }
  PetscCall(PetscFree(own));
  PetscCall(PetscFree(mark));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SideSumsDestroy(SideSums *sums)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(sums->corner));
  PetscCall(PetscFree(sums->others));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SideSumsShare(const SideSums *sums, PetscInt bs, PetscReal values[])
{
  Vec v;

  PetscFunctionBeginUser;
  if (sums->size == 1) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecCreateGhostBlockWithArray(sums->comm, bs, bs * sums->num_owned, PETSC_DETERMINE,
                                         sums->num - sums->num_owned, sums->others, values, &v));
  PetscCall(LevelShareVec(v, ADD_VALUES));
  PetscCall(VecDestroy(&v));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SideSumAtNodes(const SideSums *nodes, PetscInt bs, const PetscReal skip[], PetscReal values[])
{
  const Facets *facets = nodes->facets;
  PetscReal    *sums;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(nodes->num * bs, &sums));
  for (PetscInt way = 0; way < 2; way++) { // adds corners to the sums, then gives corners these
    for (PetscInt f = 0; f < facets->num; f++) {
      for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); i++) {
        const PetscInt c = f * F + i;

        if (skip && skip[c] != 0) continue;
        for (PetscInt k = 0; k < bs; k++) {
          if (way == 0)
            sums[nodes->corner[c] * bs + k] += values[c * bs + k];
          else
            values[c * bs + k] = sums[nodes->corner[c] * bs + k];
        }
      }
    }
    if (way == 0) PetscCall(SideSumsShare(nodes, bs, sums));
  }
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

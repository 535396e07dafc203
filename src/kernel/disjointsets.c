/* disjointsets.c -- union and find. The smaller root stays: no rank is kept, since paths are halved. */
#include "kernel/disjointsets.h"

void DisjointSetsInitialize(PetscInt num, PetscInt parent[])
{
  for (PetscInt i = 0; i < num; i++) parent[i] = i;
}

PetscInt DisjointSetsFind(PetscInt parent[], PetscInt point)
{
  while (parent[point] != point) point = parent[point] = parent[parent[point]];
  return point;
}

void DisjointSetsUnite(PetscInt parent[], PetscInt a, PetscInt b)
{
  const PetscInt roots[] = {DisjointSetsFind(parent, a), DisjointSetsFind(parent, b)};

  parent[PetscMax(roots[0], roots[1])] = PetscMin(roots[0], roots[1]);
}

/* disjointsets.h -- union and find with path halving (Tarjan and van Leeuwen 1984), for connected components.

   A set is a tree of points, and its representative is the root. */
#ifndef MORTISE_DISJOINTSETS_H
#define MORTISE_DISJOINTSETS_H

#include <petscsys.h>

/* Each point is a set. [out] parent - [num] */
void DisjointSetsInitialize(PetscInt num, PetscInt parent[]);

/* The representative of the set of a point. [in,out] parent - paths in it become shorter */
PetscInt DisjointSetsFind(PetscInt parent[], PetscInt point);

/* Unites the sets of two points. The smaller representative is that of the union. */
void DisjointSetsUnite(PetscInt parent[], PetscInt a, PetscInt b);

#endif

/* meshforest.h -- bodies whose cells are bisected or split: lists of cells on the first rank.

   A forest has the latest mesh as lists, in the order of its bisection, and the cells and global nodes of the
   latest level. From marked cells it makes the lists of the next mesh. */
#ifndef MORTISE_MESHFOREST_H
#define MORTISE_MESHFOREST_H

#include "bodies/bodylist.h"
#include "kernel/dilatation.h"
#include "mesh/tree.h"
#include "refinement/curves.h"

/* What the first rank knows of a cell of a level. */
typedef struct {
  PetscInt cell;                           /* in the lists, body after body */
  PetscInt vertex[BISECT_MAX_VERTICES];    /* in the lists of all bodies, in the order of the level */
  PetscInt type, nodes[ELEMENT_MAX_NODES]; /* global nodes of the level */
  PetscInt age;                            /* Level.cell_age */
  PetscInt inner; /* bits of its facets, in the order of the level: beside hanging nodes, in the body */
} ForestCell;

struct _n_MeshForest {
  PetscInt     num_bodies;
  Tree        *tree;            /* [num_bodies]; cells and vertices on the first rank alone */
  SideNames   *names;           /* [num_bodies] */
  PetscBool   *cut;             /* whether a body had other cells than simplices, on all ranks [num_bodies] */
  PetscInt     num_cells;       /* on the first rank, of the latest level */
  ForestCell  *cell;            /* by their number in the lists [num_cells] */
  PetscInt    *gathered;        /* the list's number of each cell, rank after rank [num_cells] */
  PetscMPIInt *counts, *begins; /* cells of every rank; NULL on others [size] */
  PetscBool    lost;            /* whether the lists are those of a level that MeshReturn() has destroyed */
};
typedef struct _n_MeshForest *MeshForest;

/* Takes over the lists; quadrilaterals and hexahedra are cut into simplices, unless they are kept.
   Collective.
   [in,out] lists, names - of the first rank, empty afterwards [num_bodies] */
PetscErrorCode MeshForestCreate(Scene scene, BodyList lists[], SideNames names[], MeshForest *forest);
PetscErrorCode MeshForestDestroy(MeshForest *forest);
/* The DM of the latest lists, all of it on the first rank. Collective.
   [out] dm, curves - owned by the caller */
PetscErrorCode MeshForestMerge(Scene scene, MeshForest forest, DM *dm, Curves *curves);
/* Gathers the cells and nodes of the level of the latest lists on the first rank. Collective.
   [in] origin - of PartitionDistribute() */
PetscErrorCode MeshForestGather(MeshForest forest, const Level *level, const PetscInt origin[]);

#endif

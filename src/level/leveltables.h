/* leveltables.h -- the making of a level's tables from a DMPlex.

   Functions are not collective unless they say so. */
#ifndef MORTISE_LEVELTABLES_H
#define MORTISE_LEVELTABLES_H

#include "level/level.h"

/* The highest order of any body. */
PetscInt SceneMaxOrder(Scene scene);
/* Tables for the cells of a DM, which are empty. [out] level - owned by the caller, LevelDestroy() */
PetscErrorCode LevelBegin(Scene scene, DM dm, Level *level);
/* Tables of one DM in its order of cells, with nodes up to an order, without positions. Collective. */
PetscErrorCode LevelCreateTables(Scene scene, DM dm, PetscInt max_order, Level *level);
/* The same on the cells of a level that has its tables. [in] scene - may have other orders of bodies */
PetscErrorCode LevelCreateOnCells(Scene scene, const Level *level, Level *other);
/* Parts of LevelCreateTables(): cell_material and cell_body, from the label. */
PetscErrorCode LevelSetCellMaterials(Level *level);
/* cell_start, cell_type, cell_nodes from the present point_node. */
PetscErrorCode LevelSetCells(Level *level);
/* Nodes: number, owner, body, local section of the DM, and cells by LevelSetCells(). Collective. */
PetscErrorCode LevelSetNodes(Level *level, PetscInt max_order);
PetscErrorCode LevelDestroy(Level *level);

/* Vertices of a cell, which are the first of its nodes. */
PetscInt LevelNumVertices(const Level *level, PetscInt cell);
/* A copy of the level with its nodes before maps; arrays are borrowed. */
Level LevelBeforeMap(const Level *level);

/* Orients all cells anticlockwise, or solids so that facets are anticlockwise from outside. User errors: a
   degenerate or tangled cell, a map that folds a body. Collective.
   [out] sound - false in place of a user error, the same on all ranks; optional, may be NULL */
PetscErrorCode LevelTurnCells(Level *level, PetscBool *sound);
/* Reverses the orientation of a cell with these nodes: its mirror image in the plane xi_0 = xi_1. */
void CellReverse(ElementType type, PetscInt nodes[]);

#endif

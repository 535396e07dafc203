/* level.c -- the tables of one DMPlex, in the order in which they need each other. */
#include "room.h"
#include <mortise/compat.h>

PetscInt LevelNumVertices(const Level *level, PetscInt cell)
{
  return ElementNumNodes(ElementLinear((ElementType)level->cell_type[cell]));
}

/* Bodies tell which points have nodes and which map applies. */
PetscErrorCode LevelCreateTables(Scene scene, DM dm, PetscInt max_order, Level *level)
{
  PetscFunctionBeginUser;
  *level = (Level){.comm = scene->comm, .dm = dm, .dim = scene->dim, .scene = scene};
  PetscCall(PetscObjectReference((PetscObject)dm));
  PetscCall(LevelSetCellBodies(level));
  PetscCall(LevelSetNodes(level, max_order));
  PetscCall(LevelSetCells(level));
  PetscCall(LevelSetCoords(level));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelCreate(Scene scene, DM dm, Level *level)
{
  PetscInt max_order = 1;

  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < scene->num_bodies; ++b) max_order = PetscMax(max_order, scene->bodies[b].order);
  PetscCall(LevelCreateTables(scene, dm, max_order, level));
  PetscCall(LevelTurnCells(level));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelDestroy(Level *level)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(level->point_node));
  PetscCall(PetscFree3(level->node_global, level->node_body, level->coords));
  PetscCall(PetscFree3(level->cell_start, level->cell_type, level->cell_body));
  PetscCall(PetscFree(level->cell_nodes));
  PetscCall(MatDestroy(&level->prolongation));
  PetscCall(DMDestroy(&level->dm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

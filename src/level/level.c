/* level.c -- the tables of one DMPlex. */
#include "base/compat.h"
#include "level/leveltables.h"

PetscInt LevelNumVertices(const Level *level, PetscInt cell)
{
  return ElementNumNodes(ElementLinear((ElementType)level->cell_type[cell]));
}

PetscErrorCode LevelBegin(Scene scene, DM dm, Level *level)
{
  PetscInt begin, end;

  PetscFunctionBeginUser;
  *level = (Level){.comm = scene->comm, .dm = dm, .dim = scene->dim, .scene = scene};
  PetscCall(PetscObjectReference((PetscObject)dm));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &begin, &end));
  level->num_cells = end - begin;
  PetscCall(PetscCalloc3(level->num_cells + 1, &level->cell_start, level->num_cells, &level->cell_type,
                         level->num_cells, &level->cell_body));
  level->cell_material = level->cell_body;
  if (scene->num_regions) PetscCall(PetscCalloc1(level->num_cells, &level->cell_material));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The orders of bodies determine the points with nodes. */
PetscErrorCode LevelCreateTables(Scene scene, DM dm, PetscInt max_order, Level *level)
{
  PetscFunctionBeginUser;
  PetscCall(LevelBegin(scene, dm, level));
  PetscCall(LevelSetCellMaterials(level));
  PetscCall(LevelSetNodes(level, max_order));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelCreateOnCells(Scene scene, const Level *level, Level *other)
{
  DM dm;

  PetscFunctionBeginUser;
  PetscCall(DMClone(level->dm, &dm)); // a DM has one layout of nodes
  PetscCall(LevelBegin(scene, dm, other));
  PetscCall(PetscArraycpy(other->cell_material, level->cell_material, level->num_cells));
  PetscCall(PetscArraycpy(other->cell_body, level->cell_body, level->num_cells));
  PetscCall(LevelSetNodes(other, SceneMaxOrder(scene)));
  PetscCall(DMDestroy(&dm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscInt SceneMaxOrder(Scene scene)
{
  PetscInt max_order = 1;

  for (PetscInt b = 0; b < scene->num_bodies; b++) max_order = PetscMax(max_order, scene->bodies[b].order);
  return max_order;
}

PetscErrorCode LevelGetBox(const Level *level, PetscInt body, PetscReal lower[], PetscReal upper[])
{
  PetscReal most[6]; // of -x and of x

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < 6; k++) most[k] = -PETSC_MAX_REAL;
  for (PetscInt a = 0; a < level->num_owned; a++) {
    if (body >= 0 && level->node_body[a] != body) continue;
    for (PetscInt k = 0; k < level->dim; k++) {
      most[k]     = PetscMax(most[k], -level->coords[a * level->dim + k]);
      most[3 + k] = PetscMax(most[3 + k], level->coords[a * level->dim + k]);
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, most, 6, MPIU_REAL, MPIU_MAX, level->comm));
  for (PetscInt k = 0; k < level->dim; k++) {
    lower[k] = -most[k];
    upper[k] = most[3 + k];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

Level LevelBeforeMap(const Level *level)
{
  Level plain = *level;

  if (level->unmapped) plain.coords = level->unmapped;
  return plain;
}

PetscErrorCode LevelDestroy(Level *level)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(level->point_node));
  PetscCall(PetscFree3(level->node_global, level->node_body, level->coords));
  PetscCall(PetscFree(level->unmapped));
  if (level->cell_material != level->cell_body) PetscCall(PetscFree(level->cell_material));
  PetscCall(PetscFree(level->cell_age));
  PetscCall(PetscFree3(level->cell_start, level->cell_type, level->cell_body));
  PetscCall(PetscFree(level->cell_nodes));
  PetscCall(MatDestroy(&level->prolongation));
  PetscCall(MatDestroy(&level->conforming));
  PetscCall(VecDestroy(&level->arcs));
  PetscCall(VecDestroy(&level->normal_errors));
  PetscCall(PetscFree(level->inner));
  PetscCall(PetscFree(level->hanging.start));
  PetscCall(PetscFree(level->hanging.node));
  PetscCall(PetscFree(level->hanging.weight));
  PetscCall(PetscFree(level->hanging.rise));
  PetscCall(DMDestroy(&level->dm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* bodycurves.c -- curved edges of files under bodies of order 1.

   A body of order 1 has no nodes on edges that could keep the curves of its file. The same bodies in order 2,
   on the same points of the mesh, have such nodes. Refined together with the mesh, they give the positions of
   its new vertices. */
#include "base/compat.h"
#include "level/leveltables.h"
#include "level/plexpoints.h"
#include "mesh/bodycurves.h"
#include "refinement/levelrefine.h"

struct _n_MeshShape {
  struct _n_Scene scene; /* as the mesh's, but of order 2 where a file is */
  Level           level; /* on the points of the finest level of the mesh */
};

PetscErrorCode MeshShapeCreate(Scene scene, const Level *level, const Curves *curves, MeshShape *shape)
{
  Scene    own;
  PetscInt num = 0;

  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < scene->num_bodies; b++) num += scene->bodies[b].straightened;
  if (!num) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscNew(shape));
  own  = &(*shape)->scene;
  *own = *scene;
  PetscCall(PetscMalloc1(scene->num_bodies, &own->bodies));
  PetscCall(PetscArraycpy(own->bodies, scene->bodies, scene->num_bodies));
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    if (scene->bodies[b].straightened) own->bodies[b].order = 2;
  }
  PetscCall(LevelCreateOnCells(own, level, &(*shape)->level));
  PetscCall(LevelSetCoords(&(*shape)->level, curves));
  PetscCall(LevelBeginArcs(&(*shape)->level));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Refinement numbers the points of equal meshes equally. */
PetscErrorCode MeshShapeRefine(MeshShape shape, Level *fine)
{
  const PetscInt dim = fine->dim;
  Level          coarse;
  ArcSides       sides;

  PetscFunctionBeginUser;
  if (!shape) PetscFunctionReturn(PETSC_SUCCESS);
  coarse = shape->level;
  PetscCall(ArcSidesCreate(&coarse, 1, &sides));
  PetscCall(LevelRefine(&coarse, &sides, &shape->level));
  PetscCall(ArcSidesDestroy(&sides));
  PetscCall(LevelDestroy(&coarse));
  PetscCall(MatDestroy(&shape->level.prolongation)); // used by the refinement only
  for (PetscInt p = fine->point_begin; p < fine->point_end; p++) {
    const PetscInt node = PointGetNode(fine, p), other = PointGetNode(&shape->level, p);

    if (node >= 0) PetscCall(PetscArraycpy(&fine->coords[node * dim], &shape->level.coords[other * dim], dim));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshShapeDestroy(MeshShape *shape)
{
  PetscFunctionBeginUser;
  if (!*shape) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(LevelDestroy(&(*shape)->level));
  PetscCall(PetscFree((*shape)->scene.bodies));
  PetscCall(PetscFree(*shape));
  PetscFunctionReturn(PETSC_SUCCESS);
}

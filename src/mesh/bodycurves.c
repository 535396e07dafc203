/* bodycurves.c -- curved edges of files under bodies of order 1.

   A body of order 1 has no nodes on edges that could keep the curves of its file. The same bodies in order 2,
   on the same points of the mesh, have such nodes. Refined together with the mesh, they give the positions of
   its new vertices. */
#include "mesh/meshimpl.h"
#include "base/compat.h"

struct _n_MeshShape {
  struct _n_Scene scene; /* as the mesh's, but of order 2 where a file is */
  Level           level; /* on the points of the finest level of the mesh */
};

PetscErrorCode MeshShapeCreate(Mesh mesh, const Curves *curves)
{
  Scene    scene = mesh->scene, own;
  PetscInt num   = 0;

  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < scene->num_bodies; b++) num += scene->bodies[b].straightened;
  if (!num) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscNew(&mesh->shape));
  own  = &mesh->shape->scene;
  *own = *scene;
  PetscCall(PetscMalloc1(scene->num_bodies, &own->bodies));
  PetscCall(PetscArraycpy(own->bodies, scene->bodies, scene->num_bodies));
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    if (scene->bodies[b].straightened) own->bodies[b].order = 2;
  }
  PetscCall(LevelCreateOnCells(own, MeshFinest(mesh), &mesh->shape->level));
  PetscCall(LevelSetCoords(&mesh->shape->level, curves));
  PetscCall(LevelBeginArcs(&mesh->shape->level));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Refinement numbers the points of equal meshes equally. */
PetscErrorCode MeshShapeRefine(Mesh mesh)
{
  Level   *fine = MeshFinest(mesh), coarse;
  PetscInt dim  = fine->dim;
  ArcSides sides;

  PetscFunctionBeginUser;
  if (!mesh->shape) PetscFunctionReturn(PETSC_SUCCESS);
  coarse = mesh->shape->level;
  PetscCall(ArcSidesCreate(&coarse, 1, &sides));
  PetscCall(LevelRefine(&coarse, &sides, &mesh->shape->level));
  PetscCall(ArcSidesDestroy(&sides));
  PetscCall(LevelDestroy(&coarse));
  PetscCall(MatDestroy(&mesh->shape->level.prolongation)); // used by the refinement only
  for (PetscInt p = fine->point_begin; p < fine->point_end; p++) {
    const PetscInt node = PointGetNode(fine, p), other = PointGetNode(&mesh->shape->level, p);

    if (node >= 0) PetscCall(PetscArraycpy(&fine->coords[node * dim], &mesh->shape->level.coords[other * dim], dim));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshShapeDestroy(Mesh mesh)
{
  PetscFunctionBeginUser;
  if (!mesh->shape) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(LevelDestroy(&mesh->shape->level));
  PetscCall(PetscFree(mesh->shape->scene.bodies));
  PetscCall(PetscFree(mesh->shape));
  PetscFunctionReturn(PETSC_SUCCESS);
}

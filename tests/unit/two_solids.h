/* two_solids.h -- a pair of two solids made in code, for unit tests of pairs in space. */
#ifndef TEST_TWO_SOLIDS_H
#define TEST_TWO_SOLIDS_H

#include "contact/pairs.h"
#include "two_boxes.h"

enum { DIM = 3 };

/* A box of hexahedra or tetrahedra. */
static inline void SetSolid(SceneBody *body, const char *name, ElementType cell, PetscInt nx, PetscInt ny, PetscInt nz,
                            const PetscReal lower[], const PetscReal upper[])
{
  const PetscInt faces[DIM] = {nx, ny, nz};

  body->name    = (char *)name;
  body->order   = ElementOrder(cell);
  body->simplex = (PetscBool)(ElementLinear(cell) == ELEMENT_TET4);
  for (PetscInt k = 0; k < DIM; k++) {
    body->faces[k] = faces[k];
    body->lower[k] = lower[k];
    body->upper[k] = upper[k];
  }
}

/* The pair of two bodies that a map takes to their places, NULL for none. Collective. */
static inline PetscErrorCode MakePair(struct _n_Scene *scene, const char *map, Mesh *mesh, Support *support, Pair *pair)
{
  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < 2 && map; b++)
    PetscCall(ExpressionCreate(PETSC_COMM_WORLD, "-map", map, DIM, PETSC_FALSE, &scene->bodies[b].map));
  PetscCall(MeshCreate(scene, mesh));
  PetscCall(MeshSetUp(*mesh));
  PetscCall(SupportCreate(MeshFinest(*mesh), scene, support));
  PetscCall(PairsCreate(scene, MeshFinest(*mesh), support, pair));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static inline PetscErrorCode LosePair(struct _n_Scene *scene, Mesh *mesh, Support *support, Pair *pair)
{
  PetscFunctionBeginUser;
  PetscCall(PairDestroy(pair));
  PetscCall(SupportDestroy(support));
  PetscCall(MeshDestroy(mesh));
  for (PetscInt b = 0; b < 2; b++) PetscCall(ExpressionDestroy(&scene->bodies[b].map));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Two bodies whose boxes SetSolid() gives, and their pair. */
static inline PetscErrorCode SetTwoSolids(struct _n_Scene *scene, SceneBody bodies[2], ScenePair *spec)
{
  PetscFunctionBeginUser;
  PetscCall(SetTwoBoxes(scene, bodies, spec));
  scene->dim   = DIM;
  scene->model = MODEL_SOLID;
  PetscFunctionReturn(PETSC_SUCCESS);
}

#endif

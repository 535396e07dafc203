/* two_boxes.h -- a scene of two boxes made in code, for unit tests that start above the options. */
#ifndef TWO_BOXES_H
#define TWO_BOXES_H

#include "base/compat.h"
#include "constant.h"
#include "base/usererror.h"
#include "problem/vi.h"

/* Sets a box of quads with isotropic material; strings are borrowed. */
static inline void SetBox(SceneBody *body, const char *name, PetscInt nx, PetscInt ny, PetscReal x0, PetscReal y0,
                          PetscReal x1, PetscReal y1)
{
  body->name     = (char *)name;
  body->order    = 1;
  body->faces[0] = nx;
  body->faces[1] = ny;
  body->lower[0] = x0;
  body->lower[1] = y0;
  body->upper[0] = x1;
  body->upper[1] = y1;
}

/* An upper box (nonmortar side "bottom") over a lower one (mortar side "top"); bodies, pair and scene are the caller's. */
static inline PetscErrorCode SetTwoBoxes(struct _n_Scene *scene, SceneBody bodies[2], ScenePair *pair)
{
  PetscFunctionBeginUser;
  PetscCall(PetscMemzero(scene, sizeof(*scene)));
  PetscCall(PetscMemzero(pair, sizeof(*pair)));
  PetscCall(PetscMemzero(bodies, 2 * sizeof(*bodies)));
  pair->name           = (char *)"joint";
  pair->nonmortar.body = 0;
  pair->nonmortar.side = (char *)"bottom";
  pair->mortar.body    = 1;
  pair->mortar.side    = (char *)"top";
  pair->reach          = -1;
  scene->comm          = PETSC_COMM_WORLD;
  scene->title         = (char *)"";
  scene->dim           = 2;
  scene->thickness     = 1;
  scene->num_bodies    = 2;
  scene->bodies        = bodies;
  scene->num_pairs     = 1;
  scene->pairs         = pair;
  for (PetscInt b = 0; b < 2; b++) {
    const PetscReal young = 1000, poisson = 0.3;
    PetscCall(ConstantCreate("-young", 1, &young, &bodies[b].material.young));
    PetscCall(ConstantCreate("-poisson", 1, &poisson, &bodies[b].material.poisson));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static inline PetscErrorCode DestroyTwoBoxes(SceneBody bodies[2])
{
  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < 2; b++) {
    PetscCall(ExpressionDestroy(&bodies[b].material.young));
    PetscCall(ExpressionDestroy(&bodies[b].material.poisson));
    for (PetscInt i = 0; i < bodies[b].num_boundaries; i++)
      PetscCall(ExpressionDestroy(&bodies[b].boundaries[i].value));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

#endif

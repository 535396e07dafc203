/* obstacle.c -- a rigid obstacle in place of a mortar side: its shape and the numbers that the shape needs. */
#include "parts.h"

/* Reads the direction of the plane or of the parabola's axis and makes it of length one. */
static PetscErrorCode ObstacleReadNormal_Private(Scene scene, const ScenePair *pair, SceneObstacle *obstacle)
{
  Option    normal;
  PetscReal length = 0;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-<pair>_obstacle_normal", pair->name, NULL, &normal));
  PetscCall(OptionRequire(&normal, "this obstacle needs a direction"));
  PetscCall(OptionGetReals(&normal, scene->dim, obstacle->normal));
  for (PetscInt i = 0; i < scene->dim; i++) length = PetscMax(length, PetscAbsReal(obstacle->normal[i]));
  if (!(length > 0)) PetscCall(OptionRaise(&normal, "a direction must not be zero"));
  for (PetscInt i = 0; i < scene->dim; i++)
    obstacle->normal[i] /= length; /* first, so that squares neither vanish nor overflow */
  length = 0;
  for (PetscInt i = 0; i < scene->dim; i++) length += PetscSqr(obstacle->normal[i]);
  for (PetscInt i = 0; i < scene->dim; i++) obstacle->normal[i] /= PetscSqrtReal(length);
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode ObstacleReadRadius_Private(Scene scene, const ScenePair *pair, SceneObstacle *obstacle)
{
  Option radius;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-<pair>_obstacle_radius", pair->name, NULL, &radius));
  PetscCall(OptionRequire(&radius, "this obstacle needs a radius"));
  PetscCall(OptionGetReals(&radius, 1, &obstacle->radius));
  if (obstacle->radius == 0) PetscCall(OptionRaise(&radius, "a radius must not be zero"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ObstacleRead(Scene scene, ScenePair *pair, const Option *shape)
{
  /* in the order of the table's words: a circle is the section of a ball */
  static const ObstacleKind shapes[] = {OBSTACLE_PLANE,    OBSTACLE_BALL,     OBSTACLE_BALL,
                                        OBSTACLE_CYLINDER, OBSTACLE_PARABOLA, OBSTACLE_EXPRESSION};
  SceneObstacle            *obstacle = &pair->obstacle;
  Option                    point, gap;
  PetscInt                  choice = 0;

  PetscFunctionBeginUser;
  PetscCall(OptionGetChoice(shape, &choice));
  obstacle->kind = shapes[choice];
  if (obstacle->kind == OBSTACLE_CYLINDER) {
    PetscCall(OptionRaise(
        shape, "a cylinder is for solids, which this version does not solve; its section in the plane is a circle"));
  }
  if (obstacle->kind == OBSTACLE_EXPRESSION) {
    PetscCall(OptionFind(scene, "-<pair>_obstacle_gap", pair->name, NULL, &gap));
    PetscCall(OptionRequire(&gap, "the obstacle is an expression"));
    PetscCall(OptionGetExpression(&gap, 1, PETSC_FALSE, &obstacle->gap));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(OptionFind(scene, "-<pair>_obstacle_point", pair->name, NULL, &point));
  PetscCall(OptionGetReals(&point, scene->dim, obstacle->point));
  if (obstacle->kind != OBSTACLE_BALL) PetscCall(ObstacleReadNormal_Private(scene, pair, obstacle));
  if (obstacle->kind != OBSTACLE_PLANE) PetscCall(ObstacleReadRadius_Private(scene, pair, obstacle));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* sceneobstacle.c -- a rigid obstacle in place of a mortar side: its shape and the numbers that the shape
   needs. */
#include "scene/sceneparts.h"

/* Reads a direction and makes it of length one.
   [in] why - what needs it, a clause; [out] direction - [dim] */
static PetscErrorCode ObstacleReadDirection_Private(const Option *option, const char why[], PetscReal direction[])
{
  const PetscInt dim    = option->scene->dim;
  PetscReal      length = 0;

  PetscFunctionBeginUser;
  PetscCall(OptionRequire(option, why));
  PetscCall(OptionGetReals(option, dim, direction));
  for (PetscInt i = 0; i < dim; i++) length = PetscMax(length, PetscAbsReal(direction[i]));
  if (!(length > 0)) PetscCall(OptionRaise(option, "a direction must not be zero"));
  for (PetscInt i = 0; i < dim; i++) direction[i] /= length; /* first, so that squares neither vanish nor overflow */
  length = 0;
  for (PetscInt i = 0; i < dim; i++) length += PetscSqr(direction[i]);
  for (PetscInt i = 0; i < dim; i++) direction[i] /= PetscSqrtReal(length);
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

/* A cylinder about the axis of revolution is, in the meridian plane, a straight line along it. */
static PetscErrorCode ObstacleReadRing_Private(Scene scene, const ScenePair *pair, SceneObstacle *obstacle)
{
  Option point, axis;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-<pair>_obstacle_point", pair->name, NULL, &point));
  PetscCall(OptionFind(scene, "-<pair>_obstacle_axis", pair->name, NULL, &axis));
  if (point.set || axis.set) {
    PetscCall(OptionRaise(point.set ? &point : &axis,
                          "the cylinder of an axisymmetric scene has the axis of the scene; omit the option"));
  }
  PetscCall(ObstacleReadRadius_Private(scene, pair, obstacle));
  obstacle->kind      = OBSTACLE_PLANE;
  obstacle->point[0]  = PetscAbsReal(obstacle->radius);
  obstacle->normal[0] = obstacle->radius > 0 ? 1 : -1;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Reads the point, the direction and the radius of an obstacle, as its shape needs them. */
static PetscErrorCode ObstacleReadPlace_Private(Scene scene, const ScenePair *pair, SceneObstacle *obstacle)
{
  Option point, normal, axis;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-<pair>_obstacle_point", pair->name, NULL, &point));
  PetscCall(OptionGetReals(&point, scene->dim, obstacle->point));
  if (obstacle->kind == OBSTACLE_PLANE || obstacle->kind == OBSTACLE_PARABOLA) {
    PetscCall(OptionFind(scene, "-<pair>_obstacle_normal", pair->name, NULL, &normal));
    PetscCall(ObstacleReadDirection_Private(&normal, "this obstacle needs a direction", obstacle->normal));
  }
  if (obstacle->kind == OBSTACLE_CYLINDER) {
    PetscCall(OptionFind(scene, "-<pair>_obstacle_axis", pair->name, NULL, &axis));
    PetscCall(ObstacleReadDirection_Private(&axis, "a cylinder needs the direction of its axis", obstacle->axis));
  }
  if (obstacle->kind != OBSTACLE_PLANE) PetscCall(ObstacleReadRadius_Private(scene, pair, obstacle));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SceneObstacleRead(Scene scene, ScenePair *pair, const Option *shape)
{
  enum { CIRCLE = 2 };
  /* in the order of the table's words: a circle is the section of a ball */
  static const ObstacleKind shapes[] = {OBSTACLE_PLANE,    OBSTACLE_BALL,     OBSTACLE_BALL,
                                        OBSTACLE_CYLINDER, OBSTACLE_PARABOLA, OBSTACLE_EXPRESSION};
  SceneObstacle            *obstacle = &pair->obstacle;
  Option                    gap;
  PetscInt                  choice = 0;

  PetscFunctionBeginUser;
  PetscCall(OptionGetChoice(shape, &choice));
  obstacle->kind = shapes[choice];
  if (obstacle->kind == OBSTACLE_CYLINDER && scene->dim == 2 && scene->model != MODEL_AXISYMMETRIC) {
    PetscCall(OptionRaise(
        shape, "a cylinder is for solids and axisymmetric bodies; its section in a plane is a circle, write circle"));
  }
  if (choice == CIRCLE && scene->dim == 3)
    PetscCall(OptionRaise(shape, "a circle is flat, and the scene a solid; write ball or cylinder"));
  if (obstacle->kind == OBSTACLE_EXPRESSION) {
    PetscCall(OptionFind(scene, "-<pair>_obstacle_gap", pair->name, NULL, &gap));
    PetscCall(OptionRequire(&gap, "the obstacle is an expression"));
    PetscCall(OptionGetExpression(&gap, 1, PETSC_FALSE, &obstacle->gap));
  } else if (obstacle->kind == OBSTACLE_CYLINDER && scene->dim == 2) {
    PetscCall(ObstacleReadRing_Private(scene, pair, obstacle));
  } else {
    PetscCall(ObstacleReadPlace_Private(scene, pair, obstacle));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* positions.c -- where the nodes of a level are.

   The DM keeps box coordinates. A node in the middle of an edge or a cell has the mean of its vertices there, and the map
   then puts it on the exact curve: sides are isoparametric. */
#include "room.h"
#include <mortise/compat.h>

/* Box coordinates of all points that may carry nodes: the mean of a point's vertices is the mean of its facets' means.
   [out] X - [point_end - point_begin][dim] */
static PetscErrorCode LevelGetBoxCoords_Private(const Level *level, PetscReal X[])
{
  const PetscInt     dim = level->dim;
  const PetscScalar *box;
  PetscInt           vertex_begin, vertex_end;
  Vec                coords;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetDepthStratum(level->dm, 0, &vertex_begin, &vertex_end));
  PetscCall(DMGetCoordinatesLocal(level->dm, &coords));
  PetscCall(VecGetArrayRead(coords, &box));
  for (PetscInt i = 0; i < (vertex_end - vertex_begin) * dim; ++i) // the coordinate section has the vertices in order
    X[(vertex_begin - level->point_begin) * dim + i] = PetscRealPart(box[i]);
  PetscCall(VecRestoreArrayRead(coords, &box));
  for (PetscInt depth = 1; depth <= dim; ++depth) {
    PetscInt begin, end;

    PetscCall(DMPlexGetDepthStratum(level->dm, depth, &begin, &end));
    if (begin < level->point_begin || end > level->point_end) break; // nodes on vertices only
    for (PetscInt p = begin; p < end; ++p) {
      const PetscInt *cone;
      PetscInt        size;

      PetscCall(DMPlexGetConeSize(level->dm, p, &size));
      PetscCall(DMPlexGetCone(level->dm, p, &cone));
      for (PetscInt d = 0; d < dim; ++d) {
        PetscReal sum = 0;

        for (PetscInt i = 0; i < size; ++i) sum += X[(cone[i] - level->point_begin) * dim + d];
        X[(p - level->point_begin) * dim + d] = sum / size;
      }
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* x = map(X) for nodes of mapped bodies, x = X else. */
PetscErrorCode LevelSetCoords(Level *level)
{
  const Scene    scene = level->scene;
  const PetscInt dim   = level->dim;
  PetscReal     *X;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((level->point_end - level->point_begin) * dim, &X));
  PetscCall(LevelGetBoxCoords_Private(level, X));
  for (PetscInt p = 0; p < level->point_end - level->point_begin; ++p) {
    const PetscInt node = level->point_node[p];
    Expression     map;

    if (node < 0) continue;
    map = scene->bodies[level->node_body[node]].map;
    if (map)
      PetscCall(ExpressionEvaluate(map, dim, &X[p * dim], &level->coords[node * dim]));
    else
      PetscCall(PetscArraycpy(&level->coords[node * dim], &X[p * dim], dim));
  }
  PetscCall(PetscFree(X));
  for (PetscInt b = 0; b < scene->num_bodies; ++b) PetscCall(ExpressionCheck(level->comm, scene->bodies[b].map));
  PetscFunctionReturn(PETSC_SUCCESS);
}

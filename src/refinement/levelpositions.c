/* levelpositions.c -- positions of the nodes of a level.

   The DM keeps box coordinates of vertices. A node in the middle of an edge or a cell is at the mean of the
   vertices, or at its position in the file. Finer levels follow the curves of the coarsest. The body's map
   puts all of them on the exact curve: sides are isoparametric. */
#include "refinement/refinementimpl.h"
#include "base/compat.h"

/* Means over vertices, by point: the mean of a point's vertices is the mean of its facets' means.
   [in,out] X - of all points that may carry nodes, known for vertices on entry [point_end -
   point_begin][dim] */
static PetscErrorCode LevelSetMiddles_Private(const Level *level, PetscReal X[])
{
  const PetscInt dim = level->dim;

  PetscFunctionBeginUser;
  for (PetscInt depth = 1; depth <= dim; depth++) {
    PetscInt begin, end;

    PetscCall(DMPlexGetDepthStratum(level->dm, depth, &begin, &end));
    if (begin < level->point_begin || end > level->point_end) break; // nodes on vertices only
    for (PetscInt p = begin; p < end; p++) {
      const PetscInt *cone;
      PetscInt        size;

      PetscCall(DMPlexGetConeSize(level->dm, p, &size));
      PetscCall(DMPlexGetCone(level->dm, p, &cone));
      for (PetscInt d = 0; d < dim; d++) {
        PetscReal sum = 0;

        for (PetscInt i = 0; i < size; i++) sum += X[(cone[i] - level->point_begin) * dim + d];
        X[(p - level->point_begin) * dim + d] = sum / size;
      }
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Box coordinates of straight cells. [out] X - [num_nodes][dim] */
static PetscErrorCode LevelGetStraight_Private(const Level *level, PetscReal X[])
{
  const PetscInt     dim = level->dim;
  const PetscScalar *box;
  PetscInt           begin, end, space_dim;
  PetscReal         *at; /* by point */
  Vec                coords;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((level->point_end - level->point_begin) * dim, &at));
  PetscCall(DMPlexGetDepthStratum(level->dm, 0, &begin, &end));
  PetscCall(DMGetCoordinateDim(level->dm, &space_dim)); // coordinates of a file may have a third component
  PetscCall(DMGetCoordinatesLocal(level->dm, &coords));
  PetscCall(VecGetArrayRead(coords, &box));
  for (PetscInt v = begin; v < end; v++) { // the coordinate section has the vertices in order
    for (PetscInt d = 0; d < dim; d++)
      at[(v - level->point_begin) * dim + d] = PetscRealPart(box[(v - begin) * space_dim + d]);
  }
  PetscCall(VecRestoreArrayRead(coords, &box));
  PetscCall(LevelSetMiddles_Private(level, at));
  for (PetscInt p = level->point_begin; p < level->point_end; p++) {
    const PetscInt node = PointGetNode(level, p);

    if (node >= 0) PetscCall(PetscArraycpy(&X[node * dim], &at[(p - level->point_begin) * dim], dim));
  }
  PetscCall(PetscFree(at));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* x = map(X) for nodes of mapped bodies, x = X else. */
static PetscErrorCode LevelMapCoords_Private(Level *level, const PetscReal X[])
{
  const Scene    scene = level->scene;
  const PetscInt dim   = level->dim;

  PetscFunctionBeginUser;
  for (PetscInt node = 0; node < level->num_nodes; node++) {
    const Expression map = scene->bodies[level->node_body[node]].map;

    if (map)
      PetscCall(ExpressionEvaluate(map, dim, &X[node * dim], &level->coords[node * dim]));
    else
      PetscCall(PetscArraycpy(&level->coords[node * dim], &X[node * dim], dim));
  }
  for (PetscInt b = 0; b < scene->num_bodies; b++) PetscCall(ExpressionCheck(level->comm, scene->bodies[b].map));
  PetscCall(LevelSetAxis(level));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Keeps for finer levels the data that the DM does not have. */
PetscErrorCode LevelSetCoords(Level *level, const Curves *curves)
{
  PetscReal *X;
  PetscInt   size = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(level->num_nodes * level->dim + 1, &X)); // not NULL where a rank has no nodes
  PetscCall(LevelGetStraight_Private(level, X));
  if (curves) {
    PetscCall(CurvesGetNodes(curves, level, X));
    PetscCall(CurvesGetSize(curves, &size));
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &size, 1, MPIU_INT, MPI_MAX, level->comm));
  }
  PetscCall(LevelMapCoords_Private(level, X));
  if (size)
    level->unmapped = X;
  else
    PetscCall(PetscFree(X));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* One coordinate of the coarse nodes becomes one of the fine nodes. */
static PetscErrorCode LevelProlongCoord_Private(Level *coarse, Level *fine, PetscInt d)
{
  PetscScalar *x;
  Vec          from, to, local;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(coarse, 1, &from));
  PetscCall(LevelCreateVec(fine, 1, &to));
  PetscCall(VecGetArray(from, &x));
  for (PetscInt i = 0; i < coarse->num_owned; i++) x[i] = coarse->unmapped[i * coarse->dim + d];
  PetscCall(VecRestoreArray(from, &x));
  PetscCall(MatMult(fine->prolongation, from, to));
  PetscCall(LevelShareVec(to, INSERT_VALUES));
  PetscCall(VecGhostGetLocalForm(to, &local));
  PetscCall(VecGetArray(local, &x));
  for (PetscInt i = 0; i < fine->num_nodes; i++) fine->unmapped[i * fine->dim + d] = PetscRealPart(x[i]);
  PetscCall(VecRestoreArray(local, &x));
  PetscCall(VecGhostRestoreLocalForm(to, &local));
  PetscCall(VecDestroy(&from));
  PetscCall(VecDestroy(&to));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelKeepUnmapped(Level *level)
{
  PetscFunctionBeginUser;
  if (level->unmapped) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(level->num_nodes * level->dim + 1, &level->unmapped));
  PetscCall(LevelGetStraight_Private(level, level->unmapped));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Middle nodes of bodies of order 2 whose files have straight edges. */
static PetscErrorCode LevelCurveMiddles_Private(Level *level)
{
  ArcSides sides;

  PetscFunctionBeginUser;
  PetscCall(ArcSidesCreate(level, 2, &sides));
  if (sides.any) PetscCall(LevelArcMiddles(level, &sides));
  PetscCall(ArcSidesDestroy(&sides));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelBeginArcs(Level *level)
{
  PetscBool any;

  PetscFunctionBeginUser;
  PetscCall(LevelFindArcs(level, &any));
  if (any) {
    PetscCall(LevelKeepUnmapped(level));
    PetscCall(LevelCurveMiddles_Private(level));
    PetscCall(LevelMapCoords_Private(level, level->unmapped));
  }
  PetscCall(LevelFindFileArcs(level)); // these have their middle nodes
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Fine nodes are on the coarse isoparametric cells, so that refinement stays on a file's curves; or on the
   arcs over straight edges. All ranks take the same branch, also those without nodes. */
PetscErrorCode LevelFollowCoords(Level *coarse, const ArcSides *sides, const Refinement *refinement, Level *fine)
{
  PetscFunctionBeginUser;
  if (!coarse->unmapped) {
    PetscCall(LevelSetCoords(fine, NULL));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PetscMalloc1(fine->num_nodes * fine->dim + 1, &fine->unmapped));
  for (PetscInt d = 0; d < fine->dim; d++) PetscCall(LevelProlongCoord_Private(coarse, fine, d));
  if (sides->any) PetscCall(LevelArcVertices(coarse, sides, refinement, fine));
  PetscCall(LevelRiseParabolas(coarse, refinement, fine));
  PetscCall(LevelCurveMiddles_Private(fine));
  PetscCall(LevelMapCoords_Private(fine, fine->unmapped));
  PetscFunctionReturn(PETSC_SUCCESS);
}

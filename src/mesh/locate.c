/* locate.c -- which cell of a body holds a point. */
#include "room.h"
#include <mortise/compat.h>

/* A point on a side belongs to the cell; round-off of a position is far below this share of the cell. */
static const PetscReal LocateTolerance = 1e-8;
/* A parabola through the ends and the middle of an arc of 45 degrees misses it by 2 percent of its height. */
static const PetscReal CurveSlack = 0.05;
/* Boxes of cells are widened by this share where a curve may leave them: half a circle over one facet. */
static const PetscReal CurveMargin = 0.5;
/* A parabola leaves the box around its three nodes by an eighth of it, a side of a tri6 or a quad9 by less than a third. */
static const PetscReal OrderMargin = 1. / 3;
/* Reference coordinates may leave the cell by this much where a curve does. */
static const PetscReal CurveTolerance = 1;

/* Whether a point lies in the box around a cell, widened by a share of its size. [out] X - [num_nodes][dim] */
static PetscBool LocateMeetsBox_Private(const Level *level, PetscInt cell, const PetscReal x[], PetscReal margin,
                                        PetscReal X[])
{
  const PetscInt *nodes = &level->cell_nodes[level->cell_start[cell]];
  const PetscInt  num   = level->cell_start[cell + 1] - level->cell_start[cell];
  PetscReal       low[3], high[3], size = 0;

  for (PetscInt d = 0; d < level->dim; ++d) {
    low[d]  = PETSC_MAX_REAL;
    high[d] = -PETSC_MAX_REAL;
    for (PetscInt i = 0; i < num; ++i) {
      X[i * level->dim + d] = level->coords[nodes[i] * level->dim + d];
      low[d]                = PetscMin(low[d], X[i * level->dim + d]);
      high[d]               = PetscMax(high[d], X[i * level->dim + d]);
    }
    size = PetscMax(size, high[d] - low[d]);
  }
  for (PetscInt d = 0; d < level->dim; ++d) {
    if (x[d] < low[d] - margin * size || x[d] > high[d] + margin * size) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

/* The curve over a facet, as a chord a, b and the way from its middle to the curve's. */
static PetscErrorCode FacetGetCurve_Private(const Level *level, Expression map, PetscInt facet, PetscReal a[],
                                            PetscReal b[], PetscReal rise[])
{
  const PetscScalar *box;
  PetscReal          middle[3];
  PetscInt           begin, num, ends[ELEMENT_MAX_NODES];
  Vec                coords;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetDepthStratum(level->dm, 0, &begin, NULL));
  PetscCall(PointGetVertices(level->dm, facet, &num, ends));
  PetscCall(DMGetCoordinatesLocal(level->dm, &coords));
  PetscCall(VecGetArrayRead(coords, &box));
  for (PetscInt d = 0; d < level->dim; ++d) {
    const PetscInt i = ends[0] - begin, j = ends[1] - begin;

    middle[d] = 0.5 * PetscRealPart(box[i * level->dim + d] + box[j * level->dim + d]);
    a[d]      = level->coords[PointGetNode(level, ends[0]) * level->dim + d];
    b[d]      = level->coords[PointGetNode(level, ends[1]) * level->dim + d];
  }
  PetscCall(VecRestoreArrayRead(coords, &box));
  if (PointGetNode(level, facet) >= 0)
    PetscCall(PetscArraycpy(rise, &level->coords[PointGetNode(level, facet) * level->dim], level->dim));
  else
    PetscCall(ExpressionEvaluate(map, level->dim, middle, rise));
  for (PetscInt d = 0; d < level->dim; ++d) rise[d] -= 0.5 * (a[d] + b[d]);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a point lies between a facet and its curve, taken as the parabola a + t (b - a) + 4 t (1 - t) rise. */
static PetscErrorCode FacetHoldsPoint_Private(const Level *level, Expression map, PetscInt facet, const PetscReal x[],
                                              PetscBool *holds)
{
  PetscReal a[3], b[3], rise[3], length = 0, height = 0, t = 0, above = 0;

  PetscFunctionBeginUser;
  PetscCall(FacetGetCurve_Private(level, map, facet, a, b, rise));
  for (PetscInt d = 0; d < level->dim; ++d) {
    length += PetscSqr(b[d] - a[d]);
    height += PetscSqr(rise[d]);
    t += (x[d] - a[d]) * (b[d] - a[d]);
  }
  t /= length;
  for (PetscInt d = 0; d < level->dim; ++d) above += (x[d] - a[d] - t * (b[d] - a[d])) * rise[d];
  *holds = t >= 0 && t <= 1 && above >= 0 && height > PetscSqr(LocateTolerance) * length &&
                   above <= ((1 + CurveSlack) * 4 * t * (1 - t) + LocateTolerance) * height
               ? PETSC_TRUE
               : PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a point lies beyond a boundary facet of a cell but within its curve. */
static PetscErrorCode CellHoldsPoint_Private(const Level *level, Expression map, PetscInt cell, const PetscReal x[],
                                             PetscBool *holds)
{
  const PetscInt *facets;
  PetscInt        begin, size, num_cells;

  PetscFunctionBeginUser;
  *holds = PETSC_FALSE;
  PetscCall(DMPlexGetHeightStratum(level->dm, 0, &begin, NULL));
  PetscCall(DMPlexGetConeSize(level->dm, begin + cell, &size));
  PetscCall(DMPlexGetCone(level->dm, begin + cell, &facets));
  for (PetscInt f = 0; f < size && !*holds; ++f) {
    PetscCall(DMPlexGetSupportSize(level->dm, facets[f], &num_cells));
    if (num_cells == 1) PetscCall(FacetHoldsPoint_Private(level, map, facets[f], x, holds));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* This rank's first cell that holds the point, -1 if there is none; with a map also beyond facets: of order 1 there lies
   all of the curve, of order 2 what is between it and the parabola. */
static PetscErrorCode LocateLocally_Private(const Level *level, PetscInt body, Expression map, const PetscReal x[],
                                            PetscInt *cell, PetscReal xi[])
{
  PetscReal X[ELEMENT_MAX_NODES * 3];

  PetscFunctionBeginUser;
  *cell = -1;
  for (PetscInt c = 0; c < level->num_cells && *cell < 0; ++c) {
    const ElementType type   = (ElementType)level->cell_type[c];
    const PetscReal   margin = ElementOrder(type) > 1 ? OrderMargin : LocateTolerance;
    PetscBool         holds  = PETSC_TRUE;

    if (level->cell_body[c] != body || !LocateMeetsBox_Private(level, c, x, map ? CurveMargin : margin, X)) continue;
    if (map) PetscCall(CellHoldsPoint_Private(level, map, c, x, &holds));
    if (holds && ElementLocate(type, X, x, map ? CurveTolerance : LocateTolerance, xi)) *cell = c;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelLocate(Level *level, PetscInt body, const PetscReal x[], PetscInt *cell, PetscReal xi[],
                           PetscBool *found)
{
  const Expression map = level->scene->bodies[body].map;
  PetscMPIInt      rank, size, winner;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(level->comm, &rank));
  PetscCallMPI(MPI_Comm_size(level->comm, &size));
  for (int curves = 0; curves <= (map != NULL); ++curves) {
    PetscCall(LocateLocally_Private(level, body, curves ? map : NULL, x, cell, xi));
    winner = *cell >= 0 ? rank : size;
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &winner, 1, MPI_INT, MPI_MIN, level->comm));
    if (winner < size) break;
  }
  if (rank != winner) *cell = -1;
  *found = winner < size ? PETSC_TRUE : PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

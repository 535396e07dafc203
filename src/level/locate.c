/* locate.c -- the cell of a body that contains a point. */
#include "kernel/vector.h"
#include "level/plexpoints.h"
#include "base/compat.h"

/* A point on a side belongs to the cell; round-off of a position is far below this share of the cell. */
static const PetscReal LOCATE_TOLERANCE = 1e-8;
/* Boxes of cells are widened by this share where a curve may leave them: half a circle over one facet. */
static const PetscReal CURVE_MARGIN = 0.5;
/* A parabola extends beyond the box around its three nodes by an eighth of it. A side of a tri6 or a quad9
   extends by less than a third. */
static const PetscReal ORDER_MARGIN = 1. / 3;
/* Reference coordinates may leave the cell by this much where a curve does. */
static const PetscReal CURVE_TOLERANCE = 1;
/* Derivatives of a map are differences over this share of a cell: half the digits of a number. */
static const PetscReal DIFFERENCE_SHARE = 1e-7;
enum { INVERSE_MAX_STEPS = 20 };

/* The box around the nodes of a cell. */
typedef struct {
  PetscReal low[3], high[3];
} Span;

/* [in] X - [num][dim] */
static Span SpanOf_Private(PetscInt dim, PetscInt num, const PetscReal X[])
{
  Span span;

  for (PetscInt d = 0; d < dim; d++) {
    span.low[d] = span.high[d] = X[d];
    for (PetscInt i = 1; i < num; i++) {
      span.low[d]  = PetscMin(span.low[d], X[i * dim + d]);
      span.high[d] = PetscMax(span.high[d], X[i * dim + d]);
    }
  }
  return span;
}

/* Whether a point lies in the box around a cell, widened by a share of its size.
   [out] X - [num_nodes][dim] */
static PetscBool LocateMeetsBox_Private(const Level *level, PetscInt cell, const PetscReal x[], PetscReal margin,
                                        PetscReal X[])
{
  const PetscInt *nodes = &level->cell_nodes[level->cell_start[cell]];
  const PetscInt  num   = level->cell_start[cell + 1] - level->cell_start[cell];
  PetscReal       size  = 0;
  Span            span;

  VectorGather(level->dim, num, nodes, level->coords, X);
  span = SpanOf_Private(level->dim, num, X);
  for (PetscInt d = 0; d < level->dim; d++) size = PetscMax(size, span.high[d] - span.low[d]);
  for (PetscInt d = 0; d < level->dim; d++) {
    if (x[d] < span.low[d] - margin * size || x[d] > span.high[d] + margin * size) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

/* A cell as it is before the map. [out] X - of its nodes, as the DM has them [num][dim] */
static PetscErrorCode CellGetUnmapped_Private(const Level *level, PetscInt cell, ElementType *type, PetscReal X[])
{
  const PetscScalar *box;
  PetscInt           begin, vertex_begin, num, points[ELEMENT_MAX_NODES];
  Vec                coords;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetHeightStratum(level->dm, 0, &begin, NULL));
  if (level->unmapped) {
    PetscCall(PointGetNodes(level, begin + cell, type, points));
    for (PetscInt i = 0; i < ElementNumNodes(*type); i++)
      PetscCall(PetscArraycpy(&X[i * level->dim], &level->unmapped[points[i] * level->dim], level->dim));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  *type = ElementLinear((ElementType)level->cell_type[cell]);
  PetscCall(DMPlexGetDepthStratum(level->dm, 0, &vertex_begin, NULL));
  PetscCall(PointGetVertices(level->dm, begin + cell, &num, points));
  PetscCall(DMGetCoordinatesLocal(level->dm, &coords));
  PetscCall(VecGetArrayRead(coords, &box));
  for (PetscInt i = 0; i < num * level->dim; i++)
    X[i] = PetscRealPart(box[(points[i / level->dim] - vertex_begin) * level->dim + i % level->dim]);
  PetscCall(VecRestoreArrayRead(coords, &box));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* One step of Newton's method for map(X) = x, limited to the span: elsewhere the map may not exist.
   [in,out] X - [dim];
   [out] length - of the whole step as a share of the span, infinite where the map cannot be inverted */
static PetscErrorCode InverseStep_Private(Expression map, PetscInt dim, const PetscReal x[], const Span *span,
                                          PetscReal X[], PetscReal *length)
{
  const ElementType simplex = dim == 2 ? ELEMENT_TRI3 : ELEMENT_TET4;
  PetscReal         at[4 * 3], delta[3], phi[ELEMENT_MAX_NODES], grad[ELEMENT_MAX_NODES * 3];

  PetscFunctionBeginUser;
  /* the images of X and of points beside it span a simplex, in whose reference coordinates the step is
     known */
  PetscCall(ExpressionEvaluate(map, dim, X, at));
  for (PetscInt i = 0; i < dim; i++) {
    PetscReal beside[3];

    PetscCall(PetscArraycpy(beside, X, dim));
    delta[i] = DIFFERENCE_SHARE * (span->high[i] - span->low[i]);
    if (2 * X[i] > span->low[i] + span->high[i]) delta[i] = -delta[i]; // inwards
    beside[i] += delta[i];
    PetscCall(ExpressionEvaluate(map, dim, beside, &at[(i + 1) * dim]));
  }
  *length = PETSC_INFINITY;
  if (ElementMap(simplex, at, ElementNode(simplex, 0), NULL, phi, grad) == 0) PetscFunctionReturn(PETSC_SUCCESS);
  *length = 0;
  for (PetscInt i = 0; i < dim; i++) {
    PetscReal step = 0;

    for (PetscInt d = 0; d < dim; d++) step += delta[i] * grad[(i + 1) * dim + d] * (x[d] - at[d]);
    X[i]    = PetscMin(PetscMax(X[i] + step, span->low[i]), span->high[i]);
    *length = PetscMax(*length, PetscAbsReal(step) / (span->high[i] - span->low[i]));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a point is the image of one in a cell, though it may lie beyond the cell's facets. For order 1 it
   may lie between chord and curve, for order 2 between parabola and curve. */
static PetscErrorCode CellHoldsPoint_Private(const Level *level, Expression map, PetscInt cell, const PetscReal x[],
                                             PetscBool *holds)
{
  PetscReal   nodes[ELEMENT_MAX_NODES * 3], X[3], xi[3], length = 1;
  ElementType type;
  Span        span;

  PetscFunctionBeginUser;
  PetscCall(CellGetUnmapped_Private(level, cell, &type, nodes));
  span = SpanOf_Private(level->dim, ElementNumNodes(type), nodes);
  for (PetscInt d = 0; d < level->dim; d++) X[d] = 0.5 * (span.low[d] + span.high[d]);
  for (PetscInt i = 0; i < INVERSE_MAX_STEPS && length > LOCATE_TOLERANCE && length < PETSC_INFINITY; i++)
    PetscCall(InverseStep_Private(map, level->dim, x, &span, X, &length));
  *holds = length <= LOCATE_TOLERANCE && ElementLocate(type, nodes, X, LOCATE_TOLERANCE, xi) ? PETSC_TRUE : PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* This rank's first cell that holds the point, -1 if there is none; with a map also beyond facets. */
static PetscErrorCode LocateLocally_Private(const Level *level, PetscInt body, Expression map, const PetscReal x[],
                                            PetscInt *cell, PetscReal xi[])
{
  PetscReal X[ELEMENT_MAX_NODES * 3];

  PetscFunctionBeginUser;
  *cell = -1;
  for (PetscInt c = 0; c < level->num_cells && *cell < 0; c++) {
    const ElementType type   = (ElementType)level->cell_type[c];
    const PetscReal   margin = ElementOrder(type) > 1 ? ORDER_MARGIN : LOCATE_TOLERANCE;
    PetscBool         holds  = PETSC_TRUE;

    if (level->cell_body[c] != body || !LocateMeetsBox_Private(level, c, x, map ? CURVE_MARGIN : margin, X)) continue;
    if (map) PetscCall(CellHoldsPoint_Private(level, map, c, x, &holds));
    if (holds && ElementLocate(type, X, x, map ? CURVE_TOLERANCE : LOCATE_TOLERANCE, xi)) *cell = c;
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
  for (int curves = 0; curves <= (map != NULL); curves++) {
    PetscCall(LocateLocally_Private(level, body, curves ? map : NULL, x, cell, xi));
    winner = *cell >= 0 ? rank : size;
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &winner, 1, MPI_INT, MPI_MIN, level->comm));
    if (winner < size) break;
  }
  if (rank != winner) *cell = -1;
  *found = winner < size ? PETSC_TRUE : PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The largest distance of two vertices of a cell. */
static PetscReal LocateGetSize_Private(const Level *level, PetscInt c)
{
  const PetscInt *nodes = &level->cell_nodes[level->cell_start[c]], dim = level->dim;
  const PetscInt  n    = ElementNumNodes(ElementLinear((ElementType)level->cell_type[c]));
  PetscReal       most = 0;

  for (PetscInt i = 0; i < n; i++) {
    for (PetscInt j = 0; j < i; j++)
      most = PetscMax(most, VectorDistance(dim, &level->coords[nodes[i] * dim], &level->coords[nodes[j] * dim]));
  }
  return most;
}

PetscErrorCode LevelLocateAll(Level *level, PetscInt body, const PetscReal at[], PetscInt marked[], PetscReal *size)
{
  static const PetscReal SAME_PLACE = 1e-6; /* of a cell's size */
  const PetscInt         dim        = level->dim;
  PetscReal              X[ELEMENT_MAX_NODES * 3], xi[3];
  PetscBool              found;
  PetscInt               cell;

  PetscFunctionBeginUser;
  PetscCall(LevelLocate(level, body, at, &cell, xi, &found)); // may lie outside of all, under a curve
  *size = cell >= 0 ? LocateGetSize_Private(level, cell) : 0;
  if (marked && cell >= 0 && !marked[cell]) marked[cell] = 1;
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const PetscInt *nodes = &level->cell_nodes[level->cell_start[c]];
    const PetscInt  num   = level->cell_start[c + 1] - level->cell_start[c];
    const PetscReal reach = level->cell_body[c] == body ? LocateGetSize_Private(level, c) : -1;

    if (reach < 0 || VectorDistance(dim, &level->coords[nodes[0] * dim], at) > 2 * reach) continue;
    VectorGather(dim, num, nodes, level->coords, X);
    if (!ElementLocate((ElementType)level->cell_type[c], X, at, SAME_PLACE, xi)) continue;
    *size = PetscMax(*size, reach);
    if (marked && !marked[c]) marked[c] = 1;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, size, 1, MPIU_REAL, MPIU_MAX, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

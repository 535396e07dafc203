/* prolongation.c -- prolongation between levels, and from order 1 to order 2.

   The value of a fine node is that of the coarse shape functions at its position. The position is that in the
   coarse point (edge or cell) of its origin. Fine vertices are middles of coarse points, other fine nodes are
   middles of fine vertices. So every position is a mean of reference coordinates, for any dimension and
   order. Polynomials of the lower of both orders are reproduced exactly on straight cells. */
#include "refinement/refinementimpl.h"
#include "base/compat.h"
#include "base/csrmatrix.h"

/* A Mat under assembly whose rows are this rank's nodes. */
typedef struct {
  PetscInt    *start, *columns; /* global nodes */
  PetscScalar *values;
} Rows;

/* Room for num rows of the nodes of a cell. */
static PetscErrorCode RowsCreate_Private(PetscInt num, Rows *rows)
{
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(num + 1, &rows->start, num * ELEMENT_MAX_NODES, &rows->columns, num * ELEMENT_MAX_NODES,
                         &rows->values));
  rows->start[0] = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Row i: the weights of some nodes of a level. Zeros are exact, since all positions are dyadic numbers. */
static PetscErrorCode RowsSet_Private(Rows *rows, PetscInt i, const Level *from, PetscInt num, const PetscInt nodes[],
                                      const PetscReal weights[])
{
  PetscInt end = rows->start[i];

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < num; k++) {
    if (weights[k] == 0) continue;
    rows->columns[end]  = from->node_global[nodes[k]];
    rows->values[end++] = weights[k];
  }
  PetscCall(PetscSortIntWithScalarArray(end - rows->start[i], &rows->columns[rows->start[i]],
                                        &rows->values[rows->start[i]])); // Mats need ascending columns
  rows->start[i + 1] = end;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Turns the rows into a Mat and frees them. */
static PetscErrorCode RowsToMat_Private(Rows *rows, const Level *from, const Level *to, Mat *P)
{
  PetscFunctionBeginUser;
  PetscCall(CSRMatrixCreate(
      to->comm, &(CSRRows){1, to->num_owned, from->num_owned, rows->start, rows->columns, rows->values}, P));
  PetscCall(PetscFree3(rows->start, rows->columns, rows->values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds a fine vertex's reference coordinates in a coarse element: the mean over the vertices of the point it
   comes from.
   [in] nodes - of the element; [in,out] xi - [ElementDim] */
static PetscErrorCode VertexAddPlace_Private(const Level *coarse, const Refinement *refinement, PetscInt vertex,
                                             ElementType type, const PetscInt nodes[], PetscReal share, PetscReal xi[])
{
  PetscInt num, vertices[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  PetscCall(PointGetVertices(coarse->dm, RefinementGetSource(refinement, vertex, NULL), &num, vertices));
  for (PetscInt i = 0; i < num; i++) {
    PetscInt k = 0;

    while (nodes[k] != PointGetNode(coarse, vertices[i])) k++;
    for (PetscInt d = 0; d < ElementDim(type); d++) xi[d] += share / num * ElementNode(type, k)[d];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Weights of coarse nodes at the node on a fine point. [out] nodes - local, weights - [ELEMENT_MAX_NODES] */
static PetscErrorCode PointGetWeights_Private(const Level *coarse, const Refinement *refinement, const Level *fine,
                                              PetscInt point, PetscInt *num, PetscInt nodes[], PetscReal weights[])
{
  PetscInt    from, num_vertices, vertices[ELEMENT_MAX_NODES];
  PetscReal   xi[3] = {0, 0, 0};
  ElementType type;
  PetscBool   vertex;

  PetscFunctionBeginUser;
  from = RefinementGetSource(refinement, point, &vertex);
  if (vertex) {
    *num       = 1;
    nodes[0]   = PointGetNode(coarse, from);
    weights[0] = 1;
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PointGetNodes(coarse, from, &type, nodes));
  PetscCall(PointGetVertices(fine->dm, point, &num_vertices, vertices));
  for (PetscInt i = 0; i < num_vertices; i++)
    PetscCall(VertexAddPlace_Private(coarse, refinement, vertices[i], type, nodes, (PetscReal)1 / num_vertices, xi));
  ElementShape(type, xi, weights, NULL);
  *num = ElementNumNodes(type);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelCreateProlongation(const Level *coarse, const Refinement *refinement, Level *fine)
{
  PetscInt *point;
  Rows      rows;

  PetscFunctionBeginUser;
  PetscCall(LevelGetNodePoints(fine, &point));
  PetscCall(RowsCreate_Private(fine->num_owned, &rows));
  for (PetscInt i = 0; i < fine->num_owned; i++) {
    PetscInt  num = 0, nodes[ELEMENT_MAX_NODES];
    PetscReal weights[ELEMENT_MAX_NODES];

    PetscCall(PointGetWeights_Private(coarse, refinement, fine, point[i], &num, nodes, weights));
    PetscCall(RowsSet_Private(&rows, i, coarse, num, nodes, weights));
  }
  PetscCall(RowsToMat_Private(&rows, coarse, fine, &fine->prolongation));
  PetscCall(PetscFree(point));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A node that only the higher order has is the middle of its point's vertices. */
PetscErrorCode LevelCreateEmbedding(const Level *low, const Level *high, Mat *E)
{
  PetscInt *point;
  Rows      rows;

  PetscFunctionBeginUser;
  PetscCall(LevelGetNodePoints(high, &point));
  PetscCall(RowsCreate_Private(high->num_owned, &rows));
  for (PetscInt i = 0; i < high->num_owned; i++) {
    const PetscInt p = point[i];
    PetscInt       num, points[ELEMENT_MAX_NODES], nodes[ELEMENT_MAX_NODES];
    PetscReal      weights[ELEMENT_MAX_NODES];

    if (PointGetNode(low, p) >= 0) {
      num       = 1;
      points[0] = p;
    } else {
      PetscCall(PointGetVertices(high->dm, p, &num, points));
    }
    for (PetscInt k = 0; k < num; k++) {
      nodes[k]   = PointGetNode(low, points[k]);
      weights[k] = (PetscReal)1 / num;
    }
    PetscCall(RowsSet_Private(&rows, i, low, num, nodes, weights));
  }
  PetscCall(RowsToMat_Private(&rows, low, high, E));
  PetscCall(PetscFree(point));
  PetscFunctionReturn(PETSC_SUCCESS);
}

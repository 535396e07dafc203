/* points.c -- vertices and nodes of a single point of the mesh: a vertex, an edge, a cell.

   What is linear in space is known from the vertices, what a finite element knows from the nodes. Both are listed in the
   order of element.h, as the DM has the point; whether that is anticlockwise is seen only when there are positions. */
#include "room.h"
#include <mortise/compat.h>

/* The cell of order 1 on a point, by the number of its facets. */
static ElementType PointGetLinear_Private(PetscInt num_facets)
{
  if (num_facets == ElementNumFacets(ELEMENT_LINE2)) return ELEMENT_LINE2;
  return num_facets == ElementNumFacets(ELEMENT_TRI3) ? ELEMENT_TRI3 : ELEMENT_QUAD4;
}

/* Edge i of a polygon starts at corner i and runs against its own cone where its orientation is negative. */
PetscErrorCode PointGetVertices(DM dm, PetscInt point, PetscInt *num, PetscInt vertices[])
{
  const PetscInt *cone, *orientation, *ends;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetConeSize(dm, point, num));
  PetscCall(DMPlexGetCone(dm, point, &cone));
  if (*num == 0) {
    *num        = 1;
    vertices[0] = point;
  } else if (*num == ElementNumFacets(ELEMENT_LINE2)) {
    PetscCall(PetscArraycpy(vertices, cone, *num));
  } else {
    PetscCall(DMPlexGetConeOrientation(dm, point, &orientation));
    for (PetscInt i = 0; i < *num; ++i) {
      PetscCall(DMPlexGetCone(dm, cone[i], &ends));
      vertices[i] = ends[orientation[i] < 0];
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Triangles are the only cells of order 2 without a node of their own. */
PetscErrorCode PointHasMiddle(DM dm, PetscInt point, PetscBool *has)
{
  PetscInt num;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetConeSize(dm, point, &num));
  *has = num > 0 && PointGetLinear_Private(num) != ELEMENT_TRI3 ? PETSC_TRUE : PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscInt PointGetNode(const Level *level, PetscInt point)
{
  if (point < level->point_begin || point >= level->point_end) return -1;
  return level->point_node[point - level->point_begin];
}

/* Vertices, middles of facets, own middle: as far as the level has nodes there. */
PetscErrorCode PointGetNodes(const Level *level, PetscInt point, ElementType *type, PetscInt nodes[])
{
  const PetscInt *cone;
  PetscInt        size, num, points[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  PetscCall(PointGetVertices(level->dm, point, &num, points));
  PetscCall(DMPlexGetConeSize(level->dm, point, &size));
  PetscCall(DMPlexGetCone(level->dm, point, &cone));
  for (PetscInt i = 0; i < size && size > 2; ++i) points[num++] = cone[i]; // the facets of an edge are its ends
  points[num++] = point;
  *type         = PointGetLinear_Private(size);
  size          = 0;
  for (PetscInt i = 0; i < num; ++i) {
    const PetscInt node = PointGetNode(level, points[i]);

    if (node >= 0) nodes[size++] = node;
  }
  if (size > ElementNumNodes(*type)) *type = ElementOfOrder(*type, 2);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelGetNodePoints(const Level *level, PetscInt **point)
{
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(level->num_nodes, point));
  for (PetscInt p = level->point_begin; p < level->point_end; ++p) {
    const PetscInt node = PointGetNode(level, p);

    if (node >= 0) (*point)[node] = p;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

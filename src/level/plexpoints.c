/* plexpoints.c -- vertices and nodes of a single point of the mesh: a vertex, an edge, a facet, a cell.
   Coordinates of all vertices.

   Vertices are in the order of element.h from any first one, and so are nodes. Orientation of cells is known
   only with positions. */
#include "level/plexpoints.h"
#include <petscsf.h>
#include "base/compat.h"

/* The cell of order 1 on a point that is not a vertex. It is identified by the numbers of its facets and of
   the first facet's facets, without labels. [out] cone - its facets */
static PetscErrorCode PointGetLinear_Private(DM dm, PetscInt point, ElementType *type, const PetscInt *cone[])
{
  PetscInt size, facet_size;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetConeSize(dm, point, &size));
  PetscCall(DMPlexGetCone(dm, point, cone));
  PetscCall(DMPlexGetConeSize(dm, (*cone)[0], &facet_size));
  if (facet_size == 0)
    *type = ELEMENT_LINE2;
  else if (facet_size == ElementNumFacets(ELEMENT_LINE2))
    *type = size == ElementNumFacets(ELEMENT_TRI3) ? ELEMENT_TRI3 : ELEMENT_QUAD4;
  else
    *type = facet_size == ElementNumFacets(ELEMENT_TRI3) ? ELEMENT_TET4 : ELEMENT_HEX8;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Edge i of a polygon starts at corner i and runs against its own cone where its orientation is negative. */
static PetscErrorCode PolygonGetVertices_Private(DM dm, PetscInt point, PetscInt num, PetscInt vertices[])
{
  const PetscInt *cone, *orientation, *ends;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetCone(dm, point, &cone));
  PetscCall(DMPlexGetConeOrientation(dm, point, &orientation));
  for (PetscInt i = 0; i < num; i++) {
    PetscCall(DMPlexGetCone(dm, cone[i], &ends));
    vertices[i] = ends[orientation[i] < 0];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Index of an item, num if it is not among them. */
static PetscInt PointFindEqual_Private(PetscInt num, const PetscInt items[], PetscInt item)
{
  PetscInt i = 0;

  while (i < num && items[i] != item) i++;
  return i;
}

/* A solid's first facet in the DM is the first facet of element.h: its vertices run anticlockwise seen from
   outside. From each of them one edge leads to a vertex that is not on the facet. This is the apex, or the
   vertex with the number higher by the vertices of the facet. */
static PetscErrorCode SolidGetVertices_Private(DM dm, PetscInt point, ElementType type, const PetscInt cone[],
                                               PetscInt vertices[])
{
  const PetscInt  num = ElementNumNodes(ElementFacetType(type)), num_all = ElementNumNodes(type);
  const PetscInt *first = ElementFacetNodes(type, 0), *orientation;
  PetscInt        polygon[ELEMENT_MAX_FACET_NODES];

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetConeOrientation(dm, point, &orientation));
  PetscCall(PolygonGetVertices_Private(dm, cone[0], num, polygon));
  for (PetscInt i = 0; i < num; i++) vertices[first[orientation[0] < 0 ? num - 1 - i : i]] = polygon[i];
  for (PetscInt f = 1; f < ElementNumFacets(type); f++) {
    PetscCall(PolygonGetVertices_Private(dm, cone[f], num, polygon));
    for (PetscInt i = 0; i < num; i++) {
      const PetscInt a = polygon[i], b = polygon[(i + 1) % num];
      const PetscInt at_a = PointFindEqual_Private(num, vertices, a), at_b = PointFindEqual_Private(num, vertices, b);

      if (at_a < num && at_b == num) vertices[PetscMin(num + at_a, num_all - 1)] = b;
      if (at_b < num && at_a == num) vertices[PetscMin(num + at_b, num_all - 1)] = a;
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PointGetVertices(DM dm, PetscInt point, PetscInt *num, PetscInt vertices[])
{
  const PetscInt *cone;
  PetscInt        size;
  ElementType     type;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetConeSize(dm, point, &size));
  if (!size) {
    *num        = 1;
    vertices[0] = point;
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PointGetLinear_Private(dm, point, &type, &cone));
  *num = ElementNumNodes(type);
  if (ElementDim(type) == 1)
    PetscCall(PetscArraycpy(vertices, cone, *num));
  else if (ElementDim(type) == 2)
    PetscCall(PolygonGetVertices_Private(dm, point, *num, vertices));
  else
    PetscCall(SolidGetVertices_Private(dm, point, type, cone, vertices));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Triangles and tetrahedra of order 2 have nodes on their vertices and edges only. */
PetscErrorCode PointHasMiddle(DM dm, PetscInt point, PetscBool *has)
{
  const PetscInt *cone;
  PetscInt        size;
  ElementType     type;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetConeSize(dm, point, &size));
  *has = PETSC_FALSE;
  if (!size) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PointGetLinear_Private(dm, point, &type, &cone));
  *has = type != ELEMENT_TRI3 && type != ELEMENT_TET4 ? PETSC_TRUE : PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The edge between two vertices of a plane cell, whose facets are edges, or of a solid. */
static PetscErrorCode PointFindEdge_Private(DM dm, ElementType type, const PetscInt facets[], PetscInt a, PetscInt b,
                                            PetscInt *edge)
{
  const PetscInt  num_lists = ElementDim(type) == 2 ? 1 : ElementNumFacets(type);
  const PetscInt  num       = ElementDim(type) == 2 ? ElementNumEdges(type) : ElementNumEdges(ElementFacetType(type));
  const PetscInt *edges     = facets, *ends;

  PetscFunctionBeginUser;
  for (PetscInt f = 0; f < num_lists; f++) {
    if (ElementDim(type) > 2) PetscCall(DMPlexGetCone(dm, facets[f], &edges));
    for (PetscInt i = 0; i < num; i++) {
      PetscCall(DMPlexGetCone(dm, edges[i], &ends));
      *edge = edges[i];
      if ((ends[0] == a && ends[1] == b) || (ends[0] == b && ends[1] == a)) PetscFunctionReturn(PETSC_SUCCESS);
    }
  }
  SETERRQ(PETSC_COMM_SELF, PETSC_ERR_PLIB, "No edge from point %" PetscInt_FMT " to %" PetscInt_FMT, a, b);
}

PetscErrorCode PointFindFacet(DM dm, PetscInt point, PetscInt num, const PetscInt vertices[], PetscInt *facet)
{
  const PetscInt *cone;
  PetscInt        size, polygon[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetConeSize(dm, point, &size));
  PetscCall(DMPlexGetCone(dm, point, &cone));
  for (PetscInt f = 0; f < size; f++) {
    PetscInt num_found, found = 0;

    *facet = cone[f];
    PetscCall(PointGetVertices(dm, *facet, &num_found, polygon));
    for (PetscInt i = 0; i < num; i++) found += PointFindEqual_Private(num_found, polygon, vertices[i]) < num_found;
    if (num_found == num && found == num) PetscFunctionReturn(PETSC_SUCCESS);
  }
  SETERRQ(PETSC_COMM_SELF, PETSC_ERR_PLIB, "Point %" PetscInt_FMT " has no such facet", point);
}

PetscErrorCode PointGetMiddles(DM dm, PetscInt point, const PetscInt vertices[], PetscInt *num, PetscInt middles[])
{
  const PetscInt *cone;
  ElementType     type;
  PetscBool       has;

  PetscFunctionBeginUser;
  PetscCall(PointGetLinear_Private(dm, point, &type, &cone));
  *num = 0;
  for (PetscInt e = 0; e < ElementNumEdges(type) && ElementDim(type) > 1; e++) { // a line is its own edge
    const PetscInt *ends = ElementEdgeNodes(type, e);

    PetscCall(PointFindEdge_Private(dm, type, cone, vertices[ends[0]], vertices[ends[1]], &middles[(*num)++]));
  }
  for (PetscInt f = 0; f < ElementNumFacets(type) && type == ELEMENT_HEX8; f++) {
    const PetscInt *nodes = ElementFacetNodes(type, f), corners = ElementNumNodes(ElementFacetType(type));
    PetscInt        polygon[ELEMENT_MAX_FACET_NODES];

    for (PetscInt i = 0; i < corners; i++) polygon[i] = vertices[nodes[i]];
    PetscCall(PointFindFacet(dm, point, corners, polygon, &middles[(*num)++]));
  }
  PetscCall(PointHasMiddle(dm, point, &has));
  if (has) middles[(*num)++] = point;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscInt PointGetNode(const Level *level, PetscInt point)
{
  if (point < level->point_begin || point >= level->point_end) return -1;
  return level->point_node[point - level->point_begin];
}

/* Levels with nodes on vertices alone skip the search for middles. */
PetscErrorCode PointGetNodes(const Level *level, PetscInt point, ElementType *type, PetscInt nodes[])
{
  const PetscInt *cone;
  PetscInt        num, num_middles = 0, points[ELEMENT_MAX_NODES], size = 0;

  PetscFunctionBeginUser;
  PetscCall(PointGetLinear_Private(level->dm, point, type, &cone));
  PetscCall(PointGetVertices(level->dm, point, &num, points));
  if (point >= level->point_begin && point < level->point_end)
    PetscCall(PointGetMiddles(level->dm, point, points, &num_middles, points + num));
  for (PetscInt i = 0; i < num + num_middles; i++) {
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
  for (PetscInt i = 0; i < level->num_nodes; i++) (*point)[i] = -1;
  for (PetscInt p = level->point_begin; p < level->point_end; p++) {
    const PetscInt node = PointGetNode(level, p);

    if (node >= 0) (*point)[node] = p;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PointsMarkShared(DM dm, PetscBool **shared)
{
  PetscSF         sf;
  PetscInt        begin, end, num_roots, num_leaves;
  const PetscInt *leaves, *degree;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetChart(dm, &begin, &end));
  PetscCall(PetscCalloc1(end, shared));
  PetscCall(DMGetPointSF(dm, &sf));
  PetscCall(PetscSFGetGraph(sf, &num_roots, &num_leaves, &leaves, NULL));
  if (num_roots < 0) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt i = 0; i < num_leaves; i++) (*shared)[leaves ? leaves[i] : i] = PETSC_TRUE;
  PetscCall(PetscSFComputeDegreeBegin(sf, &degree));
  PetscCall(PetscSFComputeDegreeEnd(sf, &degree));
  for (PetscInt i = 0; i < num_roots; i++)
    if (degree[i]) (*shared)[i] = PETSC_TRUE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelMarkShared(const Level *level, PetscBool **shared)
{
  PetscInt begin, end;

  PetscFunctionBeginUser;
  PetscCall(PointsMarkShared(level->dm, shared));
  PetscCall(DMPlexGetHeightStratum(level->dm, 1, &begin, &end));
  for (PetscInt f = begin; f < end && level->inner; f++)
    (*shared)[f] = (PetscBool)((*shared)[f] || level->inner[f - begin]);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PlexCreateCoords(DM dm, PetscInt dim, Vec *coords)
{
  PetscInt     begin, end;
  PetscSection section;
  DM           coord_dm;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetDepthStratum(dm, 0, &begin, &end));
  PetscCall(DMSetCoordinateDim(dm, dim));
  PetscCall(DMGetCoordinateDM(dm, &coord_dm));
  PetscCall(DMGetCoordinateSection(dm, &section));
  PetscCall(PetscSectionSetNumFields(section, 1));
  PetscCall(PetscSectionSetFieldComponents(section, 0, dim));
  PetscCall(PetscSectionSetChart(section, begin, end));
  for (PetscInt v = begin; v < end; v++) {
    PetscCall(PetscSectionSetDof(section, v, dim));
    PetscCall(PetscSectionSetFieldDof(section, v, 0, dim));
  }
  PetscCall(PetscSectionSetUp(section));
  PetscCall(VecCreate(PETSC_COMM_SELF, coords));
  PetscCall(PetscObjectSetName((PetscObject)*coords, "coordinates"));
  PetscCall(VecSetSizes(*coords, (end - begin) * dim, PETSC_DETERMINE));
  PetscCall(VecSetBlockSize(*coords, dim));
  PetscCall(VecSetType(*coords, VECSTANDARD));
  PetscFunctionReturn(PETSC_SUCCESS);
}

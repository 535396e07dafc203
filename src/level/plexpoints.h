/* plexpoints.h -- points of the DMPlex: their vertices, their nodes, their neighbours on other ranks.

   Functions are not collective unless they say so. */
#ifndef MORTISE_PLEXPOINTS_H
#define MORTISE_PLEXPOINTS_H

#include "level/level.h"

/* Vertices of a point of the mesh: a vertex itself, the ends of an edge, the corners of a facet or a cell.
   [out] vertices -
   [ELEMENT_MAX_NODES] */
PetscErrorCode PointGetVertices(DM dm, PetscInt point, PetscInt *num, PetscInt vertices[]);
/* Whether order 2 has a node in the middle of an edge, a facet or a cell. */
PetscErrorCode PointHasMiddle(DM dm, PetscInt point, PetscBool *has);
/* The points with the middle nodes of an element of order 2: edges, quads of a hexahedron, the point itself.
   [in] vertices - in the order of the element, which may differ from that of PointGetVertices();
   [out] middles - [ELEMENT_MAX_NODES] */
PetscErrorCode PointGetMiddles(DM dm, PetscInt point, const PetscInt vertices[], PetscInt *num, PetscInt middles[]);
/* The facet of a cell that has exactly these vertices, in any order. */
PetscErrorCode PointFindFacet(DM dm, PetscInt point, PetscInt num, const PetscInt vertices[], PetscInt *facet);
/* The local node on a point, -1 where there is none. */
PetscInt PointGetNode(const Level *level, PetscInt point);
/* The element on an edge, a facet or a cell, in the order of element.h, though perhaps inside out.
   [out] nodes - local [ELEMENT_MAX_NODES] */
PetscErrorCode PointGetNodes(const Level *level, PetscInt point, ElementType *type, PetscInt nodes[]);
/* The point of the mesh of each local node, -1 where it is on other ranks alone. [out] point - [num_nodes],
   owned by the caller, PetscFree() */
PetscErrorCode LevelGetNodePoints(const Level *level, PetscInt **point);
/* Which points of the DM other ranks have as well: facets between ranks are no boundary. Collective. [out]
   shared - [end of the chart], freed by the caller */
PetscErrorCode PointsMarkShared(DM dm, PetscBool **shared);
/* The same, and facets beside hanging nodes. */
PetscErrorCode LevelMarkShared(const Level *level, PetscBool **shared);
/* Room for the positions of all vertices in order, for DMSetCoordinatesLocal(). Collective on the DM.
   [out] coords - [vertices][dim], owned by the caller */
PetscErrorCode PlexCreateCoords(DM dm, PetscInt dim, Vec *coords);

#endif

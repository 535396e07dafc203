/* plexlist.c -- lists of cells as one DMPlex.

   Points: cells sorted by type, then the vertices of list after list, then facets of solids and edges.
   DMPlexTransform needs each type of cells in one interval. */
#include "base/compat.h"
#include "bodies/bodylist.h"
#include "bodies/plexlist.h"
#include "bodies/skeleton.h"
#include "level/plexpoints.h"

/* Vertices of element.h in PETSc's order, in which the first facet of a solid, its first vertices, has an
   outward normal. */
static const PetscInt CONE_ORDER[ELEMENT_COUNT][8] = {[ELEMENT_LINE2] = {0, 1},
                                                      [ELEMENT_TRI3]  = {0, 1, 2},
                                                      [ELEMENT_QUAD4] = {0, 1, 2, 3},
                                                      [ELEMENT_TET4]  = {0, 2, 1, 3},
                                                      [ELEMENT_HEX8]  = {0, 3, 2, 1, 4, 5, 6, 7}};

/* All cells of a type in all bodies come before those of the next. */
PetscErrorCode NumberingCreate(PetscInt num_bodies, const BodyList lists[], Numbering *numbering)
{
  PetscInt point = 0;

  PetscFunctionBeginUser;
  *numbering = (Numbering){.num_bodies = num_bodies};
  PetscCall(PetscMalloc2(num_bodies, &numbering->point, num_bodies, &numbering->first_vertex));
  for (PetscInt b = 0; b < num_bodies; b++) PetscCall(PetscMalloc1(lists[b].num_cells, &numbering->point[b]));
  for (PetscInt type = 0; type < ELEMENT_COUNT; type++) {
    for (PetscInt b = 0; b < num_bodies; b++) {
      for (PetscInt c = 0; c < lists[b].num_cells; c++) {
        if (ElementLinear((ElementType)lists[b].cell_type[c]) == (ElementType)type) numbering->point[b][c] = point++;
      }
    }
  }
  numbering->num_cells = point;
  for (PetscInt b = 0; b < num_bodies; b++) {
    numbering->first_vertex[b] = point;
    point += lists[b].num_vertices;
  }
  numbering->num_vertices = point - numbering->num_cells;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode NumberingDestroy(Numbering *numbering)
{
  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < numbering->num_bodies; b++) PetscCall(PetscFree(numbering->point[b]));
  PetscCall(PetscFree2(numbering->point, numbering->first_vertex));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Cells with their vertices, counted from 0, in the order of their points. */
static PetscErrorCode ShapesOfCells_Private(const BodyList lists[], const Numbering *numbering, Shapes *cells)
{
  PetscInt *body, *index, num_corners = 0, vertices[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(numbering->num_cells, &body, numbering->num_cells, &index));
  for (PetscInt b = 0; b < numbering->num_bodies; b++) {
    for (PetscInt c = 0; c < lists[b].num_cells; c++) {
      body[numbering->point[b][c]]  = b;
      index[numbering->point[b][c]] = c;
      num_corners += ElementNumNodes(ElementLinear((ElementType)lists[b].cell_type[c]));
    }
  }
  PetscCall(ShapesCreate(numbering->num_cells, num_corners, cells));
  for (PetscInt p = 0; p < numbering->num_cells; p++) {
    const BodyList   *list  = &lists[body[p]];
    const ElementType type  = ElementLinear((ElementType)list->cell_type[index[p]]);
    const PetscInt    first = numbering->first_vertex[body[p]] - numbering->num_cells;

    for (PetscInt i = 0; i < ElementNumNodes(type); i++)
      vertices[i] = first + list->cell_nodes[index[p] * ELEMENT_MAX_NODES + CONE_ORDER[type][i]];
    ShapesAdd(cells, type, vertices);
  }
  PetscCall(PetscFree2(body, index));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets the shapes of a DM. [in] first - point of the first one; below - first point of their facets */
static PetscErrorCode PlexSetSizes_Private(DM dm, const Shapes *shapes, PetscInt first)
{
  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < shapes->num; i++) {
    PetscCall(DMPlexSetConeSize(dm, first + i, ElementNumFacets((ElementType)shapes->type[i])));
    PetscCall(DMPlexSetCellType(dm, first + i, PlexPolytope[shapes->type[i]]));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode PlexSetCones_Private(DM dm, const Shapes *shapes, PetscInt first, PetscInt below)
{
  PetscInt cone[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < shapes->num; i++) {
    const PetscInt start = shapes->cone_start[i], num = shapes->cone_start[i + 1] - start;

    for (PetscInt f = 0; f < num; f++) cone[f] = below + shapes->cone[start + f];
    PetscCall(DMPlexSetCone(dm, first + i, cone));
    PetscCall(DMPlexSetConeOrientation(dm, first + i, &shapes->orientation[start]));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Shapes by dimension, from that of the cells down to 1. A point is bounded by those of the next, an edge by
   vertices. */
static PetscErrorCode PlexSetShapes_Private(DM dm, PetscInt dim, const Shapes shapes[], PetscInt num_vertices)
{
  PetscInt first[4] = {shapes[dim].num, 0, 0, 0}, end = shapes[dim].num + num_vertices;

  PetscFunctionBeginUser;
  for (PetscInt d = dim - 1; d > 0; d--) {
    first[d] = end;
    end += shapes[d].num;
  }
  PetscCall(DMPlexSetChart(dm, 0, end));
  PetscCall(DMCreateLabel(dm, "celltype")); // set here: PETSc would derive the types from the cones
  for (PetscInt d = dim; d > 0; d--) PetscCall(PlexSetSizes_Private(dm, &shapes[d], first[d]));
  for (PetscInt v = 0; v < num_vertices; v++) PetscCall(DMPlexSetCellType(dm, first[0] + v, DM_POLYTOPE_POINT));
  PetscCall(DMSetUp(dm));
  for (PetscInt d = dim; d > 1; d--) PetscCall(PlexSetCones_Private(dm, &shapes[d], first[d], first[d - 1]));
  for (PetscInt e = 0; e < shapes[1].num; e++) {
    const PetscInt *ends = &shapes[1].vertex[shapes[1].start[e]];

    PetscCall(DMPlexSetCone(dm, first[1] + e, (const PetscInt[]){first[0] + ends[0], first[0] + ends[1]}));
  }
  // nodes of two bodies that coincide are different points, so nothing connects bodies
  PetscCall(DMPlexSymmetrize(dm));
  PetscCall(DMPlexStratify(dm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Positions before any map: refinement halves edges there, and maps are applied to the result. */
static PetscErrorCode PlexSetCoords_Private(const BodyList lists[], const Numbering *numbering, PetscInt dim, DM dm)
{
  Vec          coords;
  PetscScalar *x;

  PetscFunctionBeginUser;
  PetscCall(PlexCreateCoords(dm, dim, &coords));
  PetscCall(VecGetArray(coords, &x));
  for (PetscInt b = 0; b < numbering->num_bodies; b++) {
    const PetscInt offset = (numbering->first_vertex[b] - numbering->num_cells) * dim;

    for (PetscInt i = 0; i < lists[b].num_vertices * dim; i++) x[offset + i] = lists[b].coords[i];
  }
  PetscCall(VecRestoreArray(coords, &x));
  PetscCall(DMSetCoordinatesLocal(dm, coords));
  PetscCall(VecDestroy(&coords));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PlexCreate(MPI_Comm comm, PetscInt dim, const BodyList lists[], const Numbering *numbering, DM *dm)
{
  Shapes shapes[4];

  PetscFunctionBeginUser;
  PetscCall(DMCreate(comm, dm));
  PetscCall(DMSetType(*dm, DMPLEX));
  PetscCall(DMSetDimension(*dm, dim));
  PetscCall(ShapesOfCells_Private(lists, numbering, &shapes[dim]));
  for (PetscInt d = dim; d > 1; d--) PetscCall(ShapesBound(&shapes[d], numbering->num_vertices, &shapes[d - 1]));
  PetscCall(PlexSetShapes_Private(*dm, dim, shapes, numbering->num_vertices));
  for (PetscInt d = dim; d > 0; d--) PetscCall(ShapesDestroy(&shapes[d]));
  PetscCall(PlexSetCoords_Private(lists, numbering, dim, *dm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

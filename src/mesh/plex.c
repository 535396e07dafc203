/* plex.c -- lists of cells as one DMPlex.

   Points: cells sorted by type (DMPlexTransform numbers what it makes by type and needs each type in one run), then the
   vertices of list after list; edges and facets of solids come behind by DMPlexInterpolate(). */
#include "room.h"
#include <mortise/compat.h>

static const DMPolytopeType Polytope[ELEMENT_COUNT] = {[ELEMENT_LINE2] = DM_POLYTOPE_SEGMENT,
                                                       [ELEMENT_TRI3]  = DM_POLYTOPE_TRIANGLE,
                                                       [ELEMENT_QUAD4] = DM_POLYTOPE_QUADRILATERAL,
                                                       [ELEMENT_TET4]  = DM_POLYTOPE_TETRAHEDRON,
                                                       [ELEMENT_HEX8]  = DM_POLYTOPE_HEXAHEDRON};

/* Our vertices in PETSc's order, in which the first facet of a solid, its first vertices, is seen from outside. */
static const PetscInt ConeOrder[ELEMENT_COUNT][8] = {[ELEMENT_LINE2] = {0, 1},
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
  for (PetscInt b = 0; b < num_bodies; ++b) PetscCall(PetscMalloc1(lists[b].num_cells, &numbering->point[b]));
  for (PetscInt type = 0; type < ELEMENT_COUNT; ++type) {
    for (PetscInt b = 0; b < num_bodies; ++b) {
      for (PetscInt c = 0; c < lists[b].num_cells; ++c) {
        if (ElementLinear((ElementType)lists[b].cell_type[c]) == (ElementType)type) numbering->point[b][c] = point++;
      }
    }
  }
  numbering->num_cells = point;
  for (PetscInt b = 0; b < num_bodies; ++b) {
    numbering->first_vertex[b] = point;
    point += lists[b].num_vertices;
  }
  numbering->num_vertices = point - numbering->num_cells;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode NumberingDestroy(Numbering *numbering)
{
  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < numbering->num_bodies; ++b) PetscCall(PetscFree(numbering->point[b]));
  PetscCall(PetscFree2(numbering->point, numbering->first_vertex));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Cells with their vertices as cones. */
static PetscErrorCode PlexSetCones_Private(const BodyList lists[], const Numbering *numbering, DM dm)
{
  PetscInt cone[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  PetscCall(DMPlexSetChart(dm, 0, numbering->num_cells + numbering->num_vertices));
  PetscCall(DMCreateLabel(dm, "celltype")); // kept by hand: PETSc would guess the types from the sizes of the cones
  for (PetscInt b = 0; b < numbering->num_bodies; ++b) {
    for (PetscInt c = 0; c < lists[b].num_cells; ++c) {
      const ElementType linear = ElementLinear((ElementType)lists[b].cell_type[c]);

      PetscCall(DMPlexSetConeSize(dm, numbering->point[b][c], ElementNumNodes(linear)));
      PetscCall(DMPlexSetCellType(dm, numbering->point[b][c], Polytope[linear]));
    }
  }
  for (PetscInt v = 0; v < numbering->num_vertices; ++v)
    PetscCall(DMPlexSetCellType(dm, numbering->num_cells + v, DM_POLYTOPE_POINT));
  PetscCall(DMSetUp(dm));
  for (PetscInt b = 0; b < numbering->num_bodies; ++b) {
    for (PetscInt c = 0; c < lists[b].num_cells; ++c) {
      const ElementType linear = ElementLinear((ElementType)lists[b].cell_type[c]);

      for (PetscInt i = 0; i < ElementNumNodes(linear); ++i)
        cone[i] = numbering->first_vertex[b] + lists[b].cell_nodes[c * ELEMENT_MAX_NODES + ConeOrder[linear][i]];
      PetscCall(DMPlexSetCone(dm, numbering->point[b][c], cone));
    }
  }
  // nodes of two bodies that coincide are different points, so bodies hang together by nothing
  PetscCall(DMPlexSymmetrize(dm));
  PetscCall(DMPlexStratify(dm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Positions before any map: refinement halves edges there, and maps are applied to what comes out. */
static PetscErrorCode PlexSetCoords_Private(const BodyList lists[], const Numbering *numbering, PetscInt dim, DM dm)
{
  const PetscInt first = numbering->num_cells, end = first + numbering->num_vertices;
  PetscSection   section;
  Vec            coords;
  PetscScalar   *x;
  DM             coord_dm;

  PetscFunctionBeginUser;
  PetscCall(DMSetCoordinateDim(dm, dim));
  PetscCall(DMGetCoordinateDM(dm, &coord_dm));
  PetscCall(DMGetCoordinateSection(dm, &section));
  PetscCall(PetscSectionSetNumFields(section, 1));
  PetscCall(PetscSectionSetFieldComponents(section, 0, dim));
  PetscCall(PetscSectionSetChart(section, first, end));
  for (PetscInt v = first; v < end; ++v) {
    PetscCall(PetscSectionSetDof(section, v, dim));
    PetscCall(PetscSectionSetFieldDof(section, v, 0, dim));
  }
  PetscCall(PetscSectionSetUp(section));
  PetscCall(VecCreate(PETSC_COMM_SELF, &coords));
  PetscCall(PetscObjectSetName((PetscObject)coords, "coordinates"));
  PetscCall(VecSetSizes(coords, numbering->num_vertices * dim, PETSC_DETERMINE));
  PetscCall(VecSetBlockSize(coords, dim));
  PetscCall(VecSetType(coords, VECSTANDARD));
  PetscCall(VecGetArray(coords, &x));
  for (PetscInt b = 0; b < numbering->num_bodies; ++b) {
    const PetscInt offset = (numbering->first_vertex[b] - first) * dim;

    for (PetscInt i = 0; i < lists[b].num_vertices * dim; ++i) x[offset + i] = lists[b].coords[i];
  }
  PetscCall(VecRestoreArray(coords, &x));
  PetscCall(DMSetCoordinatesLocal(dm, coords));
  PetscCall(VecDestroy(&coords));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PlexCreate(MPI_Comm comm, PetscInt dim, const BodyList lists[], const Numbering *numbering, DM *dm)
{
  DM cells;

  PetscFunctionBeginUser;
  PetscCall(DMCreate(comm, &cells));
  PetscCall(DMSetType(cells, DMPLEX));
  PetscCall(DMSetDimension(cells, dim));
  PetscCall(PlexSetCones_Private(lists, numbering, cells));
  PetscCall(DMPlexInterpolate(cells, dm)); // adds what is between; cells and vertices keep their numbers
  PetscCall(DMDestroy(&cells));
  PetscCall(PlexSetCoords_Private(lists, numbering, dim, *dm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* merge.c -- all bodies in one DMPlex, disconnected, on the first rank.

   Points: cells sorted by type (DMPlexTransform numbers what it makes by type and needs each type in one run), then the
   nodes of body after body; edges come behind by DMPlexInterpolate(). Coincident nodes of two bodies stay two nodes. */
#include "room.h"
#include <mortise/compat.h>

static const DMPolytopeType Polytope[ELEMENT_COUNT] = {[ELEMENT_LINE2] = DM_POLYTOPE_SEGMENT,
                                                       [ELEMENT_TRI3]  = DM_POLYTOPE_TRIANGLE,
                                                       [ELEMENT_QUAD4] = DM_POLYTOPE_QUADRILATERAL};

/* Where the bodies' cells and nodes are among the points. */
typedef struct {
  PetscInt   num_bodies, num_cells, num_nodes;
  PetscInt **point;      /* of every cell of every body [num_bodies][num_cells] */
  PetscInt  *first_node; /* point of the body's first node [num_bodies] */
} Numbering;

/* All triangles of all bodies come before all quads. */
static PetscErrorCode NumberingCreate_Private(PetscInt num_bodies, const BodyList lists[], Numbering *numbering)
{
  PetscInt point = 0;

  PetscFunctionBeginUser;
  *numbering = (Numbering){.num_bodies = num_bodies};
  PetscCall(PetscMalloc2(num_bodies, &numbering->point, num_bodies, &numbering->first_node));
  for (PetscInt b = 0; b < num_bodies; ++b) PetscCall(PetscMalloc1(lists[b].num_cells, &numbering->point[b]));
  for (PetscInt type = 0; type < ELEMENT_COUNT; ++type) {
    for (PetscInt b = 0; b < num_bodies; ++b) {
      for (PetscInt c = 0; c < lists[b].num_cells; ++c) {
        if (lists[b].cell_type[c] == type) numbering->point[b][c] = point++;
      }
    }
  }
  numbering->num_cells = point;
  for (PetscInt b = 0; b < num_bodies; ++b) {
    numbering->first_node[b] = point;
    point += lists[b].num_nodes;
  }
  numbering->num_nodes = point - numbering->num_cells;
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode NumberingDestroy_Private(Numbering *numbering)
{
  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < numbering->num_bodies; ++b) PetscCall(PetscFree(numbering->point[b]));
  PetscCall(PetscFree2(numbering->point, numbering->first_node));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Cells with their nodes as cones. */
static PetscErrorCode MergeSetCones_Private(const BodyList lists[], const Numbering *numbering, DM dm)
{
  PetscInt cone[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  PetscCall(DMPlexSetChart(dm, 0, numbering->num_cells + numbering->num_nodes));
  PetscCall(DMCreateLabel(dm, "celltype")); // kept by hand: PETSc would guess the types from the sizes of the cones
  for (PetscInt b = 0; b < numbering->num_bodies; ++b) {
    for (PetscInt c = 0; c < lists[b].num_cells; ++c) {
      PetscCall(DMPlexSetConeSize(dm, numbering->point[b][c], ElementNumNodes((ElementType)lists[b].cell_type[c])));
      PetscCall(DMPlexSetCellType(dm, numbering->point[b][c], Polytope[lists[b].cell_type[c]]));
    }
  }
  for (PetscInt v = 0; v < numbering->num_nodes; ++v)
    PetscCall(DMPlexSetCellType(dm, numbering->num_cells + v, DM_POLYTOPE_POINT));
  PetscCall(DMSetUp(dm));
  for (PetscInt b = 0; b < numbering->num_bodies; ++b) {
    for (PetscInt c = 0; c < lists[b].num_cells; ++c) {
      const PetscInt num = ElementNumNodes((ElementType)lists[b].cell_type[c]);

      for (PetscInt i = 0; i < num; ++i)
        cone[i] = numbering->first_node[b] + lists[b].cell_nodes[c * ELEMENT_MAX_NODES + i];
      PetscCall(DMPlexSetCone(dm, numbering->point[b][c], cone));
    }
  }
  // nodes of two bodies that coincide are different points, so bodies hang together by nothing
  PetscCall(DMPlexSymmetrize(dm));
  PetscCall(DMPlexStratify(dm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Positions before any map: refinement halves edges there, and maps are applied to what comes out. */
static PetscErrorCode MergeSetCoords_Private(const BodyList lists[], const Numbering *numbering, PetscInt dim, DM dm)
{
  const PetscInt first = numbering->num_cells, end = first + numbering->num_nodes;
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
  PetscCall(VecSetSizes(coords, numbering->num_nodes * dim, PETSC_DETERMINE));
  PetscCall(VecSetBlockSize(coords, dim));
  PetscCall(VecSetType(coords, VECSTANDARD));
  PetscCall(VecGetArray(coords, &x));
  for (PetscInt b = 0; b < numbering->num_bodies; ++b) {
    const PetscInt offset = (numbering->first_node[b] - first) * dim;

    for (PetscInt i = 0; i < lists[b].num_nodes * dim; ++i) x[offset + i] = lists[b].coords[i];
  }
  PetscCall(VecRestoreArray(coords, &x));
  PetscCall(DMSetCoordinatesLocal(dm, coords));
  PetscCall(VecDestroy(&coords));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* "body" on cells; "<body>:<side>" on facets, value 1. All ranks make the labels, the first one fills them;
   distribution and refinement carry them on. */
static PetscErrorCode MergeSetLabels_Private(Scene scene, const BodyList lists[], const SideNames names[],
                                             const Numbering *numbering, DM dm)
{
  DMLabel label;

  PetscFunctionBeginUser;
  PetscCall(DMCreateLabel(dm, "body"));
  PetscCall(DMGetLabel(dm, "body", &label));
  for (PetscInt b = 0; b < numbering->num_bodies; ++b) {
    for (PetscInt c = 0; c < lists[b].num_cells; ++c) PetscCall(DMLabelSetValue(label, numbering->point[b][c], b));
  }
  for (PetscInt b = 0; b < numbering->num_bodies; ++b) {
    for (PetscInt s = 0; s < names[b].num; ++s) {
      char text[PETSC_MAX_PATH_LEN];

      PetscCall(PetscSNPrintf(text, sizeof(text), "%s:%s", scene->bodies[b].name, names[b].name[s]));
      PetscCall(DMCreateLabel(dm, text));
      PetscCall(DMGetLabel(dm, text, &label));
      for (PetscInt f = 0; f < lists[b].num_facets; ++f) {
        const PetscInt *cone;

        if (lists[b].facet_side[f] != s) continue;
        PetscCall(DMPlexGetCone(dm, numbering->point[b][lists[b].facet_cell[f]], &cone));
        PetscCall(DMLabelSetValue(label, cone[lists[b].facet[f]], 1)); // a Plex polygon counts its edges like element.h
      }
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshMerge(Scene scene, const BodyList lists[], const SideNames names[], DM *dm)
{
  Numbering numbering;
  DM        cells;

  PetscFunctionBeginUser;
  PetscCall(NumberingCreate_Private(scene->num_bodies, lists, &numbering));
  PetscCall(DMCreate(scene->comm, &cells));
  PetscCall(DMSetType(cells, DMPLEX));
  PetscCall(DMSetDimension(cells, scene->dim));
  PetscCall(MergeSetCones_Private(lists, &numbering, cells));
  PetscCall(DMPlexInterpolate(cells, dm)); // adds the edges; cells and nodes keep their numbers
  PetscCall(DMDestroy(&cells));
  PetscCall(MergeSetCoords_Private(lists, &numbering, scene->dim, *dm));
  PetscCall(MergeSetLabels_Private(scene, lists, names, &numbering, *dm));
  PetscCall(NumberingDestroy_Private(&numbering));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* gmshplex.c -- a Gmsh file as one DMPlex.

   Physical groups are the labels "Cell Sets" and "Face Sets". Cells of second order have positions of middle
   nodes.

   Cells are the elements of the scene's dimension, facets those of one less; others are ignored. */
#include "base/compat.h"
#include "bodies/bodylist.h"
#include "bodies/cellmiddles.h"
#include "bodies/curvedfile.h"
#include "bodies/gmshplex.h"
#include "bodies/plexlist.h"
#include <string.h>

/* The nodes first .. end-1 of a cell. [in,out] number - of the file's nodes in the list, -1 before */
static void CellSetNodes_Private(const GmshMesh *mesh, PetscInt e, PetscInt cell, PetscInt first, PetscInt end,
                                 PetscInt number[], BodyList *list)
{
  for (PetscInt i = first; i < end; i++) {
    const PetscInt node = mesh->nodes[mesh->start[e] + i];

    if (number[node] < 0) {
      number[node] = list->num_nodes++;
      for (PetscInt d = 0; d < list->dim; d++) list->coords[number[node] * list->dim + d] = mesh->coords[3 * node + d];
    }
    list->cell_nodes[cell * ELEMENT_MAX_NODES + i] = number[node];
  }
}

/* All cells of the file, vertices numbered before other nodes. [out] number - as above [mesh->num_nodes] */
static PetscErrorCode GmshGetCells_Private(const GmshMesh *mesh, PetscInt dim, PetscInt number[], BodyList *list)
{
  PetscInt num_cells = 0, num_middles = 0;

  PetscFunctionBeginUser;
  for (PetscInt e = 0; e < mesh->num_elements; e++) {
    if (mesh->type[e]->dim != dim) continue;
    num_cells++;
    num_middles += ElementNumNodes(mesh->type[e]->cell) - mesh->type[e]->num_nodes;
  }
  PetscCall(BodyListAllocate(dim, num_cells, mesh->num_nodes + num_middles, 0, list));
  list->num_nodes = 0;
  for (PetscInt n = 0; n < mesh->num_nodes; n++) number[n] = -1;
  for (int middles = 0; middles < 2; middles++) {
    for (PetscInt e = 0, cell = 0; e < mesh->num_elements; e++) {
      const GmshType *type = mesh->type[e];
      PetscInt        corners;

      if (type->dim != dim) continue;
      corners               = GmshNumCorners(mesh, e);
      list->cell_type[cell] = type->cell;
      CellSetNodes_Private(mesh, e, cell, middles ? corners : 0, middles ? type->num_nodes : corners, number, list);
      if (middles) CellSetMiddles(cell, type->num_nodes, list);
      cell++;
    }
    if (!middles) list->num_vertices = list->num_nodes;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The facet of the DM that an element of the file is, -1 if it is none. */
static PetscErrorCode GmshGetFacetPoint_Private(const GmshMesh *mesh, PetscInt e, const PetscInt number[], DM dm,
                                                PetscInt *point)
{
  const PetscInt *nodes = &mesh->nodes[mesh->start[e]], *join, corners = GmshNumCorners(mesh, e);
  PetscInt        first, last, begin, end, num, size, vertices[ELEMENT_MAX_FACET_NODES];

  PetscFunctionBeginUser;
  *point = -1;
  PetscCall(DMPlexGetDepthStratum(dm, 0, &first, &last));
  PetscCall(DMPlexGetHeightStratum(dm, 1, &begin, &end));
  for (PetscInt i = 0; i < corners; i++) {
    vertices[i] = first + number[nodes[i]];
    if (vertices[i] < first || vertices[i] >= last) PetscFunctionReturn(PETSC_SUCCESS); // no cell has a corner there
  }
  PetscCall(DMPlexGetFullJoin(dm, corners, vertices, &num, &join));
  for (PetscInt i = 0; i < num; i++) { // three corners of a quadrangle may be those of a triangle of another body
    if (join[i] < begin || join[i] >= end) continue;
    PetscCall(DMPlexGetConeSize(dm, join[i], &size)); // a facet has as many sides as corners
    if (size == corners) *point = join[i];
  }
  PetscCall(DMPlexRestoreJoin(dm, corners, vertices, &num, &join));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* "its triangle with corners (0, 0, 0), .. in physical group 7 is not a facet of any cell" */
static void GmshDescribeFacet_Private(const GmshMesh *mesh, PetscInt e, PetscInt dim, char reason[])
{
  snprintf(reason, MESH_SENTENCE, "one of its %s in physical group %d, with the corners", mesh->type[e]->name,
           (int)mesh->group[mesh->first_group[e]]);
  GmshDescribeElement(mesh, e, dim, reason, MESH_SENTENCE);
  snprintf(reason + strlen(reason), MESH_SENTENCE - strlen(reason), ", is not a facet of any cell");
}

/* Every physical group is a value of one of two labels. [in] point - of every cell in the DM */
static PetscErrorCode GmshSetLabels_Private(const GmshMesh *mesh, const PetscInt number[], const PetscInt point[],
                                            PetscInt dim, DM dm, char reason[])
{
  DMLabel  cells, facets;
  PetscInt cell = 0;

  PetscFunctionBeginUser;
  PetscCall(DMCreateLabel(dm, "Cell Sets"));
  PetscCall(DMCreateLabel(dm, "Face Sets"));
  PetscCall(DMGetLabel(dm, "Cell Sets", &cells));
  PetscCall(DMGetLabel(dm, "Face Sets", &facets));
  for (PetscInt e = 0; e < mesh->num_elements && !reason[0]; e++) {
    const PetscBool is_cell = mesh->type[e]->dim == dim ? PETSC_TRUE : PETSC_FALSE;
    PetscInt        at;

    if (is_cell)
      at = point[cell++];
    else if (mesh->type[e]->dim == dim - 1 && mesh->first_group[e] < mesh->end_group[e])
      PetscCall(GmshGetFacetPoint_Private(mesh, e, number, dm, &at));
    else
      continue; // in no group, or the edge of a solid
    if (at < 0) GmshDescribeFacet_Private(mesh, e, dim, reason);
    for (PetscInt g = mesh->first_group[e]; g < mesh->end_group[e] && at >= 0; g++)
      PetscCall(DMLabelSetValue(is_cell ? cells : facets, at, mesh->group[g]));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GmshPlexCreate(const GmshMesh *mesh, PetscInt dim, DM *dm, Curves *curves, char reason[])
{
  BodyList  list;
  Numbering numbering;
  PetscInt *number;

  PetscFunctionBeginUser;
  PetscCall(GmshCheck(mesh, dim, reason, MESH_SENTENCE));
  if (reason[0]) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(mesh->num_nodes, &number));
  PetscCall(GmshGetCells_Private(mesh, dim, number, &list));
  PetscCall(NumberingCreate(1, &list, &numbering));
  PetscCall(PlexCreate(PETSC_COMM_SELF, dim, &list, &numbering, dm));
  PetscCall(CurvesCreate(*dm, &list, &numbering, curves));
  PetscCall(GmshSetLabels_Private(mesh, number, numbering.point[0], dim, *dm, reason));
  PetscCall(NumberingDestroy(&numbering));
  PetscCall(BodyListDestroy(&list));
  PetscCall(PetscFree(number));
  PetscFunctionReturn(PETSC_SUCCESS);
}

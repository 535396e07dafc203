/* gmshplex.c -- a Gmsh file as one DMPlex, with its physical groups as labels "Cell Sets" and "Face Sets", and the
   positions of middle nodes where its cells are of second order. */
#include "room.h"
#include <mortise/compat.h>

enum { GMSH_QUAD8 = 16 }; /* a quad9 whose own middle is left to the reader */

/* What a Gmsh element is as a cell; PETSC_FALSE for a line. */
static PetscBool CellGetType_Private(PetscInt gmsh, ElementType *type)
{
  static const struct {
    PetscInt    gmsh;
    ElementType type;
  } cells[] = {
      {2, ELEMENT_TRI3}, {9, ELEMENT_TRI6}, {3, ELEMENT_QUAD4}, {10, ELEMENT_QUAD9}, {GMSH_QUAD8, ELEMENT_QUAD9}};

  for (size_t i = 0; i < sizeof(cells) / sizeof(cells[0]); ++i) {
    if (cells[i].gmsh != gmsh) continue;
    *type = cells[i].type;
    return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* Whether the cells have the scene's dimension and are plane. [out] reason - "" if so [MESH_SENTENCE] */
static void GmshCheckPlane_Private(const GmshMesh *mesh, PetscInt dim, char reason[])
{
  PetscInt  highest = 0;
  PetscReal lower[3], upper[3];

  for (PetscInt d = 0; d < 3; ++d) {
    lower[d] = PETSC_MAX_REAL;
    upper[d] = -PETSC_MAX_REAL;
  }
  for (PetscInt e = 0; e < mesh->num_elements; ++e) {
    PetscInt of_type, num;

    GmshTypeGet(mesh->type[e], &of_type, &num);
    highest = PetscMax(highest, of_type);
    for (PetscInt i = 0; i < 3 * num && of_type == dim; ++i) {
      const PetscReal x = mesh->coords[3 * mesh->nodes[e * GMSH_MAX_NODES + i / 3] + i % 3];

      lower[i % 3] = PetscMin(lower[i % 3], x);
      upper[i % 3] = PetscMax(upper[i % 3], x);
    }
  }
  if (highest == dim)
    FileCheckHeight(lower, upper, reason);
  else
    snprintf(reason, MESH_SENTENCE, "its cells have dimension %d, the scene has %d", (int)highest, (int)dim);
}

/* The last node of a cell of eight: where serendipity shape functions have the middle. */
static void CellSetMiddle_Private(PetscInt cell, BodyList *list)
{
  const PetscInt dim = list->dim, corners = ElementNumNodes(ELEMENT_QUAD4), middle = list->num_nodes++;
  PetscInt      *nodes = &list->cell_nodes[cell * ELEMENT_MAX_NODES];

  nodes[2 * corners] = middle;
  for (PetscInt d = 0; d < dim; ++d) {
    list->coords[middle * dim + d] = 0;
    for (PetscInt i = 0; i < corners; ++i)
      list->coords[middle * dim + d] +=
          0.5 * list->coords[nodes[corners + i] * dim + d] - 0.25 * list->coords[nodes[i] * dim + d];
  }
}

/* The nodes first .. end-1 of a cell. [in,out] number - of the file's nodes in the list, -1 before */
static void CellSetNodes_Private(const GmshMesh *mesh, PetscInt e, PetscInt cell, PetscInt first, PetscInt end,
                                 PetscInt number[], BodyList *list)
{
  for (PetscInt i = first; i < end; ++i) {
    const PetscInt node = mesh->nodes[e * GMSH_MAX_NODES + i];

    if (number[node] < 0) {
      number[node] = list->num_nodes++;
      for (PetscInt d = 0; d < list->dim; ++d) list->coords[number[node] * list->dim + d] = mesh->coords[3 * node + d];
    }
    list->cell_nodes[cell * ELEMENT_MAX_NODES + i] = number[node];
  }
}

/* All cells of the file, vertices numbered before other nodes. [out] number - as above [mesh->num_nodes] */
static PetscErrorCode GmshGetCells_Private(const GmshMesh *mesh, PetscInt dim, PetscInt number[], BodyList *list)
{
  PetscInt    num_cells = 0, num_middles = 0;
  ElementType type;

  PetscFunctionBeginUser;
  for (PetscInt e = 0; e < mesh->num_elements; ++e) {
    num_cells += CellGetType_Private(mesh->type[e], &type);
    num_middles += mesh->type[e] == GMSH_QUAD8;
  }
  PetscCall(BodyListAllocate(dim, num_cells, mesh->num_nodes + num_middles, 0, list));
  list->num_nodes = 0;
  for (PetscInt n = 0; n < mesh->num_nodes; ++n) number[n] = -1;
  for (int middles = 0; middles < 2; ++middles) {
    for (PetscInt e = 0, cell = 0; e < mesh->num_elements; ++e) {
      PetscInt of_type, num, corners;

      if (!CellGetType_Private(mesh->type[e], &type)) continue;
      GmshTypeGet(mesh->type[e], &of_type, &num);
      corners               = ElementNumNodes(ElementLinear(type));
      list->cell_type[cell] = type;
      CellSetNodes_Private(mesh, e, cell, middles ? corners : 0, middles ? num : corners, number, list);
      if (middles && mesh->type[e] == GMSH_QUAD8) CellSetMiddle_Private(cell, list);
      ++cell;
    }
    if (!middles) list->num_vertices = list->num_nodes;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The edge of the DM that a line of the file is, -1 if it is none. */
static PetscErrorCode LineGetPoint_Private(const GmshMesh *mesh, PetscInt e, const PetscInt number[], DM dm,
                                           PetscInt *point)
{
  const PetscInt *nodes = &mesh->nodes[e * GMSH_MAX_NODES], *join;
  PetscInt        begin, num, ends[2];

  PetscFunctionBeginUser;
  *point = -1;
  PetscCall(DMPlexGetDepthStratum(dm, 0, &begin, NULL));
  for (PetscInt i = 0; i < 2; ++i) {
    if (number[nodes[i]] < 0) PetscFunctionReturn(PETSC_SUCCESS); // no cell is there
    ends[i] = begin + number[nodes[i]];
  }
  PetscCall(DMPlexGetFullJoin(dm, 2, ends, &num, &join));
  if (num == 1) *point = join[0];
  PetscCall(DMPlexRestoreJoin(dm, 2, ends, &num, &join));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Every physical group is a value of one of two labels. [in] point - of every cell in the DM */
static PetscErrorCode GmshSetLabels_Private(const GmshMesh *mesh, const PetscInt number[], const PetscInt point[],
                                            DM dm, char reason[])
{
  DMLabel  cells, facets;
  PetscInt cell = 0;

  PetscFunctionBeginUser;
  PetscCall(DMCreateLabel(dm, "Cell Sets"));
  PetscCall(DMCreateLabel(dm, "Face Sets"));
  PetscCall(DMGetLabel(dm, "Cell Sets", &cells));
  PetscCall(DMGetLabel(dm, "Face Sets", &facets));
  for (PetscInt e = 0; e < mesh->num_elements && !reason[0]; ++e) {
    const PetscReal *a = &mesh->coords[3 * mesh->nodes[e * GMSH_MAX_NODES]],
                    *b = &mesh->coords[3 * mesh->nodes[e * GMSH_MAX_NODES + 1]];
    ElementType     type;
    const PetscBool is_cell = CellGetType_Private(mesh->type[e], &type);
    PetscInt        at;

    if (is_cell)
      at = point[cell++];
    else if (mesh->first_group[e] < mesh->end_group[e])
      PetscCall(LineGetPoint_Private(mesh, e, number, dm, &at));
    else
      continue; // a line in no group
    if (at < 0) {
      snprintf(reason, MESH_SENTENCE, "its line from (%g, %g) to (%g, %g) is not a side of any cell", (double)a[0],
               (double)a[1], (double)b[0], (double)b[1]);
      break;
    }
    for (PetscInt g = mesh->first_group[e]; g < mesh->end_group[e]; ++g)
      PetscCall(DMLabelSetValue(is_cell ? cells : facets, at, mesh->group[g]));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GmshToPlex(const GmshMesh *mesh, PetscInt dim, DM *dm, Curves *curves, char reason[])
{
  BodyList  list;
  Numbering numbering;
  PetscInt *number;

  PetscFunctionBeginUser;
  GmshCheckPlane_Private(mesh, dim, reason);
  if (reason[0]) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(mesh->num_nodes, &number));
  PetscCall(GmshGetCells_Private(mesh, dim, number, &list));
  PetscCall(NumberingCreate(1, &list, &numbering));
  PetscCall(PlexCreate(PETSC_COMM_SELF, dim, &list, &numbering, dm));
  PetscCall(CurvesCreate(*dm, &list, &numbering, curves));
  PetscCall(GmshSetLabels_Private(mesh, number, numbering.point[0], *dm, reason));
  PetscCall(NumberingDestroy(&numbering));
  PetscCall(BodyListDestroy(&list));
  PetscCall(PetscFree(number));
  PetscFunctionReturn(PETSC_SUCCESS);
}

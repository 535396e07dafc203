/* filesides.c -- the sides of a body from the mesh of its file.

   A facet belongs to a side of the body if it has the side's number and is on the boundary of the body's own
   cells. Facets between the regions of two bodies of one file may be on sides of both. */
#include "base/compat.h"
#include "bodies/bodylist.h"
#include "bodies/fileextract.h"
#include "bodies/filesides.h"
#include "level/facets.h"
#include "level/plexpoints.h"
#include <string.h>

/* Facets of a physical group. */
typedef struct {
  PetscInt num;                /* on the body's boundary */
  PetscInt num_inside, inside; /* inside the body, and one of those */
} SideCount;

/* Corners of a facet in the lists, negative where no chosen cell is. [out] corners - [ELEMENT_MAX_NODES] */
static PetscErrorCode FacetGetCorners_Private(const Extract *x, PetscInt facet, PetscInt corners[])
{
  PetscInt num, vertices[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  PetscCall(PointGetVertices(x->level.dm, facet, &num, vertices));
  for (PetscInt i = 0; i < num; i++) corners[i] = x->node_at[PointGetNode(&x->level, vertices[i])];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The one chosen cell of a facet, -1 if there is none or if there are several. */
static PetscErrorCode FacetGetCell_Private(const Extract *x, PetscInt facet, PetscInt *cell, PetscInt *num)
{
  const PetscInt *support;
  PetscInt        size;

  PetscFunctionBeginUser;
  *num  = 0;
  *cell = -1;
  PetscCall(DMPlexGetSupportSize(x->level.dm, facet, &size));
  PetscCall(DMPlexGetSupport(x->level.dm, facet, &support));
  for (PetscInt i = 0; i < size; i++) {
    if (x->cell_at[support[i] - x->cell_begin] < 0) continue;
    *cell = x->cell_at[support[i] - x->cell_begin];
    ++*num;
  }
  if (*num != 1) *cell = -1;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a cell has the corners of one of its facets in the order of the mesh, or in the reverse. */
static PetscBool CellKeepsSense_Private(const BodyList *list, PetscInt cell, const PetscInt corners[])
{
  const ElementType type  = (ElementType)list->cell_type[cell];
  const PetscInt    num   = ElementNumNodes(ElementLinear(ElementFacetType(type)));
  const PetscInt   *nodes = &list->cell_nodes[cell * ELEMENT_MAX_NODES];
  const PetscInt   *local = ElementFacetNodes(type, CellFindFacet(type, nodes, corners));
  PetscInt          at    = 0;

  while (nodes[local[at]] != corners[0]) at++;
  if (num == 2) return at == 0 ? PETSC_TRUE : PETSC_FALSE; // the ends of a line are neighbours in either order
  return nodes[local[(at + 1) % num]] == corners[1] ? PETSC_TRUE : PETSC_FALSE;
}

/* Numbers of chosen cells that have a facet in the order of the mesh, and in the reverse. [out] num - [2] */
static PetscErrorCode FacetCountSenses_Private(const Extract *x, const BodyList *list, PetscInt facet, PetscInt num[])
{
  const PetscInt *support;
  PetscInt        size, corners[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  num[0] = num[1] = 0;
  PetscCall(FacetGetCorners_Private(x, facet, corners));
  PetscCall(DMPlexGetSupportSize(x->level.dm, facet, &size));
  PetscCall(DMPlexGetSupport(x->level.dm, facet, &support));
  for (PetscInt i = 0; i < size; i++) {
    const PetscInt cell = x->cell_at[support[i] - x->cell_begin];

    if (cell >= 0) num[!CellKeepsSense_Private(list, cell, corners)]++;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Appends " (1, 2, 3)": a corner of a facet. */
static PetscErrorCode FacetDescribe_Private(const Extract *x, const BodyList *list, PetscInt facet, char text[])
{
  PetscInt corners[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  PetscCall(FacetGetCorners_Private(x, facet, corners));
  for (PetscInt d = 0; d < list->dim; d++) {
    const size_t used = strlen(text);

    snprintf(text + used, MESH_SENTENCE - used, "%s%g", d ? ", " : " (",
             (double)list->coords[corners[0] * list->dim + d]);
  }
  snprintf(text + strlen(text), MESH_SENTENCE - strlen(text), ")");
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* No cell is inside out here: two cells with the same orientation of a facet lie on the same side of it. */
PetscErrorCode ExtractCheckFacets(const Extract *x, const BodyList *list, char sentence[])
{
  PetscInt begin, end, num[2];
  char     place[MESH_SENTENCE] = "";

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetHeightStratum(x->level.dm, 1, &begin, &end));
  for (PetscInt f = begin; f < end; f++) {
    PetscCall(FacetCountSenses_Private(x, list, f, num));
    if (num[0] <= 1 && num[1] <= 1) continue;
    PetscCall(FacetDescribe_Private(x, list, f, place));
    snprintf(
        sentence, MESH_SENTENCE,
        "body '%s': cells of %.400s overlap at%.100s; mend the mesh if a node is outside the cells around it; if a "
        "part is in two physical groups, choose one with -%s_mesh_region",
        x->body->name, x->body->mesh_file, place, x->body->name);
    break;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The body's boundary facets with a number; entered into the lists under the index of a side if index >=
   0. */
static PetscErrorCode ExtractSide_Private(const Extract *x, PetscInt tag, PetscInt index, BodyList *list,
                                          SideCount *count)
{
  PetscInt begin, end, num, *points;

  PetscFunctionBeginUser;
  *count = (SideCount){.inside = -1};
  PetscCall(DMPlexGetHeightStratum(x->level.dm, 1, &begin, &end));
  PetscCall(LabelGetPoints(x->level.dm, "Face Sets", tag, &num, &points));
  for (PetscInt i = 0; i < num; i++) {
    PetscInt cell, cells, corners[ELEMENT_MAX_NODES];

    if (points[i] < begin || points[i] >= end) continue; // refinement labels what is on a facet as well
    PetscCall(FacetGetCell_Private(x, points[i], &cell, &cells));
    if (cells > 1) {
      count->inside = points[i];
      count->num_inside++;
    }
    if (cell < 0) continue;
    count->num++;
    if (index < 0) continue;
    PetscCall(FacetGetCorners_Private(x, points[i], corners));
    list->facet_cell[list->num_facets] = cell;
    list->facet[list->num_facets] =
        CellFindFacet((ElementType)list->cell_type[cell], &list->cell_nodes[cell * ELEMENT_MAX_NODES], corners);
    list->facet_side[list->num_facets++] = index;
  }
  PetscCall(PetscFree(points));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* "the body has no side 'x'; it has a (1), 7": numbers that occur on the body's boundary. */
static PetscErrorCode ExtractNoSide_Private(const Extract *x, const char side[], BodyList *list, char sentence[])
{
  char        text[MESH_SENTENCE / 2] = "";
  const char *other;
  PetscInt    num, *tags;
  SideCount   count;

  PetscFunctionBeginUser;
  PetscCall(LabelGetPoints(x->level.dm, "Face Sets", -1, &num, &tags));
  for (PetscInt i = 0; i < num; i++) {
    if (tags[i] <= 0) continue; // 0: in no group
    PetscCall(ExtractSide_Private(x, tags[i], -1, list, &count));
    if (count.num) GmshNamesDescribe(x->names, list->dim - 1, tags[i], text, sizeof(text));
  }
  PetscCall(PetscFree(tags));
  PetscCall(ExtractFindOther(x, list->dim - 1, side, &other));
  snprintf(sentence, MESH_SENTENCE,
           "body '%s' has no side '%s' in %.300s: no facet on its boundary is in a physical group of this name or "
           "number%s%s; %s%s",
           x->body->name, side, x->body->mesh_file, other ? ", which is a " : "", other ? other : "",
           text[0]          ? "its sides are "
           : list->dim == 2 ? "nor in any other: sides are physical curves of Gmsh"
                            : "nor in any other: sides are physical surfaces of Gmsh",
           text);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* "side 'x' has facets inside the body (3), one of them at (1, 2, 3)" */
static PetscErrorCode ExtractInside_Private(const Extract *x, const char side[], const SideCount *count, BodyList *list,
                                            char sentence[])
{
  char place[MESH_SENTENCE] = "";

  PetscFunctionBeginUser;
  PetscCall(FacetDescribe_Private(x, list, count->inside, place));
  snprintf(sentence, MESH_SENTENCE,
           "side '%s' of body '%s' in %.300s has facets inside the body (%d), one of them at%.100s; a side is on the "
           "boundary; for one between two regions choose a region with -%s_mesh_region",
           side, x->body->name, x->body->mesh_file, (int)count->num_inside, place, x->body->name);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ExtractSides(const Extract *x, const SideNames *names, BodyList *list, char sentence[])
{
  PetscFunctionBeginUser;
  for (PetscInt s = 0; s < names->num && !sentence[0]; s++) {
    SideCount count = {0};
    PetscInt  tag;

    if (GmshNamesFindGroup(x->names, list->dim - 1, names->name[s], &tag) && tag > 0)
      PetscCall(ExtractSide_Private(x, tag, s, list, &count));
    if (count.num_inside)
      PetscCall(ExtractInside_Private(x, names->name[s], &count, list, sentence));
    else if (!count.num)
      PetscCall(ExtractNoSide_Private(x, names->name[s], list, sentence));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

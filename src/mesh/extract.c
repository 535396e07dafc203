/* extract.c -- the lists of a body from the DMPlex of its file.

   A facet belongs to a side of the body if it carries the side's number and lies on the boundary of the body's own
   cells: where two bodies share a file, the line between their regions is a side of each. */
#include "room.h"
#include <mortise/compat.h>
#include <string.h>

/* A body on its way from the DM to the lists. */
typedef struct {
  const SceneBody *body;
  const GmshNames *names;
  DM               dm; /* refined as the body wants it */
  PetscInt         cell_begin, cell_end, vertex_begin, vertex_end, num_cells, num_nodes;
  PetscInt        *cell_at; /* position of each cell in the lists, -1 for other regions */
  PetscInt        *node_at; /* likewise of each vertex */
} Extract;

/* The indices of one stratum of a label, or of the label's values with tag < 0; sorted copies. */
static PetscErrorCode LabelGetPoints_Private(DM dm, const char name[], PetscInt tag, PetscInt *num, PetscInt **points)
{
  const PetscInt *indices;
  DMLabel         label;
  IS              is = NULL;

  PetscFunctionBeginUser;
  *num    = 0;
  *points = NULL;
  PetscCall(DMGetLabel(dm, name, &label));
  if (label && tag < 0)
    PetscCall(DMLabelGetValueIS(label, &is));
  else if (label)
    PetscCall(DMLabelGetStratumIS(label, tag, &is));
  if (!is) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ISGetLocalSize(is, num));
  PetscCall(PetscMalloc1(*num, points));
  PetscCall(ISGetIndices(is, &indices));
  PetscCall(PetscArraycpy(*points, indices, *num));
  PetscCall(ISRestoreIndices(is, &indices));
  PetscCall(ISDestroy(&is));
  PetscCall(PetscSortInt(*num, *points));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Marks the cells of the region, or all. */
static PetscErrorCode ExtractSelect_Private(Extract *x, PetscInt dim, char sentence[])
{
  const char *region = x->body->region;
  PetscInt    tag, num = 0, *points = NULL;
  char        text[MESH_SENTENCE / 2] = "";

  PetscFunctionBeginUser;
  for (PetscInt c = 0; c < x->cell_end - x->cell_begin; ++c) x->cell_at[c] = region ? -1 : x->num_cells++;
  if (!region) PetscFunctionReturn(PETSC_SUCCESS);
  if (GmshFindGroup(x->names, dim, region, &tag))
    PetscCall(LabelGetPoints_Private(x->dm, "Cell Sets", tag, &num, &points));
  for (PetscInt i = 0; i < num; ++i) { // refinement labels the cells' edges as well
    if (points[i] >= x->cell_begin && points[i] < x->cell_end) x->cell_at[points[i] - x->cell_begin] = x->num_cells++;
  }
  PetscCall(PetscFree(points));
  if (x->num_cells) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(LabelGetPoints_Private(x->dm, "Cell Sets", -1, &num, &points));
  for (PetscInt i = 0; i < num; ++i) {
    if (points[i]) GmshDescribeGroup(x->names, dim, points[i], text, sizeof(text)); // 0: in no group
  }
  PetscCall(PetscFree(points));
  snprintf(sentence, MESH_SENTENCE,
           "-%s_mesh_region %s: the mesh has no cells in a physical group of this name or number; it has %s",
           x->body->name, region, text[0] ? text : "no groups of cells");
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Numbers the vertices of the chosen cells. */
static PetscErrorCode ExtractNumber_Private(Extract *x)
{
  PetscInt size, corners[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  for (PetscInt v = 0; v < x->vertex_end - x->vertex_begin; ++v) x->node_at[v] = -1;
  for (PetscInt c = x->cell_begin; c < x->cell_end; ++c) {
    if (x->cell_at[c - x->cell_begin] < 0) continue;
    PetscCall(PointGetVertices(x->dm, c, &size, corners));
    for (PetscInt i = 0; i < size; ++i) x->node_at[corners[i] - x->vertex_begin] = 0;
  }
  for (PetscInt v = 0; v < x->vertex_end - x->vertex_begin; ++v) {
    if (x->node_at[v] == 0) x->node_at[v] = x->num_nodes++;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Positions and cells. Clockwise cells are turned here, so that a body has one orientation before its map. */
static PetscErrorCode ExtractCells_Private(const Extract *x, BodyList *list)
{
  const PetscScalar *coords;
  PetscInt           space_dim, size, corners[ELEMENT_MAX_NODES];
  Vec                vec;

  PetscFunctionBeginUser;
  PetscCall(DMGetCoordinateDim(x->dm, &space_dim));
  PetscCall(DMGetCoordinatesLocal(x->dm, &vec));
  PetscCall(VecGetArrayRead(vec, &coords));
  for (PetscInt v = 0; v < x->vertex_end - x->vertex_begin; ++v) {
    for (PetscInt d = 0; d < list->dim && x->node_at[v] >= 0; ++d)
      list->coords[x->node_at[v] * list->dim + d] = PetscRealPart(coords[v * space_dim + d]);
  }
  PetscCall(VecRestoreArrayRead(vec, &coords));
  for (PetscInt c = x->cell_begin; c < x->cell_end; ++c) {
    const PetscInt at   = x->cell_at[c - x->cell_begin];
    PetscReal      area = 0; // twice
    PetscInt      *nodes;

    if (at < 0) continue;
    PetscCall(PointGetVertices(x->dm, c, &size, corners));
    list->cell_type[at] = size == ElementNumNodes(ELEMENT_TRI3) ? ELEMENT_TRI3 : ELEMENT_QUAD4;
    nodes               = &list->cell_nodes[at * ELEMENT_MAX_NODES];
    for (PetscInt i = 0; i < size; ++i) nodes[i] = x->node_at[corners[i] - x->vertex_begin];
    for (PetscInt i = 0; i < size; ++i) {
      const PetscReal *a = &list->coords[nodes[i] * 2], *b = &list->coords[nodes[(i + 1) % size] * 2];

      area += a[0] * b[1] - a[1] * b[0];
    }
    for (PetscInt i = 0; i < size && area < 0; ++i) nodes[i] = x->node_at[corners[size - 1 - i] - x->vertex_begin];
  }
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
  PetscCall(DMPlexGetSupportSize(x->dm, facet, &size));
  PetscCall(DMPlexGetSupport(x->dm, facet, &support));
  for (PetscInt i = 0; i < size; ++i) {
    if (x->cell_at[support[i] - x->cell_begin] < 0) continue;
    *cell = x->cell_at[support[i] - x->cell_begin];
    ++*num;
  }
  if (*num != 1) *cell = -1;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* How many chosen cells run along a facet from its first end to its second, and back. [out] num - [2] */
static PetscErrorCode FacetCountSenses_Private(const Extract *x, const BodyList *list, PetscInt facet, PetscInt num[])
{
  const PetscInt *support, *ends;
  PetscInt        size;

  PetscFunctionBeginUser;
  num[0] = num[1] = 0;
  PetscCall(DMPlexGetCone(x->dm, facet, &ends));
  PetscCall(DMPlexGetSupportSize(x->dm, facet, &size));
  PetscCall(DMPlexGetSupport(x->dm, facet, &support));
  for (PetscInt i = 0; i < size; ++i) {
    const PetscInt  cell = x->cell_at[support[i] - x->cell_begin], first = x->node_at[ends[0] - x->vertex_begin];
    const PetscInt *nodes = &list->cell_nodes[cell * ELEMENT_MAX_NODES], second = x->node_at[ends[1] - x->vertex_begin];
    PetscInt        at = 0;

    if (cell < 0) continue;
    while (nodes[at] != first) ++at;
    ++num[nodes[(at + 1) % ElementNumNodes((ElementType)list->cell_type[cell])] != second];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* All cells run anticlockwise by now, so two that run the same way along a facet lie on the same side of it. */
static PetscErrorCode ExtractCheckFacets_Private(const Extract *x, const BodyList *list, char sentence[])
{
  PetscInt begin, end, num[2];

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetHeightStratum(x->dm, 1, &begin, &end));
  for (PetscInt f = begin; f < end; ++f) {
    const PetscInt  *ends;
    const PetscReal *at;

    PetscCall(FacetCountSenses_Private(x, list, f, num));
    if (num[0] <= 1 && num[1] <= 1) continue;
    PetscCall(DMPlexGetCone(x->dm, f, &ends));
    at = &list->coords[x->node_at[ends[0] - x->vertex_begin] * list->dim];
    snprintf(sentence, MESH_SENTENCE,
             "body '%s': cells of %.400s lie upon each other at (%g, %g); where a surface is in two physical groups "
             "-%s_mesh_region can choose one",
             x->body->name, x->body->mesh_file, (double)at[0], (double)at[1], x->body->name);
    break;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The body's boundary facets with a number; entered into the lists under the index of a side if index >= 0. */
static PetscErrorCode ExtractSide_Private(const Extract *x, PetscInt tag, PetscInt index, BodyList *list,
                                          PetscInt *num_facets)
{
  PetscInt begin, end, num, *points;

  PetscFunctionBeginUser;
  *num_facets = 0;
  PetscCall(DMPlexGetHeightStratum(x->dm, 1, &begin, &end));
  PetscCall(LabelGetPoints_Private(x->dm, "Face Sets", tag, &num, &points));
  for (PetscInt i = 0; i < num; ++i) {
    const PetscInt *ends;
    PetscInt        cell, cells, nodes[ELEMENT_MAX_FACET_NODES];

    if (points[i] < begin || points[i] >= end) continue; // a vertex that refinement has labelled
    PetscCall(FacetGetCell_Private(x, points[i], &cell, &cells));
    if (cell < 0) continue;
    ++*num_facets;
    if (index < 0) continue;
    PetscCall(DMPlexGetCone(x->dm, points[i], &ends));
    for (PetscInt k = 0; k < 2; ++k) nodes[k] = x->node_at[ends[k] - x->vertex_begin];
    list->facet_cell[list->num_facets] = cell;
    list->facet[list->num_facets] =
        CellFindFacet((ElementType)list->cell_type[cell], &list->cell_nodes[cell * ELEMENT_MAX_NODES], nodes);
    list->facet_side[list->num_facets++] = index;
  }
  PetscCall(PetscFree(points));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* "the body has no side 'x'; it has a (1), 7": numbers that occur on the body's boundary. */
static PetscErrorCode ExtractNoSide_Private(const Extract *x, const char side[], BodyList *list, char sentence[])
{
  char     text[MESH_SENTENCE / 2] = "";
  PetscInt num, *tags, found;

  PetscFunctionBeginUser;
  PetscCall(LabelGetPoints_Private(x->dm, "Face Sets", -1, &num, &tags));
  for (PetscInt i = 0; i < num; ++i) {
    if (tags[i] > 0) PetscCall(ExtractSide_Private(x, tags[i], -1, list, &found)); // 0: in no group
    if (tags[i] > 0 && found) GmshDescribeGroup(x->names, list->dim - 1, tags[i], text, sizeof(text));
  }
  PetscCall(PetscFree(tags));
  snprintf(sentence, MESH_SENTENCE,
           "body '%s' has no side '%s' in %.300s: no facet on its boundary is in a physical group of this name or "
           "number; its sides are %s",
           x->body->name, side, x->body->mesh_file, text[0] ? text : "none");
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* All sides that the scene names. A facet counts once in each of them. */
static PetscErrorCode ExtractSides_Private(const Extract *x, const SideNames *names, BodyList *list, char sentence[])
{
  PetscFunctionBeginUser;
  for (PetscInt s = 0; s < names->num && !sentence[0]; ++s) {
    PetscInt tag, found = 0;

    if (GmshFindGroup(x->names, list->dim - 1, names->name[s], &tag) && tag > 0)
      PetscCall(ExtractSide_Private(x, tag, s, list, &found));
    if (!found) PetscCall(ExtractNoSide_Private(x, names->name[s], list, sentence));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The file's mesh split as often as the body wants. */
static PetscErrorCode ExtractRefine_Private(DM dm, PetscInt times, DM *refined)
{
  PetscFunctionBeginUser;
  PetscCall(PetscObjectReference((PetscObject)dm));
  *refined = dm;
  for (PetscInt i = 0; i < times; ++i) {
    DM finer;

    PetscCall(DMRefine(*refined, PETSC_COMM_SELF, &finer));
    PetscCall(DMDestroy(refined));
    *refined = finer;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BodyListCreateFile(const SceneBody *body, PetscInt dim, const SideNames *names, MeshFile *files,
                                  BodyList *list, char sentence[])
{
  Extract  x = {.body = body};
  PetscInt begin, end;
  DM       dm;

  PetscFunctionBeginUser;
  PetscCall(MeshFileOpen(body, dim, files, &dm, &x.names, sentence));
  if (sentence[0]) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ExtractRefine_Private(dm, body->refine, &x.dm));
  PetscCall(DMPlexGetHeightStratum(x.dm, 0, &x.cell_begin, &x.cell_end));
  PetscCall(DMPlexGetDepthStratum(x.dm, 0, &x.vertex_begin, &x.vertex_end));
  PetscCall(DMPlexGetHeightStratum(x.dm, 1, &begin, &end));
  PetscCall(PetscMalloc2(x.cell_end - x.cell_begin, &x.cell_at, x.vertex_end - x.vertex_begin, &x.node_at));
  PetscCall(ExtractSelect_Private(&x, dim, sentence));
  PetscCall(ExtractNumber_Private(&x));
  PetscCall(BodyListAllocate(dim, x.num_cells, x.num_nodes, (end - begin) * names->num, list));
  PetscCall(ExtractCells_Private(&x, list));
  if (!sentence[0]) PetscCall(ExtractCheckFacets_Private(&x, list, sentence));
  PetscCall(ExtractSides_Private(&x, names, list, sentence));
  PetscCall(PetscFree2(x.cell_at, x.node_at));
  PetscCall(DMDestroy(&x.dm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* extract.c -- the lists of a body from the mesh of its file.

   A facet belongs to a side of the body if it carries the side's number and lies on the boundary of the body's own
   cells: where two bodies share a file, the line between their regions is a side of each. */
#include "room.h"
#include <mortise/compat.h>
#include <string.h>

/* A body on its way from the file's mesh to the lists. */
typedef struct {
  const SceneBody *body;
  const GmshNames *names;
  struct _n_Scene  scene; /* of this body alone, before its map, with all cells of the file */
  SceneBody        alone;
  Level            level; /* refined as the body wants it */
  PetscInt         cell_begin, num_cells, num_vertices, num_nodes;
  PetscInt        *cell_at; /* position of each cell in the lists, -1 for other regions */
  PetscInt        *node_at; /* likewise of each of the level's nodes */
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
  for (PetscInt c = 0; c < x->level.num_cells; ++c) x->cell_at[c] = region ? -1 : x->num_cells++;
  if (!region) PetscFunctionReturn(PETSC_SUCCESS);
  if (GmshFindGroup(x->names, dim, region, &tag))
    PetscCall(LabelGetPoints_Private(x->level.dm, "Cell Sets", tag, &num, &points));
  for (PetscInt i = 0; i < num; ++i) { // refinement labels the cells' edges as well
    if (points[i] >= x->cell_begin && points[i] < x->cell_begin + x->level.num_cells)
      x->cell_at[points[i] - x->cell_begin] = x->num_cells++;
  }
  PetscCall(PetscFree(points));
  if (x->num_cells) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(LabelGetPoints_Private(x->level.dm, "Cell Sets", -1, &num, &points));
  for (PetscInt i = 0; i < num; ++i) {
    if (points[i]) GmshDescribeGroup(x->names, dim, points[i], text, sizeof(text)); // 0: in no group
  }
  PetscCall(PetscFree(points));
  snprintf(sentence, MESH_SENTENCE,
           "-%s_mesh_region %s: the mesh has no cells in a physical group of this name or number; it has %s",
           x->body->name, region, text[0] ? text : "no groups of cells");
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* How many nodes of a cell the body wants. */
static PetscInt ExtractNumNodes_Private(const Extract *x, PetscInt cell)
{
  const Level *level = &x->level;

  return x->body->order > 1 ? level->cell_start[cell + 1] - level->cell_start[cell] : LevelNumVertices(level, cell);
}

/* Numbers the nodes of the chosen cells, vertices first. */
static void ExtractNumber_Private(Extract *x)
{
  enum { UNUSED = -1, VERTEX = -2, MIDDLE = -3 };
  const Level *level = &x->level;

  for (PetscInt n = 0; n < level->num_nodes; ++n) x->node_at[n] = UNUSED;
  for (PetscInt c = 0; c < level->num_cells; ++c) {
    const PetscInt *nodes = &level->cell_nodes[level->cell_start[c]];

    for (PetscInt i = 0; i < ExtractNumNodes_Private(x, c) && x->cell_at[c] >= 0; ++i)
      x->node_at[nodes[i]] = i < LevelNumVertices(level, c) ? VERTEX : MIDDLE;
  }
  for (PetscInt n = 0; n < level->num_nodes; ++n) {
    if (x->node_at[n] == VERTEX) x->node_at[n] = x->num_nodes++;
  }
  x->num_vertices = x->num_nodes;
  for (PetscInt n = 0; n < level->num_nodes; ++n) {
    if (x->node_at[n] == MIDDLE) x->node_at[n] = x->num_nodes++;
  }
}

/* Area of a cell, negative where it runs clockwise. */
static PetscReal CellGetArea_Private(const BodyList *list, PetscInt cell)
{
  enum { DEGREE = 3 }; /* of det J in each direction, at most */
  const ElementType type  = (ElementType)list->cell_type[cell];
  const PetscInt   *nodes = &list->cell_nodes[cell * ELEMENT_MAX_NODES];
  PetscReal         X[ELEMENT_MAX_NODES * 3], xi[ELEMENT_MAX_POINTS * 3], weight[ELEMENT_MAX_POINTS];
  PetscReal         phi[ELEMENT_MAX_NODES], area = 0;
  const PetscInt    num = ElementQuadrature(type, DEGREE, xi, weight);

  for (PetscInt i = 0; i < ElementNumNodes(type); ++i) {
    for (PetscInt d = 0; d < list->dim; ++d) X[i * list->dim + d] = list->coords[nodes[i] * list->dim + d];
  }
  for (PetscInt q = 0; q < num; ++q) area += weight[q] * ElementMap(type, X, &xi[q * list->dim], NULL, phi, NULL);
  return area;
}

/* Positions and cells. Clockwise cells are turned here, so that a body has one orientation before its map. */
static void ExtractCells_Private(const Extract *x, BodyList *list)
{
  const Level *level = &x->level;

  list->num_vertices = x->num_vertices;
  list->straightened = x->body->order < x->alone.order ? PETSC_TRUE : PETSC_FALSE;
  for (PetscInt n = 0; n < level->num_nodes; ++n) {
    for (PetscInt d = 0; d < list->dim && x->node_at[n] >= 0; ++d)
      list->coords[x->node_at[n] * list->dim + d] = level->coords[n * list->dim + d];
  }
  for (PetscInt c = 0; c < level->num_cells; ++c) {
    const PetscInt at = x->cell_at[c], num = ExtractNumNodes_Private(x, c);
    PetscInt      *nodes;

    if (at < 0) continue;
    nodes               = &list->cell_nodes[at * ELEMENT_MAX_NODES];
    list->cell_type[at] = level->cell_type[c];
    if (x->body->order == 1) list->cell_type[at] = ElementLinear((ElementType)level->cell_type[c]);
    for (PetscInt i = 0; i < num; ++i) nodes[i] = x->node_at[level->cell_nodes[level->cell_start[c] + i]];
    if (CellGetArea_Private(list, at) < 0) CellReverse((ElementType)list->cell_type[at], nodes);
  }
}

/* Ends of a facet in the lists, negative where no chosen cell is. */
static PetscErrorCode FacetGetEnds_Private(const Extract *x, PetscInt facet, PetscInt ends[])
{
  PetscInt num, vertices[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  PetscCall(PointGetVertices(x->level.dm, facet, &num, vertices));
  for (PetscInt i = 0; i < num; ++i) ends[i] = x->node_at[PointGetNode(&x->level, vertices[i])];
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
  const PetscInt *support;
  PetscInt        size, ends[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  num[0] = num[1] = 0;
  PetscCall(FacetGetEnds_Private(x, facet, ends));
  PetscCall(DMPlexGetSupportSize(x->level.dm, facet, &size));
  PetscCall(DMPlexGetSupport(x->level.dm, facet, &support));
  for (PetscInt i = 0; i < size; ++i) {
    const PetscInt  cell = x->cell_at[support[i] - x->cell_begin];
    const PetscInt *nodes;
    PetscInt        at = 0;

    if (cell < 0) continue;
    nodes = &list->cell_nodes[cell * ELEMENT_MAX_NODES];
    while (nodes[at] != ends[0]) ++at;
    ++num[nodes[(at + 1) % ElementNumNodes(ElementLinear((ElementType)list->cell_type[cell]))] != ends[1]];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* All cells run anticlockwise by now, so two that run the same way along a facet lie on the same side of it. */
static PetscErrorCode ExtractCheckFacets_Private(const Extract *x, const BodyList *list, char sentence[])
{
  PetscInt begin, end, num[2], ends[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetHeightStratum(x->level.dm, 1, &begin, &end));
  for (PetscInt f = begin; f < end; ++f) {
    const PetscReal *at;

    PetscCall(FacetCountSenses_Private(x, list, f, num));
    if (num[0] <= 1 && num[1] <= 1) continue;
    PetscCall(FacetGetEnds_Private(x, f, ends));
    at = &list->coords[ends[0] * list->dim];
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
  PetscCall(DMPlexGetHeightStratum(x->level.dm, 1, &begin, &end));
  PetscCall(LabelGetPoints_Private(x->level.dm, "Face Sets", tag, &num, &points));
  for (PetscInt i = 0; i < num; ++i) {
    PetscInt cell, cells, ends[ELEMENT_MAX_NODES];

    if (points[i] < begin || points[i] >= end) continue; // a vertex that refinement has labelled
    PetscCall(FacetGetCell_Private(x, points[i], &cell, &cells));
    if (cell < 0) continue;
    ++*num_facets;
    if (index < 0) continue;
    PetscCall(FacetGetEnds_Private(x, points[i], ends));
    list->facet_cell[list->num_facets] = cell;
    list->facet[list->num_facets] =
        CellFindFacet((ElementType)list->cell_type[cell], &list->cell_nodes[cell * ELEMENT_MAX_NODES], ends);
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
  PetscCall(LabelGetPoints_Private(x->level.dm, "Face Sets", -1, &num, &tags));
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

/* Tables of the file's mesh, split as often as the body wants. A file of second order is followed along its curves, so that
   the vertices of a body are the same whatever its order. */
static PetscErrorCode ExtractSetLevel_Private(Extract *x, PetscInt dim, MeshFile file)
{
  PetscInt size;

  PetscFunctionBeginUser;
  PetscCall(CurvesGetSize(&file->curves, &size));
  x->alone       = *x->body;
  x->alone.map   = NULL;
  x->alone.order = size ? 2 : 1;
  x->scene       = (struct _n_Scene){.comm = PETSC_COMM_SELF, .dim = dim, .num_bodies = 1, .bodies = &x->alone};
  PetscCall(LevelCreateTables(&x->scene, file->dm, x->alone.order, &x->level));
  PetscCall(LevelSetCoords(&x->level, &file->curves));
  for (PetscInt i = 0; i < x->body->refine; ++i) {
    Level coarse = x->level;

    PetscCall(LevelRefine(&coarse, &x->level));
    PetscCall(LevelDestroy(&coarse));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BodyListCreateFile(const SceneBody *body, PetscInt dim, const SideNames *names, MeshFile *files,
                                  BodyList *list, char sentence[])
{
  Extract  x = {.body = body};
  PetscInt begin, end;
  MeshFile file;

  PetscFunctionBeginUser;
  PetscCall(MeshFileOpen(body, dim, files, &file, sentence));
  if (sentence[0]) PetscFunctionReturn(PETSC_SUCCESS);
  x.names = &file->names;
  PetscCall(ExtractSetLevel_Private(&x, dim, file));
  PetscCall(DMPlexGetHeightStratum(x.level.dm, 0, &x.cell_begin, NULL));
  PetscCall(DMPlexGetHeightStratum(x.level.dm, 1, &begin, &end));
  PetscCall(PetscMalloc2(x.level.num_cells, &x.cell_at, x.level.num_nodes, &x.node_at));
  PetscCall(ExtractSelect_Private(&x, dim, sentence));
  ExtractNumber_Private(&x);
  PetscCall(BodyListAllocate(dim, x.num_cells, x.num_nodes, (end - begin) * names->num, list));
  ExtractCells_Private(&x, list);
  if (!sentence[0]) PetscCall(ExtractCheckFacets_Private(&x, list, sentence));
  PetscCall(ExtractSides_Private(&x, names, list, sentence));
  PetscCall(PetscFree2(x.cell_at, x.node_at));
  PetscCall(LevelDestroy(&x.level));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* fileextract.c -- the lists of a body from the mesh of its file: its cells and nodes. */
#include "kernel/vector.h"
#include "mesh/fileextract.h"
#include "base/compat.h"

PetscErrorCode LabelGetPoints(DM dm, const char name[], PetscInt tag, PetscInt *num, PetscInt **points)
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

PetscErrorCode ExtractFindOther(const Extract *x, PetscInt wanted, const char group[], const char **kind)
{
  static const char *const kinds[] = {"point", "curve", "surface", "volume"}; /* by dimension, as Gmsh calls them */
  const PetscInt           dim     = x->level.dim;

  PetscFunctionBeginUser;
  *kind = NULL;
  for (PetscInt d = 0; d <= dim; d++) {
    PetscInt tag, size = 0;

    if (d == wanted || !GmshNamesFindGroup(x->names, d, group, &tag)) continue;
    if (d >= dim - 1) PetscCall(DMGetStratumSize(x->level.dm, d == dim ? "Cell Sets" : "Face Sets", tag, &size));
    if (size || GmshNamesHas(x->names, d, group)) *kind = kinds[d];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Numbers the nodes of the chosen cells, vertices first. */
static void ExtractNumber_Private(Extract *x)
{
  enum { UNUSED = -1, VERTEX = -2, MIDDLE = -3 };
  const Level *level = &x->level;

  for (PetscInt n = 0; n < level->num_nodes; n++) x->node_at[n] = UNUSED;
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const PetscInt *nodes = &level->cell_nodes[level->cell_start[c]];

    for (PetscInt i = 0; i < level->cell_start[c + 1] - level->cell_start[c] && x->cell_at[c] >= 0; i++)
      x->node_at[nodes[i]] = i < LevelNumVertices(level, c) ? VERTEX : MIDDLE;
  }
  for (PetscInt n = 0; n < level->num_nodes; n++) {
    if (x->node_at[n] == VERTEX) x->node_at[n] = x->num_nodes++;
  }
  x->num_vertices = x->num_nodes;
  for (PetscInt n = 0; n < level->num_nodes; n++) {
    if (x->node_at[n] == MIDDLE) x->node_at[n] = x->num_nodes++;
  }
}

PetscReal CellGetMeasure(ElementType type, PetscInt dim, const PetscReal X[])
{
  const PetscInt degree = dim * ElementOrder(type) - 1; // of det J in each direction, at most
  PetscReal      xi[ELEMENT_MAX_POINTS * 3], weight[ELEMENT_MAX_POINTS], phi[ELEMENT_MAX_NODES], measure = 0;
  const PetscInt num = QuadratureRule(type, degree, xi, weight);

  for (PetscInt q = 0; q < num; q++) measure += weight[q] * ElementMap(type, X, &xi[q * dim], NULL, phi, NULL);
  return measure;
}

PetscReal BodyListGetMeasure(const BodyList *list, PetscInt cell, PetscInt order)
{
  const ElementType of_file = (ElementType)list->cell_type[cell], type = order > 1 ? of_file : ElementLinear(of_file);
  const PetscInt   *nodes = &list->cell_nodes[cell * ELEMENT_MAX_NODES];
  PetscReal         X[ELEMENT_MAX_NODES * 3];

  VectorGather(list->dim, ElementNumNodes(type), nodes, list->coords, X);
  return CellGetMeasure(type, list->dim, X);
}

/* Positions and cells, of the order of the file: refinement of a body of order 1 takes its new vertices from
   them. Cells that are inside out are reversed here, so that a body has one orientation before its map. */
static void ExtractCells_Private(const Extract *x, BodyList *list)
{
  const Level *level = &x->level;

  list->num_vertices = x->num_vertices;
  list->curved_file  = x->alone.order > 1 ? PETSC_TRUE : PETSC_FALSE;
  list->straightened = x->body->order < x->alone.order ? PETSC_TRUE : PETSC_FALSE;
  for (PetscInt n = 0; n < level->num_nodes; n++) {
    for (PetscInt d = 0; d < list->dim && x->node_at[n] >= 0; d++)
      list->coords[x->node_at[n] * list->dim + d] = level->coords[n * list->dim + d];
  }
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const PetscInt at = x->cell_at[c], num = level->cell_start[c + 1] - level->cell_start[c];
    PetscInt      *nodes;

    if (at < 0) continue;
    nodes               = &list->cell_nodes[at * ELEMENT_MAX_NODES];
    list->cell_type[at] = level->cell_type[c];
    for (PetscInt i = 0; i < num; i++) nodes[i] = x->node_at[level->cell_nodes[level->cell_start[c] + i]];
    if (BodyListGetMeasure(list, at, x->body->order) < 0) CellReverse((ElementType)list->cell_type[at], nodes);
  }
}

/* Tables of the file's mesh, with the body's own refinements. New vertices follow the curves of a file of
   second order, so that the vertices of a body do not depend on its order. */
static PetscErrorCode ExtractSetLevel_Private(Extract *x, Scene scene, PetscInt body, MeshFile file)
{
  PetscInt size;

  PetscFunctionBeginUser;
  PetscCall(CurvesGetSize(&file->curves, &size));
  x->alone       = *x->body;
  x->alone.map   = NULL;
  x->alone.order = size ? 2 : 1;
  x->scene       = (struct _n_Scene){.comm = PETSC_COMM_SELF, .dim = scene->dim, .num_bodies = 1, .bodies = &x->alone};
  PetscCall(LevelCreateTables(&x->scene, file->dm, x->alone.order, &x->level));
  PetscCall(LevelSetCoords(&x->level, &file->curves));
  if (x->body->refine) PetscCall(ExtractMarkParabolas(x, scene, body));
  for (PetscInt i = 0; i < x->body->refine; i++) {
    ArcSides sides;
    Level    coarse;

    PetscCall(ExtractArcSides(x, scene, body, &sides));
    coarse = x->level;
    PetscCall(LevelRefine(&coarse, &sides, &x->level));
    PetscCall(ExtractCurveMiddles(x, scene, body));
    PetscCall(ArcSidesDestroy(&sides));
    PetscCall(LevelDestroy(&coarse));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BodyListCreateFile(Scene scene, PetscInt body, const SideNames *names, MeshFile *files, BodyList *list,
                                  char sentence[])
{
  const PetscInt dim = scene->dim;
  Extract        x   = {.body = &scene->bodies[body]};
  PetscInt       begin, end;
  MeshFile       file;

  PetscFunctionBeginUser;
  PetscCall(MeshFileOpen(x.body, dim, files, &file, sentence));
  if (sentence[0]) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(SharedCellsCheck(scene, body, file, sentence));
  if (sentence[0]) PetscFunctionReturn(PETSC_SUCCESS);
  x.names = &file->names;
  PetscCall(ExtractSetLevel_Private(&x, scene, body, file));
  PetscCall(DMPlexGetHeightStratum(x.level.dm, 0, &x.cell_begin, NULL));
  PetscCall(DMPlexGetHeightStratum(x.level.dm, 1, &begin, &end));
  PetscCall(PetscMalloc2(x.level.num_cells, &x.cell_at, x.level.num_nodes, &x.node_at));
  PetscCall(ExtractSelect(&x, sentence));
  ExtractNumber_Private(&x);
  PetscCall(BodyListAllocate(dim, x.num_cells, x.num_nodes, (end - begin) * names->num, list));
  ExtractCells_Private(&x, list);
  if (!sentence[0]) PetscCall(ExtractRegions(&x, scene, body, list, sentence));
  if (!sentence[0]) PetscCall(ExtractCheckFacets(&x, list, sentence));
  PetscCall(ExtractSides(&x, names, list, sentence));
  PetscCall(NonManifoldFind(&x, list));
  if (!sentence[0]) PetscCall(UnjoinedPiecesFind(&x, scene, body, names, list));
  PetscCall(PetscFree2(x.cell_at, x.node_at));
  PetscCall(LevelDestroy(&x.level));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* bodyfile.c -- the lists of a body from the mesh of its file: its cells and nodes. */
#include "base/compat.h"
#include "bodies/arcextract.h"
#include "bodies/bodyfile.h"
#include "bodies/bodylist.h"
#include "bodies/cellmeasure.h"
#include "bodies/fileextract.h"
#include "bodies/fileregions.h"
#include "bodies/filesides.h"
#include "bodies/meshfile.h"
#include "bodies/nonmanifold.h"
#include "bodies/sharedcells.h"
#include "bodies/unjoinedpieces.h"
#include "level/leveltables.h"
#include "refinement/levelrefine.h"

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

/* Tables of the file's mesh, refined so many times. New vertices follow the curves of a file of
   second order, so that the vertices of a body do not depend on its order. */
static PetscErrorCode ExtractSetLevel_Private(Extract *x, Scene scene, PetscInt body, PetscInt refine, MeshFile file)
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
  if (refine) PetscCall(ExtractMarkParabolas(x, scene, body));
  for (PetscInt i = 0; i < refine; i++) {
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

PetscErrorCode BodyListCreateFile(Scene scene, PetscInt body, PetscInt refine, const SideNames *names, MeshFile *files,
                                  BodyList *list, char sentence[])
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
  PetscCall(ExtractSetLevel_Private(&x, scene, body, refine, file));
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

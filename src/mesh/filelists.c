/* filelists.c -- sends cells to their ranks, and makes the lists of bodies there. */
#include "base/compat.h"
#include "bodies/bodylist.h"
#include "bodies/cellmeasure.h"
#include "bodies/cellmiddles.h"
#include "level/exchange.h"
#include "level/facets.h"
#include "level/leveltables.h"
#include "mesh/filecells.h"
#include "mesh/fileconnect.h"
#include "mesh/filelists.h"

/* Numbers of a cell that is sent: body, material, type, nodes of the file, sense, nodes, groups. */
enum { HEAD = 5 };

PetscErrorCode FileCellsMove(const Files *files, const PetscInt part[], FileCells *cells)
{
  const PetscInt size = HEAD + cells->max_nodes + 2 * FILE_FACETS, order = cells->order, total = cells->total;
  PetscInt      *own, *came;
  PetscMPIInt   *rank;
  Exchange       exchange;
  FileCells      moved;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(cells->num * size, &own, cells->num, &rank));
  for (PetscInt c = 0; c < cells->num; c++) {
    PetscInt *r = &own[c * size];

    rank[c] = (PetscMPIInt)part[c];
    r[0]    = cells->body[c];
    r[1]    = cells->material[c];
    r[2]    = cells->type[c];
    r[3]    = cells->file_nodes[c];
    r[4]    = cells->reversed[c];
    for (PetscInt i = 0; i < cells->max_nodes; i++)
      r[HEAD + i] = i < cells->file_nodes[c] ? cells->nodes[c * cells->max_nodes + i] : -1;
    for (PetscInt f = 0; f < FILE_FACETS; f++) {
      const PetscInt  at      = c * FILE_FACETS + f;
      const PetscBool outside = (PetscBool)(cells->neighbour[at] < 0);

      r[HEAD + cells->max_nodes + f]               = outside ? cells->group[at] : -1;
      r[HEAD + cells->max_nodes + FILE_FACETS + f] = outside ? cells->group_end[at] : -1;
    }
  }
  PetscCall(ExchangeCreate(files->comm, cells->num, rank, &exchange));
  PetscCall(FileCellsDestroy(cells));
  PetscCall(PetscMalloc1(exchange.num * size, &came));
  PetscCall(ExchangeSend(&exchange, (size_t)size * sizeof(PetscInt), own, came));
  PetscCall(PetscFree2(own, rank));
  PetscCall(FileCellsAllocate(exchange.num, size - HEAD - 2 * FILE_FACETS, &moved));
  for (PetscInt c = 0; c < moved.num; c++) {
    const PetscInt *r = &came[c * size];

    moved.body[c]       = r[0];
    moved.material[c]   = r[1];
    moved.type[c]       = r[2];
    moved.file_nodes[c] = r[3];
    moved.reversed[c]   = r[4];
    PetscCall(PetscArraycpy(&moved.nodes[c * moved.max_nodes], &r[HEAD], moved.max_nodes));
    PetscCall(PetscArraycpy(&moved.group[c * FILE_FACETS], &r[HEAD + moved.max_nodes], FILE_FACETS));
    PetscCall(PetscArraycpy(&moved.group_end[c * FILE_FACETS], &r[HEAD + moved.max_nodes + FILE_FACETS], FILE_FACETS));
  }
  moved.order = order;
  moved.total = total;
  PetscCall(ExchangeDestroy(&exchange));
  PetscCall(PetscFree(came));
  *cells = moved;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Physical groups of the sides of a body. */
typedef struct {
  PetscInt  num;
  PetscInt *tag; /* [num] */
} SideTags;

/* The points of a body's cells, vertices or others, ascending. [out] points - freed by the caller */
static PetscErrorCode FileCellsGetPoints_Private(const FileCells *cells, PetscInt body, PetscBool vertices,
                                                 PetscInt *num, PetscInt **points)
{
  PetscInt most = 0;

  PetscFunctionBeginUser;
  for (PetscInt c = 0; c < cells->num; c++) most += cells->body[c] == body ? cells->file_nodes[c] : 0;
  PetscCall(PetscMalloc1(most, points));
  *num = 0;
  for (PetscInt c = 0; c < cells->num; c++) {
    const PetscInt corners = ElementNumNodes(ElementLinear((ElementType)cells->type[c]));

    for (PetscInt i = vertices ? 0 : corners; i < (vertices ? corners : cells->file_nodes[c]); i++)
      if (cells->body[c] == body) (*points)[(*num)++] = cells->nodes[c * cells->max_nodes + i];
  }
  PetscCall(PetscSortRemoveDupsInt(num, *points));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds the facets of a cell that are on sides; the cell may have been reversed. [in] tag - of each side */
static PetscErrorCode ListAddFacets_Private(const Files *files, const FileCells *cells, PetscInt c, PetscInt num_sides,
                                            const PetscInt tag[], const PetscInt before[], BodyList *list)
{
  const ElementType type = (ElementType)cells->type[c];
  const PetscInt    cell = list->num_cells - 1;

  PetscFunctionBeginUser;
  for (PetscInt f = 0; f < ElementNumFacets(type); f++) {
    const PetscInt *local = ElementFacetNodes(type, f);
    PetscInt        corners[ELEMENT_MAX_FACET_NODES];

    for (PetscInt i = 0; i < ElementNumNodes(ElementFacetType(type)); i++) corners[i] = before[local[i]];
    for (PetscInt s = 0; s < num_sides; s++) {
      if (!FileCellsHasSide(files, cells, c, f, tag[s])) continue;
      list->facet_cell[list->num_facets]   = cell;
      list->facet[list->num_facets]        = CellFindFacet(type, &list->cell_nodes[cell * ELEMENT_MAX_NODES], corners);
      list->facet_side[list->num_facets++] = s;
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Numbers of cells and facets of sides of a body on this rank, and of nodes that are not in the file. */
static void ListCount_Private(const Files *files, const FileCells *cells, PetscInt body, PetscInt num_sides,
                              const PetscInt tag[], PetscInt count[3])
{
  for (PetscInt i = 0; i < 3; i++) count[i] = 0;
  for (PetscInt c = 0; c < cells->num; c++) {
    if (cells->body[c] != body) continue;
    count[0]++;
    count[2] += ElementNumNodes((ElementType)cells->type[c]) - cells->file_nodes[c];
    for (PetscInt f = 0; f < ElementNumFacets((ElementType)cells->type[c]); f++)
      for (PetscInt s = 0; s < num_sides; s++) count[1] += FileCellsHasSide(files, cells, c, f, tag[s]);
  }
}

/* Nodes of a list: vertices, then others. Collective.
   [in] num, points - of both [2]; more - nodes that are not in the file */
static PetscErrorCode ListCreateNodes_Private(const Files *files, const PetscInt num[], PetscInt *const points[],
                                              const PetscInt count[], BodyList *list)
{
  PetscInt  *all;
  PetscReal *x;

  PetscFunctionBeginUser;
  PetscCall(BodyListAllocate(files->dim, count[0], num[0] + num[1] + count[2], count[1], list));
  PetscCall(PetscMalloc2(num[0] + num[1], &all, 3 * (num[0] + num[1]), &x));
  PetscCall(PetscArraycpy(all, points[0], num[0]));
  PetscCall(PetscArraycpy(&all[num[0]], points[1], num[1]));
  PetscCall(FilesGetPoints(files, num[0] + num[1], all, x));
  for (PetscInt i = 0; i < num[0] + num[1]; i++)
    for (PetscInt d = 0; d < files->dim; d++) list->coords[i * files->dim + d] = x[3 * i + d];
  PetscCall(PetscFree2(all, x));
  list->num_vertices = num[0];
  list->num_nodes    = num[0] + num[1];
  list->num_cells    = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The list of one body. Collective.
   [in] sides - of this body; [out] ids - of its vertices [list->num_vertices], freed by the
   caller */
static PetscErrorCode ListCreate_Private(Scene scene, const Files *files, const FileCells *cells, PetscInt body,
                                         const SideTags *sides, BodyList *list, PetscInt **ids)
{
  const PetscInt num_sides = sides->num, *tag = sides->tag;
  PetscInt       num[2], *points[2], count[3];

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < 2; k++)
    PetscCall(FileCellsGetPoints_Private(cells, body, (PetscBool)!k, &num[k], &points[k]));
  ListCount_Private(files, cells, body, num_sides, tag, count);
  PetscCall(ListCreateNodes_Private(files, num, points, count, list));
  list->curved_file  = (PetscBool)(cells->order > 1);
  list->straightened = (PetscBool)(scene->bodies[body].order < cells->order);
  if (scene->bodies[body].num_regions) PetscCall(PetscMalloc1(count[0], &list->cell_material));
  for (PetscInt c = 0; c < cells->num; c++) {
    const ElementType type    = (ElementType)cells->type[c];
    const PetscInt    corners = ElementNumNodes(ElementLinear(type)), at = list->num_cells;
    PetscInt         *nodes = &list->cell_nodes[at * ELEMENT_MAX_NODES], before[ELEMENT_MAX_NODES];

    if (cells->body[c] != body) continue;
    list->cell_type[at] = type;
    if (list->cell_material) list->cell_material[at] = cells->material[c];
    for (PetscInt i = 0; i < cells->file_nodes[c]; i++) {
      const PetscInt k = i >= corners;

      PetscCall(PetscFindInt(cells->nodes[c * cells->max_nodes + i], num[k], points[k], &nodes[i]));
      if (k) nodes[i] += num[0];
    }
    if (cells->file_nodes[c] < ElementNumNodes(type)) CellSetMiddles(at, cells->file_nodes[c], list);
    PetscCall(PetscArraycpy(before, nodes, ElementNumNodes(type)));
    list->num_cells++;
    if (BodyListGetMeasure(list, at, scene->bodies[body].order) < 0) CellReverse(type, nodes);
    PetscCall(ListAddFacets_Private(files, cells, c, num_sides, tag, before, list));
  }
  PetscCall(PetscFree(points[1]));
  for (PetscInt i = 0; i < num[0]; i++) points[0][i] += body * files->num_points;
  *ids = points[0];
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FileListsCreate(Scene scene, const Files *files, const FileCells *cells, const SideNames names[],
                               BodyList lists[], PetscInt **ids)
{
  PetscInt num = 0;

  PetscFunctionBeginUser;
  *ids = NULL;
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    SideTags  sides = {.num = names[b].num};
    PetscInt *own;

    PetscCall(PetscMalloc1(sides.num, &sides.tag));
    for (PetscInt s = 0; s < sides.num; s++)
      (void)GmshNamesFindGroup(&files->names[files->of_body[b]], files->dim - 1, names[b].name[s], &sides.tag[s]);
    PetscCall(ListCreate_Private(scene, files, cells, b, &sides, &lists[b], &own));
    PetscCall(PetscRealloc((num + lists[b].num_vertices) * sizeof(PetscInt), ids));
    PetscCall(PetscArraycpy(&(*ids)[num], own, lists[b].num_vertices));
    num += lists[b].num_vertices;
    PetscCall(PetscFree(own));
    PetscCall(PetscFree(sides.tag));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* fileparting.c -- the ranks of cells of files. The first rank gathers the facets that may touch. If the mesh
   is not large it also gathers the graph of all cells, and partitions it by METIS. */
#include "base/compat.h"
#include "level/facets.h"
#include "mesh/filecells.h"
#include "mesh/fileconnect.h"
#include "mesh/fileparting.h"
#include "mesh/graphparallel.h"
#include "partition/cellgraph.h"
#include "partition/graphcut.h"
#include <petscsf.h>

enum { CORNERS = 4 };

/* A facet of a side of a pair. */
typedef struct {
  PetscInt  end, cell, type; /* 2 pair + 1 on the mortar side; number of the cell; ElementType of order 1 */
  PetscReal x[CORNERS][3];
} SideFacet;

/* Values of cells of other ranks. Collective.
   [in] value - of own cells [cells->num]; [out] across - of the neighbour [num][FILE_FACETS] */
static PetscErrorCode NeighboursGet_Private(MPI_Comm comm, const FileCells *cells, const PetscReal value[],
                                            PetscReal across[])
{
  PetscInt   *leaves, *remote, num = 0;
  PetscLayout layout;
  PetscSF     sf;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(cells->num * FILE_FACETS, &leaves, cells->num * FILE_FACETS, &remote));
  for (PetscInt i = 0; i < cells->num * FILE_FACETS; i++) {
    if (cells->neighbour[i] < 0) continue;
    leaves[num]   = i;
    remote[num++] = cells->neighbour[i];
  }
  PetscCall(PetscLayoutCreateFromSizes(comm, cells->num, cells->total, 1, &layout));
  PetscCall(PetscSFCreate(comm, &sf));
  PetscCall(PetscSFSetGraphLayout(sf, layout, num, leaves, PETSC_COPY_VALUES, remote));
  PetscCall(PetscSFBcastBegin(sf, MPIU_REAL, value, across, MPI_REPLACE));
  PetscCall(PetscSFBcastEnd(sf, MPIU_REAL, value, across, MPI_REPLACE));
  PetscCall(PetscSFDestroy(&sf));
  PetscCall(PetscLayoutDestroy(&layout));
  PetscCall(PetscFree2(leaves, remote));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Edges across facets, each by the rank of its first cell. Collective. */
static PetscErrorCode FileCellsAddEdges_Private(MPI_Comm comm, const FileCells *cells, CellGraph *graph)
{
  PetscReal *farthest, *across;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc2(cells->num, &farthest, cells->num * FILE_FACETS, &across));
  for (PetscInt i = 0; i < cells->num * FILE_FACETS; i++)
    if (cells->neighbour[i] >= 0) farthest[i / FILE_FACETS] = PetscMax(farthest[i / FILE_FACETS], cells->distance[i]);
  PetscCall(NeighboursGet_Private(comm, cells, farthest, across));
  for (PetscInt i = 0; i < cells->num * FILE_FACETS; i++) {
    const PetscInt c = cells->first + i / FILE_FACETS;

    if (cells->neighbour[i] < c) continue;
    PetscCall(CellGraphAddEdge(graph, c, cells->neighbour[i],
                               CellGraphWeight(cells->distance[i], PetscMax(farthest[i / FILE_FACETS], across[i]))));
  }
  PetscCall(PetscFree2(farthest, across));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a facet is of a side, or of one of several joined with '+'. */
static PetscErrorCode FacetIsOf_Private(const Files *files, const FileCells *cells, PetscInt i, const SideNames *side,
                                        PetscBool *is)
{
  const PetscInt cell = i / FILE_FACETS;

  PetscFunctionBeginUser;
  *is = PETSC_FALSE;
  for (PetscInt s = 0; s < side->num; s++) {
    PetscInt tag;

    (void)GmshNamesFindGroup(&files->names[files->of_body[cells->body[cell]]], files->dim - 1, side->name[s], &tag);
    if (FileCellsHasSide(files, cells, cell, i % FILE_FACETS, tag)) *is = PETSC_TRUE;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Facets of one side on this rank, with points in place of corners.
   [in,out] facet, corner - freed by the caller */
static PetscErrorCode SideFacetsAdd_Private(const Files *files, const FileCells *cells, const SceneSide *side,
                                            PetscInt end, PetscInt *num, SideFacet **facet, PetscInt **corner)
{
  SideNames names = {0, NULL};

  PetscFunctionBeginUser;
  PetscCall(SideNamesAdd(&names, side->side));
  for (PetscInt i = 0; i < cells->num * FILE_FACETS; i++) {
    const PetscInt    c    = i / FILE_FACETS;
    const ElementType type = ElementLinear((ElementType)cells->type[c]);
    PetscBool         is   = PETSC_FALSE;

    if (cells->body[c] != side->body || cells->group[i] < 0 || cells->neighbour[i] >= 0) continue;
    PetscCall(FacetIsOf_Private(files, cells, i, &names, &is));
    if (!is) continue;
    PetscCall(PetscRealloc((*num + 1) * sizeof(**facet), facet));
    PetscCall(PetscRealloc((*num + 1) * CORNERS * sizeof(PetscInt), corner));
    (*facet)[*num] = (SideFacet){.end = end, .cell = cells->first + c, .type = ElementFacetType(type)};
    for (PetscInt k = 0; k < CORNERS; k++) {
      const PetscInt has = PetscMin(k, ElementNumNodes(ElementFacetType(type)) - 1);

      (*corner)[*num * CORNERS + k] =
          cells->nodes[c * cells->max_nodes + ElementFacetNodes(type, i % FILE_FACETS)[has]];
    }
    ++*num;
  }
  PetscCall(SideNamesDestroy(&names));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Arrays of all ranks, one after another, on the first. Collective.
   [out] all - freed by the caller, NULL on others */
static PetscErrorCode FilesGather_Private(const Files *files, size_t bytes, PetscInt num, const void *mine,
                                          PetscInt *total, void **all)
{
  PetscMPIInt *counts, *begins, n;
  MPI_Datatype type;

  PetscFunctionBeginUser;
  PetscCall(PetscMPIIntCast(num, &n));
  PetscCall(PetscMalloc2(files->size, &counts, files->size, &begins));
  PetscCallMPI(MPI_Gather(&n, 1, MPI_INT, counts, 1, MPI_INT, 0, files->comm));
  *total = 0;
  *all   = NULL;
  for (PetscMPIInt r = 0; r < files->size && !files->rank; r++) {
    begins[r] = (PetscMPIInt)*total;
    *total += counts[r];
  }
  if (!files->rank) PetscCall(PetscMalloc1((size_t)*total * bytes, (char **)all));
  PetscCallMPI(MPI_Type_contiguous((int)bytes, MPI_BYTE, &type));
  PetscCallMPI(MPI_Type_commit(&type));
  PetscCallMPI(MPI_Gatherv(mine, n, type, *all, counts, begins, type, 0, files->comm));
  PetscCallMPI(MPI_Type_free(&type));
  PetscCall(PetscFree2(counts, begins));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The facets of one end of a pair among those gathered, on a level that has their corners.
   [out] level, facets - freed by the caller */
static PetscErrorCode SideFacetsSelect_Private(PetscInt num, const SideFacet facet[], PetscInt end, PetscInt dim,
                                               Level *level, Facets *facets)
{
  PetscInt kept = 0;

  PetscFunctionBeginUser;
  PetscCall(FacetsAllocate(num, facets));
  for (PetscInt i = 0; i < num; i++) {
    if (facet[i].end != end) continue;
    facets->cell[kept] = facet[i].cell;
    facets->type[kept] = (ElementType)facet[i].type;
    for (PetscInt k = 0; k < ElementNumNodes((ElementType)facet[i].type); k++) {
      facets->nodes[kept * ELEMENT_MAX_FACET_NODES + k] = i * CORNERS + k;
      for (PetscInt d = 0; d < dim; d++) level->coords[(i * CORNERS + k) * dim + d] = facet[i].x[k][d];
    }
    kept++;
  }
  facets->num = kept;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Edges across contact, on the first rank. Collective. */
static PetscErrorCode FileCellsAddContact_Private(Scene scene, const Files *files, const FileCells *cells,
                                                  CellGraph *graph)
{
  PetscInt   num = 0, total, *corner = NULL;
  SideFacet *own = NULL, *all;
  PetscReal *x;
  Level      level = {.dim = files->dim};

  PetscFunctionBeginUser;
  for (PetscInt p = 0; p < scene->num_pairs; p++) {
    if (scene->pairs[p].mortar.body < 0) continue;
    PetscCall(SideFacetsAdd_Private(files, cells, &scene->pairs[p].nonmortar, 2 * p, &num, &own, &corner));
    PetscCall(SideFacetsAdd_Private(files, cells, &scene->pairs[p].mortar, 2 * p + 1, &num, &own, &corner));
  }
  PetscCall(PetscMalloc1(3 * CORNERS * num, &x));
  PetscCall(FilesGetPoints(files, CORNERS * num, corner, x));
  for (PetscInt i = 0; i < num; i++) PetscCall(PetscArraycpy(&own[i].x[0][0], &x[3 * CORNERS * i], 3 * CORNERS));
  PetscCall(PetscFree(x));
  PetscCall(PetscFree(corner));
  PetscCall(FilesGather_Private(files, sizeof(*own), num, own, &total, (void **)&all));
  PetscCall(PetscFree(own));
  PetscCall(PetscMalloc1(total * CORNERS * files->dim, &level.coords));
  for (PetscInt p = 0; p < scene->num_pairs && !files->rank; p++) {
    Facets side[2];

    if (scene->pairs[p].mortar.body < 0) continue;
    for (PetscInt k = 0; k < 2; k++)
      PetscCall(SideFacetsSelect_Private(total, all, 2 * p + k, files->dim, &level, &side[k]));
    PetscCall(CellGraphAddContact(&level, &side[0], &side[1], scene->pairs[p].reach, CONTACT_WEIGHT, graph));
    for (PetscInt k = 0; k < 2; k++) PetscCall(FacetsDestroy(&side[k]));
  }
  PetscCall(PetscFree(level.coords));
  PetscCall(PetscFree(all));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The graph of all cells on the first rank, from that of each. Collective. [in,out] graph */
static PetscErrorCode GraphGather_Private(const Files *files, CellGraph *graph)
{
  PetscInt *end, *weight, total;

  PetscFunctionBeginUser;
  PetscCall(FilesGather_Private(files, 2 * sizeof(PetscInt), graph->num, graph->end, &total, (void **)&end));
  PetscCall(FilesGather_Private(files, sizeof(PetscInt), graph->num, graph->weight, &total, (void **)&weight));
  PetscCall(CellGraphDestroy(graph));
  *graph = (CellGraph){.num = total, .max = total, .num_neighbours = total, .end = end, .weight = weight};
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The first rank parts the graph of all cells. Collective.
   [in,out] graph - edges across facets of this rank; gathered */
static PetscErrorCode GraphCutFirst_Private(Scene scene, const Files *files, const FileCells *cells, PetscInt refine,
                                            CellGraph *graph, PetscInt part[])
{
  Level        level = {.dim = files->dim, .num_cells = cells->total};
  PetscInt     total, *whole = NULL;
  PetscMPIInt *counts, *begins, n;

  PetscFunctionBeginUser;
  PetscCall(GraphGather_Private(files, graph));
  PetscCall(FilesGather_Private(files, sizeof(PetscInt), cells->num, cells->type, &total, (void **)&level.cell_type));
  PetscCall(FilesGather_Private(files, sizeof(PetscInt), cells->num, cells->body, &total, (void **)&level.cell_body));
  if (!files->rank) PetscCall(PetscCalloc2(total, &graph->contact, total, &whole));
  PetscCall(FileCellsAddContact_Private(scene, files, cells, graph));
  if (!files->rank) PetscCall(CellGraphCut(scene, &level, refine, graph, files->size, whole));
  PetscCall(PetscFree(level.cell_type));
  PetscCall(PetscFree(level.cell_body));
  PetscCall(PetscMPIIntCast(cells->num, &n));
  PetscCall(PetscMalloc2(files->size, &counts, files->size, &begins));
  PetscCallMPI(MPI_Gather(&n, 1, MPI_INT, counts, 1, MPI_INT, 0, files->comm));
  for (PetscMPIInt r = 0; r < files->size && !files->rank; r++) begins[r] = r ? begins[r - 1] + counts[r - 1] : 0;
  PetscCallMPI(MPI_Scatterv(whole, counts, begins, MPIU_INT, part, n, MPIU_INT, 0, files->comm));
  PetscCall(PetscFree2(counts, begins));
  if (!files->rank) PetscCall(PetscFree2(graph->contact, whole));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FileCellsPart(Scene scene, const Files *files, const FileCells *cells, const FileLimits *limits,
                             PetscInt refine, PetscInt part[])
{
  CellGraph graph = {.num = 0};

  PetscFunctionBeginUser;
  if (files->size == 1) { // METIS numbers one part 1
    PetscCall(PetscArrayzero(part, cells->num));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(FileCellsAddEdges_Private(files->comm, cells, &graph));
  if (cells->total >= limits->parallel && GraphHasParallel()) {
    PetscCall(FileCellsAddContact_Private(scene, files, cells, &graph));
    PetscCall(GraphCutParallel(scene, files, cells, &graph, part));
  } else {
    PetscCall(GraphCutFirst_Private(scene, files, cells, refine, &graph, part));
  }
  PetscCall(CellGraphDestroy(&graph));
  PetscFunctionReturn(PETSC_SUCCESS);
}

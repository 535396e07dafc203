/* arcextract.c -- smooth sides of a body while its file's mesh is refined (eq. 4.5). */
#include "base/compat.h"
#include "bodies/arcextract.h"
#include "bodies/fileextract.h"
#include "bodies/fileregions.h"
#include "level/plexpoints.h"
#include "refinement/filearcs.h"
#include "refinement/levelrefine.h"

/* The one chosen cell of a facet, -1 if there is none or if there are several. */
static PetscErrorCode ArcExtractGetCell_Private(const Extract *x, const PetscBool chosen[], PetscInt facet,
                                                PetscInt *cell)
{
  const PetscInt *support;
  PetscInt        begin, size, num = 0;

  PetscFunctionBeginUser;
  *cell = -1;
  PetscCall(DMPlexGetHeightStratum(x->level.dm, 0, &begin, NULL));
  PetscCall(DMPlexGetSupportSize(x->level.dm, facet, &size));
  PetscCall(DMPlexGetSupport(x->level.dm, facet, &support));
  for (PetscInt i = 0; i < size; i++) {
    if (!chosen[support[i] - begin]) continue;
    *cell = support[i] - begin;
    num++;
  }
  if (num != 1) *cell = -1;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Points of all sides of a list, each once. [out] points - freed by the caller */
static PetscErrorCode ArcExtractGetPoints_Private(const Extract *x, const SideNames *names, PetscInt *num,
                                                  PetscInt **points)
{
  PetscFunctionBeginUser;
  *num    = 0;
  *points = NULL;
  for (PetscInt s = 0; s < names->num; s++) {
    PetscInt tag, more, *labelled;

    if (!GmshNamesFindGroup(x->names, x->level.dim - 1, names->name[s], &tag) || tag <= 0) continue;
    PetscCall(LabelGetPoints(x->level.dm, "Face Sets", tag, &more, &labelled));
    PetscCall(PetscRealloc((*num + more) * sizeof(PetscInt), points));
    PetscCall(PetscArraycpy(&(*points)[*num], labelled, more));
    *num += more;
    PetscCall(PetscFree(labelled));
  }
  PetscCall(PetscSortRemoveDupsInt(num, *points));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Facets of sides, joined, on the boundary of the chosen cells. [in] side - NULL for none; it is freed */
static PetscErrorCode ArcExtractGetFacets_Private(const Extract *x, const PetscBool chosen[], char *side,
                                                  Facets *facets)
{
  SideNames names = {0, NULL};
  PetscInt  begin, end, num, *points, count = 0;

  PetscFunctionBeginUser;
  if (side) PetscCall(SideNamesAdd(&names, side));
  PetscCall(PetscFree(side));
  PetscCall(ArcExtractGetPoints_Private(x, &names, &num, &points));
  PetscCall(SideNamesDestroy(&names));
  PetscCall(DMPlexGetHeightStratum(x->level.dm, 1, &begin, &end));
  PetscCall(FacetsAllocate(num, facets));
  for (PetscInt i = 0; i < num; i++) {
    PetscInt cell, corners, vertices[ELEMENT_MAX_NODES];

    if (points[i] < begin || points[i] >= end) continue; // refinement labels what is on a facet as well
    PetscCall(ArcExtractGetCell_Private(x, chosen, points[i], &cell));
    if (cell < 0) continue;
    PetscCall(PointGetVertices(x->level.dm, points[i], &corners, vertices));
    facets->cell[count] = cell;
    facets->type[count] = ElementFacetType(ElementLinear((ElementType)x->level.cell_type[cell]));
    for (PetscInt v = 0; v < corners; v++)
      facets->nodes[count * ELEMENT_MAX_FACET_NODES + v] = PointGetNode(&x->level, vertices[v]);
    count++;
  }
  facets->num = count;
  FacetsTurnOut(&x->level, facets);
  PetscCall(PetscFree(points));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Facets of the sides of a body that may be smooth, and of those that must stay flat. */
static PetscErrorCode ExtractGetSides_Private(Extract *x, Scene scene, PetscInt body, ArcSides *sides)
{
  char      *round, *flat;
  PetscBool *chosen;

  PetscFunctionBeginUser;
  PetscCall(ArcSideNames(scene, body, &round, &flat));
  PetscCall(PetscMalloc1(x->level.num_cells, &chosen));
  PetscCall(RegionMark(x->level.dm, x->names, x->body->region, chosen, NULL));
  PetscCall(ArcExtractGetFacets_Private(x, chosen, round, &sides->round));
  PetscCall(ArcExtractGetFacets_Private(x, chosen, flat, &sides->flat));
  PetscCall(PetscFree(chosen));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ExtractArcSides(Extract *x, Scene scene, PetscInt body, ArcSides *sides)
{
  PetscFunctionBeginUser;
  *sides = (ArcSides){.any = PETSC_FALSE};
  if (x->alone.order > 1 || x->body->polygonal) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ExtractGetSides_Private(x, scene, body, sides));
  PetscCall(LevelHasArcs(&x->level, sides, &sides->any));
  if (sides->any) PetscCall(LevelKeepUnmapped(&x->level));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ExtractMarkParabolas(Extract *x, Scene scene, PetscInt body)
{
  ArcSides sides;

  PetscFunctionBeginUser;
  if (x->alone.order == 1 || x->body->polygonal) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ExtractGetSides_Private(x, scene, body, &sides));
  PetscCall(LevelMarkParabolas(&x->level, &sides, NULL, &x->alone.arcs));
  PetscCall(ArcSidesDestroy(&sides));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ExtractCurveMiddles(Extract *x, Scene scene, PetscInt body)
{
  ArcSides sides;

  PetscFunctionBeginUser;
  if (!x->alone.arcs) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ExtractGetSides_Private(x, scene, body, &sides));
  PetscCall(LevelArcMiddles(&x->level, &sides));
  PetscCall(PetscArraycpy(x->level.coords, x->level.unmapped, x->level.num_nodes * x->level.dim));
  PetscCall(ArcSidesDestroy(&sides));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* sidefacets.c -- the facets of a body's side, from the labels that the merge has set.

   Sides are searched at each call: they are few and short, and no list has to follow the mesh. */
#include "kernel/vector.h"
#include "level/plexpoints.h"
#include "level/facets.h"
#include "base/compat.h"

/* Points of the union of the labels "<body>:<part>", sorted, without duplicates, on this rank.
   [out] is - owned by the caller */
static PetscErrorCode SideGetPoints_Private(DM dm, const char body[], const char side[], IS *is)
{
  SideNames names = {0, NULL};
  PetscInt  begin, end, num = 0, *points;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetHeightStratum(dm, 1, &begin, &end));
  PetscCall(SideNamesAdd(&names, side));
  PetscCall(PetscMalloc1((end - begin) * names.num, &points));
  for (PetscInt s = 0; s < names.num; s++) {
    const PetscInt *labelled;
    char            text[PETSC_MAX_PATH_LEN];
    PetscInt        size;
    IS              stratum;

    PetscCall(PetscSNPrintf(text, sizeof(text), "%s:%s", body, names.name[s]));
    PetscCall(DMGetStratumIS(dm, text, 1, &stratum));
    if (!stratum) continue; // none on this rank
    PetscCall(ISGetLocalSize(stratum, &size));
    PetscCall(ISGetIndices(stratum, &labelled));
    for (PetscInt i = 0; i < size; i++) { // refinement labels new vertices as well
      if (labelled[i] >= begin && labelled[i] < end) points[num++] = labelled[i];
    }
    PetscCall(ISRestoreIndices(stratum, &labelled));
    PetscCall(ISDestroy(&stratum));
  }
  PetscCall(SideNamesDestroy(&names));
  PetscCall(PetscSortRemoveDupsInt(&num, points));
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, num, points, PETSC_COPY_VALUES, is));
  PetscCall(PetscFree(points));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* One facet with its nodes in the order of its cell. The cell is not inside out, so that the normal is
   outward. */
static PetscErrorCode FacetSet_Private(const Level *level, PetscInt point, PetscInt f, Facets *facets)
{
  const PetscInt *cells, *order, *nodes;
  PetscInt        cell_begin, num, ends[ELEMENT_MAX_NODES], number;
  ElementType     type;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetHeightStratum(level->dm, 0, &cell_begin, NULL));
  PetscCall(DMPlexGetSupport(level->dm, point, &cells));
  PetscCall(PointGetVertices(level->dm, point, &num, ends));
  facets->cell[f] = cells[0] - cell_begin;
  type            = (ElementType)level->cell_type[facets->cell[f]];
  nodes           = &level->cell_nodes[level->cell_start[facets->cell[f]]];
  for (PetscInt i = 0; i < num; i++) ends[i] = PointGetNode(level, ends[i]);
  number = CellFindFacet(type, nodes, ends);
  PetscCheck(number >= 0, PETSC_COMM_SELF, PETSC_ERR_PLIB, "Facet %" PetscInt_FMT " is not one of its cell", point);
  facets->type[f] = ElementFacetType(type);
  order           = ElementFacetNodes(type, number);
  for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); i++)
    facets->nodes[f * ELEMENT_MAX_FACET_NODES + i] = nodes[order[i]];
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelGetFacets(Level *level, Scene scene, PetscInt body, const char side[], Facets *facets)
{
  const PetscInt *points;
  IS              is;

  PetscFunctionBeginUser;
  PetscCall(SideGetPoints_Private(level->dm, scene->bodies[body].name, side, &is));
  PetscCall(ISGetLocalSize(is, &facets->num));
  PetscCall(ISGetIndices(is, &points));
  PetscCall(PetscMalloc3(facets->num, &facets->type, facets->num, &facets->cell, facets->num * ELEMENT_MAX_FACET_NODES,
                         &facets->nodes));
  for (PetscInt f = 0; f < facets->num; f++) PetscCall(FacetSet_Private(level, points[f], f, facets));
  PetscCall(ISRestoreIndices(is, &points));
  PetscCall(ISDestroy(&is));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelGetBoundary(const Level *level, PetscInt body, Facets *facets)
{
  PetscInt   begin, end, first, num = 0;
  PetscBool *shared;

  PetscFunctionBeginUser;
  PetscCall(LevelMarkShared(level, &shared));
  PetscCall(DMPlexGetHeightStratum(level->dm, 0, &first, NULL));
  PetscCall(DMPlexGetHeightStratum(level->dm, 1, &begin, &end));
  for (PetscInt pass = 0; pass < 2; pass++) {
    if (pass) PetscCall(FacetsAllocate(num, facets));
    num = 0;
    for (PetscInt f = begin; f < end; f++) {
      const PetscInt *cells;
      PetscInt        size;

      PetscCall(DMPlexGetSupportSize(level->dm, f, &size));
      PetscCall(DMPlexGetSupport(level->dm, f, &cells));
      if (size != 1 || shared[f] || level->cell_body[cells[0] - first] != body) continue;
      if (pass) PetscCall(FacetSet_Private(level, f, num, facets));
      num++;
    }
  }
  PetscCall(PetscFree(shared));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* arcsides.c -- the smooth sides: sides of pairs whose files have straight edges (eq. 4.5). */
#include "refinement/filearcs.h"
#include "refinement/refinementimpl.h"
#include "base/compat.h"
#include <string.h>

enum { F = ELEMENT_MAX_FACET_NODES };

/* "a+b+c". [out] side - freed by the caller, NULL for no names; the names are destroyed */
static PetscErrorCode SideNamesJoin_Private(SideNames *names, char **side)
{
  size_t length = 1;

  PetscFunctionBeginUser;
  *side = NULL;
  for (PetscInt i = 0; i < names->num; i++) length += strlen(names->name[i]) + 1;
  if (names->num) PetscCall(PetscCalloc1(length, side));
  for (PetscInt i = 0; i < names->num; i++) {
    if (i) strcat(*side, "+");
    strcat(*side, names->name[i]);
  }
  PetscCall(SideNamesDestroy(names));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ArcSideNames(Scene scene, PetscInt body, char **round, char **flat)
{
  const SceneBody *b       = &scene->bodies[body];
  SideNames        of_pair = {0, NULL}, normal = {0, NULL};

  PetscFunctionBeginUser;
  for (PetscInt p = 0; p < scene->num_pairs; p++) {
    const ScenePair *pair = &scene->pairs[p];

    if (pair->nonmortar.body == body) PetscCall(SideNamesAdd(&of_pair, pair->nonmortar.side));
    if (pair->mortar.body == body) PetscCall(SideNamesAdd(&of_pair, pair->mortar.side));
  }
  for (PetscInt i = 0; i < b->num_boundaries; i++) {
    if (b->boundaries[i].kind == BOUNDARY_NORMAL) PetscCall(SideNamesAdd(&normal, b->boundaries[i].side));
  }
  PetscCall(SideNamesJoin_Private(&of_pair, round));
  PetscCall(SideNamesJoin_Private(&normal, flat));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Appends the facets of sides of a body, if there are any. [in,out] side - is freed */
static PetscErrorCode ArcSidesAddFacets_Private(Level *level, PetscInt body, char **side, Facets *facets)
{
  Facets more;

  PetscFunctionBeginUser;
  if (*side) {
    PetscCall(LevelGetFacets(level, level->scene, body, *side, &more));
    for (PetscInt f = 0; f < more.num; f++) more.type[f] = ElementLinear(more.type[f]);
    FacetsTurnOut(level, &more);
    PetscCall(FacetsAppend(&more, facets));
  }
  PetscCall(PetscFree(*side));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds a body's facets. */
static PetscErrorCode ArcSidesAdd_Private(Level *level, PetscInt body, ArcSides *sides)
{
  char *round, *flat;

  PetscFunctionBeginUser;
  PetscCall(ArcSideNames(level->scene, body, &round, &flat));
  PetscCall(ArcSidesAddFacets_Private(level, body, &round, &sides->round));
  PetscCall(ArcSidesAddFacets_Private(level, body, &flat, &sides->flat));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ArcSidesCreate(Level *level, PetscInt order, ArcSides *sides)
{
  const Scene scene = level->scene;

  PetscFunctionBeginUser;
  *sides = (ArcSides){.any = PETSC_FALSE};
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    if (!scene->bodies[b].arcs || scene->bodies[b].order != order) continue;
    sides->any = PETSC_TRUE;
    PetscCall(ArcSidesAdd_Private(level, b, sides));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FileSidesCreate(Level *level, ArcSides *sides)
{
  const Scene scene = level->scene;

  PetscFunctionBeginUser;
  *sides = (ArcSides){.any = PETSC_FALSE};
  for (PetscInt b = 0; b < scene->num_bodies && level->dim == 3; b++) {
    const SceneBody *body = &scene->bodies[b];

    if (!body->curved_file || body->polygonal || body->order == 1) continue;
    sides->any = PETSC_TRUE;
    PetscCall(ArcSidesAdd_Private(level, b, sides));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ArcSidesDestroy(ArcSides *sides)
{
  PetscFunctionBeginUser;
  PetscCall(FacetsDestroy(&sides->round));
  PetscCall(FacetsDestroy(&sides->flat));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelFindFileArcs(Level *level)
{
  const Scene scene = level->scene;
  Level       plain = LevelBeforeMap(level);

  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    SceneBody *body  = &scene->bodies[b];
    ArcSides   sides = {.any = PETSC_FALSE};

    if (!body->curved_file || body->polygonal || body->order == 1) continue;
    PetscCall(ArcSidesAdd_Private(level, b, &sides));
    PetscCall(LevelMarkParabolas(&plain, &sides, level, &body->arcs));
    PetscCall(ArcSidesDestroy(&sides));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelFindArcs(Level *level, PetscBool *any)
{
  const Scene scene = level->scene;

  PetscFunctionBeginUser;
  *any = PETSC_FALSE;
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    SceneBody *body  = &scene->bodies[b];
    ArcSides   sides = {.any = PETSC_FALSE};

    body->arcs = PETSC_FALSE;
    if (!body->mesh_file || body->polygonal || body->curved_file) continue;
    PetscCall(ArcSidesAdd_Private(level, b, &sides));
    PetscCall(LevelHasArcs(level, &sides, &body->arcs));
    PetscCall(ArcSidesDestroy(&sides));
    *any = (PetscBool)(*any || body->arcs);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

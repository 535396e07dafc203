/* fileregions.c -- cells of a file by their physical groups: those that form a body, and its regions. */
#include "base/compat.h"
#include "bodies/bodylist.h"
#include "bodies/fileextract.h"
#include "bodies/fileregions.h"

/* Marks the cells of one group. [out] any - whether there are some */
static PetscErrorCode GroupMark_Private(DM dm, const GmshNames *names, const char group[], PetscBool chosen[],
                                        PetscBool *any)
{
  PetscInt dim, begin, end, tag, num = 0, *points = NULL;

  PetscFunctionBeginUser;
  *any = PETSC_FALSE;
  PetscCall(DMGetDimension(dm, &dim));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &begin, &end));
  if (GmshNamesFindGroup(names, dim, group, &tag)) PetscCall(LabelGetPoints(dm, "Cell Sets", tag, &num, &points));
  for (PetscInt i = 0; i < num; i++) {
    if (points[i] < begin || points[i] >= end) continue; // refinement labels the cells' edges as well
    chosen[points[i] - begin] = *any = PETSC_TRUE;
  }
  PetscCall(PetscFree(points));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A group whose own name has a '+' is one group. */
PetscErrorCode RegionMark(DM dm, const GmshNames *names, const char groups[], PetscBool chosen[], char lacking[])
{
  SideNames parts = {0, NULL};
  PetscInt  dim, begin, end;
  PetscBool any;

  PetscFunctionBeginUser;
  PetscCall(DMGetDimension(dm, &dim));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &begin, &end));
  for (PetscInt c = 0; c < end - begin; c++) chosen[c] = groups ? PETSC_FALSE : PETSC_TRUE;
  if (lacking) lacking[0] = '\0';
  if (!groups) PetscFunctionReturn(PETSC_SUCCESS);
  if (GmshNamesHas(names, dim, groups)) {
    PetscCall(GroupMark_Private(dm, names, groups, chosen, &any));
    if (!any && lacking) (void)snprintf(lacking, MESH_SENTENCE, "%s", groups);
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(SideNamesAdd(&parts, groups));
  for (PetscInt i = 0; i < parts.num; i++) {
    PetscCall(GroupMark_Private(dm, names, parts.name[i], chosen, &any));
    if (!any && lacking && !lacking[0]) (void)snprintf(lacking, MESH_SENTENCE, "%s", parts.name[i]);
  }
  PetscCall(SideNamesDestroy(&parts));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* "steel (1), rubber (2)": groups of some cells. [in] wanted - these cells [num_cells]; [out] text -
   "" if there are none [len] */
static PetscErrorCode GroupsDescribe_Private(const Extract *x, const PetscBool wanted[], char text[], size_t len)
{
  const PetscInt num_cells = x->level.num_cells;
  PetscInt       num, *tags;

  PetscFunctionBeginUser;
  text[0] = '\0';
  PetscCall(LabelGetPoints(x->level.dm, "Cell Sets", -1, &num, &tags));
  for (PetscInt i = 0; i < num; i++) {
    PetscInt  num_points, *points;
    PetscBool has = PETSC_FALSE;

    if (!tags[i]) continue; // in no group
    PetscCall(LabelGetPoints(x->level.dm, "Cell Sets", tags[i], &num_points, &points));
    for (PetscInt p = 0; p < num_points && !has; p++) {
      const PetscInt c = points[p] - x->cell_begin;

      has = (PetscBool)(c >= 0 && c < num_cells && wanted[c]);
    }
    PetscCall(PetscFree(points));
    if (has) GmshNamesDescribe(x->names, x->level.dim, tags[i], text, len);
  }
  PetscCall(PetscFree(tags));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* "-b_<option> x: the mesh has no cells in a physical group of this name or number; it has steel (1), rubber
   (2)" */
static PetscErrorCode GroupLacks_Private(const Extract *x, const char option[], const char group[], char sentence[])
{
  char        text[MESH_SENTENCE / 2];
  const char *other;
  PetscBool  *all;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(x->level.num_cells, &all));
  for (PetscInt c = 0; c < x->level.num_cells; c++) all[c] = PETSC_TRUE;
  PetscCall(GroupsDescribe_Private(x, all, text, sizeof(text)));
  PetscCall(PetscFree(all));
  PetscCall(ExtractFindOther(x, x->level.dim, group, &other));
  snprintf(sentence, MESH_SENTENCE,
           "-%s_%s %.200s: the mesh has no cells in a physical group of this name or number%s%s; it has %s",
           x->body->name, option, group, other ? ", which is a " : "", other ? other : "",
           text[0] ? text : "no groups of cells");
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ExtractSelect(Extract *x, char sentence[])
{
  char       lacking[MESH_SENTENCE];
  PetscBool *chosen;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(x->level.num_cells, &chosen));
  PetscCall(RegionMark(x->level.dm, x->names, x->body->region, chosen, lacking));
  for (PetscInt c = 0; c < x->level.num_cells; c++) x->cell_at[c] = chosen[c] ? x->num_cells++ : -1;
  PetscCall(PetscFree(chosen));
  if (lacking[0]) PetscCall(GroupLacks_Private(x, "mesh_region", lacking, sentence));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Gives the body's cells in one region its material. [out] clash - a cell that has another, or -1 */
static void RegionSet_Private(const Extract *x, PetscInt body, PetscInt material, const PetscBool chosen[],
                              BodyList *list, PetscInt *num, PetscInt *clash)
{
  *num   = 0;
  *clash = -1;
  for (PetscInt c = 0; c < x->level.num_cells; c++) {
    const PetscInt at = x->cell_at[c];

    if (at < 0 || !chosen[c]) continue;
    if (list->cell_material[at] != body) *clash = at;
    list->cell_material[at] = *clash == at ? list->cell_material[at] : material;
    ++*num;
  }
}

/* Reads one region. */
static PetscErrorCode ExtractRegion_Private(const Extract *x, Scene scene, PetscInt body, PetscInt material,
                                            BodyList *list, char sentence[])
{
  const char *group = scene->regions[material - scene->num_bodies].group;
  char        text[MESH_SENTENCE];
  PetscBool  *chosen;
  PetscInt    num, clash;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(x->level.num_cells, &chosen));
  PetscCall(RegionMark(x->level.dm, x->names, group, chosen, text));
  RegionSet_Private(x, body, material, chosen, list, &num, &clash);
  if (text[0]) {
    PetscCall(GroupLacks_Private(x, "regions", text, sentence));
  } else if (!num) {
    for (PetscInt c = 0; c < x->level.num_cells; c++) chosen[c] = (PetscBool)(x->cell_at[c] >= 0);
    PetscCall(GroupsDescribe_Private(x, chosen, text, MESH_SENTENCE / 2));
    snprintf(
        sentence, MESH_SENTENCE,
        "-%s_regions %.200s: no cell of body '%s' is in this physical group; -%s_mesh_region %.200s takes those in "
        "%.400s",
        x->body->name, group, x->body->name, x->body->name, x->body->region, text);
  } else if (clash >= 0) {
    snprintf(
        sentence, MESH_SENTENCE,
        "-%s_regions: cells of body '%s' are both in %.200s and in %.200s; a cell has one material, so name one of "
        "the two",
        x->body->name, x->body->name, scene->regions[list->cell_material[clash] - scene->num_bodies].group, group);
  }
  PetscCall(PetscFree(chosen));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The user error of cells in no region without a material. */
static PetscErrorCode ExtractCheckRest_Private(const Extract *x, PetscInt body, const BodyList *list, char sentence[])
{
  char       text[MESH_SENTENCE / 2];
  PetscBool *rest;
  PetscInt   num = 0;

  PetscFunctionBeginUser;
  if (!x->body->missing) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(x->level.num_cells, &rest));
  for (PetscInt c = 0; c < x->level.num_cells; c++) {
    rest[c] = (PetscBool)(x->cell_at[c] >= 0 && list->cell_material[x->cell_at[c]] == body);
    num += rest[c];
  }
  PetscCall(GroupsDescribe_Private(x, rest, text, sizeof(text)));
  PetscCall(PetscFree(rest));
  if (num)
    snprintf(sentence, MESH_SENTENCE,
             "%.200s is missing: %d cells of body '%s' are in none of the regions that -%s_regions names, and have the "
             "material of the body; they are in %s",
             x->body->missing, (int)num, x->body->name, x->body->name, text[0] ? text : "no physical group");
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ExtractRegions(const Extract *x, Scene scene, PetscInt body, BodyList *list, char sentence[])
{
  const PetscInt first = SceneBodyFirstRegion(scene, body), num = x->body->num_regions;

  PetscFunctionBeginUser;
  if (!num) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(list->num_cells, &list->cell_material));
  for (PetscInt c = 0; c < list->num_cells; c++) list->cell_material[c] = body;
  for (PetscInt m = first; m < first + num && !sentence[0]; m++)
    PetscCall(ExtractRegion_Private(x, scene, body, m, list, sentence));
  if (!sentence[0]) PetscCall(ExtractCheckRest_Private(x, body, list, sentence));
  PetscFunctionReturn(PETSC_SUCCESS);
}

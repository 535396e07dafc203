/* sharedcells.c -- bodies of the same cells of one file: -<body>_mesh_region was forgotten.

   Two bodies in the same place are a mistake. Two copies of one part are not: their maps differ. */
#include "base/compat.h"
#include "bodies/bodylist.h"
#include "bodies/fileextract.h"
#include "bodies/fileregions.h"
#include "bodies/meshfile.h"
#include "bodies/sharedcells.h"
#include <string.h>

/* Whether two maps take a file to the same place. */
static PetscBool SharedCellsSameMap_Private(Expression a, Expression b)
{
  if (!a || !b) return (PetscBool)(a == b);
  return (PetscBool)!strcmp(ExpressionText(a), ExpressionText(b));
}

/* "the file has the regions steel (1), wood (2)", or what to do where there are none. */
static PetscErrorCode SharedCellsDescribe_Private(const MeshFile file, PetscInt dim, char text[], size_t len)
{
  char     names[MESH_SENTENCE / 2] = "";
  PetscInt num, *tags;

  PetscFunctionBeginUser;
  PetscCall(LabelGetPoints(file->dm, "Cell Sets", -1, &num, &tags));
  for (PetscInt i = 0; i < num; i++) {
    if (tags[i]) GmshNamesDescribe(&file->names, dim, tags[i], names, sizeof(names)); // 0: in no group
  }
  PetscCall(PetscFree(tags));
  if (names[0])
    snprintf(text, len, "the file has the regions %.350s", names);
  else
    snprintf(text, len, "the file has no regions, which are physical %s of Gmsh", dim == 2 ? "surfaces" : "volumes");
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SharedCellsCheck(Scene scene, PetscInt body, const MeshFile file, char sentence[])
{
  const SceneBody *b = &scene->bodies[body];
  PetscInt         begin, end;
  PetscBool       *of_a, *of_b;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetHeightStratum(file->dm, 0, &begin, &end));
  PetscCall(PetscMalloc2(end - begin, &of_a, end - begin, &of_b));
  for (const SceneBody *a = scene->bodies; a < b && !sentence[0]; a++) {
    char     regions[MESH_SENTENCE / 2];
    PetscInt num = 0;

    if (!a->mesh_file || strcmp(a->mesh_file, b->mesh_file) || !SharedCellsSameMap_Private(a->map, b->map)) continue;
    PetscCall(RegionMark(file->dm, &file->names, a->region, of_a, NULL));
    PetscCall(RegionMark(file->dm, &file->names, b->region, of_b, NULL));
    for (PetscInt c = 0; c < end - begin; c++) num += of_a[c] && of_b[c];
    if (!num) continue;
    PetscCall(SharedCellsDescribe_Private(file, scene->dim, regions, sizeof(regions)));
    snprintf(
        sentence, MESH_SENTENCE,
        "-%s_dm_plex_filename %.250s: the bodies %s and %s have %d cells of this file in common; give each a region "
        "of its own with -%s_mesh_region and -%s_mesh_region: %s",
        b->name, b->mesh_file, a->name, b->name, (int)num, a->name, b->name, regions);
  }
  PetscCall(PetscFree2(of_a, of_b));
  PetscFunctionReturn(PETSC_SUCCESS);
}

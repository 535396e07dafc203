/* patchsummary.c -- the connected patches of a contact in the summary and on the terminal. */
#include "base/compat.h"
#include "base/json.h"
#include "output/patchsummary.h"
#include "checks/contactpatches.h"

enum { MOST_PRINTED = 4 }; /* patches on the terminal */

PetscErrorCode PatchSummaryAdd(Fields fields, PetscInt p, cJSON *object)
{
  cJSON         *array = cJSON_AddArrayToObject(object, "patches");
  ContactPatches patches;

  PetscFunctionBeginUser;
  if (!fields) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ContactPatchesCreate(fields, p, &patches));
  for (PetscInt i = 0; i < patches.num; i++) {
    const ContactPatch *patch = &patches.patch[i];
    const PetscInt      dim   = fields->vi->level->dim;
    cJSON              *item  = cJSON_CreateObject(), *axes;

    cJSON_AddItemToArray(array, item);
    JSONAddReals(item, "force", dim, patch->force);
    JSONAddReal(item, "normal_force", patch->normal_force);
    JSONAddReals(item, "moment", dim == 2 ? 1 : 3, patch->moment);
    JSONAddReal(item, "area", patch->area);
    JSONAddReal(item, "mean_pressure", patch->mean_pressure);
    JSONAddReal(item, "max_pressure", patch->max_pressure);
    JSONAddReals(item, "centre", dim, patch->centre);
    JSONAddReals(item, "extent", dim - 1, patch->extent);
    axes = cJSON_AddArrayToObject(item, "axes");
    for (PetscInt a = 0; a < dim - 1; a++) JSONAppendReals(axes, dim, patch->axis[a]);
    JSONAddReal(item, "facets", patch->facets);
    JSONAddInt(item, "nodes", patch->nodes);
  }
  PetscCall(ContactPatchesDestroy(&patches));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PatchSummaryPrint(Fields fields, PetscInt p)
{
  const MPI_Comm comm = fields->vi->level->comm;
  ContactPatches patches;

  PetscFunctionBeginUser;
  PetscCall(ContactPatchesCreate(fields, p, &patches));
  for (PetscInt i = 0; i < PetscMin(patches.num, MOST_PRINTED) && patches.num > 1; i++) {
    const ContactPatch *patch = &patches.patch[i];

    PetscCall(PetscPrintf(comm,
                          "    patch %" PetscInt_FMT " of %" PetscInt_FMT
                          ": normal force %.6g, area %.6g, mean pressure %.6g, %.3g facets wide, centre (%.4g, %.4g",
                          i + 1, patches.num, (double)patch->normal_force, (double)patch->area,
                          (double)patch->mean_pressure, (double)patch->facets, (double)patch->centre[0],
                          (double)patch->centre[1]));
    if (fields->vi->level->dim == 3) PetscCall(PetscPrintf(comm, ", %.4g", (double)patch->centre[2]));
    PetscCall(PetscPrintf(comm, ")\n"));
  }
  PetscCall(ContactPatchesDestroy(&patches));
  PetscFunctionReturn(PETSC_SUCCESS);
}

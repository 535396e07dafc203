/* groupsets.c -- sets of physical groups. */
#include "gmsh/groupsets.h"
#include "base/compat.h"

/* Finds or appends a set.
   [in] guess - the set of the element before, which is tried first; [out] set - its number */
static PetscErrorCode GroupSetsFind_Private(GroupSets *sets, PetscInt num, const PetscInt number[], PetscInt guess,
                                            PetscInt *set)
{
  PetscFunctionBeginUser;
  for (PetscInt i = -1; i < sets->num; i++) {
    const PetscInt at = i < 0 ? guess : i;
    PetscBool      same;

    if (sets->start[at + 1] - sets->start[at] != num) continue;
    PetscCall(PetscArraycmp(&sets->number[sets->start[at]], number, num, &same));
    *set = at;
    if (same) PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PetscRealloc((sets->num + 2) * sizeof(PetscInt), &sets->start));
  PetscCall(PetscRealloc((sets->start[sets->num] + num) * sizeof(PetscInt), &sets->number));
  PetscCall(PetscArraycpy(&sets->number[sets->start[sets->num]], number, num));
  sets->start[sets->num + 1] = sets->start[sets->num] + num;
  *set                       = sets->num++;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GroupSetsCreate(const GmshMesh *mesh, PetscInt dim, GroupSets *sets, PetscInt **set)
{
  PetscInt guess = 0;

  PetscFunctionBeginUser;
  *sets = (GroupSets){.num = 1};
  PetscCall(PetscRealloc(2 * sizeof(PetscInt), &sets->start));
  sets->start[0] = sets->start[1] = 0;
  PetscCall(PetscMalloc1(mesh->num_elements, set));
  for (PetscInt e = 0; e < mesh->num_elements; e++) {
    const PetscInt first = mesh->first_group[e], num = mesh->end_group[e] - first, own = mesh->type[e]->dim;

    (*set)[e] = -1;
    if (own != dim && (own != dim - 1 || !num)) continue;
    PetscCall(GroupSetsFind_Private(sets, num, num ? &mesh->group[first] : NULL, guess, &(*set)[e]));
    guess = (*set)[e];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GroupSetsDestroy(GroupSets *sets)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(sets->start));
  PetscCall(PetscFree(sets->number));
  sets->num = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

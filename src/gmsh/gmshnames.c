/* gmshnames.c -- names and numbers of the physical groups of a Gmsh file. */
#include "gmsh/gmsh.h"
#include "base/compat.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

PetscErrorCode GmshNamesDestroy(GmshNames *names)
{
  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < names->num; i++) PetscCall(PetscFree(names->name[i]));
  PetscCall(PetscFree3(names->dim, names->tag, names->name));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Index of a name in the list, -1 if it is not there. */
static PetscInt GmshNamesFind_Private(const GmshNames *names, PetscInt dim, const char name[])
{
  for (PetscInt i = 0; i < names->num; i++) {
    if (names->dim[i] == dim && !strcmp(names->name[i], name)) return i;
  }
  return -1;
}

/* Names come first: a group may have the name "7". */
PetscBool GmshNamesFindGroup(const GmshNames *names, PetscInt dim, const char group[], PetscInt *tag)
{
  const PetscInt at = GmshNamesFind_Private(names, dim, group);
  char          *end;

  if (at >= 0) {
    *tag = names->tag[at];
    return PETSC_TRUE;
  }
  *tag = (PetscInt)strtol(group, &end, 10);
  return end != group && !*end ? PETSC_TRUE : PETSC_FALSE;
}

PetscBool GmshNamesHas(const GmshNames *names, PetscInt dim, const char name[])
{
  return GmshNamesFind_Private(names, dim, name) >= 0 ? PETSC_TRUE : PETSC_FALSE;
}

void GmshNamesUnite(const GmshNames *names, GmshMesh *mesh)
{
  for (PetscInt i = 0; i < names->num; i++) {
    const PetscInt first = GmshNamesFind_Private(names, names->dim[i], names->name[i]);

    if (names->tag[first] == names->tag[i]) continue;
    for (PetscInt e = 0; e < mesh->num_elements; e++)
      for (PetscInt g = mesh->first_group[e]; g < mesh->end_group[e] && mesh->type[e]->dim == names->dim[i]; g++)
        if (mesh->group[g] == names->tag[i]) mesh->group[g] = names->tag[first];
  }
}

void GmshNamesDescribe(const GmshNames *names, PetscInt dim, PetscInt tag, char text[], size_t len)
{
  const size_t used = strlen(text);
  const char  *name = NULL;

  for (PetscInt i = 0; i < names->num; i++) {
    if (names->dim[i] == dim && names->tag[i] == tag) name = names->name[i];
  }
  if (name) snprintf(text + used, len - used, "%s%s (%d)", used ? ", " : "", name, (int)tag);
  if (!name) snprintf(text + used, len - used, "%s%d", used ? ", " : "", (int)tag);
}

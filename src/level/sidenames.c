/* sidenames.c -- names of sides: "a+b" is the union of two. */
#include <string.h>
#include "base/compat.h"
#include "level/level.h"

/* Adds one name unless it is there. */
static PetscErrorCode SideNamesAddOne_Private(SideNames *names, const char name[], size_t length)
{
  PetscInt i;

  PetscFunctionBeginUser;
  for (i = 0; i < names->num; i++) {
    if (strlen(names->name[i]) == length && !strncmp(names->name[i], name, length)) PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PetscRealloc((names->num + 1) * sizeof(char *), &names->name));
  PetscCall(PetscMalloc1(length + 1, &names->name[names->num]));
  memcpy(names->name[names->num], name, length);
  names->name[names->num++][length] = '\0';
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SideNamesAdd(SideNames *names, const char side[])
{
  PetscFunctionBeginUser;
  for (const char *part = side; part; part = strchr(part, '+') ? strchr(part, '+') + 1 : NULL) {
    PetscCall(SideNamesAddOne_Private(names, part, strcspn(part, "+")));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SideNamesDestroy(SideNames *names)
{
  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < names->num; i++) PetscCall(PetscFree(names->name[i]));
  PetscCall(PetscFree(names->name));
  names->num = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

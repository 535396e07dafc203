/* scenesides.c -- sides of bodies as the user names them: one, or several joined with '+'.

   Whether a side of a mesh exists is known when the mesh is read; the sides of a box are known now. */
#include "scene/sceneparts.h"
#include <string.h>

/* Copies the part of a joined side at cursor, which moves behind it; NULL after the last one. */
static const char *SideNextPart_Private(const char *cursor, char part[OPTION_MAX])
{
  const size_t length = PetscMin(strcspn(cursor, "+"), OPTION_MAX - 1);

  memcpy(part, cursor, length);
  part[length] = '\0';
  return cursor[length] == '+' ? cursor + length + 1 : NULL;
}

PetscErrorCode SceneSideCheck(const Option *option, const SceneBody *body, const char side[])
{
  static const char *const box_sides[] = {"left", "right", "bottom", "top", "front", "back"};
  const PetscInt           num         = 2 * option->scene->dim; /* the first four are those of a plane box */
  char                     part[OPTION_MAX], again[OPTION_MAX];

  PetscFunctionBeginUser;
  for (const char *cursor = side; cursor;) {
    PetscBool found = (PetscBool) !!body->mesh_file;

    cursor = SideNextPart_Private(cursor, part);
    if (!part[0]) PetscCall(OptionRaise(option, "'%s' has an empty part; sides are joined as in left+top", side));
    if (cursor && SceneSideOverlaps(part, cursor, again))
      PetscCall(OptionRaise(option, "'%s' names the side %s twice", side, again));
    for (PetscInt i = 0; i < num; i++) found = (PetscBool)(found || !strcmp(part, box_sides[i]));
    if (!found) {
      const char *near = UserErrorNearest(part, num, box_sides);

      PetscCall(OptionRaise(option, "the box %s has no side '%s'; its sides are left, right, bottom, top%s%s%s%s",
                            body->name, part, option->scene->dim == 3 ? ", front, back" : "",
                            near ? "; did you mean " : "", near ? near : "", near ? "?" : ""));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscBool SceneSideOverlaps(const char a[], const char b[], char common[])
{
  char of_a[OPTION_MAX], of_b[OPTION_MAX];

  for (const char *p = a; p;) {
    p = SideNextPart_Private(p, of_a);
    for (const char *q = b; q;) {
      q = SideNextPart_Private(q, of_b);
      if (strcmp(of_a, of_b) != 0) continue;
      if (common) memcpy(common, of_a, strlen(of_a) + 1);
      return PETSC_TRUE;
    }
  }
  return PETSC_FALSE;
}

PetscBool SceneSidesShare(const char a[], const char b[])
{
  return SceneSideOverlaps(a, b, NULL);
}

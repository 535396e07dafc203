/* sceneboundaries.c -- supports and loads of one body: lists of sides, and a datum for each.

   A load along a direction that the same side fixes goes into the support. The mesh tells how large it is,
   and problem/lostload.c warns. Loads on one side add up. */
#include "scene/sceneparts.h"
#include <string.h>

/* Names of the kinds in the options, in the order of BoundaryKind. */
static const char *const kinds[] = {"displacement", "normal", "traction", "pressure", "force", "moment"};
enum { NUM_KINDS = 6 };

/* The list of sides of one kind. */
static PetscErrorCode BoundaryFindList_Private(Scene scene, const SceneBody *body, PetscInt kind, Option *list)
{
  static const char *const patterns[NUM_KINDS] = {"-<body>_bc_displacement", "-<body>_bc_normal", "-<body>_bc_traction",
                                                  "-<body>_bc_pressure",     "-<body>_bc_force",  "-<body>_bc_moment"};

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, patterns[kind], body->name, NULL, list));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Reads the datum of one listed side. If it is missing, the data of all other sides have been read before.
   Hence an unread datum is that of a side that is not listed. */
static PetscErrorCode BoundaryFindValue_Private(Scene scene, const SceneBody *body, const SceneBoundary *boundary,
                                                Option *datum)
{
  static const char *const patterns[NUM_KINDS] = {"-<body>_bc_displacement_<side>", NULL,
                                                  "-<body>_bc_traction_<side>",     "-<body>_bc_pressure_<side>",
                                                  "-<body>_bc_force_<side>",        "-<body>_bc_moment_<side>"};

  PetscFunctionBeginUser;
  if (boundary->kind == BOUNDARY_NORMAL) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(OptionFind(scene, patterns[boundary->kind], body->name, boundary->side, datum));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Raises a user error where a total names a coordinate, or where a ring is to carry a moment. */
static PetscErrorCode BoundaryCheckTotal_Private(const Option *datum, const SceneBoundary *boundary)
{
  static const char *const coordinates[] = {"x", "y", "z", "r"};

  PetscFunctionBeginUser;
  if (boundary->kind != BOUNDARY_FORCE && boundary->kind != BOUNDARY_MOMENT) PetscFunctionReturn(PETSC_SUCCESS);
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(coordinates); i++) {
    if (ExpressionNames(boundary->value, coordinates[i]))
      PetscCall(OptionRaise(datum, "the total of a side cannot name %s; write numbers, or formulas of the time t",
                            coordinates[i]));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Components of a datum. */
static PetscInt BoundaryNumComponents_Private(Scene scene, BoundaryKind kind)
{
  if (kind == BOUNDARY_PRESSURE || (kind == BOUNDARY_MOMENT && scene->dim == 2)) return 1;
  return scene->dim;
}

static PetscErrorCode BoundaryReadValue_Private(Scene scene, const SceneBody *body, SceneBoundary *boundary)
{
  const PetscBool displacement = (PetscBool)(boundary->kind == BOUNDARY_DISPLACEMENT);
  Option          datum;
  char            why[OPTION_MAX];

  PetscFunctionBeginUser;
  if (boundary->kind == BOUNDARY_NORMAL) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(BoundaryFindValue_Private(scene, body, boundary, &datum));
  PetscCall(PetscSNPrintf(why, sizeof(why), "the side is listed in -<body>_bc_%s", kinds[boundary->kind]));
  PetscCall(OptionRequire(&datum, why));
  PetscCall(OptionGetExpression(&datum, BoundaryNumComponents_Private(scene, boundary->kind), displacement,
                                &boundary->value));
  PetscCall(BoundaryCheckTotal_Private(&datum, boundary));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Reads one list of sides with its data, and appends the boundaries. */
static PetscErrorCode BoundaryReadKind_Private(Scene scene, SceneBody *body, PetscInt kind)
{
  Option      list, datum;
  const char *cursor = NULL;
  char        side[OPTION_MAX];
  PetscInt    num, first = body->num_boundaries;

  PetscFunctionBeginUser;
  PetscCall(BoundaryFindList_Private(scene, body, kind, &list));
  num = OptionCountItems(&list);
  if (list.set && kind == BOUNDARY_MOMENT && scene->model == MODEL_AXISYMMETRIC)
    PetscCall(OptionRaise(&list, "the forces on a ring have no moment, by symmetry; use -model solid"));
  for (PetscInt i = 0; i < num; i++) {
    SceneBoundary *boundary = &body->boundaries[body->num_boundaries];

    PetscCall(OptionNextItem(&list, &cursor, side));
    if (strlen(side) + strlen(list.name) + 2 > OPTION_MAX)
      PetscCall(OptionRaise(&list, "the name of a side is too long for an option"));
    PetscCall(SceneSideCheck(&list, body, side));
    for (PetscInt j = first; j < body->num_boundaries; j++) {
      char common[OPTION_MAX];

      if (SceneSideOverlaps(side, body->boundaries[j].side, common))
        PetscCall(OptionRaise(&list, "the side %s is listed twice", common));
    }
    boundary->kind = (BoundaryKind)kind;
    body->num_boundaries++;
    PetscCall(PetscStrallocpy(side, &boundary->side));
    PetscCall(BoundaryFindValue_Private(scene, body, boundary, &datum));
  }
  for (PetscInt i = first; i < body->num_boundaries; i++)
    PetscCall(BoundaryReadValue_Private(scene, body, &body->boundaries[i]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscBool SceneBoundaryFixesAll(Scene scene, const SceneBoundary *boundary)
{
  if (boundary->kind != BOUNDARY_DISPLACEMENT) return PETSC_FALSE;
  for (PetscInt c = 0; c < scene->dim; c++) {
    if (ExpressionIsFree(boundary->value, c)) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

PetscErrorCode SceneBoundariesRead(Scene scene, SceneBody *body)
{
  Option   list;
  PetscInt num = 0;

  PetscFunctionBeginUser;
  for (PetscInt kind = 0; kind < NUM_KINDS; kind++) {
    PetscCall(BoundaryFindList_Private(scene, body, kind, &list));
    num += OptionCountItems(&list);
  }
  PetscCall(PetscCalloc1(num, &body->boundaries));
  for (PetscInt kind = 0; kind < NUM_KINDS; kind++) PetscCall(BoundaryReadKind_Private(scene, body, kind));
  PetscFunctionReturn(PETSC_SUCCESS);
}

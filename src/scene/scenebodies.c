/* scenebodies.c -- one body: its mesh, and data of the whole body. */
#include "scene/sceneparts.h"
#include "base/options.h"

/* Raises a user error where a box would have more cells than a PetscInt can count, on the finest mesh of a
   study. */
static PetscErrorCode BodyCheckSize_Private(Scene scene, const SceneBody *body, const Option *faces)
{
  const PetscInt refine =
      body->refine + scene->refine + (scene->study.kind == STUDY_UNIFORM ? scene->study.levels - 1 : 0);
  const PetscInt unknowns = scene->dim == 2 ? 2 * 4 : 3 * 8; /* of a cell of order 2 that shares its nodes */
  PetscReal      cells    = !body->simplex ? 1 : scene->dim == 2 ? 2 : 6; /* of every brick */

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < scene->dim; i++) cells *= PetscPowRealInt(2, (int)refine) * body->faces[i];
  if (cells * unknowns >= (PetscReal)PETSC_MAX_INT) {
    PetscCall(OptionRaise(faces,
                          "refined %" PetscInt_FMT
                          " times (-%s_dm_refine and -dm_refine%s) this box has %.3g cells, more than can be numbered",
                          refine, body->name, scene->study.kind == STUDY_UNIFORM ? ", then -study_levels" : "",
                          (double)cells));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A box: faces, corners, triangles or quads. */
static PetscErrorCode BodyReadBox_Private(Scene scene, SceneBody *body, const Option *faces)
{
  Option lower, upper, simplex;

  PetscFunctionBeginUser;
  PetscCall(OptionGetInts(faces, scene->dim, 1, body->faces));
  PetscCall(OptionFind(scene, "-<body>_dm_plex_box_lower", body->name, NULL, &lower));
  PetscCall(OptionFind(scene, "-<body>_dm_plex_box_upper", body->name, NULL, &upper));
  PetscCall(OptionFind(scene, "-<body>_dm_plex_simplex", body->name, NULL, &simplex));
  for (PetscInt i = 0; i < scene->dim; i++) body->upper[i] = 1;
  PetscCall(OptionGetReals(&lower, scene->dim, body->lower));
  PetscCall(OptionGetReals(&upper, scene->dim, body->upper));
  PetscCall(OptionGetBool(&simplex, &body->simplex));
  for (PetscInt i = 0; i < scene->dim; i++) {
    if (body->lower[i] < body->upper[i]) continue;
    PetscCall(OptionRaise(upper.set ? &upper : &lower,
                          "the box is empty along %c: its lower end %g must be below its upper end %g", "xyz"[i],
                          (double)body -> lower[i], (double)body -> upper[i]));
  }
  PetscCall(BodyCheckSize_Private(scene, body, faces));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Reads the option of a mesh file, which must exist; the module mesh reads it. */
static PetscErrorCode BodyReadFile_Private(Scene scene, SceneBody *body, const Option *file)
{
  char      found[PETSC_MAX_PATH_LEN];
  Option    region;
  PetscBool exists = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(OptionGetText(file, &body->mesh_file));
  PetscCall(OptionsFindFile(scene->comm, body->mesh_file, found, sizeof(found), &exists));
  if (!exists) {
    PetscCall(OptionRaise(
        file, "there is no such file that can be read, neither from the working directory nor from the folder of the "
              "options file"));
  }
  PetscCall(PetscFree(body->mesh_file));
  PetscCall(PetscStrallocpy(found, &body->mesh_file));
  PetscCall(OptionFind(scene, "-<body>_mesh_region", body->name, NULL, &region));
  PetscCall(OptionGetText(&region, &body->region));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Cells of a box are in no physical group. */
static PetscErrorCode BodyCheckNoRegions_Private(Scene scene, const SceneBody *body)
{
  Option regions;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-<body>_regions", body->name, NULL, &regions));
  if (!body->num_regions) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(OptionRaise(&regions,
                        "a box has no regions, which are physical groups of a mesh file; moduli of a box vary by a "
                        "formula, such as -%s_young \"x<0.5 ? 2e5 : 7e4\", with a boundary of cells at the jump",
                        body->name));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode BodyReadMesh_Private(Scene scene, SceneBody *body)
{
  Option   file, faces, map, refine, polygonal, order, exact;
  PetscInt number;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-<body>_dm_plex_filename", body->name, NULL, &file));
  PetscCall(OptionFind(scene, "-<body>_dm_plex_box_faces", body->name, NULL, &faces));
  PetscCall(OptionFind(scene, "-<body>_map", body->name, NULL, &map));
  PetscCall(OptionFind(scene, "-<body>_dm_refine", body->name, NULL, &refine));
  PetscCall(OptionFind(scene, "-<body>_polygonal", body->name, NULL, &polygonal));
  PetscCall(OptionFind(scene, "-<body>_order", body->name, NULL, &order));
  if (file.set && faces.set)
    PetscCall(
        OptionRaise(&faces, "the body has a mesh file already (%s %s); give one of the two", file.name, file.text));
  PetscCall(OptionGetInts(&refine, 1, 0, &body->refine));
  if (file.set)
    PetscCall(BodyReadFile_Private(scene, body, &file));
  else {
    PetscCall(OptionRequire(&faces, "every body needs a mesh: a box, or a file named by -<body>_dm_plex_filename"));
    PetscCall(BodyCheckNoRegions_Private(scene, body));
    PetscCall(BodyReadBox_Private(scene, body, &faces));
  }
  PetscCall(OptionGetBool(&polygonal, &body->polygonal));
  PetscCall(OptionGetExpression(&map, scene->dim, PETSC_FALSE, &body->map));
  PetscCall(OptionFind(scene, "-<body>_exact_displacement", body->name, NULL, &exact));
  PetscCall(OptionGetExpression(&exact, scene->dim, PETSC_FALSE, &body->exact));
  if (order.set) {
    PetscCall(OptionGetChoice(&order, &number));
    body->order = number + 1;
    if (scene->study.num_orders)
      PetscCall(OptionRaise(&order, "-study_orders gives the order of all bodies; give one of the two"));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Reads the unit vector along a body with pretension. */
static PetscErrorCode BodyReadAxis_Private(Scene scene, SceneBody *body)
{
  Option    axis;
  PetscReal length = 0;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-<body>_pretension_axis", body->name, NULL, &axis));
  PetscCall(OptionRequire(&axis, "-<body>_pretension acts along an axis"));
  PetscCall(OptionGetReals(&axis, scene->dim, body->axis));
  for (PetscInt k = 0; k < scene->dim; k++) length += PetscSqr(body->axis[k]);
  length = PetscSqrtReal(length);
  if (!(length > 0)) PetscCall(OptionRaise(&axis, "an axis has a direction; one of its components is not 0"));
  for (PetscInt k = 0; k < scene->dim; k++) body->axis[k] /= length;
  if (scene->model == MODEL_AXISYMMETRIC && body->axis[0] != 0)
    PetscCall(OptionRaise(&axis, "a ring has tension along the axis of the scene alone; write 0,1"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A mean axial force. */
static PetscErrorCode BodyReadPretension_Private(Scene scene, SceneBody *body)
{
  const PetscReal origin[3] = {0, 0, 0};
  PetscReal       force;
  Option          pretension;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-<body>_pretension", body->name, NULL, &pretension));
  if (!pretension.set) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(OptionGetExpression(&pretension, 1, PETSC_FALSE, &body->pretension));
  if (ExpressionNames(body->pretension, "x") || ExpressionNames(body->pretension, "y") ||
      ExpressionNames(body->pretension, "z") || ExpressionNames(body->pretension, "r"))
    PetscCall(
        OptionRaise(&pretension, "the force of a body does not vary in space; write a number, or a formula of t"));
  if (ExpressionIsConstant(body->pretension)) {
    PetscCall(ExpressionEvaluate(body->pretension, scene->dim, origin, &force));
    if (!(force > 0)) PetscCall(OptionRaise(&pretension, "a pretension is a tensile force above 0"));
  }
  PetscCall(BodyReadAxis_Private(scene, body));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SceneBodyRead(Scene scene, SceneBody *body)
{
  PetscFunctionBeginUser;
  PetscCall(BodyReadMesh_Private(scene, body));
  PetscCall(SceneMaterialsRead(scene, body));
  PetscCall(BodyReadPretension_Private(scene, body));
  PetscCall(SceneBoundariesRead(scene, body));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SceneBodyDestroy(SceneBody *body)
{
  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < body->num_boundaries; i++) {
    PetscCall(PetscFree(body->boundaries[i].side));
    PetscCall(ExpressionDestroy(&body->boundaries[i].value));
  }
  PetscCall(PetscFree(body->boundaries));
  PetscCall(SceneMaterialDestroy(&body->material));
  PetscCall(ExpressionDestroy(&body->map));
  PetscCall(ExpressionDestroy(&body->pretension));
  PetscCall(ExpressionDestroy(&body->exact));
  PetscCall(PetscFree(body->name));
  PetscCall(PetscFree(body->mesh_file));
  PetscCall(PetscFree(body->region));
  PetscCall(PetscFree(body->missing));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* scenebodies.c -- mesh and material of one body. */
#include "scene/sceneparts.h"
#include "base/options.h"
#include <math.h>

/* A constant Hooke matrix counts as singular below this ratio of its eigenvalues: a thousand roundings. */
static const PetscReal DEFINITE = 1000 * PETSC_MACHINE_EPSILON;

/* Raises a user error where a box would have more cells than the whole numbers of PETSc can count, on the finest mesh of a study. */
static PetscErrorCode BodyCheckSize_Private(Scene scene, const SceneBody *body, const Option *faces)
{
  const PetscInt refine   = body->refine + scene->refine + (scene->study.kind ? scene->study.levels - 1 : 0);
  const PetscInt unknowns = scene->dim == 2 ? 2 * 4 : 3 * 8; /* of a cell of order 2 that shares its nodes */
  PetscReal      cells    = !body->simplex ? 1 : scene->dim == 2 ? 2 : 6; /* of every brick */

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < scene->dim; i++) cells *= PetscPowRealInt(2, (int)refine) * body->faces[i];
  if (cells * unknowns >= (PetscReal)PETSC_MAX_INT) {
    PetscCall(OptionRaise(faces,
                          "refined %" PetscInt_FMT
                          " times (-%s_dm_refine and -dm_refine%s) this box has %.3g cells, more than can be numbered",
                          refine, body->name, scene->study.kind ? ", then -study_levels" : "", (double)cells));
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

/* A file, which must be there; what is in it is the mesh's business. */
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

/* Checks E and nu where they are plain numbers. Above nu = 1/2 a body would grow under pressure. Near nu = 1/2 it keeps
   its volume: plane stress can still show that by its thickness, but in other models displacements alone cannot tell
   the pressure. */
static PetscErrorCode BodyCheckIsotropic_Private(Scene scene, const SceneBody *body, const Option *young,
                                                 const Option *poisson)
{
  const PetscReal origin[3] = {0, 0, 0};
  PetscReal       E, nu;

  PetscFunctionBeginUser;
  if (ExpressionIsConstant(body->young)) {
    PetscCall(ExpressionEvaluate(body->young, scene->dim, origin, &E));
    if (!(E > 0)) PetscCall(OptionRaise(young, "Young's modulus must be above 0"));
  }
  if (ExpressionIsConstant(body->poisson)) {
    PetscCall(ExpressionEvaluate(body->poisson, scene->dim, origin, &nu));
    if (nu >= MATERIAL_POISSON_END && nu <= 0.5 && scene->model != MODEL_PLANE_STRESS) {
      PetscCall(OptionRaise(poisson,
                            "an incompressible body needs a mixed method, which Mortise does not have; Poisson's ratio "
                            "must be above -1 and below %.7g",
                            MATERIAL_POISSON_END));
    }
    if (!(nu > -1 && nu <= 0.5)) PetscCall(OptionRaise(poisson, "Poisson's ratio must be above -1 and below 0.5"));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Checks a Hooke matrix of plain numbers: turning it does not change its eigenvalues. */
static PetscErrorCode BodyCheckStiffness_Private(Scene scene, const SceneBody *body, const Option *stiffness)
{
  const PetscReal origin[3] = {0, 0, 0};
  PetscReal       upper[21], C[36];
  const PetscInt  num_strains = MaterialNumStrains(scene->model);

  PetscFunctionBeginUser;
  if (!ExpressionIsConstant(body->stiffness)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ExpressionEvaluate(body->stiffness, scene->dim, origin, upper));
  MaterialAnisotropic(scene->model, upper, body->angle, C);
  if (!(MaterialDefiniteness(num_strains, C) > DEFINITE)) {
    PetscCall(OptionRaise(
        stiffness,
        "the Hooke matrix is not positive definite: some strain has no energy, or a negative one; check the "
        "order of its entries, %s",
        scene->model == MODEL_AXISYMMETRIC
            ? "xx-xx, xx-yy, xx-zz, xx-xy, yy-yy, yy-zz, yy-xy, zz-zz, zz-xy, xy-xy, zz being around the axis"
            : "xx-xx, xx-yy, xx-xy, yy-yy, yy-xy, xy-xy"));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The axes of a material that has some. */
static PetscErrorCode BodyReadAngle_Private(Scene scene, SceneBody *body)
{
  Option angle;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-<body>_material_angle", body->name, NULL, &angle));
  PetscCall(OptionGetReals(&angle, scene->dim == 2 ? 1 : 3, body->angle));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode BodyReadMaterial_Private(Scene scene, SceneBody *body)
{
  Option         young, poisson, stiffness;
  const PetscInt num_strains = MaterialNumStrains(scene->model);

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-<body>_young", body->name, NULL, &young));
  PetscCall(OptionFind(scene, "-<body>_poisson", body->name, NULL, &poisson));
  PetscCall(OptionFind(scene, "-<body>_stiffness", body->name, NULL, &stiffness));
  if (stiffness.set) {
    if (young.set || poisson.set) {
      PetscCall(OptionRaise(young.set ? &young : &poisson,
                            "the body has a Hooke matrix already (%s); give one of the two", stiffness.name));
    }
    PetscCall(OptionGetExpression(&stiffness, num_strains * (num_strains + 1) / 2, PETSC_FALSE, &body->stiffness));
    PetscCall(BodyReadAngle_Private(scene, body));
    PetscCall(BodyCheckStiffness_Private(scene, body, &stiffness));
  } else {
    PetscCall(OptionRequire(&young,
                            "every body needs a material, Young's modulus and Poisson's ratio, or -<body>_stiffness"));
    PetscCall(OptionRequire(&poisson, "an isotropic material needs Poisson's ratio as well"));
    PetscCall(OptionGetExpression(&young, 1, PETSC_FALSE, &body->young));
    PetscCall(OptionGetExpression(&poisson, 1, PETSC_FALSE, &body->poisson));
    PetscCall(BodyCheckIsotropic_Private(scene, body, &young, &poisson));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Raises a user error where the six numbers of a plane Hooke matrix do not tell what a strain across the plane does.
   [in] across - which component that is */
static PetscErrorCode BodyCheckAcross_Private(Scene scene, const SceneBody *body, const Option *option, Expression e,
                                              PetscInt across)
{
  const PetscReal origin[3] = {0, 0, 0};
  PetscReal       values[6] = {0};

  PetscFunctionBeginUser;
  if (!e || !body->stiffness || scene->model != MODEL_PLANE_STRAIN) PetscFunctionReturn(PETSC_SUCCESS);
  if (ExpressionSize(e) > across && ExpressionIsConstant(e)) {
    PetscCall(ExpressionEvaluate(e, scene->dim, origin, values));
    if (values[across] == 0) PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(OptionRaise(option,
                        "in plane strain the six numbers of -%s_stiffness do not tell the stress of a strain across "
                        "the plane; write 0 for its zz, with the strains in the plane that a body held along z has, or "
                        "use -model plane_stress or solid",
                        body->name));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Strains without stress: of temperature, and others. */
static PetscErrorCode BodyReadEigenstrain_Private(Scene scene, SceneBody *body)
{
  Option   temperature, expansion, strain;
  PetscInt num;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-<body>_temperature", body->name, NULL, &temperature));
  PetscCall(OptionFind(scene, "-<body>_thermal_expansion", body->name, NULL, &expansion));
  PetscCall(OptionFind(scene, "-<body>_initial_strain", body->name, NULL, &strain));
  if (temperature.set)
    PetscCall(OptionRequire(&expansion, "-<body>_temperature strains a body by its coefficient of thermal expansion"));
  if (expansion.set)
    PetscCall(OptionRequire(&temperature, "-<body>_thermal_expansion has no effect without a temperature"));
  PetscCall(OptionGetExpression(&temperature, 1, PETSC_FALSE, &body->temperature));
  PetscCall(OptionGetExpression(&expansion, 0, PETSC_FALSE, &body->expansion));
  num = body->expansion ? ExpressionSize(body->expansion) : 1;
  if (num != 1 && num != 3)
    PetscCall(OptionRaise(
        &expansion, "%" PetscInt_FMT " numbers given; write one, or three, one for each axis of the material", num));
  if (num == 3) PetscCall(BodyReadAngle_Private(scene, body));
  PetscCall(BodyCheckAcross_Private(scene, body, &expansion, body->expansion, 2));
  PetscCall(OptionGetExpression(&strain, scene->dim == 2 ? 4 : 6, PETSC_FALSE, &body->initial_strain));
  PetscCall(BodyCheckAcross_Private(scene, body, &strain, body->initial_strain, 2));
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
  PetscCall(BodyReadMaterial_Private(scene, body));
  PetscCall(BodyReadEigenstrain_Private(scene, body));
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
  PetscCall(ExpressionDestroy(&body->map));
  PetscCall(ExpressionDestroy(&body->young));
  PetscCall(ExpressionDestroy(&body->poisson));
  PetscCall(ExpressionDestroy(&body->stiffness));
  PetscCall(ExpressionDestroy(&body->body_force));
  PetscCall(ExpressionDestroy(&body->temperature));
  PetscCall(ExpressionDestroy(&body->expansion));
  PetscCall(ExpressionDestroy(&body->initial_strain));
  PetscCall(ExpressionDestroy(&body->pretension));
  PetscCall(ExpressionDestroy(&body->exact));
  PetscCall(PetscFree(body->name));
  PetscCall(PetscFree(body->mesh_file));
  PetscCall(PetscFree(body->region));
  PetscFunctionReturn(PETSC_SUCCESS);
}

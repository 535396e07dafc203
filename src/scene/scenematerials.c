/* scenematerials.c -- materials of a body and of its regions.

   A region has its own value where its option is given, else that of its body. Both read the same option
   then, so that each material has expressions of its own. */
#include "scene/sceneparts.h"

/* A constant Hooke matrix counts as singular below this ratio of its eigenvalues: a thousand roundings. */
static const PetscReal DEFINITE = 1000 * PETSC_MACHINE_EPSILON;

typedef enum {
  KEY_YOUNG,
  KEY_POISSON,
  KEY_STIFFNESS,
  KEY_ANGLE,
  KEY_FORCE,
  KEY_TEMPERATURE,
  KEY_EXPANSION,
  KEY_STRAIN,
  KEY_COUNT
} MaterialKey;

/* Options of a body and of its regions. */
static const struct {
  const char *of_body, *of_region;
} patterns[KEY_COUNT] = {
    [KEY_YOUNG]       = {"-<body>_young", "-<body>_<region>_young"},
    [KEY_POISSON]     = {"-<body>_poisson", "-<body>_<region>_poisson"},
    [KEY_STIFFNESS]   = {"-<body>_stiffness", "-<body>_<region>_stiffness"},
    [KEY_ANGLE]       = {"-<body>_material_angle", "-<body>_<region>_material_angle"},
    [KEY_FORCE]       = {"-<body>_body_force", "-<body>_<region>_body_force"},
    [KEY_TEMPERATURE] = {"-<body>_temperature", "-<body>_<region>_temperature"},
    [KEY_EXPANSION]   = {"-<body>_thermal_expansion", "-<body>_<region>_thermal_expansion"},
    [KEY_STRAIN]      = {"-<body>_initial_strain", "-<body>_<region>_initial_strain"},
};

/* A datum of a material. */
typedef struct {
  Option    option; /* of the region where that is given or the body has none, else of the body */
  PetscBool own;    /* whether it is given for this body or region itself */
} Datum;

/* Whose material is read. */
typedef struct {
  Scene              scene;
  SceneBody         *body;
  const SceneRegion *region; /* or NULL */
  SceneMaterial     *material;
} Reader;

/* PETSc looks for -a_young where -a_1_young is not given: the value is the same then. */
static PetscErrorCode DatumFind_Private(const Reader *r, MaterialKey key, Datum *datum)
{
  Option of_body;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(r->scene, patterns[key].of_body, r->body->name, NULL, &of_body));
  datum->option = of_body;
  datum->own    = of_body.set;
  if (!r->region) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(OptionFind(r->scene, patterns[key].of_region, r->region->prefix, NULL, &datum->option));
  datum->own = (PetscBool)(datum->option.set && datum->option.text != of_body.text);
  if (!datum->own && of_body.set) datum->option = of_body;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether any region of the body that is read gives a datum. */
static PetscErrorCode DatumOfRegions_Private(const Reader *r, MaterialKey key, PetscBool *any)
{
  PetscFunctionBeginUser;
  *any = PETSC_FALSE;
  for (PetscInt i = 0; i < r->body->num_regions && !r->region; i++) {
    const Reader of_region = {r->scene, r->body, &r->scene->regions[r->body->first_region + i], NULL};
    Datum        datum;

    PetscCall(DatumFind_Private(&of_region, key, &datum));
    *any = (PetscBool)(*any || datum.own);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Raises a user error if a datum is missing. For a body with regions it does so only if there are cells in
   none of them, which the mesh knows.
   [out] found - whether it is there */
static PetscErrorCode DatumRequire_Private(const Reader *r, const Datum *datum, const char why[], PetscBool *found)
{
  PetscFunctionBeginUser;
  *found = datum->option.set;
  if (*found) PetscFunctionReturn(PETSC_SUCCESS);
  if (r->region || !r->body->num_regions) PetscCall(OptionRequire(&datum->option, why));
  if (!r->body->missing) PetscCall(PetscStrallocpy(datum->option.name, &r->body->missing));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Checks E and nu where they are plain numbers. Above nu = 1/2 a body would grow under pressure. Near nu =
   1/2 it keeps its volume. Plane stress can still show that by its thickness. In other models displacements
   alone cannot tell the pressure. */
static PetscErrorCode MaterialCheckIsotropic_Private(const Reader *r, const Option *young, const Option *poisson)
{
  const PetscReal origin[3] = {0, 0, 0};
  PetscReal       E, nu;

  PetscFunctionBeginUser;
  if (ExpressionIsConstant(r->material->young)) {
    PetscCall(ExpressionEvaluate(r->material->young, r->scene->dim, origin, &E));
    if (!(E > 0)) PetscCall(OptionRaise(young, "Young's modulus must be above 0"));
  }
  if (ExpressionIsConstant(r->material->poisson)) {
    PetscCall(ExpressionEvaluate(r->material->poisson, r->scene->dim, origin, &nu));
    if (nu >= MATERIAL_POISSON_END && nu <= 0.5 && r->scene->model != MODEL_PLANE_STRESS) {
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
static PetscErrorCode MaterialCheckStiffness_Private(const Reader *r, const Option *stiffness)
{
  const PetscReal origin[3] = {0, 0, 0};
  const ModelKind model     = r->scene->model;
  PetscReal       upper[21], C[36];

  PetscFunctionBeginUser;
  if (!ExpressionIsConstant(r->material->stiffness)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ExpressionEvaluate(r->material->stiffness, r->scene->dim, origin, upper));
  MaterialAnisotropic(model, upper, r->material->angle, C);
  if (!(MaterialDefiniteness(MaterialNumStrains(model), C) > DEFINITE)) {
    PetscCall(OptionRaise(
        stiffness,
        "the Hooke matrix is not positive definite: some strain has no energy, or a negative one; check the "
        "order of its entries, %s",
        model == MODEL_AXISYMMETRIC
            ? "xx-xx, xx-yy, xx-zz, xx-xy, yy-yy, yy-zz, yy-xy, zz-zz, zz-xy, xy-xy, zz being around the axis"
            : "xx-xx, xx-yy, xx-xy, yy-yy, yy-xy, xy-xy"));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The axes of a material that has some. */
static PetscErrorCode MaterialReadAngle_Private(const Reader *r)
{
  Datum angle;

  PetscFunctionBeginUser;
  PetscCall(DatumFind_Private(r, KEY_ANGLE, &angle));
  PetscCall(OptionGetReals(&angle.option, r->scene->dim == 2 ? 1 : 3, r->material->angle));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode MaterialReadIsotropic_Private(const Reader *r, const Datum *young, const Datum *poisson)
{
  PetscBool found;

  PetscFunctionBeginUser;
  PetscCall(DatumRequire_Private(
      r, young, "every body needs a material, Young's modulus and Poisson's ratio, or -<body>_stiffness", &found));
  if (found) PetscCall(DatumRequire_Private(r, poisson, "an isotropic material needs Poisson's ratio as well", &found));
  if (!found) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(OptionGetExpression(&young->option, 1, PETSC_FALSE, &r->material->young));
  PetscCall(OptionGetExpression(&poisson->option, 1, PETSC_FALSE, &r->material->poisson));
  PetscCall(MaterialCheckIsotropic_Private(r, &young->option, &poisson->option));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A region may be isotropic in a body with a Hooke matrix, and have one in a body that is isotropic. */
static PetscErrorCode MaterialReadElastic_Private(const Reader *r)
{
  const PetscInt num_strains = MaterialNumStrains(r->scene->model);
  Datum          young, poisson, stiffness;

  PetscFunctionBeginUser;
  PetscCall(DatumFind_Private(r, KEY_YOUNG, &young));
  PetscCall(DatumFind_Private(r, KEY_POISSON, &poisson));
  PetscCall(DatumFind_Private(r, KEY_STIFFNESS, &stiffness));
  if (stiffness.own && (young.own || poisson.own)) {
    PetscCall(OptionRaise(young.own ? &young.option : &poisson.option,
                          "the %s has a Hooke matrix already (%s); give one of the two", r->region ? "region" : "body",
                          stiffness.option.name));
  }
  if (!stiffness.option.set || young.own || poisson.own) {
    PetscCall(MaterialReadIsotropic_Private(r, &young, &poisson));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(OptionGetExpression(&stiffness.option, num_strains * (num_strains + 1) / 2, PETSC_FALSE,
                                &r->material->stiffness));
  PetscCall(MaterialReadAngle_Private(r));
  PetscCall(MaterialCheckStiffness_Private(r, &stiffness.option));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Raises a user error where the six numbers of a plane Hooke matrix do not tell what a strain across the
   plane does. [in] e - the thermal expansion or the initial strain; NULL without one */
static PetscErrorCode MaterialCheckAcross_Private(const Reader *r, const Option *option, Expression e)
{
  const PetscReal origin[3] = {0, 0, 0};
  PetscReal       values[6] = {0};

  PetscFunctionBeginUser;
  if (!e || !r->material->stiffness || r->scene->model != MODEL_PLANE_STRAIN) PetscFunctionReturn(PETSC_SUCCESS);
  if (ExpressionSize(e) > 2 && ExpressionIsConstant(e)) {
    PetscCall(ExpressionEvaluate(e, r->scene->dim, origin, values));
    if (values[2] == 0) PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(OptionRaise(option,
                        "in plane strain the six numbers of %s do not determine the stress of a strain across the "
                        "plane; write 0 for its zz, with the strains in the plane that a body held along z has, or "
                        "use -model plane_stress or solid",
                        ExpressionOption(r->material->stiffness)));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Temperature and thermal expansion: without one of them the other has no effect, unless a region has it. */
static PetscErrorCode MaterialReadThermal_Private(const Reader *r)
{
  Datum     temperature, expansion;
  PetscBool region_expands, region_is_warm, found;
  PetscInt  num;
  char      point[128];

  PetscFunctionBeginUser;
  PetscCall(DatumFind_Private(r, KEY_TEMPERATURE, &temperature));
  PetscCall(DatumFind_Private(r, KEY_EXPANSION, &expansion));
  PetscCall(DatumOfRegions_Private(r, KEY_EXPANSION, &region_expands));
  PetscCall(DatumOfRegions_Private(r, KEY_TEMPERATURE, &region_is_warm));
  if (temperature.option.set && !region_expands)
    PetscCall(
        OptionRequire(&expansion.option, "-<body>_temperature strains a body by its coefficient of thermal expansion"));
  if (expansion.own && !region_is_warm)
    PetscCall(OptionRequire(&temperature.option, "-<body>_thermal_expansion has no effect without a temperature"));
  if (!temperature.option.set) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(DatumRequire_Private(r, &expansion, "", &found));
  if (!found) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(OptionGetExpression(&temperature.option, 1, PETSC_FALSE, &r->material->temperature));
  PetscCall(OptionGetExpression(&expansion.option, 0, PETSC_FALSE, &r->material->expansion));
  num = ExpressionSize(r->material->expansion);
  if (num != 1 && num != 3) {
    ExpressionSuggestPoint(expansion.option.text, 1, point, sizeof(point));
    PetscCall(OptionRaise(&expansion.option,
                          "%" PetscInt_FMT " numbers given; write one, or three, one for each axis of the material%s",
                          num, point));
  }
  if (num == 3) PetscCall(MaterialReadAngle_Private(r));
  PetscCall(MaterialCheckAcross_Private(r, &expansion.option, r->material->expansion));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode MaterialRead_Private(const Reader *r)
{
  Datum force, strain;

  PetscFunctionBeginUser;
  PetscCall(MaterialReadElastic_Private(r));
  PetscCall(MaterialReadThermal_Private(r));
  PetscCall(DatumFind_Private(r, KEY_STRAIN, &strain));
  PetscCall(OptionGetExpression(&strain.option, r->scene->dim == 2 ? 4 : 6, PETSC_FALSE, &r->material->initial_strain));
  PetscCall(MaterialCheckAcross_Private(r, &strain.option, r->material->initial_strain));
  PetscCall(DatumFind_Private(r, KEY_FORCE, &force));
  PetscCall(OptionGetExpression(&force.option, r->scene->dim, PETSC_FALSE, &r->material->body_force));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SceneMaterialsRead(Scene scene, SceneBody *body)
{
  PetscFunctionBeginUser;
  PetscCall(MaterialRead_Private(&(Reader){scene, body, NULL, &body->material}));
  for (PetscInt i = 0; i < body->num_regions; i++) {
    SceneRegion *region = &scene->regions[body->first_region + i];

    PetscCall(MaterialRead_Private(&(Reader){scene, body, region, &region->material}));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SceneMaterialDestroy(SceneMaterial *material)
{
  PetscFunctionBeginUser;
  PetscCall(ExpressionDestroy(&material->young));
  PetscCall(ExpressionDestroy(&material->poisson));
  PetscCall(ExpressionDestroy(&material->stiffness));
  PetscCall(ExpressionDestroy(&material->body_force));
  PetscCall(ExpressionDestroy(&material->temperature));
  PetscCall(ExpressionDestroy(&material->expansion));
  PetscCall(ExpressionDestroy(&material->initial_strain));
  PetscFunctionReturn(PETSC_SUCCESS);
}

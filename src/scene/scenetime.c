/* scenetime.c -- data that change from one solution to the next: time, and values that a caller gives. */
#include "scene/sceneparts.h"
#include <string.h>
#include <strings.h>

/* A datum of the scene, where it stands. */
typedef struct {
  Expression *e;
  int         kind;     /* DatumKind */
  PetscBool   scaled;   /* whether time multiplies it where -load_steps_scale has its kind */
  PetscBool   variable; /* whether a caller may replace it */
} Datum;

enum {
  DATA_MATERIAL = 7,
  DATA_BODY     = 3,
  DATA_PAIR     = 6
}; /* of a material, of a body beside its boundaries, of a pair */

/* Adds the data of a material. [in,out] data - [num] */
static void DataAddMaterial_Private(SceneMaterial *material, PetscInt *num, Datum data[])
{
  const Datum those[DATA_MATERIAL] = {{&material->young, DATUM_MATERIAL, PETSC_FALSE, PETSC_FALSE},
                                      {&material->poisson, DATUM_MATERIAL, PETSC_FALSE, PETSC_FALSE},
                                      {&material->stiffness, DATUM_MATERIAL, PETSC_FALSE, PETSC_FALSE},
                                      {&material->body_force, DATUM_LOAD, PETSC_TRUE, PETSC_TRUE},
                                      {&material->temperature, DATUM_TEMPERATURE, PETSC_TRUE, PETSC_TRUE},
                                      {&material->initial_strain, DATUM_TEMPERATURE, PETSC_TRUE, PETSC_TRUE},
                                      {&material->expansion, DATUM_TEMPERATURE, PETSC_FALSE, PETSC_TRUE}};

  for (PetscInt i = 0; i < DATA_MATERIAL; i++) data[(*num)++] = those[i];
}

/* All data that a scene has. [out] data - [num], owned by the caller */
static PetscErrorCode DataList_Private(Scene scene, PetscInt *num, Datum **data)
{
  PetscInt most = DATA_MATERIAL * (scene->num_bodies + scene->num_regions) + DATA_BODY * scene->num_bodies +
                  DATA_PAIR * scene->num_pairs,
           n = 0;

  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < scene->num_bodies; b++) most += scene->bodies[b].num_boundaries;
  PetscCall(PetscMalloc1(most, data));
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    SceneBody *body = &scene->bodies[b];

    (*data)[n++] = (Datum){&body->map, DATUM_MESH, PETSC_FALSE, PETSC_FALSE};
    DataAddMaterial_Private(&body->material, &n, *data);
    (*data)[n++] = (Datum){&body->exact, 0, PETSC_FALSE, PETSC_FALSE};
    (*data)[n++] = (Datum){&body->pretension, DATUM_PRETENSION, PETSC_FALSE, PETSC_TRUE};
    for (PetscInt i = 0; i < body->num_boundaries; i++) {
      const int kind = body->boundaries[i].kind == BOUNDARY_DISPLACEMENT ? DATUM_DISPLACEMENT : DATUM_LOAD;

      (*data)[n++] = (Datum){&body->boundaries[i].value, kind, PETSC_TRUE, PETSC_TRUE};
    }
  }
  for (PetscInt r = 0; r < scene->num_regions; r++) DataAddMaterial_Private(&scene->regions[r].material, &n, *data);
  for (PetscInt p = 0; p < scene->num_pairs; p++) {
    ScenePair *pair = &scene->pairs[p];

    (*data)[n++] = (Datum){&pair->gap_offset, DATUM_GAP, PETSC_TRUE, PETSC_TRUE};
    (*data)[n++] = (Datum){&pair->gap, DATUM_GAP, PETSC_FALSE, PETSC_TRUE};
    (*data)[n++] = (Datum){&pair->obstacle.gap, DATUM_GAP, PETSC_FALSE, PETSC_TRUE};
    (*data)[n++] = (Datum){&pair->exact, 0, PETSC_FALSE, PETSC_FALSE};
    (*data)[n++] = (Datum){&pair->friction, DATUM_FRICTION, PETSC_FALSE, PETSC_TRUE};
    (*data)[n++] = (Datum){&pair->bound, DATUM_FRICTION, PETSC_FALSE, PETSC_TRUE};
  }
  *num = 0;
  for (PetscInt i = 0; i < n; i++)
    if (*(*data)[i].e) (*data)[(*num)++] = (*data)[i];
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SceneSetTime(Scene scene, PetscReal t)
{
  PetscInt    num;
  PetscBool   named = PETSC_FALSE;
  const char *map   = NULL;
  int         scaled, vary = 0;
  Datum      *data;

  PetscFunctionBeginUser;
  PetscCall(DataList_Private(scene, &num, &data));
  for (PetscInt i = 0; i < num; i++) {
    const PetscBool names = ExpressionNames(*data[i].e, "t");

    if (names && data[i].kind == DATUM_MESH) map = ExpressionOption(*data[i].e);
    named = (PetscBool)(named || names);
  }
  scaled = scene->steps.scale_set ? scene->steps.scale : named ? 0 : SCENE_STEPS_SCALABLE;
  for (PetscInt i = 0; i < num; i++) {
    const PetscBool names      = ExpressionNames(*data[i].e, "t");
    const PetscBool multiplied = (PetscBool)(!names && data[i].scaled && (data[i].kind & scaled));

    ExpressionSetFactor(*data[i].e, multiplied ? t : 1);
    if (names || multiplied) vary |= data[i].kind;
  }
  if (t != scene->time) scene->changed |= vary;
  scene->time   = t;
  scene->scaled = (PetscBool)(scaled && !named);
  ExpressionSetTime(t);
  PetscCall(PetscFree(data));
  if (map)
    PetscCall(UserErrorRaise(scene->comm, "%s: a map cannot name the time t, the mesh is made only once; write x, y, z",
                             map));
  if (scene->steps.num > 1 && !vary)
    PetscCall(UserErrorRaise(scene->comm, "-load_steps: all steps are alike: no datum names t, and %s",
                             scene->steps.scale_set
                                 ? "-load_steps_scale names nothing that the scene has for t to multiply"
                                 : "the scene has no load, given displacement, gap offset or temperature for t to "
                                   "multiply"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Raises the user error of a datum that the scene does not have. [in] data - [num], freed */
static PetscErrorCode DatumRaise_Private(Scene scene, const char option[], PetscInt num, Datum *data)
{
  const char **names, *near;
  PetscInt     n                      = 0;
  char         suggestion[OPTION_MAX] = "";

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(num, &names));
  for (PetscInt i = 0; i < num; i++)
    if (data[i].variable) names[n++] = ExpressionOption(*data[i].e);
  near = UserErrorNearest(option, n, names);
  if (near) PetscCall(PetscSNPrintf(suggestion, sizeof(suggestion), "; did you mean %s?", near));
  PetscCall(PetscFree(names));
  PetscCall(PetscFree(data));
  PetscCall(UserErrorRaise(scene->comm,
                           "%s: the scene has no load, temperature, given displacement or gap of this name%s", option,
                           suggestion));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The text of new components. [out] text - owned by the caller */
static PetscErrorCode DatumText_Private(Expression old, const PetscReal values[], PetscBool *free_any, char **text)
{
  enum { NUMBER = 32 };
  const PetscInt num    = ExpressionSize(old);
  size_t         length = 0, size = (size_t)num * NUMBER + 1;

  PetscFunctionBeginUser;
  *free_any = PETSC_FALSE;
  PetscCall(PetscMalloc1(size, text));
  for (PetscInt c = 0; c < num; c++) {
    const char *comma = c ? "," : "";

    if (ExpressionIsFree(old, c)) {
      length += (size_t)snprintf(*text + length, size - length, "%sfree", comma);
      *free_any = PETSC_TRUE;
    } else {
      length += (size_t)snprintf(*text + length, size - length, "%s%.17g", comma, (double)values[c]);
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether values can take the place of an expression. */
static PetscErrorCode DatumCheck_Private(Scene scene, Expression old, const char option[], PetscInt num,
                                         const PetscReal values[])
{
  PetscFunctionBeginUser;
  if (num != ExpressionSize(old)) {
    PetscCall(UserErrorRaise(scene->comm, "%s: %" PetscInt_FMT " numbers given, %" PetscInt_FMT " wanted", option, num,
                             ExpressionSize(old)));
  }
  for (PetscInt c = 0; c < num; c++) {
    if (!PetscIsInfOrNanReal(values[c]) || ExpressionIsFree(old, c)) continue;
    PetscCall(UserErrorRaise(scene->comm, "%s: component %" PetscInt_FMT " is not a finite number", option, c + 1));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Replaces one expression. */
static PetscErrorCode DatumReplace_Private(Scene scene, const PetscReal values[], Expression *place)
{
  Expression fresh;
  PetscBool  free_any;
  char      *text;

  PetscFunctionBeginUser;
  PetscCall(DatumText_Private(*place, values, &free_any, &text));
  PetscCall(ExpressionCreate(scene->comm, ExpressionOption(*place), text, ExpressionSize(*place), free_any, &fresh));
  PetscCall(PetscFree(text));
  PetscCall(ExpressionDestroy(place));
  *place = fresh;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A datum of a body may be that of its regions, too. */
PetscErrorCode SceneSetDatum(Scene scene, const char option[], PetscInt num, const PetscReal values[])
{
  PetscInt   num_data, found = 0;
  Expression first;
  Datum     *data;

  PetscFunctionBeginUser;
  PetscCall(DataList_Private(scene, &num_data, &data));
  for (PetscInt i = 0; i < num_data; i++) {
    if (!data[i].variable || strcasecmp(ExpressionOption(*data[i].e), option)) continue;
    data[found++] = data[i];
  }
  if (!found) PetscCall(DatumRaise_Private(scene, option, num_data, data));
  first = *data[0].e;
  PetscCall(DatumCheck_Private(scene, first, option, num, values));
  for (PetscInt i = 0; i < found; i++) {
    PetscCall(DatumReplace_Private(scene, values, data[i].e));
    scene->changed |= data[i].kind;
  }
  PetscCall(PetscFree(data));
  PetscFunctionReturn(PETSC_SUCCESS);
}

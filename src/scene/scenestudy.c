/* scenestudy.c -- the same scene on several meshes: how many, of which orders, and what they may cost. */
#include "scene/sceneparts.h"
#include <math.h>
#include <string.h>

enum { ADAPTIVE_LEVELS = 12 }; /* they grow by less than two */

static const PetscReal ADAPTIVE_MARKING = 0.5; /* that of -adapt_marking */

/* -study_orders: each a choice, ascending. */
static PetscErrorCode StudyReadOrders_Private(Scene scene, SceneStudy *study)
{
  Option      orders;
  const char *cursor = NULL;
  char        word[OPTION_MAX];
  PetscInt    values[STUDY_MAX_ORDERS], num;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-study_orders", NULL, NULL, &orders));
  if (!orders.set) PetscFunctionReturn(PETSC_SUCCESS);
  num = OptionCountItems(&orders);
  if (num > STUDY_MAX_ORDERS) {
    PetscCall(OptionRaise(&orders, "%" PetscInt_FMT " orders given, there are %d; write 1, 2 or 1,2", num,
                          (int)STUDY_MAX_ORDERS));
  }
  for (PetscInt i = 0; i < num; i++) {
    PetscCall(OptionNextItem(&orders, &cursor, word));
    if (strcmp(word, "1") != 0 && strcmp(word, "2") != 0)
      PetscCall(OptionRaise(&orders, "'%s' is not an order; write 1, 2 or 1,2", word));
    values[i] = word[0] - '0';
    if (i > 0 && values[i] <= values[i - 1])
      PetscCall(OptionRaise(&orders, "orders are named once each, the lower one first; write 1, 2 or 1,2"));
    study->orders[i] = values[i];
  }
  study->num_orders = num;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Options of a study are read only where there is one; else they are reported as unused. */
PetscErrorCode SceneStudyRead(Scene scene)
{
  SceneStudy *study = &scene->study;
  Option      kind, levels, memory;
  PetscInt    choice = 0;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-study", NULL, NULL, &kind));
  if (!kind.set) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(OptionGetChoice(&kind, &choice));
  study->kind   = choice ? STUDY_ADAPTIVE : STUDY_UNIFORM;
  study->memory = (PetscReal)INFINITY;
  PetscCall(OptionFind(scene, "-study_levels", NULL, NULL, &levels));
  PetscCall(OptionFind(scene, "-study_memory", NULL, NULL, &memory));
  PetscCall(OptionGetInts(&levels, 1, 1, &study->levels));
  PetscCall(OptionGetBytes(&memory, &study->memory));
  PetscCall(StudyReadOrders_Private(scene, study));
  if (study->kind == STUDY_ADAPTIVE) {
    if (study->num_orders > 1)
      PetscCall(OptionRaise(&kind, "each order has meshes of its own then; give one of -study_orders"));
    if (!levels.set) study->levels = ADAPTIVE_LEVELS;
    scene->adapt.on      = PETSC_TRUE;
    scene->adapt.marking = ADAPTIVE_MARKING;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SceneStudySetOrders(Scene scene)
{
  SceneStudy *study = &scene->study;

  PetscFunctionBeginUser;
  if (study->kind == STUDY_NONE || study->num_orders) PetscFunctionReturn(PETSC_SUCCESS);
  study->num_orders = 1;
  study->orders[0]  = scene->bodies[0].order;
  for (PetscInt i = 1; i < scene->num_bodies; i++) {
    if (scene->bodies[i].order != study->orders[0]) study->orders[0] = STUDY_OWN_ORDERS;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

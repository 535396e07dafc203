/* scenesteps.c -- load steps: the times of the solutions, and what time multiplies. */
#include "scene/sceneparts.h"
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { STEPS_MOST = 100000 }; /* more is a mistake, and would fill the disk */

/* One number without a point: so many equal steps up to t = 1. [out] count - 0 where it is no such number */
static void StepsGetCount_Private(const char text[], PetscInt *count)
{
  char      *end;
  const long number = strtol(text, &end, 10);

  *count = end != text && !*end ? (PetscInt)PetscMin(number, STEPS_MOST + 1) : 0;
}

/* -load_steps 10, or the values of t. */
static PetscErrorCode StepsReadTimes_Private(const Option *option, SceneSteps *steps)
{
  PetscInt count = 0;

  PetscFunctionBeginUser;
  steps->num = OptionCountItems(option);
  if (steps->num == 1) StepsGetCount_Private(option->text, &count);
  if (count < 0 || count > STEPS_MOST || steps->num > STEPS_MOST || (steps->num == 1 && !strcmp(option->text, "0")))
    PetscCall(OptionRaise(option, "must be a number of steps from 1 to %d, or a list of times such as 0.25,0.5,1",
                          (int)STEPS_MOST));
  if (count) {
    steps->num = count;
    PetscCall(PetscMalloc1(count, &steps->t));
    for (PetscInt i = 0; i < count; i++) steps->t[i] = (PetscReal)(i + 1) / (PetscReal)count;
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PetscMalloc1(steps->num, &steps->t));
  PetscCall(OptionGetReals(option, steps->num, steps->t));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* -load_steps_scale: a list of kinds, or none. The choices of the table are in the order of these bits. */
static PetscErrorCode StepsReadScale_Private(const Option *option, SceneSteps *steps)
{
  static const int kinds[] = {0, DATUM_LOAD, DATUM_DISPLACEMENT, DATUM_GAP, DATUM_TEMPERATURE};
  const char      *cursor  = NULL;
  char             word[OPTION_MAX];
  PetscInt         choice;

  PetscFunctionBeginUser;
  steps->scale_set = option->set;
  if (!option->set) PetscFunctionReturn(PETSC_SUCCESS);
  do {
    PetscCall(OptionNextItem(option, &cursor, word));
    PetscCall(OptionMatchChoice(option, word, "", &choice));
    if (choice == 0 && OptionCountItems(option) > 1)
      PetscCall(OptionRaise(option, "none stands alone; omit it, or omit the others"));
    steps->scale |= kinds[choice];
  } while (cursor);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SceneStepsRead(Scene scene)
{
  Option times, scale;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-load_steps", NULL, NULL, &times));
  PetscCall(OptionFind(scene, "-load_steps_scale", NULL, NULL, &scale));
  if (times.set) PetscCall(StepsReadTimes_Private(&times, &scene->steps));
  PetscCall(StepsReadScale_Private(&scale, &scene->steps));
  if (times.set && scene->study.kind != STUDY_NONE)
    PetscCall(OptionRaise(&times, "-study solves the scene on several meshes, at one time; give one of the two"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* scenesteps.c -- load steps: the times of the solutions, and what time multiplies. */
#include "scene/sceneparts.h"
#include "base/warning.h"
#include <stdlib.h>
#include <string.h>

enum { STEPS_MOST = 100000 }; /* more is a mistake, and would fill the disk */

/* One number without a point: so many equal steps up to t = 1. [out] count - 0 where it is no such number */
static void StepsGetCount_Private(const char text[], PetscInt *count)
{
  char      *end;
  const long number = strtol(text, &end, 10);

  *count = end != text && !*end ? (PetscInt)PetscMin(number, STEPS_MOST + 1) : 0;
}

/* Whether the items of a list are whole numbers without a sign, and the list of times with 0,5 read as 0.5.
   [out] meant - that list, with decimal points; "" where no item is 0; [out] increase - whether these times
   ascend from above 0 */
static PetscErrorCode StepsReadPoints_Private(const Option *option, PetscBool *whole, char meant[OPTION_MAX],
                                              PetscBool *increase)
{
  const char *cursor = NULL;
  char        word[OPTION_MAX], next[OPTION_MAX], time[2 * OPTION_MAX];
  PetscReal   last  = 0;
  size_t      used  = 0;
  PetscInt    zeros = 0;

  PetscFunctionBeginUser;
  *whole = *increase = PETSC_TRUE;
  meant[0]           = '\0';
  do {
    PetscBool zero;

    next[0] = '\0';
    PetscCall(OptionNextItem(option, &cursor, word));
    zero = (PetscBool)!strcmp(word, "0");
    if (zero && cursor) PetscCall(OptionNextItem(option, &cursor, next));
    *whole =
        (PetscBool)(*whole && strspn(word, "0123456789") == strlen(word) &&
                    strspn(next, "0123456789") == strlen(next) && used + strlen(word) + strlen(next) + 3 < OPTION_MAX);
    if (!*whole) PetscFunctionReturn(PETSC_SUCCESS);
    zeros += zero;
    used +=
        (size_t)snprintf(meant + used, OPTION_MAX - used, "%s%s%s%s", used ? "," : "", word, *next ? "." : "", next);
    (void)snprintf(time, sizeof(time), "%s.%s", word, next);
    if (!(strtod(time, NULL) > last)) *increase = PETSC_FALSE;
    last = strtod(time, NULL);
  } while (cursor);
  if (!zeros) meant[0] = '\0';
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Warns of decimal commas: 0,5 and 0,25,0,5,1 are unlikely times. Unloading, 1,0,1, and 0,2,4 are times. */
static PetscErrorCode StepsWarnComma_Private(const Option *option, const SceneSteps *steps)
{
  char      meant[OPTION_MAX];
  PetscBool whole, increase, ascends = PETSC_TRUE;

  PetscFunctionBeginUser;
  PetscCall(StepsReadPoints_Private(option, &whole, meant, &increase));
  if (!whole || !increase || !meant[0]) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt i = 1; i < steps->num; i++) ascends = (PetscBool)(ascends && steps->t[i] > steps->t[i - 1]);
  if (ascends && (steps->num > 2 || steps->t[steps->num - 1] == 1)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(WarningAdd(&(Warning){.code = "decimal_comma", .advice = "the decimal mark is a point, not a comma"},
                       "-load_steps %s asks for %" PetscInt_FMT
                       " solutions, the last one at t = %g, and not for t = %s",
                       option->text, steps->num, (double)steps->t[steps->num - 1], meant));
  PetscFunctionReturn(PETSC_SUCCESS);
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
  steps->counted = (PetscBool)(count > 0);
  if (count) {
    steps->num = count;
    PetscCall(PetscMalloc1(count, &steps->t));
    for (PetscInt i = 0; i < count; i++) steps->t[i] = (PetscReal)(i + 1) / (PetscReal)count;
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PetscMalloc1(steps->num, &steps->t));
  PetscCall(OptionGetReals(option, steps->num, steps->t));
  PetscCall(StepsWarnComma_Private(option, steps));
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

/* The file is read when there is a mesh. */
PetscErrorCode SceneRestartRead(Scene scene)
{
  Option option;
  char   own[PETSC_MAX_PATH_LEN];

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-restart", NULL, NULL, &option));
  PetscCall(OptionGetText(&option, &scene->steps.restart));
  if (!option.set) PetscFunctionReturn(PETSC_SUCCESS);
  if (!scene->steps.num) PetscCall(OptionRaise(&option, "only load steps go on from others; give -load_steps, too"));
  if (scene->adapt.on)
    PetscCall(OptionRaise(&option, "-adapt makes meshes that the file does not have; omit one of the two"));
  for (PetscInt b = 0; b < scene->num_bodies; b++)
    if (scene->bodies[b].pretension)
      PetscCall(OptionRaise(&option, "the strain of -%s_pretension is not in the file; solve all load steps in one run",
                            scene->bodies[b].name));
  if (!scene->output) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscSNPrintf(own, sizeof(own), "%s.h5", scene->output));
  if (!strcmp(own, scene->steps.restart))
    PetscCall(OptionRaise(&option, "-output %s would replace this file; give another name", scene->output));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SceneHalvedRead(Scene scene)
{
  Option option;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-load_steps_halved", NULL, NULL, &option));
  PetscCall(OptionGetBool(&option, &scene->steps.halved));
  if (!scene->steps.halved) PetscFunctionReturn(PETSC_SUCCESS);
  if (!scene->steps.num) PetscCall(OptionRaise(&option, "there are no steps to halve; give -load_steps, too"));
  if (!SceneHasFriction(scene))
    PetscCall(
        OptionRaise(&option, "without friction the answer of a step does not depend on the steps before; omit it"));
  if (scene->adapt.on)
    PetscCall(OptionRaise(&option, "the bars of -adapt are those of meshes, not of steps; omit one of the two"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

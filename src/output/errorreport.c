/* errorreport.c -- the estimated error of the result, and its error bars. */
#include "output/errorreport.h"
#include "base/compat.h"
#include "base/json.h"
#include "result/estimate.h"
#include <stdio.h>
#include <string.h>

enum { PART_TEXT = 48 };
static const PetscReal PERCENT = 100;
/* A larger relative error is not printed as a number: without loads it is roundoff over roundoff. */
static const PetscReal ANY_ERROR = 10;

/* "0.717% of the solution" */
static void ErrorReportPart_Private(PetscReal relative, char text[], size_t len)
{
  if (relative > ANY_ERROR)
    (void)snprintf(text, len, "larger than the solution");
  else
    (void)snprintf(text, len, "%.3g%% of the solution", (double)(PERCENT * relative));
}

PetscErrorCode ErrorReportAdd(const SummaryInput *in, cJSON *root)
{
  cJSON    *object, *potential;
  Estimate  estimate;
  PetscReal theta, error, relative;

  PetscFunctionBeginUser;
  cJSON_AddItemToObject(root, "bars", in->bars ? cJSON_Duplicate(in->bars, cJSON_True) : cJSON_CreateNull());
  if (in->estimate) {
    cJSON_AddItemToObject(root, "estimate", cJSON_Duplicate(in->estimate, cJSON_True));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  theta = error = relative = (PetscReal)NAN;
  if (in->fields && (!in->passing || in->fields->estimate)) {
    PetscCall(EstimateGet(in->fields, &estimate));
    theta    = estimate->standard;
    error    = EstimateGetError(estimate, theta);
    relative = EstimateGetRelative(estimate, theta);
  }
  object = cJSON_AddObjectToObject(root, "estimate");
  JSONAddReal(object, "energy_norm", error);
  JSONAddReal(object, "energy_norm_relative", relative);
  JSONAddReal(object, "calibration", theta);
  potential = cJSON_AddObjectToObject(object, "potential");
  JSONAddReal(potential, "value", (PetscReal)NAN);
  JSONAddReal(potential, "bar", (PetscReal)NAN);
  cJSON_AddArrayToObject(object, "meshes");
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ErrorReportPrint(const SummaryInput *in)
{
  const MPI_Comm comm = in->scene->comm;
  PetscReal      relative;
  int            meshes;
  char           part[PART_TEXT];
  Estimate       estimate;

  PetscFunctionBeginUser;
  if (in->estimate) {
    relative = JSONGetReal(in->estimate, "energy_norm_relative");
    meshes   = cJSON_GetArraySize(cJSON_GetObjectItemCaseSensitive(in->estimate, "meshes"));
    ErrorReportPart_Private(relative, part, sizeof(part));
    PetscCall(PetscPrintf(comm, "  estimated error: %s in the energy norm, %d mesh%s\n", part, meshes,
                          meshes == 1 ? ", which gives no error bars" : "es"));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(EstimateGet(in->fields, &estimate));
  relative = EstimateGetRelative(estimate, estimate->standard);
  ErrorReportPart_Private(relative, part, sizeof(part));
  PetscCall(PetscPrintf(
      comm, "  estimated error: %s in the energy norm; one mesh gives no error bars, -adapt and -study do\n", part));
  PetscFunctionReturn(PETSC_SUCCESS);
}

void ErrorReportPairBar(const SummaryInput *in, const char pair[], const char key[], char text[], size_t len)
{
  const cJSON    *pairs = cJSON_GetObjectItemCaseSensitive(in->bars, "pairs");
  const PetscReal bar   = JSONGetReal(cJSON_GetObjectItemCaseSensitive(pairs, pair), key);

  const cJSON *item, *unbounded = cJSON_GetObjectItemCaseSensitive(in->bars, "unbounded");

  text[0] = '\0';
  cJSON_ArrayForEach(item, unbounded)
  {
    if (!strcmp(item->valuestring, pair) && !strcmp(key, "max_pressure"))
      (void)snprintf(text, len, ", growing without limit,");
  }
  if (!PetscIsNanReal(bar)) (void)snprintf(text, len, " +- %.2g", (double)bar);
}

/* test_warning.c -- one list of warnings: what is kept, what a new run forgets, what is never said twice. */
#include "base/compat.h"
#include "base/warning.h"
#include <string.h>
#include <test.h>

static PetscMPIInt rank;

/* The number of entries of the list, of all warnings, and the text of the last entry. */
static PetscErrorCode Check(int listed, PetscInt counted, const char last[])
{
  cJSON   *list = WarningList();
  PetscInt num;

  PetscFunctionBeginUser;
  PetscCall(WarningNum(PETSC_COMM_WORLD, &num));
  CHECK(num == counted);
  CHECK(cJSON_GetArraySize(list) == (rank ? 0 : listed));
  if (!rank && listed) {
    const cJSON *item = cJSON_GetArrayItem(list, listed - 1);

    CHECK(!strcmp(cJSON_GetObjectItem(item, "text")->valuestring, last));
  }
  cJSON_Delete(list);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What an entry has to say, and what it leaves out. */
static PetscErrorCode TestEntry(void)
{
  const Warning full  = {.code = "gap_jump", .pair = "joint", .dim = 2, .at = {0.1, -2}, .advice = "refine"};
  const Warning plain = {.code = "unused_option"};
  const char   *first = "{\"code\":\"gap_jump\",\"text\":\"3 of joint\",\"pair\":\"joint\",\"at\":[0.1,-2],"
                        "\"advice\":\"refine\"}",
             *other   = "{\"code\":\"unused_option\",\"text\":\"100%\",\"at\":null,\"advice\":null}";
  char  *text;
  cJSON *list;

  PetscFunctionBeginUser;
  PetscCall(Check(0, 0, NULL));
  PetscCall(WarningAdd(&full, "%d of %s", 3, "joint"));
  PetscCall(WarningAdd(&plain, "%s", "100%"));
  PetscCall(Check(2, 2, "100%"));
  list = WarningList();
  text = cJSON_PrintUnformatted(list);
  CHECK(rank ? !strcmp(text, "[]") : strstr(text, first) && strstr(text, other));
  free(text);
  cJSON_Delete(list);
  WarningClear();
  PetscCall(Check(0, 0, NULL));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A run forgets the run before and a try before, and not what is of all runs; nothing is listed twice. */
static PetscErrorCode TestRuns(void)
{
  const Warning file = {.code = "hinged_parts", .body = "a"}, found = {.code = "marginal"};

  PetscFunctionBeginUser;
  PetscCall(WarningAdd(&file, "of the file"));
  WarningBeginRun();
  PetscCall(WarningAdd(&found, "of a try"));
  PetscCall(Check(2, 2, "of a try"));
  WarningBeginRun();
  PetscCall(Check(1, 1, "of the file"));
  PetscCall(WarningAdd(&found, "of the first run"));
  PetscCall(WarningAdd(&found, "of the first run"));
  PetscCall(WarningAdd(&file, "of the file"));
  PetscCall(Check(2, 2, "of the first run"));
  WarningEndRun();
  PetscCall(Check(2, 2, "of the first run")); // the summary may be written now
  PetscCall(WarningAdd(&file, "of another file"));
  PetscCall(Check(3, 3, "of the first run"));
  WarningBeginRun();
  PetscCall(Check(2, 3, "of another file")); // all runs are counted
  PetscCall(WarningAdd(&found, "of the first run"));
  PetscCall(Check(3, 4, "of the first run"));
  WarningEndRun();
  WarningClear();
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What is computed beside the answer is not spoken of, and the first rank speaks for all. */
static PetscErrorCode TestMuteAndRanks(void)
{
  PetscFunctionBeginUser;
  WarningMute();
  WarningMute();
  WarningUnmute();
  PetscCall(WarningAdd(&(Warning){.code = "marginal"}, "of a coarse level"));
  PetscCall(Check(0, 0, NULL));
  WarningUnmute();
  if (rank) PetscCall(WarningAdd(&(Warning){.code = "marginal"}, "of another rank"));
  PetscCall(Check(0, 0, NULL));
  if (!rank) PetscCall(WarningAdd(&(Warning){.code = "marginal"}, "of the first rank"));
  PetscCall(Check(1, 1, "of the first rank"));
  WarningClear();
  PetscFunctionReturn(PETSC_SUCCESS);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  PetscCall(TestEntry());
  PetscCall(TestRuns());
  PetscCall(TestMuteAndRanks());
  PetscCall(PetscFinalize());
  return 0;
}

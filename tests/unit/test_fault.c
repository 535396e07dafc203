/* test_fault.c -- one sentence, one code, on every rank. */
#include "base/compat.h"
#include "base/usererror.h"
#include <petscksp.h>
#include <string.h>
#include <test.h>

static void CheckNearest(const char misspelt[], const char expected[])
{
  static const char *const names[] = {"young", "poisson", "thickness", "top", "x"};
  const char              *nearest = UserErrorNearest(misspelt, 5, names);

  CHECK(expected ? nearest && !strcmp(nearest, expected) : !nearest);
}

static void TestNearest(void)
{
  CheckNearest("yuong", "young");
  CheckNearest("Poison", "poisson");
  CheckNearest("tihckness", "thickness");
  CheckNearest("to", "top");
  CheckNearest("bottom", NULL);
  CheckNearest("y", NULL); // another letter is another name
  CheckNearest("", NULL);
  CHECK(!UserErrorNearest("young", 0, NULL));
}

static void TestRaise(void)
{
  CHECK(UserErrorRaise(PETSC_COMM_WORLD, "-%s %d: expected by the test", "value", 3) == MORTISE_ERR_USER);
  CHECK(!strcmp(UserErrorSentence(), "-value 3: expected by the test"));
}

/* Of the ranks that complain the lowest is heard, by all; where none complains there is no fault. */
static void TestCheck(void)
{
  int  rank, size;
  char sentence[64], expected[64];

  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  snprintf(sentence, sizeof(sentence), "rank %d complains, expected by the test", rank);
  snprintf(expected, sizeof(expected), "rank %d complains, expected by the test", size / 2);
  CHECK(!UserErrorCheck(PETSC_COMM_WORLD, NULL));
  CHECK(!UserErrorCheck(PETSC_COMM_WORLD, ""));
  CHECK(UserErrorCheck(PETSC_COMM_WORLD, rank >= size / 2 ? sentence : NULL) == MORTISE_ERR_USER);
  CHECK(!strcmp(UserErrorSentence(), expected));
}

/* PETSc's complaints about what the user typed are faults; a mistake of the program stays PETSc's. */
static void TestOptions(void)
{
  PetscReal      value;
  PetscErrorCode error;
  KSP            ksp;

  CHECK(!PetscOptionsSetValue(NULL, "-a_number", "three"));
  CHECK(PetscOptionsGetReal(NULL, NULL, "-a_number", &value, NULL) == MORTISE_ERR_USER);
  CHECK(strstr(UserErrorSentence(), "three"));
  CHECK(!KSPCreate(PETSC_COMM_WORLD, &ksp));
  CHECK(KSPSetType(ksp, "nonsense") == MORTISE_ERR_USER);
  CHECK(strstr(UserErrorSentence(), "nonsense"));
  CHECK(!PetscPushErrorHandler(PetscReturnErrorHandler, NULL));
  error = KSPSetTolerances(ksp, -3, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT);
  CHECK(error && error != MORTISE_ERR_USER);
  CHECK(!PetscPopErrorHandler());
  CHECK(!KSPDestroy(&ksp));
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(UserErrorInitialize());
  TestNearest();
  TestRaise();
  TestCheck();
  TestOptions();
  PetscCall(PetscFinalize());
  return 0;
}

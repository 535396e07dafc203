/* fuzz_expression.c -- a number that varies in space, read and evaluated. */
#include "base/expression.h"
#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  static const PetscReal points[][3] = {{0, 0, 0}, {1, -2, 0.5}, {1e-300, 1e300, -1}};
  char                  *text        = FuzzText(data, size);
  Expression             e           = NULL;
  PetscReal             *values;

  if (!text) return 0;
  FuzzExpect(ExpressionCreate(PETSC_COMM_SELF, "-value", text, 0, PETSC_TRUE, &e));
  free(text);
  if (!e) return 0;
  values = calloc((size_t)ExpressionSize(e), sizeof(*values));
  for (PetscInt dim = 1; dim <= 3; ++dim) {
    for (size_t p = 0; p < sizeof(points) / sizeof(*points); ++p)
      FuzzExpect(ExpressionEvaluate(e, dim, points[p], values));
  }
  FuzzExpect(ExpressionCheck(PETSC_COMM_SELF, e));
  free(values);
  FuzzExpect(ExpressionDestroy(&e));
  return 0;
}

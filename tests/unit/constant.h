/* constant.h -- expressions of plain numbers, for scenes made in code. */
#ifndef CONSTANT_H
#define CONSTANT_H

#include "base/compat.h"
#include "base/expression.h"
#include <stdio.h>

/* [in] option - kept for messages; [in] values - [num_components]; [out] e - owned by the caller. Not collective. */
static inline PetscErrorCode ConstantCreate(const char option[], PetscInt num_components, const PetscReal values[],
                                            Expression *e)
{
  char   text[256] = "";
  size_t length    = 0;

  PetscFunctionBeginUser;
  for (PetscInt c = 0; c < num_components; c++)
    length += (size_t)snprintf(text + length, sizeof(text) - length, "%s%.17g", c ? "," : "", (double)values[c]);
  PetscCheck(length < sizeof(text), PETSC_COMM_SELF, PETSC_ERR_ARG_SIZ, "Too many numbers");
  PetscCall(ExpressionCreate(PETSC_COMM_SELF, option, text, num_components, PETSC_FALSE, e));
  PetscFunctionReturn(PETSC_SUCCESS);
}

#endif

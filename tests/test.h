/* test.h -- the few macros a unit test needs: one program per module, the first failed check ends it with exit code 1. */
#ifndef MORTISE_TEST_H
#define MORTISE_TEST_H

#include <petscsys.h>
#include <stdio.h>
#include <stdlib.h>

/* Whether sanitizers look on: they see the same on fewer and smaller meshes, in a tenth of the time. */
#ifdef __SANITIZE_ADDRESS__
enum { SANITIZED = 1 };
#else
enum { SANITIZED = 0 };
#endif

/* Ends the test unless the condition holds. */
#define CHECK(condition)                                                                                               \
  do {                                                                                                                 \
    if (!(condition)) {                                                                                                \
      fprintf(stderr, "%s:%d: CHECK(%s) failed\n", __FILE__, __LINE__, #condition);                                    \
      MPI_Abort(MPI_COMM_WORLD, 1);                                                                                    \
    }                                                                                                                  \
  } while (0)

/* Ends the test unless |actual - expected| <= tolerance (absolute); NaN fails. */
#define CHECK_NEAR(actual, expected, tolerance)                                                                        \
  do {                                                                                                                 \
    const double actual_ = (double)(actual), expected_ = (double)(expected);                                           \
    if (!(PetscAbsReal(actual_ - expected_) <= (tolerance))) {                                                         \
      fprintf(stderr, "%s:%d: %s = %.17g, expected %.17g, off by %.3g > %.3g\n", __FILE__, __LINE__, #actual, actual_, \
              expected_, actual_ - expected_, (double)(tolerance));                                                    \
      MPI_Abort(MPI_COMM_WORLD, 1);                                                                                    \
    }                                                                                                                  \
  } while (0)

#endif

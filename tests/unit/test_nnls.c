/* test_nnls.c -- nonnegative least squares: small problems with known answers, and what every answer has to fulfil. */
#include "kernel/nnls.h"
#include <test.h>

#include "uniform.h"

static const PetscReal EXACT = 1e-14;

/* Enters the most promising column until none has a price above tolerance. [in] columns - [n][m] */
static void Solve(NNLS *nnls, PetscInt n, const PetscReal columns[], PetscReal tolerance)
{
  for (;;) {
    PetscInt  best  = -1;
    PetscReal price = tolerance;

    for (PetscInt j = 0; j < n; j++) {
      const PetscReal own = NNLSPrice(nnls, &columns[j * nnls->m]);

      if (own > price) price = own, best = j;
    }
    if (best < 0 || !NNLSEnter(nnls, best, &columns[best * nnls->m])) return;
  }
}

/* Weight of a column, 0 where it carries none. */
static PetscReal Weight(const NNLS *nnls, PetscInt name)
{
  for (PetscInt j = 0; j < nnls->num; j++)
    if (nnls->name[j] == name) return nnls->weight[j];
  return 0;
}

/* A plank on supports at x = 0, 1, 2, 3, each of which pushes (1, x): forces and moments. */
static PetscErrorCode TestPlank(void)
{
  static const PetscReal supports[] = {1, 0, 1, 1, 1, 2, 1, 3};
  const PetscReal        inside[] = {2, 3}, edge[] = {2, 6}, beyond[] = {1, 4}, pulled[] = {-1, 0};
  NNLS                   nnls;

  PetscFunctionBeginUser;
  PetscCall(NNLSCreate(2, inside, &nnls));
  Solve(&nnls, 4, supports, EXACT);
  CHECK(nnls.num <= 2);
  CHECK_NEAR(PetscAbsReal(nnls.residual[0]) + PetscAbsReal(nnls.residual[1]), 0, EXACT);
  PetscCall(NNLSDestroy(&nnls));
  PetscCall(NNLSCreate(2, edge, &nnls)); // all of it on the last support
  Solve(&nnls, 4, supports, EXACT);
  CHECK(nnls.num == 1);
  CHECK_NEAR(Weight(&nnls, 3), 2, EXACT);
  PetscCall(NNLSDestroy(&nnls));
  PetscCall(NNLSCreate(2, beyond, &nnls)); // it turns about the last support: (-3, 1) / 10 times the moment there, 1
  Solve(&nnls, 4, supports, EXACT);
  CHECK(nnls.num == 1);
  CHECK_NEAR(Weight(&nnls, 3), 1.3, EXACT);
  CHECK_NEAR(nnls.residual[0], -0.3, EXACT);
  CHECK_NEAR(nnls.residual[1], 0.1, EXACT);
  PetscCall(NNLSDestroy(&nnls));
  PetscCall(NNLSCreate(2, pulled, &nnls)); // nothing resists, everything is left
  Solve(&nnls, 4, supports, EXACT);
  CHECK(nnls.num == 0 && nnls.residual[0] == -1 && nnls.residual[1] == 0);
  PetscCall(NNLSDestroy(&nnls));
  PetscFunctionReturn(0);
}

/* A column that helps at first and pushes the wrong way as soon as others are there has to leave. */
static PetscErrorCode TestLeaves(void)
{
  static const PetscReal columns[] = {1, 1, 1,
                                      0, 0, 1}; // (1, 1) has the best price for (2, 1 + 1/4), then (1, 0) enters
  const PetscReal        target[]  = {2, -0.25};
  NNLS                   nnls;

  PetscFunctionBeginUser;
  PetscCall(NNLSCreate(2, target, &nnls));
  CHECK(NNLSEnter(&nnls, 0, &columns[0]));
  CHECK_NEAR(Weight(&nnls, 0), 0.875, EXACT);
  CHECK(NNLSEnter(&nnls, 1, &columns[2]));
  CHECK(nnls.num == 1);
  CHECK_NEAR(Weight(&nnls, 1), 2, EXACT);
  CHECK_NEAR(nnls.residual[0], 0, EXACT);
  CHECK_NEAR(nnls.residual[1], -0.25, EXACT);
  CHECK(NNLSPrice(&nnls, &columns[0]) < 0 && NNLSPrice(&nnls, &columns[4]) < 0);
  PetscCall(NNLSDestroy(&nnls));
  PetscFunctionReturn(0);
}

/* Random columns, among them copies and multiples: r.c <= 0, r.c = 0 in use, y > 0, target = sum y c + r. */
static PetscErrorCode TestOptimality(void)
{
  enum { M = 12, N = 60 };
  static PetscReal columns[N * M];

  PetscFunctionBeginUser;
  for (PetscInt round = 0; round < 400; round++) {
    const PetscInt m = 1 + round % M, n = 1 + (7 * round) % N;
    PetscReal      target[M], sum[M], rounding = EXACT;
    NNLS           nnls;

    for (PetscInt i = 0; i < n * m; i++) columns[i] = Uniform(-1., 1.) + (round % 3 ? 0.5 : 0.);
    for (PetscInt i = 0; i < m && n > 4; i++) columns[2 * m + i] = columns[i], columns[3 * m + i] = 3 * columns[m + i];
    for (PetscInt i = 0; i < m; i++) target[i] = Uniform(-1., 1.);
    PetscCall(NNLSCreate(m, target, &nnls));
    Solve(&nnls, n, columns, EXACT);
    for (PetscInt j = 0; j < nnls.num; j++)
      rounding += EXACT * m * nnls.weight[j]; // of the sum that leaves the residual
    for (PetscInt j = 0; j < n; j++) CHECK(NNLSPrice(&nnls, &columns[j * m]) <= rounding);
    for (PetscInt i = 0; i < m; i++) sum[i] = nnls.residual[i];
    for (PetscInt j = 0; j < nnls.num; j++) {
      CHECK(nnls.weight[j] > 0);
      CHECK_NEAR(NNLSPrice(&nnls, &nnls.column[j * m]), 0, rounding);
      for (PetscInt i = 0; i < m; i++) sum[i] += nnls.weight[j] * columns[nnls.name[j] * m + i];
    }
    for (PetscInt i = 0; i < m; i++) CHECK_NEAR(sum[i], target[i], rounding);
    PetscCall(NNLSDestroy(&nnls));
  }
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(TestPlank());
  PetscCall(TestLeaves());
  PetscCall(TestOptimality());
  PetscCall(PetscFinalize());
  return 0;
}

/* test_pdas.c -- pdas against known answers and against trying every active set. */
#include "base/usererror.h"
#include "pdas/pdas.h"
#include "small_problem.h"

static void CheckSameHistory(const Run *a, const Run *b)
{
  CHECK(a->iterations == b->iterations && a->num_active == b->num_active);
  for (PetscInt k = 0; k < a->iterations; k++) CHECK(a->changed[k] == b->changed[k]);
}

/* One problem by both ways, by all ranks together and by each one alone, against trying everything. */
static PetscErrorCode CheckProblem(const Problem *p, const char start[], Run *run)
{
  PetscReal   best[MAX], scale = 0;
  PetscMPIInt size;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  CHECK(BruteForce(p, best) < 1e-9);
  for (PetscInt i = 0; i < p->n; i++) scale = PetscMax(scale, PetscAbsReal(best[i]));
  for (int way = 0; way<4; way += size> 1 ? 1 : 2) {
    Run other = RunDefault();

    other.comm   = way & 1 ? PETSC_COMM_SELF : PETSC_COMM_WORLD;
    other.reduce = (PetscBool)(way > 1);
    other.start  = start;
    PetscCall(Solve(p, &other));
    CHECK(other.reason > 0 && other.residual < 1e-12);
    CHECK(other.reduced == other.reduce);
    CHECK(other.changed[other.iterations - 1] == 0);
    CHECK(other.monitored == other.iterations + 1);
    for (PetscInt i = 0; i < p->n; i++) CHECK_NEAR(other.y[i], best[i], 1e-9 * scale);
    for (PetscInt i = 0; i < p->n; i++) CHECK(!other.active[i] || other.y[i] == p->upper[i]);
    if (way)
      CheckSameHistory(run, &other);
    else
      *run = other;
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode TestRandom(PetscInt num)
{
  PetscFunctionBeginUser;
  for (PetscInt seed = 0; seed < num; seed++) {
    Problem p;
    Run     run;

    PetscCall(RandomProblem(seed, &p));
    Extend(&p);
    PetscCall(CheckProblem(&p, seed % 2 ? "empty" : seed % 7 ? "gap" : "full", &run));
  }
  PetscFunctionReturn(0);
}

/* All of the first sixty thousand random problems on which the plain iteration runs in a circle. */
static PetscErrorCode TestCycling(PetscInt num)
{
  static const PetscInt seeds[] = {4187,  5164,  7334,  7652,  13349, 14246, 14338, 19346, 20291, 24757, 40271,
                                   40634, 48557, 50309, 51299, 51554, 53327, 53456, 53879, 54550, 58217};
  PetscInt              most    = 0;

  PetscFunctionBeginUser;
  for (PetscInt s = 0; s < PetscMin(num, (PetscInt)PETSC_STATIC_ARRAY_LENGTH(seeds)); s++) {
    Problem p;
    Run     run;

    PetscCall(RandomProblem(seeds[s], &p));
    Extend(&p);
    PetscCall(CheckProblem(&p, seeds[s] % 2 ? "empty" : seeds[s] % 7 ? "gap" : "full", &run));
    CHECK(run.safeguarded);
    most = PetscMax(most, run.iterations);
  }
  CHECK(most <= 20);
  PetscFunctionReturn(0);
}

/* The smallest known problem on which it does. */
static PetscErrorCode TestCycle(void)
{
  Problem p   = {.n = 3, .A = {21, 18, -9, 18, 18, -12, -9, -12, 13}, .b = {1, 5, -7}, .upper = {0, 0, 0}};
  Run     run = RunDefault();

  PetscFunctionBeginUser;
  PetscCall(Solve(&p, &run));
  CHECK(run.reason > 0 && run.safeguarded && !run.reduced);
  CHECK(run.changed[0] == 2 && run.changed[1] == 2 && run.changed[2] == 2); /* {} {2,3} {1,2} {} */
  CHECK(run.num_active == 1 && run.active[1]);
  CHECK_NEAR(run.y[0], -25. / 96, 1e-14);
  CHECK(run.y[1] == 0);
  CHECK_NEAR(run.y[2], -23. / 32, 1e-14);
  Extend(&p);
  PetscCall(CheckProblem(&p, "empty", &run));
  CHECK(run.safeguarded && run.num_active == 1 && run.active[2]);
  PetscFunctionReturn(0);
}

/* An exact tie, y_3 = upper_3 with no force: no roundoff may take it in and out. */
static PetscErrorCode TestTie(void)
{
  Problem p   = {.n = 3, .A = {2, -1, 3, -1, 1, 0, 3, 0, 10}, .b = {-1, 0, -3}, .upper = {0, 0, 0}};
  Run     run = RunDefault();

  PetscFunctionBeginUser;
  for (int extended = 0; extended < 2; extended++) {
    for (int full = 0; full < 2; full++) {
      run.reduce = (PetscBool)extended;
      run.start  = full ? "full" : "empty";
      PetscCall(Solve(&p, &run));
      CHECK(run.reason > 0 && !run.safeguarded && run.iterations <= 3);
      CHECK_NEAR(run.y[extended], -1, 1e-14);
      CHECK_NEAR(run.y[extended + 1], -1, 1e-14);
      CHECK_NEAR(run.y[extended + 2], 0, 1e-14);
    }
    Extend(&p);
  }
  PetscFunctionReturn(0);
}

/* The history does not know c. */
static PetscErrorCode TestConstant(PetscInt num)
{
  PetscFunctionBeginUser;
  for (PetscInt seed = 0; seed < num; seed++) {
    Problem p;
    Run     base = RunDefault();

    PetscCall(RandomProblem(seed, &p));
    Extend(&p);
    PetscCall(Solve(&p, &base));
    for (int way = 0; way < 6; way++) {
      Run run = RunDefault();

      run.c      = way % 3 == 0 ? 1e-10 : way % 3 == 1 ? 1e3 : 1e10;
      run.reduce = (PetscBool)(way > 2);
      PetscCall(Solve(&p, &run));
      CheckSameHistory(&base, &run);
    }
  }
  PetscFunctionReturn(0);
}

/* A given set is where it begins: the right one is confirmed at once. A bound that nothing reaches costs nothing. */
static PetscErrorCode TestStart(void)
{
  Problem   p;
  Run       run = RunDefault();
  PetscReal set[MAX];

  PetscFunctionBeginUser;
  PetscCall(RandomProblem(11, &p));
  PetscCall(Solve(&p, &run));
  CHECK(run.iterations > 1 && run.num_active > 0);
  for (PetscInt i = 0; i < p.n; i++) set[i] = run.active[i] ? 1 : 0;
  run.start    = "previous";
  run.previous = set;
  PetscCall(Solve(&p, &run));
  CHECK(run.iterations == 1 && run.changed[0] == 0);
  for (PetscInt i = 0; i < p.n; i++) p.upper[i] = 1e3;
  run = RunDefault();
  PetscCall(Solve(&p, &run));
  CHECK(run.iterations == 1 && run.num_active == 0);
  for (PetscInt i = 0; i < p.n; i++) p.upper[i] = -1e3; /* everything is pressed down */
  run.start = "full";
  PetscCall(Solve(&p, &run));
  CHECK(run.reason > 0);
  for (PetscInt i = 0; i < p.n; i++) p.upper[i] = PETSC_INFINITY;
  run.reduce = PETSC_TRUE;
  PetscCall(Solve(&p, &run));
  CHECK(run.reason > 0 && run.iterations == 1 && run.num_active == 0 && !run.reduced);
  PetscFunctionReturn(0);
}

/* PETSc's own method finds the same, where it converges. */
static PetscErrorCode TestOther(PetscInt num)
{
  PetscInt converged = 0;

  PetscFunctionBeginUser;
  for (PetscInt seed = 0; seed < num; seed++) {
    Problem   p;
    Run       run = RunDefault(), other = RunDefault();
    PetscReal scale = 0;

    PetscCall(RandomProblem(seed, &p));
    PetscCall(Solve(&p, &run));
    other.type = SNESVINEWTONRSLS;
    PetscCall(Solve(&p, &other));
    if (other.reason < 0) continue;
    converged++;
    for (PetscInt i = 0; i < p.n; i++) scale = PetscMax(scale, PetscAbsReal(run.y[i]));
    for (PetscInt i = 0; i < p.n; i++) CHECK_NEAR(run.y[i], other.y[i], 1e-6 * scale);
  }
  CHECK(converged >= num * 9 / 10);
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscMPIInt size;

  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(UserErrorInitialize());
  PetscCall(PDASRegister());
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  PetscCall(TestCycle());
  PetscCall(TestTie());
  PetscCall(TestStart());
  /* many small parallel factorizations take long: there, fewer of the same */
  PetscCall(TestConstant(size > 1 ? 2 : 10));
  PetscCall(TestCycling(size > 1 ? 4 : 21));
  PetscCall(TestRandom(size > 1 ? 20 : 120));
  PetscCall(TestOther(size > 1 ? 10 : 50));
  PetscCall(PetscFinalize());
  return 0;
}

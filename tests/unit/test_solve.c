/* test_solve.c -- SolverSolve() and SolverCrossCheck() on a membrane above a wire: every solver finds the same contact. */
#include "base/usererror.h"
#include "pdas/pdas.h"
#include <string.h>
#include "membrane.h"

/* SolveOnce() with options that are there for this call only. */
static PetscErrorCode SolveFrom(const char options[], VI vi, Vec guess, Vec y, SolverReport *report)
{
  PetscOptions own;
  char         before[16] = "", after[16] = "";

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsCreate(&own));
  PetscCall(PetscOptionsPush(own));
  PetscCall(PetscOptionsInsertString(own, options));
  PetscCall(PetscOptionsGetString(own, NULL, "-mat_mumps_icntl_14", before, sizeof(before), NULL));
  PetscCall(SolveOnce(vi, NULL, guess, y, report));
  PetscCall(PetscOptionsGetString(own, NULL, "-mat_mumps_icntl_14", after, sizeof(after), NULL));
  CHECK(!strcmp(before, after)); // however much room MUMPS was given in between
  PetscCall(PetscOptionsPop());
  PetscCall(PetscOptionsDestroy(&own));
  PetscFunctionReturn(0);
}

static PetscErrorCode SolveWith(const char options[], VI vi, Vec y, SolverReport *report)
{
  return SolveFrom(options, vi, NULL, y, report);
}

/* All ways lead to the same solution; the two of pdas through the same sets. */
static PetscErrorCode TestWays(void)
{
  static const char *const ways[] = {
    "-snes_pdas_reduce 0", /* first: must have the same history, too */
    "-snes_type vinewtonrsls",
    "-pc_type lu",
    "-mat_mumps_icntl_14 -95", /* too little room, so that it has to ask for more */
    "-mat_mumps_icntl_14 -95 -snes_pdas_reduce 0",
    "-mat_mumps_icntl_14 -95 -snes_type vinewtonrsls",
    "-ksp_type cg -pc_type gamg -snes_rtol 1e-12",
#if defined(PETSC_HAVE_HYPRE)
    "-pc_type hypre -snes_rtol 1e-12",
    "-snes_type vinewtonrsls -pc_type hypre -ksp_rtol 1e-12",
#endif
    "-pc_type jacobi -snes_rtol 1e-12",
    "-snes_pdas_start full",
    "-snes_pdas_start gap",
    "-snes_pdas_start previous"
  };
  Membrane     m;
  Vec          y, other;
  SolverReport base, report;
  PetscReal    max, difference;

  PetscFunctionBeginUser;
  PetscCall(MembraneCreate(1, 1, PETSC_TRUE, PETSC_TRUE, &m));
  PetscCall(VecDuplicate(m.vi.b, &y));
  PetscCall(VecDuplicate(m.vi.b, &other));
  PetscCall(SolveOnce(&m.vi, NULL, NULL, y, &base));
  PetscCall(VecNorm(y, NORM_INFINITY, &max));
  CHECK(base.converged && !base.reason[0] && base.active > 3 && base.linear_residual < 1e-13);
  CHECK(base.num_changed == base.iterations && base.changed[base.iterations - 1] == 0);
  for (size_t w = 0; w < PETSC_STATIC_ARRAY_LENGTH(ways); w++) {
    PetscCall(SolveWith(ways[w], &m.vi, other, &report));
    PetscCall(VecAXPY(other, -1, y));
    PetscCall(VecNorm(other, NORM_INFINITY, &difference));
    CHECK(report.converged && !report.reason[0]);
    CHECK(difference < 1e-11 * max);
    CHECK(report.active == base.active);
    if (w) continue;
    CHECK(report.num_changed == base.num_changed);
    for (PetscInt k = 0; k < base.num_changed; k++) CHECK(report.changed[k] == base.changed[k]);
  }
  PetscCall(VecDestroy(&y));
  PetscCall(VecDestroy(&other));
  PetscCall(MembraneDestroy(&m));
  PetscFunctionReturn(0);
}

/* The set, its history and the digits of the answer know nothing of units; nor of c, over twenty decades. */
static PetscErrorCode TestUnits(void)
{
  static const PetscReal   stiffnesses[] = {1, 1e-6, 1e9, 1e9}, lengths[] = {1, 1e3, 1e-6, 1e3};
  static const char *const ways[] = {"-snes_pdas_c 1", "-snes_pdas_c 1e-10", "-snes_pdas_c 1e10", "-snes_pdas_reduce 0",
                                     "-snes_pdas_reduce 0 -snes_pdas_c 1e10"};
  SolverReport             base   = {.converged = PETSC_FALSE}, report;
  PetscReal                max    = 0, own;

  PetscFunctionBeginUser;
  for (int u = 0; u < 4; u++) {
    for (int w = 0; w < 5; w++) {
      Membrane m;
      Vec      y;

      PetscCall(MembraneCreate(stiffnesses[u], lengths[u], PETSC_TRUE, PETSC_TRUE, &m));
      PetscCall(VecDuplicate(m.vi.b, &y));
      PetscCall(SolveWith(ways[w], &m.vi, y, &report));
      PetscCall(VecNorm(y, NORM_INFINITY, &own));
      if (!u && !w) {
        base = report;
        max  = own;
      }
      CHECK(report.converged && report.active == base.active && report.num_changed == base.num_changed);
      for (PetscInt k = 0; k < base.num_changed; k++) CHECK(report.changed[k] == base.changed[k]);
      CHECK_NEAR(own / lengths[u], max, 1e-13 * max);
      PetscCall(VecDestroy(&y));
      PetscCall(MembraneDestroy(&m));
    }
  }
  PetscFunctionReturn(0);
}

/* Agreement from either side, whatever solved the first; a wrong first solution does not agree. */
static PetscErrorCode TestCrossCheck(void)
{
  static const char *const ways[] = {"-snes_type pdas", "-snes_type vinewtonrsls", "-pc_type gamg -snes_rtol 1e-12"};
  Membrane                 m;
  SolverReport             report;
  CrossCheck               check;
  Solver                   solver;
  Vec                      y;

  PetscFunctionBeginUser;
  PetscCall(MembraneCreate(1, 1, PETSC_TRUE, PETSC_TRUE, &m));
  PetscCall(VecDuplicate(m.vi.b, &y));
  PetscCall(SolverCreate(&m.vi, NULL, &solver));
  for (int w = 0; w < 3; w++) {
    PetscCall(SolveWith(ways[w], &m.vi, y, &report));
    PetscCall(SolverCrossCheck(solver, y, &report, &check));
    CHECK(check.done && check.agree && !check.active_difference);
    CHECK(check.displacement_difference < 1e-11);
    CHECK(strcmp(check.other.type, report.type));
  }
  PetscCall(VecScale(y, 0.99));
  PetscCall(SolverCrossCheck(solver, y, &report, &check));
  CHECK(check.done && !check.agree && check.active_difference == report.active);
  CHECK_NEAR(check.displacement_difference, 0.01 / 0.99, 1e-12);
  PetscCall(SolverDestroy(&solver));
  PetscCall(VecDestroy(&y));
  PetscCall(MembraneDestroy(&m));
  PetscFunctionReturn(0);
}

/* No bounds are one linear solve; too few iterations and a free membrane are told, not raised. */
static PetscErrorCode TestEdges(void)
{
  Membrane     m;
  SolverReport report;
  Vec          y;

  PetscFunctionBeginUser;
  PetscCall(MembraneCreate(1, 1, PETSC_FALSE, PETSC_TRUE, &m));
  PetscCall(VecDuplicate(m.vi.b, &y));
  PetscCall(SolveOnce(&m.vi, NULL, NULL, y, &report));
  CHECK(report.converged && report.iterations == 1 && report.active == 0 && report.linear_residual < 1e-13);
  PetscCall(SolveWith("-snes_type vinewtonrsls", &m.vi, y, &report));
  CHECK(report.converged && report.active == 0);
  PetscCall(MembraneDestroy(&m));

  PetscCall(MembraneCreate(1, 1, PETSC_TRUE, PETSC_TRUE, &m));
  PetscCall(SolveWith("-snes_max_it 2", &m.vi, y, &report));
  CHECK(!report.converged && report.iterations == 2 && strstr(report.reason, "-snes_max_it"));
  PetscCall(SolveWith("-snes_max_it 2 -snes_pdas_reduce 0", &m.vi, y, &report));
  CHECK(!report.converged && report.iterations == 2 && strstr(report.reason, "-snes_max_it"));
  PetscCall(SolveWith("-snes_type vinewtonrsls -snes_max_it 2", &m.vi, y, &report));
  CHECK(!report.converged && report.iterations == 2 && strstr(report.reason, "-snes_max_it"));
  PetscCall(SolveWith("-pc_type jacobi -ksp_max_it 3", &m.vi, y, &report));
  CHECK(!report.converged && strstr(report.reason, "-ksp_max_it"));
  PetscCall(MembraneDestroy(&m));

  for (int bounded = 0; bounded < 2; bounded++) { /* what nothing holds has no solution, unless a wire stops it */
    PetscCall(MembraneCreate(1, 1, (PetscBool)bounded, PETSC_FALSE, &m));
    PetscCall(SolveOnce(&m.vi, NULL, NULL, y, &report));
    CHECK(bounded ? report.converged : !report.converged && strstr(report.reason, "singular"));
    PetscCall(SolveWith("-snes_pdas_reduce 0", &m.vi, y, &report));
    CHECK(bounded ? report.converged : !report.converged && strstr(report.reason, "singular"));
    PetscCall(SolveWith("-snes_pdas_start empty", &m.vi, y, &report));
    CHECK(!report.converged && strstr(report.reason, "singular"));
    PetscCall(MembraneDestroy(&m));
  }
  PetscCall(VecDestroy(&y));
  PetscFunctionReturn(0);
}

/* A displacement to begin with changes the work: the solution itself takes one step. It never changes the answer, however wrong
   it is; where contact alone holds a body it is not used. */
static PetscErrorCode TestGuess(void)
{
  const PetscReal wrong[] = {1e6, -1e6, 1e-3};
  Membrane        m;
  SolverReport    cold, report;
  Vec             y, guess, other;
  PetscReal       max, difference;

  PetscFunctionBeginUser;
  PetscCall(MembraneCreate(1, 1, PETSC_TRUE, PETSC_TRUE, &m));
  m.vi.length = 0.25; // u = length y
  PetscCall(VecDuplicate(m.vi.b, &y));
  PetscCall(VecDuplicate(m.vi.b, &guess));
  PetscCall(VecDuplicate(m.vi.b, &other));
  PetscCall(SolveOnce(&m.vi, NULL, NULL, y, &cold));
  PetscCall(VecNorm(y, NORM_INFINITY, &max));
  PetscCall(VecCopy(y, guess));
  PetscCall(VecScale(guess, m.vi.length));
  PetscCall(SolveOnce(&m.vi, NULL, guess, other, &report));
  CHECK(cold.iterations > 2 && report.converged && report.iterations == 1 && report.active == cold.active);
  for (int w = 0; w < 6; w++) {
    PetscCall(VecSet(guess, wrong[w % 3]));
    if (w < 3)
      PetscCall(SolveOnce(&m.vi, NULL, guess, other, &report));
    else
      PetscCall(SolveFrom("-snes_type vinewtonrsls", &m.vi, guess, other, &report));
    PetscCall(VecAXPY(other, -1, y));
    PetscCall(VecNorm(other, NORM_INFINITY, &difference));
    CHECK(report.converged && report.active == cold.active);
    CHECK_NEAR(difference, 0, 1e-11 * max);
  }
  PetscCall(SolveFrom("-snes_pdas_start full", &m.vi, guess, other, &report));
  PetscCall(SolveFrom("-snes_pdas_start full", &m.vi, NULL, y, &cold));
  CHECK(report.iterations == cold.iterations); // the user's own start wins
  PetscCall(VecDestroy(&y));
  PetscCall(VecDestroy(&guess));
  PetscCall(VecDestroy(&other));
  PetscCall(MembraneDestroy(&m));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(UserErrorInitialize());
  PetscCall(PDASRegister());
  PetscCall(TestWays());
  PetscCall(TestUnits());
  PetscCall(TestCrossCheck());
  PetscCall(TestEdges());
  PetscCall(TestGuess());
  PetscCall(PetscFinalize());
  return 0;
}

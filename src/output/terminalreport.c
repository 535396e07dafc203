/* terminalreport.c -- the result on the terminal, and the destination of the summary. */
#include <stdlib.h>
#include <string.h>
#include "output/summary.h"
#include "output/output.h"
#include "output/setupreport.h"
#include "base/log.h"
#include "base/compat.h"
#include "output/patchsummary.h"
#include "result/frictionfields.h"
#include "result/pairsum.h"
#include "checks/solvabilityreport.h"
#include "output/errorreport.h"
#include "output/numberwords.h"

static const PetscReal PERCENT = 100;

/* "force (1, -2) +- 3", with the bar of the normal force. Around a ring the radial parts of a force cancel:
   there the line has the normal and the axial force. */
static PetscErrorCode SummaryPrintForce_Private(const SummaryInput *in, const ScenePair *spec, const PairSum *sum,
                                                char text[], size_t len)
{
  char force[128], bar[32];

  PetscFunctionBeginUser;
  ErrorReportPairBar(in, spec->name, "normal_force", bar, sizeof(bar));
  PetscCall(NumberWordsVector(in->scene->dim, sum->force, force, sizeof(force)));
  if (in->scene->model == MODEL_AXISYMMETRIC && spec->type == PAIR_CONTACT) {
    PetscCall(PetscSNPrintf(text, len, "normal force %.6g%s, mean pressure %.6g, axial force %.6g",
                            (double)sum->normal_force, bar, (double)(sum->area > 0 ? sum->normal_force / sum->area : 0),
                            (double)sum->force[1]));
  } else {
    PetscCall(PetscSNPrintf(text, len, "force %s%s", force, bar));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* "friction (0, 20), 40 % of the area slips by up to 1e-5" */
static PetscErrorCode SummaryPrintFriction_Private(const SummaryInput *in, PetscInt p)
{
  FrictionSum sum;
  char        force[128];

  PetscFunctionBeginUser;
  if (!ScenePairHasFriction(in->vi->pairs[p]->spec)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(FrictionSumCompute(in->fields, p, &sum));
  PetscCall(NumberWordsVector(in->scene->dim, sum.force, force, sizeof(force)));
  PetscCall(PetscPrintf(in->scene->comm, "    friction %s, ", force));
  if (sum.slip_share > 0)
    PetscCall(PetscPrintf(in->scene->comm, "%.3g%% of the area slips, by at most %.4g\n", 100 * (double)sum.slip_share,
                          (double)sum.max_slip));
  else
    PetscCall(PetscPrintf(in->scene->comm, "all nodes in contact stick\n"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* One pair, in one or two lines. */
static PetscErrorCode SummaryPrintPair_Private(const SummaryInput *in, PetscInt p)
{
  const MPI_Comm   comm = in->scene->comm;
  const ScenePair *spec = in->vi->pairs[p]->spec;
  PairSum          sum;
  char             force[192], at[128], bar[2][32];

  PetscFunctionBeginUser;
  if (!in->vi->pairs[p]->num_multipliers) PetscFunctionReturn(PETSC_SUCCESS); // a warning has the reason
  ErrorReportPairBar(in, spec->name, "max_pressure", bar[0], sizeof(bar[0]));
  ErrorReportPairBar(in, spec->name, "area", bar[1], sizeof(bar[1]));
  PetscCall(PairSumCompute(in->fields, p, &sum));
  PetscCall(SummaryPrintForce_Private(in, spec, &sum, force, sizeof(force)));
  PetscCall(PetscPrintf(comm, "  %s: %" PetscInt_FMT " of %" PetscInt_FMT " nodes %s, %s on %s\n", spec->name,
                        sum.active, in->vi->pairs[p]->num_multipliers, spec->type == PAIR_TIED ? "tied" : "in contact",
                        force, in->scene->bodies[spec->nonmortar.body].name));
  if (sum.active && spec->type == PAIR_CONTACT) {
    PetscCall(NumberWordsVector(in->scene->dim, sum.max_pressure_at, at, sizeof(at)));
    PetscCall(PetscPrintf(comm, "    largest pressure %.6g%s at %s, ", (double)sum.max_pressure, bar[0], at));
    if (sum.max_covered < sum.max_pressure)
      PetscCall(PetscPrintf(comm, "where the partner ends, %.6g elsewhere, ", (double)sum.max_covered));
    PetscCall(PetscPrintf(comm, "area %.6g%s\n", (double)sum.area, bar[1]));
    PetscCall(SummaryPrintFriction_Private(in, p));
    PetscCall(PatchSummaryPrint(in->fields, p));
  }
  if (in->inf_sup && !PetscIsNanReal(in->inf_sup[p].number)) {
    PetscCall(PetscPrintf(comm, "    inf-sup number %.4g", (double)in->inf_sup[p].number));
    if (!PetscIsNanReal(in->inf_sup[p].condition))
      PetscCall(PetscPrintf(comm, ", condition of the Schur complement %.3g", (double)in->inf_sup[p].condition));
    PetscCall(PetscPrintf(comm, "\n"));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Names of the files that were written. */
static PetscErrorCode SummaryPrintFiles_Private(const SummaryInput *in)
{
  const MPI_Comm comm  = in->scene->comm;
  const Scene    scene = in->scene;

  PetscFunctionBeginUser;
  if (scene->output) {
    PetscCall(PetscPrintf(comm, "  wrote %s.json", scene->output));
    PetscCall(OutputPrintNames(scene, in->fields ? PETSC_TRUE : PETSC_FALSE));
    PetscCall(PetscPrintf(comm, "\n"));
  }
  if (scene->summary) PetscCall(PetscPrintf(comm, "  wrote %s\n", scene->summary));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* "  error of upper: energy 1.3e-03 (0.84%), L2 3.4e-06 (0.01%)"; nothing where nothing is known. */
static PetscErrorCode SummaryPrintError_Private(MPI_Comm comm, const char what[], const char first[],
                                                const PetscReal first_error[2], const char second[],
                                                const PetscReal second_error[2])
{
  const struct {
    const char      *norm;
    const PetscReal *error; /* absolute, relative */
  } parts[] = {{first, first_error}, {second, second_error}};

  PetscFunctionBeginUser;
  if (PetscIsNanReal(first_error[0])) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscPrintf(comm, "  error of %s:", what));
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(parts); i++) {
    PetscCall(PetscPrintf(comm, "%s %s %.4e", i ? "," : "", parts[i].norm, (double)parts[i].error[0]));
    if (!PetscIsNanReal(parts[i].error[1]))
      PetscCall(PetscPrintf(comm, " (%.3g%%)", (double)(PERCENT * parts[i].error[1])));
  }
  PetscCall(PetscPrintf(comm, "\n"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* One line for each body and each pair with an exact solution. */
static PetscErrorCode SummaryPrintErrors_Private(const SummaryInput *in)
{
  const MPI_Comm comm = in->scene->comm;
  char           what[PETSC_MAX_PATH_LEN];

  PetscFunctionBeginUser;
  if (!in->errors->any) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt b = 0; b < in->scene->num_bodies; b++) {
    const BodyError *e        = &in->errors->body[b];
    const PetscReal  energy[] = {e->energy, e->energy_relative}, l2[] = {e->l2, e->l2_relative};

    PetscCall(SummaryPrintError_Private(comm, in->scene->bodies[b].name, "energy", energy, "L2", l2));
  }
  for (PetscInt p = 0; p < in->vi->num_pairs; p++) {
    const PressureError *e    = &in->errors->pair[p];
    const PetscReal      l2[] = {e->l2, e->l2_relative}, weighted[] = {e->weighted, e->weighted_relative};

    PetscCall(PetscSNPrintf(what, sizeof(what), "the pressure of %s", in->vi->pairs[p]->spec->name));
    PetscCall(SummaryPrintError_Private(comm, what, "L2", l2, "at nodes", weighted));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Work of all levels, and the cost of one linear solve. */
static PetscErrorCode SummaryPrintCost_Private(const SummaryInput *in)
{
  const SolverReport *report = in->report;

  PetscFunctionBeginUser;
  if (report->work > 0) {
    PetscCall(PetscPrintf(in->scene->comm,
                          "  cost: %.0f products with the matrix, %" PetscInt_FMT " linear iterations\n",
                          (double)report->work, report->linear_iterations));
  }
  if (report->reference.done) {
    PetscCall(PetscPrintf(in->scene->comm,
                          "  one linear solve with the final active set: %.3g s, %" PetscInt_FMT
                          " iterations; whole solve: %.3g s\n",
                          (double)report->reference.seconds, report->reference.iterations, report->seconds));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode SummaryPrintResults_Private(const SummaryInput *in)
{
  const MPI_Comm      comm   = in->scene->comm;
  const SolverReport *report = in->report;
  const Certificate  *c      = in->certificate;

  PetscFunctionBeginUser;
  if (in->scene->title[0]) PetscCall(PetscPrintf(comm, "%s\n", in->scene->title));
  PetscCall(PetscPrintf(comm, "  %s: %" PetscInt_FMT " unknowns, %" PetscInt_FMT " iteration%s of %s, %.3g s\n",
                        in->solved ? "solved" : "NOT SOLVED", in->vi->level->num_global * in->vi->level->dim,
                        report->iterations, report->iterations == 1 ? "" : "s", report->type, LogTotalSeconds()));
  PetscCall(SummaryPrintCost_Private(in));
  for (PetscInt b = 0; b < in->scene->num_bodies; b++) {
    const PetscInt pieces = ComponentsOfBody(&in->vi->rigid_modes.components, b);

    if (pieces > 1)
      PetscCall(PetscPrintf(comm, "  body %s is in %" PetscInt_FMT " pieces\n", in->scene->bodies[b].name, pieces));
  }
  for (PetscInt p = 0; p < in->vi->num_pairs; p++) PetscCall(SummaryPrintPair_Private(in, p));
  PetscCall(ErrorReportPrint(in));
  PetscCall(SolvabilityReportPrint(in->vi, in->solvability));
  PetscCall(SummaryPrintErrors_Private(in));
  PetscCall(PetscPrintf(comm,
                        "  certificate: equilibrium %.1e, gap %.1e, pressure %.1e, complementarity %.1e, forces %.1e, "
                        "moments %.1e\n",
                        (double)c->equilibrium, (double)c->gap, (double)c->pressure, (double)c->complementarity,
                        (double)c->force, (double)c->moment));
  if (!PetscIsInfOrNanReal(CertificateRelative(c, report->bound.value))) {
    PetscCall(PetscPrintf(comm, "  solver error: at most %.1e of the solution, in the energy norm%s\n",
                          (double)CertificateRelative(c, report->bound.value),
                          report->bound.estimated ? " (estimated)" : ""));
  }
  if (isgreater(report->discretisation, 0)) {
    PetscCall(PetscPrintf(comm,
                          "  stopped at the discretisation error: about %.1e of the solution, in the energy norm, "
                          "estimated from coarser meshes\n",
                          (double)CertificateRelative(c, report->discretisation)));
  }
  if (in->check->done && in->check->other.converged) {
    PetscCall(PetscPrintf(
        comm, "  cross-check by %s, %s: active sets differ in %" PetscInt_FMT " nodes, displacements by %.1e\n",
        in->check->other.type, in->check->other.linear, in->check->active_difference,
        (double)in->check->displacement_difference));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Why it is not solved, on stderr: one sentence each. */
static PetscErrorCode SummaryPrintFailures_Private(const SummaryInput *in)
{
  const MPI_Comm comm = in->scene->comm;

  PetscFunctionBeginUser;
  if (!in->report->converged)
    PetscCall(PetscFPrintf(comm, PETSC_STDERR, "mortise: not solved: %s\n", in->report->reason));
  /* Omits the advice of a certificate, its part behind the semicolon, if there is no solution. */
  if (!in->certificate->holds) {
    const char *failure = in->certificate->failure;
    const int   shown   = (int)(in->report->converged ? strlen(failure) : strcspn(failure, ";"));

    PetscCall(PetscFPrintf(comm, PETSC_STDERR, "mortise: %.*s\n", shown, failure));
  }
  if (in->check->done && in->check->other.converged && !in->check->agree) {
    PetscCall(PetscFPrintf(comm, PETSC_STDERR,
                           "mortise: %s and %s disagree: active sets differ in %" PetscInt_FMT
                           " nodes, displacements by %.1e\n",
                           in->report->type, in->check->other.type, in->check->active_difference,
                           (double)in->check->displacement_difference));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Why it is not solved, on stderr; nothing where it is. */
static PetscErrorCode SummaryPrintRefusal_Private(const SummaryInput *in)
{
  PetscFunctionBeginUser;
  if (in->setup) PetscFunctionReturn(PETSC_SUCCESS); // nothing was to be solved
  PetscCall(SolvabilityReportRefuse(in->vi, in->solvability));
  if (in->fields && !in->solved) PetscCall(SummaryPrintFailures_Private(in));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SummaryPrint(const SummaryInput *input)
{
  PetscFunctionBeginUser;
  if (input->fields) PetscCall(SummaryPrintResults_Private(input));
  if (input->setup) PetscCall(SetupReportPrint(input->vi, input->solvability, input->setup));
  PetscCall(SummaryPrintRefusal_Private(input));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SummaryPrintEnd(const SummaryInput *input, PetscBool quiet)
{
  PetscFunctionBeginUser;
  if (!quiet) {
    if (input->fields) PetscCall(SummaryPrintResults_Private(input));
    if (input->setup) PetscCall(SetupReportPrint(input->vi, input->solvability, input->setup));
    PetscCall(SummaryPrintFiles_Private(input));
  }
  PetscCall(SummaryPrintRefusal_Private(input));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SummaryWrite(const SummaryInput *input, Output *output)
{
  const Scene     scene         = input->scene;
  const PetscBool stdout_wanted = (PetscBool)(scene->summary && strcmp(scene->summary, "-") == 0);
  char           *text, path[PETSC_MAX_PATH_LEN];

  PetscFunctionBeginUser;
  PetscCall(SummaryCreate(input, &text));
  if (scene->summary && !stdout_wanted) PetscCall(OutputAddText(*output, scene->summary, text));
  if (scene->output) {
    PetscCall(PetscSNPrintf(path, sizeof(path), "%s.json", scene->output));
    PetscCall(OutputAddText(*output, path, text)); // the last: where it is, the result is complete
  }
  PetscCall(OutputFinish(output));
  if (stdout_wanted && text) puts(text);
  free(text);
  /* not beside a summary on stdout: that is for programs to read */
  PetscCall(SummaryPrintEnd(input, (PetscBool)(scene->quiet || stdout_wanted)));
  PetscFunctionReturn(PETSC_SUCCESS);
}

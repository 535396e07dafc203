/* resultwarnings.c -- warnings about a result. */
#include <string.h>
#include "base/compat.h"
#include "output/summary.h"
#include "base/warning.h"
#include "checks/coarsecontact.h"
#include "result/estimate.h"
#include "result/frictionfields.h"
#include "checks/gapdiscontinuity.h"
#include "result/pairsum.h"
#include "result/sideerrors.h"
#include "checks/solvabilityreport.h"
#include "checks/unevenpressure.h"
#include "checks/validity.h"
#include "output/numberwords.h"
#include "output/setupwarnings.h"

/* A solver that stops at a discretisation error above this part of the solution gives useless numbers. */
static const PetscReal COARSE = 0.1;
/* A result is useless if its estimated error is this part of the solution. Strain energies below STRAINED are
   roundoff, as of a rigid motion, in units of the squared displacements times the diagonal of K. */
static const PetscReal AS_LARGE = 1, STRAINED = 1e-12;
/* An initial overlap above this part of the displacements is an interference. The deviation of facets from
   their curves matters above this part of the overlap. */
static const PetscReal OVERLAP_SHOWS = 0.1, CURVE_SHOWS = 0.1;
/* The pressure where a partner ends matters if it is above the largest pressure elsewhere by more than this
   part. */
static const PetscReal EDGE_SHOWS = 0.1;
/* A tie across a gap acts as rigid links, intended between shells, else a sign of a body in the wrong
   position. Longest links without a warning, as a part of the extent of the tied side. */
static const PetscReal TIED_FAR = 0.05;
/* Gaps and overlaps below this part of the reach are rounding of positions. */
static const PetscReal ROUNDING = 1e-12;

/* Errors of pressures that the shape of sides leaves are told above this part of the mean pressure. */
static const PetscReal ERRORS_SHOW = 0.1;

/* Warns of tied sides that are apart, or overlap. Collective. */
static PetscErrorCode SummaryWarnTiedGap_Private(const SummaryInput *in, PetscInt p)
{
  const Pair       pair = in->vi->pairs[p];
  const ScenePair *spec = pair->spec;
  const PetscInt   dim  = in->scene->dim;
  PetscReal        most[7], extent = 0; // the longest link; the largest components of x and of -x
  Warning          wide = {.code = "tied_gap",
                           .pair = spec->name,
                           .advice =
                      in->scene->adapt.on
                                   ? "check the positions of the bodies; if the links are intended, errors fall slowly, because "
                                     "the links exert concentrated forces at the ends of the tie"
                                   : "check the positions of the bodies, unless the links are intended"};

  PetscFunctionBeginUser;
  if (spec->type != PAIR_TIED || spec->gap || spec->gap_offset) PetscFunctionReturn(PETSC_SUCCESS);
  most[0] = 0;
  for (PetscInt i = 1; i < 7; i++) most[i] = -PETSC_MAX_REAL;
  for (PetscInt a = 0; a < pair->num; a++) {
    const PetscReal *x = &pair->level->coords[pair->nodes[a] * dim];

    most[0] = PetscMax(most[0], PetscAbsReal(pair->gap[a]) / pair->share[a]);
    for (PetscInt k = 0; k < dim; k++) {
      most[1 + k] = PetscMax(most[1 + k], x[k]);
      most[4 + k] = PetscMax(most[4 + k], -x[k]);
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, most, 7, MPIU_REAL, MPIU_MAX, pair->level->comm));
  for (PetscInt k = 0; k < dim && most[1] > -PETSC_MAX_REAL; k++) extent += PetscSqr(most[1 + k] + most[4 + k]);
  if (most[0] <= TIED_FAR * PetscSqrtReal(extent)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(WarningAdd(&wide, "the tied sides of %s are up to %.3g apart, and are joined as by rigid links", spec->name,
                       (double)most[0]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Warns of a gap that jumps or bends within a facet, if that changes the pressure visibly. Collective. */
static PetscErrorCode SummaryWarnGapDiscontinuity_Private(const SummaryInput *in, PetscInt p)
{
  const ScenePair *spec = in->vi->pairs[p]->spec;
  PetscBool        shows;
  PetscReal        overlap;
  Warning          jump = {.code = "gap_jump", .pair = spec->name, .dim = in->scene->dim};
  char             text[128];

  PetscFunctionBeginUser;
  PetscCall(GapDiscontinuityFind(in->fields, p, &shows, &overlap, jump.at));
  if (!shows) PetscFunctionReturn(PETSC_SUCCESS);
  jump.advice = spec->mortar.body < 0
                    ? "align facets with that place"
                    : "align facets with that place, list only sides that meet, or exchange nonmortar and mortar side";
  PetscCall(NumberWordsVector(jump.dim, jump.at, text, sizeof(text)));
  PetscCall(WarningAdd(&jump,
                       "the pressure of %s is unreliable near %s: the gap jumps or bends within a facet, and its mean "
                       "acts as an additional overlap of %.3g",
                       spec->name, text, (double)overlap));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Warns of a largest pressure at a node whose facets the partner covers in part: there it may be unbounded.
   Collective. */
static PetscErrorCode SummaryWarnEdgePressure_Private(const SummaryInput *in, PetscInt p)
{
  const ScenePair *spec = in->vi->pairs[p]->spec;
  Warning          edge = {.code   = "edge_pressure",
                           .pair   = spec->name,
                           .dim    = in->scene->dim,
                           .advice = "use the force, or the pressure elsewhere; or round the edge of the partner"};
  char             at[128], elsewhere[64] = "";
  PairSum          sum;

  PetscFunctionBeginUser;
  if (spec->type != PAIR_CONTACT || !in->vi->pairs[p]->num_multipliers) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PairSumCompute(in->fields, p, &sum));
  if (!sum.active || sum.max_pressure <= (1 + EDGE_SHOWS) * sum.max_covered) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscArraycpy(edge.at, sum.max_pressure_at, 3));
  PetscCall(NumberWordsVector(edge.dim, edge.at, at, sizeof(at)));
  if (sum.max_covered > 0)
    (void)snprintf(elsewhere, sizeof(elsewhere), "; elsewhere it is %.4g", (double)sum.max_covered);
  PetscCall(WarningAdd(&edge,
                       "the largest pressure of %s, %.4g near %s, is where the partner ends, and may grow with every "
                       "refinement%s",
                       spec->name, (double)sum.max_pressure, at, elsewhere));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Warns of a largest pressure that follows the facets of the mortar side. Collective.
   [out] told - whether it does */
static PetscErrorCode SummaryWarnUnevenPressure_Private(const SummaryInput *in, PetscInt p, PetscBool *told)
{
  const ScenePair *spec   = in->vi->pairs[p]->spec;
  Warning          uneven = {.code = "uneven_pressure", .pair = spec->name, .dim = in->scene->dim};
  char             at[128], advice[256];
  UnevenPressure   found;

  PetscFunctionBeginUser;
  PetscCall(UnevenPressureFind(in->fields, p, &found));
  *told = found.shows;
  if (!found.shows) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscArraycpy(uneven.at, found.at, 3));
  PetscCall(NumberWordsVector(uneven.dim, uneven.at, at, sizeof(at)));
  (void)snprintf(advice, sizeof(advice), "exchange nonmortar and mortar side, or refine %s:%s",
                 in->scene->bodies[spec->mortar.body].name, spec->mortar.side);
  uneven.advice = advice;
  PetscCall(
      WarningAdd(&uneven,
                 "the largest pressure of %s, %.4g near %s, is %.3g times the mean around it: facets of the softer "
                 "mortar side are %.2g times as long, and the pressure follows them",
                 spec->name, (double)found.largest, at, (double)(found.largest / found.mean), (double)found.ratio));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Warns of contact a few facets wide. Collective.
   [out] told - whether there is such; [out] round - whether its sides are smooth: then the gap jumps or bends
   only because facets are large */
static PetscErrorCode SummaryWarnCoarseContact_Private(const SummaryInput *in, PetscInt p, PetscBool *told,
                                                       PetscBool *round)
{
  const char        *name     = in->vi->pairs[p]->spec->name;
  const ObstacleKind obstacle = in->vi->pairs[p]->spec->obstacle.kind;
  Warning            coarse   = {.code = "coarse_contact", .pair = name, .dim = in->scene->dim};
  CoarseContact      found;
  const PetscBool    holds = (PetscBool)(ScenePairHasFriction(in->vi->pairs[p]->spec) && in->vi->rigid_modes.num);
  PetscBool          jumps = PETSC_FALSE;
  PetscReal          overlap, where[3];
  char               text[128], advice[256], facets[32], force[128] = "";

  PetscFunctionBeginUser;
  PetscCall(CoarseContactFind(in->fields, p, &found));
  *told  = found.shows;
  *round = (PetscBool)(found.shows && (in->vi->pairs[p]->smooth[0] || in->vi->pairs[p]->smooth[1] ||
                                       (obstacle != OBSTACLE_NONE && obstacle != OBSTACLE_EXPRESSION)));
  if (!found.shows) PetscFunctionReturn(PETSC_SUCCESS);
  if (*round) PetscCall(GapDiscontinuityFind(in->fields, p, &jumps, &overlap, where));
  PetscCall(PetscArraycpy(coarse.at, found.at, 3));
  PetscCall(NumberWordsVector(coarse.dim, coarse.at, text, sizeof(text)));
  coarse.advice = advice;
  (void)snprintf(facets, sizeof(facets), "%.3g facet", (double)found.facets);
  if (strcmp(facets, "1 facet")) (void)strncat(facets, "s", sizeof(facets) - strlen(facets) - 1);
  if (jumps) {
    (void)snprintf(advice, sizeof(advice), "refine to cells of h <= %.2g near %s", (double)found.size, text);
    PetscCall(WarningAdd(&coarse,
                         "the contact of %s is %s wide, and its largest pressure is not resolved, nor a force that "
                         "displacements cause: the mean gap acts as an additional overlap of %.3g",
                         name, facets, (double)overlap));
  } else if (found.edge) {
    (void)snprintf(advice, sizeof(advice), "use the force alone, or round the edge and refine");
    PetscCall(
        WarningAdd(&coarse,
                   "the contact of %s is %s wide at an edge near %s, and the pressure at an edge grows with every "
                   "refinement",
                   name, facets, text));
  } else {
    (void)snprintf(advice, sizeof(advice), "refine to cells of h <= %.2g near %s%s", (double)found.size, text,
                   found.doubt > 0 ? ", or take order 2" : "");
    if (found.doubt > 0)
      (void)snprintf(force, sizeof(force),
                     ", nor a force that displacements cause: bodies may touch by %.2g too early or too late",
                     (double)found.doubt);
    PetscCall(WarningAdd(&coarse, "the contact of %s is %s wide, and its largest pressure is not resolved%s%s", name,
                         facets, holds ? ", nor the friction that holds bodies there" : "", force));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The largest initial overlap at the nodes of a pair, and the largest displacement of these nodes along their
   normals. Collective.
   [out] size - these two lengths, the same on all ranks */
static PetscErrorCode SummaryFindOverlap_Private(const SummaryInput *in, PetscInt p, PetscReal size[2])
{
  const Pair         pair = in->vi->pairs[p];
  const PetscInt     dim  = in->scene->dim;
  const PetscScalar *u;

  PetscFunctionBeginUser;
  size[0] = size[1] = 0;
  PetscCall(VecGetArrayRead(in->fields->u, &u)); // of nodes that this rank owns, as those of the pair are
  for (PetscInt a = 0; a < pair->num; a++) {
    PetscReal un = 0;

    for (PetscInt k = 0; k < dim; k++) un += PetscRealPart(u[pair->nodes[a] * dim + k]) * pair->normal[a * dim + k];
    size[0] = PetscMax(size[0], -pair->gap[a] / pair->share[a]);
    size[1] = PetscMax(size[1], PetscAbsReal(un));
  }
  PetscCall(VecRestoreArrayRead(in->fields->u, &u));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, size, 2, MPIU_REAL, MPI_MAX, in->scene->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Warns of an interference that is not large beside the deviation of facets from their curves. Collective. */
static PetscErrorCode SummaryWarnCoarseCurve_Private(const SummaryInput *in, PetscInt p)
{
  const Pair       pair  = in->vi->pairs[p];
  const PetscInt   which = pair->curve_error[1] > pair->curve_error[0] ? 1 : 0;
  const SceneSide *side  = which ? &pair->spec->mortar : &pair->spec->nonmortar;
  const PetscReal  left  = pair->curve_error[0] + pair->curve_error[1];
  Warning          curve = {.code = "coarse_curve", .pair = pair->spec->name};
  PetscReal        size[2];

  PetscFunctionBeginUser;
  if (!(left > 0) || pair->spec->type == PAIR_TIED) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(SummaryFindOverlap_Private(in, p, size));
  if (size[0] <= OVERLAP_SHOWS * size[1] || left <= CURVE_SHOWS * size[0]) PetscFunctionReturn(PETSC_SUCCESS);
  curve.advice = in->scene->bodies[side->body].polygonal ? "refine, or leave the sides smooth" : "refine";
  PetscCall(WarningAdd(&curve,
                       "%s: bodies overlap by %.3g initially, and facets deviate from their curves by up to %.3g, most "
                       "on %s:%s",
                       pair->spec->name, (double)size[0], (double)left, in->scene->bodies[side->body].name,
                       side->side));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Warns of pressures that the file's facets do not determine. Collective. */
static PetscErrorCode SummaryWarnCoarseFile_Private(const SummaryInput *in, PetscInt p)
{
  const ScenePair *spec   = in->vi->pairs[p]->spec;
  Warning          coarse = {.code = "coarse_file",
                             .pair = spec->name,
                             .dim  = in->scene->dim,
                             .advice = "give the file smaller facets on curved sides in contact, or facets of second order"};
  SideErrors       errors;
  char             at[128];

  PetscFunctionBeginUser;
  PetscCall(SideErrorsGet(in->fields, p, &errors));
  if (errors.pressure <= ERRORS_SHOW * errors.mean) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscArraycpy(coarse.at, errors.at, 3));
  PetscCall(NumberWordsVector(coarse.dim, coarse.at, at, sizeof(at)));
  PetscCall(WarningAdd(
      &coarse,
      "facets of files leave normals of %s uncertain by about %.2g: so are pressures, by %.2g in the mean "
      "square, %.2g times the mean, most near %s",
      spec->name, (double)errors.normal, (double)errors.pressure, (double)(errors.pressure / errors.mean), at));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Warns of lost friction, where a support fixes the nonmortar side along a partner that does not move along.
   Collective. */
static PetscErrorCode SummaryWarnHeldFriction_Private(const SummaryInput *in, PetscInt p)
{
  const ScenePair *spec = in->vi->pairs[p]->spec;
  Warning          held = {.code   = "held_friction",
                           .pair   = spec->name,
                           .dim    = in->scene->dim,
                           .advice = spec->mortar.body < 0
                                         ? "support the body elsewhere, or refine there"
                                         : "exchange nonmortar and mortar side, or support the body elsewhere"};
  PetscInt         num;
  PetscReal        share;
  char             at[128];

  PetscFunctionBeginUser;
  PetscCall(FrictionFieldsFindHeld(in->fields, p, &num, &share, held.at));
  if (!num) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(NumberWordsVector(in->scene->dim, held.at, at, sizeof(at)));
  PetscCall(WarningAdd(&held,
                       "%s has no friction at %" PetscInt_FMT
                       " node%s in contact, first at %s, %.3g %% of its area: supports hold the nonmortar side there "
                       "along its partner, which does not move with it",
                       spec->name, num, num == 1 ? "" : "s", at, (double)(100 * share)));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Warns of a pair without multipliers. */
static PetscErrorCode SummaryWarnEmptyPair_Private(const SummaryInput *in, PetscInt p)
{
  const Pair       pair = in->vi->pairs[p];
  const ScenePair *spec = pair->spec;
  const char      *body = in->scene->bodies[spec->nonmortar.body].name;
  const Warning    held = {.code = "nothing_to_decide", .pair = spec->name};
  const Warning    none = {.code   = "no_partner",
                           .pair   = spec->name,
                           .advice = "check the sides of the pair and the positions of the bodies"};

  PetscFunctionBeginUser;
  if (pair->num_multipliers) PetscFunctionReturn(PETSC_SUCCESS);
  if (pair->num_removed) {
    PetscCall(WarningAdd(&held,
                         "%s: no multipliers: the nodes of %s:%s that face the partner are fixed along their normal, "
                         "or belong to another pair",
                         spec->name, body, spec->nonmortar.side));
  } else {
    PetscCall(WarningAdd(
        &none,
        "%s: no part of %s:%s faces its partner within the reach %.6g (-%s_reach), across a gap or in an overlap",
        spec->name, body, spec->nonmortar.side, (double)pair->reach, spec->name));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Warns of a solver that stopped at a large discretisation error. */
static PetscErrorCode SummaryWarnCoarseMesh_Private(const SummaryInput *in)
{
  const Warning   coarse = {.code = "coarse_mesh", .advice = "refine, or omit -stop discretisation"};
  const PetscReal part   = CertificateRelative(in->certificate, in->report->discretisation);

  PetscFunctionBeginUser;
  if (isgreater(in->report->discretisation, 0) && isgreater(part, COARSE)) {
    PetscCall(WarningAdd(
        &coarse, "the solver stopped at a discretisation error of about %.1e of the solution, which is too large",
        (double)part));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Warns of an error that is estimated to be as large as the solution. The loop of -adapt judges its own. */
static PetscErrorCode SummaryWarnLargeError_Private(const SummaryInput *in)
{
  const Warning   coarse = {.code = "coarse_mesh", .advice = "refine, or use -adapt"};
  const PetscReal scale  = in->vi->stiffness * PetscSqr(in->fields->u_ref) * (PetscReal)in->vi->level->num_global;
  PetscReal       relative;
  Estimate        estimate;

  PetscFunctionBeginUser;
  if (in->estimate || (in->passing && !in->fields->estimate)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(EstimateGet(in->fields, &estimate));
  relative = EstimateGetRelative(estimate, estimate->standard);
  if (!(relative >= AS_LARGE) || estimate->norm <= STRAINED * scale) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(WarningAdd(
      &coarse, "the mesh is too coarse: in the energy norm the error is estimated to be as large as the solution"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Warns of a second solver that has not converged. */
static PetscErrorCode SummaryWarnUnconfirmed_Private(const SummaryInput *in)
{
  const Warning alone = {.code   = "not_confirmed",
                         .advice = "allow it more iterations by options that begin with -cross_check_"};

  PetscFunctionBeginUser;
  if (in->check->done && !in->check->other.converged) {
    PetscCall(
        WarningAdd(&alone, "not confirmed: %s found no solution: %s", in->check->other.type, in->check->other.reason));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Warns of a coefficient of friction so large that another solution may be near. */
static PetscErrorCode SummaryWarnNotUnique_Private(const SummaryInput *in)
{
  const FrictionReport *friction = &in->report->friction;

  PetscFunctionBeginUser;
  if (!in->vi->friction || !in->report->converged || (friction->rho < 1 && !friction->others))
    PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(WarningAdd(
      &(Warning){.code = "not_unique", .advice = "compare with smaller load steps, and with a smaller coefficient"},
      "with this friction the solution %s: rho is %.3g, and below 1 there is no other one near it",
      friction->others ? "is not the only one, and there are at least two others" : "may not be the only one",
      (double)friction->rho));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Warns, with -check, that loads are not balanced: a solve would end with exit code 2. */
static PetscErrorCode SummaryWarnUnbalanced_Private(const SummaryInput *in)
{
  const Solvability s = in->solvability;

  PetscFunctionBeginUser;
  if (!in->setup || !s || s->status != SOLVABLE_NOT) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(WarningAdd(&(Warning){.code = "unbalanced_loads", .advice = "support the body, or change the loads"},
                       "there is no solution%s: %s: the loads do %+.6g of work and %s",
                       s->coarse ? " on this mesh" : "", s->motion.sentence, (double)s->motion.work,
                       s->slides ? "friction is too small to resist" : "nothing resists"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a formula depends on the position: then it may vanish where bodies touch. */
static PetscBool SummaryVariesInSpace_Private(Expression value)
{
  static const char *const coordinates[] = {"x", "y", "z", "r"};

  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(coordinates); i++)
    if (ExpressionNames(value, coordinates[i])) return PETSC_TRUE;
  return PETSC_FALSE;
}

/* Warns of uniform loads on a side of a pair: they act under the partner as well, which is rarely
   intended. */
static PetscErrorCode SummaryWarnLoadedSide_Private(const SummaryInput *in, PetscInt p)
{
  const ScenePair *spec    = in->vi->pairs[p]->spec;
  const SceneSide *sides[] = {&spec->nonmortar, &spec->mortar};
  const Warning    about   = {.code = "loaded_contact", .pair = spec->name, .advice = "check the side of the load"};

  PetscFunctionBeginUser;
  for (PetscInt which = 0; which < 2 && spec->type == PAIR_CONTACT; which++) {
    const SceneBody *body = sides[which]->body >= 0 ? &in->scene->bodies[sides[which]->body] : NULL;

    for (PetscInt i = 0; body && i < body->num_boundaries; i++) {
      const SceneBoundary *load = &body->boundaries[i];

      if (!SceneBoundaryIsLoad(load) || !SceneSidesShare(load->side, sides[which]->side)) continue;
      if (SummaryVariesInSpace_Private(load->value)) continue;
      PetscCall(WarningAdd(&about, "%s loads the side %s:%s of %s, also where the partner touches it",
                           ExpressionOption(load->value), body->name, sides[which]->side, spec->name));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether there is no load, no given displacement and no overlap. Collective. */
static PetscErrorCode SummaryIsAtRest_Private(const SummaryInput *in, PetscBool *rest)
{
  const FrictionLaw *law = in->vi->friction;
  PetscReal          force;
  PetscBool          loaded = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(VecNorm(in->vi->f, NORM_INFINITY, &force));
  for (PetscInt i = 0; law && i < FRICTION_TANGENTS * law->n; i++)
    loaded = (PetscBool)(loaded || law->origin[i] != 0); // friction resists the slip of earlier load steps
  for (PetscInt p = 0; p < in->vi->num_pairs; p++) {
    const Pair pair = in->vi->pairs[p];

    for (PetscInt a = 0; a < pair->num; a++) loaded = (PetscBool)(loaded || pair->gap[a] < -ROUNDING * pair->reach);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &loaded, 1, MPIU_BOOL, MPI_LOR, in->scene->comm));
  *rest = (PetscBool)(!loaded && force == 0 && in->vi->support.max_value == 0);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Warns of a partner that overlaps a facet between its nodes and touches no node. Collective.
   [out] hidden - whether there is such a pair */
static PetscErrorCode SummaryWarnHidden_Private(const SummaryInput *in, PetscBool *hidden)
{
  Estimate estimate;

  PetscFunctionBeginUser;
  *hidden = PETSC_FALSE;
  if (!in->fields) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(EstimateGet(in->fields, &estimate));
  for (PetscInt p = 0; p < in->vi->num_pairs; p++) {
    const Pair pair    = in->vi->pairs[p];
    Warning    between = {.code   = "hidden_contact",
                          .pair   = pair->spec->name,
                          .dim    = in->scene->dim,
                          .advice = "refine there, or let -adapt do it"};
    char       at[128];
    PairSum    sum;

    if (pair->spec->type != PAIR_CONTACT || !(estimate->hidden[p].value > ROUNDING * pair->reach)) continue;
    PetscCall(PairSumCompute(in->fields, p, &sum));
    if (sum.active) continue;
    *hidden = PETSC_TRUE;
    PetscCall(PetscArraycpy(between.at, estimate->hidden[p].at, 3));
    PetscCall(NumberWordsVector(between.dim, between.at, at, sizeof(at)));
    PetscCall(WarningAdd(&between,
                         "%s: no node is in contact, but the partner enters a facet by %.3g between nodes at %s",
                         pair->spec->name, (double)estimate->hidden[p].value, at));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Warns of a scene without loads, or of a pair without contact; of load steps, at the last one. Collective.
   [out] hidden - whether a pair touches between nodes alone */
static PetscErrorCode SummaryWarnIdle_Private(const SummaryInput *in, PetscBool *hidden)
{
  const SceneSteps *steps = &in->scene->steps;
  const Warning     still = {.code = "no_load", .advice = "give loads, displacements, or an interference"};
  PetscBool         rest  = PETSC_FALSE;

  PetscFunctionBeginUser;
  *hidden = PETSC_FALSE;
  if (steps->num && in->scene->time != steps->t[steps->num - 1]) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(SummaryWarnHidden_Private(in, hidden));
  if (*hidden) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(SummaryIsAtRest_Private(in, &rest));
  if (rest)
    PetscCall(WarningAdd(&still, "nothing moves: all loads and given displacements are zero, and no bodies overlap"));
  for (PetscInt p = 0; p < in->vi->num_pairs && in->fields && !rest; p++) {
    const ScenePair *spec  = in->vi->pairs[p]->spec;
    const Warning    apart = {.code   = "open_contact",
                              .pair   = spec->name,
                              .advice = "check the signs of loads and displacements, and on which side the partner lies"};
    PairSum          sum;

    if (spec->type != PAIR_CONTACT || !in->vi->pairs[p]->num_multipliers) continue;
    PetscCall(PairSumCompute(in->fields, p, &sum));
    if (!sum.active && sum.min_gap > ROUNDING * in->vi->pairs[p]->reach)
      PetscCall(
          WarningAdd(&apart, "%s: no node is in contact; the smallest gap is %.6g", spec->name, (double)sum.min_gap));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SummaryWarn(const SummaryInput *input)
{
  PetscBool hidden;

  PetscFunctionBeginUser;
  PetscCall(SolvabilityReportWarn(input->vi, input->solvability));
  PetscCall(SetupWarningsAdd(input->vi, input->solvability, input->fields));
  for (PetscInt p = 0; p < input->vi->num_pairs; p++) {
    PetscBool uneven = PETSC_FALSE, coarse = PETSC_FALSE, round = PETSC_FALSE;

    PetscCall(SummaryWarnEmptyPair_Private(input, p));
    PetscCall(SummaryWarnLoadedSide_Private(input, p));
    PetscCall(SummaryWarnTiedGap_Private(input, p));
    if (input->fields) PetscCall(SummaryWarnUnevenPressure_Private(input, p, &uneven));
    if (input->fields && !uneven) // that breaks a patch into small ones
      PetscCall(SummaryWarnCoarseContact_Private(input, p, &coarse, &round));
    if (input->fields && !coarse) PetscCall(SummaryWarnEdgePressure_Private(input, p)); // the same advice
    if (input->fields && !round)
      PetscCall(SummaryWarnGapDiscontinuity_Private(input, p)); // a gap bends within few facets
    if (input->fields) PetscCall(SummaryWarnCoarseCurve_Private(input, p));
    if (input->fields) PetscCall(SummaryWarnCoarseFile_Private(input, p));
    if (input->fields) PetscCall(SummaryWarnHeldFriction_Private(input, p));
  }
  PetscCall(SummaryWarnUnbalanced_Private(input));
  PetscCall(SummaryWarnNotUnique_Private(input));
  PetscCall(SummaryWarnIdle_Private(input, &hidden));
  if (!input->fields) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ValidityWarn(input->fields));
  PetscCall(SummaryWarnCoarseMesh_Private(input));
  if (!hidden) PetscCall(SummaryWarnLargeError_Private(input));
  PetscCall(SummaryWarnUnconfirmed_Private(input));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* validity.c -- indicators of the small-displacement model.

   Strains and rotations take one pass over the cells. Gaps and normals take one contact search in the
   deformed configuration, slips products with D and M. */
#include <string.h>
#include "base/compat.h"
#include "base/json.h"
#include "base/warning.h"
#include "contact/deformedgap.h"
#include "kernel/vector.h"
#include "result/contactpatches.h"
#include "result/largest.h"
#include "result/slip.h"
#include "result/validity.h"

/* An indicator is green below the first number and red above the second: errors of one and of some per cent;
   a slip of half a facet and of two, where nodes face other facets than those that they are coupled with. */
static const struct {
  const char *name, *what;
  PetscReal   green, red;
} KINDS[VALIDITY_COUNT] = {
    {"strain", "neglected share of the strain", 0.01, 0.05},
    {"rotation", "rotation", 0.02, 0.1},
    {"gap", "error of the gap", 0.01, 0.05},
    {"slip_cell", "slip over facet", 0.5, 2},
    {"slip_contact", "slip over width of the contact", 0.02, 0.1},
    {"normal", "turn of normals", 0.02, 0.1},
};
static const char *const COLOURS[] = {"unknown", "green", "amber", "red"};

/* Strain and rotation are those that this part of a body's strain energy exceeds. At a corner of infinite
   stress the largest ones grow without limit as cells get smaller. A rotation moves all that hangs on a
   place, so that less is left out of it. Chosen so that two plates on any mesh have what the maxima are on 32
   x 32 and 24 x 24 cells, to 20 per cent. */
static const PetscReal STRAIN_SHARE = 0.01, ROTATION_SHARE = 0.002;
/* The strain, over the displacements and the size of the scene, of a place that counts by its volume: it is
   rounding. */
static const PetscReal STRAINLESS = 1e-12;
/* Gaps below this part of the displacements are closed. */
static const PetscReal NO_GAP = 1e-9;
/* A value that exceeds a limit by no more than this part of it is the limit, as where a uniform strain is. */
static const PetscReal LIMIT_ROUNDING = 1e-9;
/* Less than this part of an error grows with the square of the displacements: it is of the mesh. */
static const PetscReal SQUARE_PART = 0.25;
/* A scale below this part of the displacements is rounding. */
static const PetscReal RIM_PART       = 0.5; /* of the way: a larger error is of the search */
static const PetscReal SCALE_ROUNDING = 1e-6;
/* Displacements are halved so many times to find the partner that a node has slid off. */
enum { MAX_HALVES = 6 };

/* What is neglected of the strain, the strain and the rotation that a gradient stands for. [in] H - grad u,
   in place 9 the strain around the axis; [out] sizes - Frobenius norms of 1/2 H'H and eps, the angle of the
   rotation */
static void ValidityOfGradient_Private(PetscInt dim, const PetscReal H[10], PetscReal sizes[3])
{
  PetscReal product = PetscSqr(0.5 * H[9] * H[9]), strain = H[9] * H[9], turn = 0;

  for (PetscInt i = 0; i < dim; i++) {
    for (PetscInt j = 0; j < dim; j++) {
      PetscReal sum = 0;

      for (PetscInt k = 0; k < dim; k++) sum += H[k * dim + i] * H[k * dim + j];
      product += PetscSqr(0.5 * sum);
      strain += PetscSqr(0.5 * (H[i * dim + j] + H[j * dim + i]));
      if (i < j) turn += PetscSqr(0.5 * (H[i * dim + j] - H[j * dim + i]));
    }
  }
  sizes[0] = PetscSqrtReal(product);
  sizes[1] = PetscSqrtReal(strain);
  sizes[2] = PetscSqrtReal(turn);
}

/* What is found in the cells: the root of what is neglected of the strain, the strain, the rotation. */
enum { NEGLECTED, STRAIN, ROTATION, NUM_SIZES };

/* Adds one cell, by strain energy but for the modulus. [in] u - at local nodes; [in] reference - usual size
   of grad u; [in,out] sizes - [NUM_SIZES] */
static void ValidityOfCell_Private(const Fields fields, PetscInt c, const ElementRule *rule, const PetscScalar u[],
                                   PetscReal reference, LargestBut sizes[])
{
  const Level    *level = fields->vi->level;
  const PetscInt  dim = level->dim, n = ElementNumNodes(rule->type), *nodes = &level->cell_nodes[level->cell_start[c]];
  const PetscBool ring = (PetscBool)(level->scene->model == MODEL_AXISYMMETRIC);
  PetscReal       X[ELEMENT_MAX_NODES * 3], v[ELEMENT_MAX_NODES * 3], x[3], found[NUM_SIZES];

  VectorGather(dim, n, nodes, level->coords, X);
  VectorGather(dim, n, nodes, u, v);
  for (PetscInt q = 0; q < rule->num; q++) {
    PetscReal H[10] = {0}, weight;

    weight = PetscAbsReal(ElementRuleGradient(rule, q, X, v, x, H));
    for (PetscInt i = 0; ring && i < n; i++) H[9] += rule->phi[q * n + i] * v[i * dim] / x[0];
    if (ring) weight *= x[0];
    ValidityOfGradient_Private(dim, H, found);
    found[NEGLECTED] = PetscSqrtReal(found[NEGLECTED]);
    weight *= PetscSqr(found[STRAIN] / reference) + PetscSqr(STRAINLESS);
    for (PetscInt k = 0; k < NUM_SIZES; k++)
      LargestButAdd(sizes[k], found[k], weight, dim, x, (PetscInt)level->cell_body[c]);
  }
}

/* All cells of this rank. [in] reference, [in,out] sizes - of ValidityOfCell_Private() */
static PetscErrorCode ValidityAddCells_Private(Fields fields, PetscReal reference, LargestBut sizes[])
{
  const Level       *level = fields->vi->level;
  ElementRule       *rule;
  const PetscScalar *u;
  PetscInt           type = -1;
  Vec                local;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&rule));
  PetscCall(VecGhostGetLocalForm(fields->u, &local));
  PetscCall(VecGetArrayRead(local, &u));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    if (level->cell_type[c] != type) {
      type = level->cell_type[c];
      ElementRuleSet((ElementType)type, ElementStiffnessDegree((ElementType)type), rule);
    }
    ValidityOfCell_Private(fields, c, rule, u, reference, sizes);
  }
  PetscCall(VecRestoreArrayRead(local, &u));
  PetscCall(VecGhostRestoreLocalForm(fields->u, &local));
  PetscCall(PetscFree(rule));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Strains and rotations. Collective. [out] strain - that of STRAIN_SHARE */
static PetscErrorCode ValidityOfCells_Private(Fields fields, Largest largest[VALIDITY_COUNT], PetscReal *strain)
{
  const PetscReal share[NUM_SIZES] = {STRAIN_SHARE, STRAIN_SHARE, ROTATION_SHARE};
  const Level    *level            = fields->vi->level;
  const PetscReal reference        = fields->u_ref > 0 ? fields->u_ref / fields->vi->length : 1;
  LargestBut      sizes[NUM_SIZES];
  Largest         found[NUM_SIZES];

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < NUM_SIZES; k++)
    PetscCall(LargestButCreate(fields->vi->scene->num_bodies, reference, &sizes[k]));
  PetscCall(ValidityAddCells_Private(fields, reference, sizes));
  for (PetscInt k = 0; k < NUM_SIZES; k++) {
    PetscCall(LargestButGet(sizes[k], level->comm, level->dim, share[k], &found[k]));
    PetscCall(LargestButDestroy(&sizes[k]));
  }
  *strain                        = found[STRAIN].value;
  largest[VALIDITY_STRAIN]       = found[NEGLECTED];
  largest[VALIDITY_STRAIN].value = PetscSqr(found[NEGLECTED].value);
  if (*strain > STRAINLESS * reference)
    largest[VALIDITY_STRAIN].value /= *strain;
  else
    largest[VALIDITY_STRAIN].value = 0; // rigid motions have no strain, and no error of it
  largest[VALIDITY_ROTATION] = found[ROTATION];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What the nodes of a pair tell; not in contact are those of ties, too. */
typedef struct {
  PetscReal *relative, *tangential; /* displacements of the nonmortar side less those of the other one [num][dim] */
  PetscReal *linear;                /* linearized gap [num] */
  PetscReal *error;                 /* gap in the deformed configuration less that, NAN where it does not count [num] */
  PetscReal *turn;                  /* of normals [num] */
  PetscReal *size;                  /* of a facet [num] */
  PetscReal *force;                 /* p W [num] */
  PetscInt  *patch;                 /* of the node, -1 where it is not in contact [num] */
  PetscReal  scale;                 /* what errors of gaps are compared with */
} PairState;

static PetscErrorCode PairStateCreate_Private(Fields fields, PetscInt p, const ContactPatches *patches,
                                              PairState *state)
{
  const VI         vi   = fields->vi;
  const Pair       pair = vi->pairs[p];
  const PetscInt   num = pair->num, dim = vi->level->dim;
  const PetscReal *lambda, *slack;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc5(num * dim, &state->relative, num * dim, &state->tangential, num, &state->linear, num,
                         &state->error, num, &state->turn));
  PetscCall(PetscMalloc3(num, &state->size, num, &state->patch, num, &state->force));
  PetscCall(SlipComputeRelative(fields, p, state->relative));
  SlipTakeTangential(pair, state->relative, state->tangential);
  PetscCall(SlipFindFacetSizes(fields, p, state->size));
  for (PetscInt a = 0; a < num; a++) {
    state->patch[a] = -1;
    state->force[a] = 0;
    state->linear[a] =
        pair->gap[a] - pair->share[a] * VectorDot(dim, &pair->normal[a * dim], &state->relative[a * dim]);
  }
  PetscCall(VecGetArrayRead(fields->lambda, &lambda));
  PetscCall(VecGetArrayRead(fields->slack, &slack));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const PetscInt a = vi->row_node[r];

    if (vi->row_pair[r] != p || vi->row_direction[r] != 0 || pair->spec->type == PAIR_TIED) continue;
    state->linear[a] = slack[r];
    state->patch[a]  = patches->row_patch[r];
    if (state->patch[a] >= 0) state->force[a] = lambda[r] * fields->row_weight[r];
  }
  PetscCall(VecRestoreArrayRead(fields->slack, &slack));
  PetscCall(VecRestoreArrayRead(fields->lambda, &lambda));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode PairStateDestroy_Private(PairState *state)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree5(state->relative, state->tangential, state->linear, state->error, state->turn));
  PetscCall(PetscFree3(state->size, state->patch, state->force));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The largest of three lengths: relative normal displacements of the sides, gaps that have closed, and the
   strain times the extent of the contact. An error of the last one would be a stress as large as the present
   one. The extent is twice the largest distance from the mean of its nodes, also in turned scenes.
   Collective. */
static PetscErrorCode PairStateSetScale_Private(Fields fields, const Pair pair, PetscReal strain, PairState *state)
{
  const PetscInt dim        = pair->level->dim;
  PetscReal      largest[2] = {0, 0}, sum[4] = {0, 0, 0, 0}; // displacement or gap, radius; of nodes: number, positions

  PetscFunctionBeginUser;
  for (PetscInt a = 0; a < pair->num; a++) {
    largest[0] = PetscMax(largest[0], PetscAbsReal(pair->gap[a] - state->linear[a]));
    if (state->patch[a] < 0 && pair->spec->type != PAIR_TIED) continue;
    largest[0] = PetscMax(largest[0], PetscAbsReal(pair->gap[a]));
    sum[0] += 1;
    for (PetscInt k = 0; k < dim; k++) sum[1 + k] += pair->level->coords[pair->nodes[a] * dim + k];
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 4, MPIU_REAL, MPIU_SUM, pair->level->comm));
  for (PetscInt a = 0; a < pair->num; a++) {
    PetscReal square = 0;

    if (state->patch[a] < 0 && pair->spec->type != PAIR_TIED) continue;
    for (PetscInt k = 0; k < dim; k++)
      square += PetscSqr(pair->level->coords[pair->nodes[a] * dim + k] - sum[1 + k] / sum[0]);
    largest[1] = PetscMax(largest[1], PetscSqrtReal(square));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, largest, 2, MPIU_REAL, MPIU_MAX, pair->level->comm));
  state->scale = PetscMax(PetscMax(largest[0], strain * 2 * largest[1]), SCALE_ROUNDING * fields->u_ref);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Gaps in the configuration that a share of the displacements deforms, less linearized ones. Collective.
   [out] error - NAN where no partner faces the node [pair->num]; [out] turn - or NULL */
static PetscErrorCode PairStateMeasureAt_Private(Fields fields, const Pair pair, const PairState *state,
                                                 PetscReal share, PetscReal error[], PetscReal turn[])
{
  const VI vi = fields->vi;
  Vec      u;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(vi->level, vi->level->dim, &u));
  PetscCall(VecAXPBY(u, share, 0.0, fields->u));
  PetscCall(LevelShareVec(u, INSERT_VALUES));
  PetscCall(DeformedGapMeasure(vi->scene, &vi->support, pair, u, error, turn));
  for (PetscInt a = 0; a < pair->num; a++) error[a] -= pair->gap[a] + share * (state->linear[a] - pair->gap[a]);
  PetscCall(VecDestroy(&u));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Errors of the gap of nodes that touch, or were near enough to begin with. A node that has slid off its
   partner is measured on the way: errors grow with the square of the displacement. What is off by as much as
   the way itself is no such error. At the rim of a partner another part of a facet is met. Collective. */
static PetscErrorCode PairStateMeasureGaps_Private(Fields fields, const Pair pair, PairState *state)
{
  PetscReal share = 1, *error;
  PetscBool away  = PETSC_TRUE;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(pair->num, &error));
  for (PetscInt a = 0; a < pair->num; a++) state->error[a] = NAN;
  for (PetscInt half = 0; half <= MAX_HALVES && away; half++, share /= 2) {
    PetscCall(PairStateMeasureAt_Private(fields, pair, state, share, error, half ? NULL : state->turn));
    away = PETSC_FALSE;
    for (PetscInt a = 0; a < pair->num; a++) {
      if (pair->spec->obstacle.kind == OBSTACLE_EXPRESSION) continue; // a gap that is given, not measured
      if (!PetscIsNanReal(state->error[a]) || PetscAbsReal(pair->gap[a]) > state->scale) continue;
      if (PetscIsNanReal(error[a])) away = PETSC_TRUE;
      state->error[a] = error[a] / PetscSqr(share);
      if (half && PetscAbsReal(error[a]) > RIM_PART * share * state->scale) state->error[a] = 0;
    }
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &away, 1, MPIU_BOOL, MPI_LOR, fields->vi->level->comm));
  }
  PetscCall(PetscFree(error));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Omits errors of gaps that do not grow with the square of the displacements. At edges and on coarse facets
   the linearized gap of a mesh has errors in proportion to them. A node at the rim of its partner meets
   another part of it. Neither is a limit of the model. Collective. */
static PetscErrorCode PairStateOmitLinear_Private(Fields fields, const Pair pair, PairState *state)
{
  PetscReal *error[2];
  PetscBool  large = PETSC_FALSE;

  PetscFunctionBeginUser;
  for (PetscInt a = 0; a < pair->num; a++)
    large = (PetscBool)(large || (!PetscIsNanReal(state->error[a]) &&
                                  PetscAbsReal(state->error[a]) > KINDS[VALIDITY_GAP].green * state->scale));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &large, 1, MPIU_BOOL, MPI_LOR, fields->vi->level->comm));
  if (!large) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc2(pair->num, &error[0], pair->num, &error[1]));
  PetscCall(PairStateMeasureAt_Private(fields, pair, state, 1. / 2, error[0], NULL));
  PetscCall(PairStateMeasureAt_Private(fields, pair, state, 1. / 4, error[1], NULL));
  for (PetscInt a = 0; a < pair->num; a++) {
    const PetscReal whole = state->error[a], half = error[0][a], quarter = error[1][a];
    PetscReal       square;

    if (PetscIsNanReal(whole) || PetscIsNanReal(half) || PetscIsNanReal(quarter)) continue;
    square = (whole - 3 * half + 2 * quarter) * 8 / 3; // b of a0 + a1 s + b s^2 at s = 1, 1/2, 1/4
    if (PetscAbsReal(square) < SQUARE_PART * PetscAbsReal(whole)) state->error[a] = square;
    if (PetscAbsReal(4 * half) < SQUARE_PART * PetscAbsReal(whole)) state->error[a] = 4 * half; // jumps on the way
  }
  PetscCall(PetscFree2(error[0], error[1]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Gaps, slips and normals of one pair. Collective. [in] strain - of ValidityOfCells_Private(); [in,out]
   largest - of all pairs, of this rank; [in,out] sliding - sum of p W |slip| */
static PetscErrorCode ValidityOfPair_Private(Fields fields, PetscInt p, PetscReal strain,
                                             Largest largest[VALIDITY_COUNT], PetscReal *sliding)
{
  const Pair     pair = fields->vi->pairs[p];
  const PetscInt dim  = pair->level->dim;
  /* adaptive facets are as small as the error wants them, below any slip */
  const PetscBool adaptive = fields->vi->scene->adapt.on;
  ContactPatches  patches;
  PairState       state;

  PetscFunctionBeginUser;
  PetscCall(ContactPatchesCreate(fields, p, &patches));
  PetscCall(PairStateCreate_Private(fields, p, &patches, &state));
  PetscCall(PairStateSetScale_Private(fields, pair, strain, &state));
  PetscCall(PairStateMeasureGaps_Private(fields, pair, &state));
  PetscCall(PairStateOmitLinear_Private(fields, pair, &state));
  for (PetscInt a = 0; a < pair->num; a++) {
    const PetscReal *x    = &pair->level->coords[pair->nodes[a] * dim];
    const PetscReal  slip = VectorNorm(dim, &state.tangential[a * dim]);
    PetscReal        width;

    LargestTake(&largest[VALIDITY_NORMAL], state.turn[a], dim, x, p);
    if (!PetscIsNanReal(state.error[a]) && state.scale > 0)
      LargestTake(&largest[VALIDITY_GAP], PetscAbsReal(state.error[a]) / state.scale, dim, x, p);
    if (state.patch[a] < 0) continue;
    if (!adaptive) LargestTake(&largest[VALIDITY_SLIP_CELL], slip / state.size[a], dim, x, p);
    width = PetscMax(patches.patch[state.patch[a]].width, state.size[a]); // a node alone has no extent
    LargestTake(&largest[VALIDITY_SLIP_CONTACT], slip / width, dim, x, p);
    if (!ScenePairHasFriction(pair->spec)) *sliding += state.force[a] * slip;
  }
  PetscCall(PairStateDestroy_Private(&state));
  PetscCall(ContactPatchesDestroy(&patches));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Friction, as a share of twice the strain energy: of the work that loads in proportion do. Collective. */
static PetscErrorCode ValiditySetFriction_Private(Fields fields, PetscReal sliding, Validity v)
{
  const PetscInt num_bodies = fields->vi->scene->num_bodies;
  PetscReal     *strain, potential, work = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(num_bodies, &strain));
  PetscCall(FieldsEnergy(fields, strain, &potential));
  for (PetscInt b = 0; b < num_bodies; b++) work += 2 * strain[b];
  PetscCall(PetscFree(strain));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &sliding, 1, MPIU_REAL, MPI_SUM, fields->vi->level->comm));
  v->friction = v->indicator[VALIDITY_SLIP_CELL].colour != VALIDITY_UNKNOWN && work > 0 ? sliding / work : NAN;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Colours, and the factor of the loads at which the first indicator is red. */
static void ValidityJudge_Private(PetscInt dim, const Largest largest[], Validity v)
{
  v->load_factor = PETSC_INFINITY;
  v->worst       = VALIDITY_GREEN;
  for (PetscInt k = 0; k < VALIDITY_COUNT; k++) {
    ValidityIndicator *indicator = &v->indicator[k];
    const PetscReal    value     = largest[k].value;
    const PetscBool    cells     = (PetscBool)(k == VALIDITY_STRAIN || k == VALIDITY_ROTATION);

    *indicator = (ValidityIndicator){.value = NAN, .at = {NAN, NAN, NAN}, .body = -1, .pair = -1};
    if (!(value >= 0)) continue;
    indicator->value = value;
    for (PetscInt i = 0; i < dim; i++) indicator->at[i] = largest[k].at[i];
    *(cells ? &indicator->body : &indicator->pair) = (PetscInt)largest[k].owner;
    indicator->colour                              = value <= (1 + LIMIT_ROUNDING) * KINDS[k].green ? VALIDITY_GREEN
                                                     : value > KINDS[k].red                         ? VALIDITY_RED
                                                                                                    : VALIDITY_AMBER;
    v->worst                                       = PetscMax(v->worst, indicator->colour);
    if (value > 0) v->load_factor = PetscMin(v->load_factor, KINDS[k].red / value);
  }
  if (PetscIsInfReal(v->load_factor)) v->load_factor = NAN;
}

/* Whether all sides touch to begin with where they may meet. Collective. */
static PetscErrorCode ValiditySetHomogeneous_Private(Fields fields, Validity v)
{
  const VI  vi  = fields->vi;
  PetscReal gap = 0;

  PetscFunctionBeginUser;
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    for (PetscInt a = 0; a < vi->pairs[p]->num; a++) gap = PetscMax(gap, PetscAbsReal(vi->pairs[p]->gap[a]));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &gap, 1, MPIU_REAL, MPIU_MAX, vi->level->comm));
  v->homogeneous = (PetscBool)(gap <= NO_GAP * fields->u_ref);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The indicators, which are computed once for each solution. Collective.
   [out] validity - borrowed from the fields */
static PetscErrorCode ValidityGet_Private(Fields fields, Validity *validity)
{
  const VI  vi = fields->vi;
  Largest   largest[VALIDITY_COUNT];
  PetscReal sliding = 0, strain = 0;
  Validity  v;

  PetscFunctionBeginUser;
  *validity = fields->validity;
  if (*validity) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscNew(&v));
  for (PetscInt k = 0; k < VALIDITY_COUNT; k++) largest[k] = (Largest){.value = -1};
  PetscCall(ValidityOfCells_Private(fields, largest, &strain));
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    if (vi->pairs[p]->num_multipliers) PetscCall(ValidityOfPair_Private(fields, p, strain, largest, &sliding));
  }
  PetscCall(LargestReduce(vi->level->comm, vi->level->dim, VALIDITY_COUNT - VALIDITY_GAP, &largest[VALIDITY_GAP]));
  ValidityJudge_Private(vi->level->dim, largest, v);
  PetscCall(ValiditySetFriction_Private(fields, sliding, v));
  PetscCall(ValiditySetHomogeneous_Private(fields, v));
  fields->validity = *validity = v;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* "rotation 0.182 at (1, 2)" */
static PetscErrorCode ValidityDescribe_Private(PetscInt dim, const Validity v, PetscInt k, char text[], size_t len)
{
  const ValidityIndicator *indicator = &v->indicator[k];

  PetscFunctionBeginUser;
  PetscCall(PetscSNPrintf(text, len, "%s %.3g at (%.4g, %.4g", KINDS[k].what, (double)indicator->value,
                          (double)indicator->at[0], (double)indicator->at[1]));
  if (dim == 3) {
    const size_t end = strlen(text);

    PetscCall(PetscSNPrintf(text + end, len - end, ", %.4g", (double)indicator->at[2]));
  }
  PetscCall(PetscStrlcat(text, ")", len));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ValidityWarn(Fields fields)
{
  const Scene              scene = fields->vi->scene;
  const ValidityIndicator *first;
  PetscInt                 leading = 0, others = 0;
  char                     text[256];
  Warning                  limit = {.code = "model_limit", .dim = scene->dim};
  Validity                 v;

  PetscFunctionBeginUser;
  PetscCall(ValidityGet_Private(fields, &v));
  if (v->worst < VALIDITY_AMBER) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt k = 1; k < VALIDITY_COUNT; k++) {
    if (v->indicator[k].colour == VALIDITY_UNKNOWN) continue;
    if (v->indicator[k].value / KINDS[k].red > v->indicator[leading].value / KINDS[leading].red) leading = k;
  }
  for (PetscInt k = 0; k < VALIDITY_COUNT; k++) others += k != leading && v->indicator[k].colour >= VALIDITY_AMBER;
  first = &v->indicator[leading];
  if (first->body >= 0) limit.body = scene->bodies[first->body].name;
  if (first->pair >= 0) limit.pair = scene->pairs[first->pair].name;
  PetscCall(PetscArraycpy(limit.at, first->at, scene->dim));
  limit.grave  = (PetscBool)(v->worst == VALIDITY_RED);
  limit.advice = limit.grave ? "check the units of loads, lengths and moduli, or reduce the loads"
                             : "expect errors of some per cent beside those of the mesh";
  PetscCall(ValidityDescribe_Private(scene->dim, v, leading, text, sizeof(text)));
  PetscCall(
      WarningAdd(&limit, "small displacements %s: %s in %s, limit %.3g%s; the model holds up to %.3g times these loads",
                 limit.grave ? "are exceeded" : "hold roughly", text, limit.body ? limit.body : limit.pair,
                 (double)KINDS[leading].red, others ? " (and others, see validity)" : "", (double)v->load_factor));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ValidityAdd(Fields fields, cJSON *root)
{
  cJSON   *object = cJSON_AddObjectToObject(root, "validity"), *all = cJSON_AddObjectToObject(object, "indicators");
  Validity v = NULL;

  PetscFunctionBeginUser;
  if (fields) PetscCall(ValidityGet_Private(fields, &v));
  for (PetscInt k = 0; k < VALIDITY_COUNT; k++) {
    cJSON          *item  = cJSON_AddObjectToObject(all, KINDS[k].name);
    const PetscBool known = (PetscBool)(v && v->indicator[k].colour != VALIDITY_UNKNOWN);

    JSONAddReal(item, "value", known ? v->indicator[k].value : NAN);
    if (known)
      JSONAddReals(item, "at", fields->vi->level->dim, v->indicator[k].at);
    else
      cJSON_AddNullToObject(item, "at");
    if (known)
      cJSON_AddStringToObject(item, "colour", COLOURS[v->indicator[k].colour]);
    else
      cJSON_AddNullToObject(item, "colour");
    JSONAddReal(item, "red", KINDS[k].red);
  }
  JSONAddReal(object, "load_factor", v ? v->load_factor : NAN);
  if (v)
    cJSON_AddBoolToObject(object, "homogeneous", v->homogeneous);
  else
    cJSON_AddNullToObject(object, "homogeneous");
  JSONAddReal(object, "friction_neglected", v ? v->friction : NAN);
  PetscFunctionReturn(PETSC_SUCCESS);
}

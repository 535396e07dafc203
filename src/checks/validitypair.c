/* validitypair.c -- errors of linearized gaps, turns of normals, and slips of one pair.

   Gaps and normals take a contact search in the deformed configuration. Slips take products with D and M. */
#include "checks/validityimpl.h"
#include "base/compat.h"
#include "contact/deformedgap.h"
#include "kernel/vector.h"
#include "checks/contactpatches.h"
#include "checks/slip.h"
#include "checks/slippatch.h"

/* Less than this part of an error grows with the square of the displacements: it is of the mesh. */
static const PetscReal SQUARE_PART = 0.25;
/* At the rim of a partner another part of a facet is met: an error above this part of the way is no limit of
   the model. */
static const PetscReal RIM_PART = 0.5;
/* A scale below this part of the displacements is rounding. */
static const PetscReal SCALE_ROUNDING = 1e-6;
/* A slip of two facets is no limit where the patch and its sides are longer than this number of them. */
static const PetscReal WIDE_PATCH = 20;
/* Displacements are halved so many times to find the partner that a node has slid off. */
enum { MAX_HALVES = 6 };

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

/* Whether some node that counts for gaps has facets that the partner covers wholly. Collective. */
static PetscErrorCode PairStateFindWhole_Private(const Pair pair, const PairState *state, PetscBool *whole)
{
  PetscFunctionBeginUser;
  *whole = PETSC_FALSE;
  for (PetscInt a = 0; a < pair->num && !*whole; a++)
    *whole = (PetscBool)(!pair->partly_covered[a] && PetscAbsReal(pair->gap[a]) <= state->scale);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, whole, 1, MPIU_BOOL, MPI_LOR, pair->level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Errors of the gap of nodes that touch, or were near enough to begin with. Where the partner ends within a
   facet, the mean gap is one over another part of it afterwards, which is no error of the gap: such nodes are
   omitted if there are others. A node that has slid off its
   partner is measured on the way: errors grow with the square of the displacement. What is off by as much as
   the way itself is no such error. At the rim of a partner another part of a facet is met. Collective. */
static PetscErrorCode PairStateMeasureGaps_Private(Fields fields, const Pair pair, PairState *state)
{
  PetscReal share = 1, *error;
  PetscBool away  = PETSC_TRUE, whole;

  PetscFunctionBeginUser;
  PetscCall(PairStateFindWhole_Private(pair, state, &whole));
  PetscCall(PetscMalloc1(pair->num, &error));
  for (PetscInt a = 0; a < pair->num; a++) state->error[a] = NAN;
  for (PetscInt half = 0; half <= MAX_HALVES && away; half++, share /= 2) {
    PetscCall(PairStateMeasureAt_Private(fields, pair, state, share, error, half ? NULL : state->turn));
    away = PETSC_FALSE;
    for (PetscInt a = 0; a < pair->num; a++) {
      if (pair->spec->obstacle.kind == OBSTACLE_EXPRESSION) continue; // a gap that is given, not measured
      if (whole && pair->partly_covered[a]) continue;
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
                                  PetscAbsReal(state->error[a]) > VALIDITY_GREEN_GAP * state->scale));
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

PetscErrorCode ValidityPairMeasure(Fields fields, PetscInt p, PetscReal strain, Largest largest[VALIDITY_COUNT],
                                   PetscReal *sliding, GapErrors *errors)
{
  const Pair     pair = fields->vi->pairs[p];
  const PetscInt dim  = pair->level->dim;
  ContactPatches patches;
  PairState      state;
  SlipPatch     *slips;

  PetscFunctionBeginUser;
  PetscCall(ContactPatchesCreate(fields, p, &patches));
  PetscCall(PairStateCreate_Private(fields, p, &patches, &state));
  PetscCall(SlipPatchesCreate(fields, p, &patches, state.patch, state.force, state.tangential, &slips));
  PetscCall(PairStateSetScale_Private(fields, pair, strain, &state));
  PetscCall(PairStateMeasureGaps_Private(fields, pair, &state));
  PetscCall(PairStateOmitLinear_Private(fields, pair, &state));
  PetscCall(GapErrorsAdd(fields, p, &patches, state.error, state.scale, errors));
  for (PetscInt a = 0; a < pair->num; a++) {
    const PetscReal *x    = &pair->level->coords[pair->nodes[a] * dim];
    const PetscReal  slip = VectorNorm(dim, &state.tangential[a * dim]);
    PetscReal        width, share;

    LargestTake(&largest[VALIDITY_NORMAL], state.turn[a], dim, x, p);
    if (!PetscIsNanReal(state.error[a]) && state.scale > 0)
      LargestTake(&largest[VALIDITY_GAP], PetscAbsReal(state.error[a]) / state.scale, dim, x, p);
    if (state.patch[a] < 0) continue;
    width = PetscMax(patches.patch[state.patch[a]].width, state.size[a]); // a node alone has no extent
    share = SlipPatchCompare(&slips[state.patch[a]], dim, &state.tangential[a * dim], width);
    LargestTake(&largest[VALIDITY_SLIP_CELL], PetscMin(slip / state.size[a], WIDE_PATCH * share), dim, x, p);
    LargestTake(&largest[VALIDITY_SLIP_CONTACT], share, dim, x, p);
    if (!ScenePairHasFriction(pair->spec)) *sliding += state.force[a] * slip;
  }
  PetscCall(PetscFree(slips));
  PetscCall(PairStateDestroy_Private(&state));
  PetscCall(ContactPatchesDestroy(&patches));
  PetscFunctionReturn(PETSC_SUCCESS);
}

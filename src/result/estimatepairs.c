/* estimatepairs.c -- what contact adds to the error estimate.

   Recovery does not detect that two sides do not fit: a stiff nonmortar body has hardly any stress while its
   partner penetrates its coarse side. What the sides' tractions and gaps leave is taken as a half space takes
   a wave of the facet's size. It resists a displacement of wave number k with E' k / 2, k = pi / h. */
#include "base/compat.h"
#include "contact/pairpoints.h"
#include "kernel/frame.h"
#include "kernel/rise.h"
#include "kernel/vector.h"
#include "result/estimatepairs.h"
#include "result/hiddencontact.h"

enum { F = ELEMENT_MAX_FACET_NODES };

/* Below this part of a facet's size, what an obstacle does between its points is rounding. */
static const PetscReal HIDDEN_DEPTH = 1e-9;

/* Both sides' values at nodes. */
typedef struct {
  const PetscScalar *u, *traction, *normal; /* local forms of the nonmortar side */
  /* Status of the nonmortar side, and whether the node has a pressure, its own or that of neighbours; with a
     frozen set, of that [2] */
  const PetscScalar *status;
  const PetscScalar *before; /* displacement from which slip counts, or NULL for none */
  NodalStressArrays  stress;
  PetscReal         *u_m;        /* of PairPointsFetch(), like the following */
  PetscReal         *before_m;   /* NULL for none */
  PetscReal        **stress_m;   /* [most] */
  PetscReal         *material_m; /* those that meet at a node, NULL where no body has regions [num_mortar][F][most] */
  PetscReal         *X_m;        /* places, NULL without a lever arm */
  PetscInt           most;       /* materials that meet at a node */
} PairValues;

/* The materials of owned nodes, as they are stored. Collective.
   [out] v - [most] per node, -1 behind the last */
static PetscErrorCode PairValuesCreateMaterials_Private(Fields fields, Vec *v)
{
  const NodeMaterials *at    = &fields->stress.at;
  Level               *level = fields->vi->level;
  PetscScalar         *a;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, at->most, v));
  PetscCall(VecGetArray(*v, &a));
  for (PetscInt i = 0; i < level->num_owned; i++) {
    const PetscInt num = NodeMaterialsCount(at, i);

    for (PetscInt k = 0; k < at->most; k++) a[i * at->most + k] = k < num ? at->material[at->start[i] + k] : -1;
  }
  PetscCall(VecRestoreArray(*v, &a));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The places of owned nodes. Collective. */
static PetscErrorCode PairValuesCreatePlaces_Private(Level *level, Vec *v)
{
  PetscScalar *a;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, level->dim, v));
  PetscCall(VecGetArray(*v, &a));
  for (PetscInt i = 0; i < level->num_owned * level->dim; i++) a[i] = level->coords[i];
  PetscCall(VecRestoreArray(*v, &a));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Displacements, stresses and tractions at mortar nodes. Collective.
   [out] values - released by PairValuesRestoreMortar_Private() */
static PetscErrorCode PairValuesFetchMortar_Private(Fields fields, const Pair pair, PairValues *values)
{
  Level *level = fields->vi->level;
  Vec    v;

  PetscFunctionBeginUser;
  values->most = fields->stress.at.most;
  PetscCall(PairPointsFetch(pair->points, fields->u, level->dim, &values->u_m));
  if (ScenePairHasFriction(pair->spec) && fields->vi->slip_from)
    PetscCall(PairPointsFetch(pair->points, fields->vi->slip_from, level->dim, &values->before_m));
  PetscCall(PetscMalloc1(values->most, &values->stress_m));
  for (PetscInt i = 0; i < values->most; i++)
    PetscCall(PairPointsFetch(pair->points, fields->stress.value[i], CELL_STRESSES, &values->stress_m[i]));
  if (fields->stress.at.start) {
    PetscCall(PairValuesCreateMaterials_Private(fields, &v));
    PetscCall(PairPointsFetch(pair->points, v, values->most, &values->material_m));
    PetscCall(VecDestroy(&v));
  }
  if (pair->arm) {
    PetscCall(PairValuesCreatePlaces_Private(level, &v));
    PetscCall(PairPointsFetch(pair->points, v, level->dim, &values->X_m));
    PetscCall(VecDestroy(&v));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode PairValuesRestoreMortar_Private(PairValues *values)
{
  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < values->most; i++) PetscCall(PetscFree(values->stress_m[i]));
  PetscCall(PetscFree(values->stress_m));
  PetscCall(PetscFree(values->u_m));
  PetscCall(PetscFree(values->before_m));
  PetscCall(PetscFree(values->material_m));
  PetscCall(PetscFree(values->X_m));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The recovered stress at a mortar node, in cells of a material. [in] at - facet and node */
static const PetscReal *PairValuesStress_Private(const PairValues *values, PetscInt at, PetscInt material)
{
  PetscInt i = 0;

  while (values->material_m && values->material_m[at * values->most + i] != material) i++;
  return &values->stress_m[i][at * CELL_STRESSES];
}

/* What is there at a point of a pair. */
typedef struct {
  PetscReal x[3], normal[3], jump[3], traction[3], stress[2][CELL_STRESSES];
  PetscReal before[3]; /* the jump from which slip counts */
  PetscBool closed;    /* whether all vertices of the facet are in contact */
  PetscBool pushed;    /* whether any node of the facet has a pressure */
} PointState;

static void PointStateSet_Private(const Level *level, PairPoints points, const PairPoint *point,
                                  const PairValues *values, PointState *state)
{
  const PetscInt    dim = level->dim, *nodes = &points->facets.nodes[point->facet * F];
  const ElementType type     = points->facets.type[point->facet];
  const PetscInt    material = level->cell_material[points->facets.cell[point->facet]];
  PetscReal         phi[ELEMENT_MAX_NODES];

  *state = (PointState){.closed = PETSC_TRUE};
  for (PetscInt i = 0; i < ElementNumNodes(ElementLinear(type)); i++)
    state->closed = (PetscBool)(state->closed && StatusIsContact((PetscInt)values->status[2 * nodes[i]]));
  ElementShape(type, point->xi, phi, NULL);
  for (PetscInt i = 0; i < ElementNumNodes(type); i++) {
    for (PetscInt k = 0; k < dim; k++) {
      state->x[k] += phi[i] * level->coords[nodes[i] * dim + k];
      state->normal[k] += phi[i] * PetscRealPart(values->normal[nodes[i] * dim + k]);
      state->jump[k] += phi[i] * PetscRealPart(values->u[nodes[i] * dim + k]);
      if (values->before) state->before[k] += phi[i] * PetscRealPart(values->before[nodes[i] * dim + k]);
      state->traction[k] += phi[i] * PetscRealPart(values->traction[nodes[i] * dim + k]);
    }
    state->pushed = (PetscBool)(state->pushed || values->status[2 * nodes[i] + 1] != 0);
    for (PetscInt k = 0; k < CELL_STRESSES; k++)
      state->stress[0][k] += phi[i] * PetscRealPart(NodalStressAt(&values->stress, nodes[i], material)[k]);
  }
  FrameNormalize(dim, state->normal);
  if (point->mortar < 0) return;
  ElementShape(points->type[point->mortar], point->eta, phi, NULL);
  for (PetscInt i = 0; i < ElementNumNodes(points->type[point->mortar]); i++) {
    const PetscInt   at     = point->mortar * F + i;
    const PetscReal *stress = PairValuesStress_Private(values, at, points->material[point->mortar]);

    for (PetscInt k = 0; k < dim; k++) state->jump[k] -= phi[i] * values->u_m[at * dim + k];
    for (PetscInt k = 0; k < dim && values->before_m; k++) state->before[k] -= phi[i] * values->before_m[at * dim + k];
    for (PetscInt k = 0; k < CELL_STRESSES; k++) state->stress[1][k] += phi[i] * stress[k];
  }
  if (values->X_m) PairPointTakeArm(points, level, point, values->X_m, values->u_m, state->jump);
}

/* Squares of traction errors at a point, of both sides. */
typedef struct {
  PetscReal part[2];    /* (2/pi) (h/E') |s* n + lambda|^2 */
  PetscReal surplus[2]; /* how much of it the best common traction in place of lambda does not leave */
} TractionErrors;

/* [in] weight - (2/pi) (h/E') of both sides, 0 for that of an obstacle;
   [in] all - whether the pair transmits all of the traction, or the normal part */
static void EstimateGetTractionErrors_Private(PetscInt dim, const PointState *state, const PetscReal weight[2],
                                              PetscBool all, TractionErrors *errors)
{
  PetscReal error[2][CELL_MAX_DIM], jump = 0;

  for (PetscInt i = 0; i < 2; i++) {
    PetscReal normal;

    CellStressTraction(dim, state->stress[i], state->normal, error[i]);
    for (PetscInt k = 0; k < dim; k++) error[i][k] += state->traction[k];
    errors->part[i] = weight[i] * VectorDot(dim, error[i], error[i]);
    normal          = VectorDot(dim, error[i], state->normal);
    for (PetscInt k = 0; k < dim && !all; k++) error[i][k] = normal * state->normal[k];
    errors->surplus[i] = state->pushed ? weight[i] * VectorDot(dim, error[i], error[i]) : 0;
  }
  if (!state->pushed) return;
  for (PetscInt k = 0; k < dim; k++) jump += PetscSqr(error[0][k] - error[1][k]);
  for (PetscInt i = 0; i < 2; i++)
    errors->surplus[i] -= weight[i] * jump * PetscSqr(weight[1 - i] / (weight[0] + weight[1]));
}

/* Where the parts of pairs go. */
typedef struct {
  Compliance           *compliance; /* borrowed */
  PetscInt              first;      /* cell of this rank, counted over all ranks */
  Vec                   squares;    /* eta_T^2 of all cells */
  Vec                   surplus;    /* what of it is no part of eta^2 */
  PetscReal             signs;      /* L of this rank */
  const EstimateFrozen *frozen;     /* or NULL */
  Largest              *hidden;     /* of each pair, on this rank; NULL with a frozen set [num_pairs] */
} PairSums;

/* d^2 at a point. The pressure of a node in contact extends over facets beyond an edge. L has none where it
   could not close the gap. [in] resistance - pi E* / h */
static PetscReal EstimateGetGap_Private(const Fields fields, PetscInt p, const PairPoint *point,
                                        const PointState *state, PetscReal resistance, PairSums *sums)
{
  const PetscInt        dim      = fields->vi->level->dim;
  const Pair            pair     = fields->vi->pairs[p];
  const EstimateFrozen *frozen   = sums->frozen;
  const PetscReal       weight   = point->weight * fields->vi->scene->thickness;
  const PetscReal       pressure = VectorDot(dim, state->normal, state->traction);
  const PetscReal       motion   = frozen ? (*frozen->motion)(frozen->ctx, p, state->x) : 0;
  const PetscReal       depth    = VectorDot(dim, state->normal, state->jump) - (frozen ? motion : point->gap);
  PetscReal             squared  = 0;

  if (pair->spec->type == PAIR_TIED) {
    for (PetscInt k = 0; k < dim; k++) squared += PetscSqr(state->jump[k] - motion * state->normal[k]);
    sums->signs -= 2 * weight * VectorDot(dim, state->jump, state->traction);
    return squared;
  }
  if (depth > -PetscMax(0, pressure) / resistance) sums->signs -= 2 * weight * pressure * depth;
  if (frozen) return state->closed ? depth * depth : 0;
  if (!state->pushed) LargestTake(&sums->hidden[p], depth, dim, state->x, 0);
  return depth < 0 ? PetscSqr(PetscMin(-depth, PetscMax(0, pressure) / resistance)) : depth * depth;
}

/* What is left of the law of friction at a point, as a square of slip: |P(q + k s) - q|^2 / k^2, P onto |q|
   <= g. [in] resistance - k */
static PetscErrorCode EstimateGetSlip_Private(const Fields fields, PetscInt p, const PointState *state,
                                              PetscReal resistance, PetscReal *squared)
{
  const PetscInt   dim      = fields->vi->level->dim;
  const ScenePair *spec     = fields->vi->pairs[p]->spec;
  const PetscReal  pressure = VectorDot(dim, state->normal, state->traction),
                  depth     = VectorDot(dim, state->normal, state->jump) - VectorDot(dim, state->normal, state->before);
  PetscReal limit = 0, size = 0, kept, q[3], z[3];

  PetscFunctionBeginUser;
  *squared = 0;
  if (!ScenePairHasFriction(spec)) PetscFunctionReturn(PETSC_SUCCESS);
  if (spec->friction) PetscCall(ExpressionEvaluate(spec->friction, dim, state->x, &limit));
  limit *= PetscMax(pressure, 0);
  if (spec->bound) PetscCall(ExpressionEvaluate(spec->bound, dim, state->x, &limit));
  for (PetscInt k = 0; k < dim; k++) {
    q[k] = state->traction[k] - pressure * state->normal[k];
    z[k] = q[k] + resistance * (state->jump[k] - state->before[k] - depth * state->normal[k]);
    size += z[k] * z[k];
  }
  size = PetscSqrtReal(size);
  kept = size > limit ? limit / size : 1;
  for (PetscInt k = 0; k < dim; k++) *squared += PetscSqr((kept * z[k] - q[k]) / resistance);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds one point. [in] size - of its nonmortar facet */
static PetscErrorCode EstimateAddPoint_Private(Fields fields, PetscInt p, const PairPoint *point, PetscReal size,
                                               const PointState *state, PairSums *sums)
{
  const Level     *level  = fields->vi->level;
  const Pair       pair   = fields->vi->pairs[p];
  const PairPoints points = pair->points;
  const PetscReal  weight = point->weight * level->scene->thickness;
  const PetscInt   cell   = sums->first + points->facets.cell[point->facet];
  const PetscBool  all    = (PetscBool)(pair->spec->type == PAIR_TIED || ScenePairHasFriction(pair->spec));
  PetscReal        E[2], w[2] = {0, 0}, slip = 0;
  TractionErrors   errors;

  PetscFunctionBeginUser;
  PetscCall(ComplianceModulus(sums->compliance, level->cell_material[points->facets.cell[point->facet]], state->x,
                              state->normal, &E[0]));
  w[0] = weight * 2 / PETSC_PI * size / E[0];
  if (point->mortar >= 0) {
    PetscCall(ComplianceModulus(sums->compliance, points->material[point->mortar], state->x, state->normal, &E[1]));
    w[1] = weight * 2 / PETSC_PI * points->size[point->mortar] / E[1];
    E[0] = 1 / (1 / E[0] + 1 / E[1]);
  }
  EstimateGetTractionErrors_Private(level->dim, state, w, all, &errors);
  if (point->mortar >= 0) {
    PetscCall(VecSetValue(sums->squares, points->cell[point->mortar], errors.part[1], ADD_VALUES));
    PetscCall(VecSetValue(sums->surplus, points->cell[point->mortar], errors.surplus[1], ADD_VALUES));
  }
  E[0] *= PETSC_PI / size;
  if (!sums->frozen) PetscCall(EstimateGetSlip_Private(fields, p, state, E[0], &slip));
  errors.part[0] += weight * E[0] * (slip + EstimateGetGap_Private(fields, p, point, state, E[0], sums));
  PetscCall(VecSetValue(sums->squares, cell, errors.part[0], ADD_VALUES));
  PetscCall(VecSetValue(sums->surplus, cell, errors.surplus[0], ADD_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Status of the nodes of a side, and whether they have a pressure. The traction does not tell that: open
   nodes have roundoff, which removed nodes take from them. Collective. [out] status - two per node, ghosted,
   owned by the caller */
static PetscErrorCode EstimateCreateStatus_Private(Fields fields, PetscInt p, Vec *status)
{
  const PetscInt n = fields->vi->level->num_owned;
  PetscReal     *pushed;
  PetscBool     *covered;
  PairFields     nodal;
  PetscScalar   *a;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(fields->vi->level, 2, status));
  PetscCall(PairFieldsCreate(fields, p, &nodal));
  PetscCall(PetscMalloc2(n, &pushed, n, &covered));
  for (PetscInt i = 0; i < n; i++) {
    pushed[i]  = StatusIsContact(nodal.status[i]) || nodal.status[i] == STATUS_TIED;
    covered[i] = (PetscBool)(nodal.status[i] != STATUS_NONE);
  }
  PetscCall(PairFieldsSpread(fields->vi->pairs[p], pushed, covered));
  PetscCall(VecGetArray(*status, &a));
  for (PetscInt i = 0; i < n; i++) {
    a[2 * i]     = (PetscReal)nodal.status[i];
    a[2 * i + 1] = pushed[i];
  }
  PetscCall(VecRestoreArray(*status, &a));
  PetscCall(PetscFree2(pushed, covered));
  PetscCall(PairFieldsDestroy(&nodal));
  PetscCall(LevelShareVec(*status, INSERT_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds what an obstacle does between the points of a facet without pressure. [in] X - of the facet */
static PetscErrorCode EstimateAddHidden_Private(const Fields fields, PetscInt p, PetscInt f, const PetscReal X[],
                                                const PairValues *values, PairSums *sums)
{
  const Level     *level  = fields->vi->level;
  const PairPoints points = fields->vi->pairs[p]->points;
  const PetscInt   dim = level->dim, *nodes = &points->facets.nodes[f * F], cell = points->facets.cell[f];
  ObstacleFacet    facet = {.spec = fields->vi->pairs[p]->spec, .dim = dim, .type = points->facets.type[f]};
  PetscReal        x[3], normal[3], depth, squared, width, modulus, xi[2], weight, phi[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  if (points->rises) facet.rise = &points->rises[f * RISE_TERMS * dim];
  PetscCall(PetscArraycpy(facet.X, X, ElementNumNodes(facet.type) * dim));
  VectorGather(dim, ElementNumNodes(facet.type), nodes, values->u, facet.u);
  VectorGather(dim, ElementNumNodes(facet.type), nodes, values->normal, facet.normal);
  PetscCall(HiddenContactFind(&facet, x, &depth, &squared, &width));
  if (!(depth > HIDDEN_DEPTH * ElementLongestEdge(facet.type, dim, X))) PetscFunctionReturn(PETSC_SUCCESS);
  LargestTake(&sums->hidden[p], depth, dim, x, 0);
  (void)QuadratureRule(facet.type, 1, xi, &weight); // the point in the middle
  (void)ElementSurface(facet.type, X, xi, NULL, phi, normal);
  PetscCall(ComplianceModulus(sums->compliance, level->cell_material[cell], x, normal, &modulus));
  PetscCall(VecSetValue(sums->squares, sums->first + cell,
                        PETSC_PI * modulus / width * squared * SceneMeasure(level->scene, x), ADD_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds the points of one facet. [in] begin, end - of its points */
static PetscErrorCode EstimateAddFacet_Private(Fields fields, PetscInt p, PetscInt begin, PetscInt end,
                                               const PairValues *values, PairSums *sums)
{
  const Level     *level  = fields->vi->level;
  const Pair       pair   = fields->vi->pairs[p];
  const PairPoints points = pair->points;
  const PetscInt   f      = points->point[begin].facet;
  const PetscBool  open   = (PetscBool)(pair->spec->type == PAIR_CONTACT && sums->hidden);
  Largest          before = {.value = 0};
  PointState       state;
  PetscReal        X[3 * F], size;

  PetscFunctionBeginUser;
  if (open) {
    before          = sums->hidden[p];
    sums->hidden[p] = (Largest){.value = 0};
  }
  ContactFacetCoordinates(level, &points->facets, f, X);
  size = ElementLongestEdge(points->facets.type[f], level->dim, X);
  for (PetscInt q = begin; q < end; q++) {
    PointStateSet_Private(level, points, &points->point[q], values, &state);
    PetscCall(EstimateAddPoint_Private(fields, p, &points->point[q], size, &state, sums));
  }
  if (!open) PetscFunctionReturn(PETSC_SUCCESS);
  if (pair->spec->mortar.body < 0 && !state.pushed && sums->hidden[p].value == 0)
    PetscCall(EstimateAddHidden_Private(fields, p, f, X, values, sums));
  LargestTake(&sums->hidden[p], before.value, level->dim, before.at, 0);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds the points of one pair. Collective. */
static PetscErrorCode EstimateAddPair_Private(Fields fields, PetscInt p, PairSums *sums)
{
  const PairPoints    points = fields->vi->pairs[p]->points;
  PairValues          values = {NULL};
  const PetscBool     slips  = ScenePairHasFriction(fields->vi->pairs[p]->spec);
  Vec                 v[]    = {fields->u, NULL, points->normals, NULL, slips ? fields->vi->slip_from : NULL}, local[5];
  const PetscScalar **array[] = {&values.u, &values.traction, &values.normal, &values.status, &values.before};
  const PetscInt      num     = PETSC_STATIC_ARRAY_LENGTH(v);
  const Fields        judged  = sums->frozen ? sums->frozen->solution : fields;

  PetscFunctionBeginUser;
  PetscCall(PairTractionCreate(fields, p, judged->row_status, &v[1]));
  PetscCall(EstimateCreateStatus_Private(judged, p, &v[3]));
  PetscCall(PairValuesFetchMortar_Private(fields, fields->vi->pairs[p], &values));
  PetscCall(NodalStressGetArrays(&fields->stress, &values.stress));
  for (PetscInt i = 0; i < num; i++) {
    if (!v[i]) continue;
    PetscCall(VecGhostGetLocalForm(v[i], &local[i]));
    PetscCall(VecGetArrayRead(local[i], array[i]));
  }
  for (PetscInt begin = 0, end; begin < points->num; begin = end) { // facet after facet
    for (end = begin + 1; end < points->num && points->point[end].facet == points->point[begin].facet;) end++;
    PetscCall(EstimateAddFacet_Private(fields, p, begin, end, &values, sums));
  }
  for (PetscInt i = 0; i < num; i++) {
    if (!v[i]) continue;
    PetscCall(VecRestoreArrayRead(local[i], array[i]));
    PetscCall(VecGhostRestoreLocalForm(v[i], &local[i]));
  }
  PetscCall(NodalStressRestoreArrays(&fields->stress, &values.stress));
  PetscCall(PairValuesRestoreMortar_Private(&values));
  PetscCall(VecDestroy(&v[1]));
  PetscCall(VecDestroy(&v[3]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds this rank's part of a vector of cells, which is destroyed. Collective. [in,out] cell - [num_cells] */
static PetscErrorCode PairSumsTake_Private(Vec *squares, PetscInt num_cells, PetscReal cell[])
{
  const PetscScalar *square;

  PetscFunctionBeginUser;
  PetscCall(VecAssemblyBegin(*squares));
  PetscCall(VecAssemblyEnd(*squares));
  PetscCall(VecGetArrayRead(*squares, &square));
  for (PetscInt c = 0; c < num_cells; c++) cell[c] += PetscRealPart(square[c]);
  PetscCall(VecRestoreArrayRead(*squares, &square));
  PetscCall(VecDestroy(squares));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EstimatePairsAdd(Fields fields, const EstimateFrozen *frozen, Compliance *compliance, PetscReal cell[],
                                PetscReal surplus[], PetscReal *signs, Largest hidden[])
{
  const Level *level = fields->vi->level;
  PairSums     sums  = {.compliance = compliance, .frozen = frozen, .hidden = frozen ? NULL : hidden};

  PetscFunctionBeginUser;
  PetscCall(VecCreateMPI(level->comm, level->num_cells, PETSC_DETERMINE, &sums.squares));
  PetscCall(VecDuplicate(sums.squares, &sums.surplus));
  PetscCall(VecGetOwnershipRange(sums.squares, &sums.first, NULL));
  for (PetscInt p = 0; p < fields->vi->num_pairs; p++) PetscCall(EstimateAddPair_Private(fields, p, &sums));
  PetscCall(PairSumsTake_Private(&sums.squares, level->num_cells, cell));
  PetscCall(PairSumsTake_Private(&sums.surplus, level->num_cells, surplus));
  *signs = sums.signs;
  PetscFunctionReturn(PETSC_SUCCESS);
}

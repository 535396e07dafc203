/* setupcheck.c -- see the header. */
#include <math.h>
#include <string.h>
#include "base/compat.h"
#include "kernel/vector.h"
#include "checks/setupcheck.h"
#include "result/sidenodes.h"

enum {
  MARKED = 30,
  DEGREE = 3
}; /* sides that an integer of 32 bits can tell apart; added to twice the order of cells and facets */
/* Gaps below this part of the reach are rounding of positions. */
static const PetscReal ROUNDING = 1e-12;
/* Scaled Jacobians of the corners of an equilateral triangle and of a regular tetrahedron. */
static const PetscReal TRIANGLE_CORNER = 0.86602540378443865, TETRAHEDRON_CORNER = 0.70710678118654752;

/* The extreme of all ranks. Collective. [in] sign - -1 for the least; [in,out] extreme - the largest of sign
   times the value on this rank; the value, NAN for none */
static PetscErrorCode SetupExtremeReduce_Private(const Level *level, PetscReal sign, Largest *extreme)
{
  PetscFunctionBeginUser;
  PetscCall(LargestReduce(level->comm, level->dim, 1, extreme));
  extreme->value = extreme->value > -PETSC_MAX_REAL ? sign * extreme->value : NAN;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* --- bodies --------------------------------------------------------------------------------------------- */

/* Scaled Jacobian of a corner: |det| of the edges that leave it, over the product of their lengths and that
   of an ideal corner. */
static PetscReal SetupCornerShape_Private(ElementType linear, const PetscReal X[], PetscInt dim, PetscInt corner)
{
  PetscReal e[3][3] = {{0}}, lengths = 1, det;
  PetscInt  num = 0;

  for (PetscInt i = 0; i < ElementNumEdges(linear) && num < dim; i++) {
    const PetscInt *ends = ElementEdgeNodes(linear, i);

    if (ends[0] != corner && ends[1] != corner) continue;
    for (PetscInt k = 0; k < dim; k++) e[num][k] = X[ends[ends[0] == corner ? 1 : 0] * dim + k] - X[corner * dim + k];
    lengths *= VectorNorm(dim, e[num++]);
  }
  det = dim == 2 ? VectorCrossPlane(e[0], e[1]) : VectorTriple(e[0], e[1], e[2]);
  if (!(lengths > 0)) return 0;
  if (linear == ELEMENT_TRI3) lengths *= TRIANGLE_CORNER;
  if (linear == ELEMENT_TET4) lengths *= TETRAHEDRON_CORNER;
  return PetscAbsReal(det) / lengths;
}

PetscReal SetupCellVolume(Scene scene, const Level *level, PetscInt c)
{
  const PetscInt    dim   = level->dim;
  const ElementType type  = (ElementType)level->cell_type[c];
  const PetscInt   *nodes = &level->cell_nodes[level->cell_start[c]];
  PetscReal         X[3 * ELEMENT_MAX_NODES], points[3 * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS], volume = 0;
  const PetscInt    num =
      QuadratureRule(type, dim * ElementOrder(type) + SceneMeasureDegree(scene, ElementOrder(type)), points, w);

  VectorGather(dim, ElementNumNodes(type), nodes, level->coords, X);
  for (PetscInt q = 0; q < num; q++) {
    PetscReal       x[3], phi[ELEMENT_MAX_NODES];
    const PetscReal dx = w[q] * ElementMap(type, X, &points[q * dim], x, phi, NULL);

    volume += dx * SceneMeasure(scene, x);
  }
  return volume;
}

/* Volume and shape of one cell. */
static void SetupBodyAddCell_Private(VI vi, PetscInt c, SetupBody *body)
{
  const Level      *level  = vi->level;
  const PetscInt    dim    = level->dim;
  const ElementType type   = (ElementType)level->cell_type[c];
  const ElementType linear = ElementLinear(type);
  const PetscInt   *nodes  = &level->cell_nodes[level->cell_start[c]];
  PetscReal         X[3 * ELEMENT_MAX_NODES], middle[3] = {0, 0, 0};
  PetscReal         shape = 1;

  VectorGather(dim, ElementNumNodes(linear), nodes, level->coords, X);
  body->volume += SetupCellVolume(vi->scene, level, c);
  for (PetscInt i = 0; i < ElementNumNodes(linear); i++) {
    for (PetscInt k = 0; k < dim; k++) middle[k] += X[i * dim + k] / ElementNumNodes(linear);
    shape = PetscMin(shape, SetupCornerShape_Private(linear, X, dim, i));
  }
  LargestTake(&body->shape, -shape, dim, middle, 0);
  LargestTake(&body->aspect, ElementLongestEdge(linear, dim, X) / ElementShortestEdge(linear, dim, X), dim, middle, 0);
  body->cells++;
}

/* Box, loads and number of the nodes of this rank. */
static PetscErrorCode SetupBodiesAddNodes_Private(VI vi, SetupBody bodies[])
{
  const Level     *level = vi->level;
  const PetscInt   dim   = level->dim;
  const PetscReal *f;

  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(vi->f, &f));
  for (PetscInt a = 0; a < level->num_owned; a++) {
    SetupBody *body = &bodies[level->node_body[a]];
    PetscReal  x[3] = {0, 0, 0}, p[3] = {0, 0, 0}, moment[3];

    body->nodes++;
    for (PetscInt k = 0; k < dim; k++) {
      x[k]           = level->coords[a * dim + k];
      p[k]           = f[a * dim + k];
      body->lower[k] = PetscMin(body->lower[k], x[k]);
      body->upper[k] = PetscMax(body->upper[k], x[k]);
      body->force[k] += p[k];
    }
    VectorCross(x, p, moment);
    for (PetscInt k = 0; k < 3; k++) body->moment[k] += moment[k];
  }
  PetscCall(VecRestoreArrayRead(vi->f, &f));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sums and extremes of all ranks. Collective. */
static PetscErrorCode SetupBodyReduce_Private(VI vi, SetupBody *body)
{
  const MPI_Comm comm     = vi->level->comm;
  PetscInt       counts[] = {body->cells, body->nodes};
  PetscReal      sums[7]  = {body->volume,    body->force[0],  body->force[1], body->force[2],
                             body->moment[0], body->moment[1], body->moment[2]};

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, counts, 2, MPIU_INT, MPI_SUM, comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 7, MPIU_REAL, MPI_SUM, comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, body->lower, 3, MPIU_REAL, MPI_MIN, comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, body->upper, 3, MPIU_REAL, MPI_MAX, comm));
  PetscCall(SetupExtremeReduce_Private(vi->level, -1, &body->shape));
  PetscCall(SetupExtremeReduce_Private(vi->level, 1, &body->aspect));
  body->cells  = counts[0];
  body->nodes  = counts[1];
  body->volume = sums[0];
  for (PetscInt k = 0; k < 3; k++) {
    body->force[k]  = sums[1 + k];
    body->moment[k] = vi->scene->model == MODEL_AXISYMMETRIC ? NAN : sums[4 + k];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode SetupBodiesCompute_Private(VI vi, SetupBody bodies[])
{
  const RigidModes *modes = &vi->rigid_modes;

  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < vi->scene->num_bodies; b++) {
    bodies[b] = (SetupBody){.pieces = ComponentsOfBody(&modes->components, b),
                            .shape  = {.value = -PETSC_MAX_REAL},
                            .aspect = {.value = -PETSC_MAX_REAL}};
    for (PetscInt k = 0; k < 3; k++) {
      bodies[b].lower[k] = PETSC_MAX_REAL;
      bodies[b].upper[k] = -PETSC_MAX_REAL;
    }
  }
  for (PetscInt m = 0; m < modes->num; m++) bodies[modes->components.body[modes->component[m]]].motions++;
  for (PetscInt c = 0; c < vi->level->num_cells; c++) SetupBodyAddCell_Private(vi, c, &bodies[vi->level->cell_body[c]]);
  PetscCall(SetupBodiesAddNodes_Private(vi, bodies));
  for (PetscInt b = 0; b < vi->scene->num_bodies; b++) PetscCall(SetupBodyReduce_Private(vi, &bodies[b]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* --- sides ---------------------------------------------------------------------------------------------- */

static void SetupSideName_Private(SetupCheck *check, PetscInt body, const char side[], int role)
{
  for (PetscInt s = 0; s < check->num_sides; s++) {
    if (check->sides[s].body != body || strcmp(check->sides[s].side, side) != 0) continue;
    check->sides[s].roles |= role;
    return;
  }
  check->sides[check->num_sides++] = (SetupSide){.body = body, .side = side, .roles = role};
}

static int SetupSideRole_Private(BoundaryKind kind)
{
  switch (kind) {
  case BOUNDARY_DISPLACEMENT: return ROLE_DISPLACEMENT;
  case BOUNDARY_NORMAL: return ROLE_NORMAL;
  case BOUNDARY_PRESSURE: return ROLE_PRESSURE;
  case BOUNDARY_FORCE: return ROLE_FORCE;
  case BOUNDARY_MOMENT: return ROLE_MOMENT;
  default: return ROLE_TRACTION;
  }
}

/* All sides that the scene names. */
static PetscErrorCode SetupSidesList_Private(Scene scene, SetupCheck *check)
{
  PetscInt room = 2 * scene->num_pairs;

  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < scene->num_bodies; b++) room += scene->bodies[b].num_boundaries;
  PetscCall(PetscCalloc1(room, &check->sides));
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    const SceneBody *body = &scene->bodies[b];

    for (PetscInt i = 0; i < body->num_boundaries; i++)
      SetupSideName_Private(check, b, body->boundaries[i].side, SetupSideRole_Private(body->boundaries[i].kind));
    for (PetscInt p = 0; p < scene->num_pairs; p++) {
      const ScenePair *pair = &scene->pairs[p];

      if (pair->nonmortar.body == b) SetupSideName_Private(check, b, pair->nonmortar.side, ROLE_NONMORTAR);
      if (pair->mortar.body == b) SetupSideName_Private(check, b, pair->mortar.side, ROLE_MORTAR);
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Area, mean normal, mean point. Collective. */
static PetscErrorCode SetupSideCompute_Private(VI vi, SetupSide *side)
{
  const PetscInt dim     = vi->level->dim;
  PetscReal      sums[8] = {0}; /* area, area times normal, area times point, facets */
  Facets         facets;

  PetscFunctionBeginUser;
  PetscCall(LevelGetFacets(vi->level, vi->scene, side->body, side->side, &facets));
  for (PetscInt f = 0; f < facets.num; f++) {
    const ElementType type  = facets.type[f];
    const PetscInt   *nodes = &facets.nodes[f * ELEMENT_MAX_FACET_NODES], inner = ElementDim(type);
    PetscReal         X[3 * ELEMENT_MAX_FACET_NODES], points[3 * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS];
    const PetscInt    num = QuadratureRule(type, 2 * ElementOrder(type) + DEGREE, points, w);

    VectorGather(dim, ElementNumNodes(type), nodes, vi->level->coords, X);
    for (PetscInt q = 0; q < num; q++) {
      PetscReal x[3], nu[3], phi[ELEMENT_MAX_NODES];
      PetscReal dx = w[q] * ElementSurface(type, X, &points[q * inner], x, phi, nu);

      dx *= SceneMeasure(vi->scene, x);
      sums[0] += dx;
      for (PetscInt k = 0; k < dim; k++) {
        sums[1 + k] += dx * nu[k];
        sums[4 + k] += dx * x[k];
      }
    }
  }
  sums[7] = (PetscReal)facets.num;
  PetscCall(FacetsDestroy(&facets));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 8, MPIU_REAL, MPI_SUM, vi->level->comm));
  side->area   = sums[0];
  side->facets = (PetscInt)sums[7];
  for (PetscInt k = 0; k < 3; k++) {
    side->normal[k] = sums[1 + k] / sums[0];
    side->centre[k] = sums[4 + k] / sums[0];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SetupCheckMarkNodes(VI vi, const SetupCheck *check, PetscReal **bits)
{
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(vi->level->num_owned, bits));
  for (PetscInt s = 0; s < PetscMin(check->num_sides, MARKED); s++) {
    PetscInt num, *nodes;
    Facets   facets;

    PetscCall(LevelGetFacets(vi->level, vi->scene, check->sides[s].body, check->sides[s].side, &facets));
    PetscCall(SideNodesCreate(vi->level, &facets, &num, &nodes));
    for (PetscInt i = 0; i < num; i++) (*bits)[nodes[i]] += (PetscReal)(1 << s);
    PetscCall(PetscFree(nodes));
    PetscCall(FacetsDestroy(&facets));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* --- pairs ---------------------------------------------------------------------------------------------- */

static PetscErrorCode SetupPairCompute_Private(const Pair pair, SetupPair *setup)
{
  const Level *level = pair->level;

  PetscFunctionBeginUser;
  *setup = (SetupPair){.nodes       = pair->num_multipliers + pair->num_removed + pair->num_uncovered,
                       .facing      = pair->num_multipliers + pair->num_removed,
                       .multipliers = pair->num_multipliers,
                       .least       = {.value = -PETSC_MAX_REAL},
                       .largest     = {.value = -PETSC_MAX_REAL},
                       .reach       = pair->reach};
  for (PetscInt a = 0; a < pair->num; a++) {
    const PetscReal *x = &level->coords[pair->nodes[a] * level->dim], own = pair->gap[a] / pair->share[a];
    const PetscReal  gap = PetscAbsReal(own) > ROUNDING * pair->reach ? own : 0;

    LargestTake(&setup->least, -gap, level->dim, x, 0);
    LargestTake(&setup->largest, gap, level->dim, x, 0);
  }
  PetscCall(SetupExtremeReduce_Private(level, -1, &setup->least));
  PetscCall(SetupExtremeReduce_Private(level, 1, &setup->largest));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SetupCheckCompute(VI vi, SetupCheck *check)
{
  PetscFunctionBeginUser;
  *check = (SetupCheck){0};
  PetscCall(PetscMalloc2(vi->scene->num_bodies, &check->bodies, vi->num_pairs, &check->pairs));
  PetscCall(SetupBodiesCompute_Private(vi, check->bodies));
  PetscCall(SetupSidesList_Private(vi->scene, check));
  for (PetscInt s = 0; s < check->num_sides; s++) PetscCall(SetupSideCompute_Private(vi, &check->sides[s]));
  for (PetscInt p = 0; p < vi->num_pairs; p++) PetscCall(SetupPairCompute_Private(vi->pairs[p], &check->pairs[p]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SetupCheckDestroy(SetupCheck *check)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree2(check->bodies, check->pairs));
  PetscCall(PetscFree(check->sides));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* barfloors.c -- floors of error bars.

   Numbers may agree on several meshes by chance. Those of a stiff body do, since it has no part in the
   estimated error. The estimate gives their least error. Numbers that converge like the energy have the
   square of the relative error; local ones have the difference of two stresses or two pressures at the same
   place. */
#include "base/compat.h"
#include "contact/pairpoints.h"
#include "kernel/material.h"
#include "kernel/vector.h"
#include "problem/elasticity.h"
#include "result/barfloors.h"
#include "result/cellstress.h"
#include "result/compliance.h"
#include "result/knowntraction.h"
#include "result/pairsum.h"
#include "result/reactions.h"
#include "result/sideerrors.h"

enum { F = ELEMENT_MAX_FACET_NODES };

/* Measured (tests/bench/bars.md): with them 95 per cent of all bars hold. The factor of a body is larger:
   recovery finds half of the error of a body that is never refined, a quarter of its square. */
static const PetscReal WHOLE_FACTOR = 2, BODY_FACTOR = 6, LOCAL_FACTOR = 3;

/* Of the mean square error that unknown sides make of the potential. */
static const PetscReal SHAPE_FACTOR = 2;

/* Of LOCAL_FACTOR, where a part of the stress is known: the difference is an error, not an estimate. */
static const PetscReal KNOWN_SHARE = 0.5;

/* Of Dundurs' beta. Friction q along a half space changes the pressure that leaves it flat by beta times the
   Hilbert transform of q, which has the norm of q. */
static const PetscReal LARGEST_DUNDURS = 0.5;

/* Of LOCAL_FACTOR in cells at an axis of revolution, for displacements: nodes there have few and small rings
   around them, and errors of their own. Measured: bars 0.74 times the error without it, 1.4 with it. */
static const PetscReal AXIS_FACTOR = 2;

/* Of h max |e|, the largest error of a function of order 1 or 2 between two nodes at a distance h, if e is
   the error of its slope. */
static const PetscReal PLACE_FACTOR[] = {0.25, 0.1};

/* The relative error, squared; a body without strain energy has no error either. */
static PetscReal BarFloorsGetRelative_Private(PetscReal squared, PetscReal norm)
{
  return norm > 0 ? squared / norm : 0;
}

/* Sets pressure and whether it counts for the area. */
static void BarFloorsSetNode_Private(const PairFields *values, PetscInt i, PetscScalar a[])
{
  a[3 * i]     = values->pressure[i];
  a[3 * i + 1] = StatusIsContact(values->status[i]) || (values->status[i] == STATUS_TIED && values->pressure[i] > 0);
}

/* At the nodes of a side: pressure, whether it counts for the area, whether there is a multiplier.
   Collective. [out] nodal - ghosted, three per node */
static PetscErrorCode BarFloorsCreateNodal_Private(Fields fields, PetscInt p, Vec *nodal)
{
  const Pair   pair = fields->vi->pairs[p];
  PairFields   values;
  PetscScalar *a;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(fields->vi->level, 3, nodal));
  PetscCall(PairFieldsCreate(fields, p, &values));
  PetscCall(VecGetArray(*nodal, &a));
  for (PetscInt k = 0; k < pair->num; k++) {
    BarFloorsSetNode_Private(&values, pair->nodes[k], a);
    a[3 * pair->nodes[k] + 2] = 1;
  }
  for (PetscInt i = 0; i < pair->level->num_owned; i++)
    if (LevelNodeHangs(pair->level, i)) BarFloorsSetNode_Private(&values, i, a);
  PetscCall(VecRestoreArray(*nodal, &a));
  PetscCall(PairFieldsDestroy(&values));
  PetscCall(LevelShareVec(*nodal, INSERT_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The area of a facet, with the ring of an axisymmetric scene. */
static PetscReal BarFloorsGetArea_Private(const Scene scene, ElementType type, const PetscReal X[])
{
  PetscReal      xi[2 * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS], phi[ELEMENT_MAX_NODES], x[3], area = 0;
  const PetscInt num = QuadratureRule(type, 2, xi, w), dim = ElementDim(type);

  for (PetscInt q = 0; q < num; q++) {
    const PetscReal measure = ElementSurface(type, X, &xi[q * dim], x, phi, NULL);

    area += w[q] * measure * SceneMeasure(scene, x);
  }
  return area;
}

/* What is read at local nodes. */
typedef struct {
  const PetscScalar *nodal, *normal; /* of BarFloorsCreateNodal_Private(); directions of contact [dim] */
  const PetscScalar *traction;       /* [dim] */
  PetscBool          rubs;           /* whether friction acts along the side */
  NodalStressArrays  stress;
} SideValues;

/* How far stress and pressure at a node of a side are apart, with what the same difference of friction does
   to the pressure. [in] i - local node */
static PetscReal SideValuesGetDifference_Private(PetscInt dim, const SideValues *values, PetscInt i, PetscInt material)
{
  const PetscReal *normal = &values->normal[dim * i], *traction = &values->traction[dim * i];
  PetscReal        t[CELL_MAX_DIM], normal_part;

  CellStressTraction(dim, NodalStressAt(&values->stress, i, material), normal, t);
  normal_part = PetscRealPart(values->nodal[3 * i]) + VectorDot(dim, normal, t);
  if (!values->rubs) return PetscAbsReal(normal_part);
  for (PetscInt k = 0; k < dim; k++) t[k] += traction[k] - normal_part * normal[k];
  return PetscAbsReal(normal_part) + LARGEST_DUNDURS * VectorNorm(dim, t);
}

/* Takes a facet that contact ends on. [in] pressure - its mean */
static void BarFloorsAddEnd_Private(const Level *level, const Facets *facets, PetscInt f, PetscReal pressure,
                                    PairFloors *floors)
{
  const PetscInt dim = level->dim, n = ElementNumNodes(facets->type[f]);
  PetscReal      X[3 * F], area;

  ContactFacetCoordinates(level, facets, f, X);
  area = BarFloorsGetArea_Private(level->scene, facets->type[f], X);
  floors->area += area / 2;
  for (PetscInt k = 0; k < dim; k++) {
    PetscReal lower = X[k], upper = X[k];

    for (PetscInt i = 1; i < n; i++) {
      lower = PetscMin(lower, X[i * dim + k]);
      upper = PetscMax(upper, X[i * dim + k]);
    }
    floors->edge[k] = PetscMax(floors->edge[k], upper - lower);
    floors->centre[k] += pressure * area * (upper - lower) / 2;
  }
}

/* Takes one facet. [in] largest - pressure of the pair; [in,out] floors */
static void BarFloorsAddFacet_Private(const Level *level, const Facets *facets, PetscInt f, const SideValues *values,
                                      PetscReal largest, PairFloors *floors)
{
  const PetscInt material = level->cell_material[facets->cell[f]];
  const PetscInt n = ElementNumNodes(facets->type[f]), *nodes = &facets->nodes[f * F];
  PetscReal      difference = 0, pressure = 0;
  PetscBool      peak = PETSC_FALSE, open = PETSC_FALSE, closed = PETSC_FALSE;

  for (PetscInt i = 0; i < n; i++) {
    const PetscScalar *at = &values->nodal[3 * nodes[i]];

    peak   = (PetscBool)(peak || PetscRealPart(at[0]) >= largest);
    open   = (PetscBool)(open || at[1] == 0);
    closed = (PetscBool)(closed || at[1] != 0);
    pressure += PetscMax(0, PetscRealPart(at[0])) / n;
    if (at[2] == 0) continue; // others have no pressure to compare
    difference = PetscMax(difference, SideValuesGetDifference_Private(level->dim, values, nodes[i], material));
  }
  if (peak) floors->pressure = PetscMax(floors->pressure, LOCAL_FACTOR * difference);
  if (open && closed) BarFloorsAddEnd_Private(level, facets, f, pressure, floors);
}

/* Sums and maxima of all ranks. Collective. [in] force - of the pair */
static PetscErrorCode PairFloorsReduce_Private(MPI_Comm comm, PetscReal force, PairFloors *floors)
{
  PetscReal largest[4] = {floors->pressure, floors->edge[0], floors->edge[1], floors->edge[2]};
  PetscReal sums[4]    = {floors->area, floors->centre[0], floors->centre[1], floors->centre[2]};

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, largest, 4, MPIU_REAL, MPIU_MAX, comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPIU_REAL, MPI_SUM, comm));
  floors->pressure = largest[0];
  floors->area     = sums[0];
  for (PetscInt k = 0; k < 3; k++) {
    floors->edge[k]   = largest[1 + k];
    floors->centre[k] = force > 0 ? sums[1 + k] / force : 0;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode BarFloorsOfPair_Private(Fields fields, PetscInt p, PairFloors *floors)
{
  const Level     *level  = fields->vi->level;
  const PairPoints points = fields->vi->pairs[p]->points;
  Vec              nodal, traction, local[3];
  SideValues       values = {.rubs = ScenePairHasFriction(fields->vi->pairs[p]->spec)};
  PairSum          sum;

  PetscFunctionBeginUser;
  PetscCall(PairSumCompute(fields, p, &sum));
  PetscCall(BarFloorsCreateNodal_Private(fields, p, &nodal));
  PetscCall(PairTractionCreate(fields, p, fields->row_status, &traction));
  PetscCall(VecGhostGetLocalForm(traction, &local[2]));
  PetscCall(VecGetArrayRead(local[2], &values.traction));
  PetscCall(VecGhostGetLocalForm(nodal, &local[0]));
  PetscCall(VecGhostGetLocalForm(points->normals, &local[1]));
  PetscCall(VecGetArrayRead(local[0], &values.nodal));
  PetscCall(VecGetArrayRead(local[1], &values.normal));
  PetscCall(NodalStressGetArrays(&fields->stress, &values.stress));
  for (PetscInt f = 0; f < points->facets.num; f++)
    BarFloorsAddFacet_Private(level, &points->facets, f, &values, sum.max_pressure, floors);
  PetscCall(NodalStressRestoreArrays(&fields->stress, &values.stress));
  PetscCall(VecRestoreArrayRead(local[1], &values.normal));
  PetscCall(VecRestoreArrayRead(local[0], &values.nodal));
  PetscCall(VecGhostRestoreLocalForm(points->normals, &local[1]));
  PetscCall(VecGhostRestoreLocalForm(nodal, &local[0]));
  PetscCall(VecRestoreArrayRead(local[2], &values.traction));
  PetscCall(VecGhostRestoreLocalForm(traction, &local[2]));
  PetscCall(VecDestroy(&traction));
  PetscCall(VecDestroy(&nodal));
  PetscCall(PairFloorsReduce_Private(level->comm, sum.normal_force, floors));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Takes the difference of both stresses at a point. [in] error - s* - s, or its negative */
static void ProbeFloorsTake_Private(const PetscReal error[], ProbeFloors *floors)
{
  PetscReal principal[3];

  MaterialPrincipal(error, principal);
  floors->von_mises = PetscMax(floors->von_mises, LOCAL_FACTOR * MaterialVonMises(error));
  floors->principal =
      PetscMax(floors->principal, LOCAL_FACTOR * PetscMax(PetscAbsReal(principal[0]), PetscAbsReal(principal[2])));
  for (PetscInt k = 0; k < CELL_STRESSES; k++)
    floors->stress = PetscMax(floors->stress, LOCAL_FACTOR * PetscAbsReal(error[k]));
}

/* Whether a cell has a node on the axis of revolution. [in] n - nodes; [in] X - their places */
static PetscBool ProbeFloorsTouchAxis_Private(const Scene scene, PetscInt n, const PetscReal X[])
{
  if (scene->model != MODEL_AXISYMMETRIC) return PETSC_FALSE;
  for (PetscInt i = 0; i < n; i++)
    if (X[i * scene->dim] == 0) return PETSC_TRUE;
  return PETSC_FALSE;
}

/* Over the points of a cell. [in] at - place of the probe; u - local */
static PetscErrorCode ProbeFloorsOfCell_Private(const Level *level, PetscInt c, const PetscReal at[],
                                                const PetscScalar u[], const NodalStressArrays *recovered,
                                                Compliance *compliance, ProbeFloors *floors)
{
  const ElementType type  = (ElementType)level->cell_type[c];
  const PetscInt   *nodes = &level->cell_nodes[level->cell_start[c]], n = ElementNumNodes(type);
  ElementRule      *rules, *rule;
  CellStress        cell;
  PetscReal         error[CELL_STRESSES], det, factor = LOCAL_FACTOR;
  const PetscReal  *L;

  PetscFunctionBeginUser;
  PetscCall(ElasticityRulesCreate(level->scene, &rules));
  PetscCall(PetscNew(&rule));
  ElementRuleSet(type, 2 * ElementOrder(type), rule);
  PetscCall(CellStressSet(level->scene, level, c, &rules[type], u, &cell));
  PetscCall(ComplianceGet(compliance, cell.material, at, &L));
  if (ProbeFloorsTouchAxis_Private(level->scene, n, cell.X)) factor *= AXIS_FACTOR;
  for (PetscInt q = 0; q < rule->num; q++) {
    PetscCall(CellStressAtPoint(level->scene, &cell, rule, q, error, &det, NULL));
    for (PetscInt i = 0; i < n * CELL_STRESSES; i++)
      error[i % CELL_STRESSES] -=
          rule->phi[q * n + i / CELL_STRESSES] *
          PetscRealPart(NodalStressAt(recovered, nodes[i / CELL_STRESSES], cell.material)[i % CELL_STRESSES]);
    ProbeFloorsTake_Private(error, floors);
    floors->displacement = PetscMax(floors->displacement, factor * ComplianceStrain(compliance, L, error));
  }
  floors->displacement *= PLACE_FACTOR[ElementOrder(type) - 1] * ElementLongestEdge(type, level->dim, cell.X);
  PetscCall(PetscFree(rule));
  PetscCall(PetscFree(rules));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* On the surface at a probe. */
static void ProbeFloorsOfSurface_Private(const Level *level, const KnownTraction *known,
                                         const NodalStressArrays *recovered, ProbeFloors *floors)
{
  PetscReal error[CELL_STRESSES];

  for (PetscInt f = 0; f < known->facets.num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(known->facets.type[f]); i++) {
      KnownTractionGetError(known, level, recovered, f, i, error);
      for (PetscInt k = 0; k < CELL_STRESSES; k++) error[k] *= KNOWN_SHARE;
      ProbeFloorsTake_Private(error, floors);
    }
  }
}

/* Of the cell that holds a probe. Collective. [in,out] compliance */
static PetscErrorCode BarFloorsOfProbe_Private(Fields fields, const SceneProbe *probe, Compliance *compliance,
                                               ProbeFloors *floors)
{
  enum { NUMBERS = sizeof(ProbeFloors) / sizeof(PetscReal) };

  Level             *level = fields->vi->level;
  Vec                local;
  const PetscScalar *u;
  NodalStressArrays  recovered;
  KnownTraction      known;
  PetscInt           c;
  PetscReal          xi[3];
  PetscBool          found;

  PetscFunctionBeginUser;
  PetscCall(LevelLocate(level, probe->body, probe->at, &c, xi, &found));
  PetscCall(KnownTractionCreate(level, probe->body, probe->at, &known));
  PetscCall(VecGhostGetLocalForm(fields->u, &local));
  PetscCall(VecGetArrayRead(local, &u));
  PetscCall(NodalStressGetArrays(&fields->stress, &recovered));
  if (c >= 0) PetscCall(ProbeFloorsOfCell_Private(level, c, probe->at, u, &recovered, compliance, floors));
  ProbeFloorsOfSurface_Private(level, &known, &recovered, floors);
  PetscCall(KnownTractionDestroy(&known));
  PetscCall(NodalStressRestoreArrays(&fields->stress, &recovered));
  PetscCall(VecRestoreArrayRead(local, &u));
  PetscCall(VecGhostRestoreLocalForm(fields->u, &local));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, floors, NUMBERS, MPIU_REAL, MPIU_MAX, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Twice the strain energy per volume of u_r = r, free along the axis. [in] C - of rr, zz, hoop, rz */
static PetscReal BarFloorsGetRing_Private(const PetscReal C[])
{
  enum { RR, ZZ, HOOP, STRAINS = 4 };

  return C[RR * STRAINS + RR] + 2 * C[RR * STRAINS + HOOP] + C[HOOP * STRAINS + HOOP] -
         PetscSqr(C[RR * STRAINS + ZZ] + C[HOOP * STRAINS + ZZ]) / C[ZZ * STRAINS + ZZ];
}

/* Energy norms of bodies whose outer surface moves by one along the radius, and all else in proportion to r.
   Where a hole or a part of the body moves by one instead, the energy is alike: it does not depend on size in
   the plane across the axis. Collective. [out] ring - [num_bodies] */
static PetscErrorCode BarFloorsGetRings_Private(const Level *level, const PetscReal volume[], PetscReal ring[])
{
  const Scene    scene = level->scene;
  const PetscInt num   = scene->num_bodies;
  PetscReal     *radius, C[PetscSqr(COMPLIANCE_MAX_STRAINS)], poisson;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(ring, num));
  PetscCall(PetscCalloc1(num, &radius));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const PetscInt b = level->cell_body[c];

    for (PetscInt i = level->cell_start[c]; i < level->cell_start[c + 1]; i++)
      radius[b] = PetscMax(radius[b], level->coords[level->cell_nodes[i] * level->dim]);
    PetscCall(ElasticityHooke(scene, level->cell_material[c],
                              &level->coords[level->cell_nodes[level->cell_start[c]] * level->dim], C, &poisson));
    ring[b] += volume[c] * BarFloorsGetRing_Private(C);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, ring, (PetscMPIInt)num, MPIU_REAL, MPI_SUM, level->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, radius, (PetscMPIInt)num, MPIU_REAL, MPI_MAX, level->comm));
  for (PetscInt b = 0; b < num; b++) ring[b] = PetscSqrtReal(ring[b]) / radius[b];
  PetscCall(PetscFree(radius));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Of bodies and of their sides. Collective. [out] body - [num_bodies]; side - [boundaries of all bodies] */
static PetscErrorCode BarFloorsOfBodies_Private(Fields fields, Vec reactions, PetscReal body[], SideFloors side[])
{
  const Scene    scene = fields->vi->scene;
  const PetscInt dim   = scene->dim;
  PetscInt       next  = 0;
  PetscReal     *ring, *sums, *rests, potential;
  Estimate       estimate;

  PetscFunctionBeginUser;
  PetscCall(EstimateGet(fields, &estimate));
  PetscCall(FieldsEnergy(fields, body, &potential));
  PetscCall(PetscCalloc1(scene->num_bodies, &ring));
  if (scene->model == MODEL_AXISYMMETRIC)
    PetscCall(BarFloorsGetRings_Private(fields->vi->level, estimate->volume, ring));
  PetscCall(ReactionsCreate(scene, fields, reactions, &sums, &rests));
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    const PetscReal norm = 2 * body[b], relative = BarFloorsGetRelative_Private(estimate->body[b], norm);

    body[b] = BODY_FACTOR * relative;
    for (PetscInt i = 0; i < scene->bodies[b].num_boundaries; i++, next++) {
      side[next].relative = WHOLE_FACTOR * relative;
      for (PetscInt k = 0; k < dim; k++) side[next].least[k] = WHOLE_FACTOR * rests[next * dim + k];
      side[next].least[0] = PetscMax(side[next].least[0], WHOLE_FACTOR * relative * PetscSqrtReal(norm) * ring[b]);
    }
  }
  PetscCall(PetscFree(rests));
  PetscCall(PetscFree(sums));
  PetscCall(PetscFree(ring));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BarFloorsCreate(Fields fields, Vec reactions, BarFloors *floors)
{
  const Scene scene = fields->vi->scene;
  PetscInt    sides = 0;
  PetscReal   shape;
  SideErrors  side;
  Compliance  compliance;
  Estimate    estimate;

  PetscFunctionBeginUser;
  PetscCall(EstimateGet(fields, &estimate));
  for (PetscInt b = 0; b < scene->num_bodies; b++) sides += scene->bodies[b].num_boundaries;
  PetscCall(PetscCalloc4(scene->num_bodies, &floors->body, sides, &floors->side, scene->num_pairs, &floors->pair,
                         scene->num_probes, &floors->probe));
  floors->whole     = WHOLE_FACTOR * BarFloorsGetRelative_Private(estimate->squared, estimate->norm);
  floors->potential = 0;
  PetscCall(BarFloorsOfBodies_Private(fields, reactions, floors->body, floors->side));
  for (PetscInt p = 0; p < scene->num_pairs; p++) {
    PetscCall(BarFloorsOfPair_Private(fields, p, &floors->pair[p]));
    PetscCall(SideErrorsGet(fields, p, &side));
    floors->pair[p].pressure = PetscMax(floors->pair[p].pressure, LOCAL_FACTOR * side.largest);
    floors->potential += SHAPE_FACTOR * side.potential;
    PetscCall(FrictionFloorsCompute(fields, p, BODY_FACTOR / WHOLE_FACTOR * floors->whole, &floors->pair[p].friction));
  }
  shape = BarFloorsGetRelative_Private(floors->potential, estimate->norm / 2);
  floors->whole += shape;
  for (PetscInt b = 0; b < scene->num_bodies; b++) floors->body[b] += shape;
  PetscCall(ComplianceCreate(scene, &compliance));
  for (PetscInt i = 0; i < scene->num_probes; i++)
    PetscCall(BarFloorsOfProbe_Private(fields, &scene->probes[i], &compliance, &floors->probe[i]));
  PetscCall(ComplianceDestroy(&compliance));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BarFloorsDestroy(BarFloors *floors)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree4(floors->body, floors->side, floors->pair, floors->probe));
  PetscFunctionReturn(PETSC_SUCCESS);
}

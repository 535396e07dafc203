/* edgeexponent.c -- the edge nearest the largest pressure, and the wedge that its body is there.

   Each side has corners: its ends, and vertices where its body has a visible angle. All ranks know all of
   them. The pressure is unbounded at an end of one side if no corner of the other side is near it. */
#include "result/edgeexponent.h"
#include "base/compat.h"
#include "kernel/vector.h"
#include "kernel/wedge.h"
#include "level/ghosted.h"
#include "side/sidemeasure.h"
#include "result/sidecorners.h"

enum { F = ELEMENT_MAX_FACET_NODES, DIM = 2 };

/* Angles that differ less from a straight line are those of facets along a curve: 20 degrees. */
static const PetscReal NEARLY_STRAIGHT = 0.35;
/* The peak is at the end of its own side if it is so near, relative to its facets; near the end of the other
   side, if it is a vertex of the facet in front of it. */
static const PetscReal EDGE_SAME = 1e-6, EDGE_FACING = 1.01;
/* Corners of the other side are as far from the edge as this part of the facets. */
static const PetscReal EDGE_APART = 0.1;
/* Ratio of moduli of a body and a rigid partner. */
static const PetscReal RIGID = 1e-12;

/* A corner of a side. */
typedef struct {
  PetscReal x[DIM], angle, end, busy; /* 1 or 0: the side ends; it is loaded, held, or in another pair */
} Corner;

typedef struct {
  PetscInt num;
  Corner  *corner;
} Corners;

/* Marks the nodes of a side. [in,out] marks - ghosted */
static PetscErrorCode MarkSide_Private(Fields fields, PetscInt body, const char side[], Vec marks)
{
  Level       *level = fields->vi->level;
  Facets       facets;
  PetscScalar *mark;

  PetscFunctionBeginUser;
  PetscCall(LevelGetFacets(level, fields->vi->scene, body, side, &facets));
  PetscCall(GhostedGetArray(marks, &mark));
  for (PetscInt i = 0; i < DIM * facets.num; i++) mark[facets.nodes[i / DIM * F + i % DIM]] = 1;
  PetscCall(GhostedRestoreArray(marks, &mark));
  PetscCall(FacetsDestroy(&facets));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Nodes that data or other pairs act on. Collective. [out] busy - ghosted, 1 there, owned by the caller */
static PetscErrorCode EdgeExponentFindBusy_Private(Fields fields, PetscInt p, Vec *busy)
{
  const VI     vi    = fields->vi;
  const Scene  scene = vi->scene;
  PetscScalar *mark;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(vi->level, 1, busy));
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    for (PetscInt i = 0; i < scene->bodies[b].num_boundaries; i++)
      PetscCall(MarkSide_Private(fields, b, scene->bodies[b].boundaries[i].side, *busy));
  }
  for (PetscInt q = 0; q < scene->num_pairs; q++) {
    const ScenePair *spec = &scene->pairs[q];

    if (q == p) continue;
    PetscCall(MarkSide_Private(fields, spec->nonmortar.body, spec->nonmortar.side, *busy));
    if (spec->mortar.body >= 0) PetscCall(MarkSide_Private(fields, spec->mortar.body, spec->mortar.side, *busy));
  }
  PetscCall(LevelShareVec(*busy, MAX_VALUES));
  PetscCall(VecGetArray(*busy, &mark));
  for (PetscInt a = 0; a < vi->level->num_owned; a++)
    if (vi->support.count[a]) mark[a] = 1;
  PetscCall(VecRestoreArray(*busy, &mark));
  PetscCall(LevelShareVec(*busy, INSERT_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Gathers the corners of a side from all ranks; one on several ranks is there several times. Collective.
   [in] busy - of EdgeExponentFindBusy_Private(); [out] corners - owned by the caller */
static PetscErrorCode CornersCreate_Private(Fields fields, const SceneSide *side, Vec busy, Corners *corners)
{
  Level             *level = fields->vi->level;
  Vec                ways, angles;
  const PetscScalar *way, *angle, *mark;
  Facets             facets;
  Corner            *own;
  PetscMPIInt        size, num = 0, *counts, *begins;
  const PetscMPIInt  reals = sizeof(Corner) / sizeof(PetscReal);

  PetscFunctionBeginUser;
  PetscCall(LevelGetFacets(level, fields->vi->scene, side->body, side->side, &facets));
  PetscCall(SideCornersGetEnds(level, &facets, &ways));
  PetscCall(SideCornersGetAngles(level, side->body, &angles));
  PetscCall(GhostedGetArrayRead(ways, &way));
  PetscCall(GhostedGetArrayRead(angles, &angle));
  PetscCall(GhostedGetArrayRead(busy, &mark));
  PetscCall(PetscMalloc1(DIM * facets.num, &own));
  for (PetscInt i = 0; i < DIM * facets.num; i++) {
    const PetscInt  node = facets.nodes[i / DIM * F + i % DIM];
    const PetscBool end  = (PetscBool)(PetscRealPart(way[DIM * node]) != 0);

    if (!end && PetscAbsReal(PetscRealPart(angle[node]) - PETSC_PI) < NEARLY_STRAIGHT) continue;
    own[num] = (Corner){.angle = PetscRealPart(angle[node]), .end = end, .busy = PetscRealPart(mark[node])};
    PetscCall(PetscArraycpy(own[num++].x, &level->coords[DIM * node], DIM));
  }
  PetscCall(GhostedRestoreArrayRead(busy, &mark));
  PetscCall(GhostedRestoreArrayRead(angles, &angle));
  PetscCall(GhostedRestoreArrayRead(ways, &way));
  PetscCall(VecDestroy(&angles));
  PetscCall(VecDestroy(&ways));
  PetscCall(FacetsDestroy(&facets));
  PetscCallMPI(MPI_Comm_size(level->comm, &size));
  PetscCall(PetscMalloc2(size, &counts, size + 1, &begins));
  num *= reals;
  PetscCallMPI(MPI_Allgather(&num, 1, MPI_INT, counts, 1, MPI_INT, level->comm));
  begins[0] = 0;
  for (PetscMPIInt r = 0; r < size; r++) begins[r + 1] = begins[r] + counts[r];
  corners->num = begins[size] / reals;
  PetscCall(PetscMalloc1(corners->num, &corners->corner));
  PetscCallMPI(MPI_Allgatherv(own, num, MPIU_REAL, corners->corner, counts, begins, MPIU_REAL, level->comm));
  PetscCall(PetscFree2(counts, begins));
  PetscCall(PetscFree(own));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscReal DistanceOf_Private(const PetscReal a[], const PetscReal b[])
{
  const PetscReal d[DIM] = {a[0] - b[0], a[1] - b[1]};

  return VectorNorm(DIM, d);
}

/* The nearest corner; NULL without one. */
static const Corner *CornersFindNearest_Private(const Corners *corners, const PetscReal x[])
{
  const Corner *found = NULL;

  for (PetscInt i = 0; i < corners->num; i++) {
    const Corner *corner = &corners->corner[i];

    if (!found || DistanceOf_Private(corner->x, x) < DistanceOf_Private(found->x, x)) found = corner;
  }
  return found;
}

/* Finds the edge at the peak: the end of one side. [in] corners - of the nonmortar and the mortar side [2];
   [out] which - index of its side; NULL is returned where there is none, or more than one */
static const Corner *EdgeExponentFindEdge_Private(const Corners corners[], const PetscReal peak[], PetscReal size,
                                                  PetscInt *which)
{
  const Corner   *near[2] = {CornersFindNearest_Private(&corners[0], peak),
                             CornersFindNearest_Private(&corners[1], peak)};
  const PetscBool own     = (PetscBool)(near[0] && DistanceOf_Private(near[0]->x, peak) <= EDGE_SAME * size);
  const Corner   *edge, *other;

  *which = own ? 0 : 1;
  edge   = near[*which];
  if (!edge || !(edge->end > 0) || edge->busy > 0 || edge->angle > PETSC_PI - NEARLY_STRAIGHT) return NULL;
  if (!own && DistanceOf_Private(edge->x, peak) > EDGE_FACING * size) return NULL;
  other = CornersFindNearest_Private(&corners[1 - *which], edge->x);
  return other && DistanceOf_Private(other->x, edge->x) < (own ? EDGE_FACING : EDGE_APART) * size ? NULL : edge;
}

/* Whether data or other pairs act on a side within a distance of a point. Collective. */
static PetscErrorCode SideIsBusy_Private(Fields fields, const SceneSide *side, Vec busy, const PetscReal x[],
                                         PetscReal distance, PetscBool *found)
{
  Level             *level = fields->vi->level;
  const PetscScalar *mark;
  Facets             facets;

  PetscFunctionBeginUser;
  *found = PETSC_FALSE;
  PetscCall(LevelGetFacets(level, fields->vi->scene, side->body, side->side, &facets));
  PetscCall(GhostedGetArrayRead(busy, &mark));
  for (PetscInt f = 0; f < facets.num; f++) {
    const PetscInt *nodes = &facets.nodes[f * F];
    const PetscReal size  = DistanceOf_Private(&level->coords[DIM * nodes[0]], &level->coords[DIM * nodes[1]]);

    if (DistanceOf_Private(&level->coords[DIM * nodes[0]], x) > distance + size) continue;
    if (PetscRealPart(mark[nodes[0]]) > 0 || PetscRealPart(mark[nodes[1]]) > 0) *found = PETSC_TRUE;
  }
  PetscCall(GhostedRestoreArrayRead(busy, &mark));
  PetscCall(FacetsDestroy(&facets));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, found, 1, MPIU_BOOL, MPI_MAX, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the wedge of the pair is that of eq. [1] of wedge.c. */
static PetscBool EdgeExponentApplies_Private(const Scene scene, const ScenePair *spec)
{
  const PetscInt bodies[2] = {spec->nonmortar.body, spec->mortar.body};

  if (scene->dim != DIM || spec->type != PAIR_CONTACT || ScenePairHasFriction(spec)) return PETSC_FALSE;
  if (spec->gap || spec->obstacle.kind == OBSTACLE_EXPRESSION) return PETSC_FALSE;
  if (spec->gap_offset && !ExpressionIsConstant(spec->gap_offset)) return PETSC_FALSE;
  for (PetscInt i = 0; i < 2 && bodies[i] >= 0; i++) {
    if (scene->bodies[bodies[i]].material.stiffness || scene->bodies[bodies[i]].num_regions) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

/* The exponent of the wedge at an edge of a side. Collective. [in] which - index of the side */
static PetscErrorCode EdgeExponentOfWedge_Private(Fields fields, const SceneSide *const side[], PetscInt which,
                                                  PetscReal angle, PetscReal *exponent)
{
  const VI    vi    = fields->vi;
  PetscReal   ratio = RIGID;
  SideMeasure measure[2];

  PetscFunctionBeginUser;
  if (side[1]->body >= 0) {
    for (PetscInt i = 0; i < 2; i++) PetscCall(SideMeasureCompute(vi->scene, vi->level, side[i], &measure[i]));
    ratio = measure[which].modulus / measure[1 - which].modulus;
  }
  *exponent = WedgeExponent(angle, ratio);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EdgeExponentGet(Fields fields, PetscInt p, const PairSum *sum, PetscReal size, PetscReal *exponent)
{
  const ScenePair       *spec       = fields->vi->pairs[p]->spec;
  const SceneSide *const side[2]    = {&spec->nonmortar, &spec->mortar};
  Corners                corners[2] = {{0}, {0}};
  const Corner          *edge;
  PetscBool              loaded = PETSC_FALSE;
  PetscInt               which;
  Vec                    busy;

  PetscFunctionBeginUser;
  *exponent = 0;
  if (!(sum->max_pressure > 0) || !EdgeExponentApplies_Private(fields->vi->scene, spec))
    PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(EdgeExponentFindBusy_Private(fields, p, &busy));
  for (PetscInt i = 0; i < 2 && side[i]->body >= 0; i++)
    PetscCall(CornersCreate_Private(fields, side[i], busy, &corners[i]));
  edge = EdgeExponentFindEdge_Private(corners, sum->max_pressure_at, size, &which);
  if (edge && side[1 - which]->body >= 0)
    PetscCall(SideIsBusy_Private(fields, side[1 - which], busy, edge->x, size, &loaded));
  if (edge && !loaded) PetscCall(EdgeExponentOfWedge_Private(fields, side, which, edge->angle, exponent));
  for (PetscInt i = 0; i < 2; i++) PetscCall(PetscFree(corners[i].corner));
  PetscCall(VecDestroy(&busy));
  PetscFunctionReturn(PETSC_SUCCESS);
}

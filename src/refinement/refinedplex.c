/* refinedplex.c -- labels, points of other ranks and positions of a refined DMPlex. */
#include "level/plexpoints.h"
#include "refinement/refinement.h"
#include "base/compat.h"
#include <petscsf.h>

/* The parts of some points, ascending. */
static PetscErrorCode PointsGetParts_Private(const Refinement *refinement, IS points, IS *parts)
{
  const PetscInt *list;
  PetscInt        num, total = 0, *all, num_types, first[REFINEMENT_PRODUCTS], each[REFINEMENT_PRODUCTS];

  PetscFunctionBeginUser;
  PetscCall(ISGetLocalSize(points, &num));
  PetscCall(ISGetIndices(points, &list));
  for (PetscInt i = 0; i < num; i++) {
    RefinementGetParts(refinement, list[i], &num_types, first, each);
    for (PetscInt t = 0; t < num_types; t++) total += each[t];
  }
  PetscCall(PetscMalloc1(total, &all));
  total = 0;
  for (PetscInt i = 0; i < num; i++) {
    RefinementGetParts(refinement, list[i], &num_types, first, each);
    for (PetscInt t = 0; t < num_types; t++)
      for (PetscInt k = 0; k < each[t]; k++) all[total++] = first[t] + k;
  }
  PetscCall(ISRestoreIndices(points, &list));
  PetscCall(PetscSortInt(total, all));
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, total, all, PETSC_OWN_POINTER, parts));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A label has the parts of the points that it had. */
static PetscErrorCode LabelRefine_Private(const Refinement *refinement, DMLabel coarse, DMLabel fine)
{
  const PetscInt *values;
  PetscInt        num, none;
  IS              is;

  PetscFunctionBeginUser;
  PetscCall(DMLabelGetDefaultValue(coarse, &none));
  PetscCall(DMLabelSetDefaultValue(fine, none));
  PetscCall(DMLabelGetValueIS(coarse, &is));
  PetscCall(ISGetLocalSize(is, &num));
  PetscCall(ISGetIndices(is, &values));
  for (PetscInt i = 0; i < num; i++) {
    IS points, parts;

    PetscCall(DMLabelAddStratum(fine, values[i]));
    PetscCall(DMLabelGetStratumIS(coarse, values[i], &points));
    if (!points) continue;
    PetscCall(PointsGetParts_Private(refinement, points, &parts));
    PetscCall(DMLabelSetStratumIS(fine, values[i], parts));
    PetscCall(ISDestroy(&parts));
    PetscCall(ISDestroy(&points));
  }
  PetscCall(ISRestoreIndices(is, &values));
  PetscCall(ISDestroy(&is));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RefinementSetLabels(const Refinement *refinement, DM coarse, DM fine)
{
  PetscInt num;

  PetscFunctionBeginUser;
  PetscCall(DMGetNumLabels(coarse, &num));
  for (PetscInt i = 0; i < num; i++) {
    const char *name;
    DMLabel     from, to;
    PetscBool   depth, type;

    PetscCall(DMGetLabelName(coarse, i, &name));
    PetscCall(PetscStrcmp(name, "depth", &depth));
    PetscCall(PetscStrcmp(name, "celltype", &type));
    if (depth || type) continue;
    PetscCall(DMCreateLabel(fine, name));
    PetscCall(DMGetLabel(coarse, name, &from));
    PetscCall(DMGetLabel(fine, name, &to));
    PetscCall(LabelRefine_Private(refinement, from, to));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Points of other ranks. */
typedef struct {
  PetscInt     num, *point; /* [num] */
  PetscSFNode *remote;      /* the same ones there [num] */
} Leaves;

static PetscErrorCode LeavesAllocate_Private(PetscInt num, Leaves *leaves)
{
  PetscFunctionBeginUser;
  leaves->num = 0;
  PetscCall(PetscMalloc1(num, &leaves->point));
  PetscCall(PetscMalloc1(num, &leaves->remote));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The parts of the leaves of the coarse DM.
   [in] first - of the parts on their owner, by coarse points [chart][REFINEMENT_PRODUCTS] */
static PetscErrorCode LeavesCreate_Private(const Refinement *refinement, PetscSF coarse, const PetscInt first[],
                                           Leaves *leaves)
{
  PetscInt           num, num_types, own[REFINEMENT_PRODUCTS], parts[REFINEMENT_PRODUCTS], total = 0;
  const PetscInt    *list;
  const PetscSFNode *nodes;

  PetscFunctionBeginUser;
  PetscCall(PetscSFGetGraph(coarse, NULL, &num, &list, &nodes));
  for (PetscInt l = 0; l < num; l++) {
    RefinementGetParts(refinement, list ? list[l] : l, &num_types, own, parts);
    for (PetscInt t = 0; t < num_types; t++) total += parts[t];
  }
  PetscCall(LeavesAllocate_Private(total, leaves));
  for (PetscInt l = 0; l < num; l++) {
    const PetscInt p = list ? list[l] : l;

    RefinementGetParts(refinement, p, &num_types, own, parts);
    for (PetscInt t = 0; t < num_types; t++) {
      for (PetscInt k = 0; k < parts[t]; k++) {
        const PetscSFNode there = {.rank = nodes[l].rank, .index = first[p * REFINEMENT_PRODUCTS + t] + k};

        leaves->point[leaves->num]    = own[t] + k;
        leaves->remote[leaves->num++] = there;
      }
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sorts them: DMPlex searches among them. */
static PetscErrorCode LeavesSort_Private(Leaves *leaves)
{
  Leaves    sorted;
  PetscInt *order;

  PetscFunctionBeginUser;
  PetscCall(LeavesAllocate_Private(leaves->num, &sorted));
  PetscCall(PetscMalloc1(leaves->num, &order));
  for (PetscInt i = 0; i < leaves->num; i++) order[i] = i;
  PetscCall(PetscSortIntWithPermutation(leaves->num, leaves->point, order));
  for (; sorted.num < leaves->num; sorted.num++) {
    sorted.point[sorted.num]  = leaves->point[order[sorted.num]];
    sorted.remote[sorted.num] = leaves->remote[order[sorted.num]];
  }
  PetscCall(PetscFree(order));
  PetscCall(PetscFree(leaves->point));
  PetscCall(PetscFree(leaves->remote));
  *leaves = sorted;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Common points have the same cones on all ranks, and so the same order of their parts. */
PetscErrorCode RefinementSetPointSF(const Refinement *refinement, DM coarse, DM fine)
{
  PetscSF      sf, refined;
  PetscInt     num_roots, begin, end, *first, num_types, parts[REFINEMENT_PRODUCTS];
  MPI_Datatype unit;
  Leaves       leaves;

  PetscFunctionBeginUser;
  PetscCall(DMGetPointSF(coarse, &sf));
  PetscCall(DMGetPointSF(fine, &refined));
  PetscCall(PetscSFGetGraph(sf, &num_roots, NULL, NULL, NULL));
  if (num_roots < 0) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(DMPlexGetChart(coarse, &begin, &end));
  PetscCall(PetscCalloc1(end * REFINEMENT_PRODUCTS, &first));
  for (PetscInt p = begin; p < end; p++)
    RefinementGetParts(refinement, p, &num_types, &first[p * REFINEMENT_PRODUCTS], parts);
  PetscCallMPI(MPI_Type_contiguous(REFINEMENT_PRODUCTS, MPIU_INT, &unit));
  PetscCallMPI(MPI_Type_commit(&unit));
  PetscCall(PetscSFBcastBegin(sf, unit, first, first, MPI_REPLACE));
  PetscCall(PetscSFBcastEnd(sf, unit, first, first, MPI_REPLACE));
  PetscCallMPI(MPI_Type_free(&unit));
  PetscCall(LeavesCreate_Private(refinement, sf, first, &leaves));
  PetscCall(LeavesSort_Private(&leaves));
  PetscCall(DMPlexGetChart(fine, &begin, &end));
  PetscCall(PetscSFSetGraph(refined, end - begin, leaves.num, leaves.point, PETSC_OWN_POINTER, leaves.remote,
                            PETSC_OWN_POINTER));
  PetscCall(PetscFree(first));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Positions of the vertices of a refined DM: means over those of the points that they are parts of.
   [in] from - of the coarse vertices, x - room for the fine ones */
static PetscErrorCode RefinementGetCoords_Private(const Refinement *refinement, DM coarse, DM fine, PetscInt dim,
                                                  const PetscScalar from[], PetscScalar x[])
{
  PetscInt begin, end, coarse_begin, num, vertices[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetDepthStratum(coarse, 0, &coarse_begin, NULL));
  PetscCall(DMPlexGetDepthStratum(fine, 0, &begin, &end));
  for (PetscInt v = begin; v < end; v++) {
    PetscCall(PointGetVertices(coarse, RefinementGetSource(refinement, v, NULL), &num, vertices));
    for (PetscInt d = 0; d < dim; d++) {
      PetscScalar sum = 0;

      for (PetscInt i = 0; i < num; i++) sum += from[(vertices[i] - coarse_begin) * dim + d];
      x[(v - begin) * dim + d] = sum / (PetscReal)num;
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RefinementSetCoords(const Refinement *refinement, DM coarse, DM fine)
{
  const PetscScalar *old;
  PetscScalar       *x;
  PetscInt           dim;
  Vec                from, to;

  PetscFunctionBeginUser;
  PetscCall(DMGetCoordinateDim(coarse, &dim));
  PetscCall(DMGetCoordinatesLocal(coarse, &from));
  PetscCall(PlexCreateCoords(fine, dim, &to));
  PetscCall(VecGetArrayRead(from, &old));
  PetscCall(VecGetArray(to, &x));
  PetscCall(RefinementGetCoords_Private(refinement, coarse, fine, dim, old, x));
  PetscCall(VecRestoreArray(to, &x));
  PetscCall(VecRestoreArrayRead(from, &old));
  PetscCall(DMSetCoordinatesLocal(fine, to));
  PetscCall(VecDestroy(&to));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* initialoverlap.c -- bodies that initially overlap by more than the search radius.

   A node deep inside the other body would have no contact: its ray finds no partner within the reach, or a
   wrong gap. So nodes are searched in the cells of the partner: those inside it and far from its side are too
   deep. */
#include "kernel/boxtree.h"
#include "base/compat.h"
#include "side/insidebody.h"
#include "contact/contactfacet.h"
#include "contact/initialoverlap.h"

/* A node counts if points around it, at this share of the reach, are inside as well. This omits the small
   overlaps of polygons and of interference fits. The reach is at least three facets. */
static const PetscReal OVERLAP_MARGIN = 1. / 3;

enum { MAX_PROBES = 7 }; /* around a node: itself, and two points along each axis */

/* Copies x of each node of the facets that lies in a box, once on this rank.
   [out] x - [*num][dim], room for all */
static PetscErrorCode InitialOverlapCollectNodes_Private(const Level *level, const Facets *facets,
                                                         const PetscReal box[], PetscInt *num, PetscReal x[])
{
  const PetscInt dim   = level->dim;
  PetscInt       total = 0, *nodes;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(facets->num * ELEMENT_MAX_FACET_NODES, &nodes));
  for (PetscInt f = 0; f < facets->num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); i++)
      nodes[total++] = facets->nodes[f * ELEMENT_MAX_FACET_NODES + i];
  }
  PetscCall(PetscSortRemoveDupsInt(&total, nodes));
  *num = 0;
  for (PetscInt i = 0; i < total; i++) {
    const PetscReal *at     = &level->coords[nodes[i] * dim];
    PetscBool        within = PETSC_TRUE;

    for (PetscInt k = 0; k < dim; k++) within = (PetscBool)(within && box[k] < at[k] && at[k] < box[dim + k]);
    if (within) PetscCall(PetscArraycpy(&x[dim * (*num)++], at, dim));
  }
  PetscCall(PetscFree(nodes));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The nodes of a side in a box, on all ranks. Collective. */
static PetscErrorCode InitialOverlapFindSuspects_Private(const Level *level, const Facets *facets,
                                                         const PetscReal box[], GatheredPoints *suspects)
{
  PetscReal *mine;
  PetscInt   num = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(facets->num * ELEMENT_MAX_FACET_NODES * level->dim, &mine));
  PetscCall(InitialOverlapCollectNodes_Private(level, facets, box, &num, mine));
  PetscCall(GatheredPointsCreate(level, num, mine, suspects));
  PetscCall(PetscFree(mine));
  for (PetscInt i = 0; i < suspects->num; i++) suspects->flag[i] = PETSC_TRUE; // deep, until shown otherwise
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Removes the suspects that have the side of the other body within reach. Collective. */
static PetscErrorCode InitialOverlapRemoveNear_Private(const Level *level, const Facets *side, PetscReal reach,
                                                       GatheredPoints *suspects)
{
  const PetscInt  dim = level->dim;
  PetscReal       X[ELEMENT_MAX_FACET_NODES * 3], query[6], *boxes;
  const PetscInt *hits;
  PetscInt        num;
  BoxTree         tree;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(2 * dim * side->num, &boxes));
  for (PetscInt f = 0; f < side->num; f++) {
    ContactFacetCoordinates(level, side, f, X);
    ContactFacetBox(dim, side->type[f], X, &boxes[2 * dim * f]);
  }
  PetscCall(BoxTreeCreate(dim, side->num, boxes, &tree));
  for (PetscInt i = 0; i < suspects->num; i++) {
    for (PetscInt k = 0; k < dim; k++) {
      query[k]       = suspects->x[i * dim + k] - reach;
      query[dim + k] = suspects->x[i * dim + k] + reach;
    }
    PetscCall(BoxTreeQuery(tree, query, &num, &hits));
    if (num) suspects->flag[i] = PETSC_FALSE;
  }
  PetscCall(BoxTreeDestroy(&tree));
  PetscCall(PetscFree(boxes));
  PetscCallMPI(
      MPI_Allreduce(MPI_IN_PLACE, suspects->flag, (PetscMPIInt)suspects->num, MPIU_BOOL, MPI_LAND, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Keeps the suspects that are inside a body with all points around them. Collective. */
static PetscErrorCode InitialOverlapKeepInside_Private(const Level *level, PetscInt body, PetscReal margin,
                                                       GatheredPoints *suspects)
{
  const PetscInt dim = level->dim, num_probes = 2 * dim + 1;
  PetscInt       num = 0;
  PetscReal     *x;
  PetscBool     *inside;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(suspects->num * MAX_PROBES * dim, &x, suspects->num * MAX_PROBES, &inside));
  for (PetscInt i = 0; i < suspects->num; i++) {
    for (PetscInt p = 0; p < num_probes && suspects->flag[i]; p++, num++) {
      PetscCall(PetscArraycpy(&x[num * dim], &suspects->x[i * dim], dim));
      if (p) x[num * dim + (p - 1) / 2] += p % 2 ? margin : -margin;
    }
  }
  PetscCall(InsideBodyFind(level, body, num, x, inside));
  for (PetscInt i = 0, n = 0; i < suspects->num; i++) {
    for (PetscInt p = 0, deep = suspects->flag[i]; p < num_probes && deep; p++, n++)
      suspects->flag[i] = (PetscBool)(suspects->flag[i] && inside[n]);
  }
  PetscCall(PetscFree2(x, inside));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Finds the suspect farthest from the boxes around the facets of the side. Collective.
   [in,out] depth - largest distance so far; [in,out] at - its position [dim] */
static PetscErrorCode InitialOverlapMeasureDepth_Private(const Level *level, const Facets *side,
                                                         const GatheredPoints *suspects, PetscReal *depth,
                                                         PetscReal at[])
{
  const PetscInt dim = level->dim;
  PetscReal     *away, X[ELEMENT_MAX_FACET_NODES * 3], box[6];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(suspects->num, &away));
  for (PetscInt i = 0; i < suspects->num; i++) away[i] = PETSC_MAX_REAL;
  for (PetscInt f = 0; f < side->num; f++) {
    ContactFacetCoordinates(level, side, f, X);
    ContactFacetBox(dim, side->type[f], X, box);
    for (PetscInt i = 0; i < suspects->num; i++) {
      PetscReal square = 0;

      for (PetscInt k = 0; k < dim; k++) {
        const PetscReal x = suspects->x[i * dim + k];
        square += PetscSqr(PetscMax(0, PetscMax(box[k] - x, x - box[dim + k])));
      }
      away[i] = PetscMin(away[i], PetscSqrtReal(square));
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, away, (PetscMPIInt)suspects->num, MPIU_REAL, MPIU_MIN, level->comm));
  for (PetscInt i = 0; i < suspects->num; i++) {
    if (!suspects->flag[i] || away[i] <= *depth) continue;
    *depth = away[i];
    PetscCall(PetscArraycpy(at, &suspects->x[i * dim], dim));
  }
  PetscCall(PetscFree(away));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode InitialOverlapFind(const Level *level, const Facets *side, PetscInt body, const Facets *partner,
                                  PetscReal reach, PetscReal *depth, PetscReal at[])
{
  const PetscReal margin = OVERLAP_MARGIN * reach;
  PetscReal       box[6];
  PetscBool       any = PETSC_FALSE;
  GatheredPoints  suspects;

  PetscFunctionBeginUser;
  PetscCall(LevelGetBox(level, body, box, &box[level->dim]));
  for (PetscInt k = 0; k < level->dim; k++) {
    box[k] += margin;
    box[level->dim + k] -= margin;
  }
  PetscCall(InitialOverlapFindSuspects_Private(level, side, box, &suspects));
  if (suspects.num) PetscCall(InitialOverlapRemoveNear_Private(level, partner, reach, &suspects));
  for (PetscInt i = 0; i < suspects.num; i++) any = (PetscBool)(any || suspects.flag[i]);
  if (any) {
    PetscCall(InitialOverlapKeepInside_Private(level, body, margin, &suspects));
    PetscCall(InitialOverlapMeasureDepth_Private(level, partner, &suspects, depth, at));
  }
  PetscCall(GatheredPointsDestroy(&suspects));
  PetscFunctionReturn(PETSC_SUCCESS);
}

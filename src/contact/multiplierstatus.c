/* multiplierstatus.c -- the nodes of the nonmortar sides that carry a multiplier.

   A node is uncovered, or removed (its row is redistributed to its neighbours), or kept. Nodes are removed if
   they are hardly covered, so that their pressure would be inaccurate. They are also removed if their normal
   direction is fixed, wholly or in part (obliqueholds.h), or if another pair constrains them. */
#include <string.h>
#include "base/compat.h"
#include "base/usererror.h"
#include "kernel/frame.h"
#include "contact/multiplierstatus.h"
#include "kernel/vector.h"
#include "level/ghosted.h"

/* A normal whose free part is shorter than this is fixed: no multiplier. */
static const PetscReal HELD_NORMAL = 0.1;
/* Covered share of a node's support below which its pressure would be inaccurate. On linear facets the share
   e of a facet covers e^2 / 2 of a far end, on quadratic ones 3 e^2 of a middle node. The share of the far
   end of a quadratic line is 4 e^3 - 3 e^2 >= -1/4. It is negative where less than three quarters of the line
   are covered. That of the far corner of a facet in space is the product of two such shares, positive and up
   to 1/16. */
static const PetscReal SLIVER_LINEAR = 1e-3, SLIVER_QUADRATIC_LINE = 5e-2, SLIVER_QUADRATIC = 0.1;
/* Covered share that is roundoff. */
static const PetscReal NO_COVER = 1e-13;
/* Integral of a shape function, relative to the facets around its node, that counts as zero. At the axis of a
   quadratic axisymmetric side int phi r is 0 on a straight facet, and of either sign on a curved one.
   Elsewhere it is at least 1/6 on uniform meshes. */
static const PetscReal WEIGHTLESS = 1e-2;
/* A further constraint at a node needs a normal at least 20 degrees from those of earlier ones, or from their
   plane. Its part across them has at least this length. */
static const PetscReal NEW_DIRECTION = 0.34202014332566873;
/* Two pairs cover the same part of the facets around a node if the sum of their covers exceeds the facets by
   this share. */
static const PetscReal COVERED_TWICE = 1e-8;
/* Gaps that differ by less than this share are the same, on all processes. */
static const PetscReal AS_NEAR = 1e-9;

/* n := Pi n / |Pi n| with Pi the projection onto the free directions of a node. Returns whether n is free at
   all. */
static PetscBool MultiplierStatusProjectNormal_Private(const Support *support, PetscInt node, PetscReal n[])
{
  const PetscInt dim = support->dim;

  for (PetscInt j = 0; j < support->count[node]; j++) {
    const PetscReal *d   = &support->directions[(node * dim + j) * dim];
    const PetscReal  dot = VectorDot(dim, d, n);

    for (PetscInt k = 0; k < dim; k++) n[k] -= dot * d[k];
  }
  if (support->count[node] == 0) return PETSC_TRUE;
  return (PetscBool)(support->count[node] < dim && FrameNormalize(dim, n) >= HELD_NORMAL);
}

PetscErrorCode MultiplierStatusProjectNormals(const Level *level, const Support *support, const PetscBool oblique[],
                                              Vec normals)
{
  PetscReal    n[3];
  PetscScalar *N;

  PetscFunctionBeginUser;
  PetscCall(GhostedGetArray(normals, &N));
  for (PetscInt i = 0; i < level->num_nodes; i++) {
    if (oblique && oblique[i]) continue;
    PetscCall(PetscArraycpy(n, &N[i * level->dim], level->dim));
    if (MultiplierStatusProjectNormal_Private(support, i, n))
      PetscCall(PetscArraycpy(&N[i * level->dim], n, level->dim));
  }
  PetscCall(GhostedRestoreArray(normals, &N));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The least covered share of a node with a multiplier. */
static PetscReal MultiplierStatusLeastShare_Private(const Level *level, const ScenePair *spec)
{
  const PetscBool quadratic =
      (PetscBool)(level->scene->bodies[spec->nonmortar.body].order == 2 && spec->multipliers == MULTIPLIERS_NODES);

  if (!quadratic) return SLIVER_LINEAR;
  return level->dim == 2 ? SLIVER_QUADRATIC_LINE : SLIVER_QUADRATIC;
}

/* Sums that decide the status of nodes, at local nodes. */
enum { SUM_D, SUM_FULL, SUM_MEASURE, SUM_COVER, SUM_COUNT };

/* The status of a node by coverage. If the integral of its shape function over whole facets is nearly zero,
   it has no covered share and no pressure. Then the facets decide whether the node is covered, and its row
   gets a weight of roundoff for the redistribution. [in,out] a - local forms of the sums */
static MultiplierStatus MultiplierStatusOfCovered_Private(PetscScalar *const a[SUM_COUNT], PetscInt i, PetscReal least)
{
  const PetscReal D = PetscRealPart(a[SUM_D][i]), full = PetscRealPart(a[SUM_FULL][i]),
                  measure = PetscRealPart(a[SUM_MEASURE][i]), cover = PetscRealPart(a[SUM_COVER][i]);

  if (full > WEIGHTLESS * measure) {
    if (PetscAbsReal(D / full) <= NO_COVER) return NODE_UNCOVERED;
    return D / full >= least ? NODE_KEPT : NODE_REMOVED;
  }
  if (!(cover > NO_COVER * measure)) return NODE_UNCOVERED;
  if (PetscAbsReal(D) < PETSC_MACHINE_EPSILON * measure) a[SUM_D][i] = PETSC_MACHINE_EPSILON * measure;
  return NODE_REMOVED;
}

PetscErrorCode MultiplierStatusDecide(Level *level, const Support *support, const PetscBool oblique[],
                                      PairAssembly *assembly)
{
  const PetscInt  dim          = level->dim;
  const PetscReal least        = MultiplierStatusLeastShare_Private(level, assembly->spec);
  const Vec       v[SUM_COUNT] = {assembly->sums.D, assembly->sums.full, assembly->sums.measure, assembly->sums.cover};
  PetscScalar    *a[SUM_COUNT], *N;
  Vec             local[SUM_COUNT], local_N;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < SUM_COUNT; i++) {
    PetscCall(VecGhostGetLocalForm(v[i], &local[i]));
    PetscCall(VecGetArray(local[i], &a[i]));
  }
  PetscCall(VecGhostGetLocalForm(assembly->normals, &local_N));
  PetscCall(VecGetArray(local_N, &N));
  for (PetscInt i = 0; i < level->num_nodes; i++) {
    assembly->status[i] = MultiplierStatusOfCovered_Private(a, i, least);
    if (assembly->status[i] == NODE_UNCOVERED) continue;
    if ((oblique && oblique[i]) || !MultiplierStatusProjectNormal_Private(support, i, &N[i * dim]))
      assembly->status[i] = NODE_REMOVED;
  }
  PetscCall(VecRestoreArray(local_N, &N));
  PetscCall(VecGhostRestoreLocalForm(assembly->normals, &local_N));
  for (PetscInt i = 0; i < SUM_COUNT; i++) {
    PetscCall(VecRestoreArray(local[i], &a[i]));
    PetscCall(VecGhostRestoreLocalForm(v[i], &local[i]));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether all directions of a node belong to its pair: it is tied, or has friction. */
static PetscBool MultiplierStatusTakesAll_Private(const ScenePair *spec)
{
  return (PetscBool)(spec->type == PAIR_TIED || ScenePairHasFriction(spec));
}

/* Whether earlier pairs constrain a node of the pair num. They do if one of the two is tied or has friction,
   or if its normal is nearly a combination of theirs. [in] n - normals of the pairs at local nodes [num+1] */
static PetscBool MultiplierStatusIsServed_Private(PetscInt dim, PetscInt num, const PairAssembly assemblies[],
                                                  PetscScalar *const n[], PetscInt node)
{
  PetscReal span[4][3]; // orthonormal; the last one is the rest of the present normal
  PetscInt  rank = 0;

  for (PetscInt q = 0; q <= num; q++) {
    if (assemblies[q].status[node] != NODE_KEPT) continue;
    if (q < num && (MultiplierStatusTakesAll_Private(assemblies[q].spec) ||
                    MultiplierStatusTakesAll_Private(assemblies[num].spec)))
      return PETSC_TRUE;
    if (rank == dim) return PETSC_TRUE;
    for (PetscInt k = 0; k < dim; k++) span[rank][k] = PetscRealPart(n[q][node * dim + k]);
    for (PetscInt j = 0; j < rank; j++) {
      PetscReal dot = 0;
      for (PetscInt k = 0; k < dim; k++) dot += span[j][k] * span[rank][k];
      for (PetscInt k = 0; k < dim; k++) span[rank][k] -= dot * span[j][k];
    }
    if (FrameNormalize(dim, span[rank]) < NEW_DIRECTION) return PETSC_TRUE;
    rank++;
  }
  return PETSC_FALSE;
}

/* Whether two pairs have different partners on the same facets: one partner may be behind the other. */
static PetscBool MultiplierStatusMayHide_Private(const ScenePair *a, const ScenePair *b)
{
  return (PetscBool)(a->type == PAIR_CONTACT && b->type == PAIR_CONTACT && a->nonmortar.body == b->nonmortar.body &&
                     !strcmp(a->nonmortar.side, b->nonmortar.side));
}

/* Data of the nodes of a pair for the comparison of pairs. */
enum { SEEN_D, SEEN_G, SEEN_MEASURE, SEEN_COVER, SEEN_NORMALS, SEEN_COUNT };

/* Whether the partner of b is farther from a node than that of a. Their normals are nearly the same, and both
   cover the same part of its facets. [in] a, b - local forms */
static PetscBool MultiplierStatusIsBehind_Private(PetscInt dim, PetscScalar *const a[], PetscScalar *const b[],
                                                  PetscInt node)
{
  const PetscReal covers  = PetscRealPart(a[SEEN_COVER][node] + b[SEEN_COVER][node]),
                  measure = PetscRealPart(a[SEEN_MEASURE][node]);
  PetscReal dot           = 0, gap_a, gap_b;

  for (PetscInt k = 0; k < dim; k++)
    dot += PetscRealPart(a[SEEN_NORMALS][node * dim + k] * b[SEEN_NORMALS][node * dim + k]);
  if (covers <= (1 + COVERED_TWICE) * measure || dot * dot < 1 - PetscSqr(NEW_DIRECTION)) return PETSC_FALSE;
  gap_a = PetscRealPart(a[SEEN_G][node] / a[SEEN_D][node]);
  gap_b = PetscRealPart(b[SEEN_G][node] / b[SEEN_D][node]);
  return (PetscBool)(gap_b - gap_a > AS_NEAR * PetscMax(PetscAbsReal(gap_a), PetscAbsReal(gap_b)));
}

/* For two pairs on one side whose partners change their order, as two balls on a plate. A node belongs to the
   nearer partner, and is uncovered for the other one. A redistributed row would make its neighbours overlap
   by the difference of both gaps. */
static PetscErrorCode MultiplierStatusHideNodes_Private(const Level *level, PairAssembly *first, PairAssembly *second)
{
  PairAssembly *assembly[2] = {first, second};
  PetscScalar  *a[2][SEEN_COUNT];
  Vec           local[2][SEEN_COUNT], v[2][SEEN_COUNT];

  PetscFunctionBeginUser;
  if (!MultiplierStatusMayHide_Private(first->spec, second->spec)) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt s = 0; s < 2; s++) {
    const MortarIntegrals *sums            = &assembly[s]->sums;
    const Vec              all[SEEN_COUNT] = {sums->D, sums->G, sums->measure, sums->cover, assembly[s]->normals};

    for (PetscInt k = 0; k < SEEN_COUNT; k++) {
      v[s][k] = all[k];
      PetscCall(VecGhostGetLocalForm(v[s][k], &local[s][k]));
      PetscCall(VecGetArray(local[s][k], &a[s][k]));
    }
  }
  for (PetscInt i = 0; i < level->num_nodes; i++) {
    if (first->status[i] != NODE_KEPT || second->status[i] != NODE_KEPT) continue;
    if (MultiplierStatusIsBehind_Private(level->dim, a[0], a[1], i)) {
      second->status[i] = NODE_UNCOVERED;
    } else if (MultiplierStatusIsBehind_Private(level->dim, a[1], a[0], i)) {
      first->status[i] = NODE_UNCOVERED;
    }
  }
  for (PetscInt s = 0; s < 2; s++) {
    for (PetscInt k = 0; k < SEEN_COUNT; k++) {
      PetscCall(VecRestoreArray(local[s][k], &a[s][k]));
      PetscCall(VecGhostRestoreLocalForm(v[s][k], &local[s][k]));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Removes from the pair num the nodes that earlier pairs constrain. */
static PetscErrorCode MultiplierStatusRemoveNodes_Private(const Level *level, PetscInt num, PairAssembly assemblies[])
{
  PairAssembly *later = &assemblies[num];
  PetscScalar **n;
  Vec          *local;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(num + 1, &n, num + 1, &local));
  for (PetscInt q = 0; q <= num; q++) {
    PetscCall(VecGhostGetLocalForm(assemblies[q].normals, &local[q]));
    PetscCall(VecGetArray(local[q], &n[q]));
  }
  for (PetscInt i = 0; i < level->num_nodes; i++) {
    if (later->status[i] == NODE_KEPT && MultiplierStatusIsServed_Private(level->dim, num, assemblies, n, i))
      later->status[i] = NODE_REMOVED;
  }
  for (PetscInt q = 0; q <= num; q++) {
    PetscCall(VecRestoreArray(local[q], &n[q]));
    PetscCall(VecGhostRestoreLocalForm(assemblies[q].normals, &local[q]));
  }
  PetscCall(PetscFree2(n, local));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a pair keeps a node on any rank. Collective. */
static PetscErrorCode MultiplierStatusKeepsAny_Private(const Level *level, const PairAssembly *assembly, PetscBool *any)
{
  PetscFunctionBeginUser;
  *any = PETSC_FALSE;
  for (PetscInt i = 0; i < level->num_nodes; i++) *any = (PetscBool)(*any || assembly->status[i] == NODE_KEPT);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, any, 1, MPIU_BOOL, MPI_LOR, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MultiplierStatusResolve(const Level *level, PetscInt num, PairAssembly assemblies[])
{
  PetscBool before, after;

  PetscFunctionBeginUser;
  for (PetscInt p = 0; p < num; p++) {
    for (PetscInt q = 0; q < p; q++)
      PetscCall(MultiplierStatusHideNodes_Private(level, &assemblies[q], &assemblies[p]));
  }
  for (PetscInt p = 1; p < num; p++) {
    PetscCall(MultiplierStatusKeepsAny_Private(level, &assemblies[p], &before));
    PetscCall(MultiplierStatusRemoveNodes_Private(level, p, assemblies));
    PetscCall(MultiplierStatusKeepsAny_Private(level, &assemblies[p], &after));
    if (before && !after) {
      PetscCall(UserErrorRaise(level->comm,
                               "-pairs: every node of pair '%s' already serves an earlier or nearer pair; refine its "
                               "nonmortar side '%s', or swap its sides",
                               assemblies[p].spec->name, assemblies[p].spec->nonmortar.side));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

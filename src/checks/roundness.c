/* roundness.c -- test for a round support of a body.

   At a node of a smooth curve the facets turn by a little; at an edge by much, or they end; on a flat side
   not at all. */
#include "base/compat.h"
#include "kernel/vector.h"
#include "checks/roundness.h"

/* Facets that meet at less than 31 degrees are taken for a smooth curve: each is half of that from the mean
   normal. Flat is less. */
static const PetscReal SMOOTH_ANGLE = 15.5 * PETSC_PI / 180, FLAT_ANGLE = 1e-4;
/* Forces below this part of the largest one carry nothing. */
static const PetscReal CARRIES = 1e-6;

/* The outward normal of the plane through a facet's vertices. [out] n - unit [3] */
static void RoundnessGetNormal_Private(const Level *level, const PetscInt nodes[], PetscReal n[])
{
  const PetscInt   dim = level->dim;
  const PetscReal *x[3];
  PetscReal        a[3] = {0, 0, 0}, b[3] = {0, 0, 1}, size;

  for (PetscInt i = 0; i < dim; i++) x[i] = &level->coords[nodes[i] * dim];
  for (PetscInt k = 0; k < dim; k++) a[k] = x[1][k] - x[0][k];
  for (PetscInt k = 0; k < dim && dim == 3; k++)
    b[k] = x[2][k] - x[0][k]; // else (dx, dy, 0) x (0, 0, 1) = (dy, -dx, 0)
  VectorCross(a, b, n);
  size = VectorNorm(3, n);
  for (PetscInt k = 0; k < 3; k++) n[k] /= size > 0 ? size : 1;
}

/* The largest angle between the mean normal of a node and those of the facets of a side around it, as a
   ghosted vector.
   [out] turn - owned by the caller */
static PetscErrorCode RoundnessGetAngles_Private(VI vi, const SceneSide *side, Vec *turn)
{
  Level         *level = vi->level;
  const PetscInt dim   = level->dim;
  Facets         facets;
  Vec            mean, parts[2];
  PetscScalar   *m, *t;

  PetscFunctionBeginUser;
  PetscCall(LevelGetFacets(level, vi->scene, side->body, side->side, &facets));
  PetscCall(LevelCreateVec(level, dim, &mean));
  PetscCall(LevelCreateVec(level, 1, turn));
  for (int pass = 0; pass < 2; pass++) {
    PetscCall(VecGhostGetLocalForm(mean, &parts[0]));
    PetscCall(VecGhostGetLocalForm(*turn, &parts[1]));
    if (!pass) PetscCall(VecSet(parts[0], 0));
    if (!pass) PetscCall(VecSet(parts[1], 0));
    PetscCall(VecGetArray(parts[0], &m));
    PetscCall(VecGetArray(parts[1], &t));
    for (PetscInt f = 0; f < facets.num; f++) {
      const PetscInt *nodes = &facets.nodes[f * ELEMENT_MAX_FACET_NODES];
      PetscReal       n[3];

      RoundnessGetNormal_Private(level, nodes, n);
      for (PetscInt i = 0; i < ElementNumNodes(facets.type[f]); i++) {
        PetscReal product = 0, size = 0;

        for (PetscInt k = 0; k < dim; k++) {
          if (!pass) m[nodes[i] * dim + k] += n[k];
          product += n[k] * PetscRealPart(m[nodes[i] * dim + k]);
          size += PetscSqr(PetscRealPart(m[nodes[i] * dim + k]));
        }
        if (pass && size > 0)
          t[nodes[i]] = PetscMax(PetscRealPart(t[nodes[i]]),
                                 PetscAcosReal(PetscMax(PetscMin(product / PetscSqrtReal(size), 1), -1)));
      }
    }
    PetscCall(VecRestoreArray(parts[0], &m));
    PetscCall(VecRestoreArray(parts[1], &t));
    PetscCall(VecGhostRestoreLocalForm(mean, &parts[0]));
    PetscCall(VecGhostRestoreLocalForm(*turn, &parts[1]));
    PetscCall(LevelShareVec(pass ? *turn : mean, pass ? MAX_VALUES : ADD_VALUES));
  }
  PetscCall(VecDestroy(&mean));
  PetscCall(FacetsDestroy(&facets));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RoundnessCarriesLoads(VI vi, Solvability s, PetscBool *round)
{
  PetscReal largest = 0;
  PetscBool all     = PETSC_TRUE;

  PetscFunctionBeginUser;
  for (PetscInt r = 0; r < vi->num_rows; r++) largest = PetscMax(largest, s->balance[r]);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPIU_REAL, MPI_MAX, vi->level->comm));
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    const Pair         pair = vi->pairs[p];
    const ObstacleKind kind = pair->spec->obstacle.kind;
    const PetscScalar *t;
    Vec                turn;

    if (kind == OBSTACLE_BALL || kind == OBSTACLE_CYLINDER || kind == OBSTACLE_PARABOLA) continue;
    PetscCall(RoundnessGetAngles_Private(vi, &pair->spec->nonmortar, &turn));
    PetscCall(VecGetArrayRead(turn, &t)); // of nodes that this rank owns, as those of the pair are
    for (PetscInt r = 0; r < vi->num_rows; r++) {
      PetscReal angle;

      if (vi->row_pair[r] != p || s->balance[r] <= CARRIES * largest) continue;
      angle = PetscRealPart(t[pair->nodes[vi->row_node[r]]]);
      if (angle < FLAT_ANGLE || angle > SMOOTH_ANGLE) all = PETSC_FALSE;
    }
    PetscCall(VecRestoreArrayRead(turn, &t));
    PetscCall(VecDestroy(&turn));
  }
  *round = (PetscBool)(all && largest > 0);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, round, 1, MPIU_BOOL, MPI_LAND, vi->level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

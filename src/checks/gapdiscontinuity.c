/* gapdiscontinuity.c -- nodes whose mean gap is less than every gap around them.

   G_a / D_aa is a mean with weights psi_a, which are negative in part. It is right for gaps that are linear
   on a facet, and too small by some h^2 / (12 R) where a curve comes nearest. The gap may have a step or
   sharp bend within a facet, by a formula that jumps, or by a groove of the other side. There the mean may
   be far below all values of the gap. Contact then acts as if bodies overlapped. In scenes whose facets
   follow their curves it is less than a thousandth of the displacements. */
#include "base/compat.h"
#include "base/json.h"
#include "checks/gapdiscontinuity.h"
#include "checks/slip.h"
#include "kernel/vector.h"
#include "result/largest.h"

/* Such an overlap is reported above this part of the largest displacement along the normals. */
static const PetscReal SHOWS = 0.1;
/* Gaps are differences of coordinates, gaps and radii. Below this part of them an overlap is their rounding:
   a mean over some hundred points, with weights of either sign. */
static const PetscReal GAP_ROUNDING = 256 * PETSC_MACHINE_EPSILON;
/* How far the mean gap of a row in contact is below all gaps around its node, 0 of other rows. */
static PetscReal GapDiscontinuityGetRow_Private(Fields fields, PetscInt p, PetscInt r)
{
  const Pair     pair = fields->vi->pairs[p];
  const PetscInt a    = fields->vi->row_node[r];

  if (fields->vi->row_pair[r] != p || fields->vi->row_direction[r] != 0) return 0;
  if (!StatusIsContact(fields->row_status[r])) return 0;
  return PetscMax(-pair->gap[a] / pair->share[a] - pair->overlap[a], 0);
}

/* Of this rank, [out] largest - displacement of the pair's nodes along their normals, or half of how both
   sides approach: a stiff nonmortar side hardly moves; [out] size - number that a gap is made of.
   Collective. */
static PetscErrorCode GapDiscontinuityGetSizes_Private(Fields fields, PetscInt p, PetscReal *largest, PetscReal *size)
{
  const Pair           pair     = fields->vi->pairs[p];
  const SceneObstacle *obstacle = &pair->spec->obstacle;
  const Level         *level    = fields->vi->level;
  const PetscInt       dim      = level->dim;
  const PetscScalar   *u;
  PetscReal           *relative;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(pair->num * dim, &relative));
  PetscCall(SlipComputeRelative(fields, p, relative));
  *largest = 0;
  *size    = PetscAbsReal(obstacle->radius);
  for (PetscInt k = 0; k < dim; k++) *size = PetscMax(*size, PetscAbsReal(obstacle->point[k]));
  PetscCall(VecGetArrayRead(fields->u, &u)); // of nodes that this rank owns, as those of the pair are
  for (PetscInt a = 0; a < pair->num; a++) {
    PetscReal un = 0;

    for (PetscInt k = 0; k < dim; k++) un += PetscRealPart(u[pair->nodes[a] * dim + k]) * pair->normal[a * dim + k];
    *largest = PetscMax(*largest, PetscAbsReal(un));
    *largest = PetscMax(*largest, PetscAbsReal(VectorDot(dim, &relative[a * dim], &pair->normal[a * dim])) / 2);
    *size    = PetscMax(*size, PetscAbsReal(pair->gap[a]));
    for (PetscInt k = 0; k < dim; k++) *size = PetscMax(*size, PetscAbsReal(level->coords[pair->nodes[a] * dim + k]));
  }
  PetscCall(VecRestoreArrayRead(fields->u, &u));
  PetscCall(PetscFree(relative));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GapDiscontinuityFind(Fields fields, PetscInt p, PetscBool *shows, PetscReal *overlap, PetscReal at[])
{
  const VI       vi      = fields->vi;
  const PetscInt dim     = vi->level->dim;
  PetscReal      size[2] = {0, 0}; /* displacement, numbers */
  Largest        found   = {.value = 0};

  PetscFunctionBeginUser;
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    if (vi->row_pair[r] == p)
      LargestTake(&found, GapDiscontinuityGetRow_Private(fields, p, r), dim,
                  &vi->level->coords[vi->pairs[p]->nodes[vi->row_node[r]] * dim], 0);
  }
  PetscCall(LargestReduce(vi->level->comm, dim, 1, &found));
  PetscCall(GapDiscontinuityGetSizes_Private(fields, p, &size[0], &size[1]));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, size, 2, MPIU_REAL, MPI_MAX, vi->level->comm));
  *overlap = found.value > GAP_ROUNDING * size[1] ? found.value : 0;
  *shows   = (PetscBool)(*overlap > SHOWS * size[0]);
  if (*shows) PetscCall(PetscArraycpy(at, found.at, dim));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GapDiscontinuityAdd(Fields fields, PetscInt p, PetscInt dim, cJSON *object)
{
  PetscReal overlap = NAN, at[3] = {NAN, NAN, NAN};
  PetscBool shows = PETSC_FALSE;

  PetscFunctionBeginUser;
  if (fields) PetscCall(GapDiscontinuityFind(fields, p, &shows, &overlap, at));
  JSONAddReal(object, "false_overlap", overlap);
  if (shows) JSONAddReals(object, "false_overlap_at", dim, at);
  PetscFunctionReturn(PETSC_SUCCESS);
}

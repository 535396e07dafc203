/* frictionlaw.c -- friction of the pairs at their nodes.

   Rows of B stand by pair, then by node, then by direction. With friction, a normal row is followed by rows
   of the tangents that supports leave free. Where they leave none, the node cannot slide, and the normal row
   is like one without friction. The law has its nodes in the order of their unknowns, whatever the order of
   pairs. */
#include "base/compat.h"
#include "base/usererror.h"
#include "problem/frictionlaw.h"

/* Places of neighbours differ by radians, unless a facet is a smaller part of the sides than one in this. */
static const PetscReal PLACE_TURNS = 1e3;

/* Tangents behind a normal row. */
static PetscInt FrictionLawCountTangents_Private(VI vi, PetscInt row)
{
  PetscInt num = 0;

  if (vi->row_direction[row] || !ScenePairHasFriction(vi->pairs[vi->row_pair[row]]->spec)) return 0;
  while (row + num + 1 < vi->num_rows && vi->row_pair[row + num + 1] == vi->row_pair[row] &&
         vi->row_node[row + num + 1] == vi->row_node[row])
    num++;
  return num;
}

/* A coefficient or a bound at a node. */
static PetscErrorCode FrictionLawEvaluate_Private(VI vi, Expression e, PetscInt row, PetscReal *value,
                                                  PetscBool *negative)
{
  const PetscInt   dim = vi->level->dim;
  const PetscReal *x   = &vi->level->coords[vi->pairs[vi->row_pair[row]]->nodes[vi->row_node[row]] * dim];

  PetscFunctionBeginUser;
  *value = 0;
  if (!e) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ExpressionEvaluate(e, dim, x, value));
  if (!(*value >= 0)) *negative = PETSC_TRUE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Raises the user error of a pair whose coefficient or bound is negative somewhere. Collective. */
static PetscErrorCode FrictionLawCheck_Private(VI vi, const PetscBool negative[])
{
  PetscFunctionBeginUser;
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    const ScenePair *spec = vi->pairs[p]->spec;
    PetscBool        any  = negative[p];

    PetscCall(ExpressionCheck(vi->level->comm, spec->friction));
    PetscCall(ExpressionCheck(vi->level->comm, spec->bound));
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPIU_BOOL, MPI_LOR, vi->level->comm));
    if (any)
      PetscCall(UserErrorRaise(vi->level->comm, "%s: is negative, or no number, at a node of the side",
                               ExpressionOption(spec->friction ? spec->friction : spec->bound)));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscInt FrictionLawFind(const FrictionLaw *law, PetscInt normal)
{
  PetscInt begin = 0, end = law->n;

  while (begin < end) {
    const PetscInt middle = (begin + end) / 2;

    if (law->normal[middle] < normal)
      begin = middle + 1;
    else
      end = middle;
  }
  return begin < law->n && law->normal[begin] == normal ? begin : -1;
}

PetscErrorCode FrictionLawUpdate(VI vi)
{
  FrictionLaw    *law   = vi->friction;
  const PetscReal force = vi->stiffness * vi->length;
  PetscBool      *negative;

  PetscFunctionBeginUser;
  if (!law) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscCalloc1(vi->num_pairs, &negative));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const PetscInt   p = vi->row_pair[r], num = FrictionLawCountTangents_Private(vi, r);
    const ScenePair *spec = vi->pairs[p]->spec;
    PetscReal        bound;
    const PetscInt   a = num ? FrictionLawFind(law, vi->row_dof[r]) : -1;

    if (!num) continue;
    PetscCall(FrictionLawEvaluate_Private(vi, spec->friction, r, &law->coefficient[a], &negative[p]));
    PetscCall(FrictionLawEvaluate_Private(vi, spec->bound, r, &bound, &negative[p]));
    law->bound[a] = bound * vi->row_D[r] / force;
    for (PetscInt i = 0; i < num; i++)
      law->origin[FRICTION_TANGENTS * a + i] = vi->slip_origin ? vi->slip_origin[r + 1 + i] / vi->length : 0;
  }
  PetscCall(FrictionLawCheck_Private(vi, negative));
  PetscCall(PetscFree(negative));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionLawSetApproach(VI vi, Vec approach)
{
  const PetscScalar *moved;
  PetscInt           begin;

  PetscFunctionBeginUser;
  PetscCall(FrictionLawUpdate(vi));
  if (!vi->friction || !approach) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecGetOwnershipRange(approach, &begin, NULL));
  PetscCall(VecGetArrayRead(approach, &moved));
  for (PetscInt i = 0; i < FRICTION_TANGENTS * vi->friction->n; i++) {
    const PetscInt dof = vi->friction->tangent[i];

    if (dof >= 0) vi->friction->origin[i] -= PetscRealPart(moved[dof - begin]);
  }
  PetscCall(VecRestoreArrayRead(approach, &moved));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The place of the node of a row. */
static const PetscReal *FrictionLawGetPosition_Private(VI vi, PetscInt row)
{
  return &vi->level->coords[vi->pairs[vi->row_pair[row]]->nodes[vi->row_node[row]] * vi->level->dim];
}

/* Places of nodes as numbers: PLACE_TURNS radians from end to end of all nodes with friction. Collective. */
static PetscErrorCode FrictionLawSetPlaces_Private(VI vi, FrictionLaw *law)
{
  const PetscInt  dim     = vi->level->dim;
  const PetscReal turn[3] = {1, PetscSqrtReal(2), PetscSqrtReal(3)}; // mirror images differ
  PetscReal       ends[6], size = 0;                                 // upper, and lower with the sign changed

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < 6; k++) ends[k] = PETSC_MIN_REAL;
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const PetscReal *x = FrictionLawGetPosition_Private(vi, r);

    for (PetscInt k = 0; k < 2 * dim && FrictionLawCountTangents_Private(vi, r); k++)
      ends[k] = PetscMax(ends[k], k < dim ? x[k] : -x[k - dim]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, ends, 2 * dim, MPIU_REAL, MPIU_MAX, vi->level->comm));
  for (PetscInt k = 0; k < dim; k++) size = PetscMax(size, ends[k] + ends[dim + k]);
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const PetscReal *x = FrictionLawGetPosition_Private(vi, r);
    const PetscInt   a = FrictionLawCountTangents_Private(vi, r) ? FrictionLawFind(law, vi->row_dof[r]) : -1;

    if (a < 0) continue;
    law->place[a] = 0;
    for (PetscInt k = 0; k < dim && size > 0; k++)
      law->place[a] += PLACE_TURNS * turn[k] * (x[k] + ends[dim + k]) / size;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionLawCreate(VI vi)
{
  FrictionLaw *law;
  PetscInt     num_nodes = 0, all, n = 0;

  PetscFunctionBeginUser;
  if (!SceneHasFriction(vi->scene)) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt r = 0; r < vi->num_rows; r++) num_nodes += FrictionLawCountTangents_Private(vi, r) > 0;
  PetscCallMPI(MPI_Allreduce(&num_nodes, &all, 1, MPIU_INT, MPI_SUM, vi->level->comm));
  if (!all) PetscFunctionReturn(PETSC_SUCCESS); // no node faces a partner
  PetscCall(PetscNew(&law));
  law->n    = num_nodes;
  law->held = (PetscBool)!vi->rigid_modes.num;
  PetscCall(PetscMalloc6(law->n, &law->normal, FRICTION_TANGENTS * law->n, &law->tangent, law->n, &law->coefficient,
                         law->n, &law->bound, FRICTION_TANGENTS * law->n, &law->origin, law->n, &law->place));
  for (PetscInt r = 0; r < vi->num_rows; r++)
    if (FrictionLawCountTangents_Private(vi, r)) law->normal[n++] = vi->row_dof[r];
  PetscCall(PetscSortInt(law->n, law->normal));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const PetscInt num = FrictionLawCountTangents_Private(vi, r);
    const PetscInt a   = FrictionLawFind(law, vi->row_dof[r]);

    if (!num) continue;
    for (PetscInt i = 0; i < FRICTION_TANGENTS; i++) {
      law->tangent[FRICTION_TANGENTS * a + i] = i < num ? vi->row_dof[r + 1 + i] : -1;
      law->origin[FRICTION_TANGENTS * a + i]  = 0;
    }
  }
  PetscCall(FrictionLawSetPlaces_Private(vi, law));
  vi->friction = law;
  PetscCall(FrictionLawUpdate(vi));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionLawIsGiven(VI vi, PetscBool *given)
{
  PetscFunctionBeginUser;
  *given = (PetscBool)(vi->friction != NULL);
  for (PetscInt a = 0; vi->friction && a < vi->friction->n; a++)
    if (vi->friction->coefficient[a] > 0) *given = PETSC_FALSE;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, given, 1, MPIU_BOOL, MPI_LAND, vi->level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionLawDestroy(FrictionLaw **law)
{
  PetscFunctionBeginUser;
  if (!*law) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(
      PetscFree6((*law)->normal, (*law)->tangent, (*law)->coefficient, (*law)->bound, (*law)->origin, (*law)->place));
  PetscCall(PetscFree(*law));
  PetscFunctionReturn(PETSC_SUCCESS);
}

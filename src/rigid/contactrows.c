/* contactrows.c -- the constraints of contact on rigid motions, at the points where bodies can touch.

   A row of B acts at its node: psi reproduces linear functions, so int psi n.u of a rigid motion is D_aa
   n.u(x_a). This holds even where the partner ends within a facet and x_a is outside it; psi then changes
   sign on the covered part. But the bodies touch only up to the end of the partner. So rows of nodes of
   partly covered facets are replaced by n.[u] at the corners of the covered part. Pairs with friction keep
   their nodes, where the cones of their forces are. */
#include "base/compat.h"
#include "rigid/rigidimpl.h"

/* n.[u] of all modes at a point. [out] row - [m] */
static void ContactRowsSetRow_Private(VI vi, const ContactPlace *place, const PetscReal n[], PetscReal row[])
{
  const PetscInt m = vi->rigid_modes.num, dim = vi->level->dim;

  for (PetscInt k = 0; k < m; k++) {
    PetscReal slip[3] = {0, 0, 0};

    row[k] = 0;
    SceneMotionAddSlipOfMode(vi, place, k, 1, slip);
    for (PetscInt i = 0; i < dim; i++) row[k] += n[i] * slip[i];
  }
}

/* Whether forces of a pair act at the overlap boundary: not those of ties, nor of friction. */
static PetscBool ContactRowsHasCorners_Private(const Pair pair)
{
  return (PetscBool)(pair->spec->type != PAIR_TIED && !ScenePairHasFriction(pair->spec));
}

/* Corners of the overlap boundary of pairs with forces there, on this rank.
   [out] out - the corners, NULL to count them */
static PetscInt ContactRowsListCorners_Private(VI vi, const OverlapBoundary *out[])
{
  PetscInt num = 0;

  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    const Pair pair = vi->pairs[p];

    if (!ContactRowsHasCorners_Private(pair)) continue;
    for (PetscInt i = 0; i < pair->num_boundary; i++, num++)
      if (out) out[num] = &pair->boundary[i];
  }
  return num;
}

/* Appends a row for each corner of the overlap boundary. Collective. [in] num - of corners on this rank */
static PetscErrorCode ContactRowsAddCorners_Private(VI vi, PetscInt num, ContactRows *rows)
{
  const PetscInt          m = vi->rigid_modes.num;
  const OverlapBoundary **ends;
  PetscInt               *node, *piece;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(num, &ends, num, &node, num, &piece));
  ContactRowsListCorners_Private(vi, ends);
  for (PetscInt i = 0; i < num; i++) node[i] = ends[i]->mortar;
  PetscCall(ComponentsOfGlobalNodes(vi->level, &vi->rigid_modes.components, num, node, piece));
  for (PetscInt i = 0; i < num; i++, rows->num++) {
    ContactPlace *place = &rows->place[rows->num];

    PetscCall(PetscArraycpy(place->x, ends[i]->x, 3));
    place->piece[0]           = vi->rigid_modes.components.of_node[ends[i]->node];
    place->piece[1]           = piece[i];
    rows->equality[rows->num] = PETSC_FALSE;
    ContactRowsSetRow_Private(vi, place, ends[i]->normal, &rows->rows[rows->num * m]);
  }
  PetscCall(PetscFree3(ends, node, piece));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets rows at nodes, or at the overlap boundary for nodes outside it. Collective.
   [in] of - row of nodal for each row, NULL if they are the same; [out] rows - allocated by the caller */
static PetscErrorCode ContactRowsMoveToCorners_Private(VI vi, const ContactRows *nodes, const PetscInt of[],
                                                       ContactRows *rows)
{
  const PetscInt m = vi->rigid_modes.num;

  PetscFunctionBeginUser;
  rows->num = 0;
  for (PetscInt i = 0; i < nodes->num; i++) {
    const PetscInt r = of ? of[i] : i, a = vi->row_node[r];
    const Pair     pair = vi->pairs[vi->row_pair[r]];
    PetscReal     *row  = &rows->rows[rows->num * m];

    rows->equality[rows->num] = nodes->equality[i];
    rows->place[rows->num]    = nodes->place[i];
    if (!ContactRowsHasCorners_Private(pair) || !pair->partly_covered[a])
      PetscCall(PetscArraycpy(row, &nodes->rows[i * m], m));
    else if (pair->fully_covered[a]) // without the share of a removed node beyond the overlap boundary
      ContactRowsSetRow_Private(vi, &nodes->place[i], &pair->normal[a * vi->level->dim], row);
    else
      continue;
    rows->num++;
  }
  PetscCall(ContactRowsAddCorners_Private(vi, ContactRowsListCorners_Private(vi, NULL), rows));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Allocates most rows, and the corners besides. */
static PetscErrorCode ContactRowsAllocate_Private(VI vi, PetscInt most, ContactRows *rows)
{
  most += ContactRowsListCorners_Private(vi, NULL);
  return PetscMalloc3(most * vi->rigid_modes.num, &rows->rows, most, &rows->equality, most, &rows->place);
}

PetscErrorCode ContactRowsUpdate(VI vi, Solvability s, PetscReal part)
{
  PetscFunctionBeginUser;
  PetscCall(FrictionRowsUpdate(vi, s, part));
  if (!vi->friction)
    s->forces_at = s->overlap;
  else if (!s->cut)
    s->forces_at = s->friction;
  else
    PetscCall(ContactRowsMoveToCorners_Private(vi, &s->friction, s->friction_row, &s->forces_at));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ContactRowsCreate(VI vi, Solvability s)
{
  PetscInt all = ContactRowsListCorners_Private(vi, NULL);

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPIU_INT, MPI_SUM, vi->level->comm));
  s->cut     = (PetscBool)(all > 0);
  s->overlap = s->nodal;
  if (s->cut) {
    PetscCall(ContactRowsAllocate_Private(vi, vi->num_rows, &s->overlap));
    PetscCall(ContactRowsMoveToCorners_Private(vi, &s->nodal, NULL, &s->overlap));
    if (vi->friction) PetscCall(ContactRowsAllocate_Private(vi, FrictionRowsCountMost(vi), &s->forces_at));
  }
  PetscCall(ContactRowsUpdate(vi, s, 1));
  PetscFunctionReturn(PETSC_SUCCESS);
}

Cone ContactRowsCone(VI vi, Solvability s, const ContactRows *rows)
{
  return (Cone){.comm = vi->level->comm, .num = rows->num, .m = s->m, .rows = rows->rows, .equality = rows->equality};
}

PetscErrorCode ContactRowsDestroy(Solvability s)
{
  PetscFunctionBeginUser;
  if (!s->cut) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscFree3(s->overlap.rows, s->overlap.equality, s->overlap.place));
  if (s->friction.rows) PetscCall(PetscFree3(s->forces_at.rows, s->forces_at.equality, s->forces_at.place));
  PetscFunctionReturn(PETSC_SUCCESS);
}

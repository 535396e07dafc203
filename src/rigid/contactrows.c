/* contactrows.c -- the constraints of contact on rigid motions, at the places where bodies can touch.

   A row of B acts at its node: psi reproduces linear functions, so int psi n.u of a rigid motion is D_aa n.u(x_a). This holds even where
   the partner ends within a facet and x_a lies beyond its end; psi then changes sign on the covered part. The bodies themselves touch up
   to the end of the partner. Rows of nodes of partly covered facets are therefore replaced by n.[u] at the corners of the covered part. */
#include "base/compat.h"
#include "rigid/rigidimpl.h"

/* n.[u] of all modes at a place. [out] row - [m] */
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

/* Corners of the overlap boundary of all pairs but ties, on this rank. [out] out - the corners, NULL to count them */
static PetscInt ContactRowsListCorners_Private(VI vi, const OverlapBoundary *out[])
{
  PetscInt num = 0;

  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    const Pair pair = vi->pairs[p];

    if (pair->spec->type == PAIR_TIED) continue;
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

PetscErrorCode ContactRowsCreate(VI vi, Solvability s)
{
  const PetscInt m = s->m, mine = ContactRowsListCorners_Private(vi, NULL);
  PetscInt       all  = mine;
  ContactRows   *rows = &s->overlap;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPIU_INT, MPI_SUM, vi->level->comm));
  s->cut = (PetscBool)(all > 0 && !vi->friction);
  if (!s->cut) {
    s->overlap = s->nodal;
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PetscMalloc3((vi->num_rows + mine) * m, &rows->rows, vi->num_rows + mine, &rows->equality,
                         vi->num_rows + mine, &rows->place));
  rows->num = 0;
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const Pair     pair = vi->pairs[vi->row_pair[r]];
    const PetscInt a    = vi->row_node[r];
    PetscReal     *row  = &rows->rows[rows->num * m];

    rows->equality[rows->num] = s->nodal.equality[r];
    rows->place[rows->num]    = s->nodal.place[r];
    if (s->nodal.equality[r] || !pair->partly_covered[a])
      PetscCall(PetscArraycpy(row, &s->nodal.rows[r * m], m));
    else if (pair->fully_covered[a]) // without the share of a removed node beyond the overlap boundary
      ContactRowsSetRow_Private(vi, &s->nodal.place[r], &pair->normal[a * vi->level->dim], row);
    else
      continue;
    rows->num++;
  }
  PetscCall(ContactRowsAddCorners_Private(vi, mine, rows));
  PetscFunctionReturn(PETSC_SUCCESS);
}

Cone ContactRowsCone(VI vi, Solvability s, const ContactRows *rows)
{
  return (Cone){.comm = vi->level->comm, .num = rows->num, .m = s->m, .rows = rows->rows, .equality = rows->equality};
}

PetscErrorCode ContactRowsDestroy(Solvability s)
{
  PetscFunctionBeginUser;
  if (s->cut) PetscCall(PetscFree3(s->overlap.rows, s->overlap.equality, s->overlap.place));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* contactrows.c -- where contact can press, which decides what holds and what does not.

   A row of B acts at its node: psi reproduces linear functions, so that int psi n.u of a rigid motion is D_aa n.u(x_a), even where the
   partner ends within a facet and x_a lies beyond (psi is then of both signs on what is covered). The bodies themselves touch up to the
   partner's end. On facets that are covered in part the rows of their nodes are therefore replaced by n.[u] at the corners of the covered
   part; in between it is a mean of these. */
#include "base/compat.h"
#include "rigid/rigidimpl.h"

/* n.[u] of all rigid motions at a place. [out] row - [m] */
static void Row_Private(VI vi, const ContactPlace *place, const PetscReal n[], PetscReal row[])
{
  const PetscInt m = vi->rigid_modes.num, dim = vi->level->dim;

  for (PetscInt k = 0; k < m; k++) {
    PetscReal slip[3] = {0, 0, 0};

    row[k] = 0;
    SceneMotionAddSlipOfMode(vi, place, k, 1, slip);
    for (PetscInt i = 0; i < dim; i++) row[k] += n[i] * slip[i];
  }
}

/* Ends of the cover of pairs that can only press, on this rank; counts where out is NULL. */
static PetscInt Ends_Private(VI vi, const OverlapBoundary *out[])
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

/* Appends the ends of what is covered. Collective. */
static PetscErrorCode AddEnds_Private(VI vi, PetscInt num, ContactRows *cover)
{
  const PetscInt          m = vi->rigid_modes.num;
  const OverlapBoundary **ends;
  PetscInt               *node, *piece;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(num, &ends, num, &node, num, &piece));
  Ends_Private(vi, ends);
  for (PetscInt i = 0; i < num; i++) node[i] = ends[i]->mortar;
  PetscCall(ComponentsOfGlobalNodes(vi->level, &vi->rigid_modes.components, num, node, piece));
  for (PetscInt i = 0; i < num; i++, cover->num++) {
    ContactPlace *place = &cover->place[cover->num];

    PetscCall(PetscArraycpy(place->x, ends[i]->x, 3));
    place->piece[0]         = vi->rigid_modes.components.of_node[ends[i]->node];
    place->piece[1]         = piece[i];
    cover->both[cover->num] = PETSC_FALSE;
    Row_Private(vi, place, ends[i]->normal, &cover->rows[cover->num * m]);
  }
  PetscCall(PetscFree3(ends, node, piece));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ContactRowsCreate(VI vi, Solvability s)
{
  const PetscInt m = s->m, mine = Ends_Private(vi, NULL);
  PetscInt       all   = mine;
  ContactRows   *cover = &s->cover;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPIU_INT, MPI_SUM, vi->level->comm));
  s->cut = (PetscBool)(all > 0);
  if (!s->cut) {
    *cover = (ContactRows){vi->num_rows, s->C, s->both, s->place};
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PetscMalloc3((vi->num_rows + mine) * m, &cover->rows, vi->num_rows + mine, &cover->both,
                         vi->num_rows + mine, &cover->place));
  cover->num = 0;
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const Pair     pair = vi->pairs[vi->row_pair[r]];
    const PetscInt a    = vi->row_node[r];
    PetscReal     *row  = &cover->rows[cover->num * m];

    cover->both[cover->num]  = s->both[r];
    cover->place[cover->num] = s->place[r];
    if (s->both[r] || !pair->partly_covered[a])
      PetscCall(PetscArraycpy(row, &s->C[r * m], m));
    else if (pair->fully_covered[a]) // without what it has taken over from a node beyond the end
      Row_Private(vi, &s->place[r], &pair->normal[a * vi->level->dim], row);
    else
      continue;
    cover->num++;
  }
  PetscCall(AddEnds_Private(vi, mine, cover));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ContactRowsDestroy(Solvability s)
{
  PetscFunctionBeginUser;
  if (s->cut) PetscCall(PetscFree3(s->cover.rows, s->cover.both, s->cover.place));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* frictionrows.c -- the forces of contact with friction on rigid motions (eq. 16.8).

   Forces at a node with friction are in the cone |r_t| <= coefficient r_n. In a plane its two edges generate
   it. In space a pyramid around the cone takes its place: loads outside all pyramids have no equilibrium.
   Tresca's limit gives no cone: here its tangents can carry any force, as ties do. frictionlimits.c tests
   loads inside with round cones and with bounds. */
#include "base/compat.h"
#include "problem/frictionlaw.h"
#include "rigid/rigidimpl.h"

/* Edges of the pyramid: it exceeds the cone by 2 percent. */
enum { PYRAMID_EDGES = 16, MOST_GENERATORS = PYRAMID_EDGES + FRICTION_TANGENTS };

/* Generators of one node, or a copy of a row without friction.
   [in] part - of the coefficients; [in] a - of the law, -1 without friction */
static void FrictionRowsAddNode_Private(VI vi, Solvability s, PetscReal part, PetscInt r, PetscInt a)
{
  const PetscInt   m      = s->m;
  const PetscReal *normal = &s->nodal.rows[r * m], *slide = &s->slide[(r + 1) * m];
  const PetscInt   tangents = a < 0 ? 0 : vi->friction->tangent[FRICTION_TANGENTS * a + 1] < 0 ? 1 : 2;
  const PetscReal  mu       = a < 0 ? 0 : part * vi->friction->coefficient[a];
  const PetscInt   edges    = mu > 0 ? (tangents == 1 ? 2 : PYRAMID_EDGES) : 1;
  const PetscReal  wide     = edges == PYRAMID_EDGES ? mu / PetscCosReal(PETSC_PI / PYRAMID_EDGES) : mu;
  ContactRows     *rows     = &s->friction;

  for (PetscInt e = 0; e < edges + (a >= 0 && vi->friction->bound[a] > 0 ? tangents : 0); e++) {
    PetscReal      *row   = &rows->rows[rows->num * m];
    const PetscReal angle = 2 * PETSC_PI * (PetscReal)e / (PetscReal)edges;

    for (PetscInt k = 0; k < m; k++) {
      if (e >= edges) {
        row[k] = slide[(e - edges) * m + k];
        continue;
      }
      row[k] = normal[k];
      if (mu > 0) row[k] += wide * PetscCosReal(angle) * slide[k];
      if (mu > 0 && tangents == 2) row[k] += wide * PetscSinReal(angle) * slide[m + k];
    }
    rows->equality[rows->num]    = (PetscBool)(e >= edges || s->nodal.equality[r]);
    rows->place[rows->num]       = s->nodal.place[r];
    s->friction_row[rows->num++] = r;
  }
}

PetscErrorCode FrictionRowsUpdate(VI vi, Solvability s, PetscReal part)
{
  PetscFunctionBeginUser;
  if (!vi->friction) PetscFunctionReturn(PETSC_SUCCESS);
  s->friction.num = 0;
  s->part         = part;
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    if (s->tangent[r]) continue; // comes with its normal row
    FrictionRowsAddNode_Private(vi, s, part, r, FrictionLawFind(vi->friction, vi->row_dof[r]));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscInt FrictionRowsCountMost(VI vi)
{
  return vi->num_rows + (vi->friction ? MOST_GENERATORS * vi->friction->n : 0);
}

PetscErrorCode FrictionRowsCreate(VI vi, Solvability s)
{
  const PetscInt m = s->m, n = vi->num_rows, most = FrictionRowsCountMost(vi);

  PetscFunctionBeginUser;
  if (!vi->friction) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscCalloc2((n + 1 + FRICTION_TANGENTS) * m, &s->slide, n, &s->tangent));
  PetscCall(PetscMalloc4(most * m, &s->friction.rows, most, &s->friction.equality, most, &s->friction.place, most,
                         &s->friction_row));
  for (PetscInt r = 0; r < n; r++) {
    s->tangent[r] = (PetscBool)(vi->row_direction[r] && vi->pairs[vi->row_pair[r]]->spec->type != PAIR_TIED);
    if (!s->tangent[r]) continue;
    PetscCall(PetscArraycpy(&s->slide[r * m], &s->nodal.rows[r * m], m));
    PetscCall(PetscArrayzero(&s->nodal.rows[r * m], m)); // a row of zeros constrains nothing
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionRowsTakePressed(VI vi, Solvability s, PetscBool pressed[], PetscReal rows[])
{
  PetscBool holds = PETSC_FALSE; // whether friction resists at the node of the present row

  PetscFunctionBeginUser;
  PetscCall(PetscArraycpy(rows, s->nodal.rows, vi->num_rows * s->m));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    if (!s->tangent[r]) {
      const PetscInt a = FrictionLawFind(vi->friction, vi->row_dof[r]);

      holds = (PetscBool)(a >= 0 && (vi->friction->bound[a] > 0 || (pressed[r] && vi->friction->coefficient[a] > 0)));
      continue;
    }
    pressed[r] = holds;
    if (holds) PetscCall(PetscArraycpy(&rows[r * s->m], &s->slide[r * s->m], s->m));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionRowsDestroy(Solvability s)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree2(s->slide, s->tangent));
  PetscCall(PetscFree4(s->friction.rows, s->friction.equality, s->friction.place, s->friction_row));
  PetscFunctionReturn(PETSC_SUCCESS);
}

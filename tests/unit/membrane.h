/* membrane.h -- a membrane above a wire: the inequality that the tests of solvers solve. */
#ifndef MORTISE_TEST_MEMBRANE_H
#define MORTISE_TEST_MEMBRANE_H

#include "solve_once.h"
#include "test.h"

enum { GRID = 31 }; /* inner points per side; 2D, one unknown per point */

/* What a solver needs of a VI: -laplace y = b on the unit square, y <= upper on the middle rows. */
typedef struct {
  struct _n_VI    vi;
  struct _n_Scene scene;
  Level           level;
} Membrane;

/* The wire's height above the membrane: touches in the middle, a parabola. */
static PetscReal Wire(PetscInt i)
{
  return 0.02 + 0.2 * PetscSqr((PetscReal)(i + 1) / (GRID + 1) - 0.4);
}

/* Unit scales as a change of units would bring them; held: whether the membrane is held at its frame. */
static PetscErrorCode MembraneCreate(PetscReal stiffness, PetscReal length, PetscBool bounded, PetscBool held,
                                     Membrane *m)
{
  VI             vi = &m->vi;
  PetscInt       begin, end;
  const PetscInt n = GRID * GRID;

  PetscFunctionBeginUser;
  PetscCall(PetscMemzero(m, sizeof(*m)));
  m->scene.comm  = PETSC_COMM_WORLD;
  m->scene.quiet = PETSC_TRUE;
  m->level.dim   = 2;
  vi->scene      = &m->scene;
  vi->level      = &m->level;
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, PETSC_DECIDE, n, n, 5, NULL, 5, NULL, &vi->A));
  PetscCall(MatCreateVecs(vi->A, &vi->b, &vi->upper));
  PetscCall(VecDuplicate(vi->b, &vi->lower));
  PetscCall(VecSet(vi->lower, PETSC_NINFINITY));
  PetscCall(VecSet(vi->upper, PETSC_INFINITY));
  PetscCall(VecSet(vi->b, stiffness * length * 2. / PetscSqr(GRID + 1)));
  PetscCall(MatGetOwnershipRange(vi->A, &begin, &end));
  for (PetscInt k = begin; k < end; k++) {
    const PetscInt i = k % GRID, j = k / GRID, neighbour[4] = {k - 1, k + 1, k - GRID, k + GRID};
    const int      inside[4] = {i > 0, i<GRID - 1, j> 0, j < GRID - 1};
    PetscReal      diag      = 0;

    for (int d = 0; d < 4; d++) {
      if (inside[d]) PetscCall(MatSetValue(vi->A, k, neighbour[d], -stiffness, INSERT_VALUES));
      if (inside[d] || held) diag += stiffness;
    }
    PetscCall(MatSetValue(vi->A, k, k, diag, INSERT_VALUES));
    if (bounded && PetscAbsInt(j - GRID / 2) <= 1)
      PetscCall(VecSetValue(vi->upper, k, length * Wire(i), INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(vi->A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(vi->A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatSetOption(vi->A, MAT_SPD, PETSC_TRUE));
  vi->assembled = PETSC_TRUE;
  PetscCall(VecAssemblyBegin(vi->upper));
  PetscCall(VecAssemblyEnd(vi->upper));
  PetscFunctionReturn(0);
}

static PetscErrorCode MembraneDestroy(Membrane *m)
{
  PetscFunctionBeginUser;
  PetscCall(MatDestroy(&m->vi.A));
  PetscCall(VecDestroy(&m->vi.b));
  PetscCall(VecDestroy(&m->vi.lower));
  PetscCall(VecDestroy(&m->vi.upper));
  PetscFunctionReturn(0);
}

#endif

/* coneprojection.c -- the point of a polyhedron next to a target, by nonnegative least squares.

   With s = q - target the problem is to find the shortest s with row.s <= bound - row.target =: h. Where r is the residual of
   min | sum_i y_i (row_i, -h_i) - (0, .., 0, 1) |, y >= 0, it is s_k = r_k / r_(m+1) up to sign [1, 23.27]: what a row pushes is what the
   shortest vector owes it.

   References: [1] Lawson, Hanson, Solving Least Squares Problems, 1974, problem LDP. */
#include "base/compat.h"
#include "rigid/rigidimpl.h"

/* Of the residual along rows in use, whose last component is between 0 and 1. */
static const PetscReal PRICE = 1e-14;

PetscErrorCode ConeProject(const Cone *cone, const PetscReal bound[], const PetscReal target[], PetscReal q[])
{
  const PetscInt m = cone->m, n = m + 1;
  PetscReal     *rows, *unit, size = 0;
  Cone           lifted = {.comm = cone->comm, .num = cone->num, .m = n, .both = cone->both};
  NNLS           nnls;

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < m; k++) size = PetscMax(size, PetscAbsReal(target[k]));
  if (size <= 0) size = 1;
  PetscCall(PetscCalloc2(cone->num * n, &rows, n, &unit));
  for (PetscInt r = 0; r < cone->num; r++) {
    PetscReal excess = -bound[r] / size; // of the target over the bound, in units of the target

    for (PetscInt k = 0; k < m; k++) {
      rows[r * n + k] = -cone->rows[r * m + k];
      excess += cone->rows[r * m + k] * target[k] / size;
    }
    rows[r * n + m] = excess;
  }
  unit[m]     = 1;
  lifted.rows = rows;
  PetscCall(NNLSCreate(n, unit, &nnls));
  PetscCall(ConeSolve(&lifted, PRICE, &nnls, NULL));
  for (PetscInt k = 0; k < m; k++) q[k] = target[k] - size * nnls.residual[k] / nnls.residual[m];
  PetscCall(NNLSDestroy(&nnls));
  PetscCall(PetscFree2(rows, unit));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* loadspread.c -- total forces and moments of a side as tractions.

   Let c be the centroid of the side. A traction t = a + b x (x - c) has the resultant A a and the moment J b
   about c (eq. 8.5),

       J = int |r|^2 I - r r',   r = x - c.

   So a total force and a total moment each have one such traction. The rule is that of the load, on the same
   facets. So nodal loads sum up to the datum except for roundoff, also on curved sides. */
#include "base/compat.h"
#include "kernel/dense.h"
#include "problem/loadterm.h"

enum { MOMENTS = 10 }; /* of a side: 1, x, x x' */

/* Area, first and second moments of the side about a point, of all ranks.
   [in] origin - [3]; [out] sums - [MOMENTS] */
static PetscErrorCode LoadSpreadGetMoments_Private(const LoadTerm *term, const PetscReal origin[], PetscReal sums[])
{
  const PetscInt dim = term->dim;
  PetscReal      points[3 * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS], phi[ELEMENT_MAX_NODES];
  LoadElement    element;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(sums, MOMENTS));
  for (PetscInt e = 0; e < term->num; e++) {
    PetscInt num;

    LoadElementSet(term, e, &element);
    num = QuadratureRule(element.type, LoadElementFacetDegree(ElementOrder(element.type)), points, w);
    for (PetscInt q = 0; q < num; q++) {
      PetscReal x[3] = {0, 0, 0}, r[3] = {0, 0, 0}, nu[3];
      PetscReal dx = w[q] * ElementSurface(element.type, element.X, &points[q * ElementDim(element.type)], x, phi, nu);

      dx *= SceneMeasure(term->scene, x);
      for (PetscInt k = 0; k < dim; k++) r[k] = x[k] - origin[k];
      *sums += dx;
      for (PetscInt k = 0, n = 4; k < 3; k++) {
        sums[1 + k] += dx * r[k];
        for (PetscInt l = k; l < 3; l++) sums[n++] += dx * r[k] * r[l];
      }
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, MOMENTS, MPIU_REAL, MPI_SUM, term->level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LoadTermCentroid(const LoadTerm *term, PetscReal centre[], PetscReal *area)
{
  const PetscReal origin[3] = {0, 0, 0};
  PetscReal       sums[MOMENTS];

  PetscFunctionBeginUser;
  PetscCall(LoadSpreadGetMoments_Private(term, origin, sums));
  *area = sums[0];
  for (PetscInt k = 0; k < 3; k++) centre[k] = sums[1 + k] / sums[0];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* spin = J^-1 M. In a plane M and spin are along z, and J_zz is all that counts. [in] M - [3] */
static PetscErrorCode LoadSpreadMoment_Private(LoadTerm *term, const PetscReal M[])
{
  PetscReal sums[MOMENTS], trace, J[9];

  PetscFunctionBeginUser;
  PetscCall(LoadSpreadGetMoments_Private(term, term->centre, sums));
  trace = sums[4] + sums[7] + sums[9];
  for (PetscInt k = 0, n = 4; k < 3; k++) {
    for (PetscInt l = k; l < 3; l++, n++) J[3 * k + l] = J[3 * l + k] = (k == l ? trace : 0) - sums[n];
  }
  if (term->dim == 2) {
    term->spin[2] = M[2] / J[8];
  } else {
    PetscCall(PetscArraycpy(term->spin, M, 3));
    PetscCheck(DenseCholesky(3, J), PETSC_COMM_SELF, PETSC_ERR_PLIB, "A side without area");
    DenseCholeskySolve(3, J, term->spin);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LoadTermSpread(LoadTerm *term, PetscBool moment)
{
  const PetscReal origin[3] = {0, 0, 0};
  PetscReal       value[3]  = {0, 0, 0}, area;

  PetscFunctionBeginUser;
  PetscCall(LoadTermCentroid(term, term->centre, &area));
  PetscCall(ExpressionEvaluate(term->value, term->dim, origin, moment && term->dim == 2 ? &value[2] : value));
  if (moment) {
    PetscCall(LoadSpreadMoment_Private(term, value));
  } else {
    for (PetscInt k = 0; k < term->dim; k++) term->traction[k] = value[k] / area;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

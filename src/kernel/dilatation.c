/* dilatation.c -- the change of volume in cells of nearly incompressible bodies.

   Q1 with the mean is the B-bar method [1]; Q2 with linear functions and P2 with the mean are the classical
   pairs of [2]. The linear functions are those of x, not of the reference cell: on cells that are no
   parallelograms only these keep the order
   [3]. Tetrahedra have no such space: even the mean is unstable, since faces have nodes on their edges alone.

   References:
     [1] T. J. R. Hughes, Generalization of selective integration procedures to anisotropic and nonlinear
     media (1980).
     [2] D. Boffi, F. Brezzi, M. Fortin, Mixed Finite Element Methods and Applications (2013), sections 8.4
     and 8.6.
     [3] D. Boffi, L. Gastaldi, On the quadrilateral Q2-P1 element for the Stokes problem (2002). */
#include <math.h>
#include "kernel/dense.h"
#include "kernel/dilatation.h"

/* Poisson's ratios at which plain cells lose a tenth of their accuracy: of order 1, of order 2. */
static const PetscReal THRESHOLD[] = {0.45, 0.49};

PetscReal DilatationThreshold(ElementType type)
{
  return THRESHOLD[ElementOrder(type) - 1];
}

DilatationKind DilatationChoose(ElementType type, PetscReal poisson)
{
  const PetscInt  dim = ElementDim(type), order = ElementOrder(type);
  const PetscBool simplex = (PetscBool)(ElementNumNodes(ElementLinear(type)) == dim + 1);

  if (!isgreater(poisson, DilatationThreshold(type))) return DILATATION_POINTWISE;
  if (simplex) return order == 2 && dim == 2 ? DILATATION_MEAN : DILATATION_LOCKS;
  return order == 2 ? DILATATION_LINEAR : DILATATION_MEAN;
}

/* (1, x, y, z), with x counted from the cell's middle in its own size. */
static void DilatationMonomials_Private(const Dilatation *dilatation, const PetscReal x[], PetscReal monomials[])
{
  monomials[0] = 1;
  for (PetscInt a = 1; a < dilatation->num; a++)
    monomials[a] = (x[a - 1] - dilatation->origin[a - 1]) / dilatation->size;
}

/* q = L^-1 (1, x, ..) */
void DilatationShape(const Dilatation *dilatation, const PetscReal x[], PetscReal q[])
{
  const PetscInt num = dilatation->num;

  DilatationMonomials_Private(dilatation, x, q);
  for (PetscInt a = 0; a < num; a++) {
    for (PetscInt b = 0; b < a; b++) q[a] -= dilatation->L[a * num + b] * q[b];
    q[a] /= dilatation->L[a * num + a];
  }
}

/* Middle and size of the cell by its measure: mean and variance of x. */
static void DilatationSetFrame_Private(PetscInt num_points, const PetscReal x[], const PetscReal w[],
                                       Dilatation *dilatation)
{
  const PetscInt dim     = dilatation->dim;
  PetscReal      measure = 0, variance = 0;

  for (PetscInt k = 0; k < dim; k++) dilatation->origin[k] = 0;
  for (PetscInt q = 0; q < num_points; q++) {
    measure += w[q];
    for (PetscInt k = 0; k < dim; k++) dilatation->origin[k] += w[q] * x[q * dim + k];
  }
  for (PetscInt k = 0; k < dim; k++) dilatation->origin[k] /= measure;
  for (PetscInt q = 0; q < num_points; q++) {
    for (PetscInt k = 0; k < dim; k++) variance += w[q] * PetscSqr(x[q * dim + k] - dilatation->origin[k]);
  }
  dilatation->size = PetscSqrtReal(variance / measure);
}

void DilatationSet(DilatationKind kind, const ElementRule *rule, const PetscReal x[], const PetscReal w[],
                   const PetscReal div[], Dilatation *dilatation)
{
  const PetscInt dim = ElementDim(rule->type), num_dofs = ElementNumNodes(rule->type) * dim;
  const PetscInt functions[] = {0, 1, dim + 1, 0}, num = functions[kind]; /* DilatationKind */
  PetscReal      f[DILATATION_MAX_FUNCTIONS];

  dilatation->num      = num;
  dilatation->dim      = dim;
  dilatation->num_dofs = num_dofs;
  if (!num) return;
  DilatationSetFrame_Private(rule->num, x, w, dilatation);
  for (PetscInt i = 0; i < num * num; i++) dilatation->L[i] = 0;
  for (PetscInt i = 0; i < num * num_dofs; i++) dilatation->rows[i] = 0;
  for (PetscInt q = 0; q < rule->num; q++) {
    DilatationMonomials_Private(dilatation, &x[q * dim], f);
    for (PetscInt a = 0; a < num; a++) {
      for (PetscInt b = 0; b < num; b++) dilatation->L[a * num + b] += w[q] * f[a] * f[b];
    }
  }
  (void)DenseCholesky(num, dilatation->L); /* regular: a cell is no line, and has more points than functions */
  for (PetscInt q = 0; q < rule->num; q++) {
    DilatationShape(dilatation, &x[q * dim], f);
    for (PetscInt a = 0; a < num; a++) {
      for (PetscInt i = 0; i < num_dofs; i++) dilatation->rows[a * num_dofs + i] += w[q] * f[a] * div[q * num_dofs + i];
    }
  }
}

/* sum_ab (int bulk q_a q_b) rows_ai rows_bj */
void DilatationStiffness(const Dilatation *dilatation, PetscInt num_points, const PetscReal x[], const PetscReal bulk[],
                         PetscReal Ke[])
{
  const PetscInt num = dilatation->num, n = dilatation->num_dofs;
  PetscReal      q[DILATATION_MAX_FUNCTIONS], products[DILATATION_MAX_FUNCTIONS][DILATATION_MAX_FUNCTIONS] = {{0}};

  for (PetscInt point = 0; point < num_points; point++) {
    DilatationShape(dilatation, &x[point * dilatation->dim], q);
    for (PetscInt a = 0; a < num; a++) {
      for (PetscInt b = 0; b < num; b++) products[a][b] += bulk[point] * q[a] * q[b];
    }
  }
  for (PetscInt a = 0; a < num; a++) {
    PetscReal row[DILATATION_MAX_DOFS] = {0};

    for (PetscInt b = 0; b < num; b++) {
      for (PetscInt j = 0; j < n; j++) row[j] += products[a][b] * dilatation->rows[b * n + j];
    }
    for (PetscInt i = 0; i < n; i++) {
      for (PetscInt j = i; j < n; j++) Ke[i * n + j] += dilatation->rows[a * n + i] * row[j];
    }
  }
}

PetscReal DilatationEvaluate(const Dilatation *dilatation, const PetscReal x[], const PetscReal u[])
{
  PetscReal q[DILATATION_MAX_FUNCTIONS], theta = 0;

  DilatationShape(dilatation, x, q);
  for (PetscInt a = 0; a < dilatation->num; a++) {
    for (PetscInt i = 0; i < dilatation->num_dofs; i++)
      theta += q[a] * dilatation->rows[a * dilatation->num_dofs + i] * u[i];
  }
  return theta;
}

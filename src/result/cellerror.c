/* cellerror.c -- integrals of an error over cells.

   The rule has four points in each direction for order 1 and seven for order 2, far more than the square of a smooth error
   needs: where the exact solution has a kink or is singular at a node, it is the number of points that counts. */
#include <mortise/compat.h>
#include <mortise/elasticity.h>
#include "cellerror.h"
#include "exact.h"

enum { DEGREE_PER_ORDER = 6, MAX_STRAINS = 6, MAX_DIM = 3 };

/* What is compared with what: nodal values against nodal values, or against a formula for each body. */
typedef struct {
  Scene              scene;
  Level             *level;
  const PetscScalar *u, *v; /* local forms; v may be NULL */
} Comparison;

/* Value and gradient g[k][i] = d value_i / d x_k of nodal values at a point of cell c. [out] value - [dim];
   [out] g - [dim][dim] */
static void Interpolate_Private(const Level *level, PetscInt c, const PetscScalar nodal[], const PetscReal phi[],
                                const PetscReal grad[], PetscReal value[], PetscReal g[])
{
  const PetscInt *nodes = &level->cell_nodes[level->cell_start[c]], dim = level->dim;
  const PetscInt  n = level->cell_start[c + 1] - level->cell_start[c];

  for (PetscInt i = 0; i < dim; ++i) {
    value[i] = 0;
    for (PetscInt k = 0; k < dim; ++k) g[k * dim + i] = 0;
    for (PetscInt a = 0; a < n; ++a) {
      const PetscReal ua = PetscRealPart(nodal[nodes[a] * dim + i]);

      value[i] += phi[a] * ua;
      for (PetscInt k = 0; k < dim; ++k) g[k * dim + i] += ua * grad[a * dim + k];
    }
  }
}

/* eps : C eps of a displacement with this gradient. The displacement is sum_k x_k g_k: as many "nodes" as directions, whose
   shape functions are the coordinates. */
static PetscReal EnergyDensity_Private(PetscInt dim, PetscInt num_strains, const PetscReal C[], const PetscReal g[])
{
  static const PetscReal axes[MAX_DIM + 1][MAX_DIM * MAX_DIM] = {{0}, {1}, {1, 0, 0, 1}, {1, 0, 0, 0, 1, 0, 0, 0, 1}};
  PetscReal              B[MAX_STRAINS * MAX_DIM * MAX_DIM], strain[MAX_STRAINS], density = 0;

  ElementStrainMatrix(dim, dim, axes[dim], B);
  for (PetscInt s = 0; s < num_strains; ++s) {
    strain[s] = 0;
    for (PetscInt j = 0; j < dim * dim; ++j) strain[s] += B[s * dim * dim + j] * g[j];
  }
  for (PetscInt r = 0; r < num_strains; ++r)
    for (PetscInt s = 0; s < num_strains; ++s) density += strain[r] * C[r * num_strains + s] * strain[s];
  return density;
}

/* Adds one cell. */
static PetscErrorCode AddCell_Private(const Comparison *compare, PetscInt c, ErrorSquares *sum)
{
  const Level      *level = compare->level;
  const ElementType type  = (ElementType)level->cell_type[c];
  const PetscInt    dim = level->dim, body = level->cell_body[c], n = ElementNumNodes(type);
  const PetscInt   *nodes = &level->cell_nodes[level->cell_start[c]], ns = MaterialNumStrains(compare->scene->model);
  PetscReal         X[MAX_DIM * ELEMENT_MAX_NODES], xi[MAX_DIM * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS], x[MAX_DIM];
  PetscReal         phi[ELEMENT_MAX_NODES], grad[MAX_DIM * ELEMENT_MAX_NODES], C[MAX_STRAINS * MAX_STRAINS], poisson;
  PetscReal         e[MAX_DIM], ge[MAX_DIM * MAX_DIM], v[MAX_DIM], gv[MAX_DIM * MAX_DIM];
  const PetscInt    num_points = ElementQuadrature(type, DEGREE_PER_ORDER * ElementOrder(type), xi, w);

  PetscFunctionBeginUser;
  for (PetscInt a = 0; a < n; ++a) PetscCall(PetscArraycpy(&X[a * dim], &level->coords[nodes[a] * dim], dim));
  for (PetscInt q = 0; q < num_points; ++q) {
    const PetscReal dx = w[q] * ElementMap(type, X, &xi[q * dim], x, phi, grad) * compare->scene->thickness;

    PetscCall(ElasticityHooke(compare->scene, body, x, C, &poisson));
    Interpolate_Private(level, c, compare->u, phi, grad, e, ge);
    if (compare->v)
      Interpolate_Private(level, c, compare->v, phi, grad, v, gv);
    else
      PetscCall(ExactEvaluate(compare->scene->bodies[body].exact, type, X, &xi[q * dim], grad, v, gv));
    for (PetscInt i = 0; i < dim; ++i) {
      e[i] -= v[i];
      sum->error_l2 += dx * PetscSqr(e[i]);
      sum->size_l2 += dx * PetscSqr(v[i]);
    }
    for (PetscInt j = 0; j < dim * dim; ++j) ge[j] -= gv[j];
    sum->error_energy += dx * EnergyDensity_Private(dim, ns, C, ge);
    sum->size_energy += dx * EnergyDensity_Private(dim, ns, C, gv);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CellErrorsIntegrate(Scene scene, Level *level, Vec u, Vec v, ErrorSquares squares[])
{
  const PetscMPIInt count   = (PetscMPIInt)(scene->num_bodies * (PetscInt)(sizeof(ErrorSquares) / sizeof(PetscReal)));
  Comparison        compare = {.scene = scene, .level = level};
  Vec               local_u, local_v = NULL;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(squares, scene->num_bodies));
  PetscCall(VecGhostGetLocalForm(u, &local_u));
  PetscCall(VecGetArrayRead(local_u, &compare.u));
  if (v) {
    PetscCall(VecGhostGetLocalForm(v, &local_v));
    PetscCall(VecGetArrayRead(local_v, &compare.v));
  }
  for (PetscInt c = 0; c < level->num_cells; ++c) {
    const PetscInt body = level->cell_body[c];

    if (v || scene->bodies[body].exact) PetscCall(AddCell_Private(&compare, c, &squares[body]));
  }
  if (v) {
    PetscCall(VecRestoreArrayRead(local_v, &compare.v));
    PetscCall(VecGhostRestoreLocalForm(v, &local_v));
  }
  PetscCall(VecRestoreArrayRead(local_u, &compare.u));
  PetscCall(VecGhostRestoreLocalForm(u, &local_u));
  for (PetscInt b = 0; b < scene->num_bodies && !v; ++b)
    PetscCall(ExpressionCheck(level->comm, scene->bodies[b].exact));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, squares, count, MPIU_REAL, MPI_SUM, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

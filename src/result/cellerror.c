/* cellerror.c -- integrals of an error over cells.

   All cells are first integrated by a rule that is fine enough for a smooth error. A piece that holds more
   than a small share of the whole is then cut into halves along each axis, repeatedly. Pieces become small
   near singular points of the exact solution, and nowhere else unless there are few cells. So their number is
   bounded, and the error of the rule in the remaining pieces is a small part of a small share. */
#include "base/compat.h"
#include "kernel/vector.h"
#include "problem/elasticity.h"
#include "result/cellerror.h"
#include "result/exact.h"

enum { MAX_STRAINS = 6, MAX_DIM = 3, MAX_DEPTH = 16 };

/* Largest part of the integral over a body in a piece that is not cut. The error of the rule is some
   hundredths in a piece at a singular point, below 1e-3 of the integral. Measured beside stresses like
   r^(1/2): 1e-7 of the norm. */
static const PetscReal SHARE = 1e-2;

/* An error norm below this part of the solution's is rounding. That of a difference quotient grows as pieces
   shrink: cutting would never end. */
static const PetscReal NORM_ROUNDING = 1e-9;

/* The two fields of a comparison: nodal values and nodal values, or nodal values and a formula for each
   body. */
typedef struct {
  Scene              scene;
  Level             *level;
  const PetscScalar *u, *v;     /* local forms; v may be NULL */
  ElementRule       *stiffness; /* of every type of cell, for Pi */
} Comparison;

/* In the plane four points in each direction for order 1, five for order 2. This leaves four orders of h
   beyond the error of a smooth solution. In space one less, and two orders of h: every point costs thirteen
   evaluations of the exact solution. */
static PetscInt CellErrorDegree_Private(ElementType type)
{
  return 2 * ElementOrder(type) + (ElementDim(type) < 3 ? 4 : 2);
}

static void CellErrorAddSquares_Private(ErrorSquares *sum, const ErrorSquares *part)
{
  sum->error_l2 += part->error_l2;
  sum->error_energy += part->error_energy;
  sum->size_l2 += part->size_l2;
  sum->size_energy += part->size_energy;
}

/* Value and gradient g[k][i] = d value_i / d x_k of nodal values at a point of cell c. [out] value - [dim];
   [out] g - [dim][dim] */
static void CellErrorInterpolate_Private(const Level *level, PetscInt c, const PetscScalar nodal[],
                                         const PetscReal phi[], const PetscReal grad[], PetscReal value[],
                                         PetscReal g[])
{
  const PetscInt *nodes = &level->cell_nodes[level->cell_start[c]], dim = level->dim;
  const PetscInt  n = level->cell_start[c + 1] - level->cell_start[c];

  for (PetscInt i = 0; i < dim; i++) {
    value[i] = 0;
    for (PetscInt k = 0; k < dim; k++) g[k * dim + i] = 0;
    for (PetscInt a = 0; a < n; a++) {
      const PetscReal ua = PetscRealPart(nodal[nodes[a] * dim + i]);

      value[i] += phi[a] * ua;
      for (PetscInt k = 0; k < dim; k++) g[k * dim + i] += ua * grad[a * dim + k];
    }
  }
}

/* Strain of a displacement u with gradient g at x. Near x it is u + sum_k dx_k g_k: one "node" for the value,
   whose shape function is 1, and one for each direction. The shape functions of these are the coordinates
   from x. */
static void CellErrorGetStrain_Private(Scene scene, const PetscReal x[], const PetscReal u[], const PetscReal g[],
                                       PetscReal strain[])
{
  static const PetscReal axes[MAX_DIM + 1][(MAX_DIM + 1) * MAX_DIM] = {
      {0}, {0, 1}, {0, 0, 1, 0, 0, 1}, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}};
  const PetscBool ring              = (PetscBool)(scene->model == MODEL_AXISYMMETRIC);
  const PetscReal hoop[MAX_DIM + 1] = {ring ? 1 / x[0] : 0, 0, 0, 0};
  const PetscInt  dim = scene->dim, num_strains = MaterialNumStrains(scene->model), num = (dim + 1) * dim;
  PetscReal       B[MAX_STRAINS * (MAX_DIM + 1) * MAX_DIM];

  ElementStrainMatrix(dim, dim + 1, axes[dim], ring ? hoop : NULL, B);
  for (PetscInt s = 0; s < num_strains; s++) {
    strain[s] = 0;
    for (PetscInt j = 0; j < dim; j++) strain[s] += B[s * num + j] * u[j];
    for (PetscInt j = 0; j < dim * dim; j++) strain[s] += B[s * num + dim + j] * g[j];
  }
}

/* Adds the energies of e = u - v and of v, whose strains are given, at one point of cell c with weight dx. In
   cells with a Pi the change of volume of u is that of eq. 9.1. Between two nodal vectors it is left out
   there: that of a coarser mesh cannot be seen on the finer one. */
static PetscErrorCode CellErrorAddEnergy_Private(const Comparison *compare, PetscInt c, const Dilatation *pi,
                                                 const PetscReal x[], const PetscReal strains[2][MAX_STRAINS],
                                                 PetscReal dx, ErrorSquares *sum)
{
  const Level    *level = compare->level;
  const PetscInt *nodes = &level->cell_nodes[level->cell_start[c]], dim = level->dim;
  const PetscInt  num_strains = MaterialNumStrains(compare->scene->model);
  PetscReal       C[MAX_STRAINS * MAX_STRAINS], u[MAX_DIM * ELEMENT_MAX_NODES], poisson, bulk, change;

  PetscFunctionBeginUser;
  PetscCall(ElasticityHooke(compare->scene, level->cell_material[c], x, C, &poisson));
  bulk = pi->num ? MaterialTakeBulk(num_strains, C) : 0;
  sum->error_energy += dx * MaterialEnergyDensity(num_strains, C, strains[0]);
  sum->size_energy += dx * MaterialEnergyDensity(num_strains, C, strains[1]);
  if (!pi->num || compare->v) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt i = 0; i < pi->num_dofs; i++) u[i] = PetscRealPart(compare->u[nodes[i / dim] * dim + i % dim]);
  change = MaterialDilatation(num_strains, strains[1]);
  sum->error_energy += dx * bulk * PetscSqr(DilatationEvaluate(pi, x, u) - change);
  sum->size_energy += dx * bulk * PetscSqr(change);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* sum = the integrals over a piece of cell c, by one rule. */
static PetscErrorCode CellErrorIntegrateCell_Private(const Comparison *compare, PetscInt c, const CellPiece *piece,
                                                     ErrorSquares *sum)
{
  const Level      *level = compare->level;
  const ElementType type  = (ElementType)level->cell_type[c];
  const PetscInt    dim = level->dim, body = level->cell_body[c];
  const PetscInt   *nodes = &level->cell_nodes[level->cell_start[c]];
  PetscReal         X[MAX_DIM * ELEMENT_MAX_NODES], points[MAX_DIM * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS];
  PetscReal         xi[MAX_DIM], x[MAX_DIM], phi[ELEMENT_MAX_NODES], grad[MAX_DIM * ELEMENT_MAX_NODES];
  PetscReal         strains[2][MAX_STRAINS], e[MAX_DIM], ge[MAX_DIM * MAX_DIM], v[MAX_DIM], gv[MAX_DIM * MAX_DIM];
  const PetscInt    num_points = QuadratureRule(type, CellErrorDegree_Private(type), points, w);
  const CellPoint   at         = {type, X, xi, grad, piece->size};
  Dilatation        pi;

  PetscFunctionBeginUser;
  PetscCall(ElasticityDilatation(compare->scene, level, c, &compare->stiffness[type], &pi));
  *sum = (ErrorSquares){0, 0, 0, 0};
  VectorGather(dim, ElementNumNodes(type), nodes, level->coords, X);
  for (PetscInt q = 0; q < num_points; q++) {
    PetscReal dx;

    CellPiecePoint(type, piece, &points[q * dim], xi);
    dx = piece->measure * w[q] * ElementMap(type, X, xi, x, phi, grad);
    dx *= SceneMeasure(compare->scene, x);
    CellErrorInterpolate_Private(level, c, compare->u, phi, grad, e, ge);
    if (compare->v)
      CellErrorInterpolate_Private(level, c, compare->v, phi, grad, v, gv);
    else
      PetscCall(ExactEvaluate(compare->scene->bodies[body].exact, &at, v, gv));
    for (PetscInt i = 0; i < dim; i++) {
      e[i] -= v[i];
      sum->error_l2 += dx * PetscSqr(e[i]);
      sum->size_l2 += dx * PetscSqr(v[i]);
    }
    for (PetscInt j = 0; j < dim * dim; j++) ge[j] -= gv[j];
    CellErrorGetStrain_Private(compare->scene, x, e, ge, strains[0]);
    CellErrorGetStrain_Private(compare->scene, x, v, gv, strains[1]);
    PetscCall(CellErrorAddEnergy_Private(compare, c, &pi, x, strains, dx, sum));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a part holds more than its share of any of the integrals. */
static PetscBool CellErrorIsLarge_Private(const ErrorSquares *part, const ErrorSquares *total)
{
  return (PetscBool)(part->error_l2 > SHARE * total->error_l2 || part->error_energy > SHARE * total->error_energy ||
                     part->size_l2 > SHARE * total->size_l2 || part->size_energy > SHARE * total->size_energy);
}

/* Adds a piece of cell c whose integrals are known, or its parts where it is large. */
static PetscErrorCode CellErrorAddSubcell_Private(const Comparison *compare, PetscInt c, const CellPiece *piece,
                                                  PetscInt depth, const ErrorSquares *known, const ErrorSquares *total,
                                                  ErrorSquares *sum)
{
  CellPiece    parts[ELEMENT_MAX_PIECES];
  ErrorSquares part;
  PetscInt     num;

  PetscFunctionBeginUser;
  if (depth == MAX_DEPTH || !CellErrorIsLarge_Private(known, total)) {
    CellErrorAddSquares_Private(sum, known);
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  num = CellPieceCut((ElementType)compare->level->cell_type[c], piece, parts);
  if (!num) CellErrorAddSquares_Private(sum, known);
  for (PetscInt i = 0; i < num; i++) {
    PetscCall(CellErrorIntegrateCell_Private(compare, c, &parts[i], &part));
    PetscCall(CellErrorAddSubcell_Private(compare, c, &parts[i], depth + 1, &part, total, sum));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sums of all ranks. [in,out] squares - [num] */
static PetscErrorCode CellErrorReduce_Private(const Level *level, PetscInt num, ErrorSquares squares[])
{
  const PetscMPIInt count = (PetscMPIInt)(num * (PetscInt)(sizeof(ErrorSquares) / sizeof(PetscReal)));

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, squares, count, MPIU_REAL, MPI_SUM, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Takes errors that are rounding out of what CellErrorIsLarge_Private() looks at. [in,out] totals - [num] */
static void CellErrorIgnoreRounding_Private(PetscInt num, ErrorSquares totals[])
{
  const PetscReal square = PetscSqr(NORM_ROUNDING);

  for (PetscInt b = 0; b < num; b++) {
    if (totals[b].error_l2 <= square * totals[b].size_l2) totals[b].error_l2 = PETSC_INFINITY;
    if (totals[b].error_energy <= square * totals[b].size_energy) totals[b].error_energy = PETSC_INFINITY;
  }
}

/* Both rounds over the cells. */
static PetscErrorCode CellErrorAddCells_Private(const Comparison *compare, ErrorSquares squares[])
{
  const Level    *level = compare->level;
  const Scene     scene = compare->scene;
  const CellPiece whole = CellPieceWhole();
  ErrorSquares   *cells, *totals;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc2(level->num_cells, &cells, scene->num_bodies, &totals));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const PetscInt body = level->cell_body[c];

    if (!compare->v && !scene->bodies[body].exact) continue;
    PetscCall(CellErrorIntegrateCell_Private(compare, c, &whole, &cells[c]));
    CellErrorAddSquares_Private(&totals[body], &cells[c]);
  }
  PetscCall(CellErrorReduce_Private(level, scene->num_bodies, totals));
  CellErrorIgnoreRounding_Private(scene->num_bodies, totals);
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const PetscInt body = level->cell_body[c];

    PetscCall(CellErrorAddSubcell_Private(compare, c, &whole, 0, &cells[c], &totals[body], &squares[body]));
  }
  PetscCall(CellErrorReduce_Private(level, scene->num_bodies, squares));
  PetscCall(PetscFree2(cells, totals));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CellErrorsIntegrate(Scene scene, Level *level, Vec u, Vec v, ErrorSquares squares[])
{
  Comparison compare = {.scene = scene, .level = level};
  Vec        local_u, local_v = NULL;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(squares, scene->num_bodies));
  PetscCall(VecGhostGetLocalForm(u, &local_u));
  PetscCall(VecGetArrayRead(local_u, &compare.u));
  if (v) {
    PetscCall(VecGhostGetLocalForm(v, &local_v));
    PetscCall(VecGetArrayRead(local_v, &compare.v));
  }
  PetscCall(ElasticityRulesCreate(scene, &compare.stiffness));
  PetscCall(CellErrorAddCells_Private(&compare, squares));
  PetscCall(PetscFree(compare.stiffness));
  if (v) {
    PetscCall(VecRestoreArrayRead(local_v, &compare.v));
    PetscCall(VecGhostRestoreLocalForm(v, &local_v));
  }
  PetscCall(VecRestoreArrayRead(local_u, &compare.u));
  PetscCall(VecGhostRestoreLocalForm(u, &local_u));
  for (PetscInt b = 0; b < scene->num_bodies && !v; b++)
    PetscCall(ExpressionCheck(level->comm, scene->bodies[b].exact));
  PetscFunctionReturn(PETSC_SUCCESS);
}

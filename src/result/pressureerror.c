/* pressureerror.c -- error of a pressure, as the field in files and row by row. */
#include "base/compat.h"
#include "kernel/vector.h"
#include "level/ghosted.h"
#include "result/pressureerror.h"

/* Eight points on a line: an exact pressure may have a kink within a facet, where contact ends. */
enum { FACET_DEGREE = 14, MAX_DIM = 3 };

/* What a node of the side has, in one ghosted vector. */
enum { NODE_PRESSURE, NODE_COVERED, NODE_COUNT };

/* Squares of error and exact pressure, in both norms. */
enum { ERROR_L2, SIZE_L2, ERROR_WEIGHTED, SIZE_WEIGHTED, SQUARES };

/* Nodal values of a pair where facets can ask for them, also at ghosts. [out] values - owned by the caller */
static PetscErrorCode PressureErrorGetNodalValues_Private(Fields fields, PetscInt p, Vec *values)
{
  Level       *level = fields->vi->level;
  PairFields   nodal;
  PetscScalar *a;

  PetscFunctionBeginUser;
  PetscCall(PairFieldsCreate(fields, p, &nodal));
  PetscCall(LevelCreateVec(level, NODE_COUNT, values));
  PetscCall(VecGetArray(*values, &a));
  for (PetscInt i = 0; i < level->num_owned; i++) {
    a[i * NODE_COUNT + NODE_PRESSURE] = nodal.pressure[i];
    a[i * NODE_COUNT + NODE_COVERED]  = nodal.covered[i] ? 1 : 0;
  }
  PetscCall(VecRestoreArray(*values, &a));
  PetscCall(LevelShareVec(*values, INSERT_VALUES));
  PetscCall(PairFieldsDestroy(&nodal));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds one facet, unless a node of it has no pressure. [in] values - [num_nodes][NODE_COUNT] */
static PetscErrorCode PressureErrorAddFacet_Private(const Level *level, const Facets *facets, PetscInt f,
                                                    Expression exact, const PetscScalar values[], PetscReal squares[])
{
  const ElementType type  = facets->type[f];
  const PetscInt   *nodes = &facets->nodes[f * ELEMENT_MAX_FACET_NODES], n = ElementNumNodes(type), dim = level->dim;
  PetscReal         X[MAX_DIM * ELEMENT_MAX_FACET_NODES], xi[MAX_DIM * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS];
  PetscReal         phi[ELEMENT_MAX_NODES], x[MAX_DIM], p;
  const PetscInt    num_points = QuadratureRule(type, FACET_DEGREE, xi, w);

  PetscFunctionBeginUser;
  for (PetscInt a = 0; a < n; a++)
    if (PetscRealPart(values[nodes[a] * NODE_COUNT + NODE_COVERED]) == 0) PetscFunctionReturn(PETSC_SUCCESS);
  VectorGather(dim, n, nodes, level->coords, X);
  for (PetscInt q = 0; q < num_points; q++) {
    PetscReal ds = w[q] * ElementSurface(type, X, &xi[q * ElementDim(type)], x, phi, NULL), ph = 0;

    ds *= SceneMeasure(level->scene, x);
    PetscCall(ExpressionEvaluate(exact, dim, x, &p));
    for (PetscInt a = 0; a < n; a++) ph += phi[a] * PetscRealPart(values[nodes[a] * NODE_COUNT + NODE_PRESSURE]);
    squares[ERROR_L2] += ds * PetscSqr(ph - p);
    squares[SIZE_L2] += ds * PetscSqr(p);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode PressureErrorAddFacets_Private(Fields fields, PetscInt p, PetscReal squares[])
{
  const ScenePair   *spec  = fields->vi->pairs[p]->spec;
  Level             *level = fields->vi->level;
  Facets             facets;
  Vec                nodal;
  const PetscScalar *values;

  PetscFunctionBeginUser;
  PetscCall(PressureErrorGetNodalValues_Private(fields, p, &nodal));
  PetscCall(LevelGetFacets(level, fields->vi->scene, spec->nonmortar.body, spec->nonmortar.side, &facets));
  PetscCall(GhostedGetArrayRead(nodal, &values));
  for (PetscInt f = 0; f < facets.num; f++)
    PetscCall(PressureErrorAddFacet_Private(level, &facets, f, spec->exact, values, squares));
  PetscCall(GhostedRestoreArrayRead(nodal, &values));
  PetscCall(FacetsDestroy(&facets));
  PetscCall(VecDestroy(&nodal));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Rows have the measure in their D. */
static PetscErrorCode PressureErrorAddRows_Private(Fields fields, PetscInt p, PetscReal squares[])
{
  const VI         vi   = fields->vi;
  const Pair       pair = vi->pairs[p];
  const PetscReal *lambda;
  PetscReal        exact;

  PetscFunctionBeginUser;
  if (!fields->lambda) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecGetArrayRead(fields->lambda, &lambda));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const PetscReal *x = &vi->level->coords[pair->nodes[vi->row_node[r]] * vi->level->dim];

    if (vi->row_pair[r] != p || vi->row_direction[r] != 0) continue;
    PetscCall(ExpressionEvaluate(pair->spec->exact, vi->level->dim, x, &exact));
    squares[ERROR_WEIGHTED] += vi->row_D[r] * PetscSqr(lambda[r] - exact);
    squares[SIZE_WEIGHTED] += vi->row_D[r] * PetscSqr(exact);
  }
  PetscCall(VecRestoreArrayRead(fields->lambda, &lambda));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PressureErrorCompute(Fields fields, PetscInt p, PressureError *error)
{
  PetscReal squares[SQUARES] = {0};

  PetscFunctionBeginUser;
  PetscCall(PressureErrorAddFacets_Private(fields, p, squares));
  PetscCall(PressureErrorAddRows_Private(fields, p, squares));
  PetscCall(ExpressionCheck(fields->vi->level->comm, fields->vi->pairs[p]->spec->exact));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, squares, SQUARES, MPIU_REAL, MPI_SUM, fields->vi->level->comm));
  error->l2          = PetscSqrtReal(squares[ERROR_L2]);
  error->weighted    = PetscSqrtReal(squares[ERROR_WEIGHTED]);
  error->l2_relative = squares[SIZE_L2] > 0 ? PetscSqrtReal(squares[ERROR_L2] / squares[SIZE_L2]) : NAN;
  error->weighted_relative =
      squares[SIZE_WEIGHTED] > 0 ? PetscSqrtReal(squares[ERROR_WEIGHTED] / squares[SIZE_WEIGHTED]) : NAN;
  PetscFunctionReturn(PETSC_SUCCESS);
}

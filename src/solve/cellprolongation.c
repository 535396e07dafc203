/* cellprolongation.c -- prolongation of least energy inside of coarse cells.

   A coarse displacement may keep the volume of each coarse cell in the mean. Interpolated, it may still
   change the volume of each part: a large energy that only interpolation makes. Nodes inside a coarse cell
   can move volume between its parts. Those of different cells do not couple, so each cell is a small system
   of its own [1]. Displacements on boundaries of cells and of a coarse node inside stay those of the shape
   functions.

   References: [1] Schoeberl, Multigrid methods for a parameter dependent problem in primal variables,
   1999. */
#include "base/compat.h"
#include "base/csrmatrix.h"
#include "kernel/dense.h"
#include "problem/elasticity.h"
#include "solve/cellprolongation.h"

/* Nodes inside of coarse cells, cell by cell. */
typedef struct {
  const Level *coarse, *fine; /* borrowed */
  PetscInt     num;
  PetscInt    *cell;  /* coarse [num] */
  PetscInt    *start; /* into node [num + 1] */
  PetscInt    *node;  /* own fine nodes [start[num]] */
} Insides;

static PetscErrorCode InsidesDestroy_Private(Insides *insides)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(insides->cell));
  PetscCall(PetscFree(insides->start));
  PetscCall(PetscFree(insides->node));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Unknowns of the coarse cell i, which its rows of P have. */
static PetscInt InsidesWidth_Private(const Insides *insides, PetscInt i)
{
  const Level   *coarse = insides->coarse;
  const PetscInt c      = insides->cell[i];

  return coarse->dim * (coarse->cell_start[c + 1] - coarse->cell_start[c]);
}

/* Which node of a coarse cell has a global number, -1 if none. */
static PetscInt CellFindNode_Private(const Level *coarse, PetscInt c, PetscInt global)
{
  for (PetscInt k = coarse->cell_start[c]; k < coarse->cell_start[c + 1]; k++)
    if (coarse->node_global[coarse->cell_nodes[k]] == global) return k - coarse->cell_start[c];
  return -1;
}

/* Whether a fine node is inside a coarse cell and not one of its nodes. Then it is interpolated from nodes
   that share no facet. */
static PetscErrorCode CellHasInside_Private(const Level *coarse, PetscInt c, Mat nodal, PetscInt row, PetscBool *inside)
{
  const ElementType type  = (ElementType)coarse->cell_type[c];
  const PetscInt    nodes = ElementNumNodes(ElementFacetType(type));
  PetscInt          num;
  const PetscInt   *columns;

  PetscFunctionBeginUser;
  PetscCall(MatGetRow(nodal, row, &num, &columns, NULL));
  *inside = (PetscBool)(num > 1);
  for (PetscInt j = 0; j < num; j++)
    if (CellFindNode_Private(coarse, c, columns[j]) < 0) *inside = PETSC_FALSE;
  for (PetscInt f = 0; f < ElementNumFacets(type) && *inside; f++) {
    const PetscInt *facet = ElementFacetNodes(type, f);
    PetscInt        on    = 0;

    for (PetscInt j = 0; j < num; j++)
      for (PetscInt k = 0; k < nodes; k++) on += facet[k] == CellFindNode_Private(coarse, c, columns[j]);
    if (on == num) *inside = PETSC_FALSE;
  }
  PetscCall(MatRestoreRow(nodal, row, &num, &columns, NULL));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The transform of the mesh numbers the parts of each cell one after the other. */
static PetscErrorCode InsidesCreate_Private(Scene scene, const Level *coarse, const Level *fine, Insides *insides)
{
  const PetscInt parts = (PetscInt)1 << fine->dim;
  ElementRule   *rules;
  PetscBool     *seen;

  PetscFunctionBeginUser;
  *insides = (Insides){.coarse = coarse, .fine = fine};
  PetscCall(PetscMalloc1(coarse->num_cells, &insides->cell));
  PetscCall(PetscCalloc1(coarse->num_cells + 1, &insides->start));
  PetscCall(PetscMalloc1(fine->num_owned, &insides->node));
  PetscCall(PetscCalloc1(fine->num_owned, &seen));
  PetscCall(ElasticityRulesCreate(scene, &rules));
  for (PetscInt c = 0; c < coarse->num_cells; c++) {
    PetscInt       end = insides->start[insides->num];
    DilatationKind kind;
    PetscReal      poisson;

    PetscCall(ElasticityDilatationKind(scene, coarse, c, &rules[coarse->cell_type[c]], &kind, &poisson));
    if (kind == DILATATION_POINTWISE) continue;
    for (PetscInt k = fine->cell_start[c * parts]; k < fine->cell_start[(c + 1) * parts]; k++) {
      const PetscInt node   = fine->cell_nodes[k];
      PetscBool      inside = PETSC_FALSE;

      if (node >= fine->num_owned || seen[node]) continue;
      seen[node] = PETSC_TRUE;
      PetscCall(CellHasInside_Private(coarse, c, fine->prolongation, fine->node_begin + node, &inside));
      if (inside) insides->node[end++] = node;
    }
    if (end == insides->start[insides->num]) continue;
    insides->cell[insides->num]    = c;
    insides->start[++insides->num] = end;
  }
  PetscCall(PetscFree(rules));
  PetscCall(PetscFree(seen));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Rows of K at nodes inside, and what they give for displacements of coarse nodes. [out] rows, forces - in
   the order of insides->node */
static PetscErrorCode InsidesGetRows_Private(const Insides *insides, Mat K, Mat P, Mat *rows, Mat *forces)
{
  const Level   *fine = insides->fine;
  const PetscInt dim = fine->dim, num = dim * insides->start[insides->num];
  PetscInt      *list, n;
  IS             which, all;
  Mat            whole;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(num, &list));
  for (PetscInt i = 0; i < num; i++) list[i] = dim * (fine->node_begin + insides->node[i / dim]) + i % dim;
  PetscCall(ISCreateGeneral(fine->comm, num, list, PETSC_OWN_POINTER, &which));
  PetscCall(MatGetLocalSize(K, &n, NULL));
  PetscCall(ISCreateStride(fine->comm, n, dim * fine->node_begin, 1, &all));
  PetscCall(MatConvert(K, MATAIJ, MAT_INITIAL_MATRIX, &whole));
  PetscCall(MatCreateSubMatrix(whole, which, all, MAT_INITIAL_MATRIX, rows));
  PetscCall(MatDestroy(&whole));
  PetscCall(MatMatMult(*rows, P, MAT_INITIAL_MATRIX, PETSC_DEFAULT, forces));
  PetscCall(ISDestroy(&all));
  PetscCall(ISDestroy(&which));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The system of one cell: A = K_II, b = K_I P. [in] begin - first row; [in,out] A - 0 [n][n]; b - 0, by
   columns [m][n] */
static PetscErrorCode CellGetSystem_Private(const Insides *insides, PetscInt i, const Mat matrix[2], PetscInt begin,
                                            PetscReal A[], PetscReal b[])
{
  const Level   *coarse = insides->coarse, *fine = insides->fine;
  const PetscInt dim = fine->dim, first = insides->start[i], n = dim * (insides->start[i + 1] - first);

  PetscFunctionBeginUser;
  for (PetscInt which = 0; which < 2; which++) {
    for (PetscInt r = 0; r < n; r++) {
      PetscInt           num;
      const PetscInt    *columns;
      const PetscScalar *values;

      PetscCall(MatGetRow(matrix[which], begin + dim * first + r, &num, &columns, &values));
      for (PetscInt j = 0; j < num; j++) {
        const PetscInt node = columns[j] / dim, k = columns[j] % dim;

        if (which) {
          b[(dim * CellFindNode_Private(coarse, insides->cell[i], node) + k) * n + r] = PetscRealPart(values[j]);
        } else {
          for (PetscInt s = first; s < insides->start[i + 1]; s++)
            if (fine->node_begin + insides->node[s] == node)
              A[r * n + dim * (s - first) + k] = PetscRealPart(values[j]);
        }
      }
      PetscCall(MatRestoreRow(matrix[which], begin + dim * first + r, &num, &columns, &values));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What is subtracted from the rows of P: K_II^-1 K_I P. [out] less - of all cells, each by rows; owned by the
   caller; [out] at - where each begins [insides->num] */
static PetscErrorCode InsidesSolve_Private(const Insides *insides, Mat K, Mat P, PetscReal **less, PetscInt at[])
{
  const PetscInt dim  = insides->coarse->dim;
  PetscInt       room = 0, largest = 0, widest = 0, begin;
  PetscReal     *A, *b;
  Mat            matrix[2];

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < insides->num; i++) {
    const PetscInt n = dim * (insides->start[i + 1] - insides->start[i]), m = InsidesWidth_Private(insides, i);

    at[i]   = room;
    largest = PetscMax(largest, n);
    widest  = PetscMax(widest, m);
    room += n * m;
  }
  PetscCall(PetscMalloc1(room, less));
  PetscCall(PetscMalloc2(largest * largest, &A, widest * largest, &b));
  PetscCall(InsidesGetRows_Private(insides, K, P, &matrix[0], &matrix[1]));
  PetscCall(MatGetOwnershipRange(matrix[0], &begin, NULL));
  for (PetscInt i = 0; i < insides->num; i++) {
    const PetscInt n = dim * (insides->start[i + 1] - insides->start[i]), m = InsidesWidth_Private(insides, i);

    PetscCall(PetscArrayzero(A, n * n));
    PetscCall(PetscArrayzero(b, m * n));
    PetscCall(CellGetSystem_Private(insides, i, matrix, begin, A, b));
    if (DenseCholesky(n, A)) {
      for (PetscInt j = 0; j < m; j++) DenseCholeskySolve(n, A, &b[j * n]);
    } else {
      PetscCall(PetscArrayzero(b, m * n)); // no better than the shape functions
    }
    for (PetscInt r = 0; r < n; r++)
      for (PetscInt j = 0; j < m; j++) (*less)[at[i] + r * m + j] = b[j * n + r];
  }
  PetscCall(MatDestroy(&matrix[0]));
  PetscCall(MatDestroy(&matrix[1]));
  PetscCall(PetscFree2(A, b));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The row of a node inside a cell: the shape functions less a correction.
   [in] less - the correction, one for each unknown of the cell; [in] P, row - the shape functions;
   [out] columns, values - ascending, one for each unknown of the cell */
static PetscErrorCode CellGetRow_Private(const Level *coarse, PetscInt c, const PetscReal less[], Mat P, PetscInt row,
                                         PetscInt columns[], PetscScalar values[])
{
  const PetscInt     dim = coarse->dim, first = coarse->cell_start[c], num = dim * (coarse->cell_start[c + 1] - first);
  PetscInt           old;
  const PetscInt    *c_old;
  const PetscScalar *v_old;

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < num; k++) {
    columns[k] = dim * coarse->node_global[coarse->cell_nodes[first + k / dim]] + k % dim;
    values[k]  = -less[k];
  }
  PetscCall(MatGetRow(P, row, &old, &c_old, &v_old));
  for (PetscInt j = 0; j < old; j++)
    values[dim * CellFindNode_Private(coarse, c, c_old[j] / dim) + c_old[j] % dim] += v_old[j];
  PetscCall(MatRestoreRow(P, row, &old, &c_old, &v_old));
  PetscCall(PetscSortIntWithScalarArray(num, columns, values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A row as it is. [out] num, columns, values */
static PetscErrorCode RowCopy_Private(Mat P, PetscInt row, PetscInt *num, PetscInt columns[], PetscScalar values[])
{
  const PetscInt    *c;
  const PetscScalar *v;

  PetscFunctionBeginUser;
  PetscCall(MatGetRow(P, row, num, &c, &v));
  PetscCall(PetscArraycpy(columns, c, *num));
  PetscCall(PetscArraycpy(values, v, *num));
  PetscCall(MatRestoreRow(P, row, NULL, &c, &v));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A matrix in place of P, of the same layout. [in] start, column, value - its rows on this rank */
static PetscErrorCode RowsReplace_Private(PetscInt bs, PetscInt start[], PetscInt column[], PetscScalar value[], Mat *P)
{
  const MPI_Comm comm = PetscObjectComm((PetscObject)*P);
  PetscInt       rows, width;

  PetscFunctionBeginUser;
  PetscCall(MatGetLocalSize(*P, &rows, &width));
  PetscCall(MatDestroy(P));
  PetscCall(CSRMatrixCreate(comm, &(CSRRows){bs, rows, width, start, column, value}, P));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Exchanges the rows of nodes inside. [in] less, at - of InsidesSolve_Private() */
static PetscErrorCode InsidesReplace_Private(const Insides *insides, const PetscReal less[], const PetscInt at[],
                                             Mat *P)
{
  const PetscInt dim = insides->fine->dim, num_owned = insides->fine->num_owned;
  PetscInt       begin, count, *of, *place, *start, *column; /* of, place: cell of a node, and which of its nodes */
  PetscScalar   *value;
  MatInfo        info;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(*P, &begin, NULL));
  PetscCall(MatGetInfo(*P, MAT_LOCAL, &info));
  count = (PetscInt)info.nz_used;
  PetscCall(PetscMalloc2(num_owned, &of, num_owned, &place));
  for (PetscInt a = 0; a < num_owned; a++) of[a] = -1;
  for (PetscInt i = 0; i < insides->num; i++) {
    for (PetscInt s = insides->start[i]; s < insides->start[i + 1]; s++) {
      of[insides->node[s]]    = i;
      place[insides->node[s]] = s - insides->start[i];
      count += dim * InsidesWidth_Private(insides, i);
    }
  }
  PetscCall(PetscMalloc3(dim * num_owned + 1, &start, count, &column, count, &value));
  start[0] = 0;
  for (PetscInt r = 0; r < dim * num_owned; r++) {
    const PetscInt a = r / dim, i = of[a];
    PetscInt       num;

    if (i < 0) {
      PetscCall(RowCopy_Private(*P, begin + r, &num, &column[start[r]], &value[start[r]]));
    } else {
      num = InsidesWidth_Private(insides, i);
      PetscCall(CellGetRow_Private(insides->coarse, insides->cell[i], &less[at[i] + (dim * place[a] + r % dim) * num],
                                   *P, begin + r, &column[start[r]], &value[start[r]]));
    }
    start[r + 1] = start[r] + num;
  }
  PetscCall(RowsReplace_Private(dim, start, column, value, P));
  PetscCall(PetscFree3(start, column, value));
  PetscCall(PetscFree2(of, place));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CellProlongationApply(Scene scene, const Level *coarse, const Level *fine, Mat K, Mat *P)
{
  Insides    insides;
  PetscReal *less;
  PetscInt  *at;

  PetscFunctionBeginUser;
  PetscCall(InsidesCreate_Private(scene, coarse, fine, &insides));
  PetscCall(PetscMalloc1(insides.num, &at));
  PetscCall(InsidesSolve_Private(&insides, K, *P, &less, at));
  PetscCall(InsidesReplace_Private(&insides, less, at, P));
  PetscCall(PetscFree(less));
  PetscCall(PetscFree(at));
  PetscCall(InsidesDestroy_Private(&insides));
  PetscFunctionReturn(PETSC_SUCCESS);
}

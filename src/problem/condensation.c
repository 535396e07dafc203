/* condensation.c -- T'KT, which differs from K next to the contact only.

   With T = 1 + E, T'KT = K + Z, Z = E'K + K E + E'K E = E'W + W'E, W = K (1 + E / 2). E has rows at the nodes
   of the nonmortar sides alone. Of W no other rows are needed. T has two factors, and this is done for one
   after the other. The second couples to the mortar side and has one row for a node in contact. With all rows
   of these nodes it would take four times as long. With Z = L'R so far, its W is (K + L'R)(1 + E / 2), in few
   rows. So both factors share one product that has all rows, the last. */
#include "base/compat.h"
#include "multigrid/fewrows.h"
#include "multigrid/transposedproduct.h"
#include "problem/condensation.h"

/* A factor 1 + E, and its W. */
typedef struct {
  const BasisFactor *factor;
  PetscInt           num;
  PetscInt          *row;    /* rows of E, and their number in E and W [num] */
  PetscInt          *number; /* [num] */
  Mat                W;
} Term;

static PetscErrorCode TermBegin_Private(Mat K, const BasisFactor *factor, Term *term)
{
  PetscInt        begin;
  const PetscInt *row;

  PetscFunctionBeginUser;
  term->factor = factor;
  PetscCall(ISGetLocalSize(factor->rows, &term->num));
  PetscCall(PetscMalloc2(term->num, &term->row, term->num, &term->number));
  PetscCall(MatGetOwnershipRange(K, &begin, NULL));
  PetscCall(ISGetIndices(factor->rows, &row));
  for (PetscInt i = 0; i < term->num; i++) term->row[i] = begin + row[i];
  PetscCall(ISRestoreIndices(factor->rows, &row));
  PetscCall(MatGetOwnershipRange(factor->few, &begin, NULL));
  for (PetscInt i = 0; i < term->num; i++) term->number[i] = begin + i;
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode TermEnd_Private(Term *term)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree2(term->row, term->number));
  PetscCall(MatDestroy(&term->W));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Columns of a matrix at the rows of E. Collective. [out] columns - owned by the caller */
static PetscErrorCode TermCreateColumns_Private(const Term *term, Mat X, Mat *columns)
{
  const MPI_Comm comm = PetscObjectComm((PetscObject)X);
  PetscInt       begin, end;
  IS             all, some;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(X, &begin, &end));
  PetscCall(ISCreateStride(comm, end - begin, begin, 1, &all));
  PetscCall(ISCreateGeneral(comm, term->num, term->row, PETSC_USE_POINTER, &some));
  PetscCall(MatCreateSubMatrix(X, all, some, MAT_INITIAL_MATRIX, columns));
  PetscCall(ISDestroy(&all));
  PetscCall(ISDestroy(&some));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* W = (K + more) (1 + E / 2). Collective. [in] more - rows of E alone, or NULL */
static PetscErrorCode TermSetW_Private(Mat K, Mat more, Term *term)
{
  Mat columns, KE;

  PetscFunctionBeginUser;
  PetscCall(FewRowsCreate(1, &(RowList){.from = K, .num = term->num, .row = term->row}, &term->W));
  if (more) PetscCall(MatAXPY(term->W, 1, more, DIFFERENT_NONZERO_PATTERN));
  PetscCall(TermCreateColumns_Private(term, term->W, &columns));
  PetscCall(MatMatMult(columns, term->factor->few, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &KE));
  PetscCall(MatDestroy(&columns));
  PetscCall(MatAXPY(term->W, 0.5, KE, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatDestroy(&KE));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* L and R of L'R = E'W + W'E of all terms. Collective. [out] L, R - owned by the caller */
static PetscErrorCode TermsCreateFactors_Private(PetscInt num, const Term terms[], Mat *L, Mat *R)
{
  RowList of_E[BASIS_FACTORS], lists[2 * BASIS_FACTORS] = {{.num = 0}};

  PetscFunctionBeginUser;
  for (PetscInt t = 0; t < num; t++) {
    of_E[t] = lists[2 * t] = (RowList){.from = terms[t].factor->few, .num = terms[t].num, .row = terms[t].number};
    lists[2 * t + 1]       = (RowList){.from = terms[t].W, .num = terms[t].num, .row = terms[t].number};
  }
  PetscCall(FewRowsCreate(2 * num, lists, L));
  for (PetscInt t = 0; t < num; t++) {
    lists[2 * t]     = lists[2 * t + 1];
    lists[2 * t + 1] = of_E[t];
  }
  PetscCall(FewRowsCreate(2 * num, lists, R));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The rows of Z so far at those of the next E. Collective. [out] rows - owned by the caller */
static PetscErrorCode TermsCreateRows_Private(PetscInt num, const Term terms[], const Term *next, Mat *rows)
{
  Mat L, R, columns;

  PetscFunctionBeginUser;
  PetscCall(TermsCreateFactors_Private(num, terms, &L, &R));
  PetscCall(TermCreateColumns_Private(next, L, &columns));
  PetscCall(TransposedProductCreate(columns, R, rows));
  PetscCall(MatDestroy(&columns));
  PetscCall(MatDestroy(&L));
  PetscCall(MatDestroy(&R));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CondensationCreate(Mat K, const BasisFactor factors[], Mat *Z)
{
  Term     terms[BASIS_FACTORS] = {{.num = 0}};
  PetscInt num                  = 0, size;
  Mat      more, L, R;

  PetscFunctionBeginUser;
  for (int f = 0; f < BASIS_FACTORS; f++) {
    PetscCall(MatGetSize(factors[f].few, &size, NULL));
    if (f && !size) continue;
    more = NULL;
    PetscCall(TermBegin_Private(K, &factors[f], &terms[num]));
    if (num) PetscCall(TermsCreateRows_Private(num, terms, &terms[num], &more));
    PetscCall(TermSetW_Private(K, more, &terms[num++]));
    PetscCall(MatDestroy(&more));
  }
  PetscCall(TermsCreateFactors_Private(num, terms, &L, &R));
  PetscCall(TransposedProductCreate(L, R, Z));
  PetscCall(MatDestroy(&L));
  PetscCall(MatDestroy(&R));
  for (PetscInt t = 0; t < num; t++) PetscCall(TermEnd_Private(&terms[t]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

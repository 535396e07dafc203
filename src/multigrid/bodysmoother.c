/* bodysmoother.c -- constrained smoother, body by body.

   In y, u = T y, an unknown of the mortar side moves the nonmortar side as well. Its entry of diag A is large
   if the nonmortar side is stiff, although hardly anything resists the motion while the sides may separate.
   So each body is smoothed in its displacements, by its own diagonal:

       S = T'D T,   D = diag K,   S^-1 = T^-1 D^-1 T^-T =: G.

   The eigenvalues of S and T'K T are those of D and K. For fixed unknowns h, active ones among them, G is
   corrected on free ones f:

       S_ff^-1 = G_ff - G_fh G_hh^-1 G_hf,   G_hh = X D^-1 X',

   with X the rows h of T^-1. G_hh is small and sparse, and is factored. Displacements that are fixed along
   axes are excluded: D^-1 is 0 there.

   With blocks of couplings S_u in place of D, an active set changes G_hh alone while few rows of X meet in
   one block. In T'S_u T contact couples the blocks of both bodies. */
#include "base/compat.h"
#include "multigrid/bodysmoother.h"
#include "multigrid/dealtrows.h"
#include "multigrid/envelopecompliance.h"
#include "multigrid/envelopefactor.h"
#include "multigrid/redundantsolve.h"

/* Largest work for G_hh with blocks, in products for each unknown: about that of the factors of T'S_u T, some
   3.2e4 in hertz3d. */
static const PetscReal MAX_COMPLIANCE_WORK = 4e4;

typedef struct {
  BasisRows      inverse; /* T^-1 */
  Mat            E;       /* T^-1 - 1: rows of nodes on contact sides or with oblique supports only */
  Vec            w;       /* D^-1, 0 where `eliminated`; without blocks */
  Mat            blocks;  /* S_u, or NULL */
  Mat            whole;   /* on several ranks whole blocks of this one; NULL on one process, as the next four */
  IS             rows;    /* of S_u */
  VecScatter     deal;    /* from all rows to these */
  Vec            force_there, there; /* t and s in these rows */
  EnvelopeParts *parts;              /* factors of S_u, borrowed */
  Vec            s, t;               /* displacements, forces */
  PetscBool     *eliminated;         /* fixed displacements [unknowns of this rank] */
  PetscInt       num;
  PetscInt      *fixed;  /* [num] */
  Mat            X;      /* NULL if all fixed unknowns are displacements */
  PC             factor; /* of G_hh */
  Vec            gap, force;
  PetscInt       num_touched, *touched; /* blocks where X has entries [num_touched] */
} BodySmoother;

static PetscErrorCode BodySmootherRelease_Private(BodySmoother *body)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(body->fixed));
  PetscCall(MatDestroy(&body->X));
  PetscCall(PCDestroy(&body->factor));
  PetscCall(VecDestroy(&body->gap));
  PetscCall(VecDestroy(&body->force));
  PetscCall(PetscFree(body->touched));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Destroy_BodySmoother(Mat S)
{
  BodySmoother *body;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(S, &body));
  PetscCall(BodySmootherRelease_Private(body));
  PetscCall(BasisRowsDestroy(&body->inverse));
  PetscCall(MatDestroy(&body->E));
  PetscCall(MatDestroy(&body->blocks));
  PetscCall(MatDestroy(&body->whole));
  PetscCall(ISDestroy(&body->rows));
  PetscCall(VecScatterDestroy(&body->deal));
  PetscCall(VecDestroy(&body->force_there));
  PetscCall(VecDestroy(&body->there));
  PetscCall(VecDestroy(&body->w));
  PetscCall(VecDestroy(&body->s));
  PetscCall(VecDestroy(&body->t));
  PetscCall(PetscFree(body->eliminated));
  PetscCall(PetscFree(body));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* s = D^-1 t. [in] again - whether t has changed by forces along X alone */
static PetscErrorCode BodySmootherSolve_Private(BodySmoother *body, PetscBool again)
{
  const Vec          from = body->deal ? body->force_there : body->t, to = body->deal ? body->there : body->s;
  const PetscScalar *t;
  PetscScalar       *s;

  PetscFunctionBeginUser;
  if (!body->parts) {
    PetscCall(VecPointwiseMult(body->s, body->w, body->t));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  if (body->deal) PetscCall(VecScatterBegin(body->deal, body->t, from, INSERT_VALUES, SCATTER_FORWARD));
  if (body->deal) PetscCall(VecScatterEnd(body->deal, body->t, from, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGetArrayRead(from, &t));
  PetscCall(VecGetArray(to, &s));
  if (again)
    EnvelopePartsSolveSome(body->parts, body->num_touched, body->touched, t, s);
  else
    EnvelopePartsSolve(body->parts, t, s);
  PetscCall(VecRestoreArray(to, &s));
  PetscCall(VecRestoreArrayRead(from, &t));
  if (body->deal) PetscCall(VecScatterBegin(body->deal, to, body->s, INSERT_VALUES, SCATTER_REVERSE));
  if (body->deal) PetscCall(VecScatterEnd(body->deal, to, body->s, INSERT_VALUES, SCATTER_REVERSE));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* z = S_ff^-1 r, for r that is 0 where fixed */
static PetscErrorCode Mult_BodySmoother(Mat S, Vec r, Vec z)
{
  BodySmoother *body;
  PetscScalar  *a;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(S, &body));
  PetscCall(MatMultTransposeAdd(body->E, r, r, body->t));
  PetscCall(BodySmootherSolve_Private(body, PETSC_FALSE));
  if (body->X) {
    PetscCall(MatMult(body->X, body->s, body->gap));
    PetscCall(PCApply(body->factor, body->gap, body->force));
    PetscCall(VecScale(body->force, -1));
    PetscCall(MatMultTransposeAdd(body->X, body->force, body->t, body->t));
    PetscCall(BodySmootherSolve_Private(body, PETSC_TRUE));
  }
  PetscCall(MatMultAdd(body->E, body->s, body->s, z));
  PetscCall(VecGetArray(z, &a));
  for (PetscInt i = 0; i < body->num; i++) a[body->fixed[i]] = 0;
  PetscCall(VecRestoreArray(z, &a));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* D^-1, 0 where `eliminated`. */
static PetscErrorCode BodySmootherSetWeights_Private(const Operator *op, BodySmoother *body)
{
  PetscScalar *w;

  PetscFunctionBeginUser;
  PetscCall(MatCreateVecs(op->K, &body->w, NULL));
  PetscCall(VecCopy(op->diagonal, body->w));
  PetscCall(VecReciprocal(body->w));
  PetscCall(VecScale(body->w, op->stiffness));
  PetscCall(VecGetArray(body->w, &w));
  for (PetscInt i = 0; i < op->num_fixed; i++)
    if (body->eliminated[op->fixed[i]]) w[op->fixed[i]] = 0;
  PetscCall(VecRestoreArray(body->w, &w));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* All but D. */
static PetscErrorCode BodySmootherBegin_Private(const Operator *op, BodySmoother **body, Mat *inverse)
{
  PetscInt      n;
  BodySmoother *b;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(body));
  b = *body;
  PetscCall(BasisRowsReference(&op->inverse, &b->inverse));
  PetscCall(BasisRowsCreateDifference(&b->inverse, &b->E));
  PetscCall(MatCreateVecs(op->K, &b->t, &b->s));
  PetscCall(VecGetLocalSize(b->s, &n));
  PetscCall(PetscCalloc1(n, &b->eliminated));
  PetscCall(OperatorMarkFixedDisplacements(op, b->eliminated));
  PetscCall(MatCreateShell(PetscObjectComm((PetscObject)op->K), n, n, PETSC_DETERMINE, PETSC_DETERMINE, b, inverse));
  PetscCall(MatShellSetOperation(*inverse, MATOP_MULT, (void (*)(void))Mult_BodySmoother));
  PetscCall(MatShellSetOperation(*inverse, MATOP_DESTROY, (void (*)(void))Destroy_BodySmoother));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BodySmootherCreate(const Operator *op, Mat *inverse)
{
  BodySmoother *body;
  PetscBool     done;

  PetscFunctionBeginUser;
  PetscCall(BodySmootherBegin_Private(op, &body, inverse));
  PetscCall(BodySmootherSetWeights_Private(op, body));
  PetscCall(BodySmootherSetFixed(*inverse, op->num_fixed, op->fixed, &done));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whole blocks of this rank. [out] eliminated - in their rows; owned by the caller */
static PetscErrorCode BodySmootherDeal_Private(BodySmoother *body, PetscBool **eliminated)
{
  PetscInt           n, num;
  PetscScalar       *mark;
  const PetscScalar *marks;

  PetscFunctionBeginUser;
  PetscCall(EnvelopeFactorDeal(body->blocks, &body->rows, &body->whole));
  PetscCall(MatCreateVecs(body->whole, &body->there, &body->force_there));
  PetscCall(VecScatterCreate(body->s, body->rows, body->there, NULL, &body->deal));
  PetscCall(VecGetLocalSize(body->s, &n));
  PetscCall(VecGetArrayWrite(body->s, &mark));
  for (PetscInt i = 0; i < n; i++) mark[i] = body->eliminated[i] ? 1 : 0;
  PetscCall(VecRestoreArrayWrite(body->s, &mark));
  PetscCall(VecScatterBegin(body->deal, body->s, body->there, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(body->deal, body->s, body->there, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGetLocalSize(body->there, &num));
  PetscCall(PetscMalloc1(num, eliminated));
  PetscCall(VecGetArrayRead(body->there, &marks));
  for (PetscInt i = 0; i < num; i++) (*eliminated)[i] = (PetscBool)(marks[i] != 0);
  PetscCall(VecRestoreArrayRead(body->there, &marks));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Factors of the blocks without the displacements that are eliminated. [out] done - whether all ranks have
   them */
static PetscErrorCode BodySmootherSetBlocks_Private(const Operator *op, Mat blocks, BodySmoother *body, PetscBool *done)
{
  const MPI_Comm comm = PetscObjectComm((PetscObject)blocks);
  PetscMPIInt    size;
  PetscBool     *eliminated = body->eliminated;
  PetscInt       begin, num = 0, *rows;

  PetscFunctionBeginUser;
  PetscCall(PetscObjectReference((PetscObject)blocks));
  body->blocks = blocks;
  PetscCall(MatGetOwnershipRange(blocks, &begin, NULL));
  PetscCall(PetscMalloc1(op->num_fixed, &rows));
  for (PetscInt i = 0; i < op->num_fixed; i++)
    if (body->eliminated[op->fixed[i]]) rows[num++] = begin + op->fixed[i];
  PetscCall(MatZeroRowsColumns(blocks, num, rows, 1, NULL, NULL));
  PetscCall(PetscFree(rows));
  PetscCallMPI(MPI_Comm_size(comm, &size));
  if (size > 1) PetscCall(BodySmootherDeal_Private(body, &eliminated));
  PetscCall(EnvelopeFactorGet(size > 1 ? body->whole : blocks, &body->parts));
  for (PetscInt i = 0; body->parts && i < body->parts->num_alone; i++)
    if (eliminated[body->parts->alone[i]]) body->parts->inverse[i] = 0;
  if (size > 1) PetscCall(PetscFree(eliminated));
  *done = (PetscBool)(body->parts != NULL);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, done, 1, MPIU_BOOL, MPI_LAND, comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BodySmootherCreateOfBlocks(const Operator *op, Mat blocks, Mat *inverse)
{
  BodySmoother *body;
  PetscBool     done;

  PetscFunctionBeginUser;
  PetscCall(BodySmootherBegin_Private(op, &body, inverse));
  PetscCall(BodySmootherSetBlocks_Private(op, blocks, body, &done));
  if (done) PetscCall(BodySmootherSetFixed(*inverse, op->num_fixed, op->fixed, &done));
  if (!done) PetscCall(MatDestroy(inverse));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BodySmootherGetBlocks(Mat inverse, Mat *blocks)
{
  BodySmoother *body;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(inverse, &body));
  *blocks = body->blocks;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BodySmootherIs(Mat S, PetscBool *body)
{
  PetscFunctionBeginUser;
  PetscCall(PetscObjectTypeCompare((PetscObject)S, MATSHELL, body));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* X D^-1 X' */
static PetscErrorCode BodySmootherCreateG_Private(Mat X, Vec w, Mat *G)
{
  Mat half, other;
  Vec root;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(w, &root));
  PetscCall(VecCopy(w, root));
  PetscCall(VecSqrtAbs(root));
  PetscCall(MatDuplicate(X, MAT_COPY_VALUES, &half));
  PetscCall(MatDiagonalScale(half, NULL, root));
  PetscCall(MatTranspose(half, MAT_INITIAL_MATRIX, &other));
  PetscCall(MatMatMult(half, other, MAT_INITIAL_MATRIX, PETSC_DEFAULT, G));
  PetscCall(MatProductClear(*G)); // it would keep its factors
  PetscCall(MatSetOption(*G, MAT_SPD, PETSC_TRUE));
  PetscCall(MatDestroy(&half));
  PetscCall(MatDestroy(&other));
  PetscCall(VecDestroy(&root));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The part of the rows h of T^-1 that blocks of this rank have, X' in their rows; G_hh from it. */
static PetscErrorCode BodySmootherCreateCompliance_Private(BodySmoother *body, Mat *G)
{
  PetscInt n;
  Mat      transpose, dealt = NULL;

  PetscFunctionBeginUser;
  PetscCall(VecGetSize(body->s, &n));
  PetscCall(MatTranspose(body->X, MAT_INITIAL_MATRIX, &transpose));
  if (body->deal) PetscCall(DealtRowsCreate(transpose, body->rows, NULL, &dealt));
  PetscCall(EnvelopeComplianceCreate(body->parts, body->X, dealt ? dealt : transpose, MAX_COMPLIANCE_WORK * n,
                                     &body->num_touched, &body->touched, G));
  PetscCall(MatDestroy(&dealt));
  PetscCall(MatDestroy(&transpose));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* G_hh and its factorization. */
static PetscErrorCode BodySmootherFactor_Private(BodySmoother *body, PetscBool *done)
{
  Mat G;

  PetscFunctionBeginUser;
  if (body->parts)
    PetscCall(BodySmootherCreateCompliance_Private(body, &G));
  else
    PetscCall(BodySmootherCreateG_Private(body->X, body->w, &G));
  *done = (PetscBool)(G != NULL);
  if (!G) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatCreateVecs(G, &body->force, &body->gap));
  PetscCall(PCCreate(PetscObjectComm((PetscObject)G), &body->factor));
  PetscCall(PCSetOptionsPrefix(body->factor, "apart_"));
  PetscCall(PCSetOperators(body->factor, G, G));
  PetscCall(RedundantSolveSetPC(body->factor));
  PetscCall(PCSetUp(body->factor));
  PetscCall(MatDestroy(&G));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BodySmootherSetFixed(Mat inverse, PetscInt num, const PetscInt fixed[], PetscBool *done)
{
  const MPI_Comm comm = PetscObjectComm((PetscObject)inverse);
  BodySmoother  *body;
  PetscInt       count = 0, total, *list;

  PetscFunctionBeginUser;
  *done = PETSC_TRUE;
  PetscCall(MatShellGetContext(inverse, &body));
  PetscCall(BodySmootherRelease_Private(body));
  PetscCall(PetscMalloc1(num, &body->fixed));
  PetscCall(PetscArraycpy(body->fixed, fixed, num));
  body->num = num;
  PetscCall(PetscMalloc1(num, &list));
  for (PetscInt i = 0; i < num; i++)
    if (!body->eliminated[fixed[i]]) list[count++] = fixed[i];
  PetscCall(PetscSortRemoveDupsInt(&count, list));
  PetscCallMPI(MPI_Allreduce(&count, &total, 1, MPIU_INT, MPI_SUM, comm));
  if (total > 0) {
    PetscCall(BasisRowsCreateSome(&body->inverse, count, list, &body->X));
    PetscCall(BodySmootherFactor_Private(body, done));
  }
  PetscCall(PetscFree(list));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* test_dealtfactor.c -- each rank solves for whole blocks of rows, with other active sets once more; any rank may get none. */
#include "base/compat.h"
#include "multigrid/dealtfactor.h"
#include "multigrid/envelopefactor.h"
#include "test.h"

enum { CHAINS = 7, LENGTH = 23, ROWS = CHAINS * LENGTH, INSIDE = 4 * CHAINS + 3 };

static PetscInt       rows;    /* that this rank got last */
static PetscLogDouble entries; /* there */

static PetscErrorCode Configure(PC pc)
{
  Mat       S;
  MatInfo   info;
  PetscBool done;

  PetscFunctionBeginUser;
  PetscCall(PCGetOperators(pc, NULL, &S));
  PetscCall(MatGetSize(S, &rows, NULL));
  PetscCall(MatGetInfo(S, MAT_LOCAL, &info));
  entries = info.nz_used;
  PetscCall(EnvelopeFactorSetPC(pc, S, &done));
  CHECK(done);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Chains of springs, whose nodes are dealt like cards: every rank has nodes of each. [in] link - of chains to the next ones at their
   first nodes, none if 0; [in] rigid - a node that does not move, or -1 */
static void CreateChains(PetscReal link, PetscInt rigid, Mat *S)
{
  PetscInt begin, end;

  CHECK(!MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, PETSC_DECIDE, ROWS, ROWS, 5, NULL, 5, NULL, S));
  CHECK(!MatSetType(*S, MATMPIAIJ)); // on one process, too
  CHECK(!MatMPIAIJSetPreallocation(*S, 5, NULL, 5, NULL));
  CHECK(!MatGetOwnershipRange(*S, &begin, &end));
  for (PetscInt i = begin; i < end; i++) {
    const PetscInt next[2] = {i + CHAINS, i + 1 < CHAINS ? i + 1 : ROWS},
                   last[2] = {i - CHAINS, i < CHAINS ? i - 1 : -1};

    CHECK(!MatSetValue(*S, i, i, 0.5, ADD_VALUES));
    for (int k = 0; k < (link != 0 ? 2 : 1); k++) {
      const PetscReal stiffness = k ? link : 1 + (PetscReal)(i % 3);
      const PetscReal before    = k ? link : 1 + (PetscReal)((i + 2 * CHAINS) % 3);

      if (next[k] < ROWS) CHECK(!MatSetValue(*S, i, next[k], -stiffness, ADD_VALUES));
      if (next[k] < ROWS) CHECK(!MatSetValue(*S, i, i, stiffness, ADD_VALUES));
      if (last[k] >= 0) CHECK(!MatSetValue(*S, i, last[k], -before, ADD_VALUES));
      if (last[k] >= 0) CHECK(!MatSetValue(*S, i, i, before, ADD_VALUES));
    }
  }
  CHECK(!MatAssemblyBegin(*S, MAT_FINAL_ASSEMBLY));
  CHECK(!MatAssemblyEnd(*S, MAT_FINAL_ASSEMBLY));
  CHECK(!MatZeroRowsColumns(*S, rigid >= begin && rigid < end, &rigid, 1, NULL, NULL));
  CHECK(!MatSetOption(*S, MAT_SPD, PETSC_TRUE));
}

/* S^-1 S x = x, and no entry is lost. [out] most - rows of the rank with most of them */
static void CheckInverse(Mat S, PetscInt *most)
{
  PetscReal off;
  PetscInt  sum;
  PetscBool dealt;
  Vec       x, y, b;
  PC        pc;
  MatInfo   info;

  CHECK(!PCCreate(PETSC_COMM_WORLD, &pc));
  CHECK(!DealtFactorIs(pc, &dealt));
  CHECK(!dealt);
  CHECK(!PCSetOperators(pc, S, S));
  CHECK(!DealtFactorSetPC(pc, S, Configure));
  CHECK(!DealtFactorIs(pc, &dealt));
  CHECK(dealt);
  CHECK(!PCSetUp(pc));
  CHECK(!MatGetInfo(S, MAT_GLOBAL_SUM, &info));
  MPI_Allreduce(&rows, &sum, 1, MPIU_INT, MPI_SUM, PETSC_COMM_WORLD);
  MPI_Allreduce(&rows, most, 1, MPIU_INT, MPI_MAX, PETSC_COMM_WORLD);
  MPI_Allreduce(MPI_IN_PLACE, &entries, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  CHECK(sum == ROWS && entries == info.nz_used);
  CHECK(!MatCreateVecs(S, &x, &b));
  CHECK(!VecDuplicate(x, &y));
  for (PetscInt i = 0; i < ROWS; i++) CHECK(!VecSetValue(x, i, PetscSinReal((PetscReal)(i * i)), INSERT_VALUES));
  CHECK(!VecAssemblyBegin(x));
  CHECK(!VecAssemblyEnd(x));
  CHECK(!MatMult(S, x, b));
  CHECK(!PCApply(pc, b, y));
  CHECK(!VecAXPY(y, -1, x));
  CHECK(!VecNorm(y, NORM_INFINITY, &off));
  CHECK_NEAR(off, 0, 1e-5); // factors are in single precision
  CHECK(!VecDestroy(&x));
  CHECK(!VecDestroy(&y));
  CHECK(!VecDestroy(&b));
  CHECK(!PCDestroy(&pc));
}

/* Another matrix with the blocks of the first one. */
static void CheckOther(Mat base, PetscReal link, PetscInt rigid, PetscInt *most)
{
  Mat S;

  CreateChains(link, rigid, &S);
  CHECK(!EnvelopeFactorSetBase(S, base));
  CheckInverse(S, most);
  CHECK(!MatDestroy(&S));
}

int main(int argc, char **argv)
{
  PetscReal   label[ROWS];
  PetscMPIInt size;
  PetscInt    begin, end, most, before;
  Mat         base;

  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL));
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  CreateChains(0, -1, &base);
  CHECK(!MatGetOwnershipRange(base, &begin, &end));
  for (PetscInt i = begin; i < end; i++) label[i - begin] = (PetscReal)(i % CHAINS);
  CHECK(!EnvelopeFactorKeep(base, 1, label));
  CheckInverse(base, &before);
  CHECK(before <= (CHAINS + size - 1) / size * LENGTH); // whole chains, evenly
  CheckOther(base, 0, INSIDE, &most);
  CHECK(most == before);
  CheckOther(base, 0.25, INSIDE, &most); // one block, of one rank
  CHECK(most == ROWS);
  CheckOther(base, 0.25, -1, &most);
  CheckOther(base, 0, 0, &most);
  CHECK(most == ROWS); // dealt as for the one before
  CHECK(!MatScale(base, 3));
  CHECK(!EnvelopeFactorScale(base, 3));
  CHECK(!DealtFactorScale(base, 3));
  CheckInverse(base, &most);
  CheckOther(base, 0, INSIDE + 1, &most); // no block is that of the base any longer
  CHECK(!MatDestroy(&base));
  CHECK(!PetscFinalize());
  return 0;
}

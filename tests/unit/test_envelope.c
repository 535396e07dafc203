/* test_envelope.c -- blocks that edges couple are factored within their envelopes, with other active sets once more. */
#include "base/compat.h"
#include "multigrid/envelopefactor.h"
#include "test.h"

enum { PLANES = 7, LENGTH = 23, DEPTH = 9, NODES = PLANES * LENGTH * DEPTH };

static PetscInt Node(PetscInt plane, PetscInt i, PetscInt j)
{
  return (plane * DEPTH + j) * LENGTH + i;
}

/* Adds a spring. */
static void AddSpring(Mat S, PetscInt a, PetscInt b, PetscReal stiffness)
{
  CHECK(!MatSetValue(S, a, a, stiffness, ADD_VALUES));
  CHECK(!MatSetValue(S, b, b, stiffness, ADD_VALUES));
  CHECK(!MatSetValue(S, a, b, -stiffness, ADD_VALUES));
  CHECK(!MatSetValue(S, b, a, -stiffness, ADD_VALUES));
}

/* Planes of springs, each held by a weak one, which touch each other along their first lines, shifted by a node. */
static void CreatePlanes(PetscReal held, Mat *S)
{
  CHECK(!MatCreateSeqAIJ(PETSC_COMM_SELF, NODES, NODES, 9, NULL, S));
  for (PetscInt p = 0; p < PLANES; p++) {
    for (PetscInt j = 0; j < DEPTH; j++) {
      for (PetscInt i = 0; i < LENGTH; i++) {
        CHECK(!MatSetValue(*S, Node(p, i, j), Node(p, i, j), held, ADD_VALUES));
        if (i + 1 < LENGTH) AddSpring(*S, Node(p, i, j), Node(p, i + 1, j), 1);
        if (j + 1 < DEPTH) AddSpring(*S, Node(p, i, j), Node(p, i, j + 1), 2);
        if (j == 0 && p + 1 < PLANES && i + 1 < LENGTH) AddSpring(*S, Node(p, i, 0), Node(p + 1, i + 1, 0), 0.5);
      }
    }
  }
  CHECK(!MatAssemblyBegin(*S, MAT_FINAL_ASSEMBLY));
  CHECK(!MatAssemblyEnd(*S, MAT_FINAL_ASSEMBLY));
  CHECK(!MatSetOption(*S, MAT_SPD, PETSC_TRUE));
}

/* S^-1 S x = x */
static void CheckInverse(PC pc, Mat S, PetscReal tolerance)
{
  PetscReal off;
  Vec       x, y, b;

  CHECK(!MatCreateVecs(S, &x, &b));
  CHECK(!VecDuplicate(x, &y));
  for (PetscInt i = 0; i < NODES; i++) CHECK(!VecSetValue(x, i, PetscSinReal((PetscReal)(i * i)), INSERT_VALUES));
  CHECK(!MatMult(S, x, b));
  CHECK(!PCSetOperators(pc, S, S));
  CHECK(!PCApply(pc, b, y));
  CHECK(!VecAXPY(y, -1, x));
  CHECK(!VecNorm(y, NORM_INFINITY, &off));
  CHECK_NEAR(off, 0, tolerance);
  CHECK(!VecDestroy(&x));
  CHECK(!VecDestroy(&y));
  CHECK(!VecDestroy(&b));
}

/* [in] held - stiffness that holds each node; single precision will do where it is not small */
static void TestPlanes(PetscReal held, PetscReal tolerance)
{
  const PetscInt active[] = {Node(1, 3, 0), Node(2, 4, 0), Node(2, 5, 0), Node(5, 22, 0), Node(3, 7, 4)};
  PetscReal      label[NODES];
  PetscBool      done;
  Mat            S, other;
  PC             pc;

  for (PetscInt i = 0; i < NODES; i++) label[i] = (PetscReal)(i / (LENGTH * DEPTH));
  CreatePlanes(held, &S);
  CHECK(!PCCreate(PETSC_COMM_SELF, &pc));
  CHECK(!PCSetOperators(pc, S, S));
  CHECK(!EnvelopeFactorSetPC(pc, S, &done));
  CHECK(!done); // nothing is known of its blocks
  CHECK(!EnvelopeFactorKeep(S, 1, label));
  CHECK(!EnvelopeFactorSetPC(pc, S, &done));
  CHECK(done);
  CheckInverse(pc, S, tolerance);
  CHECK(!MatScale(S, 3));
  CHECK(!EnvelopeFactorScale(S, 3));
  CheckInverse(pc, S, tolerance);
  for (PetscInt num = 0; num <= 5; num++) { // the last one is in the midst of a block
    CHECK(!MatDuplicate(S, MAT_COPY_VALUES, &other));
    CHECK(!EnvelopeFactorSetBase(other, S));
    CHECK(!MatZeroRowsColumns(other, num, active, 1, NULL, NULL));
    CheckInverse(pc, other, tolerance);
    CHECK(!MatDestroy(&other));
  }
  CHECK(!PCDestroy(&pc));
  CHECK(!MatDestroy(&S));
}

int main(int argc, char **argv)
{
  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL));
  TestPlanes(1, 1e-5);
  TestPlanes(1e-9, 1e-5); // single precision would lose what holds the planes
  CHECK(!PetscFinalize());
  return 0;
}

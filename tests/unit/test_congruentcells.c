/* test_congruentcells.c -- cells that are translations of each other have one matrix. */
#include "base/compat.h"
#include "problem/congruentcells.h"
#include <test.h>

enum { N = 4, DOFS = 8 };

static void MoveSquare(PetscReal x, PetscReal y, PetscReal size, PetscReal X[])
{
  for (PetscInt i = 0; i < N; ++i) {
    X[2 * i]     = x + size * ElementNode(ELEMENT_QUAD4, i)[0];
    X[2 * i + 1] = y + size * ElementNode(ELEMENT_QUAD4, i)[1];
  }
}

static void TestFind(void)
{
  PetscReal        X[DOFS], Ke[DOFS * DOFS];
  const PetscReal *found;
  CongruentCells   cells;

  for (PetscInt i = 0; i < DOFS * DOFS; ++i) Ke[i] = (PetscReal)i;
  CHECK(!CongruentCellsCreate(2, &cells));
  MoveSquare(1. / 3, 1. / 7, 0.1, X);
  CHECK(!CongruentCellsFind(cells, ELEMENT_QUAD4, 0, X));
  CongruentCellsAdd(cells, ELEMENT_QUAD4, 0, X, Ke);
  for (PetscInt k = -50; k < 50; ++k) { // positions are rounded
    MoveSquare(k / 3., k / 7., 0.1, X);
    found = CongruentCellsFind(cells, ELEMENT_QUAD4, 0, X);
    CHECK(found && found[0] == Ke[0] && found[DOFS * DOFS - 1] == Ke[DOFS * DOFS - 1]);
  }
  CHECK(!CongruentCellsFind(cells, ELEMENT_QUAD4, 1, X)); // another material
  MoveSquare(1, 1, 0.1 + 1e-13, X);                       // larger by more than rounding
  CHECK(!CongruentCellsFind(cells, ELEMENT_QUAD4, 0, X));
  CHECK(!CongruentCellsDestroy(&cells));
}

/* More shapes than are kept: the oldest go. Found are the right ones. */
static void TestReplace(void)
{
  PetscReal        X[DOFS], Ke[DOFS * DOFS] = {0};
  const PetscReal *found;
  CongruentCells   cells;

  CHECK(!CongruentCellsCreate(2, &cells));
  for (PetscInt k = 1; k < 60; ++k) {
    Ke[0] = (PetscReal)k;
    MoveSquare(0, 0, (PetscReal)k, X);
    CHECK(!CongruentCellsFind(cells, ELEMENT_QUAD4, 0, X));
    CongruentCellsAdd(cells, ELEMENT_QUAD4, 0, X, Ke);
    for (PetscInt l = PetscMax(1, k - 5); l <= k; ++l) {
      MoveSquare(1, 2, (PetscReal)l, X);
      found = CongruentCellsFind(cells, ELEMENT_QUAD4, 0, X);
      CHECK(found && found[0] == (PetscReal)l);
    }
  }
  CHECK(!CongruentCellsDestroy(&cells));
}

int main(int argc, char **argv)
{
  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL));
  TestFind();
  TestReplace();
  CHECK(!PetscFinalize());
  return 0;
}

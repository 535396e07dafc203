/* sidesums.c -- sums over the facets around each node of a side. */
#include "mesh/sidesums.h"
#include "base/compat.h"

/* A vector has room for all nodes of a level, though few are on a side: many values take several turns. */
enum { F = ELEMENT_MAX_FACET_NODES, AT_ONCE = 18 };

PetscReal SideGetPosition(const Level *level, const Facets *facets, PetscInt f, PetscInt i, PetscInt k)
{
  const PetscInt at = facets->nodes[f * F + i] * level->dim + k;

  return level->coords[at] + (level->hanging.rise ? level->hanging.rise[at] : 0);
}

/* As many values of each corner as the sums have, from the one at begin on.
   [in] way - 0 adds them to the sums, 1 reads these */
static PetscErrorCode SideMoveValues_Private(const Facets *facets, PetscInt bs, PetscInt begin, const PetscReal skip[],
                                             PetscInt way, Vec sums, PetscReal values[])
{
  PetscScalar *a;
  PetscInt     num;
  Vec          local;

  PetscFunctionBeginUser;
  PetscCall(VecGetBlockSize(sums, &num));
  PetscCall(VecGhostGetLocalForm(sums, &local));
  if (way == 0) PetscCall(VecZeroEntries(local));
  PetscCall(VecGetArray(local, &a));
  for (PetscInt f = 0; f < facets->num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); i++) {
      PetscScalar *at   = &a[facets->nodes[f * F + i] * num];
      PetscReal   *mine = &values[(f * F + i) * bs + begin];

      if (skip && skip[f * F + i] != 0) continue;
      for (PetscInt k = 0; k < num; k++) {
        if (way == 0)
          at[k] += mine[k];
        else
          mine[k] = PetscRealPart(at[k]);
      }
    }
  }
  PetscCall(VecRestoreArray(local, &a));
  PetscCall(VecGhostRestoreLocalForm(sums, &local));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SideSumAtNodes(Level *level, const Facets *facets, PetscInt bs, const PetscReal skip[],
                              PetscReal values[])
{
  PetscFunctionBeginUser;
  for (PetscInt begin = 0; begin < bs; begin += AT_ONCE) {
    const PetscInt num = PetscMin(AT_ONCE, bs - begin);
    Vec            sums;

    PetscCall(LevelCreateVec(level, num, &sums));
    PetscCall(SideMoveValues_Private(facets, bs, begin, skip, 0, sums, values));
    PetscCall(LevelShareVec(sums, ADD_VALUES));
    PetscCall(SideMoveValues_Private(facets, bs, begin, skip, 1, sums, values));
    PetscCall(VecDestroy(&sums));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* treenormals.c -- normals of smooth sides on bisected levels.

   New vertices lie on the curves of the first mesh's normals, and have the normals of these (treearcs.c).
   Facets of a bisected mesh are less regular than those of a file. Means over them are less accurate, above
   all where a side ends. */
#include "base/compat.h"
#include "mesh/meshforest.h"
#include "mesh/tree.h"
#include "mesh/treenormals.h"
#include "side/arcnormals.h"

/* The normals of a vertex of a list, each once.
   [out] normals - zero behind the last one [LEVEL_ARC_NORMALS][dim] */
static void TreeGetNormals_Private(const Tree *tree, PetscInt vertex, PetscScalar normals[])
{
  const TreeArcs *arcs = &tree->arcs;
  const PetscInt  dim  = tree->list.dim;
  PetscReal       found[LEVEL_ARC_NORMALS * 3];
  PetscInt        num = 0;

  for (PetscInt i = arcs->start[vertex]; i < arcs->start[vertex + 1] && num < LEVEL_ARC_NORMALS; i++) {
    const SideCorner *corner = &arcs->corner[i];
    PetscInt          j      = 0;

    if (!arcs->round[corner->facet]) continue;
    while (j < num && ArcNormalsDiffer(dim, &found[j * dim], corner->normal)) j++;
    for (PetscInt k = 0; k < dim && j == num; k++) found[num * dim + k] = corner->normal[k];
    num = PetscMax(num, j + 1);
  }
  for (PetscInt k = 0; k < LEVEL_ARC_NORMALS * dim; k++) normals[k] = k < num * dim ? found[k] : 0;
}

static PetscBool TreeHasNormals_Private(const Scene scene, const MeshForest forest, PetscInt b)
{
  return (PetscBool)(forest->tree[b].arcs.any && scene->bodies[b].order == 1 && !scene->bodies[b].map);
}

PetscErrorCode MeshForestSetNormals(MeshForest forest, Level *level)
{
  PetscBool any   = PETSC_FALSE;
  PetscInt  first = 0;

  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < forest->num_bodies; b++)
    any = (PetscBool)(any || TreeHasNormals_Private(level->scene, forest, b));
  PetscCallMPI(MPI_Bcast(&any, 1, MPIU_BOOL, 0, level->comm));
  if (!any) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(LevelCreateVec(level, LEVEL_ARC_NORMALS * level->dim, &level->arcs));
  for (PetscInt b = 0; b < forest->num_bodies && forest->num_cells; b++) {
    const Bisection *mesh = &forest->tree[b].mesh;

    for (PetscInt c = 0; c < mesh->num_cells && TreeHasNormals_Private(level->scene, forest, b); c++) {
      const ForestCell *cell = &forest->cell[first + c];

      for (PetscInt i = 0; i < mesh->corners; i++) {
        PetscScalar normals[LEVEL_ARC_NORMALS * 3];

        TreeGetNormals_Private(&forest->tree[b], cell->vertex[i], normals);
        PetscCall(VecSetValuesBlocked(level->arcs, 1, &cell->nodes[i], normals, INSERT_VALUES));
      }
    }
    first += mesh->num_cells;
  }
  PetscCall(VecAssemblyBegin(level->arcs));
  PetscCall(VecAssemblyEnd(level->arcs));
  PetscCall(LevelShareVec(level->arcs, INSERT_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

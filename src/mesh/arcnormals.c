/* arcnormals.c -- normals of smooth sides on bisected levels.

   New vertices lie on the curves of the first mesh's normals, and have the normals of these (treearcs.c).
   Facets of a bisected mesh are less regular than those of a file. Means over them are less accurate, above
   all where a side ends. */
#include "mesh/arcnormals.h"
#include "base/compat.h"
#include "kernel/vector.h"
#include "mesh/sidepatch.h"

/* Normals of one vertex: patches that meet there. */
enum { F = ELEMENT_MAX_FACET_NODES, MAX_NORMALS = 3 };

static PetscBool NormalsDiffer_Private(PetscInt dim, const PetscReal a[], const PetscReal b[])
{
  PetscReal most = 0;

  for (PetscInt k = 0; k < dim; k++) most = PetscMax(most, PetscAbsReal(a[k] - b[k]));
  return (PetscBool)(most > FLAT_SIDE);
}

/* The normals of a vertex of a list, each once.
   [out] normals - zero behind the last one [MAX_NORMALS][dim] */
static void TreeGetNormals_Private(const Tree *tree, PetscInt vertex, PetscScalar normals[])
{
  const TreeArcs *arcs = &tree->arcs;
  const PetscInt  dim  = tree->list.dim;
  PetscReal       found[MAX_NORMALS * 3];
  PetscInt        num = 0;

  for (PetscInt i = arcs->start[vertex]; i < arcs->start[vertex + 1] && num < MAX_NORMALS; i++) {
    const SideCorner *corner = &arcs->corner[i];
    PetscInt          j      = 0;

    if (!arcs->round[corner->facet]) continue;
    while (j < num && NormalsDiffer_Private(dim, &found[j * dim], corner->normal)) j++;
    for (PetscInt k = 0; k < dim && j == num; k++) found[num * dim + k] = corner->normal[k];
    num = PetscMax(num, j + 1);
  }
  for (PetscInt k = 0; k < MAX_NORMALS * dim; k++) normals[k] = k < num * dim ? found[k] : 0;
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
  PetscCall(LevelCreateVec(level, MAX_NORMALS * level->dim, &level->arcs));
  for (PetscInt b = 0; b < forest->num_bodies && forest->num_cells; b++) {
    const Bisection *mesh = &forest->tree[b].mesh;

    for (PetscInt c = 0; c < mesh->num_cells && TreeHasNormals_Private(level->scene, forest, b); c++) {
      const ForestCell *cell = &forest->cell[first + c];

      for (PetscInt i = 0; i < mesh->corners; i++) {
        PetscScalar normals[MAX_NORMALS * 3];

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

/* The one of a node's normals that is that of a facet's patch. Returns whether there is one.
   [in] all - of the node; unit - normal of the facet; [out] normal - [dim] */
static PetscBool ArcNormalsChoose_Private(PetscInt dim, const PetscScalar all[], const PetscReal unit[],
                                          PetscReal normal[])
{
  PetscReal most = SMOOTH_SIDE;

  for (PetscInt j = 0; j < MAX_NORMALS; j++) {
    PetscReal own[3], product;

    for (PetscInt k = 0; k < dim; k++) own[k] = PetscRealPart(all[j * dim + k]);
    product = VectorDot(dim, own, unit);
    if (product <= most) continue;
    most = product;
    for (PetscInt k = 0; k < dim; k++) normal[k] = own[k];
  }
  return (PetscBool)(most > SMOOTH_SIDE);
}

PetscErrorCode ArcNormalsTake(const Level *level, const Facets *facets, SideShape *shape)
{
  const PetscInt     dim = level->dim;
  const PetscScalar *a;
  Vec                local;

  PetscFunctionBeginUser;
  if (!level->arcs) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecGhostGetLocalForm(level->arcs, &local));
  PetscCall(VecGetArrayRead(local, &a));
  for (PetscInt f = 0; f < facets->num; f++) {
    PetscReal unit[3];

    (void)FacetGetMeasure(level, facets, f, unit);
    for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); i++) {
      const PetscInt node   = facets->nodes[f * F + i];
      PetscReal     *normal = &shape->normal[(f * F + i) * dim], known[3];

      if (ArcNormalsChoose_Private(dim, &a[node * MAX_NORMALS * dim], unit, known) &&
          NormalsDiffer_Private(dim, known, normal))
        PetscCall(PetscArraycpy(normal, known, dim));
    }
  }
  PetscCall(VecRestoreArrayRead(local, &a));
  PetscCall(VecGhostRestoreLocalForm(level->arcs, &local));
  PetscFunctionReturn(PETSC_SUCCESS);
}

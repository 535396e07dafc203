/* nodematerials.c -- see the header. */
#include "base/compat.h"
#include "result/nodematerials.h"

/* Pairs of a node and a material, the latter ascending. */
typedef struct {
  PetscInt  num, max;
  PetscInt *node, *material; /* [max] */
} Meetings;

static PetscErrorCode MeetingsAdd_Private(Meetings *meetings, PetscInt node, PetscInt material)
{
  PetscFunctionBeginUser;
  if (meetings->num == meetings->max) {
    meetings->max = PetscMax(1024, 2 * meetings->max);
    PetscCall(PetscRealloc(meetings->max * sizeof(PetscInt), &meetings->node));
    PetscCall(PetscRealloc(meetings->max * sizeof(PetscInt), &meetings->material));
  }
  meetings->node[meetings->num]       = node;
  meetings->material[meetings->num++] = material;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The nodes of all cells of a material. Collective. [in] mark - ghosted, 1 per node, work space */
static PetscErrorCode MeetingsAddMaterial_Private(const Level *level, PetscInt material, Vec mark, Meetings *meetings)
{
  const PetscScalar *value;
  PetscScalar       *set;
  Vec                local;

  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(mark, &local));
  PetscCall(VecSet(local, 0));
  PetscCall(VecGetArray(local, &set));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    if (level->cell_material[c] != material) continue;
    for (PetscInt i = level->cell_start[c]; i < level->cell_start[c + 1]; i++) set[level->cell_nodes[i]] = 1;
  }
  PetscCall(VecRestoreArray(local, &set));
  PetscCall(VecGhostRestoreLocalForm(mark, &local));
  PetscCall(LevelShareVec(mark, MAX_VALUES));
  PetscCall(VecGhostGetLocalForm(mark, &local));
  PetscCall(VecGetArrayRead(local, &value));
  for (PetscInt n = 0; n < level->num_nodes; n++)
    if (PetscRealPart(value[n]) > 0) PetscCall(MeetingsAdd_Private(meetings, n, material));
  PetscCall(VecRestoreArrayRead(local, &value));
  PetscCall(VecGhostRestoreLocalForm(mark, &local));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode NodeMaterialsCreate(Scene scene, Level *level, NodeMaterials *at)
{
  Meetings  meetings = {0};
  PetscInt *fill;
  Vec       mark;

  PetscFunctionBeginUser;
  *at = (NodeMaterials){.most = 1};
  if (!scene->num_regions) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(LevelCreateVec(level, 1, &mark));
  for (PetscInt m = 0; m < scene->num_bodies + scene->num_regions; m++) {
    if (scene->bodies[SceneMaterialBody(scene, m)].num_regions)
      PetscCall(MeetingsAddMaterial_Private(level, m, mark, &meetings));
    else // all of its nodes have the one material
      for (PetscInt n = 0; n < level->num_nodes; n++)
        if (level->node_body[n] == m) PetscCall(MeetingsAdd_Private(&meetings, n, m));
  }
  PetscCall(VecDestroy(&mark));
  PetscCall(PetscCalloc1(level->num_nodes + 1, &at->start));
  PetscCall(PetscCalloc1(level->num_nodes, &fill));
  PetscCall(PetscMalloc1(meetings.num, &at->material));
  for (PetscInt i = 0; i < meetings.num; i++) at->start[meetings.node[i] + 1]++;
  for (PetscInt n = 0; n < level->num_nodes; n++) {
    at->most = PetscMax(at->most, at->start[n + 1]);
    at->start[n + 1] += at->start[n];
  }
  for (PetscInt i = 0; i < meetings.num; i++)
    at->material[at->start[meetings.node[i]] + fill[meetings.node[i]]++] = meetings.material[i];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &at->most, 1, MPIU_INT, MPI_MAX, level->comm));
  PetscCall(PetscFree(fill));
  PetscCall(PetscFree(meetings.node));
  PetscCall(PetscFree(meetings.material));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode NodeMaterialsDestroy(NodeMaterials *at)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(at->start));
  PetscCall(PetscFree(at->material));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* components.c -- components of bodies. Sets of nodes are united cell by cell on every rank. Then ranks
   exchange the sets of common nodes until nothing changes. */
#include "base/compat.h"
#include "base/gather.h"
#include "level/ghosted.h"
#include "support/components.h"
#include "kernel/disjointsets.h"

/* Sets of local nodes that this rank's cells join.
   [out] parent - representative of the set of each node [num_nodes] */
static void ComponentsUnite_Private(const Level *level, PetscInt parent[])
{
  DisjointSetsInitialize(level->num_nodes, parent);
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const PetscInt first = level->cell_start[c];

    for (PetscInt i = first + 1; i < level->cell_start[c + 1]; i++)
      DisjointSetsUnite(parent, level->cell_nodes[first], level->cell_nodes[i]);
  }
  for (PetscInt i = 0; i < level->num_nodes; i++) parent[i] = DisjointSetsFind(parent, i);
}

/* The largest global node of the component of each local node. [in] parent - of ComponentsUnite_Private();
   [out] name - [num_nodes] */
static PetscErrorCode ComponentsNumber_Private(Level *level, const PetscInt parent[], PetscInt name[])
{
  PetscBool    changed = PETSC_TRUE;
  PetscScalar *n;
  Vec          names;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, 1, &names));
  for (PetscInt i = 0; i < level->num_nodes; i++) name[i] = 0;
  for (PetscInt i = 0; i < level->num_nodes; i++) name[parent[i]] = PetscMax(name[parent[i]], level->node_global[i]);
  while (changed) {
    PetscCall(GhostedGetArray(names, &n));
    for (PetscInt i = 0; i < level->num_nodes; i++) n[i] = (PetscReal)name[parent[i]]; // integers below 2^53 are exact
    PetscCall(GhostedRestoreArray(names, &n));
    PetscCall(LevelShareVec(names, MAX_VALUES));
    changed = PETSC_FALSE;
    PetscCall(GhostedGetArray(names, &n));
    for (PetscInt i = 0; i < level->num_nodes; i++) {
      const PetscInt told = (PetscInt)PetscRealPart(n[i]);

      if (told <= name[parent[i]]) continue;
      name[parent[i]] = told;
      changed         = PETSC_TRUE;
    }
    PetscCall(GhostedRestoreArray(names, &n));
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &changed, 1, MPIU_BOOL, MPI_LOR, level->comm));
  }
  for (PetscInt i = 0; i < level->num_nodes; i++) name[i] = name[parent[i]];
  PetscCall(VecDestroy(&names));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The names and bodies of all components on all ranks: the owner of the node that names a component sends it.
   [in] name - [num_nodes]; [out] told - name and body of each component, names ascending [*num][2], owned by
   the caller */
static PetscErrorCode ComponentsGather_Private(const Level *level, const PetscInt name[], PetscInt *num,
                                               PetscInt **told)
{
  PetscMPIInt size, mine = 0, *counts, *starts;
  PetscInt   *own;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(level->comm, &size));
  PetscCall(PetscMalloc2(size, &counts, size + 1, &starts));
  for (PetscInt a = 0; a < level->num_owned; a++) mine += name[a] == level->node_global[a] ? 2 : 0;
  PetscCall(PetscMalloc1(mine, &own));
  mine = 0;
  for (PetscInt a = 0; a < level->num_owned; a++) {
    if (name[a] != level->node_global[a]) continue;
    own[mine++] = name[a];
    own[mine++] = level->node_body[a];
  }
  PetscCallMPI(MPI_Allgather(&mine, 1, MPI_INT, counts, 1, MPI_INT, level->comm));
  starts[0] = 0;
  for (PetscMPIInt r = 0; r < size; r++) starts[r + 1] = starts[r] + counts[r];
  *num = starts[size] / 2;
  PetscCall(PetscMalloc1(starts[size], told));
  PetscCallMPI(MPI_Allgatherv(own, mine, MPIU_INT, *told, counts, starts, MPIU_INT, level->comm));
  PetscCall(PetscFree(own));
  PetscCall(PetscFree2(counts, starts));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Boxes around the nodes of each component. Collective. [out] box - [num][COMPONENT_BOX] */
static PetscErrorCode ComponentsSetBoxes_Private(const Level *level, PetscInt num, const PetscInt of_node[],
                                                 PetscReal box[])
{
  const PetscInt dim = level->dim;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < num * COMPONENT_BOX; i++) box[i] = i % 3 < dim ? PETSC_NINFINITY : 0;
  for (PetscInt a = 0; a < level->num_owned; a++) {
    PetscReal *b = &box[of_node[a] * COMPONENT_BOX];

    for (PetscInt k = 0; k < dim; k++) {
      b[k]     = PetscMax(b[k], level->coords[a * dim + k]);
      b[3 + k] = PetscMax(b[3 + k], -level->coords[a * dim + k]);
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, box, (PetscMPIInt)(num * COMPONENT_BOX), MPIU_REAL, MPI_MAX, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether component i comes before component j: largest and smallest coordinates are the same numbers on any
   number of ranks. */
static PetscBool ComponentsCompare_Private(const PetscInt told[], const PetscReal box[], PetscInt i, PetscInt j)
{
  if (told[2 * i + 1] != told[2 * j + 1]) return (PetscBool)(told[2 * i + 1] < told[2 * j + 1]);
  for (PetscInt k = 0; k < 3; k++) {
    const PetscReal *a = &box[i * COMPONENT_BOX], *b = &box[j * COMPONENT_BOX],
                    difference = (a[k] - a[3 + k]) - (b[k] - b[3 + k]);

    if (difference != 0) return (PetscBool)(difference < 0);
  }
  return (PetscBool)(i < j);
}

/* Sorts components in place, by halves. [in,out] order - [num]; work - [num] */
static void ComponentsSort_Private(const PetscInt told[], const PetscReal box[], PetscInt num, PetscInt order[],
                                   PetscInt work[])
{
  const PetscInt half = num / 2;

  if (num < 2) return;
  ComponentsSort_Private(told, box, half, order, work);
  ComponentsSort_Private(told, box, num - half, order + half, work);
  for (PetscInt i = 0; i < num; i++) work[i] = order[i];
  for (PetscInt n = 0, i = 0, j = half; n < num; n++)
    order[n] = j == num || (i < half && ComponentsCompare_Private(told, box, work[i], work[j])) ? work[i++] : work[j++];
}

PetscErrorCode ComponentsCreate(Level *level, Components *components)
{
  PetscInt  *parent, *name, *told, *names, *order, *rank, num;
  PetscReal *box;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(level->num_nodes, &parent, level->num_nodes, &name));
  PetscCall(PetscMalloc1(level->num_nodes, &components->of_node));
  ComponentsUnite_Private(level, parent);
  PetscCall(ComponentsNumber_Private(level, parent, name));
  PetscCall(ComponentsGather_Private(level, name, &num, &told));
  PetscCall(PetscMalloc4(num, &names, num, &order, num, &rank, num * COMPONENT_BOX, &box));
  for (PetscInt i = 0; i < num; i++) {
    names[i] = told[2 * i];
    order[i] = i;
  }
  for (PetscInt i = 0; i < level->num_nodes; i++) PetscCall(PetscFindInt(name[i], num, names, &components->of_node[i]));
  PetscCall(ComponentsSetBoxes_Private(level, num, components->of_node, box));
  ComponentsSort_Private(told, box, num, order, rank);
  for (PetscInt n = 0; n < num; n++) rank[order[n]] = n;
  components->num = num;
  PetscCall(PetscMalloc2(num, &components->body, num * COMPONENT_BOX, &components->box));
  for (PetscInt n = 0; n < num; n++) {
    components->body[n] = told[2 * order[n] + 1];
    PetscCall(PetscArraycpy(&components->box[n * COMPONENT_BOX], &box[order[n] * COMPONENT_BOX], COMPONENT_BOX));
  }
  for (PetscInt i = 0; i < level->num_nodes; i++) components->of_node[i] = rank[components->of_node[i]];
  PetscCall(PetscFree4(names, order, rank, box));
  PetscCall(PetscFree(told));
  PetscCall(PetscFree2(parent, name));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ComponentsDestroy(Components *components)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(components->of_node));
  PetscCall(PetscFree2(components->body, components->box));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ComponentsOfGlobalNodes(Level *level, const Components *components, PetscInt num, const PetscInt nodes[],
                                       PetscInt component[])
{
  PetscInt          *asked;
  PetscScalar       *values;
  const PetscScalar *found;
  Vec                all, some;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(num, &asked));
  for (PetscInt i = 0; i < num; i++) asked[i] = PetscMax(nodes[i], 0);
  PetscCall(LevelCreateVec(level, 1, &all));
  PetscCall(VecGetArray(all, &values));
  for (PetscInt a = 0; a < level->num_owned; a++) values[a] = (PetscReal)components->of_node[a];
  PetscCall(VecRestoreArray(all, &values));
  PetscCall(GatherEntries(all, num, asked, &some));
  PetscCall(PetscFree(asked));
  PetscCall(VecGetArrayRead(some, &found));
  for (PetscInt i = 0; i < num; i++) component[i] = nodes[i] < 0 ? -1 : (PetscInt)PetscRealPart(found[i]);
  PetscCall(VecRestoreArrayRead(some, &found));
  PetscCall(VecDestroy(&some));
  PetscCall(VecDestroy(&all));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscInt ComponentsOfBody(const Components *components, PetscInt body)
{
  PetscInt count = 0;

  for (PetscInt n = 0; n < components->num; n++) count += components->body[n] == body;
  return count;
}

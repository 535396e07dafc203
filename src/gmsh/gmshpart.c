/* gmshpart.c -- parts of a mesh file. The first rank has all lists of a Gmsh file while it is read. */
#include "gmsh/gmshpart.h"
#include "base/compat.h"
#include "gmsh/groupsets.h"
#include "gmsh/hdf5mesh.h"
#include <string.h>

enum { REASON = 1024 };

/* The parts that the first rank sends. */
typedef struct {
  MPI_Comm     comm;
  PetscMPIInt  rank, size;
  PetscMPIInt *counts, *begins; /* on the first rank [size] */
  PetscInt    *first;           /* element of each part [size+1] */
} Scatter;

/* Removes elements without a set, in place, and replaces the groups of the others by their set: first_group
   is its number.
   [in] set - as of GroupSetsCreate() */
static void GmshKeep_Private(GmshMesh *mesh, const PetscInt set[])
{
  PetscInt num = 0, nodes = 0;

  for (PetscInt e = 0; e < mesh->num_elements; e++) {
    const PetscInt begin = mesh->start[e], size = mesh->type[e]->num_nodes;

    if (set[e] < 0) continue;
    mesh->type[num]        = mesh->type[e];
    mesh->first_group[num] = set[e];
    for (PetscInt i = 0; i < size; i++) mesh->nodes[nodes++] = mesh->nodes[begin + i];
    mesh->start[++num] = nodes;
  }
  mesh->num_elements = num;
}

/* Sends each rank the numbers of its elements, or of its points.
   [in] offset - index of the first number of each element; NULL if each has size numbers; [out] mine - on
   every rank [num] */
static PetscErrorCode Scatter_Private(Scatter *s, MPI_Datatype type, const PetscInt offset[], PetscInt size,
                                      const void *all, PetscInt num, void *mine)
{
  PetscMPIInt n;

  PetscFunctionBeginUser;
  for (PetscMPIInt r = 0; r < s->size && !s->rank; r++) {
    const PetscInt begin = offset ? offset[s->first[r]] : size * s->first[r];
    const PetscInt end   = offset ? offset[s->first[r + 1]] : size * s->first[r + 1];

    PetscCall(PetscMPIIntCast(begin, &s->begins[r]));
    PetscCall(PetscMPIIntCast(end - begin, &s->counts[r]));
  }
  PetscCall(PetscMPIIntCast(num, &n));
  PetscCallMPI(MPI_Scatterv(all, s->counts, s->begins, type, mine, n, type, 0, s->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static void ScatterSplit_Private(Scatter *s, PetscInt num)
{
  for (PetscMPIInt r = 0; r <= s->size; r++) s->first[r] = (PetscInt)((PetscInt64)num * r / s->size);
}

/* The physical groups of all sets, on all ranks. */
static PetscErrorCode ScatterGroups_Private(const Scatter *s, GroupSets *sets, GmshMesh *mesh)
{
  PetscInt num[2] = {sets->num, s->rank ? 0 : sets->start[sets->num]};

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Bcast(num, 2, MPIU_INT, 0, s->comm));
  if (s->rank) {
    sets->num = num[0];
    PetscCall(PetscRealloc((num[0] + 1) * sizeof(PetscInt), &sets->start));
  }
  PetscCall(PetscMalloc1(num[1], &mesh->group));
  if (!s->rank) PetscCall(PetscArraycpy(mesh->group, sets->number, num[1]));
  PetscCallMPI(MPI_Bcast(sets->start, (PetscMPIInt)num[0] + 1, MPIU_INT, 0, s->comm));
  PetscCallMPI(MPI_Bcast(mesh->group, (PetscMPIInt)num[1], MPIU_INT, 0, s->comm));
  mesh->num_groups = num[1];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The elements. [in] whole - on the first rank */
static PetscErrorCode ScatterElements_Private(Scatter *s, const GmshMesh *whole, GroupSets *sets, GmshMesh *mesh)
{
  PetscInt all = whole->num_elements, *kind = NULL, *mine, num = 0;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Bcast(&all, 1, MPIU_INT, 0, s->comm));
  ScatterSplit_Private(s, all);
  mesh->num_elements = s->first[s->rank + 1] - s->first[s->rank];
  PetscCall(PetscMalloc4(mesh->num_elements, &mesh->type, mesh->num_elements + 1, &mesh->start, mesh->num_elements,
                         &mesh->first_group, mesh->num_elements, &mesh->end_group));
  if (!s->rank) PetscCall(PetscMalloc1(all, &kind));
  for (PetscInt e = 0; e < all && !s->rank; e++) kind[e] = GmshTypeNumber(whole->type[e]);
  PetscCall(PetscMalloc1(mesh->num_elements, &mine));
  PetscCall(Scatter_Private(s, MPIU_INT, NULL, 1, kind, mesh->num_elements, mine));
  PetscCall(Scatter_Private(s, MPIU_INT, NULL, 1, whole->first_group, mesh->num_elements, mesh->first_group));
  mesh->start[0] = 0;
  for (PetscInt e = 0; e < mesh->num_elements; e++) {
    const PetscInt set = mesh->first_group[e];

    mesh->type[e]        = GmshTypeGet(mine[e]);
    mesh->first_group[e] = sets->start[set];
    mesh->end_group[e]   = sets->start[set + 1];
    mesh->start[e + 1]   = num += mesh->type[e]->num_nodes;
  }
  PetscCall(PetscFree(kind));
  PetscCall(PetscFree(mine));
  PetscCall(PetscMalloc1(num, &mesh->nodes));
  PetscCall(Scatter_Private(s, MPIU_INT, whole->start, 0, whole->nodes, num, mesh->nodes));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode ScatterPoints_Private(Scatter *s, const GmshMesh *whole, GmshPart *part)
{
  PetscFunctionBeginUser;
  part->all_nodes = whole->num_nodes;
  PetscCallMPI(MPI_Bcast(&part->all_nodes, 1, MPIU_INT, 0, s->comm));
  ScatterSplit_Private(s, part->all_nodes);
  part->first_node     = s->first[s->rank];
  part->mesh.num_nodes = s->first[s->rank + 1] - part->first_node;
  PetscCall(PetscMalloc1(3 * part->mesh.num_nodes, &part->mesh.coords));
  PetscCall(Scatter_Private(s, MPIU_REAL, NULL, 3, whole->coords, 3 * part->mesh.num_nodes, part->mesh.coords));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode NamesBroadcast_Private(MPI_Comm comm, PetscMPIInt rank, GmshNames *names)
{
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Bcast(&names->num, 1, MPIU_INT, 0, comm));
  if (rank) PetscCall(PetscCalloc3(names->num, &names->dim, names->num, &names->tag, names->num, &names->name));
  PetscCallMPI(MPI_Bcast(names->dim, (PetscMPIInt)names->num, MPIU_INT, 0, comm));
  PetscCallMPI(MPI_Bcast(names->tag, (PetscMPIInt)names->num, MPIU_INT, 0, comm));
  for (PetscInt i = 0; i < names->num; i++) {
    char text[HDF5_MESH_NAME] = "";

    if (!rank) PetscCall(PetscStrncpy(text, names->name[i], sizeof(text)));
    PetscCallMPI(MPI_Bcast(text, sizeof(text), MPI_CHAR, 0, comm));
    if (rank) PetscCall(PetscStrallocpy(text, &names->name[i]));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Scatters a file that the first rank has read. */
static PetscErrorCode GmshScatter_Private(MPI_Comm comm, PetscInt dim, GmshMesh *whole, GmshNames *names,
                                          GmshPart *part)
{
  Scatter   s    = {.comm = comm};
  GroupSets sets = {0, NULL, NULL};
  PetscInt *set;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &s.rank));
  PetscCallMPI(MPI_Comm_size(comm, &s.size));
  PetscCall(PetscMalloc3(s.size, &s.counts, s.size, &s.begins, s.size + 1, &s.first));
  if (!s.rank) {
    PetscCall(GroupSetsCreate(whole, dim, &sets, &set));
    GmshKeep_Private(whole, set);
    PetscCall(PetscFree(set));
  }
  PetscCall(NamesBroadcast_Private(comm, s.rank, names));
  PetscCall(ScatterGroups_Private(&s, &sets, &part->mesh));
  PetscCall(ScatterElements_Private(&s, whole, &sets, &part->mesh));
  PetscCall(ScatterPoints_Private(&s, whole, part));
  PetscCall(GroupSetsDestroy(&sets));
  PetscCall(PetscFree3(s.counts, s.begins, s.first));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether no element of any rank has a higher dimension, and cells are of known types. Collective. */
static PetscErrorCode GmshCheckParts_Private(MPI_Comm comm, const GmshMesh *mesh, PetscInt dim, PetscBool *good)
{
  PetscFunctionBeginUser;
  for (PetscInt e = 0; e < mesh->num_elements && *good; e++)
    if (mesh->type[e]->dim > dim || (mesh->type[e]->dim == dim && mesh->type[e]->cell == ELEMENT_COUNT))
      *good = PETSC_FALSE;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, good, 1, MPIU_BOOL, MPI_LAND, comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GmshPartRead(MPI_Comm comm, const char path[], PetscInt dim, GmshNames *names, GmshPart *part,
                            PetscBool *good)
{
  char        reason[REASON] = "";
  const char *ending         = strrchr(path, '.');
  GmshMesh    whole          = {0};
  PetscMPIInt rank, size;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCallMPI(MPI_Comm_size(comm, &size));
  *names = (GmshNames){0, NULL, NULL, NULL};
  *part  = (GmshPart){.first_node = 0};
  if (ending && !strcmp(ending, ".h5")) {
    PetscCall(HDF5MeshReadPart(path, rank, size, names, part, reason, sizeof(reason)));
    *good = (PetscBool)!reason[0];
    PetscCall(GmshCheckParts_Private(comm, &part->mesh, dim, good));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  if (!rank) PetscCall(GmshRead(path, names, &whole, reason, sizeof(reason)));
  *good = (PetscBool)!reason[0];
  PetscCall(GmshCheckParts_Private(comm, &whole, dim, good));
  if (*good) PetscCall(GmshScatter_Private(comm, dim, &whole, names, part));
  PetscCall(GmshMeshDestroy(&whole));
  PetscFunctionReturn(PETSC_SUCCESS);
}

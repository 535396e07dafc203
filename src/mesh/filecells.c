/* filecells.c -- the cells of a rank's part of the mesh files: their bodies, materials and middles. */
#include "base/compat.h"
#include "bodies/cellmeasure.h"
#include "mesh/filecells.h"
#include <petscsf.h>

/* The numbers of the physical groups of a name, or of several joined with '+'. */
typedef struct {
  PetscInt  num;
  PetscInt *tag, *count; /* cells of the body in each [num] */
} Tags;

/* The first of n items of a rank; below, the rank of an item. */
static PetscInt FilePartBegin_Private(PetscInt n, PetscInt size, PetscInt rank)
{
  return (PetscInt)((PetscInt64)n * rank / size);
}

static PetscInt FilePartFind_Private(PetscInt n, PetscInt size, PetscInt i)
{
  return (PetscInt)((((PetscInt64)i + 1) * size - 1) / n);
}

PetscErrorCode FilesGetPoints(const Files *files, PetscInt num, const PetscInt points[], PetscReal x[])
{
  PetscSFNode *remote;
  PetscReal   *own;
  PetscInt     num_own = 0;
  MPI_Datatype triple;
  PetscSF      sf;

  PetscFunctionBeginUser;
  for (PetscInt f = 0; f < files->num; f++) num_own += files->part[f].mesh.num_nodes;
  PetscCall(PetscMalloc1(num, &remote));
  PetscCall(PetscMalloc1(3 * num_own, &own));
  num_own = 0;
  for (PetscInt f = 0; f < files->num; num_own += files->part[f++].mesh.num_nodes)
    PetscCall(PetscArraycpy(&own[3 * num_own], files->part[f].mesh.coords, 3 * files->part[f].mesh.num_nodes));
  for (PetscInt i = 0; i < num; i++) {
    PetscInt f = 0, before = 0, node, rank;

    while (points[i] >= files->first_point[f + 1]) f++;
    node = points[i] - files->first_point[f];
    rank = FilePartFind_Private(files->part[f].all_nodes, files->size, node);
    for (PetscInt g = 0; g < f; g++)
      before += FilePartBegin_Private(files->part[g].all_nodes, files->size, rank + 1) -
                FilePartBegin_Private(files->part[g].all_nodes, files->size, rank);
    remote[i].rank  = rank;
    remote[i].index = before + node - FilePartBegin_Private(files->part[f].all_nodes, files->size, rank);
  }
  PetscCallMPI(MPI_Type_contiguous(3, MPIU_REAL, &triple));
  PetscCallMPI(MPI_Type_commit(&triple));
  PetscCall(PetscSFCreate(files->comm, &sf));
  PetscCall(PetscSFSetGraph(sf, num_own, num, NULL, PETSC_OWN_POINTER, remote, PETSC_OWN_POINTER));
  PetscCall(PetscSFBcastBegin(sf, triple, own, x, MPI_REPLACE));
  PetscCall(PetscSFBcastEnd(sf, triple, own, x, MPI_REPLACE));
  PetscCall(PetscSFDestroy(&sf));
  PetscCallMPI(MPI_Type_free(&triple));
  PetscCall(PetscFree(own));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FileCellsAllocate(PetscInt num, PetscInt max_nodes, FileCells *cells)
{
  PetscFunctionBeginUser;
  *cells = (FileCells){.num = num, .max_nodes = max_nodes};
  PetscCall(PetscMalloc6(num, &cells->body, num, &cells->material, num, &cells->type, num, &cells->file_nodes, num,
                         &cells->reversed, num * max_nodes, &cells->nodes));
  PetscCall(PetscMalloc3(num * FILE_FACETS, &cells->neighbour, num * FILE_FACETS, &cells->group, num * FILE_FACETS,
                         &cells->group_end));
  PetscCall(PetscMalloc2(3 * num, &cells->middle, num * FILE_FACETS, &cells->distance));
  for (PetscInt i = 0; i < num * FILE_FACETS; i++) cells->neighbour[i] = cells->group[i] = cells->group_end[i] = -1;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FileCellsDestroy(FileCells *cells)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree6(cells->body, cells->material, cells->type, cells->file_nodes, cells->reversed, cells->nodes));
  PetscCall(PetscFree3(cells->neighbour, cells->group, cells->group_end));
  PetscCall(PetscFree2(cells->middle, cells->distance));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A group whose own name has a '+' is one group.
   [in] groups - NULL for all cells; [in,out] good - whether each name can be a group */
static PetscErrorCode TagsCreate_Private(const GmshNames *names, PetscInt dim, const char groups[], Tags *tags,
                                         PetscBool *good)
{
  SideNames parts = {0, NULL};

  PetscFunctionBeginUser;
  *tags = (Tags){.num = 0};
  if (!groups) PetscFunctionReturn(PETSC_SUCCESS);
  if (GmshNamesHas(names, dim, groups))
    tags->num = 1;
  else
    PetscCall(SideNamesAdd(&parts, groups));
  tags->num = PetscMax(tags->num, parts.num);
  PetscCall(PetscCalloc2(tags->num, &tags->tag, tags->num, &tags->count));
  for (PetscInt i = 0; i < tags->num; i++)
    if (!GmshNamesFindGroup(names, dim, parts.num ? parts.name[i] : groups, &tags->tag[i])) *good = PETSC_FALSE;
  PetscCall(SideNamesDestroy(&parts));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode TagsDestroy_Private(Tags *tags)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree2(tags->tag, tags->count));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether an element is in one of the groups. */
static PetscBool TagsHave_Private(Tags *tags, const GmshMesh *mesh, PetscInt e)
{
  PetscBool have = PETSC_FALSE;

  for (PetscInt g = mesh->first_group[e]; g < mesh->end_group[e]; g++) {
    for (PetscInt i = 0; i < tags->num; i++) {
      if (mesh->group[g] != tags->tag[i]) continue;
      have = PETSC_TRUE;
      tags->count[i]++;
    }
  }
  return have;
}

/* Whether each group has cells of some rank. Collective. */
static PetscErrorCode TagsCheck_Private(MPI_Comm comm, Tags *tags, PetscBool *good)
{
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, tags->count, (PetscMPIInt)tags->num, MPIU_INT, MPI_SUM, comm));
  for (PetscInt i = 0; i < tags->num; i++)
    if (!tags->count[i]) *good = PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The body of each element of a file, -1 for none. [in,out] body - [part->num_elements] */
static PetscErrorCode BodiesFind_Private(Scene scene, const Files *files, PetscInt f, PetscInt body[], PetscBool *good)
{
  const GmshMesh *mesh = &files->part[f].mesh;

  PetscFunctionBeginUser;
  for (PetscInt e = 0; e < mesh->num_elements; e++) body[e] = -1;
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    Tags tags;

    if (files->of_body[b] != f) continue;
    PetscCall(TagsCreate_Private(&files->names[f], files->dim, scene->bodies[b].region, &tags, good));
    for (PetscInt e = 0; e < mesh->num_elements; e++) {
      if (mesh->type[e]->dim != files->dim || (scene->bodies[b].region && !TagsHave_Private(&tags, mesh, e))) continue;
      if (body[e] >= 0) *good = PETSC_FALSE; // the cell is in two bodies
      body[e] = b;
    }
    PetscCall(TagsCheck_Private(files->comm, &tags, good));
    PetscCall(TagsDestroy_Private(&tags));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The material of each element of a body that has regions.
   [in,out] material - that of the body before [part->num_elements] */
static PetscErrorCode MaterialsFind_Private(Scene scene, const Files *files, PetscInt b, const PetscInt body[],
                                            PetscInt material[], PetscBool *good)
{
  const PetscInt  f = files->of_body[b], first = SceneBodyFirstRegion(scene, b);
  const GmshMesh *mesh = &files->part[f].mesh;

  PetscFunctionBeginUser;
  for (PetscInt m = first; m < first + scene->bodies[b].num_regions; m++) {
    Tags tags;

    PetscCall(
        TagsCreate_Private(&files->names[f], files->dim, scene->regions[m - scene->num_bodies].group, &tags, good));
    for (PetscInt e = 0; e < mesh->num_elements; e++) {
      if (body[e] != b || !TagsHave_Private(&tags, mesh, e)) continue;
      if (material[e] != b) *good = PETSC_FALSE; // in two regions
      material[e] = m;
    }
    PetscCall(TagsCheck_Private(files->comm, &tags, good));
    PetscCall(TagsDestroy_Private(&tags));
  }
  for (PetscInt e = 0; e < mesh->num_elements && scene->bodies[b].num_regions && scene->bodies[b].missing; e++)
    if (body[e] == b && material[e] == b) *good = PETSC_FALSE; // a cell without a material
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Appends the cells of a file, also those of no body: their facets are not on a boundary. */
static PetscErrorCode FileCellsAdd_Private(Scene scene, const Files *files, PetscInt f, FileCells *cells,
                                           PetscBool *good)
{
  const GmshMesh *mesh = &files->part[f].mesh;
  PetscInt       *body, *material;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(mesh->num_elements, &body, mesh->num_elements, &material));
  PetscCall(BodiesFind_Private(scene, files, f, body, good));
  PetscCall(PetscArraycpy(material, body, mesh->num_elements));
  for (PetscInt b = 0; b < scene->num_bodies; b++)
    if (files->of_body[b] == f) PetscCall(MaterialsFind_Private(scene, files, b, body, material, good));
  for (PetscInt e = 0; e < mesh->num_elements; e++) {
    const GmshType *type = mesh->type[e];
    const PetscInt  c    = cells->num;

    if (type->dim != files->dim) continue;
    cells->body[c]       = body[e];
    cells->material[c]   = material[e];
    cells->type[c]       = type->cell;
    cells->file_nodes[c] = type->num_nodes;
    for (PetscInt i = 0; i < type->num_nodes; i++)
      cells->nodes[c * cells->max_nodes + i] = files->first_point[f] + mesh->nodes[mesh->start[e] + i];
    if (ElementOrder(type->cell) != cells->order) *good = PETSC_FALSE; // of both orders
    cells->num++;
  }
  PetscCall(PetscFree2(body, material));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Middles and orientations of cells; checks that corners differ, and that a plane mesh is plane.
   Collective. */
static PetscErrorCode FileCellsSetMiddles_Private(const Files *files, FileCells *cells, PetscBool *good)
{
  PetscReal range[2] = {PETSC_MAX_REAL, PETSC_MAX_REAL}, *x; // the least of z and of -z
  PetscInt *points, num = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(cells->num * cells->max_nodes, &points));
  for (PetscInt c = 0; c < cells->num; c++)
    for (PetscInt i = 0; i < cells->file_nodes[c]; i++) points[num++] = cells->nodes[c * cells->max_nodes + i];
  PetscCall(PetscSortRemoveDupsInt(&num, points));
  PetscCall(PetscMalloc1(3 * num, &x));
  PetscCall(FilesGetPoints(files, num, points, x));
  for (PetscInt c = 0; c < cells->num; c++) {
    const ElementType linear  = ElementLinear((ElementType)cells->type[c]);
    const PetscInt    corners = ElementNumNodes(linear);
    PetscReal        *middle  = &cells->middle[3 * c], X[ELEMENT_MAX_NODES * 3];

    for (PetscInt d = 0; d < 3; d++) middle[d] = 0;
    for (PetscInt i = 0; i < cells->file_nodes[c]; i++) {
      const PetscInt node = cells->nodes[c * cells->max_nodes + i];
      PetscInt       at;

      PetscCall(PetscFindInt(node, num, points, &at));
      range[0] = PetscMin(range[0], x[3 * at + 2]);
      range[1] = PetscMin(range[1], -x[3 * at + 2]);
      for (PetscInt j = 0; j < i && i < corners; j++)
        if (cells->nodes[c * cells->max_nodes + j] == node) *good = PETSC_FALSE;
      for (PetscInt d = 0; d < 3 && i < corners; d++) middle[d] += x[3 * at + d] / (PetscReal)corners;
      for (PetscInt d = 0; d < files->dim && i < corners; d++) X[i * files->dim + d] = x[3 * at + d];
    }
    cells->reversed[c] = CellGetMeasure(linear, files->dim, X) < 0;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, range, 2, MPIU_REAL, MPI_MIN, files->comm));
  if (files->dim < 3 && range[0] + range[1] < 0) *good = PETSC_FALSE; // not flat to the last digit
  PetscCall(PetscFree(points));
  PetscCall(PetscFree(x));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Number of cells, their order, and the largest number of nodes of one. Collective. */
static PetscErrorCode FilesCount_Private(const Files *files, PetscInt *num, PetscInt *max_nodes, PetscInt *order)
{
  PetscInt most[2] = {0, 1};

  PetscFunctionBeginUser;
  *num = 0;
  for (PetscInt f = 0; f < files->num; f++) {
    for (PetscInt e = 0; e < files->part[f].mesh.num_elements; e++) {
      const GmshType *type = files->part[f].mesh.type[e];

      if (type->dim != files->dim) continue;
      ++*num;
      most[0] = PetscMax(most[0], type->num_nodes);
      most[1] = PetscMax(most[1], ElementOrder(type->cell));
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, most, 2, MPIU_INT, MPI_MAX, files->comm));
  *max_nodes = most[0];
  *order     = most[1];
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FileCellsCreate(Scene scene, const Files *files, FileCells *cells, PetscBool *good)
{
  PetscInt num = 0, max_nodes = 0, order = 1;

  PetscFunctionBeginUser;
  PetscCall(FilesCount_Private(files, &num, &max_nodes, &order));
  PetscCall(FileCellsAllocate(num, max_nodes, cells));
  cells->num   = 0;
  cells->order = order;
  for (PetscInt f = 0; f < files->num; f++) PetscCall(FileCellsAdd_Private(scene, files, f, cells, good));
  PetscCall(FileCellsSetMiddles_Private(files, cells, good));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, good, 1, MPIU_BOOL, MPI_LAND, files->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

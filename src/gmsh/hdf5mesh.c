/* hdf5mesh.c -- reads HDF5 meshes by hyperslabs: each rank reads its part only.

   PETSc's own HDF5 meshes (DMPlexTopologyLoad()) have all edges and facets, and no middle nodes of curved
   cells. */
#include "gmsh/hdf5mesh.h"
#include "base/compat.h"
#include <hdf5.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>

enum { MAX_TYPE = 19, PATH = 64, MAX_ROWS = 500000000 };

/* Rows of the file; the first error sets `reason`. */
typedef struct {
  hid_t    file;
  PetscInt part, num_parts;
  char    *reason; /* [len] */
  size_t   len;
} Reader;

static void HDF5MeshFail_Private(Reader *reader, const char format[], ...)
{
  va_list arguments;

  if (reader->reason[0]) return;
  va_start(arguments, format);
  vsnprintf(reader->reason, reader->len, format, arguments);
  va_end(arguments);
}

/* An attribute of the file, or 0. */
static int HDF5MeshReadAttribute_Private(hid_t file, const char name[])
{
  int         value     = 0;
  const hid_t attribute = H5Aexists(file, name) > 0 ? H5Aopen(file, name, H5P_DEFAULT) : -1;

  if (attribute < 0) return 0;
  if (H5Aread(attribute, H5T_NATIVE_INT, &value) < 0) value = 0;
  H5Aclose(attribute);
  return value;
}

static hid_t HDF5MeshOpen_Private(const char path[])
{
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL); // HDF5 prints nothing: failures have sentences here
  return H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
}

PetscErrorCode HDF5MeshProbe(const char path[], PetscBool *is, PetscInt *dim)
{
  const hid_t file = HDF5MeshOpen_Private(path);

  PetscFunctionBeginUser;
  *is  = PETSC_TRUE;
  *dim = 0;
  if (file < 0) PetscFunctionReturn(PETSC_SUCCESS);
  *is  = (PetscBool)(H5Aexists(file, "mortise_mesh") > 0);
  *dim = *is ? HDF5MeshReadAttribute_Private(file, "dimension") : 0;
  H5Fclose(file);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* An open dataset of [rows][columns], or [rows]. */
typedef struct {
  const char *name;
  hid_t       set;
  PetscInt    rows;
} Rows;

/* Opens a dataset; after a failure it has no rows. */
static Rows HDF5MeshOpenRows_Private(Reader *reader, const char name[], PetscInt columns)
{
  Rows    rows     = {.name = name, .set = -1};
  hsize_t shape[2] = {0, 1};
  hid_t   space    = -1;

  if (reader->reason[0]) return rows;
  rows.set = H5Dopen2(reader->file, name, H5P_DEFAULT);
  if (rows.set >= 0) space = H5Dget_space(rows.set);
  if (space < 0 || H5Sget_simple_extent_ndims(space) > 2 || H5Sget_simple_extent_dims(space, shape, NULL) < 1)
    HDF5MeshFail_Private(reader, "it has no rows /%s", name);
  else if ((PetscInt)shape[1] != columns || shape[0] > MAX_ROWS)
    HDF5MeshFail_Private(reader, "its /%s has the shape %llu x %llu; %d columns are expected", name,
                         (unsigned long long)shape[0], (unsigned long long)shape[1], (int)columns);
  else
    rows.rows = (PetscInt)shape[0];
  if (space >= 0) H5Sclose(space);
  return rows;
}

/* Reads some rows, in one piece. */
static void HDF5MeshReadRows_Private(Reader *reader, const Rows *rows, hid_t type, PetscInt begin, PetscInt num,
                                     void *values)
{
  const hid_t space    = reader->reason[0] ? -1 : H5Dget_space(rows->set);
  hsize_t     shape[2] = {0, 1}, start[2] = {(hsize_t)begin, 0};
  hid_t       memory;
  herr_t      bad;

  if (space < 0) return;
  (void)H5Sget_simple_extent_dims(space, shape, NULL);
  shape[0] = (hsize_t)num;
  memory   = H5Screate_simple(H5Sget_simple_extent_ndims(space), shape, NULL);
  bad      = H5Sselect_hyperslab(space, H5S_SELECT_SET, start, NULL, shape, NULL);
  if (bad >= 0 && num) bad = H5Dread(rows->set, type, memory, space, H5P_DEFAULT, values);
  if (bad < 0) HDF5MeshFail_Private(reader, "its /%s cannot be read", rows->name);
  H5Sclose(memory);
  H5Sclose(space);
}

static void RowsClose_Private(Rows *rows)
{
  if (rows->set >= 0) H5Dclose(rows->set);
  rows->set = -1;
}

/* A list of integers, whole. [out] list - owned by the caller */
static PetscErrorCode HDF5MeshReadList_Private(Reader *reader, const char name[], PetscInt *num, PetscInt **list)
{
  Rows rows = HDF5MeshOpenRows_Private(reader, name, 1);

  PetscFunctionBeginUser;
  *num = rows.rows;
  PetscCall(PetscMalloc1(rows.rows, list));
  HDF5MeshReadRows_Private(reader, &rows, HDF5_MESH_INTEGER, 0, rows.rows, *list);
  RowsClose_Private(&rows);
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode HDF5MeshReadNames_Private(Reader *reader, GmshNames *names)
{
  Rows      rows = HDF5MeshOpenRows_Private(reader, "names/name", 1);
  hid_t     type = H5Tcopy(H5T_C_S1);
  PetscInt *list[2], num[2];
  char     *text;

  PetscFunctionBeginUser;
  PetscCall(HDF5MeshReadList_Private(reader, "names/dimension", &num[0], &list[0]));
  PetscCall(HDF5MeshReadList_Private(reader, "names/number", &num[1], &list[1]));
  if (num[0] != rows.rows || num[1] != rows.rows)
    HDF5MeshFail_Private(reader, "its /names do not have equally many rows");
  PetscCall(PetscCalloc1(rows.rows * HDF5_MESH_NAME, &text));
  H5Tset_size(type, HDF5_MESH_NAME);
  H5Tset_cset(type, H5T_CSET_UTF8);
  HDF5MeshReadRows_Private(reader, &rows, type, 0, rows.rows, text);
  H5Tclose(type);
  RowsClose_Private(&rows);
  if (!reader->reason[0]) {
    PetscCall(PetscCalloc3(rows.rows, &names->dim, rows.rows, &names->tag, rows.rows, &names->name));
    for (; names->num < rows.rows; names->num++) {
      text[(names->num + 1) * HDF5_MESH_NAME - 1] = '\0';
      names->dim[names->num]                      = list[0][names->num];
      names->tag[names->num]                      = list[1][names->num];
      PetscCall(PetscStrallocpy(&text[names->num * HDF5_MESH_NAME], &names->name[names->num]));
    }
  }
  PetscCall(PetscFree(text));
  PetscCall(PetscFree(list[0]));
  PetscCall(PetscFree(list[1]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The first of this rank's rows, of one part more that of the next. */
static PetscInt ReaderBegin_Private(const Reader *reader, PetscInt rows, PetscInt more)
{
  return (PetscInt)((PetscInt64)rows * (reader->part + more) / reader->num_parts);
}

static PetscErrorCode HDF5MeshReadPoints_Private(Reader *reader, GmshPart *part)
{
  Rows      rows = HDF5MeshOpenRows_Private(reader, "points", 3);
  GmshMesh *mesh = &part->mesh;

  PetscFunctionBeginUser;
  part->all_nodes  = rows.rows;
  part->first_node = ReaderBegin_Private(reader, rows.rows, 0);
  mesh->num_nodes  = ReaderBegin_Private(reader, rows.rows, 1) - part->first_node;
  PetscCall(PetscMalloc1(3 * mesh->num_nodes, &mesh->coords));
  HDF5MeshReadRows_Private(reader, &rows, H5T_NATIVE_DOUBLE, part->first_node, mesh->num_nodes, mesh->coords);
  for (PetscInt i = 0; i < 3 * mesh->num_nodes && !reader->reason[0]; i++)
    if (!isfinite(mesh->coords[i])) HDF5MeshFail_Private(reader, "a coordinate is not finite");
  RowsClose_Private(&rows);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Physical groups as the sets of the file, which elements refer to.
   [out] start - of the sets [num+1], owned by the caller */
static PetscErrorCode HDF5MeshReadGroups_Private(Reader *reader, GmshMesh *mesh, PetscInt *num, PetscInt **start)
{
  PetscInt rows;

  PetscFunctionBeginUser;
  PetscCall(HDF5MeshReadList_Private(reader, "groups/start", &rows, start));
  PetscCall(HDF5MeshReadList_Private(reader, "groups/number", &mesh->num_groups, &mesh->group));
  *num = PetscMax(rows - 1, 0);
  for (PetscInt i = 0; i < rows && !reader->reason[0]; i++) {
    if ((*start)[i] < (i ? (*start)[i - 1] : 0) || (*start)[i] > mesh->num_groups)
      HDF5MeshFail_Private(reader, "its /groups/start does not ascend to the length of /groups/number");
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The rows of all types that occur, which this rank reads.
   [out] num - elements, of each type [MAX_TYPE+1] and nodes in all */
static void HDF5MeshCountRows_Private(Reader *reader, PetscInt num[], PetscInt *num_elements, PetscInt *num_nodes)
{
  *num_elements = *num_nodes = 0;
  for (PetscInt t = 1; t <= MAX_TYPE; t++) {
    const GmshType *type = GmshTypeGet(t);
    char            name[PATH];
    Rows            rows;

    num[t] = 0;
    snprintf(name, sizeof(name), "elements/%d", (int)t);
    if (reader->reason[0] || H5Lexists(reader->file, name, H5P_DEFAULT) <= 0) continue;
    if (type->cell == ELEMENT_COUNT) HDF5MeshFail_Private(reader, "it holds %s, which are not accepted", type->name);
    snprintf(name, sizeof(name), "elements/%d/nodes", (int)t);
    rows = HDF5MeshOpenRows_Private(reader, name, type->num_nodes);
    RowsClose_Private(&rows);
    num[t] = rows.rows;
    *num_elements += ReaderBegin_Private(reader, rows.rows, 1) - ReaderBegin_Private(reader, rows.rows, 0);
    *num_nodes +=
        type->num_nodes * (ReaderBegin_Private(reader, rows.rows, 1) - ReaderBegin_Private(reader, rows.rows, 0));
  }
}

/* Appends an element. [in] nodes - in Gmsh's order [type->num_nodes]; [in] all_nodes - of the file */
static void HDF5MeshAddElement_Private(Reader *reader, const GmshType *type, const PetscInt nodes[], PetscInt all_nodes,
                                       GmshMesh *mesh)
{
  const PetscInt e = mesh->num_elements;

  for (PetscInt i = 0; i < type->num_nodes; i++) {
    if (nodes[i] < 0 || nodes[i] >= all_nodes)
      HDF5MeshFail_Private(reader, "one of its %s refers to point %d, and there are those from 0 to %d", type->name,
                           (int)nodes[i], (int)all_nodes - 1);
    mesh->nodes[mesh->start[e] + (type->place ? type->place[i] : i)] = nodes[i];
  }
  mesh->type[e]      = type;
  mesh->start[e + 1] = mesh->start[e] + type->num_nodes;
  mesh->num_elements++;
}

/* The rows of one type. [in] all - in the file; num_sets, sets - of groups */
static PetscErrorCode HDF5MeshReadType_Private(Reader *reader, PetscInt number, PetscInt all, PetscInt num_sets,
                                               const PetscInt sets[], GmshPart *part)
{
  const GmshType *type  = GmshTypeGet(number);
  const PetscInt  begin = ReaderBegin_Private(reader, all, 0), num = ReaderBegin_Private(reader, all, 1) - begin;
  const PetscInt  first = part->mesh.num_elements;
  char            name[PATH];
  Rows            rows;
  PetscInt       *nodes, *set;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(num * type->num_nodes, &nodes, num, &set));
  snprintf(name, sizeof(name), "elements/%d/nodes", (int)number);
  rows = HDF5MeshOpenRows_Private(reader, name, type->num_nodes);
  HDF5MeshReadRows_Private(reader, &rows, HDF5_MESH_INTEGER, begin, num, nodes);
  RowsClose_Private(&rows);
  for (PetscInt i = 0; i < num && !reader->reason[0]; i++)
    HDF5MeshAddElement_Private(reader, type, &nodes[i * type->num_nodes], part->all_nodes, &part->mesh);
  snprintf(name, sizeof(name), "elements/%d/groups", (int)number);
  rows = HDF5MeshOpenRows_Private(reader, name, 1);
  if (rows.rows != all)
    HDF5MeshFail_Private(reader, "its /%s does not have a row for each of the %s", name, type->name);
  HDF5MeshReadRows_Private(reader, &rows, HDF5_MESH_INTEGER, begin, num, set);
  RowsClose_Private(&rows);
  for (PetscInt i = 0; i < num && !reader->reason[0]; i++) {
    if (set[i] < 0 || set[i] >= num_sets) {
      HDF5MeshFail_Private(reader, "one of its %s refers to set %d of groups, and there are those from 0 to %d",
                           type->name, (int)set[i], (int)num_sets - 1);
      continue;
    }
    part->mesh.first_group[first + i] = sets[set[i]];
    part->mesh.end_group[first + i]   = sets[set[i] + 1];
  }
  PetscCall(PetscFree2(nodes, set));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode HDF5MeshReadPart(const char path[], PetscInt part, PetscInt num_parts, GmshNames *names, GmshPart *mesh,
                                char reason[], size_t len)
{
  Reader    reader = {.part = part, .num_parts = num_parts, .reason = reason, .len = len};
  GmshMesh *lists  = &mesh->mesh;
  PetscInt  num[MAX_TYPE + 1], num_elements, num_nodes, num_sets = 0, *sets;

  PetscFunctionBeginUser;
  reason[0]   = '\0';
  *names      = (GmshNames){0, NULL, NULL, NULL};
  *mesh       = (GmshPart){.first_node = 0};
  reader.file = HDF5MeshOpen_Private(path);
  if (reader.file < 0) {
    HDF5MeshFail_Private(&reader, "it cannot be read as an HDF5 file");
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  num_nodes = HDF5MeshReadAttribute_Private(reader.file, "mortise_mesh");
  if (num_nodes != HDF5_MESH_VERSION)
    HDF5MeshFail_Private(&reader, "its layout has version %d; %d is accepted: convert the mesh anew", (int)num_nodes,
                         HDF5_MESH_VERSION);
  PetscCall(HDF5MeshReadNames_Private(&reader, names));
  PetscCall(HDF5MeshReadPoints_Private(&reader, mesh));
  PetscCall(HDF5MeshReadGroups_Private(&reader, lists, &num_sets, &sets));
  HDF5MeshCountRows_Private(&reader, num, &num_elements, &num_nodes);
  PetscCall(PetscMalloc4(num_elements, &lists->type, num_elements + 1, &lists->start, num_elements, &lists->first_group,
                         num_elements, &lists->end_group));
  PetscCall(PetscMalloc1(num_nodes, &lists->nodes));
  lists->start[0] = 0;
  for (PetscInt t = 1; t <= MAX_TYPE && !reader.reason[0]; t++)
    if (num[t]) PetscCall(HDF5MeshReadType_Private(&reader, t, num[t], num_sets, sets, mesh));
  PetscCall(PetscFree(sets));
  H5Fclose(reader.file);
  PetscFunctionReturn(PETSC_SUCCESS);
}

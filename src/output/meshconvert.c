/* meshconvert.c -- writes the layout of hdf5mesh.h: cells, and the facets in physical groups. A scene uses
   nothing else of a Gmsh file. */
#include <hdf5.h>
#include <string.h>
#include <unistd.h>
#include "base/compat.h"
#include "base/usererror.h"
#include "gmsh/groupsets.h"
#include "gmsh/hdf5mesh.h"
#include "output/fileset.h"
#include "output/hdf5driver.h"
#include "output/meshconvert.h"

enum { MAX_TYPE = 19, PATH = 64, SENTENCE = 1024, CHUNK = 1 << 15 };

typedef struct {
  hid_t           file;
  PetscBool       good;
  const GmshMesh *mesh;
  PetscInt        dim;
  PetscInt       *set; /* of each element, -1 for those that are not kept [mesh->num_elements] */
  GroupSets       sets;
} Converter;

/* A dataset of [rows][columns], or [rows] for one column; its values follow, or are given. Returns it,
   negative on failure. */
static hid_t ConverterCreateRows_Private(Converter *c, const char name[], hid_t type, PetscInt rows, PetscInt columns)
{
  const hsize_t shape[2] = {(hsize_t)rows, (hsize_t)columns};
  const hid_t   space = H5Screate_simple(columns == 1 ? 1 : 2, shape, NULL), links = H5Pcreate(H5P_LINK_CREATE);
  hid_t         set = -1;

  H5Pset_create_intermediate_group(links, 1);
  if (c->good) set = H5Dcreate2(c->file, name, type, space, links, H5P_DEFAULT, H5P_DEFAULT);
  if (set < 0) c->good = PETSC_FALSE;
  H5Pclose(links);
  H5Sclose(space);
  return set;
}

/* [in] memory - type of the values; stored - of those in the file */
static void ConverterWriteRows_Private(Converter *c, const char name[], hid_t memory, hid_t stored, PetscInt rows,
                                       const void *values)
{
  const PetscBool points = (PetscBool)!strcmp(name, "points");
  const hid_t     set    = ConverterCreateRows_Private(c, name, stored, rows, points ? 3 : 1);

  if (set < 0) return;
  if (rows && H5Dwrite(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) c->good = PETSC_FALSE;
  H5Dclose(set);
}

/* Some rows of a dataset, behind those written. */
static void ConverterAppendRows_Private(Converter *c, hid_t set, PetscInt begin, PetscInt num, PetscInt columns,
                                        const PetscInt values[])
{
  const hsize_t start[2] = {(hsize_t)begin, 0}, count[2] = {(hsize_t)num, (hsize_t)columns};
  hid_t         space, memory;

  if (set < 0 || !num) return;
  space  = H5Dget_space(set);
  memory = H5Screate_simple(H5Sget_simple_extent_ndims(space), count, NULL);
  if (H5Sselect_hyperslab(space, H5S_SELECT_SET, start, NULL, count, NULL) < 0 ||
      H5Dwrite(set, HDF5_MESH_INTEGER, memory, space, H5P_DEFAULT, values) < 0)
    c->good = PETSC_FALSE;
  H5Sclose(memory);
  H5Sclose(space);
}

/* All elements of a type, chunk by chunk. */
static PetscErrorCode ConverterWriteType_Private(Converter *c, PetscInt number)
{
  const GmshMesh *mesh = c->mesh;
  const GmshType *type = GmshTypeGet(number);
  PetscInt        num = 0, done = 0, used = 0, *nodes, *sets;
  char            name[2][PATH];
  hid_t           set[2];

  PetscFunctionBeginUser;
  for (PetscInt e = 0; e < mesh->num_elements; e++) num += mesh->type[e] == type && c->set[e] >= 0;
  if (!num) PetscFunctionReturn(PETSC_SUCCESS);
  snprintf(name[0], PATH, "elements/%d/nodes", (int)number);
  snprintf(name[1], PATH, "elements/%d/groups", (int)number);
  set[0] = ConverterCreateRows_Private(c, name[0], H5T_STD_I32LE, num, type->num_nodes);
  set[1] = ConverterCreateRows_Private(c, name[1], H5T_STD_I32LE, num, 1);
  PetscCall(PetscMalloc2(CHUNK * type->num_nodes, &nodes, CHUNK, &sets));
  for (PetscInt e = 0; e < mesh->num_elements; e++) {
    if (mesh->type[e] != type || c->set[e] < 0) continue;
    for (PetscInt i = 0; i < type->num_nodes; i++)
      nodes[used * type->num_nodes + i] = mesh->nodes[mesh->start[e] + (type->place ? type->place[i] : i)];
    sets[used++] = c->set[e];
    if (used < CHUNK && done + used < num) continue;
    ConverterAppendRows_Private(c, set[0], done, used, type->num_nodes, nodes);
    ConverterAppendRows_Private(c, set[1], done, used, 1, sets);
    done += used;
    used = 0;
  }
  for (PetscInt i = 0; i < 2; i++)
    if (set[i] >= 0) H5Dclose(set[i]);
  PetscCall(PetscFree2(nodes, sets));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode ConverterWriteNames_Private(Converter *c, const GmshNames *names)
{
  const hid_t type = H5Tcopy(H5T_C_S1);
  char       *text;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(names->num * HDF5_MESH_NAME, &text));
  for (PetscInt i = 0; i < names->num; i++)
    PetscCall(PetscStrncpy(&text[i * HDF5_MESH_NAME], names->name[i], HDF5_MESH_NAME));
  H5Tset_size(type, HDF5_MESH_NAME);
  H5Tset_cset(type, H5T_CSET_UTF8);
  ConverterWriteRows_Private(c, "names/name", type, type, names->num, text);
  ConverterWriteRows_Private(c, "names/dimension", HDF5_MESH_INTEGER, H5T_STD_I32LE, names->num, names->dim);
  ConverterWriteRows_Private(c, "names/number", HDF5_MESH_INTEGER, H5T_STD_I32LE, names->num, names->tag);
  H5Tclose(type);
  PetscCall(PetscFree(text));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static void ConverterWriteAttribute_Private(Converter *c, const char name[], int value)
{
  const hid_t space     = H5Screate(H5S_SCALAR);
  const hid_t attribute = c->good ? H5Acreate2(c->file, name, H5T_STD_I32LE, space, H5P_DEFAULT, H5P_DEFAULT) : -1;

  if (attribute < 0 || H5Awrite(attribute, H5T_NATIVE_INT, &value) < 0) c->good = PETSC_FALSE;
  if (attribute >= 0) H5Aclose(attribute);
  H5Sclose(space);
}

/* The datasets of an open file. */
static PetscErrorCode ConverterWrite_Private(Converter *c, const GmshNames *names)
{
  PetscFunctionBeginUser;
  PetscCall(GroupSetsCreate(c->mesh, c->dim, &c->sets, &c->set));
  ConverterWriteAttribute_Private(c, "mortise_mesh", HDF5_MESH_VERSION);
  ConverterWriteAttribute_Private(c, "dimension", (int)c->dim);
  ConverterWriteRows_Private(c, "points", H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, c->mesh->num_nodes, c->mesh->coords);
  for (PetscInt t = 1; t <= MAX_TYPE; t++) PetscCall(ConverterWriteType_Private(c, t));
  ConverterWriteRows_Private(c, "groups/start", HDF5_MESH_INTEGER, H5T_STD_I32LE, c->sets.num + 1, c->sets.start);
  ConverterWriteRows_Private(c, "groups/number", HDF5_MESH_INTEGER, H5T_STD_I32LE, c->sets.start[c->sets.num],
                             c->sets.number);
  PetscCall(ConverterWriteNames_Private(c, names));
  PetscCall(PetscFree(c->set));
  PetscCall(GroupSetsDestroy(&c->sets));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Writes by the driver of hdf5driver.h, since HDF5 crashes on a full disk. */
static PetscErrorCode ConverterWriteFile_Private(Converter *c, const GmshNames *names, const char to[], FileSet *files)
{
  HDF5Driver driver = {.file = -1};
  FILE      *out;
  hid_t      access;

  PetscFunctionBeginUser;
  PetscCall(FileSetOpen(files, to, &out));
  if (!out) PetscFunctionReturn(PETSC_SUCCESS);
  driver.file = fileno(out);
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL); // its lists of functions
  access  = HDF5DriverCreate(&driver);
  c->file = access < 0 ? -1 : H5Fcreate(to, H5F_ACC_TRUNC, H5P_DEFAULT, access);
  c->good = (PetscBool)(c->file >= 0);
  PetscCall(ConverterWrite_Private(c, names));
  if (c->file >= 0 && H5Fclose(c->file) < 0) c->good = PETSC_FALSE;
  if (access >= 0) H5Pclose(access);
  HDF5DriverDestroy(&driver);
  PetscCheck(c->good || driver.error, PETSC_COMM_SELF, PETSC_ERR_MEM, "No memory for %s", to);
  if (driver.error) PetscCall(FileSetFail(files, to, driver.error));
  PetscCall(FileSetClose(files, &out));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Highest dimension of the elements. */
static PetscInt MeshGetDimension_Private(const GmshMesh *mesh)
{
  PetscInt dim = 0;

  for (PetscInt e = 0; e < mesh->num_elements; e++) dim = PetscMax(dim, mesh->type[e]->dim);
  return dim;
}

static PetscErrorCode ConvertTell_Private(const GmshMesh *mesh, PetscInt dim, const GmshNames *names, const char to[])
{
  PetscInt cells = 0;

  PetscFunctionBeginUser;
  for (PetscInt e = 0; e < mesh->num_elements; e++) cells += mesh->type[e]->dim == dim;
  PetscCall(PetscPrintf(PETSC_COMM_SELF,
                        "%s: %" PetscInt_FMT " points, %" PetscInt_FMT " cells of dimension %" PetscInt_FMT
                        "; named physical groups:",
                        to, mesh->num_nodes, cells, dim));
  for (PetscInt i = 0; i < names->num; i++)
    PetscCall(PetscPrintf(PETSC_COMM_SELF, "%s %s", i ? "," : "", names->name[i]));
  PetscCall(PetscPrintf(PETSC_COMM_SELF, "%s\n", names->num ? "" : " none"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* [out] sentence - "" unless there is a mistake [SENTENCE] */
static void ConvertCheckNames_Private(const char from[], const char to[], char sentence[])
{
  const char *ending = strrchr(from, '.'), *other = strrchr(to, '.');

  if (!ending || strncmp(ending, ".msh", strlen(".msh")))
    snprintf(sentence, SENTENCE, "-convert %.400s: Gmsh files are converted, whose names end in .msh", from);
  else if (access(from, F_OK))
    snprintf(sentence, SENTENCE, "-convert %.400s: there is no such file", from);
  else if (!other || strcmp(other, ".h5"))
    snprintf(sentence, SENTENCE, "-convert %.400s %.400s: the name of the new file must end in .h5", from, to);
  else if (!access(to, F_OK))
    snprintf(sentence, SENTENCE, "-convert %.400s %.400s: the new file exists; remove it, or give another name", from,
             to);
}

/* Converts on the first rank. [out] sentence - "" unless there is a mistake [SENTENCE] */
static PetscErrorCode ConvertFile_Private(const char from[], const char to[], FileSet *files, char sentence[])
{
  char      reason[SENTENCE / 2] = "";
  GmshMesh  mesh                 = {0};
  GmshNames names                = {0, NULL, NULL, NULL};
  Converter c                    = {.mesh = &mesh};

  PetscFunctionBeginUser;
  PetscCall(GmshRead(from, &names, &mesh, reason, sizeof(reason)));
  c.dim = MeshGetDimension_Private(&mesh);
  if (!reason[0] && c.dim < 2) snprintf(reason, sizeof(reason), "it has no cells of two or three dimensions");
  if (!reason[0]) PetscCall(GmshCheck(&mesh, c.dim, reason, sizeof(reason)));
  if (reason[0])
    snprintf(sentence, SENTENCE, "-convert %.400s: %s", from, reason);
  else
    PetscCall(ConverterWriteFile_Private(&c, &names, to, files));
  if (!reason[0] && !files->failure[0]) PetscCall(ConvertTell_Private(&mesh, c.dim, &names, to));
  PetscCall(GmshMeshDestroy(&mesh));
  PetscCall(GmshNamesDestroy(&names));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshConvert(MPI_Comm comm, const char from[], const char to[])
{
  char        sentence[SENTENCE] = "";
  FileSet     files              = {0};
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (!rank) ConvertCheckNames_Private(from, to, sentence);
  PetscCall(UserErrorCheck(comm, sentence));
  PetscCall(FileSetCheck(comm, "-convert", to));
  if (!rank) PetscCall(ConvertFile_Private(from, to, &files, sentence));
  PetscCall(UserErrorCheck(comm, sentence));
  PetscCall(FileSetFinish(comm, &files));
  PetscFunctionReturn(PETSC_SUCCESS);
}

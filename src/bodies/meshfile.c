/* meshfile.c -- mesh files, read once each on the first rank: Gmsh's by gmsh.c, converted ones by hdf5mesh.c,
   others by DMPlexCreateFromFile().

   PETSc is silent meanwhile, so that an invalid file gives one sentence. Physical groups become values of the
   labels "Cell Sets" and "Face Sets". */
#include "base/compat.h"
#include "bodies/bodylist.h"
#include "bodies/gmshplex.h"
#include "bodies/meshfile.h"
#include "gmsh/hdf5mesh.h"
#include <string.h>

/* Stores the first line of PETSc's first message. */
static PetscErrorCode RecordErrorFn(MPI_Comm comm, int line, const char *function, const char *file,
                                    PetscErrorCode code, PetscErrorType type, const char *message, void *context)
{
  char *text = (char *)context; /* [MESH_SENTENCE] */

  (void)comm, (void)line, (void)function, (void)file;
  if (type == PETSC_ERROR_INITIAL && message && !text[0])
    snprintf(text, MESH_SENTENCE, "%.*s", (int)strcspn(message, "\n"), message);
  return code;
}

/* Reads by PETSc. */
static PetscErrorCode FileReadPlex_Private(const char path[], DM *dm, char reason[])
{
  PetscErrorCode code;

  PetscFunctionBeginUser;
  PetscCall(PetscPushErrorHandler(RecordErrorFn, reason));
  code = DMPlexCreateFromFile(PETSC_COMM_SELF, path, "", PETSC_TRUE, dm);
  PetscCall(PetscPopErrorHandler());
  if (code) *dm = NULL; // incomplete, and the run ends: it is not destroyed
  if (strstr(reason, "unrecognized extension"))
    snprintf(reason, MESH_SENTENCE,
             "files of this ending cannot be read; write it by Gmsh as .msh, version 2.2 or 4.1");
  if (code && !reason[0]) snprintf(reason, MESH_SENTENCE, "PETSc cannot read it (error %d)", (int)code);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether all cells are of supported types. [out] reason - untouched if so [MESH_SENTENCE] */
static PetscErrorCode FileCheckTypes_Private(DM dm, char reason[])
{
  PetscInt       begin, end;
  DMPolytopeType type;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetHeightStratum(dm, 0, &begin, &end));
  for (PetscInt c = begin; c < end; c++) {
    PetscCall(DMPlexGetCellType(dm, c, &type));
    if (type == DM_POLYTOPE_TRIANGLE || type == DM_POLYTOPE_QUADRILATERAL || type == DM_POLYTOPE_TETRAHEDRON ||
        type == DM_POLYTOPE_HEXAHEDRON)
      continue;
    snprintf(reason, MESH_SENTENCE,
             "it holds a cell that PETSc calls %s; triangles, quadrangles, tetrahedra and hexahedra are accepted",
             DMPolytopeTypes[type]);
    break;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the mesh has the scene's dimension, is of first order, and plane in a plane scene. */
static PetscErrorCode FileCheckPlex_Private(DM dm, PetscInt dim, char reason[])
{
  PetscInt           mesh_dim, space_dim, begin, end, size;
  const PetscScalar *x;
  PetscReal          lower[3], upper[3];
  Vec                coords;

  PetscFunctionBeginUser;
  PetscCall(DMGetDimension(dm, &mesh_dim));
  if (mesh_dim != dim) {
    GmshDescribeDimension(mesh_dim, dim, reason, MESH_SENTENCE);
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(DMPlexGetDepthStratum(dm, 0, &begin, &end));
  PetscCall(DMGetCoordinateDim(dm, &space_dim));
  PetscCall(DMGetCoordinatesLocal(dm, &coords));
  PetscCall(VecGetLocalSize(coords, &size));
  if (size != (end - begin) * space_dim) {
    snprintf(reason, MESH_SENTENCE,
             "it holds cells of higher order; of Gmsh's files alone those of second order are accepted");
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(VecGetArrayRead(coords, &x));
  for (PetscInt d = 0; d < space_dim; d++) {
    lower[d] = PETSC_MAX_REAL;
    upper[d] = -PETSC_MAX_REAL;
    for (PetscInt i = 0; i < end - begin; i++) {
      lower[d] = PetscMin(lower[d], PetscRealPart(x[i * space_dim + d]));
      upper[d] = PetscMax(upper[d], PetscRealPart(x[i * space_dim + d]));
    }
  }
  PetscCall(VecRestoreArrayRead(coords, &x));
  if (space_dim > dim) GmshCheckHeight(lower, upper, reason, MESH_SENTENCE);
  if (!reason[0]) PetscCall(FileCheckTypes_Private(dm, reason));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the file holds geometry, which is to be meshed first. [in] extension - with its point */
static PetscBool FileIsGeometry_Private(const char extension[])
{
  static const char *const endings[] = {".geo", ".step", ".stp", ".iges", ".igs", ".brep", ".stl"};
  PetscBool                same      = PETSC_FALSE;

  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(endings) && !same; i++)
    (void)PetscStrcasecmp(extension, endings[i], &same);
  return same;
}

/* Reads and checks. [out] reason - "" if the file can be used [MESH_SENTENCE] */
static PetscErrorCode FileRead_Private(MeshFile file, PetscInt dim, char reason[])
{
  const char *extension = strrchr(file->path, '.');
  PetscBool   converted = PETSC_FALSE;
  PetscInt    highest;
  GmshPart    whole;
  GmshMesh    mesh;

  PetscFunctionBeginUser;
  if (extension && !strcmp(extension, ".h5")) PetscCall(HDF5MeshProbe(file->path, &converted, &highest));
  if (converted) { // other HDF5 files may be PETSc's
    PetscCall(HDF5MeshReadPart(file->path, 0, 1, &file->names, &whole, reason, MESH_SENTENCE));
    if (!reason[0]) PetscCall(GmshPlexCreate(&whole.mesh, dim, &file->dm, &file->curves, reason));
    PetscCall(GmshMeshDestroy(&whole.mesh));
  } else if (extension && !strncmp(extension, ".msh", strlen(".msh"))) { // .msh2 and .msh4 are used as well
    PetscCall(GmshRead(file->path, &file->names, &mesh, reason, MESH_SENTENCE));
    if (!reason[0]) PetscCall(GmshPlexCreate(&mesh, dim, &file->dm, &file->curves, reason));
    PetscCall(GmshMeshDestroy(&mesh));
  } else if (extension && FileIsGeometry_Private(extension)) {
    snprintf(reason, MESH_SENTENCE,
             "it holds geometry and no mesh; name sides by physical groups and mesh it: gmsh -%d %.200s -o part.msh",
             (int)dim, file->path);
  } else {
    PetscCall(FileReadPlex_Private(file->path, &file->dm, reason));
    if (!reason[0]) PetscCall(FileCheckPlex_Private(file->dm, dim, reason));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Bodies of one file differ by their regions; the file is read for the first of them. */
PetscErrorCode MeshFileOpen(const SceneBody *body, PetscInt dim, MeshFile *files, MeshFile *file, char sentence[])
{
  char reason[MESH_SENTENCE] = "";

  PetscFunctionBeginUser;
  for (*file = *files; *file && strcmp((*file)->path, body->mesh_file); *file = (*file)->next) continue;
  if (!*file) {
    PetscCall(PetscNew(file));
    PetscCall(PetscStrallocpy(body->mesh_file, &(*file)->path));
    (*file)->next = *files;
    *files        = *file;
    PetscCall(FileRead_Private(*file, dim, reason));
  }
  if (reason[0])
    snprintf(sentence, MESH_SENTENCE, "-%s_dm_plex_filename %.400s: %.500s", body->name, body->mesh_file, reason);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshFileDestroy(MeshFile *files)
{
  PetscFunctionBeginUser;
  while (*files) {
    MeshFile file = *files;

    *files = file->next;
    PetscCall(PetscFree(file->path));
    PetscCall(DMDestroy(&file->dm));
    PetscCall(CurvesDestroy(&file->curves));
    PetscCall(GmshNamesDestroy(&file->names));
    PetscCall(PetscFree(file));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

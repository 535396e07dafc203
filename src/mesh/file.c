/* file.c -- mesh files, read once each by DMPlexCreateFromFile() on the first rank.

   PETSc is kept silent meanwhile, so that a broken file becomes one sentence. Gmsh's physical groups arrive as
   values of the labels "Cell Sets" and "Face Sets". */
#include "room.h"
#include "gmsh.h"
#include <mortise/compat.h>
#include <string.h>

/* A plane mesh may lie at any height, but not leave it by more than this share of its size. */
static const PetscReal PlaneShare = 1e-9;

struct _n_MeshFile {
  char     *path;
  DM        dm;    /* as read, before any refinement */
  GmshNames names; /* empty for other formats */
  MeshFile  next;
};

/* What PETSc would have printed: the first line of the first message. */
static PetscErrorCode RecordErrorFn(MPI_Comm comm, int line, const char *function, const char *file,
                                    PetscErrorCode code, PetscErrorType type, const char *message, void *context)
{
  char *text = (char *)context; /* [MESH_SENTENCE] */

  (void)comm, (void)line, (void)function, (void)file;
  if (type == PETSC_ERROR_INITIAL && message && !text[0])
    snprintf(text, MESH_SENTENCE, "%.*s", (int)strcspn(message, "\n"), message);
  return code;
}

/* Reads by PETSc. Periodic nodes stay apart (Mortise has no periodic bodies), heights are kept to be checked; several
   physical numbers of one facet exist in format 4.1 only, where 2.2 would show its geometrical numbers as well. */
static PetscErrorCode FileReadPlex_Private(const char path[], int version, DM *dm, char reason[])
{
  const char *const option[] = {"-dm_plex_gmsh_periodic", "-dm_plex_gmsh_spacedim", "-dm_plex_gmsh_multiple_tags"};
  const char *const value[]  = {"0", "3", version > 40 ? "1" : "0"};
  PetscErrorCode    code;

  PetscFunctionBeginUser;
  for (int i = 0; i < 3; ++i) PetscCall(PetscOptionsSetValue(NULL, option[i], value[i]));
  PetscCall(PetscPushErrorHandler(RecordErrorFn, reason));
  code = DMPlexCreateFromFile(PETSC_COMM_SELF, path, "", PETSC_TRUE, dm);
  PetscCall(PetscPopErrorHandler());
  if (code) *dm = NULL; // half made, and the run ends: nothing can be gained by taking it apart
  if (code && !reason[0]) snprintf(reason, MESH_SENTENCE, "PETSc cannot read it (error %d)", (int)code);
  for (int i = 0; i < 3; ++i) PetscCall(PetscOptionsClearValue(NULL, option[i]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the mesh is plane, of first order, made of triangles and quads. */
static PetscErrorCode FileCheckPlex_Private(DM dm, PetscInt dim, char reason[])
{
  PetscInt           mesh_dim, space_dim, begin, end, size;
  const PetscScalar *x;
  PetscReal          lower[3], upper[3];
  Vec                coords;

  PetscFunctionBeginUser;
  PetscCall(DMGetDimension(dm, &mesh_dim));
  if (mesh_dim != dim) {
    snprintf(reason, MESH_SENTENCE, "its cells have dimension %d, the scene has %d", (int)mesh_dim, (int)dim);
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(DMPlexGetDepthStratum(dm, 0, &begin, &end));
  PetscCall(DMGetCoordinateDim(dm, &space_dim));
  PetscCall(DMGetCoordinatesLocal(dm, &coords));
  PetscCall(VecGetLocalSize(coords, &size));
  if (size != (end - begin) * space_dim) {
    snprintf(reason, MESH_SENTENCE,
             "it holds cells of second order, which this version cannot use; meshes of first order are accepted");
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(VecGetArrayRead(coords, &x));
  for (PetscInt d = 0; d < space_dim; ++d) {
    lower[d] = PETSC_MAX_REAL;
    upper[d] = -PETSC_MAX_REAL;
    for (PetscInt i = 0; i < end - begin; ++i) {
      lower[d] = PetscMin(lower[d], PetscRealPart(x[i * space_dim + d]));
      upper[d] = PetscMax(upper[d], PetscRealPart(x[i * space_dim + d]));
    }
  }
  PetscCall(VecRestoreArrayRead(coords, &x));
  if (space_dim > dim && upper[2] - lower[2] > PlaneShare * PetscMax(upper[0] - lower[0], upper[1] - lower[1])) {
    snprintf(reason, MESH_SENTENCE, "its mesh is not parallel to the x,y plane: z runs from %g to %g", (double)lower[2],
             (double)upper[2]);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Checks and reads. [out] reason - "" if the file can be used [MESH_SENTENCE] */
static PetscErrorCode FileRead_Private(MeshFile file, PetscInt dim, char reason[])
{
  const char *extension = strrchr(file->path, '.');
  int         version   = 0;

  PetscFunctionBeginUser;
  if (extension && !strncmp(extension, ".msh", strlen(".msh"))) { // PETSc takes .msh2 and .msh4 for Gmsh as well
    PetscCall(GmshScan(file->path, &file->names, &version, reason, MESH_SENTENCE));
  }
  if (!reason[0]) PetscCall(FileReadPlex_Private(file->path, version, &file->dm, reason));
  if (!reason[0]) PetscCall(FileCheckPlex_Private(file->dm, dim, reason));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Bodies of one file are told apart by their regions; the file is read for the first of them. */
PetscErrorCode MeshFileOpen(const SceneBody *body, PetscInt dim, MeshFile *files, DM *dm, const GmshNames **names,
                            char sentence[])
{
  char     reason[MESH_SENTENCE] = "";
  MeshFile file;

  PetscFunctionBeginUser;
  for (file = *files; file && strcmp(file->path, body->mesh_file); file = file->next) continue;
  if (!file) {
    PetscCall(PetscNew(&file));
    PetscCall(PetscStrallocpy(body->mesh_file, &file->path));
    file->next = *files;
    *files     = file;
    PetscCall(FileRead_Private(file, dim, reason));
  }
  *dm    = file->dm;
  *names = &file->names;
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
    PetscCall(GmshNamesDestroy(&file->names));
    PetscCall(PetscFree(file));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

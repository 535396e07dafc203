/* output.c -- which files a run writes, and that they appear together. */
#include <string.h>
#include <mortise/output.h>
#include <mortise/fault.h>
#include <mortise/compat.h>
#include "picture.h"

/* Path of one file of the scene's output; pair may be NULL. */
static PetscErrorCode OutputPath_Private(Scene scene, const char pair[], const char suffix[],
                                         char path[PETSC_MAX_PATH_LEN])
{
  PetscFunctionBeginUser;
  PetscCall(
      PetscSNPrintf(path, PETSC_MAX_PATH_LEN, "%s%s%s%s", scene->output, pair ? "_" : "", pair ? pair : "", suffix));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OutputCheck(Scene scene)
{
  char path[PETSC_MAX_PATH_LEN];

  PetscFunctionBeginUser;
  if (scene->output) {
    const char *const files[] = {".json", scene->formats & OUTPUT_XDMF ? ".h5" : NULL,
                                 scene->formats & OUTPUT_XDMF ? ".xdmf" : NULL,
                                 scene->formats & OUTPUT_VTU ? ".vtu" : NULL, ".csv"};
    const size_t      num = sizeof(files) / sizeof(files[0]), len = strlen(scene->output);

    if (len == 0 || scene->output[len - 1] == '/') {
      PetscCall(FaultRaise(scene->comm, "-output \"%s\" names no file; give the beginning of a name, such as %sresult",
                           scene->output, scene->output));
    }
    for (PetscInt p = -1; p < scene->num_pairs; ++p) { /* the bodies have no table, a pair has no summary */
      for (size_t i = p < 0 ? 0 : 1; i < (p < 0 ? num - 1 : num); ++i) {
        if (!files[i]) continue;
        PetscCall(OutputPath_Private(scene, p < 0 ? NULL : scene->pairs[p].name, files[i], path));
        PetscCall(FilesCheck(scene->comm, "-output", path));
      }
    }
  }
  if (scene->summary && strcmp(scene->summary, "-") != 0) {
    PetscCall(FilesCheck(scene->comm, "-summary", scene->summary));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A picture, of a pair or (NULL) of the bodies, in the formats the scene wants. First rank only. */
static PetscErrorCode WritePicture_Private(Scene scene, const char pair[], const Picture *picture, Files *files)
{
  char path[PETSC_MAX_PATH_LEN], hdf5[PETSC_MAX_PATH_LEN];

  PetscFunctionBeginUser;
  if (scene->formats & OUTPUT_XDMF) {
    PetscCall(OutputPath_Private(scene, pair, ".h5", hdf5));
    PetscCall(OutputPath_Private(scene, pair, ".xdmf", path));
    PetscCall(PictureWriteHDF5(picture, files, hdf5));
    PetscCall(PictureWriteXDMF(picture, files, path, hdf5));
  }
  if (scene->formats & OUTPUT_VTU) {
    PetscCall(OutputPath_Private(scene, pair, ".vtu", path));
    PetscCall(PictureWriteVTU(picture, files, path));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OutputWrite(Fields fields)
{
  const VI    vi = fields->vi;
  Picture     picture;
  Files       files = {0};
  char        path[PETSC_MAX_PATH_LEN];
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(vi->level->comm, &rank));
  PetscCall(PictureCreate(fields, &picture));
  if (rank == 0) PetscCall(WritePicture_Private(vi->scene, NULL, &picture, &files));
  PetscCall(PictureDestroy(&picture));
  for (PetscInt p = 0; p < vi->num_pairs; ++p) {
    const char *name = vi->pairs[p]->spec->name;

    PetscCall(OutputPath_Private(vi->scene, name, ".csv", path));
    PetscCall(PairWriteCSV(fields, p, &files, path));
    PetscCall(PictureCreateSurface(fields, p, &picture));
    if (rank == 0) PetscCall(WritePicture_Private(vi->scene, name, &picture, &files));
    PetscCall(PictureDestroy(&picture));
  }
  PetscCall(FilesFinish(vi->level->comm, &files));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OutputWriteMotion(VI vi)
{
  Picture     picture;
  Files       files = {0};
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(vi->level->comm, &rank));
  PetscCall(PictureCreateMotion(vi, &picture));
  if (rank == 0) PetscCall(WritePicture_Private(vi->scene, NULL, &picture, &files));
  PetscCall(PictureDestroy(&picture));
  PetscCall(FilesFinish(vi->level->comm, &files));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OutputWriteText(MPI_Comm comm, const char path[], const char text[])
{
  Files       files = {0};
  FILE       *out;
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (rank == 0) {
    PetscCall(FilesOpen(&files, path, &out));
    if (out) fprintf(out, "%s\n", text);
    PetscCall(FilesClose(&files, &out));
  }
  PetscCall(FilesFinish(comm, &files));
  PetscFunctionReturn(PETSC_SUCCESS);
}

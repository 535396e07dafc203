/* output.c -- which files a run writes, and that they appear together. */
#include <string.h>
#include <mortise/output.h>
#include <mortise/fault.h>
#include <mortise/compat.h>
#include "picture.h"

struct _n_Output {
  MPI_Comm    comm;
  PetscMPIInt rank;
  Files       files; /* of the first rank */
};

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
  PetscCall(OutputPath_Private(scene, pair, ".h5", hdf5));
  PetscCall(OutputPath_Private(scene, pair, ".xdmf", path));
  if (scene->formats & OUTPUT_XDMF) {
    PetscCall(PictureWriteHDF5(picture, files, hdf5));
    PetscCall(PictureWriteXDMF(picture, files, path, hdf5));
  } else {
    PetscCall(FilesRemove(files, hdf5));
    PetscCall(FilesRemove(files, path));
  }
  PetscCall(OutputPath_Private(scene, pair, ".vtu", path));
  if (scene->formats & OUTPUT_VTU) {
    PetscCall(PictureWriteVTU(picture, files, path));
  } else {
    PetscCall(FilesRemove(files, path));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OutputCreate(MPI_Comm comm, Output *output)
{
  PetscFunctionBeginUser;
  PetscCall(PetscNew(output));
  (*output)->comm = comm;
  PetscCallMPI(MPI_Comm_rank(comm, &(*output)->rank));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OutputAddFields(Output output, Fields fields)
{
  const VI vi = fields->vi;
  Picture  picture;
  char     path[PETSC_MAX_PATH_LEN];

  PetscFunctionBeginUser;
  PetscCall(PictureCreate(fields, &picture));
  if (output->rank == 0) PetscCall(WritePicture_Private(vi->scene, NULL, &picture, &output->files));
  PetscCall(PictureDestroy(&picture));
  for (PetscInt p = 0; p < vi->num_pairs; ++p) {
    const char *name = vi->pairs[p]->spec->name;

    PetscCall(OutputPath_Private(vi->scene, name, ".csv", path));
    PetscCall(PairWriteCSV(fields, p, &output->files, path));
    PetscCall(PictureCreateSurface(fields, p, &picture));
    if (output->rank == 0) PetscCall(WritePicture_Private(vi->scene, name, &picture, &output->files));
    PetscCall(PictureDestroy(&picture));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* All files of fields that an earlier run of the scene may have left. */
static PetscErrorCode RemoveFields_Private(Output output, Scene scene)
{
  const char *const suffixes[] = {".csv", ".h5", ".xdmf", ".vtu"}; // the bodies have no table
  char              path[PETSC_MAX_PATH_LEN];

  PetscFunctionBeginUser;
  if (output->rank) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt p = -1; p < scene->num_pairs; ++p) {
    for (size_t i = p < 0; i < PETSC_STATIC_ARRAY_LENGTH(suffixes); ++i) {
      PetscCall(OutputPath_Private(scene, p < 0 ? NULL : scene->pairs[p].name, suffixes[i], path));
      PetscCall(FilesRemove(&output->files, path));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OutputAddMotion(Output output, VI vi)
{
  Picture picture;

  PetscFunctionBeginUser;
  PetscCall(RemoveFields_Private(output, vi->scene));
  PetscCall(PictureCreateMotion(vi, &picture));
  if (output->rank == 0) PetscCall(WritePicture_Private(vi->scene, NULL, &picture, &output->files));
  PetscCall(PictureDestroy(&picture));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OutputAddText(Output output, const char path[], const char text[])
{
  FILE *out;

  PetscFunctionBeginUser;
  if (output->rank) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(FilesOpen(&output->files, path, &out));
  if (out) fprintf(out, "%s\n", text);
  PetscCall(FilesClose(&output->files, &out));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OutputFinish(Output *output)
{
  PetscFunctionBeginUser;
  PetscCall(FilesFinish((*output)->comm, &(*output)->files));
  PetscCall(PetscFree(*output));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OutputPrintNames(Scene scene, PetscBool pairs)
{
  PetscFunctionBeginUser;
  for (PetscInt p = -1; p < (pairs ? scene->num_pairs : 0); ++p) { // -1: the bodies
    if (p >= 0) PetscCall(PetscPrintf(scene->comm, ", _%s.csv", scene->pairs[p].name));
    if (scene->formats & OUTPUT_XDMF) PetscCall(PetscPrintf(scene->comm, ", .h5, .xdmf"));
    if (scene->formats & OUTPUT_VTU) PetscCall(PetscPrintf(scene->comm, ", .vtu"));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OutputWriteText(MPI_Comm comm, const char path[], const char text[])
{
  Output output;

  PetscFunctionBeginUser;
  PetscCall(OutputCreate(comm, &output));
  PetscCall(OutputAddText(output, path, text));
  PetscCall(OutputFinish(&output));
  PetscFunctionReturn(PETSC_SUCCESS);
}

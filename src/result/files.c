/* files.c -- temporary names, renaming, and missing folders. */
#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include "files.h"
#include <mortise/fault.h>
#include <mortise/compat.h>

enum { FOLDER_MODE = 0777 }; /* what the user's umask leaves of it */

/* Makes the folders above path that are missing. Returns 0 or errno; *first_made = length of the path of the topmost folder
   made, 0 if there was none. */
static int FoldersCreate_Private(const char path[], size_t *first_made)
{
  char folder[PETSC_MAX_PATH_LEN];

  *first_made = 0;
  if (strlen(path) >= sizeof(folder)) return ENAMETOOLONG;
  strcpy(folder, path);
  for (char *slash = strchr(folder + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
    *slash = '\0';
    if (mkdir(folder, FOLDER_MODE) == 0) {
      if (!*first_made) *first_made = strlen(folder);
    } else if (errno != EEXIST) {
      return errno;
    }
    *slash = '/';
  }
  return 0;
}

/* Removes the folders that FoldersCreate_Private() made for path, as long as they are empty. */
static void FoldersRemove_Private(const char path[], size_t first_made)
{
  char folder[PETSC_MAX_PATH_LEN];

  if (!first_made) return;
  strcpy(folder, path);
  for (char *slash = strrchr(folder, '/'); slash && (size_t)(slash - folder) >= first_made;
       slash       = strrchr(folder, '/')) {
    *slash = '\0';
    if (rmdir(folder)) return;
  }
}

/* The name a file has while it is written: beside the final one, so that renaming never crosses a file system. */
static PetscErrorCode TemporaryName_Private(const char final[], char **name)
{
  const size_t len = strlen(final) + 32;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(len, name));
  PetscCall(PetscSNPrintf(*name, len, "%s.part%ld", final, (long)getpid()));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FilesFail(Files *files, const char path[], int error)
{
  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < files->num; ++i) {
    if (strcmp(path, files->temporary[i]) == 0) path = files->final[i];
  }
  if (!files->failure[0]) {
    PetscCall(PetscSNPrintf(files->failure, sizeof(files->failure), "cannot write %s: %s", path, strerror(error)));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FilesAdd(Files *files, const char final[], const char **temporary)
{
  size_t made;
  int    error;

  PetscFunctionBeginUser;
  *temporary = NULL;
  if (files->failure[0]) PetscFunctionReturn(PETSC_SUCCESS);
  error = FoldersCreate_Private(final, &made);
  if (error) {
    PetscCall(FilesFail(files, final, error));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  if (files->num == files->capacity) {
    files->capacity = 2 * files->capacity + 4;
    PetscCall(PetscRealloc(files->capacity * sizeof(char *), &files->final));
    PetscCall(PetscRealloc(files->capacity * sizeof(char *), &files->temporary));
    PetscCall(PetscRealloc(files->capacity * sizeof(size_t), &files->made));
  }
  PetscCall(PetscStrallocpy(final, &files->final[files->num]));
  PetscCall(TemporaryName_Private(final, &files->temporary[files->num]));
  files->made[files->num] = made;
  *temporary              = files->temporary[files->num++];
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FilesOpen(Files *files, const char final[], FILE **file)
{
  const char *temporary;

  PetscFunctionBeginUser;
  *file = NULL;
  PetscCall(FilesAdd(files, final, &temporary));
  if (!temporary) PetscFunctionReturn(PETSC_SUCCESS);
  *file = fopen(temporary, "wb");
  if (!*file) PetscCall(FilesFail(files, temporary, errno));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FilesClose(Files *files, FILE **file)
{
  PetscFunctionBeginUser;
  if (*file) {
    const PetscBool bad = (PetscBool)(ferror(*file) || fflush(*file));

    if (bad) PetscCall(FilesFail(files, files->temporary[files->num - 1], errno));
    if (fclose(*file)) PetscCall(FilesFail(files, files->temporary[files->num - 1], errno));
    *file = NULL;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FilesFinish(MPI_Comm comm, Files *files)
{
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < files->num && !files->failure[0]; ++i) {
    if (rename(files->temporary[i], files->final[i])) PetscCall(FilesFail(files, files->temporary[i], errno));
  }
  for (PetscInt i = 0; i < files->num; ++i) {
    if (files->failure[0]) unlink(files->temporary[i]);
  }
  for (PetscInt i = 0; i < files->num; ++i) {
    if (files->failure[0]) FoldersRemove_Private(files->final[i], files->made[i]);
    PetscCall(PetscFree(files->final[i]));
    PetscCall(PetscFree(files->temporary[i]));
  }
  PetscCall(PetscFree(files->final));
  PetscCall(PetscFree(files->temporary));
  PetscCall(PetscFree(files->made));
  files->num = files->capacity = 0;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCallMPI(MPI_Bcast(files->failure, sizeof(files->failure), MPI_CHAR, 0, comm));
  PetscCheck(!files->failure[0], comm, PETSC_ERR_FILE_WRITE, "%s", files->failure);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Tries to make a file beside path; returns 0 or errno, and leaves nothing behind. */
static int TryWrite_Private(const char path[], const char temporary[])
{
  struct stat info;
  size_t      made;
  int         error;
  FILE       *file;

  if (stat(path, &info) == 0 && S_ISDIR(info.st_mode)) return EISDIR;
  error = FoldersCreate_Private(path, &made);
  if (!error) {
    file = fopen(temporary, "wb");
    if (file) {
      fclose(file);
      unlink(temporary);
    } else {
      error = errno;
    }
  }
  FoldersRemove_Private(path, made);
  return error;
}

PetscErrorCode FilesCheck(MPI_Comm comm, const char option[], const char path[])
{
  char        sentence[FILES_SENTENCE] = "", *temporary;
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (rank == 0) {
    int error;

    PetscCall(TemporaryName_Private(path, &temporary));
    error = TryWrite_Private(path, temporary);
    if (error) {
      PetscCall(PetscSNPrintf(sentence, sizeof(sentence),
                              "%s: cannot write %s (%s); name a place that can be written to", option, path,
                              strerror(error)));
    }
    PetscCall(PetscFree(temporary));
  }
  PetscCall(FaultCheck(comm, sentence));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* fileset.c -- temporary names, renaming, and creation of folders. */
#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include "output/fileset.h"
#include "base/usererror.h"
#include "base/interrupt.h"
#include "base/compat.h"

enum { FOLDER_MODE = 0777 }; /* less the user's umask */

static const char PART[] = ".part"; /* in the name of a temporary file, before the number of the process */

static FileSet *unfinished; /* those that are being written, the latest first */

/* Removes all temporary files. Signal handlers may call it: signals wait while lists change. */
static void FileSetCleanUpFn(void)
{
  for (const FileSet *files = unfinished; files; files = files->next) {
    for (PetscInt i = 0; i < files->num; i++) {
      if (files->temporary[i]) (void)unlink(files->temporary[i]);
    }
  }
}

/* To the list of unfinished ones, or off it. Signals wait. */
static void FileSetBegin_Private(FileSet *files)
{
  if (files->capacity) return;
  files->next = unfinished;
  unfinished  = files;
  InterruptSetCleanUp(FileSetCleanUpFn);
}

static void FileSetEnd_Private(FileSet *files)
{
  for (FileSet **place = &unfinished; *place; place = &(*place)->next) {
    if (*place != files) continue;
    *place = files->next;
    return;
  }
}

/* Makes the folders above path that are missing. Returns 0 or errno; *first_made = length of the path of the
   topmost folder made, 0 if there was none. */
static int FileSetCreateFolders_Private(const char path[], size_t *first_made)
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

/* Removes the folders that FileSetCreateFolders_Private() made for path, as long as they are empty. */
static void FileSetRemoveFolders_Private(const char path[], size_t first_made)
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

/* The name a file has while it is written: beside the final one, so that renaming never crosses a file
   system. */
static PetscErrorCode FileSetGetTemporaryName_Private(const char final[], char **name)
{
  const size_t len = strlen(final) + 32;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(len, name));
  PetscCall(PetscSNPrintf(*name, len, "%s%s%ld", final, PART, (long)getpid()));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a process runs. A killed process keeps its number until its parent reads its exit code; its state
   is 'Z' until then. */
static PetscBool FileSetProcessExists_Private(long process)
{
  char        path[64], text[PETSC_MAX_PATH_LEN] = "";
  const char *state;
  FILE       *file;

  snprintf(path, sizeof(path), "/proc/%ld/stat", process);
  file = fopen(path, "r");
  if (file) {
    text[fread(text, 1, sizeof(text) - 1, file)] = '\0';
    (void)fclose(file);
  }
  state = strrchr(text, ')'); // the name before it may contain anything
  if (state && strncmp(state, ") Z", 3) == 0) return PETSC_FALSE;
  return (PetscBool)(!kill((pid_t)process, 0) || errno != ESRCH);
}

/* Whether a name is that of a temporary file of `base` whose process is no more. */
static PetscBool FileSetIsLeftover_Private(const char name[], const char base[])
{
  const size_t len = strlen(base);
  char        *end;
  long         process;

  if (strncmp(name, base, len) || strncmp(name + len, PART, sizeof(PART) - 1)) return PETSC_FALSE;
  name += len + sizeof(PART) - 1;
  if (!isdigit((unsigned char)*name)) return PETSC_FALSE;
  process = strtol(name, &end, 10);
  return (PetscBool)(!*end && process > 0 && !FileSetProcessExists_Private(process));
}

/* Removes what killed processes have left of a file. */
static void FileSetRemoveLeftovers_Private(const char final[])
{
  char  path[PETSC_MAX_PATH_LEN + NAME_MAX + 2];
  char *slash;
  DIR  *folder;

  snprintf(path, sizeof(path), "%.*s", PETSC_MAX_PATH_LEN, final);
  slash = strrchr(path, '/');
  if (slash) slash[slash == path] = '\0';
  folder = opendir(slash ? path : ".");
  if (!folder) return;
  for (const struct dirent *entry = readdir(folder); entry; entry = readdir(folder)) {
    const char *base = strrchr(final, '/');

    if (!FileSetIsLeftover_Private(entry->d_name, base ? base + 1 : final)) continue;
    snprintf(path, sizeof(path), "%.*s%s", base ? (int)(base + 1 - final) : 0, final, entry->d_name);
    (void)unlink(path);
  }
  (void)closedir(folder);
}

PetscErrorCode FileSetFail(FileSet *files, const char path[], int error)
{
  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < files->num; i++) {
    if (files->temporary[i] && strcmp(path, files->temporary[i]) == 0) path = files->final[i];
  }
  if (!files->failure[0]) {
    PetscCall(PetscSNPrintf(files->failure, sizeof(files->failure), "cannot write %s: %s", path, strerror(error)));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Appends a file, which has no temporary name yet. Signals wait. */
static PetscErrorCode FileSetAppend_Private(FileSet *files, const char final[], size_t made)
{
  PetscFunctionBeginUser;
  FileSetBegin_Private(files);
  if (files->num == files->capacity) {
    files->capacity = 2 * files->capacity + 4;
    PetscCall(PetscRealloc(files->capacity * sizeof(char *), &files->final));
    PetscCall(PetscRealloc(files->capacity * sizeof(char *), &files->temporary));
    PetscCall(PetscRealloc(files->capacity * sizeof(size_t), &files->made));
  }
  PetscCall(PetscStrallocpy(final, &files->final[files->num]));
  files->temporary[files->num] = NULL;
  files->made[files->num++]    = made;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Path of a temporary file that will become `final`; makes missing folders. NULL, with files->failure set, if
   it cannot. From now on and until FileSetFinish() files stays where it is. */
static PetscErrorCode FileSetAdd_Private(FileSet *files, const char final[], const char **temporary)
{
  size_t made;
  int    error;

  PetscFunctionBeginUser;
  *temporary = NULL;
  if (files->failure[0]) PetscFunctionReturn(PETSC_SUCCESS);
  error = FileSetCreateFolders_Private(final, &made);
  if (error) {
    PetscCall(FileSetFail(files, final, error));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  FileSetRemoveLeftovers_Private(final);
  InterruptHold();
  PetscCall(FileSetAppend_Private(files, final, made));
  PetscCall(FileSetGetTemporaryName_Private(final, &files->temporary[files->num - 1]));
  InterruptRelease();
  *temporary = files->temporary[files->num - 1];
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FileSetRemove(FileSet *files, const char final[])
{
  PetscFunctionBeginUser;
  InterruptHold();
  PetscCall(FileSetAppend_Private(files, final, 0));
  InterruptRelease();
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FileSetOpen(FileSet *files, const char final[], FILE **file)
{
  const char *temporary;

  PetscFunctionBeginUser;
  *file = NULL;
  PetscCall(FileSetAdd_Private(files, final, &temporary));
  if (!temporary) PetscFunctionReturn(PETSC_SUCCESS);
  *file = fopen(temporary, "wb");
  if (!*file) PetscCall(FileSetFail(files, temporary, errno));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FileSetClose(FileSet *files, FILE **file)
{
  PetscFunctionBeginUser;
  if (*file) {
    const PetscBool bad = (PetscBool)(ferror(*file) || fflush(*file));

    if (bad) PetscCall(FileSetFail(files, files->temporary[files->num - 1], errno));
    if (fclose(*file)) PetscCall(FileSetFail(files, files->temporary[files->num - 1], errno));
    *file = NULL;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Removes a file, if there is one. Folders cannot be removed, and so not be replaced. */
static PetscErrorCode FileSetRemoveFile_Private(FileSet *files, const char path[])
{
  PetscFunctionBeginUser;
  if (unlink(path) && errno != ENOENT) PetscCall(FileSetFail(files, path, errno));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a name is, or links to, a device, a pipe, a socket, or a stream of a process. Renaming a file would
   replace it, even /dev/null of the whole machine. */
static PetscBool FileSetIsSpecialFile_Private(const char path[])
{
  static const char streams[] = "/proc/";
  struct stat       info;
  char              target[sizeof(streams)] = "";

  if (readlink(path, target, sizeof(target) - 1) > 0 && !strcmp(target, streams)) return PETSC_TRUE;
  return stat(path, &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode) ? PETSC_TRUE : PETSC_FALSE;
}

/* Whether a file that is to be removed is also written. The new one then replaces it: it is never missing. */
static PetscBool FileSetIsReplaced_Private(const FileSet *files, PetscInt removed)
{
  PetscBool replaced = PETSC_FALSE;

  for (PetscInt i = 0; i < files->num && !replaced; i++)
    replaced = (PetscBool)(files->temporary[i] && !strcmp(files->final[i], files->final[removed]));
  return replaced;
}

/* Gives all files their names, the mark last. */
static PetscErrorCode FileSetRename_Private(FileSet *files)
{
  struct stat info;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < files->num; i++) {
    if (!files->temporary[i]) continue;
    if (stat(files->final[i], &info) == 0 && S_ISDIR(info.st_mode))
      PetscCall(FileSetFail(files, files->final[i], EISDIR));
    if (FileSetIsSpecialFile_Private(files->final[i])) PetscCall(FileSetFail(files, files->final[i], EEXIST));
    if (access(files->temporary[i], F_OK)) PetscCall(FileSetFail(files, files->temporary[i], errno));
  }
  if (files->num > 1 && !files->failure[0]) PetscCall(FileSetRemoveFile_Private(files, files->final[files->num - 1]));
  for (FileSetChange *change = files->changes; change && !files->failure[0]; change = change->next) {
    const int error = (*change->commit)(change->ctx);

    if (error) PetscCall(FileSetFail(files, change->path, error));
  }
  for (PetscInt i = 0; i < files->num && !files->failure[0]; i++) {
    if (!files->temporary[i]) {
      if (FileSetIsReplaced_Private(files, i)) continue;
      if (stat(files->final[i], &info) || S_ISREG(info.st_mode)) // a folder of that name is no file of an earlier run
        PetscCall(FileSetRemoveFile_Private(files, files->final[i]));
    } else if (rename(files->temporary[i], files->final[i]))
      PetscCall(FileSetFail(files, files->temporary[i], errno));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FileSetChangeInPlace(FileSet *files, const char path[], int (*commit)(void *), void (*forget)(void *),
                                    void *ctx)
{
  FileSetChange *change;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&change));
  *change = (FileSetChange){.next = files->changes, .commit = commit, .forget = forget, .ctx = ctx};
  PetscCall(PetscStrallocpy(path, &change->path));
  files->changes = change;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Calls forget() of all changes, committed or not. */
static PetscErrorCode FileSetForgetChanges_Private(FileSet *files)
{
  PetscFunctionBeginUser;
  while (files->changes) {
    FileSetChange *change = files->changes;

    files->changes = change->next;
    (*change->forget)(change->ctx);
    PetscCall(PetscFree(change->path));
    PetscCall(PetscFree(change));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FileSetFinish(MPI_Comm comm, FileSet *files)
{
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  InterruptHold();
  if (!files->failure[0]) PetscCall(FileSetRename_Private(files));
  FileSetEnd_Private(files);
  PetscCall(FileSetForgetChanges_Private(files));
  for (PetscInt i = 0; i < files->num; i++) {
    if (files->failure[0] && files->temporary[i]) unlink(files->temporary[i]);
  }
  for (PetscInt i = 0; i < files->num; i++) {
    if (files->failure[0]) FileSetRemoveFolders_Private(files->final[i], files->made[i]);
    PetscCall(PetscFree(files->final[i]));
    PetscCall(PetscFree(files->temporary[i]));
  }
  PetscCall(PetscFree(files->final));
  PetscCall(PetscFree(files->temporary));
  PetscCall(PetscFree(files->made));
  files->num = files->capacity = 0;
  InterruptRelease();
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCallMPI(MPI_Bcast(files->failure, sizeof(files->failure), MPI_CHAR, 0, comm));
  PetscCheck(!files->failure[0], comm, PETSC_ERR_FILE_WRITE, "%s", files->failure);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Tries to create a file beside path, and removes it; returns 0 or errno. */
static int FileSetTryWrite_Private(const char path[], const char temporary[])
{
  struct stat info;
  size_t      made;
  int         error;
  FILE       *file;

  if (stat(path, &info) == 0 && S_ISDIR(info.st_mode)) return EISDIR;
  if (access(path, W_OK) && errno != ENOENT && errno != ENOTDIR) return errno; // a protected file is not replaced
  error = FileSetCreateFolders_Private(path, &made);
  if (!error) {
    file = fopen(temporary, "wb");
    if (file) {
      fclose(file);
      unlink(temporary);
    } else {
      error = errno;
    }
  }
  FileSetRemoveFolders_Private(path, made);
  return error;
}

PetscErrorCode FileSetCheck(MPI_Comm comm, const char option[], const char path[])
{
  char        sentence[FILE_SET_SENTENCE] = "", *temporary;
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (rank == 0) {
    int error;

    PetscCall(FileSetGetTemporaryName_Private(path, &temporary));
    InterruptHold(); // a signal must not leave the file of the attempt
    error = FileSetTryWrite_Private(path, temporary);
    InterruptRelease();
    if (!error && FileSetIsSpecialFile_Private(path)) {
      PetscCall(PetscSNPrintf(sentence, sizeof(sentence),
                              "%s: %s is a device, a pipe or a stream and cannot be replaced; name a file%s", option,
                              path, strcmp(option, "-summary") ? "" : ", or - to print the summary"));
    }
    if (error) {
      PetscCall(PetscSNPrintf(sentence, sizeof(sentence),
                              "%s: cannot write %s (%s); name a place that can be written to", option, path,
                              strerror(error)));
    }
    PetscCall(PetscFree(temporary));
  }
  PetscCall(UserErrorCheck(comm, sentence));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* fileset.h -- files that appear together under their final names, or not at all.

   Everything is written to temporary names in the same folders by the first rank, then renamed. The file that
   was added last is the mark of completeness. Its predecessor is removed before any other file is renamed,
   and it is renamed last. So such a mark never stands beside files of different runs, however the program
   ends. Temporary files are removed when a signal or a failure ends the program (interrupt.h). After kill -9
   the next run that writes the same file removes them. Calls other than FileSetFinish() and FileSetCheck()
   are not collective and belong to the first rank. */
#ifndef MORTISE_FILESET_H
#define MORTISE_FILESET_H

#include <stdio.h>
#include <petscsys.h>

enum { FILE_SET_SENTENCE = PETSC_MAX_PATH_LEN + 256 };

/* A change of a file in its place. */
typedef struct FileSetChange {
  struct FileSetChange *next;
  int (*commit)(void *ctx); /* returns 0 or errno */
  void (*forget)(void *ctx);
  void *ctx;
  char *path;
} FileSetChange;

typedef struct FileSet {
  PetscInt        num, capacity;
  char          **final;                      /* [num] */
  char          **temporary;                  /* NULL where the file is to be removed [num] */
  size_t         *made;                       /* length of the topmost folder that was made for it, 0 for none [num] */
  char            failure[FILE_SET_SENTENCE]; /* the first failure, as a sentence; "" without one */
  FileSetChange  *changes;                    /* of files that stay */
  struct FileSet *next;                       /* of all that are being written */
} FileSet;

/* Will remove `final`, which an earlier run may have written, when the others appear. */
PetscErrorCode FileSetRemove(FileSet *files, const char final[]);
/* Will change a file in its place when the others appear: commit(ctx) is called then, unless something
   failed, and forget(ctx) in any case. */
PetscErrorCode FileSetChangeInPlace(FileSet *files, const char path[], int (*commit)(void *), void (*forget)(void *),
                                    void *ctx);
/* Notes that path cannot be written and why (errno), unless something failed before. path may be a temporary
   name. */
PetscErrorCode FileSetFail(FileSet *files, const char path[], int error);
/* Opens a temporary for text and closes it; a full disk is noticed at the latest when it is closed. NULL
   after a failure. */
PetscErrorCode FileSetOpen(FileSet *files, const char final[], FILE **file);
PetscErrorCode FileSetClose(FileSet *files, FILE **file);
/* Renames all, or removes all after a failure, which becomes an error on all ranks. Collective; frees the
   lists. */
PetscErrorCode FileSetFinish(MPI_Comm comm, FileSet *files);

/* User error, with the option: path cannot be written. Tries to write, and removes the file again.
   Collective. */
PetscErrorCode FileSetCheck(MPI_Comm comm, const char option[], const char path[]);

#endif

/* dimensionprobe.c -- how many dimensions the cells of a mesh file have, before anything else is asked of it.

   A scene needs to know before its data are read, the file itself is read with the mesh. So elements are gone through by
   their heads alone, up to the first solid, and what cannot be understood is left to the mesh's own reader, which tells
   why. Formats as in the Gmsh reference manual, chapter "Gmsh file formats". */
#include "scene/sceneparts.h"
#include "gmsh/gmshtype.h"
#include "base/options.h"
#include <limits.h>
#include <stdio.h>
#include <string.h>

enum { LINE = 1024 }; /* longer than any line of a Gmsh file */

typedef struct {
  FILE *file;
  int   recent, binary; /* format 4.1, or 2.2 */
} Peek;

static PetscBool PeekLine_Private(Peek *peek, char line[])
{
  return fgets(line, LINE, peek->file) ? PETSC_TRUE : PETSC_FALSE;
}

/* Goes to the line behind "$Elements", past all that is in between, text or not. */
static PetscBool PeekBegin_Private(Peek *peek)
{
  char  line[LINE];
  float version = 0;

  if (!PeekLine_Private(peek, line) || strncmp(line, "$MeshFormat", strlen("$MeshFormat"))) return PETSC_FALSE;
  if (!PeekLine_Private(peek, line) || sscanf(line, "%f %d", &version, &peek->binary) != 2) return PETSC_FALSE;
  peek->recent = version > 4;
  while (PeekLine_Private(peek, line)) {
    if (!strncmp(line, "$Elements", strlen("$Elements"))) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* Goes past the elements of a block whose head says how many there are and what they are; NULL if they are none that are used
   here. */
static PetscBool PeekSkip_Private(Peek *peek, const GmshType *type, long long num, int num_tags)
{
  char      line[LINE];
  long long bytes;

  if (num < 0 || num > INT_MAX || num_tags < 0 || num_tags > LINE) return PETSC_FALSE;
  if (peek->binary) {
    if (!type) return PETSC_FALSE;
    bytes = peek->recent ? (long long)sizeof(size_t) * (1 + type->num_nodes)
                         : (long long)sizeof(int) * (1 + num_tags + type->num_nodes);
    return fseek(peek->file, (long)(num * bytes), SEEK_CUR) ? PETSC_FALSE : PETSC_TRUE;
  }
  while (num > 0 && PeekLine_Private(peek, line)) --num;
  return num ? PETSC_FALSE : PETSC_TRUE;
}

/* The dimension of the next block of elements, or in text of format 2.2 of the next element, which format 4.1 tells of any
   type; 0 where that is not known. Whether there may be more. */
static PetscBool PeekNext_Private(Peek *peek, PetscInt *dim)
{
  const GmshType *type;
  char            line[LINE];
  int       head[3] = {0, 0, 0}, num_tags = 0, number = 0; // a head: dimension, entity, type; or type, elements, tags
  int       entity = 0;
  size_t    size   = 0;
  long long num    = 0;

  *dim = 0;
  if (peek->binary) {
    if (fread(head, sizeof(head), 1, peek->file) != 1) return PETSC_FALSE;
    if (peek->recent && fread(&size, sizeof(size), 1, peek->file) != 1) return PETSC_FALSE;
    entity   = peek->recent ? head[0] : 0;
    number   = peek->recent ? head[2] : head[0];
    num      = peek->recent ? (long long)size : head[1];
    num_tags = peek->recent ? 0 : head[2];
  } else if (!PeekLine_Private(peek, line) || (peek->recent ? sscanf(line, "%d %*d %d %lld", &entity, &number, &num) < 2
                                                            : sscanf(line, "%*d %d", &number) < 1)) {
    return PETSC_FALSE;
  }
  type = GmshTypeGet(number);
  *dim = type ? type->dim : entity;
  return PeekSkip_Private(peek, type, num, num_tags);
}

/* The highest dimension of its elements, 0 where there are none that can be read. */
static PetscInt PeekFile_Private(const char path[])
{
  Peek     peek = {.file = fopen(path, "rb")};
  PetscInt dim  = 0;
  char     line[LINE];
  size_t   counts[4];

  if (!peek.file) return 0;
  if (PeekBegin_Private(&peek) &&
      (peek.recent && peek.binary ? fread(counts, sizeof(counts), 1, peek.file) == 1 : PeekLine_Private(&peek, line))) {
    PetscBool more = PETSC_TRUE;

    while (dim < 3 && more) {
      PetscInt next;

      more = PeekNext_Private(&peek, &next);
      dim  = PetscMax(dim, PetscMin(next, 3));
    }
  }
  fclose(peek.file);
  return dim;
}

PetscErrorCode PeekDimension(const Option *file, PetscInt *dim)
{
  const char *extension = strrchr(file->text, '.');
  char        path[PETSC_MAX_PATH_LEN];
  PetscBool   exists;
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  *dim = 0;
  if (!extension || strncmp(extension, ".msh", strlen(".msh"))) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(OptionsFindFile(file->comm, file->text, path, sizeof(path), &exists));
  if (!exists) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCallMPI(MPI_Comm_rank(file->comm, &rank));
  if (!rank) *dim = PeekFile_Private(path);
  PetscCallMPI(MPI_Bcast(dim, 1, MPIU_INT, 0, file->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

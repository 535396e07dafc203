/* gmsh.c -- the sections of a Gmsh file, and the names of its physical groups. */
#include "gmsh/gmsh.h"
#include "base/compat.h"
#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_NAME = 127 }; /* of a physical group, by the format */

/* Only the first thing that goes wrong is worth telling: the rest follows from it. */
void GmshReaderFail(GmshReader *reader, const char format[], ...)
{
  va_list arguments;

  if (reader->reason[0]) return;
  va_start(arguments, format);
  vsnprintf(reader->reason, reader->len, format, arguments);
  va_end(arguments);
}

/* Splits the line `dim tag "name"` in place; NULL if it is not one, or the name is longer than Gmsh allows. */
static char *NameParse_Private(char line[], int *dim, int *tag)
{
  int   used = 0;
  char *begin, *end;

  if (sscanf(line, "%d %d%n", dim, tag, &used) != 2 || !isspace((unsigned char)line[used])) return NULL;
  begin = line + used + strspn(line + used, " \t");
  if (*begin++ != '"') return NULL;
  end = strrchr(line, '"');
  if (end < begin || end - begin > MAX_NAME) return NULL;
  *end = '\0';
  return begin;
}

/* $PhysicalNames: text in binary files too. */
static PetscErrorCode ReaderNames_Private(GmshReader *reader, GmshNames *names)
{
  char line[GMSH_LINE];
  int  num;

  PetscFunctionBeginUser;
  if (!fgets(line, sizeof(line), reader->file) || sscanf(line, "%d", &num) != 1 || num < 0 || num > reader->size) {
    GmshReaderFail(reader, "the number of physical names is missing");
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PetscCalloc3(num, &names->dim, num, &names->tag, num, &names->name));
  for (names->num = 0; names->num < num; ++names->num) {
    char *name = NULL;
    int   dim, tag;

    if (fgets(line, sizeof(line), reader->file)) name = NameParse_Private(line, &dim, &tag);
    if (!name) {
      GmshReaderFail(reader, "physical name %d of %d cannot be read", (int)names->num + 1, num);
      break;
    }
    PetscCall(PetscStrallocpy(name, &names->name[names->num]));
    names->dim[names->num] = dim;
    names->tag[names->num] = tag;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The rest of the $MeshFormat section. */
static void ReaderFormat_Private(GmshReader *reader)
{
  char  line[GMSH_LINE];
  float version = 0;
  int   binary = 0, one = 1;

  if (!fgets(line, sizeof(line), reader->file) ||
      sscanf(line, "%f %d %d", &version, &binary, &reader->data_size) != 3) {
    GmshReaderFail(reader, "its $MeshFormat cannot be read");
    return;
  }
  reader->version = (int)lroundf(10 * version);
  reader->binary  = binary ? PETSC_TRUE : PETSC_FALSE;
  if (reader->version != 22 && reader->version != 41) {
    GmshReaderFail(reader, "its format is %g; formats 2.2 and 4.1 are accepted", (double)version);
  } else if (reader->data_size != (int)sizeof(double)) {
    GmshReaderFail(reader, "its data size is %d; 8 is accepted", reader->data_size);
  } else if (binary && (fread(&one, sizeof(one), 1, reader->file) != 1 || one != 1)) {
    GmshReaderFail(reader, "it was written on a machine of other byte order");
  }
}

/* Section after section up to the elements; what nobody here needs is skipped line by line. */
static PetscErrorCode ReaderSections_Private(GmshReader *reader, GmshNames *names)
{
  PetscBool format = PETSC_FALSE, elements = PETSC_FALSE;
  char      line[GMSH_LINE];

  PetscFunctionBeginUser;
  while (!reader->reason[0] && !elements && fgets(line, sizeof(line), reader->file)) {
    line[strcspn(line, " \r\n")] = '\0';
    if (!strcmp(line, "$MeshFormat")) {
      ReaderFormat_Private(reader);
      format = PETSC_TRUE;
    } else if (!format && line[0]) {
      GmshReaderFail(reader, "it is not a Gmsh file: it does not begin with $MeshFormat");
    } else if (!strcmp(line, "$PhysicalNames") && !names->dim) {
      PetscCall(ReaderNames_Private(reader, names));
    } else if (!strcmp(line, "$Entities") && !reader->entity) {
      PetscCall(GmshReadEntities(reader));
    } else if (!strcmp(line, "$PartitionedEntities")) {
      GmshReaderFail(reader, "it is cut into partitions; save the mesh whole: it is cut among processes here");
    } else if (!strcmp(line, "$Nodes") && !reader->tag) {
      PetscCall(GmshReadNodes(reader));
    } else if (!strcmp(line, "$Elements")) {
      PetscCall(GmshReadElements(reader));
      elements = PETSC_TRUE;
    }
  }
  if (!format) GmshReaderFail(reader, "it is empty");
  if (!elements) GmshReaderFail(reader, "it has no $Elements");
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Reads up to the elements; what comes behind them (periodic nodes, data) has no meaning here. */
PetscErrorCode GmshRead(const char path[], GmshNames *names, GmshMesh *mesh, char reason[], size_t len)
{
  GmshReader reader = {.file = fopen(path, "rb"), .reason = reason, .len = len, .mesh = mesh};

  PetscFunctionBeginUser;
  reason[0] = '\0';
  *names    = (GmshNames){0, NULL, NULL, NULL};
  *mesh     = (GmshMesh){0};
  if (!reader.file) {
    snprintf(reason, len, "it cannot be opened");
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  fseek(reader.file, 0, SEEK_END);
  reader.size = ftell(reader.file);
  rewind(reader.file);
  PetscCall(ReaderSections_Private(&reader, names));
  fclose(reader.file);
  PetscCall(PetscFree2(reader.tag, reader.node));
  PetscCall(PetscFree4(reader.entity, reader.place, reader.entity_first, reader.entity_end));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GmshMeshDestroy(GmshMesh *mesh)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(mesh->coords));
  PetscCall(PetscFree4(mesh->type, mesh->start, mesh->first_group, mesh->end_group));
  PetscCall(PetscFree(mesh->nodes));
  PetscCall(PetscFree(mesh->group));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GmshNamesDestroy(GmshNames *names)
{
  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < names->num; ++i) PetscCall(PetscFree(names->name[i]));
  PetscCall(PetscFree3(names->dim, names->tag, names->name));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The place of a name in the list, -1 if it is not there. */
static PetscInt NameFind_Private(const GmshNames *names, PetscInt dim, const char name[])
{
  for (PetscInt i = 0; i < names->num; ++i) {
    if (names->dim[i] == dim && !strcmp(names->name[i], name)) return i;
  }
  return -1;
}

/* Names first: a group may be called "7". */
PetscBool GmshFindGroup(const GmshNames *names, PetscInt dim, const char group[], PetscInt *tag)
{
  const PetscInt at = NameFind_Private(names, dim, group);
  char          *end;

  if (at >= 0) {
    *tag = names->tag[at];
    return PETSC_TRUE;
  }
  *tag = (PetscInt)strtol(group, &end, 10);
  return end != group && !*end ? PETSC_TRUE : PETSC_FALSE;
}

PetscBool GmshHasName(const GmshNames *names, PetscInt dim, const char name[])
{
  return NameFind_Private(names, dim, name) >= 0 ? PETSC_TRUE : PETSC_FALSE;
}

void GmshDescribeGroup(const GmshNames *names, PetscInt dim, PetscInt tag, char text[], size_t len)
{
  const size_t used = strlen(text);
  const char  *name = NULL;

  for (PetscInt i = 0; i < names->num; ++i) {
    if (names->dim[i] == dim && names->tag[i] == tag) name = names->name[i];
  }
  if (name) snprintf(text + used, len - used, "%s%s (%d)", used ? ", " : "", name, (int)tag);
  if (!name) snprintf(text + used, len - used, "%s%d", used ? ", " : "", (int)tag);
}

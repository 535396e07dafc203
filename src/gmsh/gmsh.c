/* gmsh.c -- Gmsh files of formats 2.2 and 4.1, ASCII and binary (Gmsh reference manual, chapter "Gmsh file
   formats").

   An element with an undefined node, a block of an undefined entity, and inconsistent counts are reported by
   a sentence. */
#include "gmsh/gmsh.h"
#include "base/compat.h"
#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum {
  MAX_NAME  = 127,       /* letters of a physical group's name, by the format */
  MAX_LINE  = 512,       /* letters of a line of text that is read at once */
  MAX_TAGS  = 64,        /* of an element */
  MAX_TAG   = 100000000, /* of a node or an entity: far above the tags of any mesh */
  MAX_COUNT = 500000000, /* three coordinates of each can still be numbered */
  MIN_SIZE  = 64         /* first size of a list that grows */
};

/* A file being read. The first error sets `reason`; nothing is read after that. */
typedef struct {
  FILE      *file;
  PetscBool  binary;
  int        version, data_size; /* 10 times the format's, 22 or 41; bytes of a number */
  PetscInt64 size;               /* of the file in bytes: no count can be larger */
  char      *reason;             /* [len] */
  size_t     len;
  GmshMesh  *mesh;
  PetscInt   num_tags, *tag, *node;         /* sorted tags of nodes, and indices of the nodes */
  PetscInt   num_entities, *entity, *place; /* sorted 4 * tag + dim, and index into the next two */
  PetscInt  *entity_first, *entity_end;     /* into mesh->group */
  PetscInt   max_groups, max_nodes;         /* sizes of mesh->group and mesh->nodes */
} GmshReader;

/* Sets the reason of the first error; later errors are its consequences. */
static void GmshFail_Private(GmshReader *reader, const char format[], ...)
{
  va_list arguments;

  if (reader->reason[0]) return;
  va_start(arguments, format);
  vsnprintf(reader->reason, reader->len, format, arguments);
  va_end(arguments);
}

/* Next integer, of the given number of bytes in binary files. */
static PetscInt64 GmshReadInt_Private(GmshReader *reader, size_t bytes)
{
  long long value = 0;
  int       word  = 0;

  if (reader->reason[0]) return 0;
  if (reader->binary) {
    void *to = bytes == sizeof(word) ? (void *)&word : (void *)&value;

    if (fread(to, bytes, 1, reader->file) != 1) GmshFail_Private(reader, "it ends too early");
    return bytes == sizeof(word) ? word : value;
  }
  if (fscanf(reader->file, "%lld", &value) == 1) return value;
  GmshFail_Private(reader, feof(reader->file) ? "it ends too early" : "it has text instead of a whole number");
  return 0;
}

/* A tag or a type. */
static PetscInt64 GmshReadTag_Private(GmshReader *reader)
{
  return GmshReadInt_Private(reader, sizeof(int));
}

/* A count: a size_t in format 4.1; in format 2.2 a line of text, even in binary files. */
static PetscInt GmshReadCount_Private(GmshReader *reader, const char what[])
{
  long long value = 0;
  char      line[MAX_LINE];

  if (reader->reason[0]) return 0;
  if (reader->version > 40) {
    value = GmshReadInt_Private(reader, (size_t)reader->data_size);
  } else if (!fgets(line, sizeof(line), reader->file) || sscanf(line, "%lld", &value) != 1) {
    GmshFail_Private(reader, "the number of %s is missing", what);
  }
  if (value < 0 || value > reader->size || value > MAX_COUNT)
    GmshFail_Private(reader, "the number of %s is %lld, which is invalid", what, value);
  return reader->reason[0] ? 0 : (PetscInt)value;
}

/* Reads finite numbers. [out] values - [num]; NULL to skip them */
static void GmshReadNumbers_Private(GmshReader *reader, PetscInt num, PetscReal values[])
{
  for (PetscInt i = 0; i < num && !reader->reason[0]; i++) {
    double value = 0;

    if (reader->binary ? fread(&value, sizeof(value), 1, reader->file) != 1
                       : fscanf(reader->file, "%lf", &value) != 1) {
      GmshFail_Private(reader, feof(reader->file) ? "it ends too early" : "it has text instead of a coordinate");
    }
    if (!isfinite(value)) GmshFail_Private(reader, "a coordinate is not finite");
    if (values) values[i] = (PetscReal)value;
  }
}

/* Reads and checks the least and the largest tag of format 4.1. */
static void GmshReadRange_Private(GmshReader *reader)
{
  const PetscInt64 least   = GmshReadInt_Private(reader, (size_t)reader->data_size);
  const PetscInt64 largest = GmshReadInt_Private(reader, (size_t)reader->data_size);

  if (least > largest)
    GmshFail_Private(reader, "its least tag %lld is above its largest %lld", (long long)least, (long long)largest);
}

/* Enlarges a list of integers if it is too small. [in,out] room - its size */
static PetscErrorCode GmshGrowList_Private(PetscInt wanted, PetscInt *room, PetscInt **list)
{
  PetscFunctionBeginUser;
  if (wanted <= *room) PetscFunctionReturn(PETSC_SUCCESS);
  *room = PetscMax(PetscMax(wanted, MIN_SIZE), 2 * *room);
  PetscCall(PetscRealloc(*room * sizeof(PetscInt), list));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Appends the number of a physical group. 0 means none; a minus sign means elements of the opposite
   orientation. */
static PetscErrorCode GmshAddGroup_Private(GmshReader *reader, PetscInt64 group)
{
  GmshMesh *mesh = reader->mesh;

  PetscFunctionBeginUser;
  if (group < -PETSC_MAX_INT || group > PETSC_MAX_INT)
    GmshFail_Private(reader, "a physical group has the number %lld, which is invalid", (long long)group);
  if (reader->reason[0] || group == 0) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(GmshGrowList_Private(mesh->num_groups + 1, &reader->max_groups, &mesh->group));
  mesh->group[mesh->num_groups++] = (PetscInt)(group < 0 ? -group : group);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Entities exist in format 4.1 only: blocks of nodes and elements refer to them for their physical groups. */
static PetscErrorCode GmshReadEntities_Private(GmshReader *reader)
{
  PetscInt num[4], total = 0;

  PetscFunctionBeginUser;
  for (PetscInt dim = 0; dim < 4; dim++) total += num[dim] = GmshReadCount_Private(reader, "entities");
  PetscCall(PetscMalloc4(total, &reader->entity, total, &reader->place, total, &reader->entity_first, total,
                         &reader->entity_end));
  for (PetscInt dim = 0; dim < 4; dim++) {
    for (PetscInt i = 0; i < num[dim] && !reader->reason[0]; i++) {
      const PetscInt   e   = reader->num_entities++;
      const PetscInt64 tag = GmshReadTag_Private(reader);

      if (tag < -MAX_TAG || tag > MAX_TAG)
        GmshFail_Private(reader, "an entity has the tag %lld, which is invalid", (long long)tag);
      reader->place[e]        = e;
      reader->entity[e]       = reader->reason[0] ? 0 : 4 * (PetscInt)tag + dim;
      reader->entity_first[e] = reader->mesh->num_groups;
      GmshReadNumbers_Private(reader, dim ? 6 : 3, NULL); // a box, or a point
      for (PetscInt n = GmshReadCount_Private(reader, "tags of an entity"); n > 0 && !reader->reason[0]; n--)
        PetscCall(GmshAddGroup_Private(reader, GmshReadTag_Private(reader)));
      reader->entity_end[e] = reader->mesh->num_groups;
      if (dim == 0) continue; // a point has no boundary
      for (PetscInt n = GmshReadCount_Private(reader, "tags of an entity"); n > 0 && !reader->reason[0]; n--)
        (void)GmshReadTag_Private(reader);
    }
  }
  PetscCall(PetscSortIntWithArray(reader->num_entities, reader->entity, reader->place));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Reads the head of a block of format 4.1: dimension and tag of its entity.
   [out] entity - index of the entity */
static PetscErrorCode GmshReadEntity_Private(GmshReader *reader, PetscInt64 *dim, PetscInt *entity)
{
  PetscInt64 tag;
  PetscInt   at = -1;

  PetscFunctionBeginUser;
  *entity = 0;
  *dim    = GmshReadTag_Private(reader);
  tag     = GmshReadTag_Private(reader);
  if (reader->reason[0]) PetscFunctionReturn(PETSC_SUCCESS);
  if (*dim >= 0 && *dim < 4 && tag >= -MAX_TAG && tag <= MAX_TAG)
    PetscCall(PetscFindInt((PetscInt)(4 * tag + *dim), reader->num_entities, reader->entity, &at));
  if (at < 0) {
    GmshFail_Private(reader, "a block belongs to entity %lld of dimension %lld, which the file does not define",
                     (long long)tag, (long long)*dim);
  } else {
    *entity = reader->place[at];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The sorted tags are different, and not too large. */
static PetscErrorCode GmshSortNodes_Private(GmshReader *reader)
{
  const PetscInt num = reader->num_tags, *tag = reader->tag;

  PetscFunctionBeginUser;
  PetscCall(PetscSortIntWithArray(num, reader->tag, reader->node));
  for (PetscInt i = 1; i < num; i++) {
    if (tag[i] == tag[i - 1]) GmshFail_Private(reader, "node %d is defined twice", (int)tag[i]);
  }
  if (num && (tag[0] < 0 || tag[num - 1] > MAX_TAG)) {
    GmshFail_Private(reader, "a node has the tag %d; tags from 0 to %d are accepted",
                     (int)(tag[0] < 0 ? tag[0] : tag[num - 1]), MAX_TAG);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Positions in the order of the file, and sorted tags for the nodes of elements. */
static PetscErrorCode GmshReadNodes_Private(GmshReader *reader)
{
  const PetscBool blocks     = reader->version > 40 ? PETSC_TRUE : PETSC_FALSE;
  const PetscInt  num_blocks = blocks ? GmshReadCount_Private(reader, "blocks of nodes") : 1;
  const PetscInt  total      = GmshReadCount_Private(reader, "nodes");

  PetscFunctionBeginUser;
  if (blocks) GmshReadRange_Private(reader);
  PetscCall(PetscMalloc2(total, &reader->tag, total, &reader->node));
  PetscCall(PetscMalloc1(3 * total, &reader->mesh->coords));
  for (PetscInt b = 0; b < num_blocks && !reader->reason[0]; b++) {
    PetscInt   num = total, first = reader->num_tags, entity;
    PetscInt64 dim;

    if (blocks) {
      PetscCall(GmshReadEntity_Private(reader, &dim, &entity));
      if (GmshReadTag_Private(reader))
        GmshFail_Private(reader, "its nodes have parametric coordinates, which cannot be read");
      num = GmshReadCount_Private(reader, "nodes of a block");
    }
    if (num > total - first) GmshFail_Private(reader, "its blocks hold more nodes than the file declares");
    for (PetscInt i = first; i < first + num && !reader->reason[0]; i++, reader->num_tags++) {
      reader->tag[i]  = (PetscInt)GmshReadInt_Private(reader, blocks ? (size_t)reader->data_size : sizeof(int));
      reader->node[i] = i;
      if (!blocks) GmshReadNumbers_Private(reader, 3, &reader->mesh->coords[3 * i]);
    }
    if (blocks && num > 0 && !reader->reason[0])
      GmshReadNumbers_Private(reader, 3 * num, &reader->mesh->coords[3 * first]);
  }
  if (reader->num_tags < total) GmshFail_Private(reader, "its blocks hold fewer nodes than the file declares");
  reader->mesh->num_nodes = reader->num_tags;
  PetscCall(GmshSortNodes_Private(reader));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A type of element by its number, whose nodes can be read. */
static const GmshType *GmshReadType_Private(GmshReader *reader)
{
  const PetscInt64 number = GmshReadTag_Private(reader);
  const GmshType  *type   = GmshTypeGet(number);

  if (!type)
    GmshFail_Private(
        reader,
        "it holds elements of Gmsh's type %lld, which cannot be used; triangles, quadrangles, tetrahedra and "
        "hexahedra of first and second order are accepted",
        (long long)number);
  return type;
}

/* Allocates all elements, without their nodes. */
static PetscErrorCode GmshAllocateElements_Private(GmshMesh *mesh, PetscInt num)
{
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc4(num, &mesh->type, num + 1, &mesh->start, num, &mesh->first_group, num, &mesh->end_group));
  mesh->start[0] = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the nodes just read are those of the element before, in the same order. Format 2.2 lists an element
   of several physical groups once for each group, in succession. */
static PetscBool GmshRepeatsElement_Private(const GmshMesh *mesh, const GmshType *type)
{
  const PetscInt e = mesh->num_elements, num = type->num_nodes;

  if (e == 0 || mesh->type[e - 1] != type) return PETSC_FALSE;
  for (PetscInt i = 0; i < num; i++) {
    if (mesh->nodes[mesh->start[e] + i] != mesh->nodes[mesh->start[e - 1] + i]) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

/* The nodes of one element, which is kept unless it is a point. [in] first, end - range of its groups */
static PetscErrorCode GmshReadElement_Private(GmshReader *reader, PetscInt64 element, const GmshType *type,
                                              size_t bytes, PetscInt first, PetscInt end)
{
  GmshMesh      *mesh = reader->mesh;
  const PetscInt e    = mesh->num_elements;

  PetscFunctionBeginUser;
  if (reader->reason[0]) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(GmshGrowList_Private(mesh->start[e] + type->num_nodes, &reader->max_nodes, &mesh->nodes));
  for (PetscInt i = 0; i < type->num_nodes; i++) {
    const PetscInt64 node = GmshReadInt_Private(reader, bytes);
    PetscInt         at   = -1;

    if (reader->reason[0]) PetscFunctionReturn(PETSC_SUCCESS);
    if (node >= 0 && node <= MAX_TAG) PetscCall(PetscFindInt((PetscInt)node, reader->num_tags, reader->tag, &at));
    if (at < 0) {
      GmshFail_Private(reader, "element %lld refers to node %lld, which the file does not define", (long long)element,
                       (long long)node);
      PetscFunctionReturn(PETSC_SUCCESS);
    }
    mesh->nodes[mesh->start[e] + (type->place ? type->place[i] : i)] = reader->node[at];
  }
  if (type->dim == 0) PetscFunctionReturn(PETSC_SUCCESS);
  if (reader->version < 40 && GmshRepeatsElement_Private(mesh, type)) {
    mesh->end_group[e - 1] = end; // its groups continue those of the element before
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  mesh->type[e]        = type;
  mesh->start[e + 1]   = mesh->start[e] + type->num_nodes;
  mesh->first_group[e] = first;
  mesh->end_group[e]   = end;
  mesh->num_elements++;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Format 2.2: every element with its own head; in binary files one head for a run of elements. */
static PetscErrorCode GmshReadRuns_Private(GmshReader *reader)
{
  const PetscInt num = GmshReadCount_Private(reader, "elements");

  PetscFunctionBeginUser;
  PetscCall(GmshAllocateElements_Private(reader->mesh, num));
  for (PetscInt e = 0; e < num && !reader->reason[0];) {
    PetscInt64       element  = reader->binary ? 0 : GmshReadTag_Private(reader);
    const GmshType  *type     = GmshReadType_Private(reader);
    PetscInt64       run      = reader->binary ? GmshReadTag_Private(reader) : 1;
    const PetscInt64 num_tags = GmshReadTag_Private(reader);

    if (run < 1 || run > num - e || num_tags < 0 || num_tags > MAX_TAGS) {
      GmshFail_Private(reader, "element %d of %d cannot be read", (int)e + 1, (int)num);
    }
    for (; run > 0 && !reader->reason[0]; run--, e++) {
      const PetscInt first = reader->mesh->num_groups;

      if (reader->binary) element = GmshReadTag_Private(reader);
      for (PetscInt64 i = 0; i < num_tags; i++) {
        const PetscInt64 tag = GmshReadTag_Private(reader);

        if (i == 0) PetscCall(GmshAddGroup_Private(reader, tag)); // the others are of the geometry
      }
      PetscCall(GmshReadElement_Private(reader, element, type, sizeof(int), first, reader->mesh->num_groups));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Format 4.1: in blocks of one entity. */
static PetscErrorCode GmshReadBlocks_Private(GmshReader *reader)
{
  const PetscInt num_blocks = GmshReadCount_Private(reader, "blocks of elements");
  const PetscInt total      = GmshReadCount_Private(reader, "elements");
  PetscInt       seen       = 0;

  PetscFunctionBeginUser;
  GmshReadRange_Private(reader);
  PetscCall(GmshAllocateElements_Private(reader->mesh, total));
  for (PetscInt b = 0; b < num_blocks && !reader->reason[0]; b++) {
    const GmshType *type;
    PetscInt64      dim;
    PetscInt        num, entity;

    PetscCall(GmshReadEntity_Private(reader, &dim, &entity));
    type = GmshReadType_Private(reader);
    num  = GmshReadCount_Private(reader, "elements of a block");
    if (!reader->reason[0] && type->dim != dim)
      GmshFail_Private(reader, "%s belong to an entity of dimension %lld", type->name, (long long)dim);
    if (num > total - seen) GmshFail_Private(reader, "its blocks hold more elements than the file declares");
    for (PetscInt e = 0; e < num && !reader->reason[0]; e++) {
      const PetscInt64 element = GmshReadInt_Private(reader, (size_t)reader->data_size);

      PetscCall(GmshReadElement_Private(reader, element, type, (size_t)reader->data_size, reader->entity_first[entity],
                                        reader->entity_end[entity]));
    }
    seen += num;
  }
  if (seen < total) GmshFail_Private(reader, "its blocks hold fewer elements than the file declares");
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Skips the elements of a head that was read; in text, the rest of its line and one line for each further
   element. */
static void GmshSkipElements_Private(GmshReader *reader, PetscInt64 num_lines, PetscInt64 num_bytes)
{
  if (reader->binary && fseek(reader->file, (long)num_bytes, SEEK_CUR)) GmshFail_Private(reader, "it ends too early");
  for (PetscInt64 n = 0; n <= num_lines && !reader->binary; n++) {
    if (fscanf(reader->file, "%*[^\n]") == EOF || fgetc(reader->file) == EOF) break;
  }
}

/* Highest dimension of the elements, up to the first solid, by their heads alone. Heads of format 4.1 have
   the dimension, for unknown types, too. */
static PetscInt GmshProbeElements_Private(GmshReader *reader)
{
  const PetscBool blocks = reader->version > 40 ? PETSC_TRUE : PETSC_FALSE;
  PetscInt64      num    = GmshReadCount_Private(reader, "elements");
  PetscInt        dim    = 0;

  if (blocks) (void)GmshReadCount_Private(reader, "elements");
  if (blocks) GmshReadRange_Private(reader);
  while (num > 0 && dim < 3 && !reader->reason[0]) {
    /* dimension, entity, type; in text of format 2.2 element, type, tags; in binary files of format 2.2 type,
       elements, tags */
    const GmshType *type;
    PetscInt64      head[3], run;

    for (int i = 0; i < 3; i++) head[i] = GmshReadTag_Private(reader);
    run  = blocks ? GmshReadCount_Private(reader, "elements") : reader->binary ? head[1] : 1;
    type = GmshTypeGet(head[blocks ? 2 : reader->binary ? 0 : 1]);
    if (reader->reason[0] || (!type && reader->binary) ||
        (!blocks && (run < 1 || run > num || head[2] < 0 || head[2] > MAX_TAGS)))
      break;
    dim = PetscMax(dim, type ? type->dim : blocks ? (PetscInt)PetscMin(head[0], 3) : 0);
    num -= blocks ? 1 : run;
    GmshSkipElements_Private(reader, blocks ? run : 0,
                             type ? run * (blocks ? 8 * (1 + type->num_nodes) : 4 * (1 + head[2] + type->num_nodes))
                                  : 0);
  }
  return dim;
}

/* Splits the line `dim tag "name"` in place; NULL if it is not one, or the name is longer than Gmsh
   allows. */
static char *GmshParseName_Private(char line[], int *dim, int *tag)
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
static PetscErrorCode GmshReadNames_Private(GmshReader *reader, GmshNames *names)
{
  char line[MAX_LINE];
  int  num;

  PetscFunctionBeginUser;
  if (!fgets(line, sizeof(line), reader->file) || sscanf(line, "%d", &num) != 1 || num < 0 || num > reader->size) {
    GmshFail_Private(reader, "the number of physical names is missing");
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PetscCalloc3(num, &names->dim, num, &names->tag, num, &names->name));
  for (names->num = 0; names->num < num; names->num++) {
    char *name = NULL;
    int   dim, tag;

    if (fgets(line, sizeof(line), reader->file)) name = GmshParseName_Private(line, &dim, &tag);
    if (!name) {
      GmshFail_Private(reader, "physical name %d of %d cannot be read", (int)names->num + 1, num);
      break;
    }
    PetscCall(PetscStrallocpy(name, &names->name[names->num]));
    names->dim[names->num] = dim;
    names->tag[names->num] = tag;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The rest of the $MeshFormat section. */
static void GmshReadFormat_Private(GmshReader *reader)
{
  char  line[MAX_LINE];
  float version = 0;
  int   binary = 0, one = 1;

  if (!fgets(line, sizeof(line), reader->file) ||
      sscanf(line, "%f %d %d", &version, &binary, &reader->data_size) != 3) {
    GmshFail_Private(reader, "its $MeshFormat cannot be read");
    return;
  }
  reader->version = (int)lroundf(10 * version);
  reader->binary  = binary ? PETSC_TRUE : PETSC_FALSE;
  if (reader->version != 22 && reader->version != 41) {
    GmshFail_Private(reader, "its format is %g; formats 2.2 and 4.1 are accepted: gmsh -format msh41 writes it anew",
                     (double)version);
  } else if (reader->data_size != (int)sizeof(double)) {
    GmshFail_Private(reader, "its data size is %d; 8 is accepted", reader->data_size);
  } else if (binary && (fread(&one, sizeof(one), 1, reader->file) != 1 || one != 1)) {
    GmshFail_Private(reader, "its byte order is not that of this machine");
  }
}

/* Section after section up to the elements; a section that is not needed is skipped line by line.
   [out] names - NULL if only the dimension of the elements is asked for;
   [out] dim - that, if names is NULL */
static PetscErrorCode GmshReadSections_Private(GmshReader *reader, GmshNames *names, PetscInt *dim)
{
  PetscBool format = PETSC_FALSE, elements = PETSC_FALSE;
  char      line[MAX_LINE];

  PetscFunctionBeginUser;
  while (!reader->reason[0] && !elements && fgets(line, sizeof(line), reader->file)) {
    line[strcspn(line, " \r\n")] = '\0';
    if (!strcmp(line, "$MeshFormat")) {
      GmshReadFormat_Private(reader);
      format = PETSC_TRUE;
    } else if (!format && line[0]) {
      GmshFail_Private(reader, strcmp(line, "$NOD")
                                   ? "it is not a Gmsh file: it does not begin with $MeshFormat"
                                   : "it is of Gmsh's version 1; write it as version 2.2 or 4.1 (gmsh -format msh4)");
    } else if (!names && !strcmp(line, "$Elements")) {
      *dim = GmshProbeElements_Private(reader);
      break;
    } else if (!names) {
      continue;
    } else if (!strcmp(line, "$PhysicalNames") && !names->dim) {
      PetscCall(GmshReadNames_Private(reader, names));
    } else if (!strcmp(line, "$Entities") && !reader->entity) {
      PetscCall(GmshReadEntities_Private(reader));
    } else if (!strcmp(line, "$PartitionedEntities")) {
      GmshFail_Private(reader, "it is partitioned; save the mesh without partitions, since Mortise makes its own");
    } else if (!strcmp(line, "$Nodes") && !reader->tag) {
      PetscCall(GmshReadNodes_Private(reader));
    } else if (!strcmp(line, "$Elements")) {
      PetscCall(reader->version > 40 ? GmshReadBlocks_Private(reader) : GmshReadRuns_Private(reader));
      elements = PETSC_TRUE;
    }
  }
  if (!format) GmshFail_Private(reader, "it is empty");
  if (!elements) GmshFail_Private(reader, "it has no $Elements");
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode GmshOpen_Private(GmshReader *reader, const char path[])
{
  PetscFunctionBeginUser;
  reader->reason[0] = '\0';
  reader->file      = fopen(path, "rb");
  if (!reader->file) {
    GmshFail_Private(reader, "it cannot be opened");
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  fseek(reader->file, 0, SEEK_END);
  reader->size = ftell(reader->file);
  rewind(reader->file);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Reads up to the elements; sections after them (periodic nodes, data) are not used. */
PetscErrorCode GmshRead(const char path[], GmshNames *names, GmshMesh *mesh, char reason[], size_t len)
{
  GmshReader reader = {.reason = reason, .len = len, .mesh = mesh};

  PetscFunctionBeginUser;
  *names = (GmshNames){0, NULL, NULL, NULL};
  *mesh  = (GmshMesh){0};
  PetscCall(GmshOpen_Private(&reader, path));
  if (!reader.file) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(GmshReadSections_Private(&reader, names, NULL));
  fclose(reader.file);
  if (!reason[0]) GmshNamesUnite(names, mesh);
  PetscCall(PetscFree2(reader.tag, reader.node));
  PetscCall(PetscFree4(reader.entity, reader.place, reader.entity_first, reader.entity_end));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GmshGetDimension(const char path[], PetscInt *dim, char reason[], size_t len)
{
  GmshReader reader = {.reason = reason, .len = len};

  PetscFunctionBeginUser;
  *dim = 0;
  PetscCall(GmshOpen_Private(&reader, path));
  if (!reader.file) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(GmshReadSections_Private(&reader, NULL, dim));
  fclose(reader.file);
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

/* gmshread.c -- nodes and elements of a Gmsh file, followed reference by reference.

   An element with a node that the file does not define, a block of an entity that does not exist, or counts that do not
   add up, end in a sentence. Formats 2.2 and 4.1, ASCII and binary, as in the Gmsh reference manual, chapter "Gmsh file
   formats". */
#include "gmsh/gmsh.h"
#include "base/compat.h"
#include <math.h>

enum {
  MAX_TAGS  = 64,        /* of an element */
  MAX_TAG   = 100000000, /* of a node or an entity: far above what a mesh needs, far below what an integer holds */
  MAX_COUNT = 500000000, /* three coordinates of each can still be numbered */
  MIN_ROOM  = 64         /* of lists that grow, from the beginning */
};

/* Next integer, of the given number of bytes in binary files. */
static PetscInt64 ReadInt_Private(GmshReader *reader, size_t bytes)
{
  long long value = 0;
  int       word  = 0;

  if (reader->reason[0]) return 0;
  if (reader->binary) {
    void *to = bytes == sizeof(word) ? (void *)&word : (void *)&value;

    if (fread(to, bytes, 1, reader->file) != 1) GmshReaderFail(reader, "it ends too early");
    return bytes == sizeof(word) ? word : value;
  }
  if (fscanf(reader->file, "%lld", &value) == 1) return value;
  GmshReaderFail(reader, feof(reader->file) ? "it ends too early" : "there is text where a whole number belongs");
  return 0;
}

/* A tag or a type. */
static PetscInt64 ReadTag_Private(GmshReader *reader)
{
  return ReadInt_Private(reader, sizeof(int));
}

/* A number of things: a size_t in format 4.1, a line of text in 2.2, even in binary files. */
static PetscInt ReadCount_Private(GmshReader *reader, const char what[])
{
  long long value = 0;
  char      line[GMSH_LINE];

  if (reader->reason[0]) return 0;
  if (reader->version > 40) {
    value = ReadInt_Private(reader, (size_t)reader->data_size);
  } else if (!fgets(line, sizeof(line), reader->file) || sscanf(line, "%lld", &value) != 1) {
    GmshReaderFail(reader, "the number of %s is missing", what);
  }
  if (value < 0 || value > reader->size || value > MAX_COUNT)
    GmshReaderFail(reader, "the number of %s is %lld, which cannot be", what, value);
  return reader->reason[0] ? 0 : (PetscInt)value;
}

/* Finite numbers. [out] values - [num], or NULL where they do not matter */
static void ReadNumbers_Private(GmshReader *reader, PetscInt num, PetscReal values[])
{
  for (PetscInt i = 0; i < num && !reader->reason[0]; ++i) {
    double value = 0;

    if (reader->binary ? fread(&value, sizeof(value), 1, reader->file) != 1
                       : fscanf(reader->file, "%lf", &value) != 1) {
      GmshReaderFail(reader, feof(reader->file) ? "it ends too early" : "there is text where a coordinate belongs");
    }
    if (!isfinite(value)) GmshReaderFail(reader, "a coordinate is not finite");
    if (values) values[i] = (PetscReal)value;
  }
}

/* Least and largest tag, which format 4.1 announces. */
static void ReadRange_Private(GmshReader *reader)
{
  const PetscInt64 least   = ReadInt_Private(reader, (size_t)reader->data_size);
  const PetscInt64 largest = ReadInt_Private(reader, (size_t)reader->data_size);

  if (least > largest)
    GmshReaderFail(reader, "its least tag %lld is above its largest %lld", (long long)least, (long long)largest);
}

/* Room for more integers in a list that grows. [in,out] room - for as many as there is */
static PetscErrorCode Grow_Private(PetscInt wanted, PetscInt *room, PetscInt **list)
{
  PetscFunctionBeginUser;
  if (wanted <= *room) PetscFunctionReturn(PETSC_SUCCESS);
  *room = PetscMax(PetscMax(wanted, MIN_ROOM), 2 * *room);
  PetscCall(PetscRealloc(*room * sizeof(PetscInt), list));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Appends the number of a physical group; 0 means none, a minus sign another sense of the elements. */
static PetscErrorCode AddGroup_Private(GmshReader *reader, PetscInt64 group)
{
  GmshMesh *mesh = reader->mesh;

  PetscFunctionBeginUser;
  if (group < -PETSC_MAX_INT || group > PETSC_MAX_INT)
    GmshReaderFail(reader, "a physical group has the number %lld, which cannot be", (long long)group);
  if (reader->reason[0] || group == 0) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(Grow_Private(mesh->num_groups + 1, &reader->max_groups, &mesh->group));
  mesh->group[mesh->num_groups++] = (PetscInt)(group < 0 ? -group : group);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Entities exist in format 4.1 only: blocks of nodes and elements refer to them for their physical groups. */
PetscErrorCode GmshReadEntities(GmshReader *reader)
{
  PetscInt num[4], total = 0;

  PetscFunctionBeginUser;
  for (PetscInt dim = 0; dim < 4; ++dim) total += num[dim] = ReadCount_Private(reader, "entities");
  PetscCall(PetscMalloc4(total, &reader->entity, total, &reader->place, total, &reader->entity_first, total,
                         &reader->entity_end));
  for (PetscInt dim = 0; dim < 4; ++dim) {
    for (PetscInt i = 0; i < num[dim] && !reader->reason[0]; ++i) {
      const PetscInt   e   = reader->num_entities++;
      const PetscInt64 tag = ReadTag_Private(reader);

      if (tag < -MAX_TAG || tag > MAX_TAG)
        GmshReaderFail(reader, "an entity has the tag %lld, which cannot be", (long long)tag);
      reader->place[e]        = e;
      reader->entity[e]       = reader->reason[0] ? 0 : 4 * (PetscInt)tag + dim;
      reader->entity_first[e] = reader->mesh->num_groups;
      ReadNumbers_Private(reader, dim ? 6 : 3, NULL); // a box, or a point
      for (PetscInt n = ReadCount_Private(reader, "tags of an entity"); n > 0 && !reader->reason[0]; --n)
        PetscCall(AddGroup_Private(reader, ReadTag_Private(reader)));
      reader->entity_end[e] = reader->mesh->num_groups;
      if (dim == 0) continue; // nothing bounds a point
      for (PetscInt n = ReadCount_Private(reader, "tags of an entity"); n > 0 && !reader->reason[0]; --n)
        (void)ReadTag_Private(reader);
    }
  }
  PetscCall(PetscSortIntWithArray(reader->num_entities, reader->entity, reader->place));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The head of a block in format 4.1: dimension and tag of its entity. [out] entity - its place */
static PetscErrorCode ReadEntity_Private(GmshReader *reader, PetscInt64 *dim, PetscInt *entity)
{
  PetscInt64 tag;
  PetscInt   at = -1;

  PetscFunctionBeginUser;
  *entity = 0;
  *dim    = ReadTag_Private(reader);
  tag     = ReadTag_Private(reader);
  if (reader->reason[0]) PetscFunctionReturn(PETSC_SUCCESS);
  if (*dim >= 0 && *dim < 4 && tag >= -MAX_TAG && tag <= MAX_TAG)
    PetscCall(PetscFindInt((PetscInt)(4 * tag + *dim), reader->num_entities, reader->entity, &at));
  if (at < 0) {
    GmshReaderFail(reader, "a block belongs to entity %lld of dimension %lld, which the file does not define",
                   (long long)tag, (long long)*dim);
  } else {
    *entity = reader->place[at];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The sorted tags are different, and not too large. */
static PetscErrorCode NodesSort_Private(GmshReader *reader)
{
  const PetscInt num = reader->num_tags, *tag = reader->tag;

  PetscFunctionBeginUser;
  PetscCall(PetscSortIntWithArray(num, reader->tag, reader->node));
  for (PetscInt i = 1; i < num; ++i) {
    if (tag[i] == tag[i - 1]) GmshReaderFail(reader, "node %d is defined twice", (int)tag[i]);
  }
  if (num && (tag[0] < 0 || tag[num - 1] > MAX_TAG)) {
    GmshReaderFail(reader, "a node has the tag %d; tags from 0 to %d are accepted",
                   (int)(tag[0] < 0 ? tag[0] : tag[num - 1]), MAX_TAG);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Positions in the order of the file, and sorted tags, which elements are looked up in. */
PetscErrorCode GmshReadNodes(GmshReader *reader)
{
  const PetscBool blocks     = reader->version > 40 ? PETSC_TRUE : PETSC_FALSE;
  const PetscInt  num_blocks = blocks ? ReadCount_Private(reader, "blocks of nodes") : 1;
  const PetscInt  total      = ReadCount_Private(reader, "nodes");

  PetscFunctionBeginUser;
  if (blocks) ReadRange_Private(reader);
  PetscCall(PetscMalloc2(total, &reader->tag, total, &reader->node));
  PetscCall(PetscMalloc1(3 * total, &reader->mesh->coords));
  for (PetscInt b = 0; b < num_blocks && !reader->reason[0]; ++b) {
    PetscInt   num = total, first = reader->num_tags, entity;
    PetscInt64 dim;

    if (blocks) {
      PetscCall(ReadEntity_Private(reader, &dim, &entity));
      if (ReadTag_Private(reader))
        GmshReaderFail(reader, "its nodes have parametric coordinates, which cannot be read");
      num = ReadCount_Private(reader, "nodes of a block");
    }
    if (num > total - first) GmshReaderFail(reader, "its blocks hold more nodes than the file declares");
    for (PetscInt i = first; i < first + num && !reader->reason[0]; ++i, ++reader->num_tags) {
      reader->tag[i]  = (PetscInt)ReadInt_Private(reader, blocks ? (size_t)reader->data_size : sizeof(int));
      reader->node[i] = i;
      if (!blocks) ReadNumbers_Private(reader, 3, &reader->mesh->coords[3 * i]);
    }
    if (blocks && num > 0 && !reader->reason[0]) ReadNumbers_Private(reader, 3 * num, &reader->mesh->coords[3 * first]);
  }
  if (reader->num_tags < total) GmshReaderFail(reader, "its blocks hold fewer nodes than the file declares");
  reader->mesh->num_nodes = reader->num_tags;
  PetscCall(NodesSort_Private(reader));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A type of element by its number, whose nodes can be read. */
static const GmshType *ReadType_Private(GmshReader *reader)
{
  const PetscInt64 number = ReadTag_Private(reader);
  const GmshType  *type   = GmshTypeGet(number);

  if (!type)
    GmshReaderFail(
        reader,
        "it holds elements of Gmsh's type %lld, which cannot be used; triangles, quadrangles, tetrahedra and "
        "hexahedra of first and second order are accepted",
        (long long)number);
  return type;
}

/* Room for all elements, but for their nodes. */
static PetscErrorCode ElementsAllocate_Private(GmshMesh *mesh, PetscInt num)
{
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc4(num, &mesh->type, num + 1, &mesh->start, num, &mesh->first_group, num, &mesh->end_group));
  mesh->start[0] = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the nodes just read are those of the element before, in the same order: an element of several physical groups
   is listed by format 2.2 once for each of them, one right after the other. */
static PetscBool ElementIsAgain_Private(const GmshMesh *mesh, const GmshType *type)
{
  const PetscInt e = mesh->num_elements, num = type->num_nodes;

  if (e == 0 || mesh->type[e - 1] != type) return PETSC_FALSE;
  for (PetscInt i = 0; i < num; ++i) {
    if (mesh->nodes[mesh->start[e] + i] != mesh->nodes[mesh->start[e - 1] + i]) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

/* The nodes of one element, which is kept unless it is a point. [in] first, end - range of its groups */
static PetscErrorCode ReadElement_Private(GmshReader *reader, PetscInt64 element, const GmshType *type, size_t bytes,
                                          PetscInt first, PetscInt end)
{
  GmshMesh      *mesh = reader->mesh;
  const PetscInt e    = mesh->num_elements;

  PetscFunctionBeginUser;
  if (reader->reason[0]) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(Grow_Private(mesh->start[e] + type->num_nodes, &reader->max_nodes, &mesh->nodes));
  for (PetscInt i = 0; i < type->num_nodes; ++i) {
    const PetscInt64 node = ReadInt_Private(reader, bytes);
    PetscInt         at   = -1;

    if (reader->reason[0]) PetscFunctionReturn(PETSC_SUCCESS);
    if (node >= 0 && node <= MAX_TAG) PetscCall(PetscFindInt((PetscInt)node, reader->num_tags, reader->tag, &at));
    if (at < 0) {
      GmshReaderFail(reader, "element %lld refers to node %lld, which the file does not define", (long long)element,
                     (long long)node);
      PetscFunctionReturn(PETSC_SUCCESS);
    }
    mesh->nodes[mesh->start[e] + (type->place ? type->place[i] : i)] = reader->node[at];
  }
  if (type->dim == 0) PetscFunctionReturn(PETSC_SUCCESS);
  if (reader->version < 40 && ElementIsAgain_Private(mesh, type)) {
    mesh->end_group[e - 1] = end; // its groups follow those of the element before
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  mesh->type[e]        = type;
  mesh->start[e + 1]   = mesh->start[e] + type->num_nodes;
  mesh->first_group[e] = first;
  mesh->end_group[e]   = end;
  ++mesh->num_elements;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Format 2.2: every element with its own head; in binary files one head for a run of elements. */
static PetscErrorCode ReadRuns_Private(GmshReader *reader)
{
  const PetscInt num = ReadCount_Private(reader, "elements");

  PetscFunctionBeginUser;
  PetscCall(ElementsAllocate_Private(reader->mesh, num));
  for (PetscInt e = 0; e < num && !reader->reason[0];) {
    PetscInt64       element  = reader->binary ? 0 : ReadTag_Private(reader);
    const GmshType  *type     = ReadType_Private(reader);
    PetscInt64       run      = reader->binary ? ReadTag_Private(reader) : 1;
    const PetscInt64 num_tags = ReadTag_Private(reader);

    if (run < 1 || run > num - e || num_tags < 0 || num_tags > MAX_TAGS) {
      GmshReaderFail(reader, "element %d of %d cannot be read", (int)e + 1, (int)num);
    }
    for (; run > 0 && !reader->reason[0]; --run, ++e) {
      const PetscInt first = reader->mesh->num_groups;

      if (reader->binary) element = ReadTag_Private(reader);
      for (PetscInt64 i = 0; i < num_tags; ++i) {
        const PetscInt64 tag = ReadTag_Private(reader);

        if (i == 0) PetscCall(AddGroup_Private(reader, tag)); // the others are of the geometry
      }
      PetscCall(ReadElement_Private(reader, element, type, sizeof(int), first, reader->mesh->num_groups));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Format 4.1: in blocks of one entity. */
static PetscErrorCode ReadBlocks_Private(GmshReader *reader)
{
  const PetscInt num_blocks = ReadCount_Private(reader, "blocks of elements");
  const PetscInt total      = ReadCount_Private(reader, "elements");
  PetscInt       seen       = 0;

  PetscFunctionBeginUser;
  ReadRange_Private(reader);
  PetscCall(ElementsAllocate_Private(reader->mesh, total));
  for (PetscInt b = 0; b < num_blocks && !reader->reason[0]; ++b) {
    const GmshType *type;
    PetscInt64      dim;
    PetscInt        num, entity;

    PetscCall(ReadEntity_Private(reader, &dim, &entity));
    type = ReadType_Private(reader);
    num  = ReadCount_Private(reader, "elements of a block");
    if (!reader->reason[0] && type->dim != dim)
      GmshReaderFail(reader, "%s stand under an entity of dimension %lld", type->name, (long long)dim);
    if (num > total - seen) GmshReaderFail(reader, "its blocks hold more elements than the file declares");
    for (PetscInt e = 0; e < num && !reader->reason[0]; ++e) {
      const PetscInt64 element = ReadInt_Private(reader, (size_t)reader->data_size);

      PetscCall(ReadElement_Private(reader, element, type, (size_t)reader->data_size, reader->entity_first[entity],
                                    reader->entity_end[entity]));
    }
    seen += num;
  }
  if (seen < total) GmshReaderFail(reader, "its blocks hold fewer elements than the file declares");
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GmshReadElements(GmshReader *reader)
{
  PetscFunctionBeginUser;
  if (reader->version > 40)
    PetscCall(ReadBlocks_Private(reader));
  else
    PetscCall(ReadRuns_Private(reader));
  PetscFunctionReturn(PETSC_SUCCESS);
}

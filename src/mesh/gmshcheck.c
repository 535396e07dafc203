/* gmshcheck.c -- a Gmsh file followed reference by reference before PETSc reads it.

   PETSc's reader indexes its arrays by the tags it finds: an element with a node that the file does not define, a
   block of an entity that does not exist, or counts that do not add up, end in a crash and not in a message. Formats
   2.2 and 4.1, ASCII and binary, as in the Gmsh reference manual, chapter "Gmsh file formats". */
#include "gmsh.h"
#include <mortise/compat.h>
#include <math.h>

enum {
  MAX_TAGS     = 64,        /* of an element */
  MAX_NODE_TAG = 100000000, /* PETSc makes a table of this length */
  NUM_TYPES    = 20
};

/* Dimension, order and number of nodes of Gmsh's element types below 20 (chapter "Node ordering"). */
static const struct {
  int dim, order, nodes;
} Type[NUM_TYPES] = {{0, 0, 0},  {1, 1, 2}, {2, 1, 3}, {2, 1, 4},  {3, 1, 4},  {3, 1, 8},  {3, 1, 6},
                     {3, 1, 5},  {1, 2, 3}, {2, 2, 6}, {2, 2, 9},  {3, 2, 10}, {3, 2, 27}, {3, 2, 18},
                     {3, 2, 14}, {0, 1, 1}, {2, 2, 8}, {3, 2, 20}, {3, 2, 15}, {3, 2, 13}};

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
  if (value < 0 || value > reader->size)
    GmshReaderFail(reader, "the number of %s is %lld, which cannot be", what, value);
  return reader->reason[0] ? 0 : (PetscInt)value;
}

/* Numbers whose values do not matter, so long as they are numbers. */
static void ReadNumbers_Private(GmshReader *reader, PetscInt num)
{
  for (PetscInt i = 0; i < num && !reader->reason[0]; ++i) {
    double value = 0;

    if (reader->binary ? fread(&value, sizeof(value), 1, reader->file) != 1
                       : fscanf(reader->file, "%lf", &value) != 1) {
      GmshReaderFail(reader, feof(reader->file) ? "it ends too early" : "there is text where a coordinate belongs");
    }
    if (!isfinite(value)) GmshReaderFail(reader, "a coordinate is not finite");
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

/* Entities exist in format 4.1 only: blocks of nodes and elements refer to them for their physical groups. */
PetscErrorCode GmshCheckEntities(GmshReader *reader)
{
  PetscInt num[4], total = 0;

  PetscFunctionBeginUser;
  for (PetscInt dim = 0; dim < 4; ++dim) total += num[dim] = ReadCount_Private(reader, "entities");
  PetscCall(PetscMalloc1(total, &reader->entities));
  for (PetscInt dim = 0; dim < 4; ++dim) {
    for (PetscInt i = 0; i < num[dim] && !reader->reason[0]; ++i) {
      reader->entities[reader->num_entities++] = 4 * (PetscInt)ReadTag_Private(reader) + dim;
      ReadNumbers_Private(reader, dim ? 6 : 3);               // a box, or a point
      for (PetscInt list = 0; list < (dim ? 2 : 1); ++list) { // physical tags, bounding entities
        for (PetscInt n = ReadCount_Private(reader, "tags of an entity"); n > 0 && !reader->reason[0]; --n) {
          (void)ReadTag_Private(reader);
        }
      }
    }
  }
  PetscCall(PetscSortInt(reader->num_entities, reader->entities));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The head of a block in format 4.1: dimension and tag of its entity. */
static PetscErrorCode ReadEntity_Private(GmshReader *reader, PetscInt64 *dim)
{
  PetscInt64 tag;
  PetscInt   at = -1;

  PetscFunctionBeginUser;
  *dim = ReadTag_Private(reader);
  tag  = ReadTag_Private(reader);
  if (reader->reason[0]) PetscFunctionReturn(PETSC_SUCCESS);
  if (*dim >= 0 && *dim < 4)
    PetscCall(PetscFindInt((PetscInt)(4 * tag + *dim), reader->num_entities, reader->entities, &at));
  if (at < 0) {
    GmshReaderFail(reader, "a block belongs to entity %lld of dimension %lld, which the file does not define",
                   (long long)tag, (long long)*dim);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The sorted tags are different, and small enough for a table. */
static PetscErrorCode NodesSort_Private(GmshReader *reader)
{
  const PetscInt num = reader->num_nodes;

  PetscFunctionBeginUser;
  PetscCall(PetscSortInt(num, reader->nodes));
  for (PetscInt i = 1; i < num; ++i) {
    if (reader->nodes[i] == reader->nodes[i - 1])
      GmshReaderFail(reader, "node %d is defined twice", (int)reader->nodes[i]);
  }
  if (num && (reader->nodes[0] < 0 || reader->nodes[num - 1] > MAX_NODE_TAG)) {
    GmshReaderFail(reader, "a node has the tag %d; tags from 0 to %d are accepted",
                   (int)(reader->nodes[0] < 0 ? reader->nodes[0] : reader->nodes[num - 1]), MAX_NODE_TAG);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Keeps the sorted tags, which elements are looked up in. */
PetscErrorCode GmshCheckNodes(GmshReader *reader)
{
  const PetscBool blocks     = reader->version > 40 ? PETSC_TRUE : PETSC_FALSE;
  const PetscInt  num_blocks = blocks ? ReadCount_Private(reader, "blocks of nodes") : 1;
  const PetscInt  total      = ReadCount_Private(reader, "nodes");

  PetscFunctionBeginUser;
  if (blocks) ReadRange_Private(reader);
  PetscCall(PetscMalloc1(total, &reader->nodes));
  for (PetscInt b = 0; b < num_blocks && !reader->reason[0]; ++b) {
    PetscInt   num = total;
    PetscInt64 dim;

    if (blocks) {
      PetscCall(ReadEntity_Private(reader, &dim));
      if (ReadTag_Private(reader))
        GmshReaderFail(reader, "its nodes have parametric coordinates, which cannot be read");
      num = ReadCount_Private(reader, "nodes of a block");
    }
    if (num > total - reader->num_nodes) GmshReaderFail(reader, "its blocks hold more nodes than the file declares");
    for (PetscInt i = 0; i < num && !reader->reason[0]; ++i) {
      reader->nodes[reader->num_nodes++] =
          (PetscInt)ReadInt_Private(reader, blocks ? (size_t)reader->data_size : sizeof(int));
      if (!blocks) ReadNumbers_Private(reader, 3);
    }
    if (blocks) ReadNumbers_Private(reader, 3 * num);
  }
  if (reader->num_nodes < total) GmshReaderFail(reader, "its blocks hold fewer nodes than the file declares");
  PetscCall(NodesSort_Private(reader));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A type of element that this version can use, or facets and points of any kind. */
static void CheckType_Private(GmshReader *reader, PetscInt64 type)
{
  if (reader->reason[0]) return;
  if (type < 1 || type >= NUM_TYPES) {
    GmshReaderFail(reader, "it holds elements of Gmsh's type %lld, which this version cannot use", (long long)type);
  } else if (Type[type].dim == 3) {
    GmshReaderFail(reader, "it holds three-dimensional cells, which this version cannot use; "
                           "plane meshes of triangles and quadrangles are accepted");
  } else if (Type[type].order > 1) {
    GmshReaderFail(reader,
                   "it holds cells of second order, which this version cannot use; meshes of first order are accepted");
  }
}

/* The nodes of one element. */
static PetscErrorCode CheckElement_Private(GmshReader *reader, PetscInt64 element, PetscInt64 type, size_t bytes)
{
  PetscFunctionBeginUser;
  for (int i = 0; !reader->reason[0] && i < Type[type].nodes; ++i) {
    const PetscInt64 node = ReadInt_Private(reader, bytes);
    PetscInt         at   = -1;

    if (reader->reason[0]) break;
    if (node >= 0 && node <= MAX_NODE_TAG)
      PetscCall(PetscFindInt((PetscInt)node, reader->num_nodes, reader->nodes, &at));
    if (at < 0) {
      GmshReaderFail(reader, "element %lld refers to node %lld, which the file does not define", (long long)element,
                     (long long)node);
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Format 2.2: every element with its own head; in binary files one head for a run of elements. */
static PetscErrorCode CheckRuns_Private(GmshReader *reader)
{
  const PetscInt num = ReadCount_Private(reader, "elements");

  PetscFunctionBeginUser;
  for (PetscInt e = 0; e < num && !reader->reason[0];) {
    PetscInt64       element  = reader->binary ? 0 : ReadTag_Private(reader);
    const PetscInt64 type     = ReadTag_Private(reader);
    PetscInt64       run      = reader->binary ? ReadTag_Private(reader) : 1;
    const PetscInt64 num_tags = ReadTag_Private(reader);

    CheckType_Private(reader, type);
    if (run < 1 || run > num - e || num_tags < 0 || num_tags > MAX_TAGS) {
      GmshReaderFail(reader, "element %d of %d cannot be read", (int)e + 1, (int)num);
    }
    for (; run > 0 && !reader->reason[0]; --run, ++e) {
      if (reader->binary) element = ReadTag_Private(reader);
      for (PetscInt64 i = 0; i < num_tags; ++i) (void)ReadTag_Private(reader);
      PetscCall(CheckElement_Private(reader, element, type, sizeof(int)));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Format 4.1: in blocks of one entity. */
static PetscErrorCode CheckBlocks_Private(GmshReader *reader)
{
  const PetscInt num_blocks = ReadCount_Private(reader, "blocks of elements");
  const PetscInt total      = ReadCount_Private(reader, "elements");
  PetscInt       seen       = 0;

  PetscFunctionBeginUser;
  ReadRange_Private(reader);
  for (PetscInt b = 0; b < num_blocks && !reader->reason[0]; ++b) {
    PetscInt64 dim, type;
    PetscInt   num;

    PetscCall(ReadEntity_Private(reader, &dim));
    type = ReadTag_Private(reader);
    num  = ReadCount_Private(reader, "elements of a block");
    CheckType_Private(reader, type);
    if (!reader->reason[0] && Type[type].dim != dim) {
      GmshReaderFail(reader, "elements of type %lld stand under an entity of dimension %lld", (long long)type,
                     (long long)dim);
    }
    if (num > total - seen) GmshReaderFail(reader, "its blocks hold more elements than the file declares");
    for (PetscInt e = 0; e < num && !reader->reason[0]; ++e) {
      const PetscInt64 element = ReadInt_Private(reader, (size_t)reader->data_size);

      PetscCall(CheckElement_Private(reader, element, type, (size_t)reader->data_size));
    }
    seen += num;
  }
  if (seen < total) GmshReaderFail(reader, "its blocks hold fewer elements than the file declares");
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GmshCheckElements(GmshReader *reader)
{
  PetscFunctionBeginUser;
  if (reader->version > 40)
    PetscCall(CheckBlocks_Private(reader));
  else
    PetscCall(CheckRuns_Private(reader));
  PetscFunctionReturn(PETSC_SUCCESS);
}

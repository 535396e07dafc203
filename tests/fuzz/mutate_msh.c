/* mutate_msh.c -- changes of a Gmsh file that leave most of it sound, for libFuzzer.

   Changed bytes end in the reader. Meshes reach what lies behind it: a file that can be read becomes a list of nodes and
   elements. One or a few of these are changed. The list is written again in any of the four formats (2.2 and 4.1, text and
   binary). Other files, and every third of these, are changed as texts or as bytes. */
#include "bodies/bodylist.h"
#include "gmsh/gmsh.h"
#include "gmsh/gmshtype.h"
#include "mutate.h"
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { MAX_NODES = 600, MAX_ELEMENTS = 500, MAX_OF_ELEMENT = 27, NUM_TYPES = 19, MAX_FILE = 1 << 16, ROUNDS = 4 };

typedef struct {
  int type, group, nodes[MAX_OF_ELEMENT]; /* in Gmsh's order */
} Element;

typedef struct {
  int     num_nodes, num_elements;
  double  x[MAX_NODES][3];
  Element element[MAX_ELEMENTS];
} Draft;

static Draft draft;

static int NumNodes_Private(int type)
{
  return (int)GmshTypeGet(type)->num_nodes;
}

static int Number_Private(const GmshType *type)
{
  int number = 1;

  while (GmshTypeGet(number) != type) ++number;
  return number;
}

/* Whether the bytes are a file that can be read, and is small enough. */
static int DraftRead_Private(const uint8_t *data, size_t size)
{
  char      reason[MESH_SENTENCE], path[64];
  GmshNames names;
  GmshMesh  mesh;
  FILE     *file;

  snprintf(path, sizeof(path), "/dev/shm/mortise-mutate-%d", (int)getpid());
  file = fopen(path, "wb");
  if (!file) return 0;
  fwrite(data, 1, size, file);
  fclose(file);
  if (GmshRead(path, &names, &mesh, reason, sizeof(reason))) return 0;
  unlink(path);
  draft.num_nodes    = (int)mesh.num_nodes;
  draft.num_elements = (int)mesh.num_elements;
  if (!reason[0] && draft.num_nodes > 0 && draft.num_nodes <= MAX_NODES && draft.num_elements <= MAX_ELEMENTS) {
    for (int n = 0; n < 3 * draft.num_nodes; ++n) draft.x[n / 3][n % 3] = mesh.coords[n];
    for (int e = 0; e < draft.num_elements; ++e) {
      const GmshType *type = mesh.type[e];

      draft.element[e].type  = Number_Private(type);
      draft.element[e].group = mesh.first_group[e] < mesh.end_group[e] ? (int)mesh.group[mesh.first_group[e]] : 0;
      for (int i = 0; i < type->num_nodes; ++i)
        draft.element[e].nodes[i] = (int)mesh.nodes[mesh.start[e] + (type->place ? type->place[i] : i)];
    }
  } else
    draft.num_nodes = 0;
  GmshMeshDestroy(&mesh);
  GmshNamesDestroy(&names);
  return draft.num_nodes > 0;
}

/* --- changes ---------------------------------------------------------------------------------------------------- */

static void ChangeNode_Private(void)
{
  static const double scales[] = {0, -1, 0.5, 1 + 1e-12, 1e-200, 1e-9, 1e9, 1e160, 1e300};
  double *const       x        = draft.x[Random(draft.num_nodes)];
  const double *const other    = draft.x[Random(draft.num_nodes)];
  const int           d        = Random(3);

  switch (Random(5)) {
  case 0: memcpy(x, other, sizeof(draft.x[0])); break;
  case 1: x[d] = other[d]; break;
  case 2: x[d] = (x[d] + other[Random(3)]) / 2; break;
  case 3: x[d] *= scales[Random(sizeof(scales) / sizeof(*scales))]; break;
  default:
    for (int n = 0; n < draft.num_nodes; ++n) draft.x[n][d] *= scales[Random(sizeof(scales) / sizeof(*scales) - 1)];
  }
}

/* An element with nodes of others, as many as its type has. */
static void SetNodes_Private(Element *element, int type)
{
  for (int i = element->type ? NumNodes_Private(element->type) : 0; i < NumNodes_Private(type); ++i)
    element->nodes[i] = Random(draft.num_nodes);
  element->type = type;
}

static void ChangeElement_Private(void)
{
  Element *const       e     = &draft.element[Random(draft.num_elements)];
  const Element *const other = &draft.element[Random(draft.num_elements)];
  const int            num = NumNodes_Private(e->type), i = Random(num), j = Random(num), node = e->nodes[i];

  switch (Random(8)) {
  case 0: e->nodes[i] = Random(draft.num_nodes); break;
  case 1: e->nodes[i] = other->nodes[Random(NumNodes_Private(other->type))]; break;
  case 2:
    e->nodes[i] = e->nodes[j];
    e->nodes[j] = node;
    break;
  case 3: e->nodes[i] = e->nodes[j]; break;
  case 4: SetNodes_Private(e, 1 + Random(NUM_TYPES)); break;
  case 5: e->group = other->group; break;
  case 6: e->group = RandomInteger(); break;
  default: *e = draft.element[--draft.num_elements];
  }
}

/* A copy of an element, a facet of one, a new one of any type, or all elements once more beside themselves. */
static void AddElement_Private(void)
{
  Element *const       e         = &draft.element[draft.num_elements];
  const Element *const other     = &draft.element[Random(draft.num_elements)];
  const int            old_nodes = draft.num_nodes, old = draft.num_elements, kind = Random(4);
  const ElementType    cell = GmshTypeGet(other->type)->cell;

  if (old == MAX_ELEMENTS) return;
  *e = *other;
  if (kind == 0) {
    SetNodes_Private(e, 1 + Random(NUM_TYPES));
  } else if (kind == 1 && cell != ELEMENT_COUNT && GmshTypeGet(other->type)->dim > 1) {
    const ElementType facet = ElementFacetType(ElementLinear(cell));
    const PetscInt   *local = ElementFacetNodes(ElementLinear(cell), Random((int)ElementNumFacets(cell)));

    e->type  = facet == ELEMENT_LINE2 ? 1 : facet == ELEMENT_TRI3 ? 2 : 3;
    e->group = RandomInteger();
    for (int i = 0; i < NumNodes_Private(e->type); ++i) e->nodes[i] = other->nodes[local[i]];
  } else if (kind == 2 && 2 * old <= MAX_ELEMENTS && 2 * old_nodes <= MAX_NODES) {
    for (int n = 0; n < old_nodes; ++n) {
      memcpy(draft.x[old_nodes + n], draft.x[n], sizeof(draft.x[0]));
      draft.x[old_nodes + n][1] += 1;
    }
    for (int n = 0; n < old; ++n) {
      draft.element[old + n] = draft.element[n];
      for (int i = 0; i < NumNodes_Private(draft.element[n].type); ++i) draft.element[old + n].nodes[i] += old_nodes;
    }
    draft.num_nodes *= 2;
    draft.num_elements *= 2;
    return;
  } else
    e->nodes[Random(NumNodes_Private(e->type))] = Random(draft.num_nodes);
  ++draft.num_elements;
}

/* --- writing ---------------------------------------------------------------------------------------------------- */

static int binary;

static void Ints_Private(FILE *file, int num, const int values[])
{
  if (binary)
    fwrite(values, sizeof(int), (size_t)num, file);
  else
    for (int i = 0; i < num; ++i) fprintf(file, "%d%c", values[i], i + 1 < num ? ' ' : '\n');
}

static void Sizes_Private(FILE *file, int num, const int values[])
{
  for (int i = 0; i < num; ++i) {
    const size_t value = (size_t)values[i];

    if (binary)
      fwrite(&value, sizeof(value), 1, file);
    else
      fprintf(file, "%zu%c", value, i + 1 < num ? ' ' : '\n');
  }
}

static void Reals_Private(FILE *file, int num, const double values[])
{
  if (binary)
    fwrite(values, sizeof(double), (size_t)num, file);
  else
    for (int i = 0; i < num; ++i) fprintf(file, "%.17g%c", values[i], i + 1 < num ? ' ' : '\n');
}

static void WriteOld_Private(FILE *file, int first)
{
  fprintf(file, "$Nodes\n%d\n", draft.num_nodes);
  for (int n = 0; n < draft.num_nodes; ++n) {
    const int tag = first + n;

    if (binary)
      Ints_Private(file, 1, &tag);
    else
      fprintf(file, "%d ", tag);
    Reals_Private(file, 3, draft.x[n]);
  }
  fprintf(file, "%s$EndNodes\n$Elements\n%d\n", binary ? "\n" : "", draft.num_elements);
  for (int e = 0; e < draft.num_elements; ++e) {
    const Element *element = &draft.element[e];
    const int      num     = NumNodes_Private(element->type);
    int            words[3 + 3 + MAX_OF_ELEMENT], used = 0;

    if (binary) Ints_Private(file, 3, (const int[]){element->type, 1, 2});
    words[used++] = e + 1;
    if (!binary) words[used++] = element->type;
    if (!binary) words[used++] = 2;
    words[used++] = element->group;
    words[used++] = 1;
    for (int i = 0; i < num; ++i) words[used++] = first + element->nodes[i];
    Ints_Private(file, used, words);
  }
  fprintf(file, "%s$EndElements\n", binary ? "\n" : "");
}

/* One entity for every element, which has its group. */
static void WriteNew_Private(FILE *file, int first)
{
  static const double box[6];
  int                 num[4] = {0, 0, 0, 0};

  for (int e = 0; e < draft.num_elements; ++e) ++num[GmshTypeGet(draft.element[e].type)->dim];
  fprintf(file, "$Entities\n");
  Sizes_Private(file, 4, num);
  for (int dim = 0; dim < 4; ++dim) {
    for (int e = 0; e < draft.num_elements; ++e) {
      const int tag = e + 1;

      if (GmshTypeGet(draft.element[e].type)->dim != dim) continue;
      Ints_Private(file, 1, &tag);
      Reals_Private(file, dim ? 6 : 3, box);
      Sizes_Private(file, 1, (const int[]){1});
      Ints_Private(file, 1, &draft.element[e].group);
      if (dim) Sizes_Private(file, 1, (const int[]){0});
    }
  }
  fprintf(file, "%s$EndEntities\n$Nodes\n", binary ? "\n" : "");
  Sizes_Private(file, 4, (const int[]){1, draft.num_nodes, first, first + draft.num_nodes - 1});
  if (draft.num_elements) Ints_Private(file, 3, (const int[]){(int)GmshTypeGet(draft.element[0].type)->dim, 1, 0});
  Sizes_Private(file, 1, &draft.num_nodes);
  for (int n = 0; n < draft.num_nodes; ++n) Sizes_Private(file, 1, (const int[]){first + n});
  Reals_Private(file, 3 * draft.num_nodes, draft.x[0]);
  fprintf(file, "%s$EndNodes\n$Elements\n", binary ? "\n" : "");
  Sizes_Private(file, 4, (const int[]){draft.num_elements, draft.num_elements, 1, draft.num_elements});
  for (int e = 0; e < draft.num_elements; ++e) {
    const Element *element = &draft.element[e];

    Ints_Private(file, 3, (const int[]){(int)GmshTypeGet(element->type)->dim, e + 1, element->type});
    Sizes_Private(file, 2, (const int[]){1, e + 1});
    for (int i = 0; i < NumNodes_Private(element->type); ++i)
      Sizes_Private(file, 1, (const int[]){first + element->nodes[i]});
  }
  fprintf(file, "%s$EndElements\n", binary ? "\n" : "");
}

static size_t DraftWrite_Private(uint8_t *data, size_t max_size, uint8_t last)
{
  static char text[MAX_FILE];
  const int   recent = Random(2), one = 1, first = Random(4) ? 1 : Random(100);
  FILE       *file = fmemopen(text, sizeof(text), "wb");
  long        size;

  if (!file) return 0;
  binary = Random(3) == 0;
  fprintf(file, "$MeshFormat\n%s %d 8\n", recent ? "4.1" : "2.2", binary);
  if (binary) {
    fwrite(&one, sizeof(one), 1, file);
    fputc('\n', file);
  }
  fprintf(file, "$EndMeshFormat\n");
  if (Random(2) && draft.num_elements) {
    const Element *e = &draft.element[Random(draft.num_elements)];

    fprintf(file, "$PhysicalNames\n1\n%d %d \"side\"\n$EndPhysicalNames\n", (int)GmshTypeGet(e->type)->dim, e->group);
  }
  if (recent)
    WriteNew_Private(file, first);
  else
    WriteOld_Private(file, first);
  fputc(last, file);
  fflush(file);
  size = ftell(file);
  fclose(file);
  if (size <= 0 || size >= MAX_FILE || (size_t)size > max_size) return 0;
  memcpy(data, text, (size_t)size);
  return (size_t)size;
}

/* --- what libFuzzer calls --------------------------------------------------------------------------------------- */

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed)
{
  size_t  written = 0;
  uint8_t last;

  RandomSeed(seed);
  last = size ? data[size - 1] : 0;
  if (Random(4) == 0) last ^= (uint8_t)(1 << Random(8));
  if (Random(3) && DraftRead_Private(data, size)) {
    for (int round = 1 + Random(ROUNDS); round > 0; --round) {
      const int what = Random(3);

      if (what == 0 || !draft.num_elements)
        ChangeNode_Private();
      else if (what == 1)
        ChangeElement_Private();
      else
        AddElement_Private();
    }
    written = DraftWrite_Private(data, max_size, last);
  }
  if (written) return written;
  return Random(2) ? MutateText(data, size, max_size) : LLVMFuzzerMutate(data, size, max_size);
}

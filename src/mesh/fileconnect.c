/* fileconnect.c -- neighbours of cells, and the physical groups of their facets.

   Facets of cells, and facets of a file in a group, are sent to the rank that is responsible for their lowest
   point. Facets with the same corners are matched there. */
#include "base/compat.h"
#include "level/exchange.h"
#include "mesh/filecells.h"
#include "mesh/fileconnect.h"
#include <stdlib.h>

enum { CORNERS = 4, NO_CELL = -1, OF_NO_BODY = -2 };

typedef struct {
  PetscInt
      key[CORNERS]; /* corners, the same for all that have them; -1 for those that triangles and edges do not have */
  PetscInt  at;     /* index among the received records */
  PetscInt  cell, body; /* NO_CELL for a facet of the file; OF_NO_BODY */
  PetscInt  sense;      /* whether a cell has the corners in the order of the key */
  PetscInt  group, group_end;
  PetscReal middle[3];
} FacetRecord;

typedef struct {
  PetscInt  neighbour, group, group_end;
  PetscReal distance;
} FacetAnswer;

/* Whether the corners are in the order of their key, or in the reverse. [out] key - [CORNERS] */
static PetscInt FacetGetKey_Private(PetscInt num, const PetscInt corners[], PetscInt key[])
{
  PetscInt low = 0, next, last;

  for (PetscInt i = 1; i < num; i++)
    if (corners[i] < corners[low]) low = i;
  next   = corners[(low + 1) % num];
  last   = corners[(low + num - 1) % num];
  key[0] = corners[low];
  key[1] = PetscMin(next, last);
  key[2] = num > 2 ? PetscMax(next, last) : -1;
  key[3] = num > 3 ? corners[(low + 2) % num] : -1;
  return num > 2 ? next < last : low == 0;
}

static int FacetCompareFn(const void *a, const void *b)
{
  const FacetRecord *x = (const FacetRecord *)a, *y = (const FacetRecord *)b;

  for (PetscInt i = 0; i < CORNERS; i++)
    if (x->key[i] != y->key[i]) return x->key[i] < y->key[i] ? -1 : 1;
  return x->at < y->at ? -1 : 1;
}

/* The records of this rank: of facets of cells, cell after cell, then of those of files.
   [out] record - freed by the caller */
static PetscErrorCode RecordsCreate_Private(const Files *files, const FileCells *cells, PetscInt *num,
                                            FacetRecord **record)
{
  PetscInt max = FILE_FACETS * cells->num, key[CORNERS];

  PetscFunctionBeginUser;
  for (PetscInt f = 0; f < files->num; f++) max += files->part[f].mesh.num_elements;
  PetscCall(PetscMalloc1(max, record));
  *num = 0;
  for (PetscInt c = 0, used = 0; c < cells->num; c++) {
    const ElementType type = ElementLinear((ElementType)cells->type[c]);

    for (PetscInt f = 0; f < ElementNumFacets(type); f++) {
      const PetscInt corners = ElementNumNodes(ElementFacetType(type)), *local = ElementFacetNodes(type, f);
      FacetRecord   *r = &(*record)[(*num)++];

      for (PetscInt i = 0; i < corners; i++) key[i] = cells->nodes[c * cells->max_nodes + local[i]];
      *r       = (FacetRecord){.cell = cells->body[c] < 0 ? OF_NO_BODY : cells->first + used, .body = cells->body[c]};
      r->sense = FacetGetKey_Private(corners, key, r->key) ^ cells->reversed[c];
      for (PetscInt d = 0; d < 3; d++) r->middle[d] = cells->middle[3 * c + d];
    }
    used += cells->body[c] >= 0;
  }
  for (PetscInt f = 0; f < files->num; f++) {
    const GmshMesh *mesh = &files->part[f].mesh;

    for (PetscInt e = 0; e < mesh->num_elements; e++) {
      const PetscInt corners = GmshNumCorners(mesh, e);
      FacetRecord   *r       = &(*record)[*num];

      if (mesh->type[e]->dim != files->dim - 1 || mesh->first_group[e] == mesh->end_group[e]) continue;
      *r = (FacetRecord){.cell = NO_CELL, .body = -1, .group = mesh->first_group[e], .group_end = mesh->end_group[e]};
      for (PetscInt i = 0; i < corners; i++) key[i] = files->first_point[f] + mesh->nodes[mesh->start[e] + i];
      r->sense = FacetGetKey_Private(corners, key, r->key);
      ++*num;
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Answers to records with the same corners. Returns whether they are valid. Valid are at most two cells, on
   opposite sides if of one body, and at most one facet of the file, with a cell. [in] record - [num] */
static PetscBool RecordsMatch_Private(PetscInt num, const FacetRecord record[], FacetAnswer answer[])
{
  const FacetRecord *cell[2] = {NULL, NULL}, *facet = NULL;
  PetscInt           cells = 0, facets = 0;
  PetscBool          joined;

  for (PetscInt i = 0; i < num; i++) {
    if (record[i].cell == NO_CELL) {
      facet = &record[i];
      facets++;
    } else {
      cell[cells++ % 2] = &record[i];
    }
  }
  if (!cells || cells > 2 || facets > 1) return PETSC_FALSE;
  joined = (PetscBool)(cells == 2 && cell[0]->body == cell[1]->body && cell[0]->body >= 0);
  if (joined && cell[0]->sense == cell[1]->sense) return PETSC_FALSE;
  for (PetscInt k = 0; k < cells; k++) {
    PetscReal square = 0;

    for (PetscInt d = 0; d < 3 && joined; d++) square += PetscSqr(cell[0]->middle[d] - cell[1]->middle[d]);
    answer[cell[k]->at] = (FacetAnswer){.neighbour = joined ? cell[1 - k]->cell : -1,
                                        .group     = facet ? facet->group : -1,
                                        .group_end = facet ? facet->group_end : -1,
                                        .distance  = PetscSqrtReal(square)};
  }
  return PETSC_TRUE;
}

/* Enters the answers into the cells of this rank. Cells of no body are removed. */
static PetscErrorCode FileCellsTake_Private(const FacetAnswer answer[], FileCells *cells)
{
  PetscInt kept = 0, at = 0;

  PetscFunctionBeginUser;
  for (PetscInt c = 0; c < cells->num; c++) {
    const PetscInt num = ElementNumFacets((ElementType)cells->type[c]);

    at += num;
    if (cells->body[c] < 0) continue;
    cells->body[kept]       = cells->body[c];
    cells->material[kept]   = cells->material[c];
    cells->type[kept]       = cells->type[c];
    cells->file_nodes[kept] = cells->file_nodes[c];
    cells->reversed[kept]   = cells->reversed[c];
    PetscCall(
        PetscArraymove(&cells->nodes[kept * cells->max_nodes], &cells->nodes[c * cells->max_nodes], cells->max_nodes));
    PetscCall(PetscArraymove(&cells->middle[3 * kept], &cells->middle[3 * c], 3));
    for (PetscInt f = 0; f < num; f++) {
      const FacetAnswer *a = &answer[at - num + f];

      cells->neighbour[kept * FILE_FACETS + f] = a->neighbour;
      cells->group[kept * FILE_FACETS + f]     = a->group;
      cells->group_end[kept * FILE_FACETS + f] = a->group_end;
      cells->distance[kept * FILE_FACETS + f]  = a->distance;
    }
    kept++;
  }
  cells->num = kept;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Answers of this rank. [in,out] record - received ones, sorted here [num] */
static PetscBool RecordsAnswer_Private(PetscInt num, FacetRecord record[], FacetAnswer answer[])
{
  PetscBool good = PETSC_TRUE;

  for (PetscInt i = 0; i < num; i++) record[i].at = i;
  for (PetscInt i = 0; i < num; i++) answer[i] = (FacetAnswer){.neighbour = -1, .group = -1, .group_end = -1};
  if (num) qsort(record, (size_t)num, sizeof(*record), FacetCompareFn);
  for (PetscInt begin = 0, end; begin < num; begin = end) {
    PetscBool same = PETSC_TRUE;

    for (end = begin + 1; end < num && same; end += same) {
      for (PetscInt i = 0; i < CORNERS; i++) same = (PetscBool)(same && record[begin].key[i] == record[end].key[i]);
    }
    good = (PetscBool)(RecordsMatch_Private(end - begin, &record[begin], answer) && good);
  }
  return good;
}

PetscErrorCode FileCellsConnect(const Files *files, FileCells *cells, PetscBool *good)
{
  PetscInt     num, used = 0;
  PetscMPIInt *rank;
  FacetRecord *own, *record;
  FacetAnswer *answer, *heard;
  Exchange     exchange;

  PetscFunctionBeginUser;
  for (PetscInt c = 0; c < cells->num; c++) used += cells->body[c] >= 0;
  PetscCallMPI(MPI_Scan(&used, &cells->first, 1, MPIU_INT, MPI_SUM, files->comm));
  cells->first -= used;
  PetscCallMPI(MPI_Allreduce(&used, &cells->total, 1, MPIU_INT, MPI_SUM, files->comm));
  PetscCall(RecordsCreate_Private(files, cells, &num, &own));
  PetscCall(PetscMalloc1(num, &rank));
  for (PetscInt i = 0; i < num; i++)
    rank[i] = (PetscMPIInt)((PetscInt64)own[i].key[0] * files->size / PetscMax(files->num_points, 1));
  PetscCall(ExchangeCreate(files->comm, num, rank, &exchange));
  PetscCall(PetscFree(rank));
  PetscCall(PetscMalloc1(exchange.num, &record));
  PetscCall(ExchangeSend(&exchange, sizeof(*record), own, record));
  PetscCall(PetscFree(own));
  PetscCall(PetscMalloc1(exchange.num, &answer));
  if (!RecordsAnswer_Private(exchange.num, record, answer)) *good = PETSC_FALSE;
  PetscCall(PetscFree(record));
  PetscCall(PetscMalloc1(num, &heard));
  PetscCall(ExchangeAnswer(&exchange, sizeof(*answer), answer, heard));
  PetscCall(PetscFree(answer));
  PetscCall(ExchangeDestroy(&exchange));
  PetscCall(FileCellsTake_Private(heard, cells));
  PetscCall(PetscFree(heard));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, good, 1, MPIU_BOOL, MPI_LAND, files->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscBool FileCellsHasSide(const Files *files, const FileCells *cells, PetscInt cell, PetscInt facet, PetscInt tag)
{
  const PetscInt *group = files->part[files->of_body[cells->body[cell]]].mesh.group;

  for (PetscInt g = cells->group[cell * FILE_FACETS + facet]; g < cells->group_end[cell * FILE_FACETS + facet]; g++)
    if (group[g] == tag) return PETSC_TRUE;
  return PETSC_FALSE;
}

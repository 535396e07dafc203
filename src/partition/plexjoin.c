/* plexjoin.c -- joins parts of a mesh on several ranks to one DMPlex.

   Vertices, edges and facets on the boundary of a part are sent to the rank that is responsible for their
   lowest vertex. Of those with the same vertices that of the highest rank is the owner.
   (DMPlexInterpolatePointSF() of PETSc 3.18 misses facets of solids.) */
#include "base/compat.h"
#include "level/exchange.h"
#include "level/plexpoints.h"
#include "partition/plexjoin.h"
#include <petscbt.h>
#include <petscsf.h>
#include <stdlib.h>

enum { CORNERS = 4 };

typedef struct {
  PetscInt key[CORNERS]; /* ids of vertices, ascending; -1 for none */
  PetscInt rank, point, at;
} PointRecord;

typedef struct {
  PetscInt rank, point; /* owner */
} PointAnswer;

static int PointCompareFn(const void *a, const void *b)
{
  const PointRecord *x = (const PointRecord *)a, *y = (const PointRecord *)b;

  for (PetscInt i = 0; i < CORNERS; i++)
    if (x->key[i] != y->key[i]) return x->key[i] < y->key[i] ? -1 : 1;
  return x->rank < y->rank ? 1 : -1; // the first record is that of the owner
}

/* Marks the facets with a single cell of this rank, and their edges and vertices.
   [out] mark - [end of the chart], freed by the caller */
static PetscErrorCode BoundaryMark_Private(DM dm, PetscBT *mark, PetscInt *num)
{
  PetscInt begin, end, chart, size, *closure = NULL;

  PetscFunctionBeginUser;
  *num = 0;
  PetscCall(DMPlexGetChart(dm, NULL, &chart));
  PetscCall(PetscBTCreate(chart, mark));
  PetscCall(DMPlexGetHeightStratum(dm, 1, &begin, &end));
  for (PetscInt f = begin; f < end; f++) {
    PetscCall(DMPlexGetSupportSize(dm, f, &size));
    if (size != 1) continue;
    PetscCall(DMPlexGetTransitiveClosure(dm, f, PETSC_TRUE, &size, &closure));
    for (PetscInt i = 0; i < size; i++) *num += !PetscBTLookupSet(*mark, closure[2 * i]);
    PetscCall(DMPlexRestoreTransitiveClosure(dm, f, PETSC_TRUE, &size, &closure));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* [out] record - freed by the caller [num] */
static PetscErrorCode PointRecordsCreate_Private(DM dm, const PetscInt ids[], PetscInt *num, PointRecord **record)
{
  PetscInt    chart, first, kept = 0;
  PetscMPIInt rank;
  PetscBT     mark;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PetscObjectComm((PetscObject)dm), &rank));
  PetscCall(BoundaryMark_Private(dm, &mark, num));
  PetscCall(DMPlexGetChart(dm, NULL, &chart));
  PetscCall(DMPlexGetDepthStratum(dm, 0, &first, NULL));
  PetscCall(PetscMalloc1(*num, record));
  for (PetscInt p = 0; p < chart; p++) {
    PointRecord *r = &(*record)[kept];
    PetscInt     size, vertices[ELEMENT_MAX_NODES];

    if (!PetscBTLookup(mark, p)) continue;
    PetscCall(PointGetVertices(dm, p, &size, vertices));
    for (PetscInt i = 0; i < size; i++) vertices[i] = ids[vertices[i] - first];
    PetscCall(PetscSortInt(size, vertices));
    *r = (PointRecord){.rank = rank, .point = p, .at = kept++};
    for (PetscInt i = 0; i < CORNERS; i++) r->key[i] = i < size ? vertices[i] : -1;
  }
  PetscCall(PetscBTDestroy(&mark));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* [in,out] record - received ones, sorted here [num] */
static void PointRecordsAnswer_Private(PetscInt num, PointRecord record[], PointAnswer answer[])
{
  for (PetscInt i = 0; i < num; i++) record[i].at = i;
  if (num) qsort(record, (size_t)num, sizeof(*record), PointCompareFn);
  for (PetscInt i = 0, owner = 0; i < num; i++) {
    for (PetscInt k = 0; k < CORNERS; k++)
      if (record[i].key[k] != record[owner].key[k]) owner = i;
    answer[record[i].at] = (PointAnswer){record[owner].rank, record[owner].point};
  }
}

PetscErrorCode PlexJoin(DM dm, PetscInt num_ids, const PetscInt ids[])
{
  const MPI_Comm comm = PetscObjectComm((PetscObject)dm);
  PetscInt       num, chart, kept = 0, dim, *leaves;
  PetscMPIInt   *to, rank, size;
  PointRecord   *own, *record;
  PointAnswer   *answer, *heard;
  PetscSFNode   *nodes;
  Exchange       exchange;
  PetscSF        sf;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(PointRecordsCreate_Private(dm, ids, &num, &own));
  PetscCall(PetscMalloc1(num, &to));
  for (PetscInt i = 0; i < num; i++) to[i] = (PetscMPIInt)((PetscInt64)own[i].key[0] * size / num_ids);
  PetscCall(ExchangeCreate(comm, num, to, &exchange));
  PetscCall(PetscMalloc2(exchange.num, &record, exchange.num, &answer));
  PetscCall(ExchangeSend(&exchange, sizeof(*own), own, record));
  PointRecordsAnswer_Private(exchange.num, record, answer);
  PetscCall(PetscMalloc1(num, &heard));
  PetscCall(ExchangeAnswer(&exchange, sizeof(*answer), answer, heard));
  PetscCall(PetscMalloc1(num, &leaves));
  PetscCall(PetscMalloc1(num, &nodes));
  for (PetscInt i = 0; i < num; i++) {
    if (heard[i].rank == rank) continue;
    leaves[kept]  = own[i].point;
    nodes[kept++] = (PetscSFNode){.rank = heard[i].rank, .index = heard[i].point};
  }
  PetscCall(DMPlexGetChart(dm, NULL, &chart));
  PetscCall(DMGetPointSF(dm, &sf));
  PetscCall(PetscSFSetGraph(sf, chart, kept, leaves, PETSC_OWN_POINTER, nodes, PETSC_OWN_POINTER));
  PetscCall(DMGetDimension(dm, &dim));
  PetscCall(PlexOrientShared(dm, dim));
  PetscCall(ExchangeDestroy(&exchange));
  PetscCall(PetscFree2(record, answer));
  PetscCall(PetscFree(heard));
  PetscCall(PetscFree(own));
  PetscCall(PetscFree(to));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PlexOrientShared(DM dm, PetscInt dim)
{
  PetscBool *shared;

  PetscFunctionBeginUser;
  PetscCall(PointsMarkShared(dm, &shared));
  for (PetscInt depth = 1; depth < dim; depth++) {
    PetscInt begin, end;

    PetscCall(DMPlexGetDepthStratum(dm, depth, &begin, &end));
    for (PetscInt p = begin; p < end; p++) {
      PetscInt       num, own[ELEMENT_MAX_NODES], wanted[ELEMENT_MAX_NODES], lowest = 0, step, orientation;
      DMPolytopeType type;

      if (!shared[p]) continue;
      PetscCall(PointGetVertices(dm, p, &num, own));
      for (PetscInt i = 1; i < num; i++)
        if (own[i] < own[lowest]) lowest = i;
      step = own[(lowest + 1) % num] <= own[(lowest + num - 1) % num] ? 1 : num - 1;
      for (PetscInt i = 0; i < num; i++) wanted[i] = own[(lowest + i * step) % num];
      PetscCall(DMPlexGetCellType(dm, p, &type));
      PetscCall(DMPolytopeGetVertexOrientation(type, own, wanted, &orientation));
      PetscCall(DMPlexOrientPoint(dm, p, orientation));
    }
  }
  PetscCall(PetscFree(shared));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets of cells that this rank's facets join.
   [out] label - of each cell, the lowest cell of its set [cells] */
static PetscErrorCode CellsJoin_Private(DM dm, PetscInt label[])
{
  PetscInt begin, end, first, last;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetHeightStratum(dm, 0, &first, &last));
  PetscCall(DMPlexGetHeightStratum(dm, 1, &begin, &end));
  for (PetscInt c = 0; c < last - first; c++) label[c] = c;
  for (PetscInt f = begin; f < end; f++) {
    const PetscInt *support;
    PetscInt        size, root[2];

    PetscCall(DMPlexGetSupportSize(dm, f, &size));
    PetscCall(DMPlexGetSupport(dm, f, &support));
    if (size != 2) continue;
    for (PetscInt i = 0; i < 2; i++) {
      root[i] = support[i] - first;
      while (label[root[i]] != root[i]) root[i] = label[root[i]] = label[label[root[i]]];
    }
    label[PetscMax(root[0], root[1])] = PetscMin(root[0], root[1]);
  }
  for (PetscInt c = 0; c < last - first; c++) label[c] = label[label[c]]; // the root of a set is before its cells
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Each set takes the lowest number of all sets joined to it by facets of several ranks, until no number
   changes. Collective.
   [in,out] number - of each set at its lowest cell; [in] label - as CellsJoin_Private() has it */
static PetscErrorCode SetsJoin_Private(DM dm, const PetscInt label[], PetscInt number[])
{
  PetscInt  begin, end, first, chart, *lowest;
  PetscBool changed = PETSC_TRUE;
  PetscSF   sf;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetChart(dm, NULL, &chart));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &first, NULL));
  PetscCall(DMPlexGetHeightStratum(dm, 1, &begin, &end));
  PetscCall(DMGetPointSF(dm, &sf));
  PetscCall(PetscMalloc1(chart, &lowest));
  while (changed) {
    changed = PETSC_FALSE;
    for (PetscInt p = 0; p < chart; p++) lowest[p] = PETSC_MAX_INT;
    for (PetscInt pass = 0; pass < 2; pass++) {
      for (PetscInt f = begin; f < end; f++) {
        const PetscInt *support;
        PetscInt       *own;

        PetscCall(DMPlexGetSupport(dm, f, &support));
        own = &number[label[support[0] - first]];
        if (pass && lowest[f] < *own) {
          *own    = lowest[f];
          changed = PETSC_TRUE;
        }
        lowest[f] = *own;
      }
      if (pass) break;
      PetscCall(PetscSFReduceBegin(sf, MPIU_INT, lowest, lowest, MPI_MIN));
      PetscCall(PetscSFReduceEnd(sf, MPIU_INT, lowest, lowest, MPI_MIN));
      PetscCall(PetscSFBcastBegin(sf, MPIU_INT, lowest, lowest, MPI_REPLACE));
      PetscCall(PetscSFBcastEnd(sf, MPIU_INT, lowest, lowest, MPI_REPLACE));
    }
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &changed, 1, MPIU_BOOL, MPI_LOR, PetscObjectComm((PetscObject)dm)));
  }
  PetscCall(PetscFree(lowest));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PlexCountComponents(DM dm, PetscInt *num)
{
  const MPI_Comm comm = PetscObjectComm((PetscObject)dm);
  PetscInt       begin, end, before, own, *label, *number;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetHeightStratum(dm, 0, &begin, &end));
  own = end - begin;
  PetscCallMPI(MPI_Scan(&own, &before, 1, MPIU_INT, MPI_SUM, comm));
  before -= own;
  PetscCall(PetscMalloc2(own, &label, own, &number));
  PetscCall(CellsJoin_Private(dm, label));
  for (PetscInt c = 0; c < own; c++) number[c] = before + c;
  PetscCall(SetsJoin_Private(dm, label, number));
  *num = 0;
  for (PetscInt c = 0; c < own; c++) *num += label[c] == c && number[c] == before + c;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, num, 1, MPIU_INT, MPI_SUM, comm));
  PetscCall(PetscFree2(label, number));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* picture.c -- gathers nodes, cells and fields of all ranks on the first one.

   One file of one writer is simple, portable and fast enough up to tens of millions of values; global nodes are numbered
   rank by rank, so gathering in the order of the ranks gives the global order. */
#include <string.h>
#include "picture.h"
#include <mortise/compat.h>

static PetscErrorCode Gather_Private(MPI_Comm comm, MPI_Datatype type, size_t size, PetscInt n, const void *mine,
                                     PetscInt *total, void **all)
{
  PetscMPIInt ranks, rank, count, *counts = NULL, *starts = NULL;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(comm, &ranks));
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCall(PetscMPIIntCast(n, &count));
  if (rank == 0) PetscCall(PetscCalloc2(ranks, &counts, ranks + 1, &starts));
  PetscCallMPI(MPI_Gather(&count, 1, MPI_INT, counts, 1, MPI_INT, 0, comm));
  *all = NULL;
  if (total) *total = 0;
  if (rank == 0) {
    for (PetscMPIInt r = 0; r < ranks; ++r) starts[r + 1] = starts[r] + counts[r];
    PetscCall(PetscMalloc(PetscMax((size_t)starts[ranks], 1) * size, all));
    if (total) *total = starts[ranks];
  }
  PetscCallMPI(MPI_Gatherv(mine, count, type, *all, counts, starts, type, 0, comm));
  if (rank == 0) PetscCall(PetscFree2(counts, starts));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GatherReals(MPI_Comm comm, PetscInt n, const PetscReal mine[], PetscInt *total, PetscReal **all)
{
  void *result;

  PetscFunctionBeginUser;
  PetscCall(Gather_Private(comm, MPIU_REAL, sizeof(PetscReal), n, mine, total, &result));
  *all = (PetscReal *)result;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GatherInts(MPI_Comm comm, PetscInt n, const PetscInt mine[], PetscInt *total, PetscInt **all)
{
  void *result;

  PetscFunctionBeginUser;
  PetscCall(Gather_Private(comm, MPIU_INT, sizeof(PetscInt), n, mine, total, &result));
  *all = (PetscInt *)result;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Gathers [num_owned][from] values as [num_points][to]; vectors of the plane get a third component 0. */
static PetscErrorCode GatherNodes_Private(const Level *level, PetscInt from, PetscInt to, const PetscReal mine[],
                                          PetscReal **all)
{
  PetscReal *padded;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(level->num_owned * to, &padded));
  for (PetscInt a = 0; a < level->num_owned; ++a) {
    for (PetscInt k = 0; k < PetscMin(from, to); ++k) padded[a * to + k] = mine[a * from + k];
  }
  PetscCall(GatherReals(level->comm, level->num_owned * to, padded, NULL, all));
  PetscCall(PetscFree(padded));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Nodes of one cell in the order of viewers: that of element.h, but for the middles of facets of hex27. */
static void PictureOrder_Private(ElementType type, const PetscInt nodes[], PetscInt ordered[])
{
  /* left, right, front, back, below, above among below, above, front, right, back, left */
  static const PetscInt facet[6] = {5, 3, 2, 4, 0, 1};
  const PetscInt        size = ElementNumNodes(type), first = type == ELEMENT_HEX27 ? size - 7 : size;

  for (PetscInt i = 0; i < size; ++i) ordered[i] = nodes[i >= first && i < size - 1 ? first + facet[i - first] : i];
}

/* Cells of all ranks with global nodes, sorted by type (stable, by counting). */
static PetscErrorCode PictureCells_Private(const Level *level, Picture *picture)
{
  PetscInt *nodes, *all_nodes, *all_types, *all_bodies, *starts, num_cells, num_entries, n = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(level->cell_start[level->num_cells], &nodes));
  for (PetscInt i = 0; i < level->cell_start[level->num_cells]; ++i)
    nodes[i] = level->node_global[level->cell_nodes[i]];
  PetscCall(GatherInts(level->comm, level->cell_start[level->num_cells], nodes, &num_entries, &all_nodes));
  PetscCall(GatherInts(level->comm, level->num_cells, level->cell_type, &num_cells, &all_types));
  PetscCall(GatherInts(level->comm, level->num_cells, level->cell_body, NULL, &all_bodies));
  PetscCall(PetscFree(nodes));
  picture->num_cells = num_cells;
  PetscCall(PetscMalloc4(num_cells + 1, &picture->cell_start, num_entries, &picture->cell_nodes, num_cells,
                         &picture->cell_type, num_cells, &picture->cell[0].values));
  PetscCall(PetscMalloc1(num_cells + 1, &starts));
  starts[0] = picture->cell_start[0] = 0;
  for (PetscInt c = 0; c < num_cells; ++c) starts[c + 1] = starts[c] + ElementNumNodes((ElementType)all_types[c]);
  for (PetscInt type = 0; type < ELEMENT_COUNT; ++type) {
    for (PetscInt c = 0; c < num_cells; ++c) {
      const PetscInt size = starts[c + 1] - starts[c];

      if (all_types[c] != type) continue;
      PictureOrder_Private((ElementType)type, &all_nodes[starts[c]], &picture->cell_nodes[picture->cell_start[n]]);
      picture->cell_start[n + 1]   = picture->cell_start[n] + size;
      picture->cell_type[n]        = type;
      picture->cell[0].values[n++] = (PetscReal)all_bodies[c];
    }
  }
  picture->cell[0] = (PictureArray){"body", 1, PETSC_TRUE, picture->cell[0].values};
  PetscCall(PetscFree(starts));
  PetscCall(PetscFree(all_nodes));
  PetscCall(PetscFree(all_types));
  PetscCall(PetscFree(all_bodies));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Pressure, gap and status of all pairs at once: a node in several pairs shows the sum of its pressures, the smallest gap,
   and the closest status. */
static PetscErrorCode PictureContact_Private(Fields fields, Picture *picture)
{
  const Level *level = fields->vi->level;
  PetscReal   *merged[3];

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc3(level->num_owned, &merged[0], level->num_owned, &merged[1], level->num_owned, &merged[2]));
  for (PetscInt a = 0; a < level->num_owned; ++a) {
    merged[1][a] = NAN;
    merged[2][a] = STATUS_NONE;
  }
  for (PetscInt p = 0; p < fields->vi->num_pairs; ++p) {
    PairFields nodal;

    PetscCall(PairFieldsCreate(fields, p, &nodal));
    for (PetscInt a = 0; a < level->num_owned; ++a) {
      merged[0][a] += nodal.pressure[a];
      merged[1][a] = fmin(merged[1][a], nodal.gap[a]); /* the number where only one is */
      merged[2][a] = PetscMax(merged[2][a], (PetscReal)nodal.status[a]);
    }
    PetscCall(PairFieldsDestroy(&nodal));
  }
  for (PetscInt i = 0; i < 3; ++i)
    PetscCall(GatherNodes_Private(level, 1, 1, merged[i], &picture->point[3 + i].values));
  PetscCall(PetscFree3(merged[0], merged[1], merged[2]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Stress as a full 3 x 3 tensor: viewers name its nine components by themselves, while for six each has an order of
   its own. Von Mises stress beside it. */
static PetscErrorCode PictureStress_Private(Fields fields, Picture *picture)
{
  static const PetscInt voigt[9] = {0, 5, 4, 5, 1, 3, 4, 3, 2}; /* xx,yy,zz,yz,xz,xy to rows of the tensor */
  const Level          *level    = fields->vi->level;
  const PetscReal      *stress;
  PetscReal            *tensor, *mises;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(level->num_owned * 9, &tensor, level->num_owned, &mises));
  PetscCall(VecGetArrayRead(fields->stress, &stress));
  for (PetscInt a = 0; a < level->num_owned; ++a) {
    for (PetscInt k = 0; k < 9; ++k) tensor[a * 9 + k] = stress[a * 6 + voigt[k]];
    mises[a] = MaterialVonMises(&stress[a * 6]);
  }
  PetscCall(VecRestoreArrayRead(fields->stress, &stress));
  PetscCall(GatherNodes_Private(level, 9, 9, tensor, &picture->point[1].values));
  PetscCall(GatherNodes_Private(level, 1, 1, mises, &picture->point[2].values));
  PetscCall(PetscFree2(tensor, mises));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PictureCreate(Fields fields, Picture *picture)
{
  static const PictureArray arrays[PICTURE_POINT_ARRAYS] = {
      {"displacement", 3, PETSC_FALSE, NULL}, {"stress", 9, PETSC_FALSE, NULL}, {"von_mises", 1, PETSC_FALSE, NULL},
      {"pressure", 1, PETSC_FALSE, NULL},     {"gap", 1, PETSC_FALSE, NULL},    {"status", 1, PETSC_TRUE, NULL}};
  const Level     *level = fields->vi->level;
  const PetscReal *u;
  PetscMPIInt      rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(level->comm, &rank));
  PetscCall(PetscMemzero(picture, sizeof(*picture)));
  picture->title      = fields->vi->scene->title;
  picture->num_points = rank == 0 ? level->num_global : 0;
  memcpy(picture->point, arrays, sizeof(arrays));
  PetscCall(GatherNodes_Private(level, level->dim, 3, level->coords, &picture->points));
  PetscCall(PictureCells_Private(level, picture));
  PetscCall(VecGetArrayRead(fields->u, &u));
  PetscCall(GatherNodes_Private(level, level->dim, 3, u, &picture->point[0].values));
  PetscCall(VecRestoreArrayRead(fields->u, &u));
  PetscCall(PictureStress_Private(fields, picture));
  PetscCall(PictureContact_Private(fields, picture));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PictureDestroy(Picture *picture)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(picture->points));
  PetscCall(PetscFree4(picture->cell_start, picture->cell_nodes, picture->cell_type, picture->cell[0].values));
  for (PetscInt i = 0; i < PICTURE_POINT_ARRAYS; ++i) PetscCall(PetscFree(picture->point[i].values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

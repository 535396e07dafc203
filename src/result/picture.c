/* picture.c -- gathers nodes, cells and fields of all ranks on the first one.

   One file of one writer is simple, portable and fast enough up to tens of millions of values; global nodes are numbered
   rank by rank, so gathering in the order of the ranks gives the global order. */
#include <string.h>
#include "picture.h"
#include <mortise/compat.h>

/* Quantities of the bodies, in the order of the files; pressure, gap and status follow each other. */
enum {
  POINT_DISPLACEMENT,
  POINT_STRESS,
  POINT_MISES,
  POINT_PRINCIPAL,
  POINT_PRESSURE,
  POINT_GAP,
  POINT_STATUS,
  POINT_COUNT
};

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

PetscErrorCode PictureGatherCells(MPI_Comm comm, const PictureCells *cells, Picture *picture, PetscReal **tags)
{
  PetscInt *all_nodes, *all_types, *all_tags, *starts, num_cells, num_entries, size = 0, n = 0;

  PetscFunctionBeginUser;
  for (PetscInt c = 0; c < cells->num; ++c) size += ElementNumNodes((ElementType)cells->type[c]);
  PetscCall(GatherInts(comm, size, cells->nodes, &num_entries, &all_nodes));
  PetscCall(GatherInts(comm, cells->num, cells->type, &num_cells, &all_types));
  PetscCall(GatherInts(comm, cells->num, cells->tag, NULL, &all_tags));
  picture->num_cells = num_cells;
  PetscCall(PetscMalloc3(num_cells + 1, &picture->cell_start, num_entries, &picture->cell_nodes, num_cells,
                         &picture->cell_type));
  PetscCall(PetscMalloc1(num_cells, tags));
  PetscCall(PetscMalloc1(num_cells + 1, &starts));
  starts[0] = picture->cell_start[0] = 0;
  for (PetscInt c = 0; c < num_cells; ++c) starts[c + 1] = starts[c] + ElementNumNodes((ElementType)all_types[c]);
  for (PetscInt type = 0; type < ELEMENT_COUNT; ++type) { /* by counting, and stable */
    for (PetscInt c = 0; c < num_cells; ++c) {
      if (all_types[c] != type) continue;
      PictureOrder_Private((ElementType)type, &all_nodes[starts[c]], &picture->cell_nodes[picture->cell_start[n]]);
      picture->cell_start[n + 1] = picture->cell_start[n] + starts[c + 1] - starts[c];
      picture->cell_type[n]      = type;
      (*tags)[n++]               = (PetscReal)all_tags[c];
    }
  }
  PetscCall(PetscFree(starts));
  PetscCall(PetscFree(all_nodes));
  PetscCall(PetscFree(all_types));
  PetscCall(PetscFree(all_tags));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The cells of all bodies, with the body, and where one is of several pieces with the piece. */
static PetscErrorCode PictureCells_Private(VI vi, Picture *picture)
{
  const Level   *level  = vi->level;
  const Pieces  *pieces = &vi->motions.pieces;
  const PetscInt size   = level->cell_start[level->num_cells];
  PetscInt      *nodes, *piece;
  PetscReal     *tags, *body;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(size, &nodes, level->num_cells, &piece));
  for (PetscInt i = 0; i < size; ++i) nodes[i] = level->node_global[level->cell_nodes[i]];
  for (PetscInt c = 0; c < level->num_cells; ++c) piece[c] = pieces->of_node[level->cell_nodes[level->cell_start[c]]];
  PetscCall(PictureGatherCells(level->comm, &(PictureCells){level->num_cells, level->cell_type, piece, nodes}, picture,
                               &tags));
  PetscCall(PetscFree2(nodes, piece));
  PetscCall(PetscMalloc1(picture->num_cells, &body));
  for (PetscInt c = 0; c < picture->num_cells; ++c) body[c] = (PetscReal)pieces->body[(PetscInt)tags[c]];
  picture->num_cell_arrays = pieces->num > vi->motions.num_bodies ? 2 : 1;
  picture->cell[0]         = (PictureArray){"body", 1, PETSC_TRUE, body};
  picture->cell[1]         = (PictureArray){"piece", 1, PETSC_TRUE, tags};
  if (picture->num_cell_arrays == 1) PetscCall(PetscFree(picture->cell[1].values));
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
    PetscCall(GatherNodes_Private(level, 1, 1, merged[i], &picture->point[POINT_PRESSURE + i].values));
  PetscCall(PetscFree3(merged[0], merged[1], merged[2]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Stress as a full 3 x 3 tensor: viewers name its nine components by themselves, while for six each has an order of
   its own. Von Mises stress and principal stresses beside it. */
static PetscErrorCode PictureStress_Private(Fields fields, Picture *picture)
{
  static const PetscInt voigt[9] = {0, 5, 4, 5, 1, 3, 4, 3, 2}; /* xx,yy,zz,yz,xz,xy to rows of the tensor */
  const Level          *level    = fields->vi->level;
  const PetscReal      *stress;
  PetscReal            *tensor, *mises, *principal;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(level->num_owned * 9, &tensor, level->num_owned, &mises, level->num_owned * 3, &principal));
  PetscCall(VecGetArrayRead(fields->stress, &stress));
  for (PetscInt a = 0; a < level->num_owned; ++a) {
    for (PetscInt k = 0; k < 9; ++k) tensor[a * 9 + k] = stress[a * 6 + voigt[k]];
    mises[a] = MaterialVonMises(&stress[a * 6]);
    MaterialPrincipal(&stress[a * 6], &principal[a * 3]);
  }
  PetscCall(VecRestoreArrayRead(fields->stress, &stress));
  PetscCall(GatherNodes_Private(level, 9, 9, tensor, &picture->point[POINT_STRESS].values));
  PetscCall(GatherNodes_Private(level, 1, 1, mises, &picture->point[POINT_MISES].values));
  PetscCall(GatherNodes_Private(level, 3, 3, principal, &picture->point[POINT_PRINCIPAL].values));
  PetscCall(PetscFree3(tensor, mises, principal));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A picture of the bodies as they are meshed, without quantities at points. */
static PetscErrorCode PictureMesh_Private(VI vi, Picture *picture)
{
  const Level *level = vi->level;
  PetscMPIInt  rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(level->comm, &rank));
  PetscCall(PetscMemzero(picture, sizeof(*picture)));
  picture->title      = vi->scene->title;
  picture->num_points = rank == 0 ? level->num_global : 0;
  PetscCall(GatherNodes_Private(level, level->dim, 3, level->coords, &picture->points));
  PetscCall(PictureCells_Private(vi, picture));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PictureCreate(Fields fields, Picture *picture)
{
  static const PictureArray arrays[POINT_COUNT] = {[POINT_DISPLACEMENT] = {"displacement", 3, PETSC_FALSE, NULL},
                                                   [POINT_STRESS]       = {"stress", 9, PETSC_FALSE, NULL},
                                                   [POINT_MISES]        = {"von_mises", 1, PETSC_FALSE, NULL},
                                                   [POINT_PRINCIPAL]    = {"principal", 3, PETSC_FALSE, NULL},
                                                   [POINT_PRESSURE]     = {"pressure", 1, PETSC_FALSE, NULL},
                                                   [POINT_GAP]          = {"gap", 1, PETSC_FALSE, NULL},
                                                   [POINT_STATUS]       = {"status", 1, PETSC_TRUE, NULL}};
  const Level              *level               = fields->vi->level;
  const PetscReal          *u;

  PetscFunctionBeginUser;
  PetscCall(PictureMesh_Private(fields->vi, picture));
  picture->first            = "Vectors=\"displacement\" Tensors=\"stress\" Scalars=\"von_mises\"";
  picture->num_point_arrays = POINT_COUNT;
  memcpy(picture->point, arrays, sizeof(arrays));
  PetscCall(VecGetArrayRead(fields->u, &u));
  PetscCall(GatherNodes_Private(level, level->dim, 3, u, &picture->point[POINT_DISPLACEMENT].values));
  PetscCall(VecRestoreArrayRead(fields->u, &u));
  PetscCall(PictureStress_Private(fields, picture));
  PetscCall(PictureContact_Private(fields, picture));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PictureCreateMotion(VI vi, Picture *picture)
{
  const Level       *level  = vi->level;
  const SceneMotion *motion = &vi->solvability->motion;
  PetscReal         *u;

  PetscFunctionBeginUser;
  PetscCall(PictureMesh_Private(vi, picture));
  picture->first            = "Vectors=\"motion\"";
  picture->num_point_arrays = 1;
  picture->point[0]         = (PictureArray){"motion", 3, PETSC_FALSE, NULL};
  PetscCall(PetscCalloc1(level->num_owned * level->dim, &u));
  for (PetscInt i = 0; i < motion->num; ++i) {
    for (PetscInt a = 0; a < level->num_owned; ++a)
      if (vi->motions.pieces.of_node[a] == motion->bodies[i].piece)
        BodyMotionAt(&motion->bodies[i], level->dim, &level->coords[a * level->dim], &u[a * level->dim]);
  }
  PetscCall(GatherNodes_Private(level, level->dim, 3, u, &picture->point[0].values));
  PetscCall(PetscFree(u));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PictureDestroy(Picture *picture)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(picture->points));
  PetscCall(PetscFree3(picture->cell_start, picture->cell_nodes, picture->cell_type));
  for (PetscInt i = 0; i < picture->num_point_arrays; ++i) PetscCall(PetscFree(picture->point[i].values));
  for (PetscInt i = 0; i < picture->num_cell_arrays; ++i) PetscCall(PetscFree(picture->cell[i].values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

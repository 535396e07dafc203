/* level.c -- node and cell tables of one DMPlex.

   Loops over elements want plain arrays: the closure of a cell is looked up once, here, from the cones of its edges.
   Ownership and global numbers come from PETSc's global section, so that Vecs of the DM and of the tables agree. */
#include "room.h"
#include <mortise/compat.h>
#include <mortise/fault.h>

/* A cell is degenerate when det J falls below this share of its longest edge squared (cubed in 3D): round-off of the
   coordinates reaches 1e-15, needle elements of aspect 1e6 keep 1e-6. */
static const PetscReal DegenerateShare = 1e-10;

/* dim unknowns on every vertex: the layout of displacements. */
static PetscErrorCode LevelSetSection_Private(Level *level)
{
  PetscSection section;
  PetscInt     begin, end;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetDepthStratum(level->dm, 0, &begin, &end));
  PetscCall(PetscSectionCreate(level->comm, &section));
  PetscCall(PetscSectionSetNumFields(section, 1));
  PetscCall(PetscSectionSetFieldName(section, 0, "displacement"));
  PetscCall(PetscSectionSetFieldComponents(section, 0, level->dim));
  PetscCall(PetscSectionSetChart(section, begin, end));
  for (PetscInt v = begin; v < end; ++v) {
    PetscCall(PetscSectionSetDof(section, v, level->dim));
    PetscCall(PetscSectionSetFieldDof(section, v, 0, level->dim));
  }
  PetscCall(PetscSectionSetUp(section));
  PetscCall(DMSetLocalSection(level->dm, section));
  PetscCall(PetscSectionDestroy(&section));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Local nodes: owned vertices in global order, which is the order of the DM, then those of other ranks. */
static PetscErrorCode LevelSetNodes_Private(Level *level)
{
  PetscSection section;
  PetscInt     begin, end, node = 0;

  PetscFunctionBeginUser;
  PetscCall(LevelSetSection_Private(level));
  PetscCall(DMGetGlobalSection(level->dm, &section));
  PetscCall(DMPlexGetDepthStratum(level->dm, 0, &begin, &end));
  level->num_nodes = end - begin;
  PetscCall(PetscMalloc4(level->num_nodes, &level->vertex_node, level->num_nodes, &level->node_global, level->num_nodes,
                         &level->node_body, level->num_nodes * level->dim, &level->coords));
  for (PetscInt ghosts = 0; ghosts < 2; ++ghosts) { // first those that this rank owns
    for (PetscInt v = begin; v < end; ++v) {
      PetscInt offset;

      PetscCall(PetscSectionGetOffset(section, v, &offset)); // -(offset + 1) where another rank owns the vertex
      if ((offset < 0) != ghosts) continue;
      level->node_global[node]      = (ghosts ? -(offset + 1) : offset) / level->dim;
      level->vertex_node[v - begin] = node++;
    }
    if (!ghosts) level->num_owned = node;
  }
  PetscCallMPI(MPI_Scan(&level->num_owned, &level->node_begin, 1, MPIU_INT, MPI_SUM, level->comm));
  level->node_begin -= level->num_owned;
  PetscCallMPI(MPI_Allreduce(&level->num_owned, &level->num_global, 1, MPIU_INT, MPI_SUM, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Corners of polygons: edge i of a cell starts at corner i and runs against its own cone where its orientation is
   negative. */
static PetscErrorCode LevelSetCells_Private(Level *level)
{
  PetscInt     begin, end, vertex_begin, *cones, *orientations;
  PetscSection section;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetHeightStratum(level->dm, 0, &begin, &end));
  PetscCall(DMPlexGetDepthStratum(level->dm, 0, &vertex_begin, NULL));
  PetscCall(DMPlexGetConeSection(level->dm, &section));
  PetscCall(DMPlexGetCones(level->dm, &cones));
  PetscCall(DMPlexGetConeOrientations(level->dm, &orientations));
  level->num_cells = end - begin;
  PetscCall(PetscMalloc3(level->num_cells + 1, &level->cell_start, level->num_cells, &level->cell_type,
                         level->num_cells, &level->cell_body));
  level->cell_start[0] = 0;
  for (PetscInt c = 0; c < level->num_cells; ++c) {
    PetscInt size;

    PetscCall(PetscSectionGetDof(section, begin + c, &size));
    level->cell_type[c]      = size == ElementNumFacets(ELEMENT_TRI3) ? ELEMENT_TRI3 : ELEMENT_QUAD4;
    level->cell_start[c + 1] = level->cell_start[c] + size;
  }
  PetscCall(PetscMalloc1(level->cell_start[level->num_cells], &level->cell_nodes));
  for (PetscInt c = 0; c < level->num_cells; ++c) {
    const PetscInt start = level->cell_start[c], size = level->cell_start[c + 1] - start;
    PetscInt       offset;

    PetscCall(PetscSectionGetOffset(section, begin + c, &offset));
    for (PetscInt i = 0; i < size; ++i) {
      PetscInt ends;

      PetscCall(PetscSectionGetOffset(section, cones[offset + i], &ends));
      level->cell_nodes[start + i] = level->vertex_node[cones[ends + (orientations[offset + i] < 0)] - vertex_begin];
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The body of every cell, from the label; of every node, from its cells. */
static PetscErrorCode LevelSetBodies_Private(Scene scene, Level *level)
{
  DMLabel  label;
  PetscInt begin;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetHeightStratum(level->dm, 0, &begin, NULL));
  PetscCall(DMGetLabel(level->dm, "body", &label));
  for (PetscInt b = 0; b < scene->num_bodies; ++b) {
    const PetscInt *cells;
    PetscInt        num;
    IS              is;

    PetscCall(DMLabelGetStratumIS(label, b, &is));
    if (!is) continue; // none of it on this rank
    PetscCall(ISGetLocalSize(is, &num));
    PetscCall(ISGetIndices(is, &cells));
    for (PetscInt i = 0; i < num; ++i) {
      if (cells[i] < begin || cells[i] >= begin + level->num_cells)
        continue; // refinement labels the cells' edges as well
      level->cell_body[cells[i] - begin] = b;
    }
    PetscCall(ISRestoreIndices(is, &cells));
    PetscCall(ISDestroy(&is));
  }
  for (PetscInt c = 0; c < level->num_cells; ++c) {
    for (PetscInt i = level->cell_start[c]; i < level->cell_start[c + 1]; ++i)
      level->node_body[level->cell_nodes[i]] = level->cell_body[c];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* x = map(X) for nodes of mapped bodies, x = X else. */
static PetscErrorCode LevelSetCoords_Private(Scene scene, Level *level)
{
  const PetscScalar *X;
  Vec                coords;

  PetscFunctionBeginUser;
  PetscCall(DMGetCoordinatesLocal(level->dm, &coords));
  PetscCall(VecGetArrayRead(coords, &X));
  for (PetscInt v = 0; v < level->num_nodes; ++v) { // the coordinate section runs over the vertices in order
    const PetscInt   node = level->vertex_node[v];
    const Expression map  = scene->bodies[level->node_body[node]].map;
    PetscReal        in[3], *x = &level->coords[node * level->dim];

    for (PetscInt d = 0; d < level->dim; ++d) in[d] = PetscRealPart(X[v * level->dim + d]);
    if (map)
      PetscCall(ExpressionEvaluate(map, level->dim, in, x));
    else
      PetscCall(PetscArraycpy(x, in, level->dim));
  }
  PetscCall(VecRestoreArrayRead(coords, &X));
  for (PetscInt b = 0; b < scene->num_bodies; ++b) PetscCall(ExpressionCheck(level->comm, scene->bodies[b].map));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Positions of a cell's nodes; returns the longest edge. [out] X - [num_nodes][dim] */
static PetscReal LevelCellCoords_Private(const Level *level, PetscInt cell, PetscReal X[])
{
  const PetscInt *nodes = &level->cell_nodes[level->cell_start[cell]],
                 num    = level->cell_start[cell + 1] - level->cell_start[cell];
  PetscReal longest     = 0;

  for (PetscInt i = 0; i < num; ++i) {
    for (PetscInt d = 0; d < level->dim; ++d) X[i * level->dim + d] = level->coords[nodes[i] * level->dim + d];
  }
  for (PetscInt i = 0; i < num; ++i) {
    PetscReal square = 0;

    for (PetscInt d = 0; d < level->dim; ++d)
      square += PetscSqr(X[i * level->dim + d] - X[(i + 1) % num * level->dim + d]);
    longest = PetscMax(longest, PetscSqrtReal(square));
  }
  return longest;
}

/* Reverses a cell that runs clockwise; tells whether it did, and whether the cell is sound then. */
static void LevelTurnCell_Private(Level *level, PetscInt cell, PetscBool *turned, PetscBool *sound)
{
  const ElementType type  = (ElementType)level->cell_type[cell];
  PetscInt         *nodes = &level->cell_nodes[level->cell_start[cell]], num = ElementNumNodes(type);
  PetscReal         X[ELEMENT_MAX_NODES * 3], longest, jacobian;

  longest  = LevelCellCoords_Private(level, cell, X);
  jacobian = ElementMinJacobian(type, X);
  *turned  = jacobian < 0 ? PETSC_TRUE : PETSC_FALSE;
  if (*turned) { // the first corner stays
    for (PetscInt i = 1; i < num - i; ++i) {
      const PetscInt swap = nodes[i];

      nodes[i]       = nodes[num - i];
      nodes[num - i] = swap;
    }
    (void)LevelCellCoords_Private(level, cell, X);
    jacobian = ElementMinJacobian(type, X);
  }
  *sound = jacobian > DegenerateShare * PetscPowRealInt(longest, (int)level->dim) ? PETSC_TRUE : PETSC_FALSE;
}

/* "body 'b' has a degenerate or tangled cell with corners (..), (..)" */
static void LevelDescribeCell_Private(Scene scene, const Level *level, PetscInt cell, char sentence[])
{
  size_t used;

  used = (size_t)snprintf(sentence, MESH_SENTENCE, "body '%s' has a degenerate or tangled cell%s with corners",
                          scene->bodies[level->cell_body[cell]].name,
                          scene->bodies[level->cell_body[cell]].map ? " after its map" : "");
  for (PetscInt i = level->cell_start[cell]; i < level->cell_start[cell + 1]; ++i) {
    const PetscReal *x = &level->coords[level->cell_nodes[i] * level->dim];

    for (PetscInt d = 0; d < level->dim; ++d) {
      used += (size_t)snprintf(sentence + used, MESH_SENTENCE - used, "%s%g", d ? ", " : " (", (double)x[d]);
    }
    used += (size_t)snprintf(sentence + used, MESH_SENTENCE - used, ")");
  }
}

/* Makes all cells run anticlockwise. Before maps every body has one sense (box.c, extract.c), and refinement keeps
   it. So a map may turn a body inside out as a whole; one that turns only some of its cells has folded it. */
static PetscErrorCode LevelTurnCells_Private(Scene scene, Level *level)
{
  char      sentence[MESH_SENTENCE] = "";
  PetscInt *seen; /* cells that ran anticlockwise and clockwise [num_bodies][2] */

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(2 * scene->num_bodies, &seen));
  for (PetscInt c = 0; c < level->num_cells; ++c) {
    PetscBool turned, sound;

    LevelTurnCell_Private(level, c, &turned, &sound);
    if (!sound && !sentence[0]) LevelDescribeCell_Private(scene, level, c, sentence);
    seen[2 * level->cell_body[c] + turned] = 1;
  }
  PetscCall(FaultCheck(level->comm, sentence));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, seen, (int)(2 * scene->num_bodies), MPIU_INT, MPI_MAX, level->comm));
  for (PetscInt b = 0; b < scene->num_bodies; ++b) {
    if (!seen[2 * b] || !seen[2 * b + 1]) continue;
    PetscCall(FaultRaise(level->comm,
                         "-%s_map %s folds body '%s': it turns some of its cells inside out and others not",
                         scene->bodies[b].name, ExpressionText(scene->bodies[b].map), scene->bodies[b].name));
  }
  PetscCall(PetscFree(seen));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The order matters: bodies tell which map applies, positions tell which cells to turn. */
PetscErrorCode LevelCreate(Scene scene, DM dm, Level *level)
{
  PetscFunctionBeginUser;
  *level = (Level){.comm = scene->comm, .dm = dm, .dim = scene->dim, .scene = scene};
  PetscCall(PetscObjectReference((PetscObject)dm));
  PetscCall(LevelSetNodes_Private(level));
  PetscCall(LevelSetCells_Private(level));
  PetscCall(LevelSetBodies_Private(scene, level));
  PetscCall(LevelSetCoords_Private(scene, level));
  PetscCall(LevelTurnCells_Private(scene, level));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelDestroy(Level *level)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree4(level->vertex_node, level->node_global, level->node_body, level->coords));
  PetscCall(PetscFree3(level->cell_start, level->cell_type, level->cell_body));
  PetscCall(PetscFree(level->cell_nodes));
  PetscCall(MatDestroy(&level->prolongation));
  PetscCall(DMDestroy(&level->dm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

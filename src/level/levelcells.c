/* levelcells.c -- the cells of a level: bodies, materials, nodes, and a check of their shape.

   Loops over elements need plain arrays: nodes of cells are read from the DM once, here. */
#include "kernel/vector.h"
#include "base/compat.h"
#include "base/usererror.h"
#include "level/leveltables.h"
#include "level/plexpoints.h"

enum { SENTENCE = 1024 };

/* A cell is degenerate if det J is below this share of its longest edge squared (cubed in 3D). Roundoff of
   coordinates reaches 1e-15, needles of aspect 1e6 have 1e-6. */
static const PetscReal DEGENERATE_SHARE = 1e-10;

/* From the label that the merge has set; a mesh without it is of one body. */
PetscErrorCode LevelSetCellMaterials(Level *level)
{
  DMLabel  label;
  PetscInt begin;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetHeightStratum(level->dm, 0, &begin, NULL));
  PetscCall(DMGetLabel(level->dm, "material", &label));
  for (PetscInt m = 0; m < level->scene->num_bodies + level->scene->num_regions && label; m++) {
    const PetscInt *cells;
    PetscInt        num;
    IS              is;

    PetscCall(DMLabelGetStratumIS(label, m, &is));
    if (!is) continue; // none of it on this rank
    PetscCall(ISGetLocalSize(is, &num));
    PetscCall(ISGetIndices(is, &cells));
    for (PetscInt i = 0; i < num; i++) level->cell_material[cells[i] - begin] = m;
    for (PetscInt i = 0; i < num; i++) level->cell_body[cells[i] - begin] = SceneMaterialBody(level->scene, m);
    PetscCall(ISRestoreIndices(is, &cells));
    PetscCall(ISDestroy(&is));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelSetCells(Level *level)
{
  ElementType type;
  PetscInt    begin, most = 0;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetHeightStratum(level->dm, 0, &begin, NULL));
  level->cell_start[0] = 0;
  for (PetscInt c = 0; c < level->num_cells; c++) {
    if (level->cell_start[c] + ELEMENT_MAX_NODES > most) {
      most = 2 * most + ELEMENT_MAX_NODES;
      PetscCall(PetscRealloc((size_t)most * sizeof(PetscInt), &level->cell_nodes));
    }
    PetscCall(PointGetNodes(level, begin + c, &type, &level->cell_nodes[level->cell_start[c]]));
    level->cell_type[c]      = type;
    level->cell_start[c + 1] = level->cell_start[c] + ElementNumNodes(type);
  }
  PetscCall(PetscRealloc((size_t)level->cell_start[level->num_cells] * sizeof(PetscInt), &level->cell_nodes));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Positions of a cell's nodes; returns the longest distance of neighbouring vertices.
   [out] X - [num_nodes][dim] */
static PetscReal LevelCellCoords_Private(const Level *level, PetscInt cell, PetscReal X[])
{
  const PetscInt   *nodes = &level->cell_nodes[level->cell_start[cell]];
  const PetscInt    num   = level->cell_start[cell + 1] - level->cell_start[cell];
  const ElementType type  = (ElementType)level->cell_type[cell];

  VectorGather(level->dim, num, nodes, level->coords, X);
  return ElementLongestEdge(type, level->dim, X);
}

/* The node of a reference cell that mirrors another in the plane xi_0 = xi_1. */
static PetscInt NodeMirror_Private(ElementType type, PetscInt node)
{
  const PetscReal *xi = ElementNode(type, node);
  PetscInt         i  = 0;

  for (; i < ElementNumNodes(type); i++) {
    const PetscReal *other = ElementNode(type, i);
    PetscBool        same  = other[0] == xi[1] && other[1] == xi[0] ? PETSC_TRUE : PETSC_FALSE;

    for (PetscInt d = 2; d < ElementDim(type); d++) same = same && other[d] == xi[d] ? PETSC_TRUE : PETSC_FALSE;
    if (same) break;
  }
  return i;
}

/* The first vertex stays. */
void CellReverse(ElementType type, PetscInt nodes[])
{
  for (PetscInt i = 0; i < ElementNumNodes(type); i++) {
    const PetscInt mirror = NodeMirror_Private(type, i), node = nodes[i];

    if (mirror <= i) continue; // on the plane, or changed already
    nodes[i]      = nodes[mirror];
    nodes[mirror] = node;
  }
}

static PetscBool LevelCellIsSound_Private(const Level *level, PetscReal longest, PetscReal jacobian)
{
  return (PetscBool)(jacobian > DEGENERATE_SHARE * PetscPowRealInt(longest, (int)level->dim));
}

/* Reverses a cell that is inside out.
   [out] turned - whether it was; sound - whether the cell is valid then */
static void LevelTurnCell_Private(Level *level, PetscInt cell, PetscBool *turned, PetscBool *sound)
{
  const ElementType type = (ElementType)level->cell_type[cell];
  PetscReal         X[ELEMENT_MAX_NODES * 3], longest, jacobian;

  longest  = LevelCellCoords_Private(level, cell, X);
  jacobian = ElementBoundJacobian(type, X); // enough for most cells, and cheap
  if (!LevelCellIsSound_Private(level, longest, jacobian)) jacobian = ElementMinJacobian(type, X);
  *turned = jacobian < 0 ? PETSC_TRUE : PETSC_FALSE;
  if (*turned) {
    CellReverse(type, &level->cell_nodes[level->cell_start[cell]]);
    (void)LevelCellCoords_Private(level, cell, X);
    jacobian = ElementMinJacobian(type, X);
  }
  *sound = LevelCellIsSound_Private(level, longest, jacobian);
}

/* "body 'b' has a degenerate or tangled cell with corners (..), (..)"; with curved sides the corners may be
   those of a valid cell. */
static void LevelDescribeCell_Private(const Level *level, PetscInt cell, char sentence[])
{
  const SceneBody *body  = &level->scene->bodies[level->cell_body[cell]];
  const PetscInt  *nodes = &level->cell_nodes[level->cell_start[cell]];
  size_t           used;

  used = (size_t)snprintf(sentence, SENTENCE, "body '%s' has a degenerate or tangled cell%s%s with corners", body->name,
                          body->order > 1 ? " of order 2" : "", body->map ? " after its map" : "");
  for (PetscInt i = 0; i < LevelNumVertices(level, cell); i++) {
    const PetscReal *x = &level->coords[nodes[i] * level->dim];

    for (PetscInt d = 0; d < level->dim; d++) {
      used += (size_t)snprintf(sentence + used, SENTENCE - used, "%s%g", d ? ", " : " (",
                               (double)(x[d] + 0)); // not -0
    }
    used += (size_t)snprintf(sentence + used, SENTENCE - used, ")");
  }
  if (body->curved_file)
    used +=
        (size_t)snprintf(sentence + used, SENTENCE - used,
                         "; Gmsh mends cells of second order by Mesh.HighOrderOptimize = 2, and makes them straight by "
                         "Mesh.SecondOrderLinear = 1");
  if (body->arcs)
    snprintf(sentence + used, SENTENCE - used,
             "; sides in contact are taken for smooth, and -%s_polygonal 1 keeps the %s of its file", body->name,
             body->curved_file ? "parabolas" : "polygons");
}

/* The user error of a body with cells of both orientations. Its map has folded it, or the curves of its file,
   or those of smooth sides. [in] cell - of this rank, of the sense that fewer cells have, or -1 */
static PetscErrorCode BodyRaiseFold_Private(const Level *level, const SceneBody *body, PetscInt cell)
{
  char sentence[SENTENCE] = "";

  PetscFunctionBeginUser;
  if (body->arcs && !body->map) {
    if (cell >= 0) LevelDescribeCell_Private(level, cell, sentence);
    PetscCall(UserErrorCheck(level->comm, sentence));
  }
  if (body->map) {
    PetscCall(UserErrorRaise(level->comm,
                             "-%s_map %.200s folds body '%s': it turns some of its cells inside out and others not",
                             body->name, ExpressionText(body->map), body->name));
  }
  PetscCall(UserErrorRaise(
      level->comm,
      "body '%s': refinement along the curved sides of %.400s turns cells inside out; -%s_order 2 names one of them",
      body->name, body->mesh_file, body->name));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Before maps every body has one orientation (box.c, bodyfile.c), and refinement keeps it except along
   curves that do not fit a cell. So a map may reverse a whole body; if it reverses only some cells it has
   folded the body. */
PetscErrorCode LevelTurnCells(Level *level, PetscBool *sound)
{
  const Scene    scene              = level->scene;
  char           sentence[SENTENCE] = "";
  const PetscInt num                = 2 * scene->num_bodies;
  PetscInt      *seen;  /* cells that were the right way and inside out [num_bodies][2]; invalid ones */
  PetscInt      *first; /* of this rank, or -1 [num_bodies][2] */

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc2(num + 1, &seen, num, &first));
  for (PetscInt i = 0; i < num; i++) first[i] = -1;
  for (PetscInt c = 0; c < level->num_cells; c++) {
    PetscBool turned, good;

    LevelTurnCell_Private(level, c, &turned, &good);
    if (!good && !sentence[0]) LevelDescribeCell_Private(level, c, sentence);
    if (!seen[2 * level->cell_body[c] + turned]++) first[2 * level->cell_body[c] + turned] = c;
  }
  if (!sound) PetscCall(UserErrorCheck(level->comm, sentence));
  seen[num] = sentence[0] ? 1 : 0;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, seen, (int)(num + 1), MPIU_INT, MPI_SUM, level->comm));
  if (sound) *sound = seen[num] ? PETSC_FALSE : PETSC_TRUE;
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    if (!seen[2 * b] || !seen[2 * b + 1]) continue;
    if (sound)
      *sound = PETSC_FALSE;
    else
      PetscCall(BodyRaiseFold_Private(level, &scene->bodies[b], first[2 * b + (seen[2 * b] > seen[2 * b + 1])]));
  }
  PetscCall(PetscFree2(seen, first));
  PetscFunctionReturn(PETSC_SUCCESS);
}

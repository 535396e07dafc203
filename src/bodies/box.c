/* box.c -- a box of quadrilaterals, triangles, hexahedra or tetrahedra.

   PETSc makes one box at a time and cannot merge two. Its Debian build has no generator for simplices. So
   boxes are written here as cell lists: nodes run along x first, then along y, then along z. A quad is cut
   along the diagonal from its lower left corner. A hexahedron is cut into the six tetrahedra around the
   diagonal from its lowest corner to its highest one [1]. All facets are cut from their lowest corner, so
   those of neighbours match.

   Reference:
     [1] H. W. Kuhn, Some combinatorial lemmas in topology, IBM J. Res. Dev. 4 (1960) 518-524. */
#include "base/compat.h"
#include "bodies/bodylist.h"
#include "bodies/box.h"
#include <string.h>

enum { MAX_SIDES = 6, MAX_PARTS = 6, MAX_PARTS_ON_SIDE = 2, MAX_CORNERS = 8 };

/* A side of the box, and of the bricks there. */
typedef struct {
  const char *name;
  PetscInt    axis, end; /* axis, and its end: 0 or 1 */
} Side;

/* Cells of a brick of the grid. */
typedef struct {
  ElementType brick, part;
  PetscInt    num_parts, corners[MAX_PARTS][MAX_CORNERS]; /* of each part, by the brick's own numbers */
} Split;

/* [dim] */
static const Side SIDES[][MAX_SIDES] = {
    [2] = {{"bottom", 1, 0}, {"right", 0, 1}, {"top", 1, 1}, {"left", 0, 0}},
    [3] = {{"bottom", 2, 0}, {"top", 2, 1}, {"front", 1, 0}, {"right", 0, 1}, {"back", 1, 1}, {"left", 0, 0}}};

/* [dim][simplex]. The tetrahedra have the edge from corner 0 to 6 in common and are right-handed. The first
   vertex of each determines the diagonal along which refinement cuts the inner octahedron. With this order
   volume over the cube of the mean edge stays above 0.56 of that of a regular tetrahedron on all levels. With
   others it falls to 0.36. */
static const Split SPLITS[][2] = {
    [2] = {{ELEMENT_QUAD4, ELEMENT_QUAD4, 1, {{0, 1, 2, 3}}}, {ELEMENT_QUAD4, ELEMENT_TRI3, 2, {{0, 1, 2}, {0, 2, 3}}}},
    [3] = {{ELEMENT_HEX8, ELEMENT_HEX8, 1, {{0, 1, 2, 3, 4, 5, 6, 7}}},
           {ELEMENT_HEX8,
            ELEMENT_TET4,
            6,
            {{0, 2, 6, 1}, {0, 3, 6, 2}, {0, 7, 6, 3}, {0, 4, 6, 7}, {0, 5, 6, 4}, {0, 1, 6, 5}}}}};

/* Bricks along the axes, and those that are made. */
typedef struct {
  PetscInt       dim, n[3];
  const Split   *split;
  const BoxPart *part; /* NULL: all */
} Grid;

/* Splits a number into digits, the first one fastest. [in] base - [dim] */
static void GridSplitNumber_Private(PetscInt dim, const PetscInt base[], PetscInt number, PetscInt digit[])
{
  for (PetscInt d = 0; d < dim; d++) {
    digit[d] = number % base[d];
    number /= base[d];
  }
}

static PetscInt GridProduct_Private(PetscInt num, const PetscInt factor[])
{
  PetscInt product = 1;

  for (PetscInt i = 0; i < num; i++) product *= factor[i];
  return product;
}

static PetscInt GridNumBricks_Private(const Grid *grid)
{
  return grid->part ? grid->part->num_bricks : GridProduct_Private(grid->dim, grid->n);
}

/* Position of a brick among all bricks of the box. */
static void GridFindBrick_Private(const Grid *grid, PetscInt brick, PetscInt at[])
{
  GridSplitNumber_Private(grid->dim, grid->n, grid->part ? grid->part->brick[brick] : brick, at);
}

/* The cells of all bricks, brick by brick. */
static PetscErrorCode BoxSetCells_Private(const Grid *grid, BodyList *list)
{
  const Split *split = grid->split;

  PetscFunctionBeginUser;
  for (PetscInt brick = 0; brick < GridNumBricks_Private(grid); brick++) {
    PetscInt at[3], node[MAX_CORNERS];

    GridFindBrick_Private(grid, brick, at);
    for (PetscInt i = 0; i < ElementNumNodes(split->brick); i++) {
      node[i] = 0;
      for (PetscInt d = grid->dim - 1; d >= 0; d--)
        node[i] = node[i] * (grid->n[d] + 1) + at[d] + (ElementNode(split->brick, i)[d] > 0);
      if (grid->part) PetscCall(PetscFindInt(node[i], grid->part->num_nodes, grid->part->node, &node[i]));
    }
    for (PetscInt p = 0; p < split->num_parts; p++) {
      const PetscInt cell = brick * split->num_parts + p;

      list->cell_type[cell] = split->part;
      for (PetscInt i = 0; i < ElementNumNodes(split->part); i++)
        list->cell_nodes[cell * ELEMENT_MAX_NODES + i] = node[split->corners[p][i]];
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The weighted mean meets both ends exactly, unlike lower + s (upper - lower). */
static void BoxSetCoords_Private(const SceneBody *body, const Grid *grid, BodyList *list)
{
  PetscInt num[3], at[3];

  for (PetscInt d = 0; d < grid->dim; d++) num[d] = grid->n[d] + 1;
  for (PetscInt node = 0; node < list->num_nodes; node++) {
    GridSplitNumber_Private(grid->dim, num, grid->part ? grid->part->node[node] : node, at);
    for (PetscInt d = 0; d < grid->dim; d++) {
      const PetscReal s = (PetscReal)at[d] / grid->n[d];

      list->coords[node * grid->dim + d] = (1 - s) * body->lower[d] + s * body->upper[d];
    }
  }
}

/* The facet of a part of a brick that lies on a side of the brick, or -1. */
static PetscInt PartFindFacet_Private(const Split *split, PetscInt part, const Side *side)
{
  const PetscInt num = ElementNumNodes(ElementFacetType(split->part));

  for (PetscInt f = 0; f < ElementNumFacets(split->part); f++) {
    const PetscInt *nodes = ElementFacetNodes(split->part, f);
    PetscInt        on    = 0;

    for (PetscInt i = 0; i < num; i++)
      on += ElementNode(split->brick, split->corners[part][nodes[i]])[side->axis] == (PetscReal)side->end;
    if (on == num) return f;
  }
  return -1;
}

/* Facets of one side of the box under the index of its name. */
static void BoxAddSide_Private(const Grid *grid, const Side *side, PetscInt index, BodyList *list)
{
  const Split *split = grid->split;

  for (PetscInt brick = 0; brick < GridNumBricks_Private(grid); brick++) {
    PetscInt at[3];

    GridFindBrick_Private(grid, brick, at);
    if (at[side->axis] != (side->end ? grid->n[side->axis] - 1 : 0)) continue;
    for (PetscInt p = 0; p < split->num_parts; p++) {
      const PetscInt facet = PartFindFacet_Private(split, p, side);

      if (facet < 0) continue;
      list->facet_cell[list->num_facets]   = brick * split->num_parts + p;
      list->facet[list->num_facets]        = facet;
      list->facet_side[list->num_facets++] = index;
    }
  }
}

/* More cells instead of refinement give the same mesh at lower cost. */
PetscErrorCode BodyListCreateBox(const SceneBody *body, PetscInt dim, const SideNames *names, const BoxPart *part,
                                 BodyList *list, char sentence[])
{
  static const char *const all[] = {
      [2] = "left, right, bottom and top", [3] = "left, right, front, back, bottom and top"};
  Grid     grid     = {.dim = dim, .split = &SPLITS[dim][body->simplex ? 1 : 0], .part = part};
  PetscInt nodes[3] = {0, 0, 0}, num_bricks, num_facets = 0;

  PetscFunctionBeginUser;
  for (PetscInt d = 0; d < dim; d++) {
    grid.n[d] = body->faces[d] << body->refine;
    nodes[d]  = grid.n[d] + 1;
  }
  num_bricks = GridNumBricks_Private(&grid);
  for (PetscInt d = 0; d < dim; d++)
    num_facets += 2 * MAX_PARTS_ON_SIDE * PetscMin(num_bricks, GridProduct_Private(dim, grid.n) / grid.n[d]);
  PetscCall(BodyListAllocate(dim, num_bricks * grid.split->num_parts,
                             part ? part->num_nodes : GridProduct_Private(dim, nodes), num_facets, list));
  PetscCall(BoxSetCells_Private(&grid, list));
  BoxSetCoords_Private(body, &grid, list);
  for (PetscInt i = 0; i < names->num; i++) {
    PetscInt side = 0;

    while (side < 2 * dim && strcmp(SIDES[dim][side].name, names->name[i])) side++;
    if (side < 2 * dim)
      BoxAddSide_Private(&grid, &SIDES[dim][side], i, list);
    else
      snprintf(sentence, MESH_SENTENCE, "body '%s' is a box and has no side '%s'; its sides are %s", body->name,
               names->name[i], all[dim]);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* box.c -- a body that is a box of quads or triangles.

   PETSc makes one box at a time and cannot merge two, and its Debian build has no generator for triangles, so boxes are
   written here as cell lists: nodes run along x first; a quad is cut along the diagonal from its lower left corner. */
#include "room.h"
#include <mortise/compat.h>
#include <string.h>

enum { NUM_SIDES = 4 };
/* In the order of a quad's facets: (0,1), (1,2), (2,3), (3,0). */
static const char *const SideName[NUM_SIDES] = {"bottom", "right", "top", "left"};

/* Cells along the two axes, and what one quad of the grid becomes. */
typedef struct {
  PetscInt nx, ny;
  PetscInt cells_per_quad; /* 1 quad or 2 triangles */
} Grid;

/* Corners a b c d of every quad, anticlockwise from the lower left. */
static void BoxSetCells_Private(const Grid *grid, BodyList *list)
{
  for (PetscInt j = 0; j < grid->ny; ++j) {
    for (PetscInt i = 0; i < grid->nx; ++i) {
      const PetscInt quad = j * grid->nx + i, a = j * (grid->nx + 1) + i, b = a + 1, d = b + grid->nx, c = d + 1;
      PetscInt      *nodes = &list->cell_nodes[quad * grid->cells_per_quad * ELEMENT_MAX_NODES];

      if (grid->cells_per_quad == 1) {
        const PetscInt corners[] = {a, b, c, d};

        memcpy(nodes, corners, sizeof(corners));
        list->cell_type[quad] = ELEMENT_QUAD4;
      } else {
        const PetscInt lower[] = {a, b, c}, upper[] = {a, c, d};

        memcpy(nodes, lower, sizeof(lower));
        memcpy(nodes + ELEMENT_MAX_NODES, upper, sizeof(upper));
        list->cell_type[2 * quad] = list->cell_type[2 * quad + 1] = ELEMENT_TRI3;
      }
    }
  }
}

/* Nodes row by row from the bottom. */
static void BoxSetCoords_Private(const SceneBody *body, const Grid *grid, BodyList *list)
{
  for (PetscInt j = 0; j <= grid->ny; ++j) {
    for (PetscInt i = 0; i <= grid->nx; ++i) {
      PetscReal      *x = &list->coords[(j * (grid->nx + 1) + i) * 2];
      const PetscReal s = (PetscReal)i / grid->nx, t = (PetscReal)j / grid->ny;

      /* the weighted mean meets both ends exactly, unlike lower + s (upper - lower) */
      x[0] = (1 - s) * body->lower[0] + s * body->upper[0];
      x[1] = (1 - t) * body->lower[1] + t * body->upper[1];
    }
  }
}

/* Facets of one side of the box under the index of its name. */
static void BoxAddSide_Private(const Grid *grid, PetscInt side, PetscInt index, BodyList *list)
{
  const PetscInt num = side == 0 || side == 2 ? grid->nx : grid->ny, nx = grid->nx, last_row = nx * (grid->ny - 1);
  const PetscInt first[NUM_SIDES] = {0, nx - 1, last_row, 0}, stride[NUM_SIDES] = {1, nx, 1, nx};
  /* lower triangle a b c: bottom is (a,b), right (b,c); upper triangle a c d: top (c,d), left (d,a) */
  const PetscInt half[NUM_SIDES] = {0, 0, 1, 1}, facet[NUM_SIDES] = {0, 1, 1, 2};

  for (PetscInt i = 0; i < num; ++i) {
    const PetscInt quad = first[side] + i * stride[side], n = list->num_facets++;

    list->facet_cell[n] = grid->cells_per_quad == 1 ? quad : 2 * quad + half[side];
    list->facet[n]      = grid->cells_per_quad == 1 ? side : facet[side];
    list->facet_side[n] = index;
  }
}

/* Refining a box is the same as making it of more cells, and cheaper. */
PetscErrorCode BodyListCreateBox(const SceneBody *body, PetscInt dim, const SideNames *names, BodyList *list,
                                 char sentence[])
{
  const Grid grid = {body->faces[0] << body->refine, body->faces[1] << body->refine, body->simplex ? 2 : 1};

  PetscFunctionBeginUser;
  PetscCall(BodyListAllocate(dim, grid.nx * grid.ny * grid.cells_per_quad, (grid.nx + 1) * (grid.ny + 1),
                             2 * (grid.nx + grid.ny), list));
  BoxSetCells_Private(&grid, list);
  BoxSetCoords_Private(body, &grid, list);
  for (PetscInt i = 0; i < names->num; ++i) {
    PetscInt side = 0;

    while (side < NUM_SIDES && strcmp(SideName[side], names->name[i])) ++side;
    if (side < NUM_SIDES)
      BoxAddSide_Private(&grid, side, i, list);
    else
      snprintf(sentence, MESH_SENTENCE,
               "body '%s' is a box and has no side '%s'; its sides are left, right, bottom and top", body->name,
               names->name[i]);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* cellpiece.c -- parts of reference cells, cut through the middles of their edges. */
#include "kernel/element.h"
#include "kernel/referencecell.h"

/* One part, in half edges of what is cut: where its first vertex lies, and its axes. */
typedef struct {
  PetscInt origin[3];
  const PetscInt (*axes)[3];
} Part;

static const PetscInt UNIT[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

static const Part BOX_PARTS[8] = {{{0, 0, 0}, UNIT}, {{1, 0, 0}, UNIT}, {{0, 1, 0}, UNIT}, {{1, 1, 0}, UNIT},
                                  {{0, 0, 1}, UNIT}, {{1, 0, 1}, UNIT}, {{0, 1, 1}, UNIT}, {{1, 1, 1}, UNIT}};

static const PetscInt TURNED[3][3] = {{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}};

/* The inner one is rotated by 180 degrees: from the middle of the longest side inwards. */
static const Part TRIANGLE_PARTS[4] = {{{0, 0, 0}, UNIT}, {{1, 0, 0}, UNIT}, {{0, 1, 0}, UNIT}, {{1, 1, 0}, TURNED}};

static const PetscInt INNER[4][3][3] = {{{-1, 1, 1}, {-1, 1, 0}, {0, 1, 0}},
                                        {{-1, 1, 1}, {0, 1, 0}, {0, 0, 1}},
                                        {{-1, 1, 1}, {0, 0, 1}, {-1, 0, 1}},
                                        {{-1, 1, 1}, {-1, 0, 1}, {-1, 1, 0}}};

/* The inner octahedron is cut along the diagonal from the middle of edge 01 to that of edge 23. Four
   tetrahedra stand around it, each between two neighbours among the middles of 02, 12, 13, 03. */
static const Part TETRAHEDRON_PARTS[8] = {{{0, 0, 0}, UNIT},     {{1, 0, 0}, UNIT},     {{0, 1, 0}, UNIT},
                                          {{0, 0, 1}, UNIT},     {{1, 0, 0}, INNER[0]}, {{1, 0, 0}, INNER[1]},
                                          {{1, 0, 0}, INNER[2]}, {{1, 0, 0}, INNER[3]}};

CellPiece CellPieceWhole(void)
{
  return (CellPiece){{0., 0., 0.}, {{1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}}, 1., 1.};
}

void CellPiecePoint(ElementType type, const CellPiece *piece, const PetscReal inside[], PetscReal xi[])
{
  const PetscInt dim = REFERENCE[type].dim;

  for (PetscInt j = 0; j < dim; j++) {
    xi[j] = piece->origin[j];
    for (PetscInt k = 0; k < dim; k++) xi[j] += inside[k] * piece->axes[k][j];
  }
}

/* v = sum_k halves_k axes_k / 2 */
static void CellPieceCombineAxes_Private(PetscInt dim, const PetscInt halves[3], const CellPiece *piece, PetscReal v[3])
{
  for (PetscInt j = 0; j < dim; j++) {
    v[j] = 0.;
    for (PetscInt k = 0; k < dim; k++) v[j] += 0.5 * halves[k] * piece->axes[k][j];
  }
}

PetscInt CellPieceCut(ElementType type, const CellPiece *piece, CellPiece parts[])
{
  const PetscInt dim = REFERENCE[type].dim, num = 1 << dim;
  const Part    *part = !REFERENCE[type].simplex ? BOX_PARTS : (dim == 2 ? TRIANGLE_PARTS : TETRAHEDRON_PARTS);

  for (PetscInt i = 0; i < num; i++) {
    parts[i] = CellPieceWhole(); /* for the axes that a plane cell does not have */
    CellPieceCombineAxes_Private(dim, part[i].origin, piece, parts[i].origin);
    for (PetscInt j = 0; j < dim; j++) parts[i].origin[j] += piece->origin[j];
    for (PetscInt k = 0; k < dim; k++) CellPieceCombineAxes_Private(dim, part[i].axes[k], piece, parts[i].axes[k]);
    parts[i].size    = 0.5 * piece->size;
    parts[i].measure = piece->measure / num;
  }
  return num;
}

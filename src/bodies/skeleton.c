/* skeleton.c -- facets of cells, and edges of facets in space.

   Each shape lists its facets, which are the shapes of the next lower dimension. Common facets of two cells
   are found among the few with the same lowest vertex. DMPlexInterpolate() gives the same, and took most of
   the time of a large mesh. PETSc's numbers of facets and vertices of a cell are taken from a mesh of one
   cell. */
#include "base/compat.h"
#include "bodies/skeleton.h"
#include "level/plexpoints.h"

enum { MAX_FACETS = 6, MAX_CORNERS = 8 };

const DMPolytopeType PlexPolytope[ELEMENT_COUNT] = {[ELEMENT_LINE2] = DM_POLYTOPE_SEGMENT,
                                                    [ELEMENT_TRI3]  = DM_POLYTOPE_TRIANGLE,
                                                    [ELEMENT_QUAD4] = DM_POLYTOPE_QUADRILATERAL,
                                                    [ELEMENT_TET4]  = DM_POLYTOPE_TETRAHEDRON,
                                                    [ELEMENT_HEX8]  = DM_POLYTOPE_HEXAHEDRON};

/* PETSc's local numbers of the vertices of each facet. */
typedef struct {
  PetscInt vertex[MAX_FACETS][MAX_CORNERS];
} Pattern;

/* Reads the pattern from a mesh of one cell. */
static PetscErrorCode PatternGet_Private(ElementType type, Pattern *pattern)
{
  const PetscInt num = ElementNumNodes(type), *facets;
  PetscInt       cone[MAX_CORNERS], num_found, vertices[ELEMENT_MAX_NODES];
  DM             cell, whole;

  PetscFunctionBeginUser;
  PetscCall(DMCreate(PETSC_COMM_SELF, &cell));
  PetscCall(DMSetType(cell, DMPLEX));
  PetscCall(DMSetDimension(cell, ElementDim(type)));
  PetscCall(DMPlexSetChart(cell, 0, num + 1));
  PetscCall(DMPlexSetConeSize(cell, 0, num));
  PetscCall(DMSetUp(cell));
  for (PetscInt i = 0; i < num; i++) cone[i] = i + 1;
  PetscCall(DMPlexSetCone(cell, 0, cone));
  PetscCall(DMCreateLabel(cell, "celltype"));
  PetscCall(DMPlexSetCellType(cell, 0, PlexPolytope[type]));
  for (PetscInt i = 0; i < num; i++) PetscCall(DMPlexSetCellType(cell, i + 1, DM_POLYTOPE_POINT));
  PetscCall(DMPlexSymmetrize(cell));
  PetscCall(DMPlexStratify(cell));
  PetscCall(DMPlexInterpolate(cell, &whole));
  PetscCall(DMPlexGetCone(whole, 0, &facets));
  for (PetscInt f = 0; f < ElementNumFacets(type); f++) {
    PetscCall(PointGetVertices(whole, facets[f], &num_found, vertices));
    for (PetscInt i = 0; i < num_found; i++) pattern->vertex[f][i] = vertices[i] - 1;
  }
  PetscCall(DMDestroy(&whole));
  PetscCall(DMDestroy(&cell));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ShapesCreate(PetscInt max_shapes, PetscInt max_vertices, Shapes *shapes)
{
  PetscFunctionBeginUser;
  *shapes = (Shapes){.num = 0};
  PetscCall(PetscMalloc3(max_shapes, &shapes->type, max_shapes + 1, &shapes->start, max_vertices, &shapes->vertex));
  shapes->start[0] = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ShapesDestroy(Shapes *shapes)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree3(shapes->type, shapes->start, shapes->vertex));
  PetscCall(PetscFree3(shapes->cone_start, shapes->cone, shapes->orientation));
  PetscFunctionReturn(PETSC_SUCCESS);
}

void ShapesAdd(Shapes *shapes, ElementType type, const PetscInt vertices[])
{
  const PetscInt num = ElementNumNodes(type), start = shapes->start[shapes->num];

  for (PetscInt i = 0; i < num; i++) shapes->vertex[start + i] = vertices[i];
  shapes->type[shapes->num]    = type;
  shapes->start[++shapes->num] = start + num;
}

/* Whether a shape has these vertices in this cyclic order, or in the reverse. In a tangled mesh two different
   quads may have the same vertices. */
static PetscBool ShapeIs_Private(const Shapes *shapes, PetscInt shape, PetscInt num, const PetscInt vertices[])
{
  const PetscInt *own = &shapes->vertex[shapes->start[shape]];

  if (shapes->start[shape + 1] - shapes->start[shape] != num) return PETSC_FALSE;
  for (PetscInt begin = 0; begin < num; begin++) {
    PetscInt forth = 0, back = 0;

    while (forth < num && own[(begin + forth) % num] == vertices[forth]) forth++;
    while (back < num && own[(begin + num - back) % num] == vertices[back]) back++;
    if (PetscMax(forth, back) == num) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* The shape with these vertices, which is added if it is new. Shapes with the same lowest vertex form a
   chain.
   [in,out] head - first shape at every vertex, -1 where there is none; next - in the chain of each shape */
static PetscInt ShapesFind_Private(Shapes *shapes, ElementType type, const PetscInt vertices[], PetscInt head[],
                                   PetscInt next[])
{
  const PetscInt num    = ElementNumNodes(type);
  PetscInt       lowest = vertices[0];

  for (PetscInt i = 1; i < num; i++) lowest = PetscMin(lowest, vertices[i]);
  for (PetscInt shape = head[lowest]; shape >= 0; shape = next[shape]) {
    if (ShapeIs_Private(shapes, shape, num, vertices)) return shape;
  }
  ShapesAdd(shapes, type, vertices);
  next[shapes->num - 1] = head[lowest];
  return head[lowest]   = shapes->num - 1;
}

/* The cone of one shape: its facets, those that are new appended to lower.
   [in,out] head, next - lists of lower by their lowest vertex, of ShapesFind_Private() */
static PetscErrorCode ShapeBound_Private(Shapes *upper, PetscInt shape, const Pattern *pattern, Shapes *lower,
                                         PetscInt head[], PetscInt next[])
{
  const ElementType facet = ElementLinear(ElementFacetType((ElementType)upper->type[shape]));
  const PetscInt    num = ElementNumNodes(facet), first = upper->cone_start[shape];

  PetscFunctionBeginUser;
  for (PetscInt f = 0; f < upper->cone_start[shape + 1] - first; f++) {
    PetscInt vertices[MAX_CORNERS], found;

    for (PetscInt i = 0; i < num; i++) vertices[i] = upper->vertex[upper->start[shape] + pattern->vertex[f][i]];
    found                  = ShapesFind_Private(lower, facet, vertices, head, next);
    upper->cone[first + f] = found;
    PetscCall(DMPolytopeGetVertexOrientation(PlexPolytope[facet], &lower->vertex[lower->start[found]], vertices,
                                             &upper->orientation[first + f]));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ShapesBound(Shapes *upper, PetscInt num_vertices, Shapes *lower)
{
  Pattern   pattern[ELEMENT_COUNT];
  PetscBool known[ELEMENT_COUNT] = {PETSC_FALSE};
  PetscInt *head, *next, num_facets = 0, num_corners = 0;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < upper->num; i++) {
    const ElementType type = (ElementType)upper->type[i];

    num_facets += ElementNumFacets(type);
    num_corners += ElementNumFacets(type) * ElementNumNodes(ElementFacetType(type));
    if (!known[type]) PetscCall(PatternGet_Private(type, &pattern[type]));
    known[type] = PETSC_TRUE;
  }
  PetscCall(ShapesCreate(num_facets, num_corners, lower));
  PetscCall(
      PetscMalloc3(upper->num + 1, &upper->cone_start, num_facets, &upper->cone, num_facets, &upper->orientation));
  PetscCall(PetscMalloc2(num_vertices, &head, num_facets, &next));
  for (PetscInt v = 0; v < num_vertices; v++) head[v] = -1;
  upper->cone_start[0] = 0;
  for (PetscInt i = 0; i < upper->num; i++) {
    upper->cone_start[i + 1] = upper->cone_start[i] + ElementNumFacets((ElementType)upper->type[i]);
    PetscCall(ShapeBound_Private(upper, i, &pattern[upper->type[i]], lower, head, next));
  }
  PetscCall(PetscFree2(head, next));
  PetscFunctionReturn(PETSC_SUCCESS);
}

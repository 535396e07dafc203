/* bisect.h -- conforming bisection of triangles and tetrahedra, and splitting of quadrilaterals and
   hexahedra.

   A cell is halved through the middle of its refinement edge, the one between its first two vertices. In the
   plane the next refinement edge is opposite the newest vertex [1]; in space marks on facets determine it
   [2]. Descendants of a cell have a bounded number of shapes, and no decision after the first marks depends
   on rounding. The result of a refinement is the coarsest conforming one that halves what was asked for: it
   depends on no numbering.

   References:
     [1] W. F. Mitchell, A comparison of adaptive refinement techniques for elliptic problems, ACM Trans.
     Math. Softw. 15
         (1989) 326-347.
     [2] D. N. Arnold, A. Mukherjee, L. Pouly, Locally adapted tetrahedral meshes using bisection, SIAM J.
     Sci. Comput. 22
         (2000) 431-448. */
#ifndef MORTISE_BISECT_H
#define MORTISE_BISECT_H

#include "kernel/edgetable.h"
#include "kernel/element.h"

enum { BISECT_MAX_VERTICES = 8 };

/* A mesh that can be refined. Owned by the caller, BisectionDestroy(). */
typedef struct {
  PetscInt dim, corners, num_vertices, num_cells; /* corners: of a cell, dim+1 of a simplex */
  PetscInt room_vertices, room_cells;             /* that the arrays have */

  PetscInt (*vertex)[BISECT_MAX_VERTICES]; /* the corners of every cell [num_cells] */
  PetscInt (
      *facet)[BISECT_MAX_VERTICES]; /* the caller's number of the facet opposite each vertex of a simplex, of each facet
                                of other cells, which its parts inherit; -1 between cells [num_cells] */
  PetscInt *generation;             /* bisections since the beginning [num_cells] */
  PetscInt (
      *ends)[2]; /* of the edge whose middle a vertex is; of the middle of a face, the middles of two opposite edges of
                    it; -1 for the first ones and middles of cells [num_vertices] */

  /* The cell before the last BisectionRefine(), and the shape functions of order 1 of each vertex in it, in
     that cell's order of vertices. These are dyadic, hence exact [num_cells][corners][corners] */
  PetscInt  *parent;
  PetscReal *place;

  unsigned char *marks; /* private: marked edges of facets, in space [num_cells] */
  PetscInt      *goal;  /* private: generation that is asked for [num_cells] */
} Bisection;

/* Begins with a conforming mesh. The longest edge of a cell and of each facet is its refinement edge, by
   length, then by the vertices' numbers. Cells list it first, so their vertices are reordered. Not
   collective.
   [in] cells - [num_cells][dim+1]; facets - [num_cells][dim+1]; coords - where lengths are measured
   [num_vertices][dim] */
PetscErrorCode BisectionCreate(PetscInt dim, PetscInt num_vertices, PetscInt num_cells, const PetscInt cells[],
                               const PetscInt facets[], const PetscReal coords[], Bisection *mesh);
PetscErrorCode BisectionDestroy(Bisection *mesh);
/* The shape functions of a vertex of a cell in its parent. Borrowed. Not collective. */
PetscReal *BisectionGetPlace(const Bisection *mesh, PetscInt cell, PetscInt vertex);
/* How often a mark of BisectionRefine() halves an edge at most. Not collective. */
PetscInt BisectionGetHalvings(PetscInt mark);
/* Whether the orientation of a cell's vertices is opposite to that in the first mesh. Not collective. */
PetscBool BisectionIsTurned(const Bisection *mesh, PetscInt cell);

/* Bisects cells dim times for each mark, which halves their edges, and other cells until no vertex hangs.
   Cells are in the order of their parents. Vertices keep their numbers; new ones follow. A mark -n is graded
   to vertices: the edges of the cell are halved once. At a vertex whose cells all have marks -n or less they
   are halved max(n, 2 n - 2) times, and in between where this holds at both ends of an edge. Not collective.
   [in] marked - how often edges are halved [num_cells] */
PetscErrorCode BisectionRefine(Bisection *mesh, const PetscInt marked[]);
/* The same for the present cells: parents and coordinates refer to the cells before the last
   BisectionRefine(). Not collective. */
PetscErrorCode BisectionRefineMore(Bisection *mesh, const PetscInt marked[]);

/* The same for quadrilaterals or hexahedra, which keep their type. Each marked cell becomes four or eight for
   each mark. Others are split until two cells with a point in common differ by one splitting at most. So a
   vertex may hang in the middle of an edge or of a face, and the corners of these do not hang. The result is
   the coarsest mesh of this kind. Not collective.
   [in] cells - vertices in the order of element.h [num_cells][corners]; facets - [num_cells][corners], of
   which the first ones count */
PetscErrorCode SplitCreate(PetscInt dim, PetscInt num_vertices, PetscInt num_cells, const PetscInt cells[],
                           const PetscInt facets[], Bisection *mesh);
PetscErrorCode SplitRefine(Bisection *mesh, const PetscInt marked[]);
PetscErrorCode SplitRefineMore(Bisection *mesh, const PetscInt marked[]);
/* What its cells are. */
ElementType SplitElement(const Bisection *mesh);
/* Vertices in the middles of edges, and between the middles of edges. [out] middles - of all edges and faces
   that were split, to be destroyed */
PetscErrorCode SplitGetMiddles(const Bisection *mesh, EdgeTable *middles);
/* The vertex in the middle of a face, -1 if it was not split. [in] middles - of SplitGetMiddles(); corner -
   around the face [4]; [out] middle - of its edges, around it [4], where all have one */
PetscInt SplitFindFace(const EdgeTable *middles, const PetscInt corner[], PetscInt middle[]);

#endif

/* roleorder.c -- roles of all pairs together, so that none run in a circle where that can be.

   Pair p leads to pair q where the mortar side of p touches the nonmortar side of q: there p's multipliers may rest on nodes
   that q's define. Pairs are decided one after the other, the ones with the strongest reasons first, each as it prefers
   unless this closes a circle with what has been decided; where neither way is left, the last decision that can be is taken
   back. The answer depends on the order and on nothing else. */
#include "mesh/meshimpl.h"
#include "base/compat.h"

/* Decisions that are tried, for each pair and at least. */
enum { TRIES_PER_PAIR = 20, TRIES = 2000 };

typedef struct {
  const RoleGraph *graph;
  PetscBool       *decided; /* [num] */
  PetscBool       *seen;    /* by the walk [num] */
  PetscInt        *walk;    /* pairs to go on from [num] */
  PetscBool       *turned;  /* [num] */
  PetscInt         tries;   /* that are left */
} Search;

static PetscBool RoleGraphHasPath_Private(const Search *search, PetscInt p, PetscInt q)
{
  const PetscInt mortar = 2 * p + !search->turned[p], nonmortar = 2 * q + search->turned[q];

  return search->graph->touch[mortar * 2 * search->graph->num + nonmortar];
}

/* Whether decided pairs lead from one of them back to it. */
static PetscBool RoleGraphReturns_Private(Search *search, PetscInt start)
{
  const PetscInt num   = search->graph->num;
  PetscInt       depth = 1;

  for (PetscInt p = 0; p < num; ++p) search->seen[p] = PETSC_FALSE;
  search->walk[0] = start;
  while (depth > 0) {
    const PetscInt p = search->walk[--depth];

    for (PetscInt q = 0; q < num; ++q) {
      if (q == p || !search->decided[q] || search->seen[q] || !RoleGraphHasPath_Private(search, p, q)) continue;
      if (q == start) return PETSC_TRUE;
      search->seen[q]       = PETSC_TRUE;
      search->walk[depth++] = q;
    }
  }
  return PETSC_FALSE;
}

/* Decides the pairs of the order from place k on. */
static PetscBool RoleGraphDecide_Private(Search *search, PetscInt k)
{
  const RoleGraph *graph = search->graph;
  PetscInt         p;

  if (k == graph->num) return PETSC_TRUE;
  p                  = graph->order[k];
  search->decided[p] = PETSC_TRUE;
  if (graph->fixed[p]) return RoleGraphDecide_Private(search, k + 1);
  for (PetscInt turn = 0; turn < 2 && search->tries > 0; ++turn) {
    --search->tries;
    search->turned[p] = turn ? PETSC_TRUE : PETSC_FALSE;
    if (!RoleGraphReturns_Private(search, p) && RoleGraphDecide_Private(search, k + 1)) return PETSC_TRUE;
  }
  search->decided[p] = PETSC_FALSE;
  search->turned[p]  = PETSC_FALSE;
  return PETSC_FALSE;
}

PetscErrorCode RoleGraphOrient(const RoleGraph *graph, PetscBool turned[], PetscBool *found)
{
  Search search = {.graph = graph, .turned = turned, .tries = TRIES + TRIES_PER_PAIR * graph->num};

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc3(graph->num, &search.decided, graph->num, &search.seen, graph->num, &search.walk));
  PetscCall(PetscArrayzero(turned, graph->num));
  *found = RoleGraphDecide_Private(&search, 0);
  PetscCall(PetscFree3(search.decided, search.seen, search.walk));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RoleGraphHasCircle(const RoleGraph *graph, const PetscBool turned[], PetscBool *circle)
{
  Search search = {.graph = graph};

  PetscFunctionBeginUser;
  *circle = PETSC_FALSE;
  PetscCall(PetscCalloc4(graph->num, &search.decided, graph->num, &search.seen, graph->num, &search.walk, graph->num,
                         &search.turned));
  for (PetscInt p = 0; p < graph->num; ++p) {
    search.decided[p] = PETSC_TRUE;
    search.turned[p]  = turned[p];
  }
  for (PetscInt p = 0; p < graph->num && !*circle; ++p) *circle = RoleGraphReturns_Private(&search, p);
  PetscCall(PetscFree4(search.decided, search.seen, search.walk, search.turned));
  PetscFunctionReturn(PETSC_SUCCESS);
}

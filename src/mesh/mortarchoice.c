/* mortarchoice.c -- the choice of the nonmortar side of each pair.

   It is the side of the softer body, else that of the finer mesh, else the smaller side (THEORY.md, section
   7). A stiff nonmortar side would stiffen a soft mortar side in the condensed matrix. The choice is made on
   the coarsest level: sides with a common node there have one on all levels.

   The choices of all pairs together form no cycle, if that is possible. Pair p depends on pair q if the
   mortar side of p touches the nonmortar side of q. Then multipliers of p may depend on displacements that q
   determines. Pairs are decided in sequence, those with the strongest reasons first. Each gets its preferred
   choice, unless that closes a cycle with earlier decisions. If neither choice is possible, the last free
   decision is taken back. The result depends on this order alone. */
#include "base/compat.h"
#include "base/usererror.h"
#include "mesh/mesh.h"
#include "mesh/mortarchoice.h"
#include "side/sidemeasure.h"
#include <string.h>

/* Largest number of decisions: for each pair, and at least. */
enum { TRIES_PER_PAIR = 20, TRIES = 2000 };
static const PetscReal STIFFNESS_RATIO = 3; /* of the contact moduli; below it the mesh decides */
static const PetscReal SAME_SIZE = 1e-6;    /* relative; sizes this near are equal, so that roundoff does not decide */

/* Reasons for a choice, weak to strong. */
typedef enum { REASON_NONE, REASON_SIZE, REASON_FACETS, REASON_MODULUS } Reason;

typedef struct {
  PetscBool swap;     /* whether to exchange the sides */
  Reason    reason;   /* of this choice */
  PetscReal strength; /* the larger measure over the smaller one, in quarters of a power of two */
} Preference;

/* The strength of a ratio in whole steps. Limits of steps are no common ratios, so that roundoff does not
   order similar pairs. */
static PetscReal RatioGetStrength_Private(PetscReal a, PetscReal b)
{
  return PetscFloorReal(4 * PetscLog2Real(a > b ? a / b : b / a) + 0.37);
}

static Preference RolesPrefer_Private(const SideMeasure *nonmortar, const SideMeasure *mortar)
{
  Preference prefer = {.reason = REASON_NONE};
  PetscReal  s = nonmortar->modulus, m = mortar->modulus;

  if (s > STIFFNESS_RATIO * m || m > STIFFNESS_RATIO * s) {
    prefer.reason = REASON_MODULUS;
  } else if (PetscAbsReal(nonmortar->facet_size - mortar->facet_size) > SAME_SIZE * mortar->facet_size) {
    prefer.reason = REASON_FACETS;
    s             = nonmortar->facet_size;
    m             = mortar->facet_size;
  } else if (PetscAbsReal(nonmortar->size - mortar->size) > SAME_SIZE * mortar->size) {
    prefer.reason = REASON_SIZE;
    s             = nonmortar->size;
    m             = mortar->size;
  }
  if (prefer.reason == REASON_NONE) return prefer;
  prefer.swap     = s > m ? PETSC_TRUE : PETSC_FALSE;
  prefer.strength = RatioGetStrength_Private(s, m);
  return prefer;
}

static void PairSwap_Private(ScenePair *pair)
{
  const SceneSide side = pair->nonmortar;

  pair->nonmortar = pair->mortar;
  pair->mortar    = side;
}

/* The preferred choice of a pair. A given choice is kept; if it slows the solver down, the log has a line. */
static PetscErrorCode PairPreferRoles_Private(Scene scene, Level *level, ScenePair *pair, Preference *prefer)
{
  SideMeasure nonmortar, mortar;

  PetscFunctionBeginUser;
  *prefer = (Preference){.reason = REASON_NONE};
  PetscCall(SideMeasureCompute(scene, level, &pair->nonmortar, &nonmortar));
  PetscCall(SideMeasureCompute(scene, level, &pair->mortar, &mortar));
  if (!pair->roles_open) {
    if (nonmortar.modulus > STIFFNESS_RATIO * mortar.modulus) {
      PetscCall(PetscInfo(level->dm,
                          "Pair %s: the nonmortar body is stiffer than the mortar body (contact moduli %g > %g * %g): "
                          "the solver is faster with swapped sides\n",
                          pair->name, (double)nonmortar.modulus, (double)STIFFNESS_RATIO, (double)mortar.modulus));
    }
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  *prefer = RolesPrefer_Private(&nonmortar, &mortar);
  if (prefer->swap) PairSwap_Private(pair);
  PetscCall(PetscInfo(level->dm,
                      "Pair %s: nonmortar is better %s:%s (contact moduli %g and %g, facets %g and %g, sides %g and %g "
                      "as typed)\n",
                      pair->name, scene->bodies[pair->nonmortar.body].name, pair->nonmortar.side,
                      (double)nonmortar.modulus, (double)mortar.modulus, (double)nonmortar.facet_size,
                      (double)mortar.facet_size, (double)nonmortar.size, (double)mortar.size));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Number of a side's facets on this rank. */
static PetscErrorCode SideCount_Private(Scene scene, Level *level, PetscInt body, const char side[], PetscInt *num)
{
  Facets facets;

  PetscFunctionBeginUser;
  PetscCall(LevelGetFacets(level, scene, body, side, &facets));
  *num = facets.num;
  PetscCall(FacetsDestroy(&facets));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether two sides have a facet in common on any rank: their union counts it once. */
static PetscErrorCode SidesShare_Private(Scene scene, Level *level, const SceneSide *a, const SceneSide *b,
                                         PetscBool *share)
{
  const size_t len = strlen(a->side) + strlen(b->side) + sizeof("+");
  PetscInt     num[3]; /* of a, of b, of both */
  char        *both;

  PetscFunctionBeginUser;
  *share = PETSC_FALSE;
  if (a->body != b->body) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(len, &both));
  PetscCall(PetscSNPrintf(both, len, "%s+%s", a->side, b->side));
  PetscCall(SideCount_Private(scene, level, a->body, a->side, &num[0]));
  PetscCall(SideCount_Private(scene, level, a->body, b->side, &num[1]));
  PetscCall(SideCount_Private(scene, level, a->body, both, &num[2]));
  PetscCall(PetscFree(both));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, num, 3, MPIU_INT, MPI_SUM, level->comm));
  *share = num[2] < num[0] + num[1] ? PETSC_TRUE : PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A side may have several partners, each in a pair of its own, but not the same partner twice, and not
   itself. */
static PetscErrorCode PairCheckRoles_Private(Scene scene, Level *level, PetscInt p)
{
  const ScenePair *pair = &scene->pairs[p];
  const char *nonmortar = scene->bodies[pair->nonmortar.body].name, *mortar = scene->bodies[pair->mortar.body].name;
  PetscBool   share;

  PetscFunctionBeginUser;
  PetscCall(SidesShare_Private(scene, level, &pair->nonmortar, &pair->mortar, &share));
  if (share) {
    PetscCall(UserErrorRaise(level->comm,
                             "pair '%s': sides '%s' and '%s' of body '%s' share facets, which cannot touch themselves",
                             pair->name, pair->nonmortar.side, pair->mortar.side, mortar));
  }
  for (PetscInt q = 0; q < p; q++) {
    const ScenePair *before = &scene->pairs[q];

    if (before->mortar.body < 0) continue; // obstacles are all different
    PetscCall(SidesShare_Private(scene, level, &pair->nonmortar, &before->nonmortar, &share));
    if (share) PetscCall(SidesShare_Private(scene, level, &pair->mortar, &before->mortar, &share));
    if (share) {
      PetscCall(UserErrorRaise(level->comm,
                               "pairs '%s' and '%s' join facets of %s:%s to the same facets of %s:%s; omit one of them",
                               before->name, pair->name, nonmortar, pair->nonmortar.side, mortar, pair->mortar.side));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Fixed pairs, then the stronger reason, then the larger ratio, then the earlier pair. [in] prefer - of every
   pair of the graph */
static void MortarChoiceSort_Private(const Preference prefer[], MortarChoice *graph)
{
  for (PetscInt i = 0; i < graph->num; i++) {
    PetscInt at = i;

    for (; at > 0; at--) {
      const PetscInt q = graph->order[at - 1];

      if (graph->fixed[q] || graph->fixed[i]) {
        if (graph->fixed[q] || !graph->fixed[i]) break;
      } else if (prefer[q].reason != prefer[i].reason) {
        if (prefer[q].reason > prefer[i].reason) break;
      } else if (prefer[q].strength >= prefer[i].strength)
        break;
      graph->order[at] = q;
    }
    graph->order[at] = i;
  }
}

/* The side of a pair's end: even ends are nonmortar ones.
   [in] pairs - indices into the scene's, of every pair of the graph */
static const SceneSide *EndGetSide_Private(Scene scene, const PetscInt pairs[], PetscInt end)
{
  const ScenePair *pair = &scene->pairs[pairs[end / 2]];

  return end % 2 ? &pair->mortar : &pair->nonmortar;
}

/* Assumes that all sides of a body touch, which needs no mesh. */
static void MortarChoiceTouchBodies_Private(Scene scene, const PetscInt pairs[], MortarChoice *graph)
{
  const PetscInt num = 2 * graph->num;

  for (PetscInt e = 0; e < num; e++) {
    for (PetscInt f = 0; f < num; f++) {
      graph->touch[e * num + f] =
          (PetscBool)(EndGetSide_Private(scene, pairs, e)->body == EndGetSide_Private(scene, pairs, f)->body);
    }
  }
}

/* Nodes of a side that this rank owns, ascending; facets of other ranks may be the ones that have them.
   Collective.
   [in,out] marks - 0, one value for each node; [out] nodes - owned by the caller */
static PetscErrorCode SideGetNodes_Private(Scene scene, Level *level, const SceneSide *side, Vec marks, PetscInt *num,
                                           PetscInt **nodes)
{
  Facets       facets;
  Vec          local;
  PetscScalar *mark;

  PetscFunctionBeginUser;
  PetscCall(LevelGetFacets(level, scene, side->body, side->side, &facets));
  PetscCall(VecGhostGetLocalForm(marks, &local));
  PetscCall(VecZeroEntries(local));
  PetscCall(VecGetArray(local, &mark));
  for (PetscInt f = 0; f < facets.num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(facets.type[f]); i++)
      mark[facets.nodes[f * ELEMENT_MAX_FACET_NODES + i]] = 1;
  }
  PetscCall(VecRestoreArray(local, &mark));
  PetscCall(VecGhostRestoreLocalForm(marks, &local));
  PetscCall(FacetsDestroy(&facets));
  PetscCall(LevelShareVec(marks, MAX_VALUES));
  PetscCall(VecGetArray(marks, &mark));
  *num = 0;
  for (PetscInt n = 0; n < level->num_owned; n++) *num += PetscRealPart(mark[n]) > 0;
  PetscCall(PetscMalloc1(*num, nodes));
  *num = 0;
  for (PetscInt n = 0; n < level->num_owned; n++) {
    if (PetscRealPart(mark[n]) > 0) (*nodes)[(*num)++] = n;
  }
  PetscCall(VecRestoreArray(marks, &mark));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether two ascending lists have an entry in common. */
static PetscBool ListsShare_Private(PetscInt num_a, const PetscInt a[], PetscInt num_b, const PetscInt b[])
{
  PetscInt i = 0, j = 0;

  while (i < num_a && j < num_b && a[i] != b[j]) {
    if (a[i] < b[j])
      i++;
    else
      j++;
  }
  return i < num_a && j < num_b ? PETSC_TRUE : PETSC_FALSE;
}

/* Finds the sides with a common node. Collective. */
static PetscErrorCode MortarChoiceTouchNodes_Private(Scene scene, Level *level, const PetscInt pairs[],
                                                     MortarChoice *graph)
{
  const PetscInt ends = 2 * graph->num;
  PetscInt      *num, **nodes;
  PetscMPIInt    count;
  Vec            marks;

  PetscFunctionBeginUser;
  PetscCall(PetscMPIIntCast(ends * ends, &count));
  PetscCall(LevelCreateVec(level, 1, &marks));
  PetscCall(PetscMalloc2(ends, &num, ends, &nodes));
  for (PetscInt e = 0; e < ends; e++)
    PetscCall(SideGetNodes_Private(scene, level, EndGetSide_Private(scene, pairs, e), marks, &num[e], &nodes[e]));
  for (PetscInt e = 0; e < ends; e++)
    for (PetscInt f = 0; f < ends; f++)
      graph->touch[e * ends + f] = ListsShare_Private(num[e], nodes[e], num[f], nodes[f]);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, graph->touch, count, MPIU_BOOL, MPI_LOR, level->comm));
  for (PetscInt e = 0; e < ends; e++) PetscCall(PetscFree(nodes[e]));
  PetscCall(PetscFree2(num, nodes));
  PetscCall(VecDestroy(&marks));
  PetscFunctionReturn(PETSC_SUCCESS);
}

typedef struct {
  const MortarChoice *graph;
  PetscBool          *decided; /* [num] */
  PetscBool          *seen;    /* by the walk [num] */
  PetscInt           *walk;    /* pairs to go on from [num] */
  PetscBool          *turned;  /* [num] */
  PetscInt            tries;   /* that are left */
} Search;

static PetscBool MortarChoiceHasPath_Private(const Search *search, PetscInt p, PetscInt q)
{
  const PetscInt mortar = 2 * p + !search->turned[p], nonmortar = 2 * q + search->turned[q];

  return search->graph->touch[mortar * 2 * search->graph->num + nonmortar];
}

/* Whether decided pairs form a cycle. */
static PetscBool MortarChoiceReturns_Private(Search *search, PetscInt start)
{
  const PetscInt num   = search->graph->num;
  PetscInt       depth = 1;

  for (PetscInt p = 0; p < num; p++) search->seen[p] = PETSC_FALSE;
  search->walk[0] = start;
  while (depth > 0) {
    const PetscInt p = search->walk[--depth];

    for (PetscInt q = 0; q < num; q++) {
      if (q == p || !search->decided[q] || search->seen[q] || !MortarChoiceHasPath_Private(search, p, q)) continue;
      if (q == start) return PETSC_TRUE;
      search->seen[q]       = PETSC_TRUE;
      search->walk[depth++] = q;
    }
  }
  return PETSC_FALSE;
}

/* Decides the pairs of the order from index k on. */
static PetscBool MortarChoiceDecide_Private(Search *search, PetscInt k)
{
  const MortarChoice *graph = search->graph;
  PetscInt            p;

  if (k == graph->num) return PETSC_TRUE;
  p                  = graph->order[k];
  search->decided[p] = PETSC_TRUE;
  if (graph->fixed[p]) return MortarChoiceDecide_Private(search, k + 1);
  for (PetscInt turn = 0; turn < 2 && search->tries > 0; turn++) {
    search->tries--;
    search->turned[p] = turn ? PETSC_TRUE : PETSC_FALSE;
    if (!MortarChoiceReturns_Private(search, p) && MortarChoiceDecide_Private(search, k + 1)) return PETSC_TRUE;
  }
  search->decided[p] = PETSC_FALSE;
  search->turned[p]  = PETSC_FALSE;
  return PETSC_FALSE;
}

PetscErrorCode MortarChoiceOrient(const MortarChoice *graph, PetscBool turned[], PetscBool *found)
{
  Search search = {.graph = graph, .turned = turned, .tries = TRIES + TRIES_PER_PAIR * graph->num};

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc3(graph->num, &search.decided, graph->num, &search.seen, graph->num, &search.walk));
  PetscCall(PetscArrayzero(turned, graph->num));
  *found = MortarChoiceDecide_Private(&search, 0);
  PetscCall(PetscFree3(search.decided, search.seen, search.walk));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortarChoiceHasCycle(const MortarChoice *graph, const PetscBool turned[], PetscBool *cycle)
{
  Search search = {.graph = graph};

  PetscFunctionBeginUser;
  *cycle = PETSC_FALSE;
  PetscCall(PetscCalloc4(graph->num, &search.decided, graph->num, &search.seen, graph->num, &search.walk, graph->num,
                         &search.turned));
  for (PetscInt p = 0; p < graph->num; p++) {
    search.decided[p] = PETSC_TRUE;
    search.turned[p]  = turned[p];
  }
  for (PetscInt p = 0; p < graph->num && !*cycle; p++) *cycle = MortarChoiceReturns_Private(&search, p);
  PetscCall(PetscFree4(search.decided, search.seen, search.walk, search.turned));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Considers bodies first: most scenes have no cycle of bodies. If nodes give no choice, or too many, the
   order of bodies is used. If there is none either, preferences are kept; VICreate() raises a user error if
   they form a cycle. Collective.
   [out] turned - [graph->num] */
static PetscErrorCode MortarChoiceSolve_Private(Scene scene, Level *level, const PetscInt pairs[], MortarChoice *graph,
                                                PetscBool turned[])
{
  PetscBool cycle, found;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(turned, graph->num));
  MortarChoiceTouchBodies_Private(scene, pairs, graph);
  PetscCall(MortarChoiceHasCycle(graph, turned, &cycle));
  if (!cycle) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MortarChoiceTouchNodes_Private(scene, level, pairs, graph));
  PetscCall(MortarChoiceOrient(graph, turned, &found));
  if (!found) {
    MortarChoiceTouchBodies_Private(scene, pairs, graph);
    PetscCall(MortarChoiceOrient(graph, turned, &found));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortarChoiceMake(Mesh mesh)
{
  Scene        scene = mesh->scene;
  Level       *level = &mesh->levels[0];
  MortarChoice graph = {.num = 0};
  PetscInt    *pairs;
  Preference  *prefer;
  PetscBool   *turned;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(scene->num_pairs, &pairs, scene->num_pairs, &prefer, scene->num_pairs, &turned));
  PetscCall(PetscMalloc2(scene->num_pairs, &graph.fixed, scene->num_pairs, &graph.order));
  for (PetscInt p = 0; p < scene->num_pairs; p++) {
    ScenePair *pair = &scene->pairs[p];

    if (pair->mortar.body < 0) continue; // an obstacle
    PetscCall(PairPreferRoles_Private(scene, level, pair, &prefer[graph.num]));
    PetscCall(PairCheckRoles_Private(scene, level, p));
    graph.fixed[graph.num] = (PetscBool)!pair->roles_open;
    pairs[graph.num++]     = p;
  }
  PetscCall(PetscMalloc1(4 * graph.num * graph.num, &graph.touch));
  MortarChoiceSort_Private(prefer, &graph);
  PetscCall(MortarChoiceSolve_Private(scene, level, pairs, &graph, turned));
  for (PetscInt i = 0; i < graph.num; i++) {
    ScenePair *pair = &scene->pairs[pairs[i]];

    if (!turned[i]) continue;
    PairSwap_Private(pair);
    PetscCall(PetscInfo(level->dm, "Pair %s: nonmortar is %s:%s instead, since roles would form a cycle\n", pair->name,
                        scene->bodies[pair->nonmortar.body].name, pair->nonmortar.side));
  }
  PetscCall(PetscFree(graph.touch));
  PetscCall(PetscFree2(graph.fixed, graph.order));
  PetscCall(PetscFree3(pairs, prefer, turned));
  PetscFunctionReturn(PETSC_SUCCESS);
}

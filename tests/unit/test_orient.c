/* test_orient.c -- roles without circles: small graphs by hand, and random ones against all choices there are. */
#include "mesh/mesh.h"
#include "mesh/mortarchoice.h"
#include "mesh_scene.h"

enum { MAX_PAIRS = 8, MAX_ENDS = 2 * MAX_PAIRS };

typedef struct {
  MortarChoice graph;
  PetscBool    fixed[MAX_PAIRS], touch[MAX_ENDS * MAX_ENDS];
  PetscInt     order[MAX_PAIRS];
} Case;

static void CaseInit(Case *c, PetscInt num)
{
  memset(c, 0, sizeof(*c));
  c->graph = (MortarChoice){.num = num, .fixed = c->fixed, .order = c->order, .touch = c->touch};
  for (PetscInt p = 0; p < num; ++p) c->order[p] = p;
}

/* By the ways over one, two, ... pairs (Warshall), which is not how the program looks. Circles of given roles alone do not
   count where others are asked for. */
static PetscBool HasCircle(const Case *c, unsigned turned, PetscBool of_others)
{
  const PetscInt num = c->graph.num;
  PetscBool      leads[MAX_PAIRS][MAX_PAIRS];

  for (PetscInt p = 0; p < num; ++p) {
    for (PetscInt q = 0; q < num; ++q) {
      const PetscInt mortar = 2 * p + !(turned >> p & 1), nonmortar = 2 * q + (turned >> q & 1);

      leads[p][q] = (PetscBool)(p != q && c->touch[mortar * 2 * num + nonmortar]);
    }
  }
  for (PetscInt over = 0; over < num; ++over)
    for (PetscInt p = 0; p < num; ++p)
      for (PetscInt q = 0; q < num; ++q) leads[p][q] = (PetscBool)(leads[p][q] || (leads[p][over] && leads[over][q]));
  for (PetscInt p = 0; p < num; ++p)
    if (leads[p][p] && !(of_others && c->fixed[p])) return PETSC_TRUE;
  return PETSC_FALSE;
}

/* The choice that turns the first pair of the order only if none leaves it, and so on; -1 if there is none. Places of the
   order are bits, the first one the highest. */
static PetscInt FindBest(const Case *c)
{
  for (unsigned choice = 0; choice < 1u << c->graph.num; ++choice) {
    unsigned  turned = 0;
    PetscBool given  = PETSC_TRUE;

    for (PetscInt k = 0; k < c->graph.num; ++k) {
      const PetscInt p = c->order[k];

      if (!(choice >> (c->graph.num - 1 - k) & 1)) continue;
      turned |= 1u << p;
      if (c->fixed[p]) given = PETSC_FALSE;
    }
    if (given && !HasCircle(c, turned, PETSC_TRUE)) return (PetscInt)turned;
  }
  return -1;
}

static void CheckCase(const Case *c)
{
  const PetscInt best = FindBest(c);
  PetscBool      turned[MAX_PAIRS], found, cycle;
  unsigned       bits = 0;

  CHECK(!MortarChoiceOrient(&c->graph, turned, &found));
  for (PetscInt p = 0; p < c->graph.num; ++p) bits |= (unsigned)turned[p] << p;
  CHECK(found == (PetscBool)(best >= 0));
  CHECK(bits == (best >= 0 ? (unsigned)best : 0));
  CHECK(!MortarChoiceHasCycle(&c->graph, turned, &cycle));
  CHECK(cycle == HasCircle(c, bits, PETSC_FALSE));
}

static PetscInt Random(PetscInt below)
{
  static unsigned state = 1;

  state = 1103515245u * state + 12345u;
  return (PetscInt)((state >> 16) % (unsigned)below);
}

/* Ends on some bodies, that touch where the body is the same, or by chance, or there less often; some roles given. */
static void TestRandom(void)
{
  PetscInt none = 0, turns = 0;

  for (PetscInt trial = 0; trial < 3000; ++trial) {
    const PetscInt num = 2 + Random(MAX_PAIRS - 1), bodies = 2 + Random(4), ends = 2 * num;
    const PetscInt rare  = Random(4),
                   given = Random(3); // touches of one body that are missing; given roles in a hundred
    PetscInt body[MAX_ENDS], best;
    Case     c;

    CaseInit(&c, num);
    for (PetscInt e = 0; e < ends; ++e) body[e] = Random(bodies);
    for (PetscInt e = 0; e < ends; ++e) {
      c.touch[e * ends + e] = PETSC_TRUE;
      for (PetscInt f = 0; f < e; ++f)
        c.touch[e * ends + f] = c.touch[f * ends + e] = (PetscBool)(body[e] == body[f] && Random(4) >= rare);
    }
    for (PetscInt p = 0; p < num; ++p) c.fixed[p] = (PetscBool)(Random(100) < 25 * given);
    for (PetscInt k = num - 1; k > 0; --k) {
      const PetscInt j = Random(k + 1), swap = c.order[k];

      c.order[k] = c.order[j];
      c.order[j] = swap;
    }
    for (PetscInt k = 1; k < num; ++k) { // given ones first
      const PetscInt p  = c.order[k];
      PetscInt       at = k;

      for (; at > 0 && c.fixed[p] && !c.fixed[c.order[at - 1]]; --at) c.order[at] = c.order[at - 1];
      c.order[at] = p;
    }
    best = FindBest(&c);
    none += best < 0;
    turns += best > 0;
    CheckCase(&c);
  }
  CHECK(none > 50 && turns > 500); // there is something to find, and something that cannot be
}

/* Boxes around the point (1, 1), each in contact with the next: by themselves each would be nonmortar against it. [in] bits -
   pairs whose roles are given, as typed; [out] swapped - bits */
static PetscInt RingOfFour(unsigned given)
{
  static const char *const name[] = {"a", "b", "c", "d"}, *const joint[] = {"ab", "bc", "cd", "da"};
  static const char *const side[4][2]   = {{"right", "left"}, {"top", "bottom"}, {"left", "right"}, {"bottom", "top"}};
  static const PetscReal   corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  static const PetscInt    cells[4][2]  = {{2, 8}, {3, 2}, {2, 6}, {8, 4}}; // all finer than the next
  PetscInt                 swapped      = 0;
  TestScene                t;
  Mesh                     mesh;

  TestSceneInit(&t);
  for (PetscInt b = 0; b < 4; ++b) {
    TestSceneAddBox(&t, name[b], cells[b][0], cells[b][1], corner[b][0], corner[b][1], corner[b][0] + 1,
                    corner[b][1] + 1);
  }
  for (PetscInt p = 0; p < 4; ++p)
    TestSceneAddPair(&t, joint[p], p, side[p][0], (p + 1) % 4, side[p][1])->roles_open = (PetscBool) !(given >> p & 1);
  mesh = TestSceneMesh(&t);
  for (PetscInt p = 0; p < 4; ++p) {
    const PetscBool swap = (PetscBool)(t.pairs[p].nonmortar.body != p);

    CHECK(t.pairs[p].nonmortar.body == (swap ? (p + 1) % 4 : p) && t.pairs[p].mortar.body == (swap ? p : (p + 1) % 4));
    CHECK(!strcmp(t.pairs[p].nonmortar.side, side[p][swap]) && !strcmp(t.pairs[p].mortar.side, side[p][!swap]));
    swapped |= swap << p;
  }
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
  return swapped;
}

/* A row of boxes with a pair of a box's own sides between: sides that share no node lead nowhere, although their body is one. */
static void TestApart(void)
{
  TestScene t;
  Mesh      mesh;

  TestSceneInit(&t);
  TestSceneAddBox(&t, "a", 2, 2, 0, 0, 1, 1);
  TestSceneAddBox(&t, "b", 2, 2, 1, 0, 2, 1);
  TestSceneAddPair(&t, "ab", 0, "right", 1, "left")->roles_open = PETSC_TRUE;
  TestSceneAddPair(&t, "ba", 1, "right", 0, "left")->roles_open = PETSC_TRUE;
  mesh                                                          = TestSceneMesh(&t);
  CHECK(t.pairs[0].nonmortar.body == 0 && t.pairs[1].nonmortar.body == 1);
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

int main(int argc, char **argv)
{
  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL));
  CHECK(!UserErrorInitialize());
  TestRandom();
  CHECK(RingOfFour(0x0) == 0x4); // facets are 4, 1.5, 1.5 and 4 times as fine: the later one of the weakest
  CHECK(RingOfFour(0x4) == 0x2);
  CHECK(RingOfFour(0x6) == 0x8);
  CHECK(RingOfFour(0xe) == 0x1);
  CHECK(RingOfFour(0xf) == 0x0); // a cycle, as it was given
  TestApart();
  CHECK(!PetscFinalize());
  return 0;
}

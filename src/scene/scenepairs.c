/* scenepairs.c -- pairs of sides, and checks of their sides. */
#include "scene/sceneparts.h"
#include <string.h>

/* Splits "body:side". */
static PetscErrorCode PairParseSide_Private(Scene scene, const Option *option, const char text[], SceneSide *side)
{
  char        body[OPTION_MAX];
  const char *colon = strchr(text, ':');

  PetscFunctionBeginUser;
  if (!colon || colon == text || !colon[1])
    PetscCall(OptionRaise(option, "'%s' does not name a side; write body:side", text));
  PetscCall(PetscSNPrintf(body, sizeof(body), "%.*s", (int)(colon - text), text));
  PetscCall(SceneNamesFindBody(scene, option, body, &side->body));
  PetscCall(SceneSideCheck(option, &scene->bodies[side->body], colon + 1));
  PetscCall(PetscStrallocpy(colon + 1, &side->side));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Reads an option that is one side. */
static PetscErrorCode PairReadSide_Private(Scene scene, const Option *option, SceneSide *side)
{
  const char *cursor = NULL;
  char        item[OPTION_MAX];

  PetscFunctionBeginUser;
  if (OptionCountItems(option) != 1)
    PetscCall(OptionRaise(option, "is a list; it takes one side as body:side, parts of it joined by +"));
  PetscCall(OptionNextItem(option, &cursor, item));
  PetscCall(PairParseSide_Private(scene, option, item, side));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Both sides by -<pair>_sides: the roles stay open. */
static PetscErrorCode PairReadOpenSides_Private(Scene scene, ScenePair *pair, const Option *sides)
{
  const char *cursor = NULL;
  char        item[OPTION_MAX];

  PetscFunctionBeginUser;
  if (OptionCountItems(sides) != 2) PetscCall(OptionRaise(sides, "must hold two sides, as in upper:bottom,lower:top"));
  pair->roles_open = PETSC_TRUE;
  PetscCall(OptionNextItem(sides, &cursor, item));
  PetscCall(PairParseSide_Private(scene, sides, item, &pair->nonmortar));
  PetscCall(OptionNextItem(sides, &cursor, item));
  PetscCall(PairParseSide_Private(scene, sides, item, &pair->mortar));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The two sides, or the one side and the obstacle. */
static PetscErrorCode PairReadSides_Private(Scene scene, ScenePair *pair)
{
  Option nonmortar, mortar, sides, obstacle;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-<pair>_nonmortar", pair->name, NULL, &nonmortar));
  PetscCall(OptionFind(scene, "-<pair>_mortar", pair->name, NULL, &mortar));
  PetscCall(OptionFind(scene, "-<pair>_sides", pair->name, NULL, &sides));
  PetscCall(OptionFind(scene, "-<pair>_obstacle", pair->name, NULL, &obstacle));
  if (sides.set) {
    const Option *other = nonmortar.set ? &nonmortar : mortar.set ? &mortar : &obstacle;

    if (other->set)
      PetscCall(OptionRaise(other, "the pair has both its sides already (%s %s); give one of the two", sides.name,
                            sides.text));
    PetscCall(PairReadOpenSides_Private(scene, pair, &sides));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(
      OptionRequire(&nonmortar, "a pair needs the side that carries the pressure, or both sides by -<pair>_sides"));
  PetscCall(PairReadSide_Private(scene, &nonmortar, &pair->nonmortar));
  if (mortar.set && obstacle.set)
    PetscCall(OptionRaise(&obstacle, "the pair has a mortar side already (%s %s); give one of the two", mortar.name,
                          mortar.text));
  if (obstacle.set) {
    PetscCall(SceneObstacleRead(scene, pair, &obstacle));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(OptionRequire(&mortar, "a pair needs the side that is met, or an obstacle by -<pair>_obstacle"));
  PetscCall(PairReadSide_Private(scene, &mortar, &pair->mortar));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Type, gaps, reach, and whether the pair may be empty. Sides that are glued have no gap to give. */
static PetscErrorCode PairReadLaw_Private(Scene scene, ScenePair *pair)
{
  Option   type, gap, offset, reach, empty;
  PetscInt choice = PAIR_CONTACT;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-<pair>_type", pair->name, NULL, &type));
  PetscCall(OptionFind(scene, "-<pair>_gap", pair->name, NULL, &gap));
  PetscCall(OptionFind(scene, "-<pair>_gap_offset", pair->name, NULL, &offset));
  PetscCall(OptionGetChoice(&type, &choice));
  pair->type = (PairType)choice;
  if (pair->type == PAIR_TIED && (gap.set || offset.set)) {
    PetscCall(
        OptionRaise(gap.set ? &gap : &offset, "tied sides have no gap; a gap is for -%s_type contact", pair->name));
  }
  if (pair->type == PAIR_TIED && pair->obstacle.kind != OBSTACLE_NONE) {
    PetscCall(OptionRaise(&type,
                          "a side that is tied to a rigid obstacle does not move; fix it with -%s_bc_displacement",
                          scene->bodies[pair->nonmortar.body].name));
  }
  PetscCall(OptionGetExpression(&gap, 1, PETSC_FALSE, &pair->gap));
  PetscCall(OptionGetExpression(&offset, 1, PETSC_FALSE, &pair->gap_offset));
  pair->reach = -1;
  PetscCall(OptionFind(scene, "-<pair>_reach", pair->name, NULL, &reach));
  PetscCall(OptionGetReals(&reach, 1, &pair->reach));
  if (reach.set && !(pair->reach > 0)) PetscCall(OptionRaise(&reach, "a distance must be above 0"));
  PetscCall(OptionFind(scene, "-<pair>_allow_empty", pair->name, NULL, &empty));
  PetscCall(OptionGetBool(&empty, &pair->allow_empty));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Coulomb's friction, or Tresca's. Zero is no friction, and costs nothing. */
static PetscErrorCode PairReadFriction_Private(Scene scene, ScenePair *pair)
{
  Option          friction, bound;
  const PetscReal origin[3] = {0, 0, 0};

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-<pair>_friction", pair->name, NULL, &friction));
  PetscCall(OptionFind(scene, "-<pair>_friction_bound", pair->name, NULL, &bound));
  if (pair->type == PAIR_TIED && (friction.set || bound.set)) {
    PetscCall(OptionRaise(friction.set ? &friction : &bound,
                          "tied sides cannot slide; friction is for -%s_type contact", pair->name));
  }
  PetscCall(OptionGetExpression(&friction, 1, PETSC_FALSE, &pair->friction));
  PetscCall(OptionGetExpression(&bound, 1, PETSC_FALSE, &pair->bound));
  for (int i = 0; i < 2; i++) {
    Expression   *e      = i ? &pair->bound : &pair->friction;
    const Option *option = i ? &bound : &friction;
    PetscReal     value;

    if (!*e || !ExpressionIsConstant(*e)) continue;
    PetscCall(ExpressionEvaluate(*e, 3, origin, &value));
    if (!(value >= 0)) PetscCall(OptionRaise(option, "must not be negative"));
    if (value == 0) PetscCall(ExpressionDestroy(e));
  }
  if (pair->friction && pair->bound)
    PetscCall(OptionRaise(&bound, "the pair has Coulomb's friction already (%s %s); give one of the two", friction.name,
                          friction.text));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Which nodes carry multipliers, and the exact pressure. */
static PetscErrorCode PairReadPressure_Private(Scene scene, ScenePair *pair)
{
  Option   multipliers, exact;
  PetscInt choice = MULTIPLIERS_NODES;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-<pair>_multipliers", pair->name, NULL, &multipliers));
  PetscCall(OptionFind(scene, "-<pair>_exact_pressure", pair->name, NULL, &exact));
  PetscCall(OptionGetChoice(&multipliers, &choice));
  pair->multipliers = (PairMultipliers)choice;
  if (exact.set && pair->type == PAIR_TIED) {
    PetscCall(OptionRaise(&exact, "tied sides have no contact pressure; an exact pressure is for -%s_type contact",
                          pair->name));
  }
  PetscCall(OptionGetExpression(&exact, 1, PETSC_FALSE, &pair->exact));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The boundary that leaves a side no freedom along its normal, or NULL: such a side cannot carry a
   multiplier. */
static const SceneBoundary *PairFindHeld_Private(Scene scene, const SceneSide *side)
{
  const SceneBody *body = &scene->bodies[side->body];

  for (PetscInt i = 0; i < body->num_boundaries; i++) {
    const SceneBoundary *boundary = &body->boundaries[i];

    if (!SceneSideOverlaps(boundary->side, side->side, NULL)) continue;
    if (boundary->kind == BOUNDARY_NORMAL || SceneBoundaryFixesAll(scene, boundary)) return boundary;
  }
  return NULL;
}

/* Raises a user error where the nonmortar side is fixed; open roles are settled where only one side is free
   to carry the multiplier. */
static PetscErrorCode PairCheckHeld_Private(Scene scene, ScenePair *pair)
{
  const SceneBoundary *held       = PairFindHeld_Private(scene, &pair->nonmortar);
  const PetscBool      other_free = (PetscBool)(pair->mortar.body >= 0 && !PairFindHeld_Private(scene, &pair->mortar));
  const char          *body       = scene->bodies[pair->nonmortar.body].name;

  PetscFunctionBeginUser;
  if (pair->roles_open && other_free != !held) {
    const SceneSide side = pair->nonmortar;

    if (held) {
      pair->nonmortar = pair->mortar;
      pair->mortar    = side;
    }
    pair->roles_open = PETSC_FALSE;
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  if (held) {
    PetscCall(UserErrorRaise(scene->comm,
                             "-%s_%s: the side %s:%s cannot carry a contact pressure, -%s_bc_%s fixes it at %s; %s",
                             pair->name, pair->roles_open ? "sides" : "nonmortar", body, pair->nonmortar.side, body,
                             held->kind == BOUNDARY_NORMAL ? "normal" : "displacement", held->side,
                             other_free ? "exchange its nonmortar and its mortar side, or leave the side free"
                                        : "leave one side of the pair free"));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscBool PairSameSide_Private(const SceneSide *a, const SceneSide *b)
{
  return (PetscBool)(a->body >= 0 && a->body == b->body && SceneSideOverlaps(a->side, b->side, NULL));
}

/* Raises a user error where a side meets itself, or where an earlier pair joins the same two sides in either
   order. */
static PetscErrorCode PairCheckTwice_Private(Scene scene, const ScenePair *pair)
{
  const SceneSide *s = &pair->nonmortar, *m = &pair->mortar;

  PetscFunctionBeginUser;
  if (PairSameSide_Private(s, m)) {
    PetscCall(
        UserErrorRaise(scene->comm,
                       "the pair %s: the side %s:%s would meet itself; -%s_nonmortar and -%s_mortar (or -%s_sides) "
                       "must name two sides",
                       pair->name, scene->bodies[s->body].name, s->side, pair->name, pair->name, pair->name));
  }
  for (const ScenePair *other = scene->pairs; other < pair; other++) {
    const SceneSide *so = &other->nonmortar, *mo = &other->mortar;

    if (m->body < 0) continue;
    if ((PairSameSide_Private(s, so) && PairSameSide_Private(m, mo)) ||
        (PairSameSide_Private(s, mo) && PairSameSide_Private(m, so))) {
      PetscCall(UserErrorRaise(
          scene->comm, "-pairs: %s and %s join the same two sides, %s:%s and %s:%s; omit one of the pairs", other->name,
          pair->name, scene->bodies[s->body].name, s->side, scene->bodies[m->body].name, m->side));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ScenePairRead(Scene scene, ScenePair *pair)
{
  PetscFunctionBeginUser;
  pair->mortar.body = -1;
  PetscCall(PairReadSides_Private(scene, pair));
  PetscCall(PairCheckTwice_Private(scene, pair));
  PetscCall(PairReadLaw_Private(scene, pair));
  PetscCall(PairReadFriction_Private(scene, pair));
  PetscCall(PairReadPressure_Private(scene, pair));
  PetscCall(PairCheckHeld_Private(scene, pair));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ScenePairDestroy(ScenePair *pair)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(pair->name));
  PetscCall(PetscFree(pair->nonmortar.side));
  PetscCall(PetscFree(pair->mortar.side));
  PetscCall(ExpressionDestroy(&pair->obstacle.gap));
  PetscCall(ExpressionDestroy(&pair->gap));
  PetscCall(ExpressionDestroy(&pair->gap_offset));
  PetscCall(ExpressionDestroy(&pair->friction));
  PetscCall(ExpressionDestroy(&pair->bound));
  PetscCall(ExpressionDestroy(&pair->exact));
  PetscFunctionReturn(PETSC_SUCCESS);
}

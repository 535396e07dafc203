/* bars.c -- error bars of the numbers of the summary. */
#include "base/compat.h"
#include "base/json.h"
#include "kernel/vector.h"
#include "study/bars.h"
#include <math.h>
#include <string.h>

enum {
  MAX_ITEMS   = 8, /* largest number of items of an array */
  BAR_MESHES  = 4, /* differences of a bar: so many hardly agree by chance */
  PEAK_MESHES = 3, /* increments of a largest pressure that are compared */
  PEAK_SIZES  = 5, /* sizes of its facets that are compared */
  PEAK_DOUBTS = 2  /* smaller sizes that must not show growth before what was unbounded has a limit */
};

static const PetscReal BAR_MARGIN = 1.25; /* factor of differences */
static const PetscReal LEAST_GAIN = 0.95; /* largest ratio of estimates: nearly equal meshes tell little */
static const PetscReal FALLEN     = 0.25; /* of the first estimate: below, fewer meshes are enough */
static const PetscReal SETTLES    = 0.5;  /* largest ratio of an increment to the one before that shows a rate */
static const PetscReal GROWN = 0.1; /* part of a stress that it has grown by over BAR_MESHES: it is far from a limit */
static const PetscReal STRESS_ROUNDING = 1e-9; /* part of its floor below which a stress is zero but for rounding */
/* Least ratio of an increment to the one before that shows no limit. */
static const PetscReal STILL_GROWS  = 0.8;
static const PetscReal SEEN_GROWING = 0.03; /* part of a pressure that it grows by over PEAK_MESHES, at least */
/* A pressure grows as at a corner if it is the size of facets there to a power of at most -CORNER_POWER. The
   power is -0.23 for two equal bodies with a square edge, -0.5 for a rigid punch, and -0.66 on its first
   meshes. Faster growth is that of meshes that have yet to find the contact. Facets are at most CORNER_FACET
   of the extent of contact, and at most CORNER_REFINED of those of the mesh before. */
static const PetscReal CORNER_POWER = 0.2, CORNER_MOST = 0.7, CORNER_FACET = 0.1, CORNER_REFINED = 0.6;
/* Least exponent of a pressure at an edge that is known to be unbounded there: at 0.01375 ten halvings raise
   it by a tenth. Its facets are at most this part of the extent of contact. */
static const PetscReal EDGE_EXPONENT = 0.01375, EDGE_FACET = 0.4;
/* Least ratio of its growth over two halvings of facets to that over the two before. It is 0.25 if the error
   is of order h, 1 if it is that of a logarithm. */
static const PetscReal CORNER_GROWS = 0.6;

/* The floor of a number: its least bar. */
typedef enum {
  FLOOR_WHOLE,  /* relative, of the whole solution */
  FLOOR_BODY,   /* relative, of a body */
  FLOOR_SIDE,   /* the same, of the body's largest reaction */
  FLOOR_PROBE,  /* of a probe's displacement: of its body and of its cell */
  FLOOR_STRESS, /* of a probe's cell, as the two below */
  FLOOR_VON_MISES,
  FLOOR_PRINCIPAL,
  FLOOR_PRESSURE,
  FLOOR_MEAN,
  FLOOR_EDGE,
  FLOOR_AREA,
  FLOOR_SLIP, /* the larger one of that of the whole, and of a pair that sticks */
  FLOOR_WORK, /* the same, of work */
  FLOOR_HELD, /* the larger one of that of the whole, and of the force that held nodes lack */
  FLOOR_PLACE /* the larger one of that of the whole, times half the extent of contact, and of the pair */
} FloorKind;

static const struct {
  const char *key;
  FloorKind   kind;
} PAIR_NUMBERS[] =
    {{"force", FLOOR_HELD},         {"normal_force", FLOOR_WHOLE},      {"area", FLOOR_AREA},
     {"mean_pressure", FLOOR_MEAN}, {"max_pressure", FLOOR_PRESSURE},   {"max_pressure_covered", FLOOR_PRESSURE},
     {"min_gap", FLOOR_WHOLE},      {"centre_of_pressure", FLOOR_PLACE}},
  FRICTION_NUMBERS[] = {{"tangential_force", FLOOR_HELD}, {"max_slip", FLOOR_SLIP}, {"dissipation", FLOOR_WORK}},
  PROBE_NUMBERS[]    = {{"displacement", FLOOR_PROBE},
                        {"stress", FLOOR_STRESS},
                        {"von_mises", FLOOR_VON_MISES},
                        {"principal", FLOOR_PRINCIPAL}};

/* A number of a mesh's row, or the numbers of an array. */
typedef struct {
  const char *section, *owner, *key, *end; /* end: of an extent, else NULL */
} BarPath;

/* Returns the number of values, 0 where nothing has the path.
   [out] values - [MAX_ITEMS]; [out] list - whether it is an array */
static PetscInt BarsRead_Private(const cJSON *row, const BarPath *path, PetscReal values[], PetscBool *list)
{
  const cJSON *item = cJSON_GetObjectItemCaseSensitive(row, path->section), *each;
  PetscInt     num  = 0;

  if (path->owner) item = cJSON_GetObjectItemCaseSensitive(item, path->owner);
  if (path->key) item = cJSON_GetObjectItemCaseSensitive(item, path->key);
  if (path->end) item = cJSON_GetObjectItemCaseSensitive(item, path->end);
  *list = (PetscBool)cJSON_IsArray(item);
  if (!item) return 0;
  if (!*list) {
    values[0] = JSONReadReal(item);
    return 1;
  }
  cJSON_ArrayForEach(each, item)
  {
    if (num < MAX_ITEMS) values[num++] = JSONReadReal(each);
  }
  return num;
}

/* Whether a sequence is monotone, and each increment at most half as large as the one before. */
static PetscBool BarsSettle_Private(PetscInt num, const PetscReal Q[])
{
  for (PetscInt j = 2; j < num; j++) {
    const PetscReal step = Q[j] - Q[j - 1], before = Q[j - 1] - Q[j - 2];

    if (!(step * before >= 0 && PetscAbsReal(step) <= SETTLES * PetscAbsReal(before))) return PETSC_FALSE;
  }
  return (PetscBool)(num > 2);
}

/* The bar from differences of meshes. Few meshes do not show a rate: then it is the largest difference, times
   BAR_MESHES over the number of differences. [in] Q - of all meshes, NAN for none [num] */
static PetscReal BarsOfSequence_Private(const BarHistory *history, const PetscReal Q[])
{
  const PetscInt  last = history->num - 1;
  const PetscReal eta  = history->mesh[last].eta;
  const PetscBool few =
      (PetscBool)(last < BAR_MESHES && (eta > FALLEN * history->mesh[0].eta || history->mesh[last].lost ||
                                        !BarsSettle_Private(history->num, Q)));
  PetscReal bar = 0;

  if (!last) return (PetscReal)NAN;
  for (PetscInt j = PetscMax(0, last - BAR_MESHES); j < last; j++) {
    const PetscReal before = history->mesh[j].eta;
    const PetscReal r      = before > 0 ? PetscMin(eta / before, LEAST_GAIN) : LEAST_GAIN;
    const PetscReal factor = few ? (PetscReal)BAR_MESHES / last : BAR_MARGIN * r / (1 - r);

    if (PetscIsNanReal(Q[j])) return (PetscReal)NAN;
    bar = PetscMax(bar, factor * PetscAbsReal(Q[last] - Q[j]));
  }
  return bar;
}

/* Half of the box around the contact of a pair. Returns the number of coordinates.
   [in] path - of a number of the pair; [out] half - [MAX_ITEMS] */
static PetscInt BarsGetHalfExtent_Private(const cJSON *row, const BarPath *path, PetscReal half[])
{
  const BarPath  lower            = {path->section, path->owner, "extent", "lower"};
  const BarPath  upper            = {path->section, path->owner, "extent", "upper"};
  PetscReal      start[MAX_ITEMS] = {0};
  PetscBool      list;
  const PetscInt num = BarsRead_Private(row, &upper, half, &list);

  (void)BarsRead_Private(row, &lower, start, &list);
  for (PetscInt i = 0; i < num; i++) half[i] = (half[i] - start[i]) / 2;
  return num;
}

/* Whether facets at a largest pressure are small against the extent of contact on a mesh.
   [in] path - of the pressure; [in] size - of the facets; [in] part - of the extent that they are at most */
static PetscBool BarsPeakIsWithin_Private(const BarHistory *history, const BarPath *path, PetscInt mesh, PetscReal size,
                                          PetscReal part)
{
  PetscReal      half[MAX_ITEMS];
  const PetscInt num = BarsGetHalfExtent_Private(history->mesh[mesh].row, path, half);

  return (PetscBool)(size > 0 && size <= part * 2 * VectorNorm(num, half));
}

static PetscBool BarsPeakIsFine_Private(const BarHistory *history, const BarPath *path, PetscInt mesh, PetscReal size)
{
  return BarsPeakIsWithin_Private(history, path, mesh, size, CORNER_FACET);
}

/* The increment of a largest pressure for each halving of its facets: a mesh may halve them twice. Facets
   that stay as they are count as one halving. [in] before, size - of these facets on both meshes */
static PetscReal BarsGetStep_Private(PetscReal step, PetscReal before, PetscReal size)
{
  return step / PetscMax(1, PetscLog2Real(before / size));
}

/* Whether a side or an obstacle ends at the largest pressure of the last mesh. There, facets need not be
   small against a rounded edge before growth counts, only against the contact, and that at last. */
static PetscBool BarsPeakEnds_Private(const BarHistory *history, PetscInt p)
{
  const PeakShape shape = history->mesh[history->num - 1].peak[p].shape;

  return (PetscBool)(shape == PEAK_END || shape == PEAK_KINK);
}

/* Whether a largest pressure grows by increments that do not shrink, on meshes that resolve the contact. */
static PetscBool BarsGrows_Private(const BarHistory *history, const BarPath *path, PetscInt p, const PetscReal Q[])
{
  const PetscInt first = history->num - PEAK_MESHES, fine = BarsPeakEnds_Private(history, p) ? history->num - 1 : first;
  const BarMesh *mesh  = history->mesh;
  PetscReal      least = 0;

  if (first < 1 || !BarsPeakIsFine_Private(history, path, fine, mesh[fine].peak[p].size)) return PETSC_FALSE;
  for (PetscInt j = first; j < history->num; j++) {
    const PetscReal step = BarsGetStep_Private(Q[j] - Q[j - 1], mesh[j - 1].peak[p].size, mesh[j].peak[p].size);

    if (!(step > least)) return PETSC_FALSE;
    least = STILL_GROWS * step;
  }
  return (PetscBool)(Q[history->num - 1] - Q[first - 1] > SEEN_GROWING * Q[history->num - 1]);
}

/* Whether a largest pressure grows like a power of the size of its facets, as at a corner: three meshes tell
   that. */
static PetscBool BarsIsCorner_Private(const BarHistory *history, const BarPath *path, PetscInt p, const PetscReal Q[])
{
  const PetscInt first = history->num - PEAK_MESHES, fine = BarsPeakEnds_Private(history, p) ? history->num - 1 : first;
  const BarMesh *mesh;
  PetscReal      power[PEAK_MESHES];

  if (first < 0 || !BarsPeakIsFine_Private(history, path, fine, history->mesh[fine].peak[p].size)) return PETSC_FALSE;
  mesh = &history->mesh[first];
  Q    = &Q[first];
  for (PetscInt j = 1; j < PEAK_MESHES; j++) {
    const PetscReal size = mesh[j].peak[p].size, before = mesh[j - 1].peak[p].size;

    if (!(size <= CORNER_REFINED * before && Q[j - 1] > 0)) return PETSC_FALSE;
    power[j] = PetscLogReal(Q[j] / Q[j - 1]) / PetscLogReal(before / size);
    if (!(power[j] >= CORNER_POWER && power[j] <= CORNER_MOST)) return PETSC_FALSE;
    if (j > 1 && !(power[j] > STILL_GROWS * power[j - 1])) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

/* The largest pressure of each of the last sizes of its facets, fine to coarse. Facets are not refined for
   each mesh, and a mesh that refines the other side alone may lower it. Returns the number of sizes.
   [out] size, most - [PEAK_SIZES] */
static PetscInt BarsGetSizes_Private(const BarHistory *history, PetscInt p, const PetscReal Q[], PetscReal size[],
                                     PetscReal most[])
{
  PetscInt k = 0;

  for (PetscInt mesh = history->num - 1; mesh >= 0; mesh--) {
    const PetscReal here = history->mesh[mesh].peak[p].size;

    if (k == 0 || size[k - 1] <= CORNER_REFINED * here) {
      if (k == PEAK_SIZES) break;
      size[k]   = here;
      most[k++] = Q[mesh];
    } else if (k == 1) {
      size[0] = here;
    }
    most[k - 1] = PetscMax(most[k - 1], Q[mesh]);
  }
  return k;
}

/* Whether a largest pressure grows over the last sizes of its facets. */
static PetscBool BarsPeakGrows_Private(const BarHistory *history, const BarPath *path, PetscInt p, const PetscReal Q[])
{
  const PetscInt last = history->num - 1, fine = BarsPeakEnds_Private(history, p) ? 1 : PEAK_SIZES - 1;
  PetscReal      most[PEAK_SIZES], size[PEAK_SIZES];

  return (PetscBool)(BarsGetSizes_Private(history, p, Q, size, most) == PEAK_SIZES &&
                     BarsPeakIsFine_Private(history, path, last, size[fine]) && most[0] - most[4] > GROWN * most[0] &&
                     most[0] > most[1] && most[2] > most[4] && most[0] - most[2] > CORNER_GROWS * (most[2] - most[4]));
}

/* Whether the largest pressure at an edge of an obstacle is larger than on facets of the size before. */
static PetscBool BarsEdgeGrows_Private(const BarHistory *history, PetscInt p, const PetscReal Q[])
{
  PetscReal most[PEAK_SIZES], size[PEAK_SIZES];

  return (PetscBool)(history->num >= PEAK_MESHES && BarsGetSizes_Private(history, p, Q, size, most) > 1 &&
                     most[0] - most[1] > SEEN_GROWING * most[0]);
}

/* Whether a largest pressure has no limit. What earlier meshes showed of a corner holds until PEAK_DOUBTS
   smaller sizes of facets do not show it. Where contact ends between nodes, single meshes tell less.
   [in] path - of the pressure; [in] p - its pair */
static PetscBool BarsIsUnbounded_Private(const BarHistory *history, const BarPath *path, PetscInt p,
                                         const PetscReal Q[])
{
  const Peak *last   = &history->mesh[history->num - 1].peak[p];
  BarHistory  part   = *history;
  PetscReal   size   = last->size;
  PetscInt    doubts = 0;

  if (last->shape == PEAK_SMOOTH) return PETSC_FALSE;
  if (last->exponent >= EDGE_EXPONENT &&
      BarsPeakIsWithin_Private(history, path, history->num - 1, last->size, EDGE_FACET))
    return PETSC_TRUE;
  if (last->shape == PEAK_KINK && BarsEdgeGrows_Private(history, p, Q)) return PETSC_TRUE;
  if (BarsGrows_Private(history, path, p, Q)) return PETSC_TRUE;
  for (part.num = history->num; part.num >= PEAK_MESHES && doubts < PEAK_DOUBTS; part.num--) {
    const PetscReal before = history->mesh[part.num - 1].peak[p].size;

    if (size <= CORNER_REFINED * before) {
      doubts++;
      size = before;
    }
    if (doubts < PEAK_DOUBTS && (BarsIsCorner_Private(&part, path, p, Q) || BarsPeakGrows_Private(&part, path, p, Q)))
      return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* Whether a stress grows as at a corner, where it is unbounded. It does so over the last two meshes nearly as
   much as over the two before, and visibly. Cells around a probe are not bisected for each mesh, so single
   increments tell less. */
static PetscBool BarsStressGrows_Private(PetscInt num, const PetscReal Q[])
{
  const PetscReal last   = num > BAR_MESHES ? PetscAbsReal(Q[num - 1]) : 0;
  const PetscReal middle = num > BAR_MESHES ? PetscAbsReal(Q[num - 1 - BAR_MESHES / 2]) : 0;
  const PetscReal first  = num > BAR_MESHES ? PetscAbsReal(Q[num - 1 - BAR_MESHES]) : 0;

  return (PetscBool)(last - first > GROWN * last && last - middle > STILL_GROWS * (middle - first) && middle > first);
}

/* The largest reaction of a body. [in] path - of one of its reactions, <body>:<side> */
static PetscReal BarsGetLargestReaction_Private(const cJSON *row, const BarPath *path)
{
  const size_t length  = strcspn(path->owner, ":") + 1;
  PetscReal    largest = 0, values[MAX_ITEMS];
  const cJSON *item;
  PetscBool    list;

  cJSON_ArrayForEach(item, cJSON_GetObjectItemCaseSensitive(row, path->section))
  {
    const BarPath other = {path->section, item->string, NULL, NULL};

    if (!strncmp(item->string, path->owner, length))
      largest = PetscMax(largest, VectorNorm(BarsRead_Private(row, &other, values, &list), values));
  }
  return largest;
}

/* What a floor needs beside the number: the area of contact for mean pressures, the body's largest reaction
   for reactions. */
static PetscReal BarsGetBeside_Private(const cJSON *row, const BarPath *path, FloorKind kind)
{
  const BarPath area              = {path->section, path->owner, "area", NULL};
  PetscReal     values[MAX_ITEMS] = {0};
  PetscBool     list;

  if (kind == FLOOR_SIDE) return BarsGetLargestReaction_Private(row, path);
  if (kind == FLOOR_MEAN) (void)BarsRead_Private(row, &area, values, &list);
  return values[0];
}

/* The floor of a mean pressure: the force may be larger, and the area of contact smaller. NAN if nothing is
   left of the area: such a mean has no bound.
   [in] whole - floor of the force, relative; error - floor of the area */
static PetscReal BarsGetMeanFloor_Private(PetscReal whole, PetscReal error, PetscReal mean, PetscReal area)
{
  if (!(area > 0)) return mean * whole;
  return error < area ? mean * ((1 + whole) / (1 - error / area) - 1) : (PetscReal)NAN;
}

/* The floor of a number, NAN if its error has no bound.
   [in] owner - index of the body, side, pair or probe; i - of the number in its array; size - of the
   number, or of its vector; of a position, half the extent of contact; beside - of BarsGetBeside_Private() */
static PetscReal BarsGetFloor_Private(const BarHistory *history, FloorKind kind, PetscInt owner, PetscInt i,
                                      PetscReal size, PetscReal beside)
{
  const BarFloors *floors = history->floors;

  switch (kind) {
  case FLOOR_BODY: return floors->body[owner] * size;
  case FLOOR_SIDE:
    return PetscMax(floors->side[owner].least[i],
                    PetscMax(floors->whole * size, floors->side[owner].relative * beside));
  case FLOOR_PROBE: return floors->body[history->scene->probes[owner].body] * size + floors->probe[owner].displacement;
  case FLOOR_STRESS: return floors->probe[owner].stress;
  case FLOOR_VON_MISES: return floors->probe[owner].von_mises;
  case FLOOR_PRINCIPAL: return floors->probe[owner].principal;
  case FLOOR_PRESSURE: return floors->pair[owner].pressure;
  case FLOOR_EDGE: return floors->pair[owner].edge[i];
  case FLOOR_AREA: return floors->pair[owner].area;
  case FLOOR_SLIP: return PetscMax(floors->whole * size, floors->pair[owner].friction.slip);
  case FLOOR_HELD: return PetscMax(floors->whole * size, BAR_MARGIN * floors->pair[owner].friction.held);
  case FLOOR_WORK: return PetscMax(floors->whole * size, floors->pair[owner].friction.work);
  case FLOOR_MEAN: return BarsGetMeanFloor_Private(floors->whole, floors->pair[owner].area, size, beside);
  case FLOOR_PLACE: return PetscMax(floors->whole * size, floors->pair[owner].centre[i]);
  default: return floors->whole * size;
  }
}

/* Adds the bars of one key.
   [in] owner - of BarsGetFloor_Private(); [out] grows - whether the number grows without limit; optional, may
   be NULL */
static PetscErrorCode BarsAdd_Private(const BarHistory *history, const BarPath *path, FloorKind kind, PetscInt owner,
                                      const char name[], cJSON *to, PetscBool *grows)
{
  const PetscInt last = history->num - 1;
  PetscReal     *Q, values[MAX_ITEMS], bars[MAX_ITEMS], half[MAX_ITEMS], size, beside;
  PetscBool      list, other;
  PetscInt       num;

  PetscFunctionBeginUser;
  num = BarsRead_Private(history->mesh[last].row, path, values, &list);
  if (!num) PetscFunctionReturn(PETSC_SUCCESS);
  size = VectorNorm(num, values);
  if (kind == FLOOR_PLACE && BarsGetHalfExtent_Private(history->mesh[last].row, path, half) < num) num = 0;
  beside = BarsGetBeside_Private(history->mesh[last].row, path, kind);
  PetscCall(PetscMalloc1(history->num, &Q));
  for (PetscInt i = 0; i < num; i++) {
    const PetscReal floor = BarsGetFloor_Private(history, kind, owner, i, kind == FLOOR_PLACE ? half[i] : size, beside);

    for (PetscInt j = 0; j < history->num; j++) {
      PetscReal row[MAX_ITEMS];

      Q[j] = BarsRead_Private(history->mesh[j].row, path, row, &other) > i ? row[i] : (PetscReal)NAN;
    }
    bars[i] = BarsOfSequence_Private(history, Q);
    if (!PetscIsNanReal(bars[i])) bars[i] = PetscIsNanReal(floor) ? floor : PetscMax(bars[i], floor);
    if (kind >= FLOOR_STRESS && kind <= FLOOR_PRINCIPAL && PetscAbsReal(values[i]) > STRESS_ROUNDING * floor &&
        BarsStressGrows_Private(history->num, Q))
      bars[i] = (PetscReal)NAN;
    if (grows) *grows = BarsIsUnbounded_Private(history, path, owner, Q);
    if (grows && *grows) bars[i] = (PetscReal)NAN;
  }
  PetscCall(PetscFree(Q));
  if (list)
    JSONAddReals(to, name, num, bars);
  else
    JSONAddReal(to, name, bars[0]);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds bars of energies. The potential is above its limit by (E^2 + L) / 2, with an error of a third of E^2.
   While few meshes calibrate E, differences of meshes may be larger. */
static PetscErrorCode BarsAddEnergy_Private(const BarHistory *history, cJSON *bars)
{
  cJSON        *energy = cJSON_AddObjectToObject(bars, "energy"), *strain = cJSON_AddObjectToObject(energy, "strain");
  const BarPath potential = {"energy", "potential", NULL, NULL};
  PetscReal    *J, values[MAX_ITEMS], bar;
  PetscBool     list;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(history->num, &J));
  for (PetscInt j = 0; j < history->num; j++) {
    (void)BarsRead_Private(history->mesh[j].row, &potential, values, &list);
    J[j] = values[0];
  }
  bar = BarsOfSequence_Private(history, J);
  if (!PetscIsNanReal(bar))
    bar = PetscMax(bar, PetscAbsReal(history->excess) / 2 + history->limit) + history->floors->potential;
  JSONAddReal(energy, "potential", bar);
  PetscCall(PetscFree(J));
  for (PetscInt b = 0; b < history->scene->num_bodies; b++) {
    const char   *name = history->scene->bodies[b].name;
    const BarPath path = {"energy", "strain", name, NULL};

    PetscCall(BarsAdd_Private(history, &path, FLOOR_BODY, b, name, strain, NULL));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode BarsAddPairs_Private(const BarHistory *history, cJSON *bars)
{
  cJSON *pairs = cJSON_AddObjectToObject(bars, "pairs"), *unbounded = cJSON_CreateArray();

  PetscFunctionBeginUser;
  for (PetscInt p = 0; p < history->scene->num_pairs; p++) {
    const char *name  = history->scene->pairs[p].name;
    cJSON      *pair  = cJSON_AddObjectToObject(pairs, name), *extent;
    PetscBool   grows = PETSC_FALSE, both = PETSC_FALSE;

    for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(PAIR_NUMBERS); i++) {
      const BarPath   path = {"pairs", name, PAIR_NUMBERS[i].key, NULL};
      const PetscBool peak = (PetscBool)(PAIR_NUMBERS[i].kind == FLOOR_PRESSURE);

      PetscCall(BarsAdd_Private(history, &path, PAIR_NUMBERS[i].kind, p, path.key, pair, peak ? &both : NULL));
      grows = (PetscBool)(grows || both);
    }
    for (size_t i = 0;
         ScenePairHasFriction(&history->scene->pairs[p]) && i < PETSC_STATIC_ARRAY_LENGTH(FRICTION_NUMBERS); i++) {
      const BarPath path = {"pairs", name, FRICTION_NUMBERS[i].key, NULL};

      PetscCall(BarsAdd_Private(history, &path, FRICTION_NUMBERS[i].kind, p, path.key, pair, NULL));
    }
    extent = cJSON_AddObjectToObject(pair, "extent");
    for (int i = 0; i < 2; i++) {
      const BarPath path = {"pairs", name, "extent", i ? "upper" : "lower"};

      PetscCall(BarsAdd_Private(history, &path, FLOOR_EDGE, p, path.end, extent, NULL));
    }
    if (grows) cJSON_AddItemToArray(unbounded, cJSON_CreateString(name));
  }
  cJSON_AddItemToObject(bars, "unbounded", unbounded);
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode BarsAddReactions_Private(const BarHistory *history, cJSON *bars)
{
  cJSON   *reactions = cJSON_AddObjectToObject(bars, "reactions");
  PetscInt side      = 0;
  char     key[PETSC_MAX_PATH_LEN];

  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < history->scene->num_bodies; b++) {
    const SceneBody *body = &history->scene->bodies[b];

    for (PetscInt i = 0; i < body->num_boundaries; i++, side++) {
      const BoundaryKind kind = body->boundaries[i].kind;
      const BarPath      path = {"reactions", key, NULL, NULL};

      if (kind != BOUNDARY_DISPLACEMENT && kind != BOUNDARY_NORMAL) continue;
      PetscCall(PetscSNPrintf(key, sizeof(key), "%s:%s", body->name, body->boundaries[i].side));
      PetscCall(BarsAdd_Private(history, &path, FLOOR_SIDE, side, key, reactions, NULL));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode BarsAddProbes_Private(const BarHistory *history, cJSON *bars)
{
  cJSON *probes = cJSON_AddObjectToObject(bars, "probes");

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < history->scene->num_probes; i++) {
    const SceneProbe *spec  = &history->scene->probes[i];
    cJSON            *probe = cJSON_AddObjectToObject(probes, spec->name);

    for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(PROBE_NUMBERS); k++) {
      const BarPath path = {"probes", spec->name, PROBE_NUMBERS[k].key, NULL};

      PetscCall(BarsAdd_Private(history, &path, PROBE_NUMBERS[k].kind, i, path.key, probe, NULL));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BarsCreate(const BarHistory *history, cJSON **bars)
{
  PetscFunctionBeginUser;
  *bars = cJSON_CreateObject();
  PetscCall(BarsAddEnergy_Private(history, *bars));
  PetscCall(BarsAddPairs_Private(history, *bars));
  PetscCall(BarsAddReactions_Private(history, *bars));
  PetscCall(BarsAddProbes_Private(history, *bars));
  PetscFunctionReturn(PETSC_SUCCESS);
}

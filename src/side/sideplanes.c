/* sideplanes.c -- planes of symmetry at which sides end.

   A support without normal displacement and friction on a flat side is a plane of symmetry. */
#include "side/sideplanes.h"
#include "base/compat.h"
#include "level/facets.h"
#include "kernel/frame.h"
#include "kernel/vector.h"
#include "level/ghosted.h"
#include "level/level.h"
#include "side/sidepatch.h"

enum { F = ELEMENT_MAX_FACET_NODES };

/* Unit normals of one direction differ by less. */
static const PetscReal SAME_DIRECTION = 1e-6;
/* Extrapolated normals are off a right angle by this share of what means over one side are, at most; on tori
   of triangles in no order, with 8 to 14 degrees a facet, by 0.001 to 0.04. Next to corners they are less
   accurate: most ends are enough. */
static const PetscReal RIGHT_ANGLE_SHARE = 0.05, MOST_ENDS = 0.75;
/* On coarse meshes extrapolation is less accurate. An angle is a right one up to this many spreads of the
   normals that neighbours have there, if these are below a quarter of the means. */
static const PetscReal SPREADS = 3, SPREAD_SHARE = 0.25;

/* The direction of a normal in a list, which is added if there is room. Returns its number, or the number of
   them if there is none. [in,out] num, list - [SIDE_PLANES_MAX][3] */
static PetscInt DirectionFind_Private(const PetscReal normal[3], PetscInt *num, PetscReal list[][3])
{
  for (PetscInt i = 0; i < *num; i++) {
    const PetscReal along = VectorDot(3, normal, list[i]) < 0 ? -1 : 1;
    PetscReal       most  = 0;

    for (PetscInt k = 0; k < 3; k++) most = PetscMax(most, PetscAbsReal(along * normal[k] - list[i][k]));
    if (most < SAME_DIRECTION) return i;
  }
  if (*num == SIDE_PLANES_MAX) return *num;
  for (PetscInt k = 0; k < 3; k++) list[*num][k] = normal[k];
  return (*num)++;
}

/* The directions of all ranks, the same ones on each; none if there are too many. Collective.
   [in] held - facets of this rank; [out] normal - [SIDE_PLANES_MAX][3] */
static PetscErrorCode DirectionsGather_Private(Level *level, const Facets *held, PetscInt *num, PetscReal normal[][3])
{
  PetscReal   own[SIDE_PLANES_MAX + 1][3] = {{0}}, *all; // the last row begins with their number
  PetscInt    mine                        = 0;
  PetscMPIInt size;
  PetscBool   many = PETSC_FALSE;

  PetscFunctionBeginUser;
  for (PetscInt f = 0; f < held->num && !many; f++) {
    PetscReal n[3] = {0};

    (void)FacetGetMeasure(level, held, f, n);
    many = (PetscBool)(DirectionFind_Private(n, &mine, own) == SIDE_PLANES_MAX);
  }
  own[SIDE_PLANES_MAX][0] = (PetscReal)mine;
  PetscCallMPI(MPI_Comm_size(level->comm, &size));
  PetscCall(PetscMalloc1(size * (SIDE_PLANES_MAX + 1) * 3, &all));
  PetscCallMPI(
      MPI_Allgather(own, (SIDE_PLANES_MAX + 1) * 3, MPIU_REAL, all, (SIDE_PLANES_MAX + 1) * 3, MPIU_REAL, level->comm));
  *num = 0;
  for (PetscMPIInt r = 0; r < size; r++) {
    const PetscReal *of = &all[r * (SIDE_PLANES_MAX + 1) * 3];

    for (PetscInt i = 0; i < (PetscInt)of[SIDE_PLANES_MAX * 3]; i++)
      many = (PetscBool)(many || DirectionFind_Private(&of[3 * i], num, normal) == SIDE_PLANES_MAX);
  }
  PetscCall(PetscFree(all));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &many, 1, MPIU_BOOL, MPI_LOR, level->comm));
  if (many) *num = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets the bits of nodes. Collective. */
static PetscErrorCode SidePlanesSetNodes_Private(Level *level, const SideSums *sums, const Facets *held,
                                                 SidePlanes *planes)
{
  const Facets *facets = sums->facets;
  PetscScalar  *a;
  Vec           marks;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, planes->num, &marks));
  PetscCall(GhostedGetArray(marks, &a));
  for (PetscInt f = 0; f < held->num; f++) {
    PetscReal n[3] = {0};
    PetscInt  num  = planes->num, q;

    (void)FacetGetMeasure(level, held, f, n);
    q = DirectionFind_Private(n, &num, planes->normal);
    for (PetscInt i = 0; i < ElementNumNodes(held->type[f]) && q < planes->num; i++)
      a[held->nodes[f * F + i] * planes->num + q] = 1;
  }
  PetscCall(GhostedRestoreArray(marks, &a));
  PetscCall(LevelShareVec(marks, ADD_VALUES));
  PetscCall(GhostedGetArray(marks, &a));
  for (PetscInt f = 0; f < facets->num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); i++) {
      for (PetscInt q = 0; q < planes->num; q++) {
        if (PetscRealPart(a[facets->nodes[f * F + i] * planes->num + q]) > 0)
          planes->on[sums->corner[f * F + i]] |= 1 << q;
      }
    }
  }
  PetscCall(GhostedRestoreArray(marks, &a));
  PetscCall(VecDestroy(&marks));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SidePlanesCreate(Level *level, const SideSums *sums, const Facets *held, SidePlanes *planes)
{
  PetscFunctionBeginUser;
  *planes = (SidePlanes){.num = 0};
  PetscCall(PetscCalloc1(sums->num, &planes->on));
  if (!held) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(DirectionsGather_Private(level, held, &planes->num, planes->normal));
  if (planes->num) PetscCall(SidePlanesSetNodes_Private(level, sums, held, planes));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SidePlanesDestroy(SidePlanes *planes)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(planes->on));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Of the nodes on a plane that are on no other one. */
typedef struct {
  PetscReal mean, spread; /* sums of squares: of means along the normal of the plane, of spreads */
  PetscReal num, within;  /* nodes; those with ends within the limit */
  PetscReal limit;
} PlaneCount;

/* Counts for all planes. Collective. [in,out] count - with limits [SIDE_PLANES_MAX] */
static PetscErrorCode SidePlanesCount_Private(const SideSums *nodes, const SidePlanes *planes, PetscInt dim,
                                              const SideEnds *ends, PlaneCount count[])
{
  const Facets *facets = nodes->facets;

  PetscFunctionBeginUser;
  for (PetscInt q = 0; q < planes->num; q++) {
    PetscReal sums[4] = {0, 0, 0, 0};

    for (PetscInt f = 0; f < facets->num; f++) {
      for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); i++) {
        const PetscInt c = f * F + i;

        if (planes->on[nodes->corner[c]] != 1 << q || ends->skip[c] != 0) continue;
        sums[0] += PetscSqr(VectorDot(dim, &ends->mean[c * dim], planes->normal[q]));
        sums[1] += PetscSqr(ends->spread[c]);
        sums[2] += 1;
        sums[3] += PetscAbsReal(VectorDot(dim, &ends->end[c * dim], planes->normal[q])) <= count[q].limit ? 1 : 0;
      }
    }
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPIU_REAL, MPIU_SUM, nodes->comm));
    count[q] = (PlaneCount){sums[0], sums[1], sums[2], sums[3], count[q].limit};
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The largest share of a normal along that of the plane that may be an error of extrapolation. */
static PetscReal PlaneCountLimit_Private(const PlaneCount *count)
{
  const PetscReal num  = PetscMax(count->num, 1);
  const PetscReal mean = PetscSqrtReal(count->mean / num), spread = SPREADS * PetscSqrtReal(count->spread / num);

  return FLAT_SIDE + PetscMax(RIGHT_ANGLE_SHARE * mean, PetscMin(spread, SPREAD_SHARE * mean));
}

PetscErrorCode SidePlanesJudge(const SideSums *nodes, PetscInt dim, const SideEnds *ends, SidePlanes *planes)
{
  PlaneCount count[SIDE_PLANES_MAX] = {{0}};
  PetscInt   keep                   = 0;

  PetscFunctionBeginUser;
  PetscCall(SidePlanesCount_Private(nodes, planes, dim, ends, count));
  for (PetscInt q = 0; q < planes->num; q++) count[q].limit = PlaneCountLimit_Private(&count[q]);
  PetscCall(SidePlanesCount_Private(nodes, planes, dim, ends, count));
  for (PetscInt q = 0; q < planes->num; q++)
    if (count[q].num > 0 && count[q].within >= MOST_ENDS * count[q].num) keep |= 1 << q;
  for (PetscInt n = 0; n < nodes->num; n++) planes->on[n] &= keep;
  if (!keep) planes->num = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

void SidePlanesReflect(const SidePlanes *planes, PetscInt dim, PetscInt plane, PetscReal v[])
{
  const PetscReal *m     = planes->normal[plane];
  const PetscReal  along = VectorDot(dim, m, v);

  for (PetscInt k = 0; k < dim; k++) v[k] -= 2 * along * m[k];
}

void SidePlanesProject(const SidePlanes *planes, PetscInt dim, PetscInt on, PetscReal normal[])
{
  PetscReal basis[3][3]; // orthonormal, of the normals of the planes
  PetscInt  num = 0;

  for (PetscInt q = 0; q < planes->num && num < dim - 1; q++) {
    PetscReal *m = basis[num];

    if (!(on >> q & 1)) continue;
    for (PetscInt k = 0; k < 3; k++) m[k] = planes->normal[q][k];
    for (PetscInt j = 0; j < num; j++) {
      const PetscReal along = VectorDot(3, m, basis[j]);

      for (PetscInt k = 0; k < 3; k++) m[k] -= along * basis[j][k];
    }
    FrameNormalize(3, m);
    num++;
  }
  for (PetscInt j = 0; j < num; j++) {
    const PetscReal along = VectorDot(dim, normal, basis[j]);

    for (PetscInt k = 0; k < dim; k++) normal[k] -= along * basis[j][k];
  }
  FrameNormalize(dim, normal);
}

void SidePlanesReflectMatrix(const SidePlanes *planes, PetscInt dim, PetscInt plane, PetscReal A[])
{
  for (PetscInt r = 0; r < dim; r++) SidePlanesReflect(planes, dim, plane, &A[r * dim]);
  for (PetscInt c = 0; c < dim; c++) {
    PetscReal column[3];

    for (PetscInt r = 0; r < dim; r++) column[r] = A[r * dim + c];
    SidePlanesReflect(planes, dim, plane, column);
    for (PetscInt r = 0; r < dim; r++) A[r * dim + c] = column[r];
  }
}

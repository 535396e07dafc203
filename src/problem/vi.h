/* vi.h -- the condensed variational inequality and the way back (eqs. 3.1, 6.1, 6.2).

   Uncondensed KKT system, in the user's units:  K u + B'lambda = f,  B u <= G,  lambda >= 0,  lambda.(B u -
   G) = 0, and the fixed directions of the supports. One change of basis u = T y makes the constrained
   combinations single unknowns, so that only inequalities are left:
       min 1/2 y'A y - b'y   subject to   y_i <= upper_i   where a row of contact has its unknown (row_dof),
   with A = T'KT and b = T'f, scaled. Fixed and tied unknowns have unit rows. A, b, y and upper are
   dimensionless: u = length * T y, A_user = stiffness * A. */
#ifndef MORTISE_VI_H
#define MORTISE_VI_H

#include "contact/pair.h"
#include "mesh/mesh.h"
#include "multigrid/basisrows.h"
#include "support/rigidmodes.h"
#include "pdas/friction.h"

typedef struct _n_VIBasis *VIBasis; /* private to this module: the factors of T */

struct _n_VI {
  Scene      scene; /* borrowed */
  Mesh       mesh;  /* borrowed; NULL for a matrix alone */
  Level     *level; /* borrowed: the finest of mesh, or a coarser one (VICreateCoarse()) */
  Support    support;
  RigidModes rigid_modes; /* that the supports leave to the bodies */
  PetscInt   num_pairs;
  Pair      *pairs;

  /* uncondensed KKT system */
  Mat K;        /* N x N, block size dim: a shell (stiffness.h) */
  Vec diagonal; /* of K */
  Vec f;        /* ghosted */
  Mat B;        /* m x N, rows as below; NULL when no pair has a multiplier */
  Vec G;        /* m */

  /* rows of B: this rank's multipliers, by pair, then by node, then (tied) by direction */
  PetscInt  num_rows; /* owned by this rank */
  PetscInt *row_pair; /* [num_rows] */
  PetscInt *row_node; /* position in the pair's nodes [num_rows] */
  PetscInt        *
      row_direction; /* 0 normal, 1.. tangents (tied pairs, and pairs with friction where supports leave them free) [num_rows] */
  PetscInt  *row_dof; /* the global unknown y_i that is (B u)_row / D_row [num_rows] */
  PetscReal *row_D;   /* D_aa [num_rows] */
  PetscReal
      *slip_origin; /* relative displacement from which slip counts, in tangential rows [num_rows]; NULL for none */
  Vec  slip_from;   /* the displacement of that slip origin, ghosted; NULL for none */

  /* the inequality */
  Mat          T;        /* u = length * T y; NULL when it is the identity */
  Mat          Z;        /* (T'KT - K) / stiffness: nonzero beside contact only; NULL with T */
  Mat          S;        /* T'KT / stiffness, for products */
  Mat          A;        /* SPD, block size dim; a shell that knows products and diagonal, until VIAssemble() */
  Vec          b;        /* ghosted */
  Vec          upper;    /* nodal gaps / length on contact unknowns, +infinity elsewhere */
  Vec          lower;    /* -infinity */
  FrictionLaw *friction; /* of the contact unknowns; NULL where no pair has friction */
  PetscReal    length, stiffness; /* scales */

  PetscInt  num_fixed;   /* unknowns of this rank that are eliminated from A */
  PetscInt *fixed;       /* global numbers [num_fixed] */
  PetscInt *fixed_local; /* counted from this rank's first */
  PetscBool assembled;   /* whether A is AIJ */
  VIBasis   basis;
};
typedef struct _n_VI *VI;

/* Searches, integrates, assembles and condenses. User errors: nonmortar sides that depend on each other in a
   cycle; those of PairsCreate() and ElasticityAssemble(). Collective. [out] vi - owned by the caller */
PetscErrorCode VICreate(Scene scene, Mesh mesh, VI *vi);
/* Collective. */
PetscErrorCode VIDestroy(VI *vi);
/* The same scene on the finest level of its mesh, with the scales of a vi on a coarser one. Collective.
   [out] fine - owned by the caller */
PetscErrorCode VICreateFiner(VI vi, VI *fine);
/* Takes loads, given displacements and gaps anew from the scene, for the same matrices: f, G, b, upper and
   length change, in place. Collective.
   [in] changed - DatumKind bits of what may differ; [out] updated - false where matrices would change: then
   vi is to be created anew */
PetscErrorCode VIUpdate(VI vi, int changed, PetscBool *updated);
/* Slip counts from this displacement on, as that of the last load step. Without friction nothing happens.
   Collective. [in] u - ghosted */
PetscErrorCode VISetSlipOrigin(VI vi, Vec u);
/* The same scene on a coarser level of its mesh, with the scales of vi. Collective.
   [in] l - level of vi->mesh; [in] K - of stiffness.h, in place of the level's own, or NULL; referenced;
   [out] coarse - owned by the caller */
PetscErrorCode VICreateCoarse(VI vi, PetscInt l, Mat K, VI *coarse);
/* Takes another K for the same contact and supports. A, b and their parts are created anew, and VIAssemble()
   is to be called again. The uncondensed system is no longer that of the level's mesh. Collective.
   [in] K - of stiffness.h, referenced */
PetscErrorCode VIReplaceStiffness(VI vi, Mat K);
/* Makes A an AIJ matrix, as factorizations and submatrices need it. Takes three times the memory of K.
   Collective. */
PetscErrorCode VIAssemble(VI vi);
/* A plus a diagonal, a matrix or a shell like A. Collective.
   [in] regularization - borrowed for as long as the result lives;
   [out] A - owned by the caller */
PetscErrorCode VICreateRegularized(VI vi, Vec regularization, Mat *A);
/* A as an AIJ matrix of its own, with the relative displacements of pair p as unknowns even if it is tied.
   Collective.
   [in] regularization - diagonal to be added, or NULL; [out] A - owned by the caller */
PetscErrorCode VICreateUntied(VI vi, PetscInt p, Vec regularization, Mat *A);
/* T^-1, as sparse as B: its rows are those of B and of the nodes' frames. Collective.
   [out] inverse - to be released by BasisRowsDestroy() */
PetscErrorCode VICreateInverseBasis(VI vi, BasisRows *inverse);
/* y = T^-1 u, without that matrix. Collective. [in] u - ghosts are not needed */
PetscErrorCode VIApplyInverseBasis(VI vi, Vec u, Vec y);
/* Marks nodes whose unknowns are their Cartesian displacements. Not collective.
   [out] cartesian - [num_owned] */
PetscErrorCode VIMarkCartesian(VI vi, PetscBool cartesian[]);

/* u = length * T y.
   [in] y; [out] u - ghosted, created by LevelCreateVec(level, dim), ghosts updated. Collective. */
PetscErrorCode VIRecoverDisplacement(VI vi, Vec y, Vec u);
/* lambda = (T'(f - K u))_row / D_row for every row of B (eq. 6.3): pressures of contact rows, tractions of
   tied rows. Collective. [in] u - ghosted; [out] lambda - layout of G, created by the caller */
PetscErrorCode VIRecoverMultiplier(VI vi, Vec u, Vec lambda);

#endif

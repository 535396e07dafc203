/* levelsets.h -- functions of points in a unit cube, their zeros on lines, and where these begin and end;
   internal to cubature.h. */
#ifndef MORTISE_LEVELSETS_H
#define MORTISE_LEVELSETS_H

#include "kernel/cubature.h"

enum { LEVELSET_MAX_DIM = 3, LEVELSET_MAX_FUNCTIONS = 24, LEVELSET_MAX_ZEROS = 64 };

/* A reference cell in its unit cube. */
typedef struct {
  Cubature *cubature;
  PetscInt  dim;
  PetscBool simplex;   /* the cell is where the sum of coordinates is less than 1 */
  PetscBool collapsed; /* or all of the cube, by collapsed coordinates */
} LevelSetCell;

/* In a cell, a function of the cubature, or the inclined facet of a simplex. In a box of fewer coordinates, a
   function of the box around. It is taken at an end of a line, or at the zero of another function on it. */
typedef struct {
  PetscInt  of, other; /* of < 0: that facet; other < 0: at an end */
  PetscReal at;        /* that end */
  PetscReal scale;     /* values that are roundoff relative to it have no sign */
} LevelSetFunction;

/* A box of some of the coordinates, and the functions that may be zero in it. */
typedef struct _n_LevelSetBox {
  const struct _n_LevelSetBox *around; /* has one coordinate more; NULL in a cell */
  PetscInt                     line;   /* that coordinate */
  PetscInt                     dim, axis[LEVELSET_MAX_DIM];
  PetscReal                    lower[LEVELSET_MAX_DIM], upper[LEVELSET_MAX_DIM]; /* of all coordinates of the cell */
  PetscInt                     num;
  LevelSetFunction             function[LEVELSET_MAX_FUNCTIONS];
} LevelSetBox;

/* Monotonicity of the functions of a box along its coordinates. */
typedef struct {
  PetscInt  line;                          /* along which each is monotone or constant; -1 where there is none */
  PetscInt  bent;                          /* along which gradients change most */
  PetscBool planes;                        /* whether all are linear in the box */
  PetscBool stays[LEVELSET_MAX_FUNCTIONS]; /* along line */
} LevelSetTrend;

/* The whole cube, with all functions. */
void LevelSetCellInit(Cubature *cubature, PetscBool collapsed, LevelSetCell *cell, LevelSetBox *box);

/* Removes functions without zeros in a box, and chooses the coordinate for lines. Not collective. */
PetscErrorCode LevelSetBoxTrend(const LevelSetCell *cell, LevelSetBox *box, LevelSetTrend *trend);
/* The box without coordinate trend->line: its functions are zero where the zeros on lines begin, end or meet.
   [out] fits - whether it has room for them */
void LevelSetBoxProject(const LevelSetBox *box, const LevelSetTrend *trend, LevelSetBox *base, PetscBool *fits);
/* Zeros along a coordinate, ascending, from end to end: ends[0] and ends[num] are those of the box. Each
   function has one at most unless the box has no other coordinate. Not collective.
   [in,out] u - the point, of which [line] is lost; [out] ends - [LEVELSET_MAX_ZEROS] */
PetscErrorCode LevelSetBoxZeros(const LevelSetCell *cell, const LevelSetBox *box, PetscInt line, PetscReal u[],
                                PetscInt *num, PetscReal ends[]);
/* The nearest zeros on a line beyond both ends of a box, where there are some within its length: for rules
   that allow for roots. Not collective. [in,out] beyond - infinite where there is none [2] */
PetscErrorCode LevelSetBoxBeyond(const LevelSetCell *cell, const LevelSetBox *box, PetscInt line, PetscReal u[],
                                 PetscReal beyond[]);

#endif

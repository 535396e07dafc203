/* expression.h -- numbers that vary in space.

   A datum of a scene is a list of components separated by commas outside parentheses. Each component is a
   plain number, the word `free`, or an expression, read by the muParser library. An expression has the
   variables x, y, z (r, z when axisymmetric) and the time t. */
#ifndef MORTISE_EXPRESSION_H
#define MORTISE_EXPRESSION_H

#include <petscsys.h>

typedef struct _n_Expression *Expression;

/* Reads text into an expression of one or more components. Collective on comm: all ranks hold the same text.
   A text that cannot be read is a user error that names the option.
   [in] option         - the option's name with its dash, kept for error messages
   [in] num_components - the number wanted, or 0 for as many as there are
   [in] allow_free     - whether `free` is a component
   [out] e             - owned by the caller */
PetscErrorCode ExpressionCreate(MPI_Comm comm, const char option[], const char text[], PetscInt num_components,
                                PetscBool allow_free, Expression *e);
PetscErrorCode ExpressionDestroy(Expression *e);
/* The switching functions of e (switching.h), as components: its formulas jump or bend only at their zeros.
   Not collective.
   [out] switches - owned by the caller, NULL where there is none */
PetscErrorCode ExpressionCreateSwitches(Expression e, Expression *switches);
/* The end of a sentence about too many components, where decimal commas may have made them; else "".
   Not collective.
   [in] text - as typed; [in] wanted - components; [out] words - [len] */
void ExpressionSuggestPoint(const char text[], PetscInt wanted, char words[], size_t len);

/* Makes z a name of the second coordinate, as r is one of the first: a point (r, z) of a meridian plane.
   Not collective. */
void ExpressionNameMeridian(Expression e);
/* Whether a formula names one of x, y, z, r, t. Not collective. */
PetscBool ExpressionNames(Expression e, const char name[]);

/* The value of t in all formulas, 1 in the beginning. Not collective; the same on all ranks. */
void ExpressionSetTime(PetscReal t);
/* Multiplies all values by a factor from now on, 1 in the beginning. Not collective. */
void ExpressionSetFactor(Expression e, PetscReal factor);

/* Number of components; whether all are plain numbers (or free); whether component c is free.
   Not collective. */
PetscInt    ExpressionSize(Expression e);
PetscBool   ExpressionIsConstant(Expression e);
PetscBool   ExpressionIsFree(Expression e, PetscInt c);
const char *ExpressionOption(Expression e);
const char *ExpressionText(Expression e);

/* values = e(x). Not collective. A value that is not finite is *not* an error here. The first point and
   component are stored, and become a user error at the next ExpressionCheck(). Free components give 0.
   [in] x - point, array of shape [dim];
   [in] dim - 1 to 3; [out] values - array of shape [ExpressionSize(e)] */
PetscErrorCode ExpressionEvaluate(Expression e, PetscInt dim, const PetscReal x[], PetscReal values[]);

/* The value of component c alone, which may be infinite or not a number. Not collective. */
PetscErrorCode ExpressionComponent(Expression e, PetscInt c, PetscInt dim, const PetscReal x[], PetscReal *value);

/* All values at a point where they may not exist, such as beside the body. Not collective.
   [out] values - [ExpressionSize(e)]; [out] finite - whether all are finite; no error is stored */
PetscErrorCode ExpressionTry(Expression e, PetscInt dim, const PetscReal x[], PetscReal values[], PetscBool *finite);

/* Raises a user error with option, text and point if any evaluation on any rank was not finite.
   Collective on comm; e may be NULL. */
PetscErrorCode ExpressionCheck(MPI_Comm comm, Expression e);

#endif

/* sceneoption.h -- the table of all options, and how a value is read through it.

   Only documented options are read: OptionFind() takes a row's pattern, and raises an internal error if there
   is no such row. Values are read as text and parsed here: of a word in place of a number PETSc would print a
   stack trace. No function here allocates memory, so that a user error leaks none. */
#ifndef SCENE_OPTION_H
#define SCENE_OPTION_H

#include "base/compat.h"
#include "base/usererror.h"
#include "scene/scene.h"

enum {
  OPTION_MAX      = 512, /* length of an option's name or of one item of a list, as in PETSc */
  OPTION_CHOICES  = 16,  /* words an option chooses from, at most */
  OPTION_SENTENCE = 2048 /* length of the sentence of a user error */
};

/* Chapters of the manual that -help prints. */
typedef enum {
  GROUP_RUN,
  GROUP_SCENE,
  GROUP_MESH,
  GROUP_MATERIAL,
  GROUP_LOADS,
  GROUP_PAIRS,
  GROUP_OBSTACLES,
  GROUP_PROBES,
  GROUP_OUTPUT,
  GROUP_ADAPT,
  GROUP_STUDY,
  GROUP_STEPS,
  GROUP_SOLVER,
  GROUP_PETSC,
  GROUP_COUNT
} OptionGroup;

/* What an option belongs to: the placeholder in its name. */
typedef enum { SCOPE_PROGRAM, SCOPE_BODY, SCOPE_PAIR, SCOPE_PROBE, SCOPE_PATH, SCOPE_REGION } OptionScope;

/* One row of the table. */
typedef struct {
  OptionGroup group;
  const char *name;     /* with its dash; <body>, <pair>, <probe>, <path>, <side> and <body>_<region>, which is one
                           placeholder, stand for names of the scene */
  const char *argument; /* form of the value; where it holds '|', the words to choose from */
  const char *unit;     /* "" where there is none */
  const char *standard; /* the value when the option is absent; in parentheses: what happens then */
  const char *help;
} OptionEntry;

/* An option of a scene, found in PETSc's database. */
typedef struct {
  Scene              scene; /* borrowed */
  MPI_Comm           comm;
  const OptionEntry *entry;
  const char        *owner;            /* body, pair, probe or prefix of the region it belongs to, or NULL */
  char               name[OPTION_MAX]; /* with the scene's names filled in */
  const char        *text;             /* the value as typed ("" for a bare option); when absent the default, or NULL */
  PetscBool          set;              /* whether the user gave it */
} Option;

/* The table and the titles of its chapters. */
const OptionEntry *OptionTable(PetscInt *num_entries);
const char        *OptionGroupTitle(OptionGroup group);
OptionScope        OptionEntryScope(const OptionEntry *entry);
/* Behind a placeholder, which a pattern begins with. */
const char *OptionPlaceholderEnd(const char pattern[]);
/* The first row whose pattern an option's name (with its dash) fits, with this owner and any side; NULL if
   there is none.
   [in] owner - name of the body, pair or probe; not looked at for SCOPE_PROGRAM */
const OptionEntry *OptionTableMatch(OptionScope scope, const char owner[], const char option[]);

/* name = pattern, or any text, with its placeholders filled in; owner and side may be NULL where it has none.
   Blanks in the name of a side become underscores. Not collective. */
PetscErrorCode OptionExpand(const char pattern[], const char owner[], const char side[], char name[OPTION_MAX]);

/* Looks up an option; reading counts as use. Not collective. [in] pattern - the name of a row of the table */
PetscErrorCode OptionFind(Scene scene, const char pattern[], const char owner[], const char side[], Option *option);
/* An option as a sentence shows it: its name and its value, which may be cut. Not collective. */
PetscErrorCode OptionShow(const char name[], const char value[], char shown[OPTION_MAX]);
/* Raises the user error "<option> <value>: <sentence>". Collective. */
PetscErrorCode OptionRaise(const Option *option, const char format[], ...) PETSC_ATTRIBUTE_FORMAT(2, 3);
/* Raises a user error if the option is absent; a near misspelling that the user typed is named.
   Collective.
   [in] why - what needs it, a clause; placeholders stand for the names of the option */
PetscErrorCode OptionRequire(const Option *option, const char why[]);

/* Values. An absent option gives the table's default, or leaves the value as it is where the table has none.
   A value that cannot be read is a user error. Collective. */
PetscErrorCode OptionGetText(const Option *option, char **text); /* copied */
PetscErrorCode OptionGetBool(const Option *option, PetscBool *value);
PetscErrorCode OptionGetInts(const Option *option, PetscInt n, PetscInt smallest, PetscInt values[]);
PetscErrorCode OptionGetReals(const Option *option, PetscInt n, PetscReal values[]);
/* A number with one of the letters K, M, G, T behind it for powers of 1024, or none. Collective. */
PetscErrorCode OptionGetBytes(const Option *option, PetscReal *bytes);
/* Index of the word among the choices of the table. Collective. */
PetscErrorCode OptionGetChoice(const Option *option, PetscInt *index);
/* Formulas. Collective. [in] num_components - of the value; [in] allow_free - whether a component may be
   the word `free`; [out] e - owned by the caller */
PetscErrorCode OptionGetExpression(const Option *option, PetscInt num_components, PetscBool allow_free, Expression *e);

/* Walks the items of a comma-separated list: cursor is NULL before the first item and after the last one.
   An empty item is a user error. Collective. [out] item - without blanks around it */
PetscErrorCode OptionNextItem(const Option *option, const char **cursor, char item[OPTION_MAX]);
PetscInt       OptionCountItems(const Option *option);
/* Index of a word among the option's choices; a user error with the choices and the nearest one if it is not
   there. Collective.
   [in] why - what the sentence says about the choices, in parentheses with a blank before, or "" */
PetscErrorCode OptionMatchChoice(const Option *option, const char word[], const char why[], PetscInt *index);

#endif

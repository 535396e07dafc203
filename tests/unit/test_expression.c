/* test_expression.c -- numbers, formulas, `free`, and the sentences for what is none of them. */
#include "base/compat.h"
#include "constant.h"
#include "base/expression.h"
#include "base/usererror.h"
#include <string.h>
#include <test.h>

static Expression Read(const char text[], PetscInt num_components, PetscBool allow_free)
{
  Expression e;

  CHECK(!ExpressionCreate(PETSC_COMM_WORLD, "-datum", text, num_components, allow_free, &e));
  return e;
}

static void Evaluate(Expression e, PetscInt dim, double x, double y, double z, PetscReal values[])
{
  const PetscReal point[3] = {x, y, z};

  CHECK(!ExpressionEvaluate(e, dim, point, values));
}

/* What strtod() takes as a decimal number is one, whatever its form, with blanks around it or not. */
static void TestNumbers(void)
{
  const double expected[] = {1, -2.5, 1e-3, 0.5, 3, 4e6};
  Expression   e          = Read(" 1 ,-2.5,1e-3, .5,+3,4E6", 0, PETSC_FALSE);
  PetscReal    values[6];

  CHECK(ExpressionSize(e) == 6 && ExpressionIsConstant(e));
  Evaluate(e, 1, 7, 0, 0, values);
  for (int c = 0; c < 6; ++c) CHECK_NEAR(values[c], expected[c], 0);
  CHECK(!strcmp(ExpressionOption(e), "-datum") && !strcmp(ExpressionText(e), " 1 ,-2.5,1e-3, .5,+3,4E6"));
  CHECK(!ExpressionDestroy(&e) && !e);
}

static void TestFormulas(void)
{
  Expression e = Read("3e6*(1-y^2), max(x,y,z), r*cos(pi/3), (x>1 && y<=2) ? 1 : 0, z", 5, PETSC_FALSE);
  PetscReal  values[5];

  CHECK(!ExpressionIsConstant(e) && !ExpressionIsFree(e, 0));
  Evaluate(e, 3, 2, 0.5, 4, values);
  CHECK_NEAR(values[0], 2.25e6, 1e-9);
  CHECK_NEAR(values[1], 4, 0);
  CHECK_NEAR(values[2], 1, 1e-15);
  CHECK_NEAR(values[3], 1, 0);
  Evaluate(e, 2, 2, 0.5, 4, values); // in the plane there is no third coordinate
  CHECK_NEAR(values[1], 2, 0);
  CHECK_NEAR(values[4], 0, 0);
  CHECK(!ExpressionCheck(PETSC_COMM_WORLD, e));
  CHECK(!ExpressionDestroy(&e));
}

/* In a meridian plane r and z are the first and the second coordinate. */
static void TestMeridian(void)
{
  Expression e = Read("r+10*z, x+10*y", 2, PETSC_FALSE);
  PetscReal  values[2];

  ExpressionNameMeridian(e);
  Evaluate(e, 2, 2, 0.5, 0, values);
  CHECK_NEAR(values[0], 7, 0);
  CHECK_NEAR(values[1], 7, 0);
  CHECK(!ExpressionDestroy(&e));
}

/* A formula without variables is a number from the start. */
static void TestFolding(void)
{
  Expression e = Read("2*pi, -sqrt(2)/2", 2, PETSC_FALSE);
  PetscReal  values[2];

  CHECK(ExpressionIsConstant(e));
  Evaluate(e, 2, 0, 0, 0, values);
  CHECK_NEAR(values[0], 2 * PETSC_PI, 1e-15);
  CHECK_NEAR(values[1], -PetscSqrtReal(0.5), 1e-15);
  CHECK(!ExpressionDestroy(&e));
}

static void TestFree(void)
{
  Expression e = Read("free, -0.02", 2, PETSC_TRUE);
  PetscReal  values[2];

  CHECK(ExpressionIsConstant(e) && ExpressionIsFree(e, 0) && !ExpressionIsFree(e, 1));
  Evaluate(e, 2, 0, 0, 0, values);
  CHECK_NEAR(values[0], 0, 0);
  CHECK_NEAR(values[1], -0.02, 0);
  CHECK(!ExpressionDestroy(&e));
}

static void TestConstant(void)
{
  const PetscReal given[2] = {0.1, -3};
  Expression      e;
  PetscReal       values[2];

  CHECK(!ConstantCreate("-datum", 2, given, &e));
  CHECK(ExpressionIsConstant(e) && ExpressionSize(e) == 2);
  Evaluate(e, 2, 5, 6, 0, values);
  for (int c = 0; c < 2; ++c) CHECK_NEAR(values[c], given[c], 0);
  CHECK(!ExpressionDestroy(&e));
}

/* Reading text is a fault whose sentence names the option, the text and the culprit. */
static void CheckFault(const char text[], PetscInt num_components, const char culprit[])
{
  Expression e;

  CHECK(ExpressionCreate(PETSC_COMM_WORLD, "-datum", text, num_components, PETSC_FALSE, &e) == MORTISE_ERR_USER);
  CHECK(!e && strstr(UserErrorSentence(), "-datum") && strstr(UserErrorSentence(), text));
  if (!strstr(UserErrorSentence(), culprit)) fprintf(stderr, "'%s' does not name '%s'\n", UserErrorSentence(), culprit);
  CHECK(strstr(UserErrorSentence(), culprit));
}

static void TestFaults(void)
{
  CheckFault("1,2,3", 2, "3 components");
  CheckFault("1", 2, "1 component given");
  CheckFault("1,,2", 3, "between the commas");
  CheckFault("", 1, "is nothing");
  CheckFault("2*q", 1, "'q'");
  CheckFault("sine(x)", 1, "nearest is 'sin'");
  CheckFault("3*(1-y", 1, "parenthesis");
  CheckFault("2 x", 1, "x");
  CheckFault("1*", 1, "end of expression");
  CheckFault("1e", 1, "e");
  CheckFault("nan", 1, "nan");
  CheckFault("-inf", 1, "inf");
  CheckFault("1e999", 1, "finite");
  CheckFault("1/0", 1, "finite");
  CheckFault("0x10", 1, "x10");
  CheckFault("x=2", 1, "'='");
  CheckFault("'text'", 1, "'");
  CheckFault("free,0", 2, "displacements only");
  CheckFault("sin(x", 1, "parenthesis");
  CheckFault("x)", 1, "parenthesis");
}

/* What is wrong with a formula is told, however long it is: muParser itself would write it beyond the end of a buffer. */
static void TestLong(void)
{
  enum { MOST = 19999 };
  static const struct {
    int         length;
    const char *end, *words;
  } cases[] = {
      {MOST + 2, "x", "longer than muParser takes"}, {MOST, "+", "missing at its end"}, {3000, "+q", "'q...'"}};
  char       text[MOST + 8];
  Expression e;

  for (size_t c = 0; c < sizeof(cases) / sizeof(*cases); ++c) {
    const int length = cases[c].length - (int)strlen(cases[c].end);

    for (int i = 0; i < length; ++i) text[i] = i % 2 ? '+' : 'x';
    if (text[length - 1] == '+') text[length - 1] = ' ';
    strcpy(text + length, cases[c].end);
    CHECK(ExpressionCreate(PETSC_COMM_WORLD, "-datum", text, 1, PETSC_FALSE, &e) == MORTISE_ERR_USER);
    CHECK(strstr(UserErrorSentence(), "-datum \"x+x") && strstr(UserErrorSentence(), "...\": "));
    if (!strstr(UserErrorSentence(), cases[c].words))
      fprintf(stderr, "'%s' does not say '%s'\n", UserErrorSentence(), cases[c].words);
    CHECK(strstr(UserErrorSentence(), cases[c].words) && strstr(UserErrorSentence(), "accepted are numbers"));
  }
}

/* One bad point on one rank is a fault on all, once. */
static void TestNotFinite(void)
{
  Expression e = Read("1, 1/x", 2, PETSC_FALSE);
  PetscReal  values[2];
  int        rank, size;

  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  Evaluate(e, 2, rank == size - 1 ? 0 : 1, 0.25, 0, values);
  Evaluate(e, 2, 2, 3, 0, values);
  CHECK(ExpressionCheck(PETSC_COMM_WORLD, e) == MORTISE_ERR_USER);
  CHECK(!strcmp(UserErrorSentence(), "-datum \"1, 1/x\": component 2 is not a finite number at (0, 0.25)"));
  CHECK(!ExpressionCheck(PETSC_COMM_WORLD, e));
  CHECK(!ExpressionCheck(PETSC_COMM_WORLD, NULL));
  CHECK(!ExpressionDestroy(&e));
}

/* t is one number for all formulas, 1 in the beginning; a factor is of one expression, and leaves what is free. */
static void TestTime(void)
{
  Expression e = Read("x*t^2, 3, free", 3, PETSC_TRUE), other = Read("t", 1, PETSC_FALSE);
  PetscReal  values[3];

  CHECK(ExpressionNames(e, "t") && !ExpressionNames(e, "y") && !ExpressionIsConstant(other));
  Evaluate(e, 2, 5, 0, 0, values);
  CHECK(values[0] == 5 && values[1] == 3);
  ExpressionSetTime(0.5);
  ExpressionSetFactor(e, 4);
  Evaluate(e, 2, 5, 0, 0, values);
  CHECK(values[0] == 5 && values[1] == 12 && values[2] == 0 && ExpressionIsFree(e, 2));
  Evaluate(other, 1, 0, 0, 0, values);
  CHECK(values[0] == 0.5);
  CHECK(!ExpressionDestroy(&other));
  other = Read("x/t", 1, PETSC_FALSE);
  ExpressionSetTime(0);
  Evaluate(other, 1, 0.25, 0, 0, values);
  CHECK(ExpressionCheck(PETSC_COMM_WORLD, other) == MORTISE_ERR_USER);
  CHECK(!strcmp(UserErrorSentence(), "-datum \"x/t\": component 1 is not a finite number at 0.25, t = 0"));
  ExpressionSetTime(1);
  CHECK(!ExpressionDestroy(&e));
  CHECK(!ExpressionDestroy(&other));
}

/* Parts of formulas one of which is zero wherever these jump or bend. */
static void CheckSwitches(const char text[], PetscInt num_components, const char expected[])
{
  Expression e = Read(text, num_components, PETSC_FALSE), switches;

  CHECK(!ExpressionCreateSwitches(e, &switches));
  CHECK((switches == NULL) == (expected == NULL));
  if (switches) CHECK(!strcmp(ExpressionText(switches), expected));
  CHECK(!ExpressionDestroy(&e));
  if (switches) CHECK(!ExpressionDestroy(&switches));
}

static void TestSwitches(void)
{
  CheckSwitches("x^2+sin(y), 3", 2, NULL);
  CheckSwitches("abs(3), max(1, 2)", 2, NULL);
  CheckSwitches("max(x, y, 1, 2, 3, 4, 5)", 1, NULL); /* too many */
  CheckSwitches("0, (x+2*y>1.3) ? -10 : 0", 2, "(x+2*y)-(1.3)");
  CheckSwitches("max(0,1-(x^2+y^2))", 1, "(0)-(1-(x^2+y^2))");
  CheckSwitches("x<1 && y>=2 || x<1 ? abs(x-1e-5) : rint(y)", 1, "(x)-(1),(y)-(2),(x-1e-5),cos(pi*(y))");
  CheckSwitches("sqrt(max(0,x,y))*sign(x)", 1, "(0)-(x),(0)-(y),(x)-(y),(x)");
  CheckSwitches("1<x<2 ? 1 : x==3 ? 4 : (y!=5)*(z<6)", 1, "(1)-(x),(1<x)-(2),(z)-(6)");
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(UserErrorInitialize());
  TestNumbers();
  TestFormulas();
  TestMeridian();
  TestFolding();
  TestFree();
  TestConstant();
  TestFaults();
  TestLong();
  TestNotFinite();
  TestTime();
  TestSwitches();
  PetscCall(PetscFinalize());
  return 0;
}

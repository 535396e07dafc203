/* test_richardson.c -- limits of sequences whose limit is known, and how they are written. */
#include "test.h"
#include "study/richardson.h"
#include <math.h>
#include "base/compat.h"
#include <string.h>

/* Q(h) = 3 + h^q has its limit found exactly, whatever its sign. */
static void TestPowers(void)
{
  const double rates[] = {0.6, 1, 1.42, 2};

  for (int i = 0; i < 4; i++) {
    for (int sign = -1; sign <= 1; sign += 2) {
      const PetscReal     Q[]   = {3 + sign, 3 + sign * pow(0.5, rates[i]), 3 + sign * pow(0.25, rates[i])};
      const Extrapolation limit = RichardsonExtrapolate(Q);

      CHECK(limit.monotone);
      CHECK_NEAR(limit.rate, rates[i], 1e-12);
      CHECK_NEAR(limit.value, 3, 1e-12);
      CHECK_NEAR(limit.bar, 1.25 * pow(0.25, rates[i]), 1e-12); // 1.25 times what is extrapolated over
    }
  }
}

/* Orders that nobody should believe. */
static void TestIrregular(void)
{
  const PetscReal     chance[] = {0, 1, 1.0001}, slow[] = {0, 1, 1.9}, zigzag[] = {0, 1, 0.5}, away[] = {0, 1, 3};
  const PetscReal     same[] = {2, 2, 2};
  const Extrapolation lucky  = RichardsonExtrapolate(chance);
  Extrapolation       limit;

  CHECK(lucky.monotone && lucky.rate > 13);
  CHECK_NEAR(lucky.value, 1.0001 + 0.0001 / 3, 1e-12);
  CHECK_NEAR(lucky.bar, 1.25 * 0.25 / 3, 1e-12); // as if the second difference were a quarter of the first
  limit = RichardsonExtrapolate(slow);
  CHECK_NEAR(limit.value, 1.9 + 0.9 / (sqrt(2) - 1), 1e-12);
  limit = RichardsonExtrapolate(zigzag);
  CHECK(!limit.monotone && isnan(limit.rate) && limit.value == 0.5 && limit.bar == 1);
  limit = RichardsonExtrapolate(away);
  CHECK(!limit.monotone && limit.value == 3 && limit.bar == 3);
  limit = RichardsonExtrapolate(same);
  CHECK(limit.value == 2 && limit.bar > 0 && limit.bar < 1e-8);
}

/* Steps are of first order: what looks like a higher one is chance. */
static void TestSteps(void)
{
  const PetscReal     first[] = {2, 1.5, 1.25}, chance[] = {0, 1, 1.0001}, zigzag[] = {0, 1, 0.5};
  const Extrapolation exact = RichardsonExtrapolateSteps(first), lucky = RichardsonExtrapolateSteps(chance),
                      turned = RichardsonExtrapolateSteps(zigzag);

  CHECK_NEAR(exact.value, 1, 1e-12);
  CHECK_NEAR(exact.bar, 1.25 * 0.25, 1e-12);
  CHECK_NEAR(lucky.value, 1.0002, 1e-12);
  CHECK_NEAR(lucky.bar, 2 * 1.0001, 1e-12);
  CHECK_NEAR(turned.value, 0.5, 1e-12);
  CHECK_NEAR(turned.bar, 2, 1e-12);
}

static void TestText(void)
{
  static const struct {
    double      value, bar;
    const char *text;
  } cases[] = {{1836973.4, 193, "1.83697e6 +- 2.0e2"}, {1836973.4, 412, "1.8370e6 +- 5e2"},
               {-5918.263, 0.31, "-5918.3 +- 0.4"},    {0.0983451, 2.6e-6, "0.0983451 +- 2.6e-6"},
               {20.5034, 0.0115, "20.503 +- 0.012"},   {1e-12, 3.9e-10, "0 +- 4e-10"},
               {9.996, 0.05, "10.00 +- 0.06"},         {12345678, 95, "1.234568e7 +- 1.0e2"},
               {2.5e-7, 2e-9, "2.500e-7 +- 2.0e-9"},   {3, 0, "3"}};

  for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
    const Extrapolation limit = {.value = cases[i].value, .bar = cases[i].bar};
    char                text[96];

    RichardsonText(&limit, text, sizeof(text));
    if (strcmp(text, cases[i].text)) fprintf(stderr, "%s instead of %s\n", text, cases[i].text);
    CHECK(!strcmp(text, cases[i].text));
  }
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  TestPowers();
  TestIrregular();
  TestSteps();
  TestText();
  PetscCall(PetscFinalize());
  return 0;
}

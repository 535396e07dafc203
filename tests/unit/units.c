/* units.c -- all unit tests as one program: test_units <name> <arguments of the test>. CMake writes units.list, a line per test. */
#include <stdio.h>
#include <string.h>

#define UNIT(name) int test_##name(int, char **);
#include "units.list"
#undef UNIT

#define UNIT(name) {#name, test_##name},
static const struct {
  const char *name;
  int (*run)(int, char **);
} UNITS[] = {
#include "units.list"
};

int main(int argc, char **argv)
{
  for (size_t i = 0; argc > 1 && i < sizeof(UNITS) / sizeof(UNITS[0]); i++) {
    if (strcmp(argv[1], UNITS[i].name)) continue;
    argv[1] = argv[0]; /* the test's own program */
    return UNITS[i].run(argc - 1, argv + 1);
  }
  fprintf(stderr, "test_units: give the name of a test\n");
  return 1;
}

/* stream.c -- how many bytes a second one core moves between memory and registers: bytes.py runs it.

   The triad a := b + s c on arrays far larger than any cache. Three arrays move once: two are read, one is written. What the cache reads
   of a before it is written is not counted, as in STREAM. Prints the largest of some repeats, in bytes for each second of the processor. */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { LENGTH = 1 << 25, REPEATS = 10 }; /* 256 MB an array */

static double Seconds(void)
{
  return (double)clock() / CLOCKS_PER_SEC;
}

int main(void)
{
  double *a = malloc(LENGTH * sizeof(double)), *b = malloc(LENGTH * sizeof(double)),
         *c   = malloc(LENGTH * sizeof(double));
  double best = 0;

  if (!a || !b || !c) return 1;
  for (int i = 0; i < LENGTH; i++) {
    a[i] = 0;
    b[i] = i;
    c[i] = 2;
  }
  for (int k = 0; k < REPEATS; k++) {
    const double start = Seconds(), factor = k + 1;
    double       rate;

    for (int i = 0; i < LENGTH; i++) a[i] = b[i] + factor * c[i];
    rate = 3.0 * LENGTH * sizeof(double) / (Seconds() - start);
    if (rate > best) best = rate;
  }
  printf("%.4g %g\n", best, a[LENGTH / 2]); /* the second number keeps the compiler from leaving the loop out */
  free(a);
  free(b);
  free(c);
  return 0;
}

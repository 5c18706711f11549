/* What gcc makes of the generated functions in C: a loop over states in columns. Reads the number
 * of a function a line, runs it once and answers with its nanoseconds. Compiled with the header
 * named by -DHEADER, which defines LOOPS. */
#define _POSIX_C_SOURCE 199309L
#include HEADER
#include <stdio.h>
#include <time.h>

enum { STATES = 1024, PLACES = STATES + 8, MOST = 108 };

#define IN(a, n) {a[0 * n + s], a[1 * n + s], a[2 * n + s], a[3 * n + s], a[4 * n + s], a[5 * n + s]}
#define LOOP(NAME, T, RESULTS, CALL)                                                              \
  __attribute__((noinline, flatten)) static void NAME(const size_t n, const T *restrict x,       \
      const T *restrict y, const T *restrict z, T *restrict results) {                           \
    _Pragma("GCC ivdep") for (size_t s = 0; s < n; s++) {                                        \
      const T q[6] = IN(x, PLACES), qd[6] = IN(y, PLACES), last[6] = IN(z, PLACES);              \
      T r[RESULTS];                                                                               \
      CALL;                                                                                       \
      _Pragma("GCC unroll 128") for (size_t k = 0; k < RESULTS; k++) results[k * PLACES + s] = r[k]; \
    }                                                                                             \
  }

LOOPS

#define ALIGNED __attribute__((aligned(64)))
static double double_in[3][6 * PLACES] ALIGNED, double_out[MOST * PLACES] ALIGNED;
static float float_in[3][6 * PLACES] ALIGNED, float_out[MOST * PLACES] ALIGNED;

static void run_double(void (*f)(size_t, const double *, const double *, const double *, double *)) {
  f(STATES, double_in[0], double_in[1], double_in[2], double_out);
}

static void run_float(void (*f)(size_t, const float *, const float *, const float *, float *)) {
  f(STATES, float_in[0], float_in[1], float_in[2], float_out);
}

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return t.tv_sec * 1e9 + t.tv_nsec;
}

int main(void) {
  unsigned bits = 1;
  for (int a = 0; a < 3; a++)
    for (int i = 0; i < 6 * PLACES; i++) {
      bits = bits * 1664525u + 1013904223u;
      double_in[a][i] = 6.28 * (bits / 4294967296.0 - 0.5);
      float_in[a][i] = (float)double_in[a][i];
    }
  int which;
  while (scanf("%d", &which) == 1) {
    double start = now();
    switch (which) { CASES }
    printf("%.17g\n", now() - start);
    fflush(stdout);
  }
  return 0;
}

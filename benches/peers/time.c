/* Times or runs one function in C; compiled with its source named by -DSOURCE, its name by
 * -DNAME, joints by -DJOINTS and results by -DRESULTS. It is CasADi's, with -DPINOCCHIO
 * Pinocchio's, or with -DOURS=1 or 3 ours with so many arrays of results.
 *
 * `values STATES` prints the results at the states, a line each; `time STATES` the
 * nanoseconds a state, the median of many batches. */
#define _POSIX_C_SOURCE 199309L
#include SOURCE
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define GLUE_(a, b) a##b
#define GLUE(a, b) GLUE_(a, b)
enum { BATCHES = 301, MOST = 1000 };

static double states[MOST][3 * JOINTS], results[RESULTS], times[BATCHES];

static int order(const void* a, const void* b) {
  double x = *(const double*)a, y = *(const double*)b;
  return (x > y) - (x < y);
}

#if defined(OURS)
static void run(const double* state) {
  const double *qd = state + JOINTS, *x = state + 2 * JOINTS;
#if OURS == 3
  NAME(state, qd, x, results, results + JOINTS * JOINTS, results + 2 * JOINTS * JOINTS);
#else
  NAME(state, qd, x, results);
#endif
}
#elif defined(PINOCCHIO)
static void run(const double* state) {
  const double* in[1] = {state};
  double* out[1] = {results};
  struct LangCAtomicFun none = {0};
  NAME(in, out, none);
}
#else
static void run(const double* state) {
  static casadi_int iw[1024];
  static double w[65536];
  const double* arg[8] = {state, state + JOINTS, state + 2 * JOINTS};
  double* res[8] = {results};
  NAME(arg, res, iw, w, 0);
}
#endif

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return t.tv_sec * 1e9 + t.tv_nsec;
}

int main(int argc, char** argv) {
  if (argc != 3) return 2;
#if !defined(OURS) && !defined(PINOCCHIO)
  casadi_int arg, res, iw, w;
  GLUE(NAME, _work)(&arg, &res, &iw, &w);
  if (arg > 8 || res > 8 || iw > 1024 || w > 65536) return 2;
#endif
  FILE* file = fopen(argv[2], "r");
  if (!file) return 2;
  int count = 0;
  while (count < MOST) {
    int k = 0;
    while (k < 3 * JOINTS && fscanf(file, "%lf", &states[count][k]) == 1) k++;
    if (k < 3 * JOINTS) break;
    count++;
  }
  if (!strcmp(argv[1], "values")) {
    for (int s = 0; s < count; s++) {
      run(states[s]);
      for (int k = 0; k < RESULTS; k++) printf(k ? " %.17g" : "%.17g", results[k]);
      printf("\n");
    }
    return 0;
  }
  for (int batch = 0; batch < BATCHES; batch++) {
    double start = now();
    for (int s = 0; s < count; s++) {
      run(states[s]);
      __asm__ volatile("" : : "r"(results) : "memory");
    }
    times[batch] = (now() - start) / count;
  }
  qsort(times, BATCHES, sizeof *times, order);
  printf("%.17g\n", times[BATCHES / 2]);
  return 0;
}

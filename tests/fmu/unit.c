/* A unit for tests, FMI 3.0 or with -DFMI=2 2.0: u = -kp x - kd v, i = the integral of x, its own time, and faults at a time. When the
   library is loaded it leaves a file where the environment names one. */
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifndef FMI
#define FMI 3
#endif

enum { X = 1, V, U, INTEGRAL, TIME, KP, KD, FAULT, AT, INSTANCES, COUNT };
typedef void logger3(void *, int, const char *, const char *);
typedef struct {
  void (*logger)(void *, const char *, int, const char *, const char *, ...);
  void *(*allocate)(size_t, size_t);
  void (*release)(void *);
  void (*finished)(void *, int);
  void *environment;
} Callbacks;
typedef struct { double value[COUNT]; void *log; } Unit;
static int instances; /* in this library */

__attribute__((constructor)) static void loaded(void) {
  const char *name = getenv("NIVEL_TEST_LOADED");
  FILE *file = name ? fopen(name, "w") : NULL;
  if (file) fclose(file);
}

static void compute(Unit *unit) {
  double *v = unit->value;
  v[U] = -v[KP] * v[X] - v[KD] * v[V];
}

static void *made(Unit *unit, void *log) {
  unit->value[KP] = 40.0, unit->value[KD] = 8.0, unit->value[AT] = 1e9, unit->log = log;
  unit->value[INSTANCES] = ++instances;
  return unit;
}

/* 0: nothing; 1: an error with a message; 2: no number; 3: the end is asked for; 4 and 5: a status that FMI does not know */
static int step(Unit *unit, double now, double length, bool *ends) {
  double *v = unit->value;
  v[INTEGRAL] += length * v[X], v[TIME] = now + length;
  compute(unit);
  *ends = false;
  if (v[TIME] < v[AT]) return 0;
  if (v[FAULT] == 2.0) v[U] = NAN;
  if (v[FAULT] == 3.0) *ends = true;
  if (v[FAULT] == 4.0) return 99;
  if (v[FAULT] == 5.0) return -1;
  if (v[FAULT] != 1.0) return 0;
#if FMI == 3
  ((logger3 *)unit->log)(NULL, 3, "logStatusError", "the sensor is lost");
#else
  Callbacks *callbacks = unit->log;
  callbacks->logger(callbacks->environment, "unit", 3, "logStatusError", "%s", "the sensor is lost");
#endif
  return 3;
}

static int get(Unit *unit, const uint32_t *references, size_t count, double *values) {
  for (size_t k = 0; k < count; ++k) values[k] = unit->value[references[k]];
  return 0;
}
static int set(Unit *unit, const uint32_t *references, size_t count, const double *values) {
  for (size_t k = 0; k < count; ++k) unit->value[references[k]] = values[k];
  return 0;
}
static int get_state(Unit *unit, void **state) {
  if (!*state) *state = malloc(sizeof unit->value);
  return memcpy(*state, unit->value, sizeof unit->value), 0;
}
static int set_state(Unit *unit, void *state) { return memcpy(unit->value, state, sizeof unit->value), 0; }
static int read_state(const void *bytes, void **state) {
  if (!*state) *state = malloc(sizeof(double[COUNT]));
  return memcpy(*state, bytes, sizeof(double[COUNT])), 0;
}

#if FMI == 3
void *fmi3InstantiateCoSimulation(const char *name, const char *token, const char *folder, bool visible, bool logging, bool events, bool early,
    const uint32_t *required, size_t count, void *environment, void *log, void *update) {
  return strcmp(token, "unit") ? NULL : made(calloc(1, sizeof(Unit)), log);
}
void fmi3FreeInstance(void *unit) { --instances, free(unit); }
int fmi3EnterInitializationMode(Unit *unit, bool a, double b, double start, bool c, double d) { return unit->value[TIME] = start, 0; }
int fmi3ExitInitializationMode(void *unit) { return compute(unit), 0; }
int fmi3GetFloat64(void *u, const uint32_t *references, size_t count, double *values, size_t n) { return get(u, references, count, values); }
int fmi3SetFloat64(void *u, const uint32_t *references, size_t count, const double *values, size_t n) { return set(u, references, count, values); }
int fmi3DoStep(void *unit, double now, double length, bool a, bool *event, bool *ends, bool *early, double *last) {
  *event = *early = false, *last = now + length;
  return step(unit, now, length, ends);
}
int fmi3GetFMUState(void *unit, void **state) { return get_state(unit, state); }
int fmi3SetFMUState(void *unit, void *state) { return set_state(unit, state); }
int fmi3FreeFMUState(void *unit, void **state) { return free(*state), *state = NULL, 0; }
int fmi3SerializedFMUStateSize(void *unit, void *state, size_t *size) { return *size = sizeof(double[COUNT]), 0; }
int fmi3SerializeFMUState(void *unit, void *state, void *bytes, size_t size) { return memcpy(bytes, state, size), 0; }
int fmi3DeserializeFMUState(void *unit, const void *bytes, size_t size, void **state) { return read_state(bytes, state); }
#else
void *fmi2Instantiate(const char *name, int type, const char *token, const char *where, const Callbacks *callbacks, int visible, int logging) {
  return strcmp(token, "unit") || strncmp(where, "file:", 5) ? NULL : made(callbacks->allocate(1, sizeof(Unit)), (void *)callbacks);
}
void fmi2FreeInstance(Unit *unit) { --instances, ((Callbacks *)unit->log)->release(unit); }
int fmi2SetupExperiment(Unit *unit, int a, double b, double start, int c, double d) { return unit->value[TIME] = start, 0; }
int fmi2EnterInitializationMode(void *unit) { return 0; }
int fmi2ExitInitializationMode(void *unit) { return compute(unit), 0; }
int fmi2GetReal(void *unit, const uint32_t *references, size_t count, double *values) { return get(unit, references, count, values); }
int fmi2SetReal(void *unit, const uint32_t *references, size_t count, const double *values) { return set(unit, references, count, values); }
int fmi2DoStep(void *unit, double now, double length, int a) {
  bool ends;
  int status = step(unit, now, length, &ends);
  return ends ? 2 : status;
}
int fmi2GetFMUstate(void *unit, void **state) { return get_state(unit, state); }
int fmi2SetFMUstate(void *unit, void *state) { return set_state(unit, state); }
int fmi2FreeFMUstate(void *unit, void **state) { return free(*state), *state = NULL, 0; }
int fmi2SerializedFMUstateSize(void *unit, void *state, size_t *size) { return *size = sizeof(double[COUNT]), 0; }
int fmi2SerializeFMUstate(void *unit, void *state, void *bytes, size_t size) { return memcpy(bytes, state, size), 0; }
int fmi2DeSerializeFMUstate(void *unit, const void *bytes, size_t size, void **state) { return read_state(bytes, state); }
#endif

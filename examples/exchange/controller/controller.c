/* A PID controller with a memory, as a unit for co-simulation by FMI 3.0. */
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* value references are places in this list: inputs x and v, parameters, output */
enum { X = 1, V, REFERENCE, KP, KD, KI, FORCE, COUNT };
typedef struct { double value[COUNT], integral; } Unit;

static void compute(Unit *unit) {
  double *value = unit->value, error = value[REFERENCE] - value[X];
  value[FORCE] = value[KP] * error - value[KD] * value[V] + value[KI] * unit->integral;
}

void *fmi3InstantiateCoSimulation(const char *name, const char *token, const char *folder, bool visible, bool logging, bool events, bool early,
    const uint32_t *required, size_t count, void *environment, void *log, void *update) {
  Unit *unit = calloc(1, sizeof *unit);
  unit->value[KP] = 40.0, unit->value[KD] = 12.0, unit->value[KI] = 20.0;
  return unit;
}
void fmi3FreeInstance(void *unit) { free(unit); }
int fmi3EnterInitializationMode(void *unit, bool tolerance, double value, double start, bool stops, double stop) { return 0; }
int fmi3ExitInitializationMode(void *unit) { return compute(unit), 0; }
int fmi3GetFloat64(void *unit, const uint32_t *references, size_t count, double *values, size_t n) {
  for (size_t k = 0; k < count; ++k) values[k] = ((Unit *)unit)->value[references[k]];
  return 0;
}
int fmi3SetFloat64(void *unit, const uint32_t *references, size_t count, const double *values, size_t n) {
  for (size_t k = 0; k < count; ++k) ((Unit *)unit)->value[references[k]] = values[k];
  return 0;
}
int fmi3DoStep(void *unit, double now, double length, bool never_back, bool *event, bool *ends, bool *early, double *last) {
  Unit *own = unit;
  own->integral += length * (own->value[REFERENCE] - own->value[X]);
  compute(own);
  *event = *ends = *early = false, *last = now + length;
  return 0;
}
/* states, so that a simulation can be saved and restored */
int fmi3GetFMUState(void *unit, void **state) {
  if (!*state) *state = malloc(sizeof(Unit));
  return memcpy(*state, unit, sizeof(Unit)), 0;
}
int fmi3SetFMUState(void *unit, void *state) { return memcpy(unit, state, sizeof(Unit)), 0; }
int fmi3FreeFMUState(void *unit, void **state) { return free(*state), *state = NULL, 0; }
int fmi3SerializedFMUStateSize(void *unit, void *state, size_t *size) { return *size = sizeof(Unit), 0; }
int fmi3SerializeFMUState(void *unit, void *state, void *bytes, size_t size) { return memcpy(bytes, state, sizeof(Unit)), 0; }
int fmi3DeserializeFMUState(void *unit, const void *bytes, size_t size, void **state) {
  if (!*state) *state = malloc(sizeof(Unit));
  return memcpy(*state, bytes, sizeof(Unit)), 0;
}

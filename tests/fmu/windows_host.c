/* Steps an FMU on Windows: windows_host DLL RESOURCES STEP COUNT REFERENCE..., and prints the values of these references. */
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <windows.h>

static void log_message(void *environment, int status, const char *category, const char *message) { fprintf(stderr, "%s\n", message); }

int main(int count, char **word) {
  HMODULE unit = LoadLibraryA(word[1]);
  if (!unit) return 1;
#define FUNCTION(RESULT, NAME, ...) RESULT (*NAME)(__VA_ARGS__) = (RESULT (*)(__VA_ARGS__))(void *)GetProcAddress(unit, "fmi3" #NAME)
  FUNCTION(void *, InstantiateCoSimulation, const char *, const char *, const char *, bool, bool, bool, bool, void *, size_t, void *, void *, void *);
  FUNCTION(int, EnterInitializationMode, void *, bool, double, double, bool, double);
  FUNCTION(int, ExitInitializationMode, void *);
  FUNCTION(int, DoStep, void *, double, double, bool, bool *, bool *, bool *, double *);
  FUNCTION(int, GetFloat64, void *, const uint32_t *, size_t, double *, size_t);
  void *instance = InstantiateCoSimulation("unit", NULL, word[2], 0, 0, 0, 0, NULL, 0, NULL, log_message, NULL);
  if (!instance) return 2;
  EnterInitializationMode(instance, 0, 0.0, 0.0, 0, 0.0);
  ExitInitializationMode(instance);
  bool event, ends, early;
  double last, value, step = atof(word[3]);
  for (int k = 0; k < atoi(word[4]); ++k)
    if (DoStep(instance, k * step, step, 1, &event, &ends, &early, &last)) return 3;
  for (int k = 5; k < count; ++k) {
    uint32_t reference = (uint32_t)atoi(word[k]);
    GetFloat64(instance, &reference, 1, &value, 1);
    printf("%.17g\n", value);
  }
  return 0;
}

/* Steps the machine for a second, or until an event ends its motion, and prints its outputs as a table. */
#include "$name.h"
#include <stdio.h>
#include <stdlib.h>
#ifdef _WIN32 /* whose C library has no aligned_alloc */
#include <malloc.h>
#define aligned_alloc(alignment, size) _aligned_malloc(size, alignment)
#define free(block) _aligned_free(block)
#endif

int main(void) {
  char text[256];
  void *machine = aligned_alloc(${NAME}_ALIGNMENT, ${NAME}_SIZE);
  int status = ${name}_start(machine);
  for (int k = 0; k < ${NAME}_OUTPUTS; ++k) printf(k ? ",%s" : "%s", ${name}_output_names[k]);
  for (;;) {
    if (status == ${NAME}_OK || status == ${NAME}_ENDED)
      for (int k = 0; k < ${NAME}_OUTPUTS; ++k) printf(k ? ",%.17g" : "\n%.17g", ${name}_outputs(machine)[k]);
    if (status != ${NAME}_OK || ${name}_time(machine) > 1.0 - 0.5 * ${NAME}_STEP) break;
    status = ${name}_step(machine);
  }
  printf("\n");
  if (status != ${NAME}_OK) {
    ${name}_message(machine, status, text, sizeof text);
    fprintf(stderr, "%s\n", text);
  }
  free(machine);
  return status == ${NAME}_OK || status == ${NAME}_ENDED ? 0 : 1;
}

/* $name: a machine as a C library. Nothing is needed but libc and libm; nothing is allocated.
   Written by nivel $version.

   Not verified: the library makes single runs with steps of $step s, whose error nothing estimates. `nivel run` with this step does,
   for the inputs of the machine file.

   A machine lives in a block of ${NAME}_SIZE bytes, aligned to ${NAME}_ALIGNMENT. Blocks are independent of each other. */
#ifndef ${NAME}_H
#define ${NAME}_H
#include <stddef.h>
#ifdef __cplusplus
extern "C" {
#endif

#define ${NAME}_SIZE $size
#define ${NAME}_ALIGNMENT $alignment
/* seconds of a step */
#define ${NAME}_STEP $step

/* what `start` and `step` return */
enum {
  ${NAME}_OK = 0,
  ${NAME}_ENDED = 5, /* no failure: an event of the machine has ended the motion; further steps change nothing */
  /* failures */
$failures
};

/* places of the outputs, and their units */
enum {
$enumeration
  ${NAME}_OUTPUTS
};
extern const char *const ${name}_output_names[${NAME}_OUTPUTS];
extern const char *const ${name}_output_units[${NAME}_OUTPUTS];

size_t ${name}_size(void);
/* Puts the machine at its start into the block, and evaluates it there. Returns a status. */
int ${name}_start(void *machine);
/* One step. Returns a status; after a failure the state is that of the last step that was done. */
int ${name}_step(void *machine);
/* The time reached [s]. */
double ${name}_time(const void *machine);
/* Outputs at this time, ${NAME}_OUTPUTS of them. */
const double *${name}_outputs(const void *machine);
/* Writes what a status means into `text`, of `size` characters: a sentence with the time, and with the name of what failed. */
void ${name}_message(const void *machine, int status, char *text, size_t size);
$inputs_declared/* Copies the whole state, inputs among it, and goes on from it in a block of this machine, the same one or another, also in
   another process. */
void ${name}_save(const void *machine, void *copy);
void ${name}_restore(void *machine, const void *copy);

#ifdef __cplusplus
}
#endif
#endif

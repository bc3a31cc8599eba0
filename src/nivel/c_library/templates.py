"""Texts of the files of a C library."""

from __future__ import annotations

from string import Template

HEADER = Template("""/* $name: a machine as a C library. Nothing is needed but libc and libm; nothing is allocated. SI units.
   Written by nivel $version.

   A machine lives in a block of ${name}_size() bytes, aligned to 64. Blocks are independent of each other. */
#ifndef ${NAME}_H
#define ${NAME}_H
#include <stddef.h>
#ifdef __cplusplus
extern "C" {
#endif

/* seconds of a step */
#define ${NAME}_STEP $step

/* places of the outputs */
enum {
$enumeration,
${NAME}_OUTPUTS
};
extern const char *const ${name}_output_names[${NAME}_OUTPUTS];

size_t ${name}_size(void);
/* Puts the machine at its start into the block, and evaluates it there. 0, or the number of a failure. */
int ${name}_start(void *machine);
/* One step. 0, or the number of a failure; the state is then that of the last step that was done. */
int ${name}_step(void *machine);
/* The time reached [s]. */
double ${name}_time(const void *machine);
/* Outputs at this time, ${NAME}_OUTPUTS of them. */
const double *${name}_outputs(const void *machine);
${inputs_declared}/* Copies the whole state, inputs among it, into another block of the same size, and back again. */
void ${name}_save(const void *machine, void *copy);
void ${name}_restore(void *machine, const void *copy);

#ifdef __cplusplus
}
#endif
#endif
""")

# of a machine that has inputs
INPUTS_DECLARED = Template("""/* places of the inputs */
enum {
$input_enumeration,
${NAME}_INPUTS
};
extern const char *const ${name}_input_names[${NAME}_INPUTS];
/* least and greatest value of each */
extern const double ${name}_input_ranges[${NAME}_INPUTS][2];
/* The place of the input of this name, or -1. */
int ${name}_find_input(const char *name);
/* Sets an input from the next step on, until it is set again; without that it is as in the machine file.
   0, or -1 where there is no such input, or the value is not within its range: then nothing changes. */
int ${name}_set_input(void *machine, int input, double value);
/* The value that was set; NaN where none was, or there is no such input. */
double ${name}_input(const void *machine, int input);
""")

INPUTS = Template("""
const char *const ${name}_input_names[${NAME}_INPUTS] = {
$input_names};
const double ${name}_input_ranges[${NAME}_INPUTS][2] = {
$input_ranges};
/* bytes of the kind and of the value of the function of each input */
static const uint32_t input_places[${NAME}_INPUTS][2] = {
$input_places};

int ${name}_find_input(const char *name) {
  for (int k = 0; k < ${NAME}_INPUTS; ++k)
    if (!strcmp(name, ${name}_input_names[k])) return k;
  return -1;
}

static int is_set(const void *machine, int input) {
  return input >= 0 && input < ${NAME}_INPUTS && *(const uint32_t *)((const char *)machine + input_places[input][0]) == $constant &&
         *count((void *)machine, $touched + 8 * (1 + (size_t)input));
}

double ${name}_input(const void *machine, int input) {
  return is_set(machine, input) ? *(const double *)((const char *)machine + input_places[input][1]) : 0.0 / 0.0;
}

int ${name}_set_input(void *machine, int input, double value) {
  if (input < 0 || input >= ${NAME}_INPUTS) return -1;
  if (!(value >= ${name}_input_ranges[input][0] && value <= ${name}_input_ranges[input][1])) return -1;
  uint32_t *kind = (uint32_t *)((char *)machine + input_places[input][0]);
  double *kept = (double *)((char *)machine + input_places[input][1]);
  if (*kind != $constant || *kept != value) *count(machine, $touched) = 1;
  *kind = $constant;
  *kept = value;
  *count(machine, $touched + 8 * (1 + (size_t)input)) = 1;
  return 0;
}

/* What depends on inputs that were changed since the last step. */
static int read_inputs(void *machine) {
  typedef int64_t evaluation(uint64_t, double, void *, int64_t, void *, int64_t);
  if (!*count(machine, $touched)) return 0;
  *count(machine, $touched) = 0;
  *count(machine, $restart) = 1;
  evaluation *evaluate = (evaluation *)(uintptr_t)address($evaluate);
  return (int)evaluate(address((char *)machine + $machine), *(double *)((char *)machine + $time), (char *)machine + $y, $y_size,
                       (char *)machine + $rate, $y_size);
}
""")

SOURCE = Template("""#include "$name.h"
#include <stdint.h>
#include <string.h>

/* machine code of the kernels; entries call each other by addresses */
extern int64_t $advance(uint64_t, uint64_t, uint64_t, uint64_t, uint64_t);
$declarations

/* words of the block that are not zero */
static const uint32_t places[$count] = {
$places};
static const uint64_t words[$count] = {
$words};
/* words that are addresses: of bytes of the block, and of machine code */
static const uint32_t inner[$inner_count][2] = {
$inner};
static const struct { uint32_t word; const char *code; } outer[$outer_count] = {
$outer};

const char *const ${name}_output_names[$width] = {
$output_names};

static uint64_t address(const void *pointer) { return (uint64_t)(uintptr_t)pointer; }
static int64_t *count(void *machine, size_t byte) { return (int64_t *)((char *)machine + byte); }

${inputs_defined}
static int go_on(void *machine, int64_t steps) {
  *count(machine, $budget) = steps;
  *count(machine, $frame_count) = 0;
  *count(machine, $event_count) = 0;
  int64_t status = $advance(address($evaluate), address($correct), address($take_step), address((char *)machine + $machine),
                            address((char *)machine + $history));
  return status == $spent ? 0 : (int)status;
}

size_t ${name}_size(void) { return $size; }

int ${name}_start(void *machine) {
  uint64_t *block = machine;
  memset(block, 0, $size);
  for (size_t k = 0; k < $count; ++k) block[places[k]] = words[k];
  for (size_t k = 0; k < $inner_count; ++k) block[inner[k][0]] = address((char *)machine + inner[k][1]);
  for (size_t k = 0; k < $outer_count; ++k) block[outer[k].word] = address(outer[k].code);
  return go_on(machine, 0);
}

int ${name}_step(void *machine) { $step_body }

double ${name}_time(const void *machine) { return *(const double *)((const char *)machine + $time); }

const double *${name}_outputs(const void *machine) { return (const double *)((const char *)machine + $frames); }

void ${name}_save(const void *machine, void *copy) { memcpy(copy, machine, $size); }

void ${name}_restore(void *machine, const void *copy) { memcpy(machine, copy, $size); }
""")

EXAMPLE = Template("""/* Steps the machine for a second, and prints its outputs as a table. */
#include "$name.h"
#include <stdio.h>
#include <stdlib.h>
#ifdef _WIN32 /* whose C library has no aligned_alloc */
#include <malloc.h>
#define aligned_alloc(alignment, size) _aligned_malloc(size, alignment)
#define free(block) _aligned_free(block)
#endif

int main(void) {
  void *machine = aligned_alloc(64, ${name}_size());
  int failure = ${name}_start(machine);
  for (int k = 0; k < ${NAME}_OUTPUTS; ++k) printf(k ? ",%s" : "%s", ${name}_output_names[k]);
  while (!failure) {
    for (int k = 0; k < ${NAME}_OUTPUTS; ++k) printf(k ? ",%.17g" : "\\n%.17g", ${name}_outputs(machine)[k]);
    if (${name}_time(machine) > 1.0 - 0.5 * ${NAME}_STEP) break;
    failure = ${name}_step(machine);
  }
  printf("\\n");
  free(machine);
  return failure;
}
""")

MAKEFILE = Template("""all: lib$name.a lib$name.so example

$name.o: $name.c $name.h
	$$(CC) -O2 -fPIC -c $name.c

lib$name.a: $name.o
	$$(AR) rcs $$@ $name.o kernels/*.o

lib$name.so: $name.o
	$$(CC) -shared -o $$@ $name.o kernels/*.o -lm -Wl,--no-undefined

example: example.c lib$name.a
	$$(CC) -O2 -o $$@ example.c lib$name.a -lm
""")

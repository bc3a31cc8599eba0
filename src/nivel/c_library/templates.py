"""Texts of the files of a C library."""

from __future__ import annotations

from string import Template

HEADER = Template("""/* $name: a machine as a C library. Nothing is needed but libc and libm; nothing is allocated.
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
""")

# of a machine that has inputs
INPUTS_DECLARED = Template("""/* places of the inputs */
enum {
$input_enumeration
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

int ${name}_find_input(const char *name) {
  for (int k = 0; k < ${NAME}_INPUTS; ++k)
    if (!strcmp(name, ${name}_input_names[k])) return k;
  return -1;
}

double ${name}_input(const void *machine, int input) {
  if (input < 0 || input >= ${NAME}_INPUTS || !nivel_is_set(&model, machine, (size_t)input)) return NAN;
  return *(const double *)((const char *)machine + inputs[input].value);
}

int ${name}_set_input(void *machine, int input, double value) {
  return input < 0 || input >= ${NAME}_INPUTS ? -1 : nivel_set_input(&model, machine, (size_t)input, value);
}
""")

SOURCE = Template("""#include "$name.h"
#include "nivel_machine.h"

/* machine code of the kernels; entries call each other by addresses */
$declarations
static void *const codes[] = {
$codes};

/* words of the block that are not zero */
static const uint32_t places[] = {
$places};
static const uint64_t words[] = {
$words};
/* words that are addresses: of bytes of the block, and of machine code */
static const nivel_place inner[] = {
$inner};
static const nivel_place outer[] = {
$outer};
static const uint32_t outputs[] = {
$output_places};
static const nivel_input inputs[] = {
$input_places};
static const char *const names[] = {
$names};
static const nivel_failure failures[] = {
$failure_table};

static const nivel_model model = {
$numbers,
  places, words, inner, outer, outputs, inputs, failures, names, codes};

const char *const ${name}_output_names[${NAME}_OUTPUTS] = {
$output_names};
const char *const ${name}_output_units[${NAME}_OUTPUTS] = {
$output_units};
$inputs_defined
size_t ${name}_size(void) { return ${NAME}_SIZE; }

int ${name}_start(void *machine) {
  nivel_load(&model, machine);
  return nivel_go(&model, machine, 0);
}

int ${name}_step(void *machine) { return nivel_go(&model, machine, 1); }

double ${name}_time(const void *machine) { return *nivel_clock(&model, machine, NIVEL_TIME); }

const double *${name}_outputs(const void *machine) { return nivel_outputs(&model, machine); }

void ${name}_message(const void *machine, int status, char *text, size_t size) { nivel_say(&model, machine, status, text, size); }

void ${name}_save(const void *machine, void *copy) { memcpy(copy, machine, ${NAME}_SIZE); }

void ${name}_restore(void *machine, const void *copy) {
  memmove(machine, copy, ${NAME}_SIZE);
  nivel_relocate(&model, machine);
}
""")

EXAMPLE = Template("""/* Steps the machine for a second, or until an event ends its motion, and prints its outputs as a table. */
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
      for (int k = 0; k < ${NAME}_OUTPUTS; ++k) printf(k ? ",%.17g" : "\\n%.17g", ${name}_outputs(machine)[k]);
    if (status != ${NAME}_OK || ${name}_time(machine) > 1.0 - 0.5 * ${NAME}_STEP) break;
    status = ${name}_step(machine);
  }
  printf("\\n");
  if (status != ${NAME}_OK) {
    ${name}_message(machine, status, text, sizeof text);
    fprintf(stderr, "%s\\n", text);
  }
  free(machine);
  return status == ${NAME}_OK || status == ${NAME}_ENDED ? 0 : 1;
}
""")

MAKEFILE = Template("""CC = $compiler
AR = $archiver

all: lib$name.a lib$name$suffix example

$name.o: $name.c $name.h nivel_machine.h
	$$(CC) -O2 -fPIC -c $name.c

lib$name.a: $name.o
	$$(AR) rcs $$@ $name.o kernels/*.o

lib$name$suffix: $name.o
	$$(CC) -shared -o $$@ $name.o kernels/*.o -lm -Wl,--no-undefined

example: example.c lib$name.a
	$$(CC) -O2 -o $$@ example.c lib$name.a -lm
""")

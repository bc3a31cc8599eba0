/* A machine of nivel in a block of memory: what C libraries and FMUs have in common. Needs libc; nothing is allocated, nothing is global.

   The block begins with the image of the machine's records. Behind it stand, in words of 8 bytes: whether an input was changed since the
   last step, which inputs were set, and the outputs. */
#ifndef NIVEL_MACHINE_H
#define NIVEL_MACHINE_H
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

/* statuses of the loop that are no failures */
enum { NIVEL_BUFFER_FULL = 3, NIVEL_BUDGET_SPENT = 4, NIVEL_ENDED = 5 };
/* numbers of a run, by their places in `clock` and in `counter` */
enum { NIVEL_TIME = 0, NIVEL_STEP = 1, NIVEL_END = 3 };
enum {
  NIVEL_DONE = 0, NIVEL_ALL = 1, NIVEL_EVERY = 2, NIVEL_FRAMES = 3, NIVEL_LAST_FRAME = 4, NIVEL_BUDGET = 5, NIVEL_RESTART = 10,
  NIVEL_STOPPED = 13, NIVEL_EVENTS = 14
};
/* more steps than are ever done */
#define NIVEL_ENDLESS ((int64_t)1 << 52)

typedef struct { uint32_t word, at; } nivel_place;
/* bytes of the kind and of the value of the function of an input */
typedef struct { uint32_t kind, value; double low, high; } nivel_input;
/* what is said of a failure; {} stands for the name of what failed, one of `count` names from `first` on */
typedef struct { int32_t status; uint32_t first, count; const char *sentence; } nivel_failure;

/* Facts of a machine, the same for all its blocks. Places are bytes of the block, where nothing else is said. */
typedef struct {
  uint64_t image;    /* bytes of the image */
  uint64_t size;     /* bytes of a block */
  uint64_t count, inner_count, outer_count, output_count, input_count, failure_count;
  uint64_t machine, history, clock, counter, frames, y, rate, y_size, failed;
  uint64_t constant; /* kind of the function of an input that was set */
  uint64_t advance, evaluate, correct, step; /* numbers of codes */
  const uint32_t *places; /* words that are not zero */
  const uint64_t *words;
  const nivel_place *inner; /* words that are addresses of bytes of the block */
  const nivel_place *outer; /* words that are addresses of codes */
  const uint32_t *outputs;  /* places in a frame */
  const nivel_input *inputs;
  const nivel_failure *failures;
  const char *const *names;
  void *const *codes; /* machine code of entries */
} nivel_model;

static inline uint64_t nivel_address(const void *pointer) { return (uint64_t)(uintptr_t)pointer; }
static inline int64_t *nivel_count(const nivel_model *m, void *block, int k) { return (int64_t *)((char *)block + m->counter) + k; }
static inline double *nivel_clock(const nivel_model *m, const void *block, int k) { return (double *)((char *)block + m->clock) + k; }
static inline int64_t *nivel_changed(const nivel_model *m, const void *block) { return (int64_t *)((char *)block + m->image); }
static inline double *nivel_outputs(const nivel_model *m, const void *block) {
  return (double *)((char *)block + m->image + 8 * (1 + m->input_count));
}

/* Writes the addresses into a block, which may have been copied from another place. */
static inline void nivel_relocate(const nivel_model *m, void *block) {
  uint64_t *words = (uint64_t *)block;
  for (size_t k = 0; k < m->inner_count; ++k) words[m->inner[k].word] = nivel_address((char *)block + m->inner[k].at);
  for (size_t k = 0; k < m->outer_count; ++k) words[m->outer[k].word] = nivel_address(m->codes[m->outer[k].at]);
}

/* Puts the image into a block; nothing is evaluated yet. */
static inline void nivel_load(const nivel_model *m, void *block) {
  memset(block, 0, m->size);
  for (size_t k = 0; k < m->count; ++k) ((uint64_t *)block)[m->places[k]] = m->words[k];
  nivel_relocate(m, block);
}

/* What depends on inputs that were changed since the last step. */
static inline int nivel_read_inputs(const nivel_model *m, void *block) {
  typedef int64_t evaluation(uint64_t, double, void *, int64_t, void *, int64_t);
  int64_t *changed = nivel_changed(m, block);
  if (!*changed) return 0;
  *changed = 0;
  *nivel_count(m, block, NIVEL_RESTART) = 1;
  evaluation *evaluate = (evaluation *)(uintptr_t)nivel_address(m->codes[m->evaluate]);
  return (int)evaluate(nivel_address((char *)block + m->machine), *nivel_clock(m, block, NIVEL_TIME), (char *)block + m->y,
                       (int64_t)m->y_size, (char *)block + m->rate, (int64_t)m->y_size);
}

/* Goes on by whole steps, with a frame after the last one, whose numbers become the outputs. 0, NIVEL_ENDED, or a failure. */
static inline int nivel_go(const nivel_model *m, void *block, int64_t steps) {
  typedef int64_t loop(uint64_t, uint64_t, uint64_t, uint64_t, uint64_t);
  int64_t *count = nivel_count(m, block, 0), done = count[NIVEL_DONE], status;
  loop *advance = (loop *)(uintptr_t)nivel_address(m->codes[m->advance]);
  if (steps && (status = nivel_read_inputs(m, block))) return (int)status;
  count[NIVEL_EVERY] = steps ? done + steps : 1;
  do {
    count[NIVEL_BUDGET] = done + steps - count[NIVEL_DONE];
    count[NIVEL_FRAMES] = count[NIVEL_EVENTS] = 0;
    status = advance(nivel_address(m->codes[m->evaluate]), nivel_address(m->codes[m->correct]), nivel_address(m->codes[m->step]),
                     nivel_address((char *)block + m->machine), nivel_address((char *)block + m->history));
  } while (status == NIVEL_BUFFER_FULL);
  if (count[NIVEL_FRAMES]) {
    const double *frame = (const double *)((char *)block + m->frames);
    double *outputs = nivel_outputs(m, block);
    for (size_t k = 0; k < m->output_count; ++k) outputs[k] = frame[m->outputs[k]];
  }
  if (count[NIVEL_STOPPED]) return status == NIVEL_ENDED ? NIVEL_ENDED : (int)status;
  return status == NIVEL_BUDGET_SPENT || status == NIVEL_ENDED ? 0 : (int)status;
}

static inline int nivel_is_set(const nivel_model *m, const void *block, size_t input) {
  uint32_t kind;
  memcpy(&kind, (const char *)block + m->inputs[input].kind, sizeof kind);
  return kind == m->constant && nivel_changed(m, block)[1 + input];
}

/* Sets an input. 0, or -1 where the value is not within the range: then nothing changes. */
static inline int nivel_set_input(const nivel_model *m, void *block, size_t input, double value) {
  const nivel_input *at = m->inputs + input;
  if (!(value >= at->low && value <= at->high)) return -1;
  uint32_t kind, constant = (uint32_t)m->constant;
  double *kept = (double *)((char *)block + at->value);
  memcpy(&kind, (char *)block + at->kind, sizeof kind);
  if (kind != constant || *kept != value) *nivel_changed(m, block) = 1;
  memcpy((char *)block + at->kind, &constant, sizeof constant);
  *kept = value;
  nivel_changed(m, block)[1 + input] = 1;
  return 0;
}

/* What a status means, as a sentence. */
static inline void nivel_say(const nivel_model *m, const void *block, int status, char *text, size_t size) {
  double t = *nivel_clock(m, block, NIVEL_TIME);
  uint32_t number;
  memcpy(&number, (const char *)block + m->failed, sizeof number);
  for (size_t k = 0; k < m->failure_count; ++k) {
    const nivel_failure *f = m->failures + k;
    if (f->status != status) continue;
    const char *hole = strstr(f->sentence, "{}");
    if (!hole) snprintf(text, size, "stopped at t = %.6g s: %s", t, f->sentence);
    else
      snprintf(text, size, "stopped at t = %.6g s: %.*s%s%s", t, (int)(hole - f->sentence), f->sentence,
               number < f->count ? m->names[f->first + number] : "something", hole + 2);
    return;
  }
  if (!status) snprintf(text, size, "t = %.6g s", t);
  else if (status == NIVEL_ENDED) snprintf(text, size, "an event ended the motion at t = %.6g s", t);
  else snprintf(text, size, "stopped at t = %.6g s: failure %d", t, status);
}
#endif

/* FMI 3.0 and 2.0 co-simulation of any machine of nivel. Nothing of a machine is in here: its numbers stand in resources/machine.bin, and
   the machine code of its entries is found by name in tables that are linked to this file. Instances share nothing. */
#include "nivel_machine.h"
#include <stdarg.h>
#include <stdbool.h>
#include <stdlib.h>
#ifdef _WIN32
#include <wchar.h>
/* windows.h defines too many words */
__declspec(dllimport) int __stdcall MultiByteToWideChar(unsigned int, unsigned long, const char *, int, wchar_t *, int);
#define UTF_8 65001
#define EXPORT __declspec(dllexport)
#else
#define EXPORT __attribute__((visibility("default")))
#endif

/* tables of entries, the best one first; fits() says whether this processor runs it. NULL after the last one. */
typedef struct { const char *name; void *code; } nivel_entry;
typedef struct { int (*fits)(void); const nivel_entry *entries; } nivel_table;
extern const nivel_table nivel_tables[];

enum { MAGIC = 0x324d464e, HEAD = 8, NUMBERS = 22 };
/* places of a run's clock */
enum { TICKS = 15, TICK_RATE = 16 };
/* value references: places of outputs in a frame, inputs, parameters */
enum { INPUT = 1 << 20, PARAMETER = 2 << 20 };
enum { OK = 0, DISCARD = 2, ERROR = 3 };
typedef enum { INSTANTIATED, INITIALISING, STEPPING, TERMINATED } Mode;

/* A word y of the image that follows from parameters: y = sign |z|^power, or z where power = 1, with z = constant + the sum of its terms
   P(t)/Q(t), t = (x - centre)/width. */
typedef struct { double value, least, centre, width; } Parameter;
typedef struct { uint64_t word; double constant, power, sign; } Number;
typedef struct { uint32_t number, parameter; double factors[4], divisors[4]; } Term;

typedef void logger3(void *, int, const char *, const char *);
typedef struct {
  void (*logger)(void *, const char *, int, const char *, const char *, ...);
  void *(*allocate)(size_t, size_t);
  void (*release)(void *);
  void (*finished)(void *, int);
  void *environment;
} Callbacks2;

/* what a saved state has besides the block */
typedef struct { double start; int64_t mode, fresh, failure, parameters; } Kept;

typedef struct {
  nivel_model model;
  void *memory, *block; /* the block, aligned, within its memory */
  char *file;
  void **codes;
  nivel_failure *failures;
  const char **names;
  const Parameter *defaults;
  const Number *numbers;
  const Term *terms;
  size_t number_count, term_count;
  uint64_t energy;
  const char *token;
  double *parameters;
  size_t parameter_count;
  Kept now; /* fresh: the block is at the start that follows from parameters and inputs, or further */
  bool early;
  void *environment;
  logger3 *log3;
  const Callbacks2 *log2;
  char name[128];
} Instance;

static int say(Instance *i, int status, const char *text, ...) {
  char message[512];
  va_list rest;
  va_start(rest, text);
  vsnprintf(message, sizeof message, text, rest);
  va_end(rest);
  if (i->log3) i->log3(i->environment, status, "logStatusError", message);
  if (i->log2 && i->log2->logger) i->log2->logger(i->log2->environment, i->name, status, "logStatusError", "%s", message);
  return status;
}

static void release(Instance *i) {
  if (!i) return;
  free(i->memory), free(i->file), free(i->codes), free(i->failures), free((void *)i->names), free(i->parameters), free(i);
}

static FILE *open_file(const char *path) {
#ifdef _WIN32
  wchar_t wide[4096];
  return MultiByteToWideChar(UTF_8, 0, path, -1, wide, 4096) ? _wfopen(wide, L"rb") : NULL;
#else
  return fopen(path, "rb");
#endif
}

/* The whole file, with a zero behind it, or NULL. */
static char *read_file(const char *path, size_t *size) {
  FILE *file = open_file(path);
  char *content = NULL;
  if (!file) return NULL;
  long length = fseek(file, 0, SEEK_END) ? -1 : ftell(file);
  if (length >= 8 * HEAD && (content = calloc(1, (size_t)length + 8))) {
    rewind(file);
    *size = fread(content, 1, (size_t)length, file);
    if (*size != (size_t)length) free(content), content = NULL;
  }
  fclose(file);
  return content;
}

static void *find_code(const char *name) {
  const nivel_table *table = nivel_tables;
  while (table->entries && !table->fits()) ++table;
  for (const nivel_entry *entry = table->entries; entry && entry->name; ++entry)
    if (!strcmp(name, entry->name)) return entry->code;
  return NULL;
}

/* What the file says, in the order in which nivel writes it. Returns NULL, or what is wrong. */
static const char *read_model(Instance *i, size_t size) {
  const uint64_t *head = (const uint64_t *)i->file;
  uint64_t sum = 14695981039346656037u; /* Fowler-Noll-Vo */
  if (head[0] != MAGIC) return "it was written by another version of nivel";
  for (size_t k = 2; k < size / 8; ++k) sum = (sum ^ head[k]) * 1099511628211u;
  if (sum != head[1]) return "it is damaged";
  size_t codes = head[2], names = head[3];
  i->parameter_count = head[4], i->number_count = head[5], i->energy = head[6], i->term_count = head[7];
  memcpy(&i->model, head + HEAD, 8 * NUMBERS);
  nivel_model *m = &i->model;
  const char *at = i->file + 8 * (HEAD + NUMBERS);
#define ARRAY(TYPE, N) ((const TYPE *)((at += sizeof(TYPE) * (N)) - sizeof(TYPE) * (N)))
  m->words = ARRAY(uint64_t, m->count);
  m->inputs = ARRAY(nivel_input, m->input_count);
  i->defaults = ARRAY(Parameter, i->parameter_count);
  i->numbers = ARRAY(Number, i->number_count);
  i->terms = ARRAY(Term, i->term_count);
  m->inner = ARRAY(nivel_place, m->inner_count);
  m->outer = ARRAY(nivel_place, m->outer_count);
  const uint32_t *failures = ARRAY(uint32_t, 3 * m->failure_count);
  m->places = ARRAY(uint32_t, m->count);
  m->outputs = ARRAY(uint32_t, m->output_count);
  i->codes = calloc(codes, sizeof *i->codes);
  i->failures = calloc(m->failure_count, sizeof *i->failures);
  i->names = calloc(names + 1, sizeof *i->names);
  i->parameters = calloc(i->parameter_count + 1, sizeof *i->parameters);
  if (!i->codes || !i->failures || !i->names || !i->parameters) return "there is too little memory";
#define TEXT(PLACE) ((PLACE) = at, at += strlen(at) + 1)
  TEXT(i->token);
  const char *code;
  for (size_t k = 0; k < codes; ++k)
    if (TEXT(code), !(i->codes[k] = find_code(code))) return "this FMU has no machine code for this processor";
  for (size_t k = 0; k < m->failure_count; ++k) {
    nivel_failure *f = i->failures + k;
    f->status = (int32_t)failures[3 * k], f->first = failures[3 * k + 1], f->count = failures[3 * k + 2];
    TEXT(f->sentence);
  }
  for (size_t k = 0; k < names; ++k) TEXT(i->names[k]);
  m->codes = i->codes, m->failures = i->failures, m->names = i->names;
  return NULL;
}

static void load_defaults(Instance *i) {
  for (size_t k = 0; k < i->parameter_count; ++k) i->parameters[k] = i->defaults[k].value;
  i->now = (Kept){.parameters = (int64_t)i->parameter_count};
  nivel_load(&i->model, i->block);
}

static Instance *instantiate(const char *name, const char *token, const char *folder, void *environment, logger3 *log3, const Callbacks2 *log2) {
  Instance *i = calloc(1, sizeof *i);
  if (!i) return NULL;
  i->environment = environment, i->log3 = log3, i->log2 = log2;
  snprintf(i->name, sizeof i->name, "%s", name ? name : "");
  char path[4096];
  size_t n = folder ? strlen(folder) : 0, size = 0;
  const char *problem = "it cannot be read", *between = n && (folder[n - 1] == '/' || folder[n - 1] == '\\') ? "" : "/";
  if (snprintf(path, sizeof path, "%s%smachine.bin", folder ? folder : "", between) < (int)sizeof path) i->file = read_file(path, &size);
  if (i->file) problem = read_model(i, size);
  if (!problem && token && strcmp(token, i->token)) problem = "it is of another FMU than modelDescription.xml";
  if (!problem && !(i->memory = malloc(i->model.size + 64))) problem = "there is too little memory";
  if (problem) return say(i, ERROR, "%s: %s", path, problem), release(i), NULL;
  i->block = (void *)(((uintptr_t)i->memory + 63) / 64 * 64);
  load_defaults(i);
  return i;
}

static double polynomial(const double c[4], double t) { return c[0] + t * (c[1] + t * (c[2] + t * c[3])); }

/* Puts the numbers that follow from parameters which are not at their defaults; whether there are any. */
static bool follow(const Instance *i) {
  bool any = false;
  for (size_t k = 0; k < i->term_count;) {
    uint32_t number = i->terms[k].number;
    const Number *n = i->numbers + number;
    double z = n->constant;
    bool other = false;
    for (; k < i->term_count && i->terms[k].number == number; ++k) {
      const Term *term = i->terms + k;
      const Parameter *p = i->defaults + term->parameter;
      double x = i->parameters[term->parameter], t = (x - p->centre) / p->width;
      z += polynomial(term->factors, t) / polynomial(term->divisors, t);
      other |= x != p->value;
    }
    if (other) ((double *)i->block)[n->word] = n->power == 1.0 ? z : n->sign * pow(fabs(z), n->power), any = true;
  }
  return any;
}

/* Puts the machine at the start that follows from its parameters and inputs. */
static int begin(Instance *i) {
  nivel_model *m = &i->model;
  if (i->now.fresh) return OK;
  size_t own = 8 * (1 + m->input_count);
  char *kept = malloc(own + 16 * m->input_count);
  if (!kept) return say(i, ERROR, "there is too little memory");
  memcpy(kept, nivel_changed(m, i->block), own);
  for (size_t k = 0; k < m->input_count; ++k) {
    memcpy(kept + own + 16 * k, (char *)i->block + m->inputs[k].kind, 4);
    memcpy(kept + own + 16 * k + 8, (char *)i->block + m->inputs[k].value, 8);
  }
  bool other = false;
  for (int turn = 0; turn < 2; ++turn) { /* energies are referred to those at the start, where parameters have changed that */
    double energy[3] = {0.0, 0.0, 0.0};
    if (turn) memcpy(energy, (char *)i->block + i->energy, sizeof energy), energy[2] = energy[0] + energy[1];
    nivel_load(m, i->block);
    for (size_t k = 0; k < m->input_count; ++k)
      if (((int64_t *)kept)[1 + k]) {
        memcpy((char *)i->block + m->inputs[k].kind, kept + own + 16 * k, 4);
        memcpy((char *)i->block + m->inputs[k].value, kept + own + 16 * k + 8, 8);
      }
    memcpy(nivel_changed(m, i->block), kept, own);
    *nivel_changed(m, i->block) = 0;
    other = follow(i);
    if (other) memcpy((char *)i->block + i->energy, energy, sizeof energy);
    i->now.failure = nivel_go(m, i->block, 0);
    if (!other || i->now.failure) break;
  }
  free(kept);
  i->now.fresh = 1;
  if (!i->now.failure || i->now.failure == NIVEL_ENDED) return OK;
  char text[256];
  nivel_say(m, i->block, (int)i->now.failure, text, sizeof text);
  return say(i, ERROR, "%s: %s", i->name, text);
}

/* A step of another length than usual, to a time. */
static int go_to(Instance *i, double end) {
  const nivel_model *m = &i->model;
  int64_t *count = nivel_count(m, i->block, 0);
  double *clock = nivel_clock(m, i->block, 0);
  count[NIVEL_ALL] = count[NIVEL_DONE] + 1, clock[NIVEL_END] = end, count[NIVEL_RESTART] = 1, count[NIVEL_LAST_FRAME] = -1;
  int status = nivel_go(m, i->block, 1);
  count[NIVEL_ALL] = NIVEL_ENDLESS, clock[NIVEL_END] = 1e300, count[NIVEL_RESTART] = 1, count[NIVEL_LAST_FRAME] = -1;
  return status;
}

/* Goes on by a length [s]: by whole steps of a grid that begins at the start, and where it begins or ends between two of its times, by a
   shorter step there. So samples are always taken at their times. */
static int advance(Instance *i, double length) {
  const nivel_model *m = &i->model;
  int64_t *count = nivel_count(m, i->block, 0);
  double *clock = nivel_clock(m, i->block, 0), h = clock[TICKS] / clock[TICK_RATE];
  double t = clock[NIVEL_TIME], end = t + length, exact = end / h, near = floor(exact + 0.5);
  if (length < 1e-9 * h) return 0;
  bool whole = fabs(exact - near) < 1e-6, between = fabs(t - (double)count[NIVEL_DONE] * h) > 1e-6 * h;
  int64_t target = (int64_t)(whole ? near : floor(exact));
  int status = 0;
  if (between && target > count[NIVEL_DONE]) status = go_to(i, (double)(count[NIVEL_DONE] + 1) * clock[TICKS] / clock[TICK_RATE]);
  if (!status && target > count[NIVEL_DONE]) status = nivel_go(m, i->block, target - count[NIVEL_DONE]);
  if (!status && !whole) {
    status = go_to(i, end);
    if (!status) count[NIVEL_DONE] -= 1;
  }
  return status;
}

static double time_of(const Instance *i) { return i->now.start + *nivel_clock(&i->model, i->block, NIVEL_TIME); }

/* OK, DISCARD where an event has ended the motion, or ERROR. */
static int do_step(Instance *i, double now, double length) {
  double h = *nivel_clock(&i->model, i->block, NIVEL_STEP), at = time_of(i);
  if (i->now.mode != STEPPING) return say(i, ERROR, "%s: a step before the end of the initialisation", i->name);
  if (!(length >= 0.0 && length < 1e300)) return say(i, ERROR, "%s: a step of %g s", i->name, length);
  if (fabs(now - at) > 1e-3 * h + 1e-9 * fabs(now)) return say(i, ERROR, "%s: a step from %.9g s on, but it is at %.9g s", i->name, now, at);
  if (!i->now.failure) i->now.failure = advance(i, length);
  if (!i->now.failure) return OK;
  if (i->now.failure == NIVEL_ENDED) return DISCARD;
  char text[256];
  nivel_say(&i->model, i->block, (int)i->now.failure, text, sizeof text);
  return say(i, ERROR, "%s: %s", i->name, text);
}

static int set_one(Instance *i, uint32_t reference, double value) {
  nivel_model *m = &i->model;
  if (reference >= PARAMETER && reference - PARAMETER < i->parameter_count) {
    const Parameter *p = i->defaults + (reference - PARAMETER);
    if (i->now.mode > INITIALISING) return say(i, ERROR, "%s: parameters are set before the end of the initialisation", i->name);
    if (!(value >= p->least && value < 1e300)) return say(i, ERROR, "%s: a parameter of %g, which is below %g or no number", i->name, value, p->least);
    i->parameters[reference - PARAMETER] = value, i->now.fresh = 0;
    return OK;
  }
  if (reference < INPUT || reference - INPUT >= m->input_count) return say(i, ERROR, "%s: the variable %u cannot be set", i->name, reference);
  const nivel_input *input = m->inputs + (reference - INPUT);
  if (nivel_set_input(m, i->block, reference - INPUT, value))
    return say(i, ERROR, "%s: an input of %g, which is not within %g and %g", i->name, value, input->low, input->high);
  if (i->now.mode <= INITIALISING) i->now.fresh = 0;
  return OK;
}

static int get_one(Instance *i, uint32_t reference, double *value) {
  nivel_model *m = &i->model;
  if (reference >= PARAMETER && reference - PARAMETER < i->parameter_count) return *value = i->parameters[reference - PARAMETER], OK;
  if (reference == 0) return *value = time_of(i), OK;
  if (begin(i)) return ERROR;
  if (reference >= INPUT && reference - INPUT < m->input_count) { /* that which was set, or what it follows */
    const uint32_t input = reference - INPUT;
    if (nivel_is_set(m, i->block, input)) return memcpy(value, (char *)i->block + m->inputs[input].value, 8), OK;
    return *value = nivel_outputs(m, i->block)[m->output_count - m->input_count + input], OK;
  }
  for (size_t low = 0, high = m->output_count - m->input_count; low < high;) { /* references ascend */
    size_t middle = (low + high) / 2;
    if (m->outputs[middle] == reference) return *value = nivel_outputs(m, i->block)[middle], OK;
    if (m->outputs[middle] < reference) low = middle + 1; else high = middle;
  }
  return say(i, ERROR, "%s: there is no variable %u", i->name, reference);
}

static int get(Instance *i, const uint32_t *references, size_t count, double *values) {
  for (size_t k = 0; k < count; ++k)
    if (get_one(i, references[k], values + k)) return ERROR;
  return OK;
}

static int set(Instance *i, const uint32_t *references, size_t count, const double *values) {
  for (size_t k = 0; k < count; ++k)
    if (set_one(i, references[k], values[k])) return ERROR;
  return OK;
}

/* A saved state: token, numbers of the instance, parameters, the block without addresses. */
static size_t state_size(const Instance *i) { return strlen(i->token) + sizeof(Kept) + 8 * i->parameter_count + i->model.size; }

static int get_state(Instance *i, void **state) {
  if (!*state && !(*state = malloc(state_size(i)))) return say(i, ERROR, "there is too little memory");
  char *to = *state;
  size_t n = strlen(i->token);
  memcpy(to, i->token, n), to += n;
  memcpy(to, &i->now, sizeof(Kept)), to += sizeof(Kept);
  memcpy(to, i->parameters, 8 * i->parameter_count), to += 8 * i->parameter_count;
  memcpy(to, i->block, i->model.size);
  for (size_t k = 0; k < i->model.inner_count; ++k) memset(to + 8 * (size_t)i->model.inner[k].word, 0, 8);
  for (size_t k = 0; k < i->model.outer_count; ++k) memset(to + 8 * (size_t)i->model.outer[k].word, 0, 8);
  return OK;
}

static int set_state(Instance *i, const void *state) {
  const char *from = state;
  size_t n = strlen(i->token);
  if (!from || memcmp(from, i->token, n)) return say(i, ERROR, "%s: the state is of another machine", i->name);
  from += n;
  memcpy(&i->now, from, sizeof(Kept)), from += sizeof(Kept);
  memcpy(i->parameters, from, 8 * i->parameter_count), from += 8 * i->parameter_count;
  memcpy(i->block, from, i->model.size);
  nivel_relocate(&i->model, i->block);
  return OK;
}

static int serialise(Instance *i, const void *state, void *bytes, size_t size) {
  if (!state || size < state_size(i)) return say(i, ERROR, "%s: %lu bytes for a state of %lu", i->name, (unsigned long)size, (unsigned long)state_size(i));
  memcpy(bytes, state, state_size(i));
  return OK;
}

static int deserialise(Instance *i, const void *bytes, size_t size, void **state) {
  if (size != state_size(i) || memcmp(bytes, i->token, strlen(i->token))) return say(i, ERROR, "%s: the state is of another machine", i->name);
  if (!*state && !(*state = malloc(size))) return say(i, ERROR, "there is too little memory");
  memcpy(*state, bytes, size);
  return OK;
}

static int initialise(Instance *i, double start) {
  if (i->now.mode != INSTANTIATED) return say(i, ERROR, "%s: it is initialised already", i->name);
  i->now.start = start, i->now.mode = INITIALISING;
  return OK;
}

static int initialised(Instance *i) {
  if (i->now.mode != INITIALISING) return say(i, ERROR, "%s: it is not in initialisation", i->name);
  i->now.mode = STEPPING;
  return begin(i);
}

static int reset(Instance *i) { return load_defaults(i), OK; }
static int terminate(Instance *i) { return i->now.mode = TERMINATED, OK; }

/* what is no part of co-simulation, or of what this FMU offers */
#define MISSING(NAME) EXPORT int NAME(void) { return ERROR; }
/* variables of other types, of which there are none */
#define NO_VARIABLES(NAME) EXPORT int NAME(void *i, const void *references, size_t count) { (void)i, (void)references; return count ? ERROR : OK; }

/* FMI 3.0 */
EXPORT const char *fmi3GetVersion(void) { return "3.0"; }
EXPORT int fmi3SetDebugLogging(void *i, bool on, size_t n, const char *const *categories) { (void)i, (void)on, (void)n, (void)categories; return OK; }
EXPORT void *fmi3InstantiateModelExchange(void) { return NULL; }
EXPORT void *fmi3InstantiateScheduledExecution(void) { return NULL; }
EXPORT void *fmi3InstantiateCoSimulation(const char *name, const char *token, const char *folder, bool visible, bool logging, bool events, bool early,
    const uint32_t *required, size_t count, void *environment, logger3 *log, void *update) {
  (void)visible, (void)logging, (void)events, (void)required, (void)count, (void)update;
  Instance *i = instantiate(name, token, folder, environment, log, NULL);
  if (i) i->early = early;
  return i;
}
EXPORT void fmi3FreeInstance(void *i) { release(i); }
EXPORT int fmi3EnterInitializationMode(void *i, bool tolerance, double value, double start, bool stops, double stop) {
  (void)tolerance, (void)value, (void)stops, (void)stop;
  return initialise(i, start);
}
EXPORT int fmi3ExitInitializationMode(void *i) { return initialised(i); }
EXPORT int fmi3EnterStepMode(void *i) { (void)i; return OK; }
EXPORT int fmi3Terminate(void *i) { return terminate(i); }
EXPORT int fmi3Reset(void *i) { return reset(i); }
EXPORT int fmi3GetFloat64(void *i, const uint32_t *references, size_t count, double *values, size_t n) { (void)n; return get(i, references, count, values); }
EXPORT int fmi3SetFloat64(void *i, const uint32_t *references, size_t count, const double *values, size_t n) { (void)n; return set(i, references, count, values); }
EXPORT int fmi3GetFMUState(void *i, void **state) { return get_state(i, state); }
EXPORT int fmi3SetFMUState(void *i, void *state) { return set_state(i, state); }
EXPORT int fmi3FreeFMUState(void *i, void **state) { (void)i; free(*state), *state = NULL; return OK; }
EXPORT int fmi3SerializedFMUStateSize(void *i, void *state, size_t *size) { (void)state; return *size = state_size(i), OK; }
EXPORT int fmi3SerializeFMUState(void *i, void *state, void *bytes, size_t size) { return serialise(i, state, bytes, size); }
EXPORT int fmi3DeserializeFMUState(void *i, const void *bytes, size_t size, void **state) { return deserialise(i, bytes, size, state); }
EXPORT int fmi3DoStep(void *i, double now, double length, bool never_back, bool *event, bool *ends, bool *early, double *last) {
  (void)never_back;
  int status = do_step(i, now, length);
  double t = time_of(i);
  *event = false, *ends = status == DISCARD;
  *early = *ends && ((Instance *)i)->early && t < now + length;
  *last = status == OK ? now + length : t;
  return status == DISCARD ? OK : status;
}
NO_VARIABLES(fmi3GetFloat32) NO_VARIABLES(fmi3GetInt8) NO_VARIABLES(fmi3GetUInt8) NO_VARIABLES(fmi3GetInt16) NO_VARIABLES(fmi3GetUInt16)
NO_VARIABLES(fmi3GetInt32) NO_VARIABLES(fmi3GetUInt32) NO_VARIABLES(fmi3GetInt64) NO_VARIABLES(fmi3GetUInt64) NO_VARIABLES(fmi3GetBoolean)
NO_VARIABLES(fmi3GetString) NO_VARIABLES(fmi3GetBinary) NO_VARIABLES(fmi3GetClock) NO_VARIABLES(fmi3SetFloat32) NO_VARIABLES(fmi3SetInt8)
NO_VARIABLES(fmi3SetUInt8) NO_VARIABLES(fmi3SetInt16) NO_VARIABLES(fmi3SetUInt16) NO_VARIABLES(fmi3SetInt32) NO_VARIABLES(fmi3SetUInt32)
NO_VARIABLES(fmi3SetInt64) NO_VARIABLES(fmi3SetUInt64) NO_VARIABLES(fmi3SetBoolean) NO_VARIABLES(fmi3SetString) NO_VARIABLES(fmi3SetBinary)
NO_VARIABLES(fmi3SetClock) MISSING(fmi3EnterEventMode) MISSING(fmi3GetNumberOfVariableDependencies) MISSING(fmi3GetVariableDependencies)
MISSING(fmi3GetDirectionalDerivative) MISSING(fmi3GetAdjointDerivative) MISSING(fmi3EnterConfigurationMode) MISSING(fmi3ExitConfigurationMode)
MISSING(fmi3GetIntervalDecimal) MISSING(fmi3GetIntervalFraction) MISSING(fmi3GetShiftDecimal) MISSING(fmi3GetShiftFraction)
MISSING(fmi3SetIntervalDecimal) MISSING(fmi3SetIntervalFraction) MISSING(fmi3SetShiftDecimal) MISSING(fmi3SetShiftFraction)
MISSING(fmi3EvaluateDiscreteStates) MISSING(fmi3UpdateDiscreteStates) MISSING(fmi3EnterContinuousTimeMode) MISSING(fmi3CompletedIntegratorStep)
MISSING(fmi3SetTime) MISSING(fmi3SetContinuousStates) MISSING(fmi3GetContinuousStateDerivatives) MISSING(fmi3GetEventIndicators)
MISSING(fmi3GetContinuousStates) MISSING(fmi3GetNominalsOfContinuousStates) MISSING(fmi3GetNumberOfEventIndicators)
MISSING(fmi3GetNumberOfContinuousStates) MISSING(fmi3GetOutputDerivatives) MISSING(fmi3ActivateModelPartition)

/* FMI 2.0 */
EXPORT const char *fmi2GetTypesPlatform(void) { return "default"; }
EXPORT const char *fmi2GetVersion(void) { return "2.0"; }
EXPORT int fmi2SetDebugLogging(void *i, int on, size_t n, const char *const *categories) { (void)i, (void)on, (void)n, (void)categories; return OK; }

static int digit(int c) { return c >= '0' && c <= '9' ? c - '0' : (c | 32) >= 'a' && (c | 32) <= 'f' ? (c | 32) - 'a' + 10 : -1; }

EXPORT void *fmi2Instantiate(const char *name, int type, const char *token, const char *address, const Callbacks2 *callbacks, int visible, int logging) {
  char path[4096] = "";
  size_t n = 0;
  (void)visible, (void)logging;
  if (type != 1) return NULL;
  if (address && !strncmp(address, "file:", 5)) { /* file:/a, file:///a, file://host/a */
    address += 5;
    if (!strncmp(address, "//", 2)) address += 2 + strcspn(address + 2, "/");
#ifdef _WIN32
    if (*address == '/') ++address; /* file:///C:/a */
#endif
  }
  for (const char *c = address; c && *c && n + 1 < sizeof path; ++c) { /* %20 and others */
    bool coded = *c == '%' && digit(c[1]) >= 0 && digit(c[2]) >= 0;
    path[n++] = coded ? (char)(16 * digit(c[1]) + digit(c[2])) : *c;
    c += coded ? 2 : 0;
  }
  path[n] = 0;
  return instantiate(name, token, path, NULL, NULL, callbacks);
}
EXPORT void fmi2FreeInstance(void *i) { release(i); }
EXPORT int fmi2SetupExperiment(void *i, int tolerance, double value, double start, int stops, double stop) {
  (void)tolerance, (void)value, (void)stops, (void)stop;
  return ((Instance *)i)->now.start = start, OK;
}
EXPORT int fmi2EnterInitializationMode(void *i) { return initialise(i, ((Instance *)i)->now.start); }
EXPORT int fmi2ExitInitializationMode(void *i) { return initialised(i); }
EXPORT int fmi2Terminate(void *i) { return terminate(i); }
EXPORT int fmi2Reset(void *i) { return reset(i); }
EXPORT int fmi2GetReal(void *i, const uint32_t *references, size_t count, double *values) { return get(i, references, count, values); }
EXPORT int fmi2SetReal(void *i, const uint32_t *references, size_t count, const double *values) { return set(i, references, count, values); }
EXPORT int fmi2GetFMUstate(void *i, void **state) { return get_state(i, state); }
EXPORT int fmi2SetFMUstate(void *i, void *state) { return set_state(i, state); }
EXPORT int fmi2FreeFMUstate(void *i, void **state) { (void)i; free(*state), *state = NULL; return OK; }
EXPORT int fmi2SerializedFMUstateSize(void *i, void *state, size_t *size) { (void)state; return *size = state_size(i), OK; }
EXPORT int fmi2SerializeFMUstate(void *i, void *state, void *bytes, size_t size) { return serialise(i, state, bytes, size); }
EXPORT int fmi2DeSerializeFMUstate(void *i, const void *bytes, size_t size, void **state) { return deserialise(i, bytes, size, state); }
EXPORT int fmi2DoStep(void *i, double now, double length, int never_back) { (void)never_back; return do_step(i, now, length); }
EXPORT int fmi2GetRealStatus(void *i, int kind, double *value) { return kind == 2 ? (*value = time_of(i), OK) : DISCARD; }
EXPORT int fmi2GetBooleanStatus(void *i, int kind, int *value) {
  return kind == 3 ? (*value = ((Instance *)i)->now.failure == NIVEL_ENDED, OK) : DISCARD;
}
NO_VARIABLES(fmi2GetInteger) NO_VARIABLES(fmi2GetBoolean) NO_VARIABLES(fmi2GetString) NO_VARIABLES(fmi2SetInteger) NO_VARIABLES(fmi2SetBoolean)
NO_VARIABLES(fmi2SetString) MISSING(fmi2GetDirectionalDerivative) MISSING(fmi2SetRealInputDerivatives) MISSING(fmi2GetRealOutputDerivatives)
MISSING(fmi2CancelStep) MISSING(fmi2GetStatus) MISSING(fmi2GetIntegerStatus) MISSING(fmi2GetStringStatus)

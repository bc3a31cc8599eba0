#include "$name.h"
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

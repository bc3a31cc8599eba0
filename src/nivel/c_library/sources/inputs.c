
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

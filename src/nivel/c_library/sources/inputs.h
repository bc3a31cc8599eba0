/* places of the inputs */
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

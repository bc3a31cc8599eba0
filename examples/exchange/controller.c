/* Controller of cart-c.yaml: proportional, integral and derivative, called every millisecond. Zero is success. */
int controller(double time, const double *inputs, double *state, double *outputs)
{
    double error = inputs[2] - inputs[0];
    state[0] += 1e-3 * error;
    outputs[0] = 60.0 * error + 80.0 * state[0] - 20.0 * inputs[1];
    outputs[1] = error;
    return 0;
}

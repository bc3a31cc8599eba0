/* A controller with an integral in its state, which counts its calls in memory of the library; it can fail in six ways. */
#include <fenv.h>
#include <math.h>
#include <stdlib.h>

static double calls = 0.0;

int controller(double time, const double *in, double *state, double *out)
{
    calls += 1.0;
    out[0] = -40.0 * in[0] - 8.0 * in[1];
    out[1] = state[0];
    out[2] = calls;
    state[0] += 2e-3 * in[0];
    if (time > 0.4999 && in[2] == 1.0) return -7;
    if (time > 0.4999 && in[2] == 2.0) out[1] = NAN;
    if (time > 0.4999 && in[2] == 3.0) abort();
    if (time > 0.4999 && in[2] == 4.0) for (;;) { calls += 1.0; }
    if (time > 0.4999 && in[2] == 5.0) exit(0);
    if (in[2] == 6.0) fesetround(FE_UPWARD);
    return 0;
}

// An open chain of bars in Pinocchio: classical Runge-Kutta steps, four calls of its articulated-body algorithm (aba) each.
//
//     pinocchio_chain LINKS STEPS RUNS CHECK_STEPS STEP LENGTH MASS IXX IYY IZZ GRAVITY
//
// Prints one JSON line: microseconds of process time a step, RUNS times for both conventions of aba; and of CHECK_STEPS steps the
// largest energy error over the largest kinetic energy and the centre of mass of the last bar.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include <pinocchio/multibody.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/energy.hpp>
#include <pinocchio/algorithm/kinematics.hpp>

using Eigen::Vector3d;
using Eigen::VectorXd;
namespace pin = pinocchio;

static double now() {
    timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return t.tv_sec + 1e-9 * t.tv_nsec;
}

struct Chain {
    pin::Model model;
    pin::Data data;
    VectorXd q, v, tau, trial_q, trial_v;
    VectorXd rate_q[4], rate_v[4];
    pin::Convention convention;

    Chain(const pin::Model& built, pin::Convention chosen) : model(built), data(built), convention(chosen) {
        q = v = tau = trial_q = trial_v = VectorXd::Zero(model.nv);
        for (int stage = 0; stage < 4; stage++) rate_q[stage] = rate_v[stage] = VectorXd::Zero(model.nv);
    }

    void evaluate(int stage, const VectorXd& at_q, const VectorXd& at_v) {
        rate_q[stage] = at_v;
        rate_v[stage] = pin::aba(model, data, at_q, at_v, tau, convention);
    }

    void step(double h) {
        static const double node[4] = {0.0, 0.5, 0.5, 1.0};
        evaluate(0, q, v);
        for (int stage = 1; stage < 4; stage++) {
            trial_q.noalias() = q + node[stage] * h * rate_q[stage - 1];
            trial_v.noalias() = v + node[stage] * h * rate_v[stage - 1];
            evaluate(stage, trial_q, trial_v);
        }
        q += h / 6 * (rate_q[0] + 2 * rate_q[1] + 2 * rate_q[2] + rate_q[3]);
        v += h / 6 * (rate_v[0] + 2 * rate_v[1] + 2 * rate_v[2] + rate_v[3]);
    }
};

static double time_of_step(const pin::Model& model, pin::Convention convention, long steps, double h) {
    Chain chain(model, convention);
    chain.step(h);
    const double begin = now();
    for (long n = 0; n < steps; n++) chain.step(h);
    return 1e6 * (now() - begin) / steps;
}

int main(int count, char** argument) {
    if (count != 12) return 1;
    const long links = std::atol(argument[1]), steps = std::atol(argument[2]), runs = std::atol(argument[3]);
    const long check_steps = std::atol(argument[4]);
    const double h = std::atof(argument[5]), length = std::atof(argument[6]), mass = std::atof(argument[7]);
    const Vector3d principal(std::atof(argument[8]), std::atof(argument[9]), std::atof(argument[10]));

    pin::Model model;
    model.gravity.linear(Vector3d(0, -std::atof(argument[11]), 0));
    const pin::Inertia inertia(mass, Vector3d(length / 2, 0, 0), principal.asDiagonal());
    pin::JointIndex parent = 0;
    for (long i = 0; i < links; i++) {
        const pin::SE3 place(Eigen::Matrix3d::Identity(), Vector3d(i == 0 ? 0 : length, 0, 0));
        parent = model.addJoint(parent, pin::JointModelRZ(), place, "hinge" + std::to_string(i));
        model.appendBodyToJoint(parent, inertia);
    }

    std::printf("{");
    for (const auto convention : {pin::Convention::WORLD, pin::Convention::LOCAL}) {
        std::printf("\"%s\": [", convention == pin::Convention::WORLD ? "world" : "local");
        for (long i = 0; i < runs; i++)
            std::printf("%s%.6g", i ? ", " : "", time_of_step(model, convention, steps, h));
        std::printf("], ");
    }

    Chain chain(model, pin::Convention::WORLD);
    double error = 0, kinetic = 0, start = 0;
    for (long n = 0; n <= check_steps; n++) {
        if (n > 0) chain.step(h);
        const double T = pin::computeKineticEnergy(model, chain.data, chain.q, chain.v);
        const double V = pin::computePotentialEnergy(model, chain.data, chain.q);
        if (n == 0) start = T + V;
        error = std::max(error, std::abs(T + V - start));
        kinetic = std::max(kinetic, T);
    }
    pin::forwardKinematics(model, chain.data, chain.q);
    const Vector3d centre = chain.data.oMi[links].act(Vector3d(length / 2, 0, 0));
    std::printf("\"energy_error\": %.6g, ", error / kinetic);
    std::printf("\"last_position\": [%.15g, %.15g, %.15g]}\n", centre[0], centre[1], centre[2]);
}

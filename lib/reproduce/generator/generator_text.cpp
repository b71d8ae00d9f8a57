// SPDX-License-Identifier: MIT
#include "lib/reproduce/generator/generator_text.hpp"

#include <fmt/format.h>

namespace faultline {
namespace {

/// 3.4e-3 rather than 3.4e-03.
std::string scientific(double value) {
  std::string text = fmt::format("{:.1e}", value);
  if (const auto zero = text.find("e-0"); zero != std::string::npos) text.erase(zero + 2, 1);
  return text;
}

double mean_mse(const GeneratorMeasurements& measured, const char* name, ControllerReading controller,
                GeneratorTest test) {
  const auto mse = measured.mse(measured.find(name), static_cast<int>(controller), test);
  return mse.value_or(Measured{}).mean();
}

constexpr const char* kProtocol =
    R"(The state (q, dq) one sample (73 ms) later, predicted from q, dq and tau of healthy motion: mean
squared error over the six outputs in squares of half ranges, on {} trajectories of 25 samples that were not
trained on, clean and with noise of 0.01 and 0.1 of half range on q and dq at both ends; then on as many
samples of runs, moves and rests one after the other. Networks train for {} iterations of Levenberg-Marquardt
({} with noise 0.1, where more only fits the noise) or {} epochs of back-propagation; the large training set
was used in the first experiment only. "Identified" is from healthy logs alone, as in the table with
friction.)";

constexpr const char* kLessons =
    R"(With the same network and patterns Levenberg-Marquardt leaves a small part of the error of
back-propagation. The torque at the later sample helps where the torque is not held. True physics is exact
when it is held; else the torque between samples is taken for a straight line, which is as good as the log
allows under fast, and poor under pd, whose torque decays within a sample.

The paper's trajectories start at rest and make one move. For held and fast this is about as hard as runs. For
pd it is much easier: the set-point jumps exactly at the first sample, and the network learns what follows. In
runs it jumps between two samples, where the inputs do not show it. The worst {:.1f} % of the samples of these
runs, as many as hold a jump, have {:.1f} % of the error of the 9-49-6 network, and {} is left on the others;
training on runs does not help. Networks that see the next torque and were trained on single moves are misled
by the jump.)";

/// Noise passes through exact physics: mse = sigma^2 (1 + gain). That is the floor for a predictor that knows
/// one sample and nothing of where robots usually are.
constexpr const char* kNoise =
    R"(Noise levels the generators: that of the measured end adds sigma^2, which nobody can predict, and that
of the start passes through the robot. Held, true physics has sigma^2 (1 + {:.2f}) = {} at 0.01 and a hundred
times that at 0.1. To train with noise of 0.01 costs more than it gains. With 0.1 the network learns to lean
towards usual states: {} instead of {}, below true physics, but on clean data it is then no better than
predicting no change. What else can be gained under noise lies in filtering over many samples, not in the
generator.)";

constexpr const char* kFriction =
    R"(The same on a robot with viscous and Coulomb friction in every joint. "Identified" is from logs alone:
{} healthy runs of {:g} s without noise, logged every 73 ms, and a robot file that says RRP and the length of
link 1. Masses, inertias, friction and, where the torque is not held, its timing between samples (one share
for all joints) come from multiple shooting on the {} rows that move most. Only the width over which Coulomb
friction changes sign stays at the default, which the simulator has too. The rows with 1 kHz take one run of
{:g} s logged every millisecond. A hybrid adds a network of 20 units, trained on the same patterns as the MLP;
where the torque is not held it sees the torque at both ends.

A model that is 5 % off and has no friction is worse than predicting no change; with a network on top it
leaves {} under fast, the larger MLP alone {}. Identified physics leaves {} there, no more than true
parameters do: the rest is the torque between samples, which is why a log at 1 kHz does not lower it. The
network takes part of that and leaves {}. Under pd one timing for all joints does not describe the torque
between samples; identified from 73 ms, masses are bent to fit, and the network mends that for the motion it
was trained on but not in runs, where set-points jump between samples.)";

}  // namespace

std::string generator_mse_text(const GeneratorMeasurements& measured, const GeneratorScale& scale) {
  constexpr ControllerReading held = ControllerReading::held;
  const double physics = mean_mse(measured, kPhysicsTrue, held, GeneratorTest::noise_01);
  const double gain = physics / (kNoiseReadings[1] * kNoiseReadings[1]) - 1.0;
  const auto noisy = [&](const char* name) {
    return fmt::format("{:.2f}e-2", 100.0 * mean_mse(measured, name, held, GeneratorTest::noise_1));
  };
  const WorstSamples worst =
      measured.worst(measured.find(kLevenbergMarquardt), static_cast<int>(ControllerReading::pd));
  return fmt::format(kProtocol, scale.test_trajectories, scale.iterations, scale.noisy_iterations,
                     scale.epochs) +
         "\n\n" +
         fmt::format(kLessons, 100.0 * share_with_a_start(), 100.0 * worst.share_of_error,
                     scientific(worst.mse_of_others)) +
         "\n\n" +
         fmt::format(kNoise, gain, scientific(physics), noisy(kTrainedWithNoise), noisy(kLevenbergMarquardt));
}

std::string generator_by_output_text() {
  return R"(The paper's network and patterns, both trainers, each output in squares of its half range. Clean,
nearly all error is in the velocities, most of it in joint 2, which has the smallest inertia of the two
coupled joints and is thrown about by joint 1. With noise every output stands near twice sigma^2, the noise of
both ends; only an error of the network beyond that still shows.)";
}

std::string generator_friction_text(const GeneratorMeasurements& measured, const GeneratorScale& scale) {
  const auto clean = [&](const char* name) {
    return scientific(mean_mse(measured, name, ControllerReading::fast, GeneratorTest::clean));
  };
  return fmt::format(kFriction, scale.slow_logs.count, scale.slow_logs.duration_s, scale.slow_logs.max_rows,
                     scale.fast_logs.duration_s, clean(kWrongAndMlp), clean(kLevenbergMarquardt),
                     clean(kPhysicsIdentified), clean(kHybrid));
}

}  // namespace faultline

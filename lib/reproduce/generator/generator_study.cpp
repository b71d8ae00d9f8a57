// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "lib/reproduce/generator/generator_measurements.hpp"

namespace faultline {
namespace {

constexpr GeneratorTest kTests[] = {GeneratorTest::clean, GeneratorTest::noise_01, GeneratorTest::noise_1,
                                    GeneratorTest::clean_runs};

// What stands above the tables, as Markdown.

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
when it is held; else the torque between samples is treated as a straight line, which is as good as the log
allows under fast, and poor under pd, whose torque decays within a sample.

The paper's trajectories start at rest and make one move. For held and fast this is about as hard as runs. For
pd it is much easier: the set-point jumps exactly at the first sample, and the network learns what follows. In
runs it jumps between two samples, where the inputs do not show it. The worst {:.1f} % of the samples of these
runs, as many as hold a jump, have {:.1f} % of the error of the 9-49-6 network, and {} remains on the others;
training on runs does not help. Networks that see the next torque and were trained on single moves are misled
by the jump.)";

/// Noise passes through exact physics: mse = sigma^2 (1 + gain). That is the floor for a predictor that knows
/// one sample and nothing of where robots usually are.
constexpr const char* kNoise =
    R"(Noise makes the generators alike: noise of the measured end state adds sigma^2, which no generator can
predict, and noise of the start state passes through the robot. Held, true physics has sigma^2 (1 + {:.2f}) = {} at 0.01 and a hundred
times that at 0.1. To train with noise of 0.01 costs more than it gains. With 0.1 the network learns to lean
towards usual states: {} instead of {}, below true physics, but on clean data it is then no better than
predicting no change. What else can be gained under noise lies in filtering over many samples, not in the
generator.)";

constexpr const char* kFriction =
    R"(The same on a robot with viscous and Coulomb friction in every joint. "Identified" is from logs alone:
{} healthy runs of {:g} s without noise, logged every 73 ms, and a robot file that gives RRP and the length of
link 1. Masses, inertias, friction and, where the torque is not held, its timing between samples (one share
for all joints) come from multiple shooting on the {} rows that move most. Only the width over which Coulomb
friction changes sign stays at the default, which the simulator has too. The rows with 1 kHz take one run of
{:g} s logged every millisecond. A hybrid adds a network of 20 units, trained on the same patterns as the MLP;
where the torque is not held it sees the torque at both ends.

A model that is 5 % off and has no friction is worse than predicting no change; with a network on top it
leaves {} under fast, the larger MLP alone {}. Identified physics leaves {} there, no more than true
parameters do: the rest is the torque between samples, which is why a log at 1 kHz does not lower it. The
network takes part of that and leaves {}. Under pd one timing for all joints does not describe the torque
between samples; identified from 73 ms, masses are distorted by the fit, and the network corrects that for the
motion it was trained on but not in runs, where set-points jump between samples.)";

constexpr const char* kByOutput =
    R"(The paper's network and patterns, both trainers, each output in squares of its half range. Clean,
nearly all error is in the velocities, most of it in joint 2, which has the smallest inertia of the two
coupled joints and is thrown about by joint 1. With noise every output stands near twice sigma^2, the noise of
both ends; only an error of the network beyond that still shows.)";

std::string scientific(double value) { return figure_text(value, FigureStyle::scientific); }

double mean_mse(const GeneratorMeasurements& measured, const char* name, ControllerVariant controller,
                GeneratorTest test) {
  const auto mse = measured.mse(measured.find(name), static_cast<int>(controller), test);
  return mse.value_or(Measured{}).mean();
}

std::string generator_mse_text(const GeneratorMeasurements& measured, const GeneratorScale& scale) {
  constexpr ControllerVariant held = ControllerVariant::held;
  const double physics = mean_mse(measured, kPhysicsTrue, held, GeneratorTest::noise_01);
  const double gain = physics / (kNoiseVariants[1] * kNoiseVariants[1]) - 1.0;
  const auto noisy = [&](const char* name) {
    return fmt::format("{:.2f}e-2", 100.0 * mean_mse(measured, name, held, GeneratorTest::noise_1));
  };
  const WorstSamples worst =
      measured.worst(measured.find(kLevenbergMarquardt), static_cast<int>(ControllerVariant::pd));
  return fmt::format(kProtocol, scale.test_trajectories, scale.iterations, scale.noisy_iterations,
                     scale.epochs) +
         "\n\n" +
         fmt::format(kLessons, 100.0 * share_with_a_start(), 100.0 * worst.share_of_error,
                     scientific(worst.mse_of_others)) +
         "\n\n" +
         fmt::format(kNoise, gain, scientific(physics), noisy(kTrainedWithNoise), noisy(kLevenbergMarquardt));
}

std::string generator_friction_text(const GeneratorMeasurements& measured, const GeneratorScale& scale) {
  const auto clean = [&](const char* name) {
    return scientific(mean_mse(measured, name, ControllerVariant::fast, GeneratorTest::clean));
  };
  return fmt::format(kFriction, scale.slow_logs.count, scale.slow_logs.duration_s, scale.slow_logs.max_rows,
                     scale.fast_logs.duration_s, clean(kWrongAndMlp), clean(kLevenbergMarquardt),
                     clean(kPhysicsIdentified), clean(kHybrid));
}

std::optional<Measured> printed(double figure) {
  if (std::isnan(figure)) return std::nullopt;
  return Measured{{figure}};
}

ResultRow row_of(const GeneratorMeasurements& measured, int candidate, int controller) {
  const GeneratorCandidate& who = measured.candidates[candidate];
  ResultRow row{{who.name, to_string(kControllerVariants[controller]), who.patterns}, {}};
  for (const GeneratorTest test : kTests) row.figures.push_back(measured.mse(candidate, controller, test));
  row.figures.push_back(printed(who.study.clean[controller]));
  return row;
}

/// Rows of all candidates, controller by controller.
std::vector<ResultRow> rows_of(const GeneratorMeasurements& measured) {
  std::vector<ResultRow> rows;
  for (int controller = 0; controller < kControllers; ++controller)
    for (int c = 0; c < static_cast<int>(measured.candidates.size()); ++c)
      if (measured.mse(c, controller, GeneratorTest::clean)) rows.push_back(row_of(measured, c, controller));
  return rows;
}

ResultTable table_of(const GeneratorMeasurements& measured, std::string id, std::string title) {
  ResultTable table;
  table.id = std::move(id);
  table.title = std::move(title);
  table.label_columns = {"generator", "controller", "patterns"};
  table.figure_columns = {
      {"clean"}, {"sigma 0.01"}, {"sigma 0.1"}, {"clean, runs of moves"}, {"study, clean"}};
  table.rows = rows_of(measured);
  return table;
}

/// Every candidate of the robot without friction by controller and test set, the other study's figures
/// beside.
ResultTable generator_mse_table(const GeneratorMeasurements& measured, const GeneratorScale& scale) {
  ResultTable table = table_of(measured, "generator_mse", "Residual generators, robot without friction");
  table.figure_columns.push_back({"study, sigma 0.01"});
  table.figure_columns.push_back({"study, sigma 0.1"});
  const std::size_t candidates = measured.candidates.size();
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const bool is_held = i < candidates;
    const StudyFigures& study = measured.candidates[i % candidates].study;
    table.rows[i].figures.push_back(is_held ? printed(study.held_noise_01) : std::nullopt);
    table.rows[i].figures.push_back(is_held ? printed(study.held_noise_1) : std::nullopt);
  }
  table.text = generator_mse_text(measured, scale);
  return table;
}

/// The paper's network by output, by either trainer.
ResultTable generator_by_output_table(const GeneratorMeasurements& measured) {
  ResultTable table;
  table.id = "generator_by_output";
  table.title = "The paper's residual generator, output by output";
  table.text = kByOutput;
  table.label_columns = {"generator", "controller", "test"};
  for (const char* name : {"q1", "q2", "q3", "dq1", "dq2", "dq3"}) table.figure_columns.push_back({name});
  for (const char* name : {kBackPropagation, kLevenbergMarquardt})
    for (int controller = 0; controller < kControllers; ++controller)
      for (const GeneratorTest test : {GeneratorTest::clean, GeneratorTest::noise_01}) {
        ResultRow row{{name, to_string(kControllerVariants[controller]),
                       test == GeneratorTest::clean ? "clean" : "sigma 0.01"},
                      {}};
        for (int output = 0; output < 6; ++output)
          row.figures.push_back(measured.mse(measured.find(name), controller, test, output));
        table.rows.push_back(std::move(row));
      }
  return table;
}

ResultTable generator_friction_table(const GeneratorMeasurements& measured, const GeneratorScale& scale) {
  ResultTable table = table_of(measured, "generator_friction", "Residual generators, robot with friction");
  table.text = generator_friction_text(measured, scale);
  return table;
}

Goal goal(const GeneratorMeasurements& measured, const char* name, ControllerVariant controller,
          const char* what, const char* paper, const char* study, double bound) {
  const auto mse = measured.mse(measured.find(name), static_cast<int>(controller), GeneratorTest::clean);
  return {.what = what, .paper = paper, .study = study, .bound = bound, .measured = mse.value_or(Measured{})};
}

std::vector<Goal> goals_of(const GeneratorMeasurements& smooth, const GeneratorMeasurements& friction,
                           bool is_quick) {
  std::vector<Goal> all{
      goal(smooth, kLevenbergMarquardt, ControllerVariant::held,
           "generator MLP 9-49-6, 2500 patterns, clean, held, Levenberg-Marquardt", "small", "3.9e-5", 4e-5),
      goal(smooth, kBackPropagation, ControllerVariant::held,
           "generator MLP 9-49-6, 2500 patterns, clean, held, back-propagation", "small", "4.0e-4", 4e-4),
      goal(friction, kHybrid, ControllerVariant::fast,
           "generator hybrid on a robot with friction, clean, fast, identified from logs alone", "-",
           "8.1e-5", 5e-5)};
  if (is_quick)
    for (Goal& each : all) each.note = "fewer patterns and iterations than the goal is meant for";
  return all;
}

}  // namespace

StudyResult generator_study(const ReproduceOptions& options, const Progress& progress) {
  options.check();
  const GeneratorScale scale = options.quick ? quick_scale() : GeneratorScale{};
  const GeneratorMeasurements smooth = measure_generators({bench_robot(), paper_candidates(scale), scale},
                                                          options, part_of(progress, 0.0, 0.7));
  const GeneratorMeasurements friction =
      measure_generators({bench_robot_with_friction(), friction_candidates(scale), scale, true}, options,
                         part_of(progress, 0.7, 1.0));
  return {{generator_mse_table(smooth, scale), generator_by_output_table(smooth),
           generator_friction_table(friction, scale)},
          goals_of(smooth, friction, options.quick)};
}

}  // namespace faultline

// SPDX-License-Identifier: MIT
#include "lib/reproduce/generator_tables.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace faultline {
namespace {

constexpr GeneratorTest kTests[] = {GeneratorTest::clean, GeneratorTest::noise_01, GeneratorTest::noise_1,
                                    GeneratorTest::clean_runs};
constexpr int kControllers = static_cast<int>(std::size(kControllerReadings));

std::vector<FigureColumn> columns_of_tests() {
  return {{"clean"}, {"sigma 0.01"}, {"sigma 0.1"}, {"clean, runs of moves"}};
}

std::optional<Measured> printed(double figure) {
  if (std::isnan(figure)) return std::nullopt;
  return Measured{{figure}};
}

double study_clean(const StudyFigures& study, ControllerReading controller) {
  switch (controller) {
    case ControllerReading::held:
      return study.held;
    case ControllerReading::fast:
      return study.fast;
    case ControllerReading::pd:
      return study.pd;
  }
  return std::nan("");
}

ResultRow row_of(const GeneratorMeasurements& measured, int candidate, int controller) {
  const GeneratorCandidate& who = measured.candidates[candidate];
  ResultRow row{{who.name, to_string(kControllerReadings[controller]), who.patterns}, {}};
  for (const GeneratorTest test : kTests) row.figures.push_back(measured.mse(candidate, controller, test));
  row.figures.push_back(printed(study_clean(who.study, kControllerReadings[controller])));
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
  table.figure_columns = columns_of_tests();
  table.figure_columns.push_back({"study, clean"});
  table.rows = rows_of(measured);
  return table;
}

double mean_mse(const GeneratorMeasurements& measured, const char* name, ControllerReading controller,
                GeneratorTest test) {
  return measured.mse(measured.find(name), static_cast<int>(controller), test).value_or(Measured{}).mean();
}

std::string protocol_text(const GeneratorScale& scale) {
  return fmt::format(
      "The state (q, dq) one sample (73 ms) later, foretold from q, dq and tau of healthy motion: mean "
      "squared "
      "error over the six outputs in squares of half ranges, on {} trajectories of 25 samples that were not "
      "trained on, clean and with noise of 0.01 and 0.1 of half range on q and dq at both ends; then on as "
      "many samples of runs, moves and rests one after the other. Levenberg-Marquardt ran {} iterations ({} "
      "on "
      "noisy patterns), back-propagation {} epochs; the large training set was used in the first experiment "
      "only.\n\n",
      scale.test_trajectories, scale.iterations, scale.noisy_iterations, scale.epochs);
}

std::string trainer_text() {
  return "With the same network and patterns Levenberg-Marquardt leaves a small part of back-propagation's "
         "error; the torque at the later sample helps where the torque is not held. Exact physics is exact "
         "when "
         "the torque is held; else it takes the torque between samples for a straight line, as good as the "
         "log allows under fast and poor under pd, whose torque decays within a sample.\n\n"
         "The paper's trajectories start at rest and make one move. For held and fast that is no easier than "
         "runs. For pd it is: the set-point jumps exactly at the first sample, and the network learns what "
         "follows. In runs it jumps between two samples, the inputs do not show it, and no training helps: "
         "the "
         "last test column for pd is bound by those samples, as is the other study's figure.\n\n";
}

/// Noise passes through exact physics, mse = sigma^2 (1 + gain), which is the floor for a predictor that
/// knows one sample and nothing of where robots usually are.
std::string noise_text(const GeneratorMeasurements& measured) {
  const double physics = mean_mse(measured, kPhysicsTrue, ControllerReading::held, GeneratorTest::noise_01);
  return fmt::format(
      "Noise levels the generators: that of the measured end alone adds sigma^2, and that of the start "
      "passes "
      "through the robot. Held, exact physics has sigma^2 (1 + {:.2f}), {:.2e} at 0.01 and a hundred times "
      "that "
      "at 0.1, so nothing that sees one sample gets much lower. Training with the noise of use gains nothing "
      "at "
      "0.01; at 0.1 the network learns to lean towards usual states, gains some per cent and loses all "
      "precision on clean data. What is left to gain under noise lies in filtering over samples, not in the "
      "generator.",
      physics / (kNoiseReadings[1] * kNoiseReadings[1]) - 1.0, physics);
}

std::string friction_text(const GeneratorMeasurements& measured, const GeneratorScale& scale) {
  const auto clean = [&](const char* name, ControllerReading controller) {
    return mean_mse(measured, name, controller, GeneratorTest::clean);
  };
  return fmt::format(
      "The same on a robot with viscous and Coulomb friction in every joint. \"Identified\" is from logs "
      "alone: "
      "{} healthy runs of {:g} s without noise, logged every 73 ms, and a robot file that says RRP and the "
      "length of link 1; all masses, inertias, friction and, where the torque is not held, its timing "
      "between "
      "samples (one share for all joints) come from multiple shooting on the {} rows that move most. Only "
      "the "
      "width over which Coulomb friction changes sign stays at its default, which the simulator uses too. "
      "The "
      "row with 1 kHz takes one run of {:g} s logged every millisecond. Hybrids add a network of 20 units "
      "trained on the same patterns as the MLP; where the torque is not held it sees the torque at both "
      "ends.\n\n"
      "A model that is 5 % off without friction is worse than foretelling no change, and a network on top "
      "does "
      "little better than one on its own. Identified under fast, physics alone leaves {:.1e}, no more than "
      "true "
      "parameters do: what is left is the torque between samples, which is why a log at 1 kHz makes it no "
      "better; the network takes part of it and leaves {:.1e}. Under pd one timing for all joints cannot "
      "describe the torque between samples, so identification from 73 ms bends the masses to fit; the "
      "network "
      "repairs it on the motion it was trained on, not in runs where set-points jump between samples.",
      scale.slow_logs.count, scale.slow_logs.duration_s, scale.slow_logs.max_rows, scale.fast_logs.duration_s,
      clean(kPhysicsIdentified, ControllerReading::fast), clean(kHybrid, ControllerReading::fast));
}

}  // namespace

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
  table.text = protocol_text(scale) + trainer_text() + noise_text(measured);
  return table;
}

ResultTable generator_by_output_table(const GeneratorMeasurements& measured) {
  ResultTable table;
  table.id = "generator_by_output";
  table.title = "The paper's residual generator, output by output";
  table.text =
      "The paper's network and patterns, both trainers, each output in squares of its half range. Clean, "
      "nearly "
      "all error is in the velocities, most in joint 2: it carries the smallest inertia and is thrown about "
      "by "
      "joint 1. With noise every output stands near twice sigma^2, the noise of both ends, and only what the "
      "network lacks beyond that still shows.";
  table.label_columns = {"generator", "controller", "test"};
  for (const char* name : {"q1", "q2", "q3", "dq1", "dq2", "dq3"}) table.figure_columns.push_back({name});
  for (const char* name : {kBackPropagation, kLevenbergMarquardt})
    for (int controller = 0; controller < kControllers; ++controller)
      for (const GeneratorTest test : {GeneratorTest::clean, GeneratorTest::noise_01}) {
        ResultRow row{{name, to_string(kControllerReadings[controller]),
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
  table.text = friction_text(measured, scale);
  return table;
}

}  // namespace faultline

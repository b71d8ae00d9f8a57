// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "lib/reproduce/page/reproduction.hpp"
#include "lib/reproduce/protocol/motion_generator.hpp"
#include "lib/reproduce/protocol/protocol.hpp"
#include "lib/reproduce/runs/detectors.hpp"
#include "lib/residual/residuals.hpp"

namespace faultline {
namespace {

constexpr ControllerVariant kController = ControllerVariant::held;
constexpr double kShownAfter = 2.0;  // s of the fault: then the freed robot leaves all ranges
constexpr int kJoint = 1;            // from 0: joint 2, as in the paper

/// One run with all that the figures show of it, in half ranges; a column a transition.
struct ShownRun {
  std::vector<double> time;
  Eigen::MatrixXd position, velocity, predicted_position, predicted_velocity, residual;
  SampleOutputs outputs;
};

ShownRun shown_run(const SampleDetector& detector, const Experiment& experiment, double onset_s,
                   std::uint64_t seed) {
  const ActingFault fault{{FaultKind::free_swinging, Joint::at(kJoint)}, onset_s};
  const Log log = run_of_moves(experiment.robot, experiment.controller,
                               {.duration_s = onset_s + kShownAfter, .fault = fault}, seed);
  const Transitions moves = transitions_of({log});
  const Eigen::MatrixXd change = predicted_change(detector.generator, moves);
  const auto per_q = experiment.ranges.q.cwiseInverse().asDiagonal();
  const auto per_dq = experiment.ranges.dq.cwiseInverse().asDiagonal();
  ShownRun run;
  run.time.assign(moves.time.begin(), moves.time.end());
  run.position = per_q * moves.next_q;
  run.velocity = per_dq * moves.next_dq;
  run.predicted_position = per_q * (moves.q + change.topRows(experiment.robot.joints()));
  run.predicted_velocity = per_dq * (moves.dq + change.bottomRows(experiment.robot.joints()));
  run.residual = run.velocity - run.predicted_velocity;
  run.outputs = outputs_of(detector, log);
  return run;
}

std::vector<double> row(const Eigen::MatrixXd& values, int i) {
  const Eigen::VectorXd one = values.row(i);
  return {one.begin(), one.end()};
}

PlotPanel residual_panel(const ShownRun& run) {
  PlotPanel panel{.y_label = "residual, half ranges", .series = {}, .y_range = {{-1.5, 1.5}}};
  for (int j = 0; j < run.residual.rows(); ++j)
    panel.series.push_back(
        {fmt::format("velocity of joint {}", Joint::at(j)), run.time, row(run.residual, j)});
  return panel;
}

PlotPanel motion_panel(const ShownRun& run, const Eigen::MatrixXd& measured, const Eigen::MatrixXd& predicted,
                       const char* label) {
  return {.y_label = label,
          .series = {{"measured", run.time, row(measured, kJoint)},
                     {"predicted by the MLP", run.time, row(predicted, kJoint)}},
          .y_range = {{-2.5, 2.5}}};
}

PlotPanel output_panel(const ShownRun& run, const Eigen::MatrixXd& outputs, const char* network) {
  PlotPanel panel{.y_label = fmt::format("{} output", network), .series = {}, .y_range = {{-0.5, 1.5}}};
  for (int i = 0; i < outputs.rows(); ++i)
    panel.series.push_back(
        {i + 1 < outputs.rows() ? fmt::format("fault in joint {}", Joint::at(i)) : "fault-free", run.time,
         row(outputs, i)});
  return panel;
}

Figure figure(int number, const char* what, const char* network, double onset_s,
              std::vector<PlotPanel> panels) {
  const std::string title =
      fmt::format("Figure {}. {}, joint 2 swings freely from {:g} s ({})", number, what, onset_s, network);
  return {
      fmt::format("figure_{}", number),
      fmt::format("**{}.** Held controller, no noise, the paper's recipe. The freed robot soon leaves its "
                  "ranges; curves are cut at the frame.",
                  title),
      {.title = title, .x_label = "time, s", .panels = std::move(panels), .marks = {{onset_s, "fault"}}}};
}

/// Three figures of one run: residual, position, velocity.
void add_figures(std::vector<Figure>& figures, const ShownRun& run, const Eigen::MatrixXd& outputs,
                 const char* network, double onset_s) {
  const int first = 3 + static_cast<int>(figures.size());
  const PlotPanel answer = output_panel(run, outputs, network);
  figures.push_back(figure(first, "Residual", network, onset_s, {residual_panel(run), answer}));
  figures.push_back(
      figure(first + 1, "Normalised position", network, onset_s,
             {motion_panel(run, run.position, run.predicted_position, "position, half ranges"), answer}));
  figures.push_back(
      figure(first + 2, "Normalised velocity", network, onset_s,
             {motion_panel(run, run.velocity, run.predicted_velocity, "velocity, half ranges"), answer}));
}

}  // namespace

std::vector<Figure> fault_figures(const ReproduceOptions& options) {
  const Experiment experiment = experiment_on(bench_robot(), kController, options.seed);
  GeneratorRecipe recipe;
  recipe.fit.trainer = ResidualTrainer::back_propagation;
  const SampleDetector detector = train_paper_detector(train_generator(experiment, recipe), experiment);
  std::vector<Figure> figures;
  const ShownRun first = shown_run(detector, experiment, 4.0, seed_of(options.seed, SeedUse::figures, 0));
  add_figures(figures, first, first.outputs.mlp, "MLP", 4.0);
  const ShownRun second = shown_run(detector, experiment, 5.0, seed_of(options.seed, SeedUse::figures, 1));
  add_figures(figures, second, second.outputs.rbfn, "RBFN", 5.0);
  return figures;
}

}  // namespace faultline

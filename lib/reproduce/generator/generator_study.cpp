// SPDX-License-Identifier: MIT
#include "lib/reproduce/generator/generator_study.hpp"

#include "lib/reproduce/generator/generator_tables.hpp"

namespace faultline {
namespace {

Goal goal(const GeneratorMeasurements& measured, const char* name, ControllerReading controller) {
  const auto mse = measured.mse(measured.find(name), static_cast<int>(controller), GeneratorTest::clean);
  return {.what = name, .paper = "-", .study = "-", .measured = mse.value_or(Measured{})};
}

std::vector<Goal> goals_of(const GeneratorMeasurements& smooth, const GeneratorMeasurements& friction,
                           bool is_quick) {
  Goal second_order = goal(smooth, kLevenbergMarquardt, ControllerReading::held);
  second_order.what = "generator MLP 9-49-6, 2500 patterns, clean, held, Levenberg-Marquardt";
  second_order.paper = "small";
  second_order.study = "3.9e-5";
  second_order.bound = 4e-5;
  Goal gradient = goal(smooth, kBackPropagation, ControllerReading::held);
  gradient.what = "generator MLP 9-49-6, 2500 patterns, clean, held, back-propagation";
  gradient.paper = "small";
  gradient.study = "4.0e-4";
  gradient.bound = 4e-4;
  Goal hybrid = goal(friction, kHybrid, ControllerReading::fast);
  hybrid.what = "generator hybrid on a robot with friction, clean, fast, identified from logs alone";
  hybrid.study = "8.1e-5";
  hybrid.bound = 5e-5;
  std::vector<Goal> all{second_order, gradient, hybrid};
  if (is_quick)
    for (Goal& each : all) each.note = "fewer patterns and iterations than the goal is meant for";
  return all;
}

}  // namespace

StudyResult generator_study(const ReproduceOptions& options, const Progress& progress) {
  options.check();
  const GeneratorScale scale = options.quick ? quick_scale() : full_scale();
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

// SPDX-License-Identifier: MIT
#include "lib/reproduce/classifier/fault_trajectories.hpp"

#include <vector>

namespace faultline {
namespace {

constexpr int kEndOfClass[kFaultClasses] = {20, 40, 75, kTable1Trajectories};

}  // namespace

int table_1_class(int index) {
  int output = 0;
  while (index >= kEndOfClass[output]) ++output;
  return output;
}

FaultLabel fault_of_class(int output) {
  if (output == kFaultClasses - 1) return {};
  return {FaultKind::free_swinging, output + 1};
}

Eigen::Vector4d table_1_prior() {
  Eigen::Vector4d prior = Eigen::Vector4d::Zero();
  for (int i = 0; i < kTable1Trajectories; ++i) prior[table_1_class(i)] += 1.0 / kTable1Trajectories;
  return prior;
}

int FaultPatterns::count() const {
  int sum = 0;
  for (const Transitions& transitions : of_class) sum += transitions.count();
  return sum;
}

FaultPatterns fault_patterns(const Experiment& experiment, const FaultTrajectories& trajectories,
                             SeedUse use) {
  std::array<std::vector<Log>, kFaultClasses> logs;
  for (int i = 0; i < trajectories.count; ++i) {
    const std::uint64_t own = seed_of(experiment.seed, use, i);
    const int output = table_1_class(i * kTable1Trajectories / trajectories.count);
    Log log = trajectory(experiment.robot, experiment.controller, kPatternsPerTrajectory, own,
                         {fault_of_class(output)});
    add_noise(log, experiment.ranges, trajectories.sigma, own);
    logs[output].push_back(std::move(log));
  }
  FaultPatterns patterns;
  for (int output = 0; output < kFaultClasses; ++output)
    patterns.of_class[output] = transitions_of(logs[output], trajectories.torque_phi);
  return patterns;
}

}  // namespace faultline

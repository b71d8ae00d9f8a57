// SPDX-License-Identifier: MIT
#include "lib/diagnosis/blind_spots.hpp"

#include <fmt/format.h>

#include <limits>

#include "lib/fault/fault_catalogue.hpp"

namespace faultline {
namespace {

constexpr double kEnough = 0.75;  // of the simulated faults of a kind

}  // namespace

std::vector<std::string> blind_spots(TorqueMeaning torque, bool has_velocity) {
  std::vector<std::string> spots;
  if (torque == TorqueMeaning::measured)
    spots.push_back(
        "The logged torque is measured, so a lost or added torque is inside it: free-swinging joints and "
        "torque loss cannot be seen.");
  if (torque == TorqueMeaning::current)
    spots.push_back(
        "The logged torque is a motor current: faults between controller and motor current cannot be seen.");
  if (!has_velocity)
    spots.push_back("The log has no velocities: small and short faults are seen later or not at all.");
  return spots;
}

double power_of(const Validation& validation) {
  double runs = 0.0, detected = 0.0;
  for (const ValidationRow& row : validation.rows) {
    runs += row.runs;
    detected += row.detected;
  }
  return runs > 0.0 ? detected / runs : std::numeric_limits<double>::quiet_NaN();
}

std::vector<std::string> weak_spots(const Validation& validation) {
  std::vector<std::string> spots;
  for (const ValidationRow& row : validation.rows)
    if (row.detected < kEnough * row.runs)
      spots.push_back(fmt::format("Of simulated faults \"{}\" the model finds only {} of {}.",
                                  describe(row.kind).heading, row.detected, row.runs));
  return spots;
}

}  // namespace faultline

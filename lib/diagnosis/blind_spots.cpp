// SPDX-License-Identifier: MIT
#include "lib/diagnosis/blind_spots.hpp"

namespace faultline {

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

}  // namespace faultline

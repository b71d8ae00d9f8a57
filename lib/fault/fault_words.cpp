// SPDX-License-Identifier: MIT
#include "lib/fault/fault_words.hpp"

#include <fmt/format.h>

#include <cmath>

namespace faultline {

std::string plain_words(const FaultLabel& label) {
  if (label.joint.is_none()) return describe(label.kind).heading;
  const FaultDescription& fault = describe(label.kind);
  return fmt::format("{} {} {}", fault.place == FaultPlace::link ? "link" : "joint", label.joint,
                     fault.of_a_joint);
}

std::string next_check_for(const FaultLabel& label) {
  const std::string joint = label.joint.is_none() ? "the joint" : fmt::format("joint {}", label.joint);
  return fmt::format(fmt::runtime(describe(label.kind).next_check), joint);
}

std::string size_text(const FaultLabel& label, const std::array<double, kMostSizes>& sizes, bool turns) {
  return fmt::format(fmt::runtime(describe(label.kind).size_words), fmt::arg("first", sizes[0]),
                     fmt::arg("joint", label.joint), fmt::arg("second", sizes[1]),
                     fmt::arg("percent", 100.0 * sizes[0]), fmt::arg("magnitude", std::abs(sizes[0])),
                     fmt::arg("much", sizes[0] < 0.0 ? "little" : "much"),
                     fmt::arg("length", unit_of(SizeMeasure::length, turns)),
                     fmt::arg("torque", unit_of(SizeMeasure::torque, turns)));
}

}  // namespace faultline

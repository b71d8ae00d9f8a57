// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

#include "lib/fault/fault_kind.hpp"
#include "lib/fault/fault_size.hpp"

namespace faultline {

/// What a kind of fault makes different from a healthy robot.
enum class FaultActsOn {
  nothing,
  motion,  ///< the joints move otherwise
  sensor,  ///< only what is read of them is false
};

enum class FaultPlace {
  nowhere,
  joint,  ///< any
  link,   ///< the end of any link; the joint that moves the link stands for it
};

inline constexpr int kMostSizes = 2;

/// All that is to be known of a kind of fault, but for what it does to the joint: its columns stand in
/// lib/explain/fault_columns and, apart from them on purpose, the simulated fault in
/// lib/simulate/fault_event.
struct FaultDescription {
  FaultKind kind = FaultKind::none;
  const char* name = "";        ///< in labels, JSON and reports; never changes
  const char* heading = "";     ///< in words
  const char* of_a_joint = "";  ///< in words, after "joint N " or "link N "
  const char* next_check = "";  ///< sentences to a technician; "{}" stands for the joint
  /// How its size is said: {first} and {second} size; the {joint}; of the first its {percent}, its
  /// {magnitude} and whether that is {much} or little; units {length} and {torque}.
  const char* size_words = "";

  FaultActsOn acts_on = FaultActsOn::nothing;
  FaultPlace place = FaultPlace::joint;
  bool passes = false;  ///< it is over by itself, so that each time it is a fault of its own
  /// Residuals show it for as long as it lasts, so that it can be told sample by sample.
  bool shows_in_each_sample = true;
  bool hidden_by_measured_torque = false;  ///< a torque measured behind the drive holds it

  /// The last one is SimulatedFault::size (lib/simulate), the first of two its `viscous`.
  std::array<FaultSize, kMostSizes> size{};
  int size_count = 0;
  /// Smaller ones are no fault to act on: share of usual_of() the measure that stands for each size among the
  /// features. Below what the twin draws, about as much as healthy days differ. 0 for kinds without a size.
  double least_size = 0.0;
  DrawRange twin_length_s{};  ///< of one that passes

  std::span<const FaultSize> sizes() const { return {size.data(), static_cast<std::size_t>(size_count)}; }
};

const FaultDescription& describe(FaultKind kind);

}  // namespace faultline

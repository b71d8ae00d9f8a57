// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "lib/core/joint.hpp"
#include "lib/fault/fault_kind.hpp"

namespace faultline {

/// Physical quantity of the size of a fault.
enum class SizeMeasure {
  torque_share,      ///< 1, of the drive's torque
  length,            ///< rad or m
  length_per_s,      ///< rad/s or m/s
  viscous_friction,  ///< N m s/rad or N s/m
  coulomb_friction,  ///< N m or N
  mass,              ///< kg
  torque,            ///< N m or N
  impulse,           ///< N m s or N s
};

/// Returns the unit at a joint that turns, or at one that slides.
const char* unit_of(SizeMeasure measure, bool turns);

/// Returns, in words such as "the range", the usual value of the measure, of which the twin draws a share.
const char* usual_of(SizeMeasure measure);

enum class Spread { uniform, log_uniform };
const char* to_string(Spread spread);

/// A range of random values.
struct DrawRange {
  double low = 0.0;
  double high = 0.0;
  Spread spread = Spread::uniform;
  bool either_sign = false;  ///< as often negative as positive

  bool operator==(const DrawRange&) const = default;
};

/// One size of a kind of fault.
struct FaultSize {
  SizeMeasure measure = SizeMeasure::torque;
  /// Quantity that represents this size among the features of an episode: the same one, or the impulse of a
  /// torque that passes.
  SizeMeasure feature = measure;
  const char* feature_name = "size";  ///< before the label in the feature's name
  DrawRange twin{};  ///< range that a technician would call a fault, as a share of usual_of(measure)
};

/// What a kind of fault changes, compared with a healthy robot.
enum class FaultActsOn {
  nothing,
  motion,  ///< the motion of the joints
  sensor,  ///< only the measured values
};

enum class FaultPlace {
  nowhere,
  joint,  ///< any joint
  link,   ///< the end of any link; identified by the joint that moves the link
};

inline constexpr int kMostSizes = 2;

/// All properties of a kind of fault but its effect on the joint: its columns are in
/// lib/explain/fault_columns and, separate on purpose, the simulated fault in lib/simulate/fault_event.
struct FaultDescription {
  FaultKind kind = FaultKind::none;
  const char* name = "";        ///< in labels, JSON and reports; never changes
  const char* heading = "";     ///< in words
  const char* of_a_joint = "";  ///< in words, with "{}" for "joint N" or "link N"
  const char* next_check = "";  ///< sentences for a technician; "{}" stands for the joint
  const char* learn_more = "";  ///< sentences: how the fault shows in a log, and what looks alike
  /// Format of the size in words: {first} and {second} size; the {joint}; of the first size its {percent},
  /// {magnitude} and sign as {much} or little; units {length} and {torque}.
  const char* size_words = "";

  FaultActsOn acts_on = FaultActsOn::nothing;
  FaultPlace place = FaultPlace::joint;
  bool passes = false;  ///< it ends by itself, so that each occurrence is a fault of its own
  /// Whether the residuals show it in each sample while it lasts, so that samples can be classified singly.
  bool shows_in_each_sample = true;
  bool hidden_by_measured_torque = false;  ///< contained in a torque that is measured behind the drive

  /// The last one is SimulatedFault::size (lib/simulate), the first of two its `viscous`.
  std::array<FaultSize, kMostSizes> size{};
  int size_count = 0;
  /// Least size of a fault to act on, for each size as a share of usual_of(FaultSize::feature): below what
  /// the twin draws, about as much as healthy days differ. 0 for kinds without a size.
  double least_size = 0.0;
  DrawRange twin_length_s{};  ///< duration of one that passes, s

  std::span<const FaultSize> sizes() const { return {size.data(), static_cast<std::size_t>(size_count)}; }
};

const FaultDescription& describe(FaultKind kind);

/// Returns the possible faults of a robot of so many joints: each kind at each joint it can have, in the
/// order of the catalogue, without the unknown fault. `payload_links`: joints of the links whose payload is
/// identifiable. `torque_is_measured`: behind the drive, which hides some kinds.
std::vector<FaultLabel> fault_labels(int joints, const std::vector<Joint>& payload_links,
                                     bool torque_is_measured);

/// Returns kind and joint in the words of a technician, such as "joint 2 is locked", "the encoder of joint 3
/// repeats one reading" or "unknown fault".
std::string plain_words(const FaultLabel& label);

/// Returns what to check next: sentences for a technician.
std::string next_check_for(const FaultLabel& label);

/// Returns the size of the fault in words, such as "about 40 % of the torque is lost"; empty for kinds
/// without such words. `sizes` as in the catalogue, at a joint that turns or slides.
std::string size_text(const FaultLabel& label, const std::array<double, kMostSizes>& sizes, bool turns);

}  // namespace faultline

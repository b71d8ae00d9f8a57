// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/fault/fault_kind.hpp"

namespace faultline {

/// What healthy days look like to one fault's hypothesis: it counts only as far as it explains more.
struct Imitation {
  FaultLabel label;
  double nats = 0.0;
};

struct EvidenceOptions {
  double trigger = 6.0;     ///< standard deviations of the cheap watch that wake the bank: seldom by chance
  double threshold = 18.0;  ///< nats of a hypothesis that raise the alarm: odds of 7e7
  double isolate_s = 0.6;   ///< time after the alarm before the fault is named: naming gains little later
  double longest_isolate_s = 1.5;  ///< the same while two labels are close
  double clear_margin = 12.0;      ///< nats between two labels that is not close: odds of 2e5
  int fewest_samples = 8;          ///< after the alarm, at low rates
  double confirm_s = 0.3;          ///< the bank goes back to sleep when nothing passed the threshold by then
  double recover_s = 1.0;          ///< an episode ends when nothing looked faulty for this long
  std::vector<Imitation> imitations{};  ///< added to the threshold of these faults
  /// No fault is named: what passes the threshold is only noted, which tells how far healthy logs go.
  bool only_measure = false;

  double imitation_of(const FaultLabel& label) const {
    for (const Imitation& imitation : imitations)
      if (imitation.label == label) return imitation.nats;
    return 0.0;
  }
};

}  // namespace faultline

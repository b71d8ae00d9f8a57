// SPDX-License-Identifier: MIT
#pragma once

namespace faultline {

struct EvidenceOptions {
  double trigger = 6.0;     ///< standard deviations of the cheap watch that wake the bank: seldom by chance
  double threshold = 18.0;  ///< nats of the best hypothesis that raise the alarm: odds of 7e7
  double isolate_s = 0.6;   ///< time after the alarm before the fault is named: naming gains little later
  double longest_isolate_s = 1.5;  ///< the same while two labels are close
  double clear_margin = 12.0;      ///< nats between two labels that is not close: odds of 2e5
  int fewest_samples = 8;          ///< after the alarm, at low rates
  double confirm_s = 0.3;          ///< the bank goes back to sleep when nothing passed the threshold by then
  double recover_s = 1.0;          ///< an episode ends when nothing looked faulty for this long
};

}  // namespace faultline

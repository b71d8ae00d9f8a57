// SPDX-License-Identifier: MIT
#include "formats/messages/receipt_gap.hpp"

#include <fmt/format.h>

namespace faultline {

void ReceiptGap::tell(Issues& issues) const {
  if (messages_ == 0 || (least_s_ == 0.0 && most_s_ == 0.0)) return;
  issues.add({"receipt_gap", "t", Severity::note,
              fmt::format("the messages were received {:.4g} s after the stamps in their headers, between "
                          "{:.4g} and {:.4g} s. To choose the time, name it in the robot file: [log] time = "
                          "\"header\" or \"receipt\"",
                          sum_s_ / static_cast<double>(messages_), least_s_, most_s_)});
}

}  // namespace faultline

// SPDX-License-Identifier: MIT
#include "lib/log/checkup/repeated_rows.hpp"

#include <algorithm>

#include "lib/log/log_channels.hpp"

namespace faultline {
namespace {

constexpr std::int64_t kShort = 20;  // rows, of what a slower source leaves; a robot at rest stands longer

}  // namespace

void RepeatedRowCheck::end() {
  found_.longest = std::max(found_.longest, run_);
  if (run_ > 0 && run_ < kShort) {
    if (found_.first_row == 0) found_.first_row = row_ - run_ + 1;
    found_.held += run_;
  }
  run_ = 0;
}

void RepeatedRowCheck::add(const Log& segment) {
  for (int i = 0; i < segment.rows(); ++i) {
    now_.clear();
    for_each_joint_channel(segment,
                           [&](const std::vector<double>& values, Channel) { now_.push_back(values[i]); });
    if (now_ == last_) {  // never of a row with a missing value
      ++found_.rows;
      ++run_;
    } else {
      end();
    }
    ++row_;
    now_.swap(last_);
  }
}

RepeatedRowCount RepeatedRowCheck::result() const {
  RepeatedRowCheck done = *this;
  done.end();
  return done.found_;
}

}  // namespace faultline

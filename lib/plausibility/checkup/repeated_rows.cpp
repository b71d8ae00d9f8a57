// SPDX-License-Identifier: MIT
#include "lib/plausibility/checkup/repeated_rows.hpp"

#include <algorithm>

#include "lib/log/log_channels.hpp"

namespace faultline {
namespace {

constexpr std::int64_t kShort = 20;  // rows, of a source slower than the logger; a robot at rest repeats more

}  // namespace

void RepeatedRowCheck::Runs::end() {
  found.longest = std::max(found.longest, run);
  if (run > 0 && run < kShort) {
    if (found.first_row == 0) found.first_row = row - run + 1;
    found.held += run;
  }
  run = 0;
}

void RepeatedRowCheck::Runs::take(bool repeats) {
  if (repeats) {
    ++found.rows;
    ++run;
  } else {
    end();
  }
  ++row;
}

void RepeatedRowCheck::add(const Log& segment) {
  const std::size_t positions = segment.q.size();  // the first channels
  for (int i = 0; i < segment.rows(); ++i) {
    now_.clear();
    for_each_joint_channel(segment,
                           [&](const std::vector<double>& values, Channel) { now_.push_back(values[i]); });
    const bool known = last_.size() == now_.size();  // a missing value equals no value
    std::size_t same = 0;
    for (std::size_t j = 0; j < positions && known; ++j) same += now_[j] == last_[j];
    positions_.take(known && same == positions);
    mixed_ += same > 0 && same < positions;
    all_.take(now_ == last_);
    now_.swap(last_);
  }
}

RepeatedRowCounts RepeatedRowCheck::result() const {
  RepeatedRowCheck done = *this;
  done.all_.end();
  done.positions_.end();
  return {done.all_.found, done.positions_.found, mixed_};
}

}  // namespace faultline

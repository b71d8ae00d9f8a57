// SPDX-License-Identifier: MIT
#include "lib/plausibility/checkup/channel_course.hpp"

#include <algorithm>
#include <cmath>

namespace faultline {
namespace {

/// The longer one of those at the more extreme value.
void keep_extreme(SameValue& kept, const SameValue& now, bool more_extreme) {
  if (kept.rows == 0 || more_extreme || (now.value == kept.value && now.rows > kept.rows)) kept = now;
}

}  // namespace

void ChannelCourse::begin(double t, double value, double place) {
  now_ = {1, value, t, 0.0, 0.0};
  place_ = place;
}

void ChannelCourse::end() {
  if (now_.rows == 0) return;
  if (now_.rows > found_.longest.rows) found_.longest = now_;
  if (now_.rows > 1 && now_.moved > found_.while_moving.moved) found_.while_moving = now_;
  keep_extreme(found_.at_min, now_, now_.value < found_.at_min.value);
  keep_extreme(found_.at_max, now_, now_.value > found_.at_max.value);
}

void ChannelCourse::add(double t, double value, double place) {
  if (std::isnan(value)) {
    end();
    now_ = {};
    last_ = value;
    return;
  }
  if (now_.rows > 0 && value == now_.value) {
    ++now_.rows;
    now_.length_s = t - now_.start_s;
    const double told = rate_ ? value * now_.length_s : 0.0;
    const double off = std::abs(place - place_ - told);
    if (off > now_.moved) now_.moved = off;
    return;
  }
  end();
  if (!std::isnan(last_)) step_.add_change(value - last_);
  last_ = value;
  begin(t, value, place);
}

ChannelCourse::Result ChannelCourse::result() const {
  ChannelCourse done = *this;
  done.end();
  done.found_.step = step_.result();
  return done.found_;
}

}  // namespace faultline

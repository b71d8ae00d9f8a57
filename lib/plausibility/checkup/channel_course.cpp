// SPDX-License-Identifier: MIT
#include "lib/plausibility/checkup/channel_course.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace faultline {
namespace {

constexpr std::size_t kStepMostChanges = 4096;
constexpr std::size_t kFewestChanges = 30;
constexpr double kSingle = 1.5;  // changes below so many times the least one are single steps
constexpr std::ptrdiff_t kFewestSingle = 3;
constexpr double kFarthestMultiple = 50.0;  // beyond it the error of the step hides multiples
constexpr double kOffMultiple = 0.15;       // of a step: largest difference from a multiple
constexpr double kMultiplesShare = 0.98;

/// Keeps in `kept` the stretch with the more extreme value, or the longer one of the same value.
void keep_extreme(SameValue& kept, const SameValue& now, bool more_extreme) {
  if (kept.rows == 0 || more_extreme || (now.value == kept.value && now.rows > kept.rows)) kept = now;
}

}  // namespace

void ValueStep::add_change(double change) {
  if (change != 0.0 && changes_.size() < kStepMostChanges) changes_.push_back(std::abs(change));
}

std::optional<double> ValueStep::result() const {
  if (changes_.size() < kFewestChanges) return std::nullopt;
  std::vector<double> sizes = changes_;
  std::sort(sizes.begin(), sizes.end());
  const auto past = std::upper_bound(sizes.begin(), sizes.end(), kSingle * sizes.front());
  if (past - sizes.begin() < kFewestSingle) return std::nullopt;
  const double step = std::accumulate(sizes.begin(), past, 0.0) / static_cast<double>(past - sizes.begin());
  double judged = 0.0, multiples = 0.0;
  for (const double size : sizes) {
    const double steps = size / step;
    if (steps > kFarthestMultiple) break;
    judged += 1.0;
    multiples += std::abs(steps - std::round(steps)) < kOffMultiple ? 1.0 : 0.0;
  }
  if (judged < static_cast<double>(kFewestChanges) || multiples < kMultiplesShare * judged)
    return std::nullopt;
  return step;
}

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
    const double by_rate = rate_ ? value * now_.length_s : 0.0;
    const double off = std::abs(place - place_ - by_rate);
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

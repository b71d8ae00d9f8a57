// SPDX-License-Identifier: MIT
#include "lib/residual/transition_reservoir.hpp"

namespace faultline {

void TransitionReservoir::offer(const Transitions& transitions, int column) {
  if (offered_ == 0) {
    pool_.row.resize(capacity_);
    pool_.time.resize(capacity_);
    pool_.duration.resize(capacity_);
    for_each_matrix(pool_, transitions,
                    [&](auto& mine, const auto& theirs) { mine.resize(theirs.rows(), capacity_); });
  }
  ++offered_;
  const std::int64_t place = kept_ < capacity_ ? kept_++ : static_cast<std::int64_t>(random_.below(offered_));
  if (place >= capacity_) return;
  pool_.row[place] = transitions.row[column];
  pool_.time[place] = transitions.time[column];
  pool_.duration[place] = transitions.duration[column];
  for_each_matrix(pool_, transitions,
                  [&](auto& mine, const auto& theirs) { mine.col(place) = theirs.col(column); });
}

Transitions TransitionReservoir::drawn() const {
  Transitions out = pool_;
  out.row.resize(kept_);
  out.time.conservativeResize(kept_);
  out.duration.conservativeResize(kept_);
  for_each_matrix(out, pool_,
                  [&](auto& mine, const auto&) { mine.conservativeResize(Eigen::NoChange, kept_); });
  return out;
}

}  // namespace faultline

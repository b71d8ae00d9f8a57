// SPDX-License-Identifier: MIT
#include "lib/residual/transition_reservoir.hpp"

namespace faultline {
namespace {

template <typename Visit>
void visit_matrices(Transitions& mine, const Transitions& theirs, Visit visit) {
  visit(mine.q, theirs.q);
  visit(mine.dq, theirs.dq);
  visit(mine.tau, theirs.tau);
  visit(mine.mean_tau, theirs.mean_tau);
  visit(mine.next_q, theirs.next_q);
  visit(mine.next_dq, theirs.next_dq);
}

}  // namespace

void TransitionReservoir::offer(const Transitions& transitions, int column) {
  if (offered_ == 0) {
    pool_.row.resize(capacity_);
    pool_.time.resize(capacity_);
    pool_.duration.resize(capacity_);
    visit_matrices(pool_, transitions,
                   [&](auto& mine, const auto& theirs) { mine.resize(theirs.rows(), capacity_); });
  }
  ++offered_;
  const std::int64_t place = kept_ < capacity_ ? kept_++ : static_cast<std::int64_t>(random_.below(offered_));
  if (place >= capacity_) return;
  pool_.row[place] = transitions.row[column];
  pool_.time[place] = transitions.time[column];
  pool_.duration[place] = transitions.duration[column];
  visit_matrices(pool_, transitions,
                 [&](auto& mine, const auto& theirs) { mine.col(place) = theirs.col(column); });
}

Transitions TransitionReservoir::drawn() const {
  Transitions out = pool_;
  out.row.resize(kept_);
  out.time.conservativeResize(kept_);
  out.duration.conservativeResize(kept_);
  visit_matrices(out, pool_,
                 [&](auto& mine, const auto&) { mine.conservativeResize(Eigen::NoChange, kept_); });
  return out;
}

}  // namespace faultline

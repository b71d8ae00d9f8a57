// SPDX-License-Identifier: MIT
#include "lib/log/transformed/converted_torque_source.hpp"

#include <algorithm>
#include <utility>

namespace faultline {

TorqueConversion::TorqueConversion(std::vector<double> delay_s, std::vector<double> gain,
                                   std::vector<double> limit)
    : delay_s_(std::move(delay_s)), gain_(std::move(gain)), limit_(std::move(limit)) {
  for (const double delay : delay_s_) {
    ahead_s_ = std::max(ahead_s_, -delay);
    behind_s_ = std::max(behind_s_, delay);
  }
}

/// Appends one more segment of the source to the rows not handed out yet; returns false at the end.
bool TorqueConversion::fill(LogSource& source) {
  Log segment;
  if (at_end_ || !source.next(segment)) {
    at_end_ = true;
    return false;
  }
  time_.insert(time_.end(), segment.time.begin(), segment.time.end());
  tau_.resize(segment.tau.size());
  position_.resize(segment.tau.size(), 0);
  for (std::size_t j = 0; j < segment.tau.size(); ++j)
    tau_[j].insert(tau_[j].end(), segment.tau[j].begin(), segment.tau[j].end());
  append(rows_, std::move(segment));
  return true;
}

double TorqueConversion::torque_at(int j, double t) {
  const std::vector<double>& tau = tau_[j];
  std::size_t& k = position_[j];
  while (k < time_.size() && time_[k] < t) ++k;
  if (k == 0) return tau.front();
  if (k == time_.size()) return tau.back();
  const double x = (t - time_[k - 1]) / (time_[k] - time_[k - 1]);
  return x == 1.0 ? tau[k] : tau[k - 1] + x * (tau[k] - tau[k - 1]);
}

bool TorqueConversion::next(LogSource& source, Log& segment) {
  while (rows_.rows() == 0 || rows_.time.front() + ahead_s_ > time_.back())
    if (!fill(source)) break;
  if (rows_.rows() == 0) return false;
  int ready = rows_.rows();
  while (!at_end_ && ready > 0 && rows_.time[ready - 1] + ahead_s_ > time_.back()) --ready;
  segment = take_front(rows_, ready);
  for (std::size_t j = 0; j < std::min(segment.tau.size(), delay_s_.size()); ++j)
    for (int k = 0; k < segment.rows(); ++k)
      segment.tau[j][k] = torque_at(static_cast<int>(j), segment.time[k] - delay_s_[j]);
  for (std::size_t j = 0; j < std::min(segment.tau.size(), gain_.size()); ++j)
    for (double& tau : segment.tau[j]) tau *= gain_[j];
  for (std::size_t j = 0; j < std::min(segment.tau.size(), limit_.size()); ++j)
    if (limit_[j] > 0.0)
      for (double& tau : segment.tau[j]) tau = std::clamp(tau, -limit_[j], limit_[j]);
  const double oldest = segment.time.back() - behind_s_;
  const auto kept = std::lower_bound(time_.begin(), time_.end(), oldest);
  const auto gone = static_cast<std::size_t>(std::max<std::ptrdiff_t>(kept - time_.begin() - 2, 0));
  time_.erase(time_.begin(), time_.begin() + static_cast<std::ptrdiff_t>(gone));
  for (std::size_t j = 0; j < tau_.size(); ++j) {
    tau_[j].erase(tau_[j].begin(), tau_[j].begin() + static_cast<std::ptrdiff_t>(gone));
    position_[j] -= std::min(position_[j], gone);
  }
  return true;
}

}  // namespace faultline

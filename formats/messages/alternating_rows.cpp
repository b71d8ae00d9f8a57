// SPDX-License-Identifier: MIT
#include "formats/messages/alternating_rows.hpp"

#include <algorithm>
#include <cmath>

namespace faultline {
namespace {

/// rad or m. Two publishers that are closer report one position, as the codes of an encoder at rest may do in
/// turn.
constexpr double kApart = 1e-2;
constexpr double kNear = 0.25;  ///< of the distance to the last row
constexpr double kMostShare = 0.5;
constexpr std::int64_t kLeastRows = 20;

double distance(const std::vector<double>& position, const std::vector<double>& other) {
  double largest = 0.0;
  for (std::size_t j = 0; j < std::min(position.size(), other.size()); ++j)
    largest = std::fmax(largest, std::abs(position[j] - other[j]));
  return largest;
}

}  // namespace

void AlternatingRows::add(const std::vector<double>& position) {
  if (!one_before_.empty()) {
    const double to_last = distance(position, last_);
    alternating_ += to_last > kApart && distance(position, one_before_) < kNear * to_last;
    ++rows_;
  }
  one_before_.swap(last_);
  last_ = position;
}

bool AlternatingRows::alternate() const {
  return rows_ >= kLeastRows && static_cast<double>(alternating_) > kMostShare * static_cast<double>(rows_);
}

}  // namespace faultline

// SPDX-License-Identifier: MIT
#include "lib/log/difference_velocity.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

constexpr int kVelocityFewestRows = 8;
constexpr std::size_t kEnoughRows = 1000;  // rows in motion that suffice
constexpr double kSameAsDifference = 0.1;  // of the noise of a difference of q: largest distance of dq
constexpr double kMostRows = 0.8;   // share of the rows that have to agree: next to lost rows, some do not
constexpr double kBendGain = 20.0;  // a third difference has 1 + 9 + 9 + 1 times the variance of white noise
constexpr double kMedianOfAbs = 0.6745;  // median of |x| over the standard deviation of a normal x

struct Joint {
  std::span<const double> time, q, dq;
  double period = 0.0;

  int rows() const { return static_cast<int>(q.size()); }
};

/// The rows between which a difference is taken, and whether its time is the period or the stamps.
struct Form {
  int back, ahead;
  bool by_period;
};

/// Returns the distance of dq from a difference of q that kMostRows keep; infinity without motion.
double distance(const Joint& m, const Form& form) {
  std::vector<double> distances;
  for (int k = 1; k + 1 < m.rows() && distances.size() < kEnoughRows; ++k) {
    const double step = m.q[k + form.ahead] - m.q[k - form.back];
    const double dt =
        form.by_period ? (form.back + form.ahead) * m.period : m.time[k + form.ahead] - m.time[k - form.back];
    if (step != 0.0 && dt > 0.0 && std::isfinite(m.dq[k] - step))
      distances.push_back(std::abs(m.dq[k] - step / dt));
  }
  return distances.empty() ? INFINITY : lower_quantile(distances, kMostRows);
}

/// Estimates the white noise of a difference of q from the third differences of q.
double difference_noise(const Joint& m) {
  std::vector<double> bends;
  for (int k = 3; k < m.rows(); ++k) {
    const double bend = m.q[k] - m.q[k - 3] - 3.0 * (m.q[k - 1] - m.q[k - 2]);
    if (std::isfinite(bend) && bend != 0.0) bends.push_back(std::abs(bend));
  }
  return bends.empty() ? 0.0 : upper_median(bends) / kMedianOfAbs / std::sqrt(kBendGain) / m.period;
}

double usual_period(std::span<const double> time) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < time.size(); ++k) steps.push_back(time[k] - time[k - 1]);
  return upper_median(steps);
}

}  // namespace

bool is_difference(std::span<const double> time, std::span<const double> q, std::span<const double> dq) {
  if (dq.size() != q.size() || q.size() < kVelocityFewestRows) return false;
  const Joint joint{time, q, dq, usual_period(time)};
  if (!(joint.period > 0.0)) return false;
  const double close = kSameAsDifference * difference_noise(joint);
  for (const bool by_period : {true, false})
    for (const Form& form : {Form{1, 0, by_period}, Form{1, 1, by_period}, Form{0, 1, by_period}})
      if (distance(joint, form) < close) return true;
  return false;
}

std::vector<char> velocities_by_difference(const Log& log) {
  std::vector<char> out(log.q.size(), 0);
  for (std::size_t j = 0; j < log.dq.size(); ++j)
    out[j] = is_difference(log.time, log.q[j], log.dq[j]) ? 1 : 0;
  return out;
}

}  // namespace faultline

// SPDX-License-Identifier: MIT
#include "lib/log/derived_velocity.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "lib/core/statistics.hpp"
#include "lib/log/time_axis.hpp"
#include "lib/log/transformed/changed_source.hpp"

namespace faultline {
namespace {

constexpr int kVelocityFewestRows = 8;
constexpr std::size_t kEnoughRows = 1000;  // rows in motion that suffice
constexpr double kSameAsDifference = 0.1;  // of the noise of a difference of q: largest distance of dq
constexpr double kMostRows = 0.8;   // share of the rows that have to agree: next to lost rows, some do not
constexpr double kBendGain = 20.0;  // a third difference has 1 + 9 + 9 + 1 times the variance of white noise
constexpr double kHalfDifference_s = 0.012;    // half of a central difference, at least one row
constexpr double kWidest = 1.5;                // times that: longer over lost rows
constexpr double kSecondDifferenceGain = 6.0;  // a second difference has 1 + 4 + 1 times the variance
constexpr double kOfMotion = 0.5;        // least share of the squared acceleration that is motion, not noise
constexpr double kCertain = 6.0;         // standard deviations of a delay
constexpr double kLeastDelay = 0.5;      // rows: less is the uncertainty of the time that a row belongs to
constexpr double kMedianOfAbs = 0.6745;  // median of |x| over the standard deviation of a normal x

struct DerivedJoint {
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
double distance(const DerivedJoint& m, const Form& form) {
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

/// Estimates the white noise of values from their third differences.
double white_noise(std::span<const double> values) {
  std::vector<double> bends;
  for (std::size_t k = 3; k < values.size(); ++k) {
    const double bend = values[k] - values[k - 3] - 3.0 * (values[k - 1] - values[k - 2]);
    if (std::isfinite(bend) && bend != 0.0) bends.push_back(std::abs(bend));
  }
  return bends.empty() ? 0.0 : upper_median(bends) / kMedianOfAbs / std::sqrt(kBendGain);
}

constexpr int kHalfWidth = 2;  // samples on either side from which the velocity of a row is estimated

/// Returns the slope at time[at] of the parabola through the finite values of rows [begin, end); NaN with
/// fewer than three.
double parabola_slope(const std::vector<double>& time, const std::vector<double>& values, int begin, int end,
                      int at) {
  const double width = std::max(time[end - 1] - time[at], time[at] - time[begin]);
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  int used = 0;
  for (int i = begin; i < end; ++i) {
    if (std::isnan(values[i])) continue;
    const double u = (time[i] - time[at]) / width;
    const Eigen::Vector3d row(1.0, u, u * u);
    normal += row * row.transpose();
    right += row * values[i];
    ++used;
  }
  if (used < 3) return std::nan("");
  return normal.ldlt().solve(right)(1) / width;
}

class AddedVelocities {
 public:
  bool next(LogSource& source, Log& segment) {
    while (!at_end_) {
      at_end_ = !source.next(incoming_);
      if (!at_end_ && !incoming_.dq.empty()) {
        std::swap(segment, incoming_);
        return true;
      }
      if (!at_end_) append(around_, incoming_);
      const int ready = at_end_ ? around_.rows() : around_.rows() - kHalfWidth;
      if (ready <= done_) continue;
      segment = slice(around_, done_, ready);
      derive(segment, done_);
      done_ = ready;
      forget(done_ - kHalfWidth);
      return true;
    }
    return false;
  }

 private:
  void derive(Log& segment, int begin) const {
    segment.dq.resize(segment.q.size());
    for (std::size_t j = 0; j < segment.q.size(); ++j) {
      segment.dq[j].resize(segment.rows());
      for (int i = 0; i < segment.rows(); ++i) {
        const int at = begin + i;
        segment.dq[j][i] = parabola_slope(around_.time, around_.q[j], std::max(at - kHalfWidth, 0),
                                          std::min(at + kHalfWidth + 1, around_.rows()), at);
      }
    }
  }

  void forget(int rows) {
    if (rows <= 0) return;
    around_ = slice(around_, rows, around_.rows());
    done_ -= rows;
  }

  Log incoming_;
  Log around_;    ///< rows handed out that the next ones need, then rows not handed out
  int done_ = 0;  ///< number of these that were handed out
  bool at_end_ = false;
};

}  // namespace

bool is_difference(std::span<const double> time, std::span<const double> q, std::span<const double> dq) {
  if (dq.size() != q.size() || q.size() < kVelocityFewestRows) return false;
  const DerivedJoint joint{time, q, dq, median_step(time)};
  if (!(joint.period > 0.0)) return false;
  const double close = kSameAsDifference * white_noise(q) / joint.period;
  for (const bool by_period : {true, false})
    for (const Form& form : {Form{1, 0, by_period}, Form{1, 1, by_period}, Form{0, 1, by_period}})
      if (distance(joint, form) < close) return true;
  return false;
}

VelocityDelay velocity_delay(std::span<const double> time, std::span<const double> q,
                             std::span<const double> dq) {
  if (dq.size() != q.size() || q.size() < kVelocityFewestRows) return {};
  const double period = median_step(time);
  if (!(period > 0.0)) return {};
  const auto half = static_cast<std::size_t>(std::max(1L, std::lround(kHalfDifference_s / period)));
  const double span_s = static_cast<double>(half) * period, widest_s = 2.0 * kWidest * span_s;
  double rows = 0.0, squares = 0.0, products = 0.0, off_squares = 0.0;
  for (std::size_t k = half; k + half < q.size(); ++k) {
    const double before_s = time[k] - time[k - half], after_s = time[k + half] - time[k];
    const double before = (q[k] - q[k - half]) / before_s, after = (q[k + half] - q[k]) / after_s;
    const double acceleration = 2.0 * (after - before) / (before_s + after_s);
    const double off = dq[k] - (q[k + half] - q[k - half]) / (before_s + after_s);
    if (before_s + after_s > widest_s || !std::isfinite(acceleration) || !std::isfinite(off)) continue;
    rows += 1.0;
    squares += acceleration * acceleration;
    products += off * acceleration;
    off_squares += off * off;
  }
  const double noise = white_noise(q) / (span_s * span_s);
  const double of_motion = squares - rows * kSecondDifferenceGain * noise * noise;
  if (!(of_motion > kOfMotion * squares)) return {};
  const double delay_s = -products / of_motion;
  const double left = std::max(off_squares - delay_s * delay_s * of_motion, 0.0) / rows;
  const double independent = rows / static_cast<double>(2 * half);  // differences overlap
  const double std_s = std::sqrt(left * rows / (independent * of_motion));
  const double error = std::abs(delay_s) * std::sqrt(of_motion / rows);
  return {delay_s,
          std::abs(delay_s) > std::max(kCertain * std_s, kLeastDelay * period) && error > white_noise(dq)};
}

bool is_derived(std::span<const double> time, std::span<const double> q, std::span<const double> dq) {
  return is_difference(time, q, dq) || velocity_delay(time, q, dq).matters;
}

std::unique_ptr<LogSource> with_velocity(std::unique_ptr<LogSource> source) {
  return std::make_unique<StagedSource<AddedVelocities>>(std::move(source));
}

}  // namespace faultline

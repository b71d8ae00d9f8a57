// SPDX-License-Identifier: MIT
#include "lib/log/derive.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "lib/log/transformed/changed_source.hpp"

namespace faultline {
namespace {

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

std::unique_ptr<LogSource> with_velocity(std::unique_ptr<LogSource> source) {
  return std::make_unique<StagedSource<AddedVelocities>>(std::move(source));
}

}  // namespace faultline

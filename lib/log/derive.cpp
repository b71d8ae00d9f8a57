// SPDX-License-Identifier: MIT
#include "lib/log/derive.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace faultline {
namespace {

class VelocitySource : public LogSource {
 public:
  VelocitySource(std::unique_ptr<LogSource> source, int half_width)
      : source_(std::move(source)), half_width_(std::max(half_width, 1)) {}

  bool next(Log& segment) override;
  void rewind() override {
    source_->rewind();
    around_ = {};
    done_ = 0;
    at_end_ = false;
  }
  const LogIdentity& identity() const override { return source_->identity(); }
  const Issues& issues() const override { return source_->issues(); }
  double share_read() const override { return source_->share_read(); }

 private:
  void derive(Log& segment, int begin) const;
  void forget(int rows);

  std::unique_ptr<LogSource> source_;
  int half_width_;
  Log incoming_;
  Log around_;    ///< rows handed out that the next ones need, then rows not handed out
  int done_ = 0;  ///< number of these that were handed out
  bool at_end_ = false;
};

bool VelocitySource::next(Log& segment) {
  while (!at_end_) {
    at_end_ = !source_->next(incoming_);
    if (!at_end_ && !incoming_.dq.empty()) {
      std::swap(segment, incoming_);
      return true;
    }
    if (!at_end_) append(around_, incoming_);
    const int ready = at_end_ ? around_.rows() : around_.rows() - half_width_;
    if (ready <= done_) continue;
    segment = slice(around_, done_, ready);
    derive(segment, done_);
    done_ = ready;
    forget(done_ - half_width_);
    return true;
  }
  return false;
}

void VelocitySource::derive(Log& segment, int begin) const {
  segment.dq.resize(segment.q.size());
  for (std::size_t j = 0; j < segment.q.size(); ++j) {
    segment.dq[j].resize(segment.rows());
    for (int i = 0; i < segment.rows(); ++i) {
      const int at = begin + i;
      segment.dq[j][i] = parabola_slope(around_.time, around_.q[j], std::max(at - half_width_, 0),
                                        std::min(at + half_width_ + 1, around_.rows()), at);
    }
  }
}

void VelocitySource::forget(int rows) {
  if (rows <= 0) return;
  around_ = slice(around_, rows, around_.rows());
  done_ -= rows;
}

}  // namespace

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

std::unique_ptr<LogSource> with_velocity(std::unique_ptr<LogSource> source, const DeriveOptions& options) {
  return std::make_unique<VelocitySource>(std::move(source), options.half_width);
}

}  // namespace faultline

// SPDX-License-Identifier: MIT
#include "lib/diagnose/curves/required_torque.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <utility>

#include "lib/explain/day/day_effects.hpp"
#include "lib/identify/motion/log_survey.hpp"
#include "lib/identify/motion/raw_stretch.hpp"
#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLeastFriction = 0.05;  // share of the identified friction: friction is never negative
constexpr double kGapPeriods = 5.5;      // a longer step ends a stretch: the motion in it is not known
constexpr int kMostMissingRows = 4;      // successive incomplete rows; more are a gap, too
constexpr int kShortestStretch = 8;      // rows: fewer do not determine an acceleration
constexpr int kChunkRows = 2000;         // rows that are smoothed at a time,
constexpr int kMarginRows = 250;         // with so many on either side; farther rows have no influence
// The three points of Gauss' quadrature in a step of length 1, and their weights.
constexpr std::array<double, 3> kGaussPoint{0.1127016653792583, 0.5, 0.8872983346207417};
constexpr std::array<double, 3> kGaussWeight{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};

/// The robot with the effects of a log's day, and the relation between logged torque and drive torque.
struct RobotOfTheDay {
  Chain chain;
  std::vector<double> gain, offset;  // by joint: the drive gives gain * logged torque + offset, N m or N
  double torque_phi = 0.0;           // Robot::torque_phi
};

/// Returns the identified robot with the friction, torque gain and torque offset that the diagnosis estimated
/// for the log (Diagnosis::condition).
RobotOfTheDay robot_of_the_day(const Model& model, const std::vector<ConditionItem>& condition) {
  const int n = model.robot.joints();
  RobotOfTheDay robot{model.robot.chain, std::vector<double>(n, 1.0), std::vector<double>(n, 0.0),
                      model.robot.torque_phi.value_or(0.0)};
  for (const ConditionItem& item : condition) {
    const int j = item.joint.index();
    if (!std::isfinite(item.value)) continue;
    if (item.kind == DayEffectKind::friction) {
      const double scale = std::max(1.0 + item.value / 100.0, kLeastFriction);
      robot.chain.friction[j].viscous *= scale;
      robot.chain.friction[j].coulomb *= scale;
      robot.chain.friction[j].load *= scale;
    } else if (item.kind == DayEffectKind::torque_gain) {
      robot.gain[j] += item.value / 100.0;
    } else if (item.kind == DayEffectKind::torque_offset) {
      robot.offset[j] += item.value;
    }
  }
  return robot;
}

bool is_complete(const Log& segment, int row) {
  const auto finite = [row](const std::vector<double>& values) { return std::isfinite(values[row]); };
  return std::all_of(segment.q.begin(), segment.q.end(), finite) &&
         std::all_of(segment.dq.begin(), segment.dq.end(), finite);
}

/// Position, velocity and acceleration at the share `s` of the step from row `k` to the next, by the cubic
/// through the positions and velocities of both.
struct Between {
  JointVector q, dq, ddq;

  Between(const RawStretch& motion, int k, double s) {
    const double h = motion.time[k + 1] - motion.time[k];
    const JointVector q0 = motion.q.col(k), q1 = motion.q.col(k + 1), v0 = h * motion.dq.col(k),
                      v1 = h * motion.dq.col(k + 1), rise = q1 - q0;
    constexpr double kDegree = 3.0;  // of the polynomial
    const JointVector b = kDegree * rise - 2.0 * v0 - v1, c = v0 + v1 - 2.0 * rise;
    q = q0 + s * (v0 + s * (b + s * c));
    dq = (v0 + s * (2.0 * b + kDegree * s * c)) / h;
    ddq = (2.0 * b + 2.0 * kDegree * s * c) / (h * h);
  }
};

/// Mean torque that the robot needs from row k to the next, joints, N m or N.
JointVector mean_torque(const Chain& chain, const RawStretch& motion, int k) {
  JointVector mean = JointVector::Zero(chain.joints());
  for (std::size_t i = 0; i < kGaussPoint.size(); ++i) {
    const Between at(motion, k, kGaussPoint[i]);
    mean += kGaussWeight[i] * inverse_dynamics(chain, at.q, at.dq, at.ddq);
  }
  return mean;
}

/// The rows of one stretch that are not yet smoothed, and those before them that smoothing needs.
class OpenStretch {
 public:
  OpenStretch(const RobotOfTheDay& robot, const LogSurvey& survey) : robot_(robot), survey_(survey) {}

  bool empty() const { return time_.empty(); }
  void clear() {
    time_.clear();
    values_.clear();
    stale_.clear();
    done_ = missing_ = 0;
  }
  int rows() const { return static_cast<int>(time_.size()); }
  /// Rows that were added and have no torque yet.
  int waiting() const { return rows() - done_; }
  double last_time_s() const { return time_.back(); }
  int missing() const { return missing_; }

  void add(const Log& segment, int row, bool complete) {
    missing_ = complete ? 0 : missing_ + 1;
    time_.push_back(segment.time[row]);
    stale_.push_back(complete ? 0 : 1);
    const std::size_t width = segment.q.size() * (segment.dq.empty() ? 1 : 2);
    has_dq_ = !segment.dq.empty();
    if (!complete) {
      values_.insert(values_.end(), width, 0.0);
      std::copy_n(values_.end() - 2 * static_cast<std::ptrdiff_t>(width), width,
                  values_.end() - static_cast<std::ptrdiff_t>(width));
      return;
    }
    for (const auto& joint : segment.q) values_.push_back(joint[row]);
    for (const auto& joint : segment.dq) values_.push_back(joint[row]);
  }

  /// Returns the torque of the rows from the first waiting one to `end` (exclusive), joints x rows.
  RequiredTorque take(int end) {
    RequiredTorque torque = RequiredTorque::Constant(robot_.chain.joints(), end - done_, kNaN);
    if (rows() >= kShortestStretch) fill(torque);
    done_ = end;
    forget_before(std::max(end - kMarginRows, 0));
    return torque;
  }

 private:
  void fill(RequiredTorque& torque) const {
    const RawStretch motion = smoothed();
    const int first = std::max(done_ - 1, 0);
    Eigen::MatrixXd mean(robot_.chain.joints(), done_ + torque.cols() - first);
    for (int i = 0; i < mean.cols(); ++i)
      mean.col(i) = first + i + 1 < rows() ? mean_torque(robot_.chain, motion, first + i)
                                           : JointVector::Constant(robot_.chain.joints(), kNaN);
    for (int i = 0; i < torque.cols(); ++i) {
      const int at = done_ + i - first;
      torque.col(i) = mean.col(at);
      if (robot_.torque_phi > 0.0 && at > 0)
        torque.col(i) = (1.0 - robot_.torque_phi) * mean.col(at) + robot_.torque_phi * mean.col(at - 1);
      for (int j = 0; j < torque.rows(); ++j)
        torque(j, i) = (torque(j, i) - robot_.offset[j]) / robot_.gain[j];
    }
  }

  /// Estimates the motion of all rows from the measurements of all of them.
  RawStretch smoothed() const {
    const int n = robot_.chain.joints(), width = has_dq_ ? 2 * n : n;
    const Eigen::Map<const Eigen::MatrixXd> measured(values_.data(), width, rows());
    RawStretch s;
    s.time = Eigen::Map<const Eigen::VectorXd>(time_.data(), rows());
    s.stale = Eigen::Map<const Eigen::VectorXi>(stale_.data(), rows());
    s.q = measured.topRows(n);
    if (has_dq_) s.dq = measured.bottomRows(n);
    RawStretch out = s;
    out.dq.resize(n, rows());
    for (int j = 0; j < n; ++j) {
      JointMotion motion = joint_motion(s, j);
      if (!survey_.measures_velocity(j)) motion.dq.resize(0);
      const SmoothMotion smooth = smooth_motion(motion, survey_.noise[j]);
      out.q.row(j) = smooth.q;
      out.dq.row(j) = smooth.dq;
    }
    return out;
  }

  void forget_before(int row) {
    const auto width = static_cast<std::ptrdiff_t>(values_.size()) / rows();
    time_.erase(time_.begin(), time_.begin() + row);
    stale_.erase(stale_.begin(), stale_.begin() + row);
    values_.erase(values_.begin(), values_.begin() + row * width);
    done_ -= row;
  }

  const RobotOfTheDay& robot_;
  const LogSurvey& survey_;
  std::vector<double> time_, values_;  ///< q, then dq of each row
  std::vector<int> stale_;
  bool has_dq_ = false;
  int done_ = 0, missing_ = 0;
};

/// Keeps segments until each of their rows has its torque, then passes them to `visit`.
class WaitingSegments {
 public:
  explicit WaitingSegments(const std::function<void(const Log&, const RequiredTorque&)>& visit)
      : visit_(visit) {}

  void add(const Log& segment, int joints) {
    waiting_.emplace_back(segment, RequiredTorque::Constant(joints, segment.rows(), kNaN));
  }

  /// Sets the torque of the next rows that have none, in order.
  void put(const RequiredTorque& torque) {
    for (Eigen::Index i = 0; i < torque.cols(); ++i) {
      auto& [segment, required] = waiting_.front();
      required.col(next_++) = torque.col(i);
      if (next_ < segment.rows()) continue;
      visit_(segment, required);
      waiting_.pop_front();
      next_ = 0;
    }
  }

 private:
  const std::function<void(const Log&, const RequiredTorque&)>& visit_;
  std::deque<std::pair<Log, RequiredTorque>> waiting_;
  int next_ = 0;
};

/// Cuts the rows of a log into stretches and computes the torque of each.
class TorqueReplay {
 public:
  TorqueReplay(const RobotOfTheDay& robot, const LogSurvey& survey,
               const std::function<void(const Log&, const RequiredTorque&)>& visit)
      : robot_(robot), survey_(survey), stretch_(robot, survey), segments_(visit) {}

  void take(const Log& segment) {
    if (segment.rows() == 0) return;
    segments_.add(segment, robot_.chain.joints());
    for (int row = 0; row < segment.rows(); ++row) take_row(segment, row);
  }

  void finish() {
    if (!stretch_.empty()) segments_.put(stretch_.take(stretch_.rows()));
    stretch_.clear();
  }

 private:
  void take_row(const Log& segment, int row) {
    const bool complete = is_complete(segment, row);
    if (!stretch_.empty() &&
        (stretch_.missing() >= kMostMissingRows ||
         segment.time[row] - stretch_.last_time_s() > kGapPeriods * survey_.summary.period_s))
      finish();
    if (stretch_.empty() && !complete)
      return segments_.put(RequiredTorque::Constant(robot_.chain.joints(), 1, kNaN));
    stretch_.add(segment, row, complete);
    if (stretch_.waiting() >= kChunkRows + kMarginRows)
      segments_.put(stretch_.take(stretch_.rows() - kMarginRows));
  }

  const RobotOfTheDay& robot_;
  const LogSurvey& survey_;
  OpenStretch stretch_;
  WaitingSegments segments_;
};

}  // namespace

void for_each_with_required_torque(LogSource& log, const Model& model, const Diagnosis& diagnosis,
                                   const std::function<void(const Log&, const RequiredTorque&)>& visit) {
  const bool is_possible = model.has_mechanics() && !diagnosis.log.is_tracked;
  if (!is_possible) {
    log.rewind();
    for (Log segment; log.next(segment);) visit(segment, {});
    return;
  }
  const LogSurvey survey = survey_log(log, model.robot.joints());
  const RobotOfTheDay robot = robot_of_the_day(model, diagnosis.condition);
  TorqueReplay replay(robot, survey, visit);
  log.rewind();
  for (Log segment; log.next(segment);) replay.take(segment);
  replay.finish();
}

}  // namespace faultline

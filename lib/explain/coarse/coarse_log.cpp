// SPDX-License-Identifier: MIT
#include "lib/explain/coarse/coarse_log.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <optional>

#include "lib/balance/rest.hpp"
#include "lib/explain/coarse/coarse_judge.hpp"
#include "lib/explain/hypothesis.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kMissingTorqueStd = 1.0;  // share of usual and logged torque that may be missing (std)
constexpr int kSmoothings = 4;             // rounds of smoothing: a force as large as the torque converges
constexpr double kStillChanges = 30.0;  // standard deviations of a measurement that the last round may change
constexpr int kHealthyRounds = 2;       // of integration and regression for the healthy robot
constexpr int kFewestStays = 4;         // samples for which it stays, at least
constexpr double kStillShare = 0.02;    // share of the joint's usual speed in this log that is still rest,
constexpr double kStillNoise = 1.5;     // beside so many standard deviations of a measured velocity
constexpr int kFewestRepeats = 3;       // samples: if healthy positions repeat so long, it is no evidence
constexpr double kTellingNoise = 2e-5;  // rad or m: with less noise a joint at rest repeats its code
constexpr int kFewestSamples = 16;      // of a log: fewer are not explained

/// Returns the first interval through which the robot cannot be integrated; their number if there is none.
int first_wild(const LinearSteps& steps) {
  for (int k = 0; k < steps.intervals; ++k)
    if (!steps.miss.col(k).allFinite() || !steps.slope_of(k).allFinite()) return k;
  return steps.intervals;
}

/// Returns the first sample that the last round of smoothing still changed; their number if there is none.
int first_unsettled(const Trajectory& change, const MatrixXd& variance) {
  const MatrixXd square = change.cwiseAbs2().cwiseQuotient(variance);
  for (Eigen::Index k = 0; k < square.cols(); ++k)
    if (!(square.col(k).maxCoeff() < kStillChanges * kStillChanges)) return static_cast<int>(k);
  return static_cast<int>(square.cols());
}

/// A smoothed trajectory, or the interval through which the robot cannot be integrated.
struct SmoothedLog {
  Trajectory about;
  int settled = 0;  ///< see CoarseLog::settled
  std::optional<int> wild{};
};

/// Smooths the trajectory under the healthy robot with uncertain torques. The steps are linear about the
/// force that the trajectory needs, too, which may be as large as the torque.
SmoothedLog smoothed_log(const CoarseLog& log) {
  const OneStepModel& m = *log.model;
  const int n = m.joints(), force = m.layout().force(0);
  const MotionLaw law(m.body, log.numbers);
  Trajectory about = log.read;
  const auto torque = log.log.tau.topRows(log.samples() - 1).transpose();
  const MatrixXd doubt =
      (log.force_std.cwiseAbs2() + kMissingTorqueStd * kMissingTorqueStd * torque.cwiseAbs2()).colwise() +
      kMissingTorqueStd * kMissingTorqueStd * m.torque_rms.cwiseAbs2();
  MatrixXd missing = MatrixXd::Zero(n, log.samples() - 1);
  int settled = 0;
  FilterInput in;
  in.column.resize(2 * n, 0);
  in.variance = log.variance;
  for (int round = 0; round < kSmoothings; ++round) {
    LinearSteps steps = linear_steps(log.log, about, m.setting, {.usual = &law, .force = &missing});
    if (const int wild = first_wild(steps); wild < steps.intervals) return {{}, 0, wild};
    for (int k = 0; k < steps.intervals; ++k)
      steps.miss.col(k) -= steps.number_of(k).middleCols(force, n) * missing.col(k);
    in.process = process_covariance(steps, m.layout(), doubt.cwiseSqrt());
    in.reading = log.read - about;
    const Trajectory change = smoothed(steps, innovations(steps, in), VectorXd(0));
    for (int k = 0; k < steps.intervals; ++k) {
      const MatrixXd by_force = steps.number_of(k).middleCols(force, n);
      const VectorXd off = change.col(k + 1) - steps.slope_of(k) * change.col(k) - steps.miss.col(k);
      missing.col(k) = by_force.colPivHouseholderQr().solve(off);
    }
    about += change;
    settled = first_unsettled(change, log.variance);
  }
  return {std::move(about), settled};
}

/// Returns whether joint `j` (from 0) halts at sample `k`, fast before, on side `side` outside its range.
bool halts_at(const CoarseLog& log, int j, double side, int k, double still) {
  const int before = std::max(1, static_cast<int>(kHaltsIn_s / log.period_s()));
  const int from = std::max(0, k - before);
  const auto speed = log.about.row(log.joints() + j);
  return speed[k] * side < still &&
         (side * speed.segment(from, k - from + 1)).maxCoeff() > kFastBeforeStop * log.model->top_speed[j];
}

/// Marks the intervals of joint `j` (from 0) from a halt that lasts to the end of a stretch.
void mark_stop(CoarseLog& log, int j, const StretchOutside& outside) {
  const auto speed = log.about.row(log.joints() + j);
  const double still = kStillShare * std::sqrt(speed.squaredNorm() / log.samples()) +
                       kStillNoise * std::sqrt(log.model->reading_variance[log.joints() + j]);
  const int stays = std::max(kFewestStays, static_cast<int>(kStaysFor_s / log.period_s()));
  int first = -1;
  bool stayed = false;
  for (int k = outside.begin; k < outside.end && !stayed; ++k) {
    if (first < 0 && halts_at(log, j, outside.side, k, still)) first = k;
    if (first < 0) continue;  // it may bounce before it stays
    stayed = k < outside.end - stays && speed.segment(k, stays).cwiseAbs().mean() < 2.0 * still;
  }
  if (!stayed) return;
  const int lead = std::max(2, static_cast<int>(kHaltsIn_s / log.period_s()));
  const int from = std::max(0, first - lead), to = std::min(log.samples() - 1, outside.end + 1);
  log.stop.row(j).segment(from, to - from).setOnes();
}

/// Finds the end stops.
void find_stops(CoarseLog& log) {
  const OneStepModel& m = *log.model;
  log.stop = MatrixXd::Zero(log.joints(), log.samples() - 1);
  for (int j = 0; j < log.joints(); ++j)
    for (const StretchOutside& each : stretches_outside(log.about.row(j), m.q_low[j], m.q_high[j]))
      mark_stop(log, j, each);
  log.keep = MatrixXd::Ones(log.read.rows(), log.samples());
  log.keep.topRightCorner(log.joints(), log.samples() - 1) -= log.stop;
  log.keep.bottomRightCorner(log.joints(), log.samples() - 1) -= log.stop;
}

}  // namespace

int CoarseLog::first_onset() const {
  return static_cast<int>(std::ceil(std::max(kLead_s, kLeadRows * period_s()) / period_s()));
}

std::optional<CoarseLog> followed_log(UniformLog log, const OneStepModel& model) {
  if (log.rows() < kFewestSamples) return std::nullopt;
  CoarseLog out;
  out.log = std::move(log);
  out.model = &model;
  out.numbers = model.numbers();
  out.day = model.day_directions();
  out.read = readings(out.log);
  out.variance = model.variance_of_readings(out.log);
  out.force_std = model.force_std(out.log, out.read);
  SmoothedLog smooth = smoothed_log(out);
  if (smooth.wild) return followed_log(part_of(out.log, 0, *smooth.wild), model);
  out.about = std::move(smooth.about);
  out.settled = smooth.settled;
  out.force_std = model.force_std(out.log, out.about);
  find_stops(out);
  const MotionLaw law(model.body, out.numbers);
  out.healthy_steps = linear_steps(out.log, out.about, model.setting, {.usual = &law});
  std::optional<CoarseExplanation> healthy = judge_coarse(out, {}, {.rounds = kHealthyRounds});
  if (!healthy) return std::nullopt;
  out.healthy = std::move(*healthy);
  return out;
}

std::optional<CoarseLog> settled_part(const CoarseLog& log) {
  return followed_log(part_of(log.log, 0, log.settled), *log.model);
}

bool repeats_are_evidence(const OneStepModel& model, int j) {
  return model.longest_repeat[j] < kFewestRepeats &&
         model.reading_variance[j] > kTellingNoise * kTellingNoise;
}

}  // namespace faultline

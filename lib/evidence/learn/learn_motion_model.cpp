// SPDX-License-Identifier: MIT
#include "lib/evidence/learn/learn_motion_model.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/error.hpp"
#include "lib/core/statistics.hpp"
#include "lib/evidence/learn/innovation_tails.hpp"
#include "lib/evidence/learn/match_noise.hpp"
#include "lib/evidence/learn/work_pieces.hpp"
#include "lib/evidence/noise_level.hpp"
#include "lib/evidence/slow_states.hpp"
#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

constexpr int kFewestRows = 50;            // fewer say nothing of noise and range
constexpr double kFloorShare = 0.001;      // of the largest torque, where matching starts
constexpr double kLeastFloor = 1e-9;       // N m or N, of joints without torque
constexpr double kFirstClockShare = 0.01;  // of the period, where matching the clock's error starts

/// Median of the first log, s.
double usual_period_s(const std::vector<HealthyExcerpt>& pieces) {
  std::vector<double> periods;
  if (pieces.empty()) return 0.0;
  const std::vector<double>& time = pieces.front().log.time;
  for (std::size_t k = 1; k < time.size(); ++k) periods.push_back(time[k] - time[k - 1]);
  return upper_median(periods);
}

/// M_jj in the middle of the range.
std::vector<double> inertia_scale(const MotionModel& model) {
  JointVector<double> middle(model.joints());
  for (int j = 0; j < model.joints(); ++j) middle[j] = 0.5 * (model.q_low[j] + model.q_high[j]);
  const JointMatrix<double> inertia = inertia_matrix(model.chain, middle);
  std::vector<double> diagonal;
  for (int j = 0; j < model.joints(); ++j) diagonal.push_back(inertia(j, j));
  return diagonal;
}

/// The same number of rows from the beginning of every log, and how it measures against the others.
std::vector<HealthyExcerpt> excerpts(std::span<LogSource* const> logs, int rows, MotionModel& model,
                                     const LearnMotionOptions& options) {
  std::vector<HealthyExcerpt> out;
  std::vector<NoiseLevel> levels;
  const int each = std::max(rows / static_cast<int>(std::max<std::size_t>(logs.size(), 1)), kFewestRows);
  for (LogSource* log : logs) {
    log->rewind();
    Log taken;
    for (Log segment; taken.rows() < each && log->next(segment);)
      append(taken, slice(segment, 0, std::min(segment.rows(), each - taken.rows())));
    if (taken.rows() < 2) continue;
    levels.push_back(noise_level(taken));
    out.push_back({std::move(taken), {}});
  }
  if (!options.normal) return out;
  model.usual_noise = usual_level(levels);
  model.noise_range = options.normal->noise;
  for (HealthyExcerpt& excerpt : out) excerpt.noise = log_noise(model, excerpt.log);
  return out;
}

/// Velocities that are differences of positions in most healthy logs tell nothing of their own; their noise
/// is that of the difference.
void leave_out_differences(MotionModel& model, const std::vector<HealthyExcerpt>& pieces, double period_s) {
  for (int j = 0; j < model.joints(); ++j) {
    const auto derived = std::count_if(pieces.begin(), pieces.end(), [j](const HealthyExcerpt& piece) {
      return piece.noise.dq_is_difference[j];
    });
    const bool most = 2 * derived > static_cast<std::ptrdiff_t>(pieces.size());
    model.dq_is_difference.push_back(most ? 1 : 0);
    if (most && period_s > 0.0) model.dq_std[j] = std::sqrt(2.0) * model.q_std[j] / period_s;
  }
}

/// What of the healthy days is neither noise nor the identified robot.
void learn_family(MotionModel& model, std::vector<HealthyExcerpt>& pieces, const MatchOptions& matching,
                  const NormalRange& normal) {
  const std::vector<SlowState> before = slow_states(model, normal);
  if (learn_tails(model, pieces, matching.threads)) match_noise(model, pieces, matching);
  model.work_pieces_kg = normal.work_pieces_kg;
  const ToldBy told = learn_work_pieces(model, before, pieces, matching.threads);
  if (told == ToldBy::nothing) return;
  model.slow = before;  // what they shook was taken for noise
  allow_work_pieces(model);
  const bool settles = told != ToldBy::statement;
  if (settles) settle_work_piece(model, told, pieces, matching.threads);
  match_noise(model, pieces, matching);
  if (settles) settle_work_piece(model, told, pieces, matching.threads);
}

}  // namespace

MotionModel learn_motion_model(std::span<LogSource* const> logs, const IdentifiedMotion& identified,
                               const LearnMotionOptions& options) {
  MotionModel model;
  model.chain = identified.chain;
  model.torque_phi = identified.torque_phi;
  model.q_std = identified.q_std;
  model.dq_std = identified.dq_std;
  const HealthyStatistics healthy = healthy_statistics(logs, identified.chain.joints());
  if (healthy.rows < kFewestRows)
    throw Error(ErrorCode::input, "healthy logs",
                "hold " + std::to_string(healthy.rows) + " usable rows; at least " +
                    std::to_string(kFewestRows) + " are needed");
  model.q_low = healthy.q_low;
  model.q_high = healthy.q_high;
  model.velocity_scale = healthy.velocity_rms;
  model.torque_scale = healthy.torque_largest;
  model.torque_jump = healthy.torque_jump;
  model.repeat_share = healthy.repeat_share;
  model.longest_repeat = healthy.longest_repeat;
  for (const double torque : healthy.torque_largest)
    model.noise.floor.push_back(std::max(kFloorShare * torque, kLeastFloor));
  if (identified.torque_is_held) model.noise.step_share = 0.0;
  model.inertia_scale = inertia_scale(model);
  model.priors = size_priors(model, healthy, options.priors);
  std::vector<HealthyExcerpt> pieces = excerpts(logs, options.excerpt_rows, model, options);
  const double period_s = usual_period_s(pieces);
  if (options.normal) {
    model.slow = slow_states(model, *options.normal);
    model.clock_std = kFirstClockShare * period_s;
    leave_out_differences(model, pieces, period_s);
  }
  const MatchOptions matching{identified.torque_is_held, period_s, options.threads};
  match_noise(model, pieces, matching);
  if (options.normal) learn_family(model, pieces, matching, *options.normal);
  ProcessNoise& noise = model.noise;
  noise.torque_share = std::max(options.safety * noise.torque_share, options.least_torque_share);
  noise.rest_share = std::max(options.safety * noise.rest_share, options.least_rest_share);
  noise.step_share *= options.safety;
  for (double& floor : noise.floor) floor *= options.safety;
  for (SlowState& slow : model.slow)
    if (slow.kind == SlowKind::coloured_torque) slow.day_std *= options.safety;
  if (options.normal) {
    allow_model_error(model, options.normal->model_error);
    widen_to_days(model, pieces, options.threads);
  }
  return model;
}

}  // namespace faultline

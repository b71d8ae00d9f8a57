// SPDX-License-Identifier: MIT
#include "lib/identify/days/fit_days.hpp"

#include <algorithm>
#include <utility>

#include "lib/identify/days/day_variance.hpp"
#include "lib/identify/days/draft_rows.hpp"
#include "lib/identify/days/healthy_looks.hpp"
#include "lib/identify/days/mixed_effects.hpp"
#include "lib/identify/days/payload_columns.hpp"
#include "lib/identify/days/refine_terms.hpp"
#include "lib/identify/days/work_pieces.hpp"

namespace faultline {
namespace {

// Kernel of the rows, standard deviation: the longer one for sample periods from kHighRate_s on.
constexpr double kHighRate_s = 0.005, kKernelAtHighRate_s = 0.012, kKernel_s = 0.016;
constexpr double kFinest_s = 0.002;   // between samples: the kernels see no difference to finer ones
constexpr double kSlackOfRate = 0.1;  // samples: a period is known to some per cent
constexpr double kRowKernels = 2.0;   // kernels between two rows: finer rows repeat each other
// Rounds of the fit from which something more is looked for: what comes later needs what came before.
constexpr int kSpringsFrom = 2, kFinePathsFrom = 4, kRipplesAt = 4, kRotorsFrom = 5, kRowsUntil = 6;
constexpr int kWidthsAt[] = {3, 6};  // rounds that refine the friction widths

/// Recorded samples that are averaged into one of the rows' samples.
int samples_averaged(double period_s) {
  return std::max(1, static_cast<int>(kFinest_s / period_s + kSlackOfRate));
}

/// Rows, setting and a first fit of the rigid robot.
DayDraft first_draft(std::span<LogSource* const> logs, const ParameterSpace& space,
                     const DayFitOptions& options) {
  std::vector<UniformLog> uniform = uniform_logs(logs);
  const bool without_velocity = hold_no_velocity(uniform);
  const int samples = samples_averaged(uniform.front().period_s);
  for (UniformLog& log : uniform) log = averaged(std::move(log), samples, options.torque_is_held);
  DayDraft draft;
  BalanceModel& m = draft.model;
  m.rigid = {space.chain, space.lift};
  m.payload = payload_columns(space);
  const double usual = uniform.front().period_s < kHighRate_s ? kKernelAtHighRate_s : kKernel_s;
  const double kernel = options.kernel_s > 0.0 ? options.kernel_s : usual;
  m.setting = draft_setting(uniform, kernel, options.row_s > 0.0 ? options.row_s : kRowKernels * kernel);
  m.setting.velocity_is_difference = without_velocity;
  m.setting.torque_is_held = options.torque_is_held;
  m.setting.averaged = samples;
  m.setting = with_chosen_lag_and_widths(uniform, m.rigid, m.setting);
  for (UniformLog& log : uniform) draft.days.push_back({.log = std::move(log)});
  m = with_looks(draft.days, std::move(m));
  draft = with_rows(std::move(draft));
  std::vector<BalanceRows> rows;
  for (const HealthyDay& day : draft.days) rows.push_back(day.rows);
  draft.used = rigid_columns_used(m.rigid, m.layout());
  draft.refused.assign(draft.used.size(), false);
  m.theta = plain_fit(rows, m.layout(), draft.used, m.torque_rms);
  for (int j = 0; j < m.joints() && options.springs; ++j)
    draft.used[m.layout().spring(j)] = m.rigid.chain.geometry[j].kind == AxisKind::revolute;
  return draft;
}

/// The draft with what is not linear, as far as this round may look for it, and rows to match.
DayDraft with_terms_of_round(DayDraft draft, int round, const DayFitOptions& options) {
  if (round == kWidthsAt[0] || round == kWidthsAt[1]) draft = with_refined_widths(std::move(draft));
  if (round == kRipplesAt && options.ripples) draft = with_ripples(std::move(draft));
  if (round == kSpringsFrom) draft = with_chosen_springs(std::move(draft));
  if (round >= kSpringsFrom) draft.model = with_compliance(std::move(draft.model));
  draft = with_rotors(std::move(draft), round >= kRotorsFrom);
  if (round <= kRowsUntil) draft = with_rows(std::move(draft));
  return with_day_columns(std::move(draft));
}

}  // namespace

FittedDays fit_days(std::span<LogSource* const> logs, const ParameterSpace& space,
                    const DayFitOptions& options) {
  DayDraft draft = first_draft(logs, space, options);
  Eigen::VectorXd between = first_day_variance(draft.model);
  for (int round = 0; round < options.rounds; ++round) {
    draft = with_terms_of_round(std::move(draft), round, options);
    if (round == 0 && options.pieces) draft = with_first_piece(std::move(draft));
    draft = with_piece_paths(std::move(draft), round < kFinePathsFrom);
    draft = with_noise(std::move(draft), options.filter_order);
    MixedEffects fit = fit_mixed_effects(std::move(draft), between);
    draft = std::move(fit.draft);
    between = variance_between_days(draft.model, fit.moments);
  }
  FittedDays out;
  for (const RobotWithoutDay& robot : fit_without_each_day(draft, between)) {
    BalanceModel& m = out.without.emplace_back(draft.model);
    m.theta = robot.theta;
    m.day_variance = prior_of_a_day(m, variance_between_days(m, robot.moments));
  }
  for (HealthyDay& day : draft.days) out.pieces.push_back({day.rows.time_s, std::move(day.path)});
  draft.model.day_variance = prior_of_a_day(draft.model, between);
  out.model = std::move(draft.model);
  return out;
}

}  // namespace faultline

// SPDX-License-Identifier: MIT
#include "lib/report/identification_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {
namespace {

constexpr double kSeemsToPay = 0.98;  // of the residual without a term: less looks as if it paid

constexpr double kHardlyTold = 0.03;  // share of a parameter's column that is its own

std::string parameter_row(const ParameterEstimate& e) {
  if (!e.identifiable) return fmt::format("  {:<9} not identifiable: {}\n", e.name, e.why_not);
  if (e.std == 0.0)
    return fmt::format("  {:<9} {:>12.6g}                              {} (given)\n", e.name, e.value,
                       e.unit);
  return fmt::format("  {:<9} {:>12.6g}  [{:.6g}, {:.6g}]  {}{}\n", e.name, e.value, e.ci95[0], e.ci95[1],
                     e.unit, e.meaning.empty() || e.meaning == e.name ? "" : "   = " + e.meaning);
}

std::string fit_text(const Identification& id) {
  std::string text = "fit\n";
  for (int j = 0; j < std::ssize(id.fit_r2); ++j)
    text += fmt::format(
        "  joint {}   R2 {:.5f}, held out {:.5f}; torque residual {:.4g} rms, {:.2g} ms late; noise of q "
        "{:.3g}{}\n",
        Joint::at(j), id.fit_r2[j], id.held_out_r2[j], id.residual_rms[j], 1e3 * id.torque_delay_s[j],
        id.q_noise[j], id.dq_noise.empty() ? "" : fmt::format(", of dq {:.3g}", id.dq_noise[j]));
  for (const ModelTerm& t : id.terms)
    text += fmt::format("  {:<9} {}: held-out residual of joint {} {:.4g} without, {:.4g} with it\n", t.name,
                        term_verdict(t), t.joint, t.error_before, t.error_after);
  return text + fmt::format("  condition number {:.3g}\n", id.condition_number);
}

std::string pattern_text(const Identification& id) {
  std::string text = "patterns of the torque residual, in shares of its variance\n";
  for (int j = 0; j < std::ssize(id.residual_patterns); ++j) {
    const ResidualPattern& p = id.residual_patterns[j];
    text += fmt::format("  joint {}   position {}, speed {}, torque {}, its value a window before {}\n",
                        Joint::at(j), share_text(p.position), share_text(p.speed), share_text(p.torque),
                        share_text(p.previous));
  }
  return text;
}

std::string motion_text(const Identification& id) {
  std::string text = "motion\n";
  for (int j = 0; j < std::ssize(id.excitation.joints); ++j) {
    const JointExcitation& e = id.excitation.joints[j];
    const AxisKind kind = id.space.chain.geometry[j].kind;
    text += fmt::format("  joint {}   {:.4g} to {:.4g} {}, at most {:.3g} forward and {:.3g} back {}\n",
                        Joint::at(j), e.q_low, e.q_high, position_unit(kind), e.fastest_forward,
                        e.fastest_back, velocity_unit(kind));
  }
  for (const std::string& line : excitation_lines(id)) text += "  " + line + "\n";
  return text;
}

std::string flag_line(const ParameterTrend& t) {
  const auto [low, high] =
      std::minmax_element(t.by_log.begin(), t.by_log.end(),
                          [](const LogValue& a, const LogValue& b) { return a.value < b.value; });
  std::string text =
      fmt::format("{} changes from log to log beyond chance: {:.4g} (log {}) to {:.4g} (log {}) {}", t.name,
                  low->value, low->log + 1, high->value, high->log + 1, t.unit);
  if (t.drifts)
    text += fmt::format("; it {} by {:.3g} per log [{:.3g}, {:.3g}]", t.slope > 0.0 ? "grows" : "falls",
                        std::abs(t.slope), std::abs(t.slope) - 2.0 * t.slope_std,
                        std::abs(t.slope) + 2.0 * t.slope_std);
  return text;
}

}  // namespace

std::string share_text(double share) { return std::isfinite(share) ? percent_text(share) : "-"; }

const char* term_verdict(const ModelTerm& term) {
  if (term.kept) return "is kept";
  return term.error_after < kSeemsToPay * term.error_before
             ? "is not kept, as it lowers the residual too little or not in each log"
             : "is not kept";
}

std::vector<std::string> trend_lines(const Identification& id) {
  std::vector<std::string> lines;
  for (const ParameterTrend& t : id.trends)
    if (t.flagged()) lines.push_back(flag_line(t));
  if (lines.empty() && !id.trends.empty())
    lines.push_back(
        fmt::format("no parameter changes from log to log beyond chance ({} tested)", id.trends.size()));
  return lines;
}

std::string mixture_text(const Excitation& excitation) {
  std::string text;
  for (const auto& [name, weight] : excitation.weakest) {
    const std::string size = std::abs(weight) > 0.995 ? "" : fmt::format("{:.2f} ", std::abs(weight));
    text += fmt::format("{}{}{}", text.empty() ? (weight < 0.0 ? "-" : "") : (weight < 0.0 ? " - " : " + "),
                        size, name);
  }
  return text;
}

std::vector<std::string> excitation_lines(const Identification& id) {
  std::vector<std::string> lines;
  bool hardly = false;
  for (int j = 0; j < std::ssize(id.excitation.joints); ++j)
    if (const std::string& lacks = id.excitation.joints[j].lacks; !lacks.empty())
      lines.push_back(fmt::format("joint {}: {}", Joint::at(j), lacks));
  for (const ParameterExcitation& p : id.excitation.parameters) {
    if (std::isnan(p.own))
      lines.push_back(fmt::format("{} does not show in the torque of this motion", p.name));
    if (!(p.own < kHardlyTold)) continue;
    hardly = true;
    lines.push_back(fmt::format(
        "{} is hardly distinguishable from {}: only {:.2g} of its effect on the torque is its own", p.name,
        p.mixed_with, p.own));
  }
  if (hardly)
    lines.push_back(
        fmt::format("least determined combination (each in the size of its effect on the torque): {}",
                    mixture_text(id.excitation)));
  return lines;
}

std::string identification_text(const Identification& id) {
  std::string text = fmt::format("{}: {} by {}; {}\n", shortened(id.robot.name, kLongestName),
                                 to_string(id.status), to_string(id.method), id.reason);
  text += "base parameters and friction [95 % interval]\n";
  for (const auto& e : id.base_parameters) text += parameter_row(e);
  text += "masses and lengths\n";
  for (const auto& e : id.physical_parameters) text += parameter_row(e);
  text += fit_text(id) + pattern_text(id) + motion_text(id);
  if (const std::vector<std::string> lines = trend_lines(id); !lines.empty()) {
    text += "from log to log\n";
    for (const std::string& line : lines) text += "  " + line + "\n";
  }
  for (const auto& log : id.logs)
    text += fmt::format("log {}: {} rows, sample period {:.6g} s\n", brief(log.path), log.rows,
                        log.sample_period_s);
  for (const auto& issue : id.issues.all())
    text += fmt::format("{}: {} ({} times)\n", to_string(issue.severity), issue.message, issue.count);
  return text;
}

}  // namespace faultline

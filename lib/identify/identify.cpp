// SPDX-License-Identifier: MIT
#include "lib/identify/identify.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/core/error.hpp"
#include "lib/core/issue.hpp"
#include "lib/identify/fit_alike.hpp"
#include "lib/identify/parameter_table.hpp"
#include "lib/identify/physical.hpp"
#include "lib/identify/verdict/fit_verdict.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {
namespace {

constexpr double kContradicts = 5.0;   // standard errors beyond which facts contradict the base parameters
constexpr int kMostRounds = 3;         // fits, each at the lengths that the previous fit found
constexpr double kOtherGuess = 0.05;   // relative change of a guessed length that needs another fit
constexpr double kSameRate = 0.02;     // relative, between the sample periods of two logs
constexpr double kOtherLength = 3e-3;  // relative change of a length: less changes no torque measurably

/// Whether the same base parameters give other torques at other lengths.
bool depends_on_lengths(const ParameterSpace& a, const ParameterSpace& b) {
  const Eigen::VectorXd ones = Eigen::VectorXd::LinSpaced(a.count(), 1.0, 2.0);
  const Eigen::VectorXd same = parameters_of(b, chain_from(a, ones), 0.0);
  return (same - ones).head(a.rigid()).cwiseAbs().maxCoeff() > 1e-6;
}

Issue contradiction_issue(double ratio) {
  return make_issue(
      "lengths_contradict", Severity::warning,
      fmt::format(
          "no masses of the links fit the base parameters at these lengths: they deviate by {:.0f} standard "
          "errors, and the intervals of m and l are wider by this factor. Check whether a length is wrong, a "
          "rotor is not stated (rotor_inertia), or a link is neither rod nor point mass",
          ratio));
}

bool differ(const PhysicalFit& physical, const std::vector<double>& used) {
  const double alike = physical.guessed_lengths.empty() ? kOtherLength : kOtherGuess;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (std::abs(physical.lengths[i] - used[i]) > alike * std::abs(physical.lengths[i])) return true;
  return false;
}

Issue guess_issue(const std::vector<std::string>& lengths) {
  return make_issue(
      "lengths_guessed", Severity::note,
      fmt::format(
          "the logs do not determine {}; the position of the tip and of a tool on it assumes the values that "
          "positive masses make likely: state them under [known] if that position matters",
          fmt::join(lengths, ", ")));
}

/// Returns `poorly_excited` if a converged fit hardly determines masses or lengths.
std::optional<FitStatus> hardly_determined(const PhysicalFit& physical, IdentificationStatus status) {
  if (physical.hardly_identifiable.empty() || status != IdentificationStatus::converged) return std::nullopt;
  return FitStatus{
      IdentificationStatus::poorly_excited,
      fmt::format("these motions hardly determine {}", fmt::join(physical.hardly_identifiable, ", "))};
}

/// An identification, and the lengths to fit again with, if any.
struct Round {
  Identification id;
  std::optional<std::vector<double>> lengths;
};

/// Returns the identification in the parameter space on the lengths of the links that were found, or with
/// these lengths if the base parameters need another fit with them.
Round with_sizes(const PhysicalFit& physical, Identification id) {
  Robot sized = id.robot;
  sized.chain.length = physical.lengths;
  ParameterSpace space = parameter_space(sized);
  space.extra = id.space.extra;
  space.chain.friction = id.space.chain.friction;  // its shape is not in the base parameters
  space.chain.ripples = id.space.chain.ripples;
  space.chain.shared_drives = id.space.chain.shared_drives;
  const bool same_base = space.base.size() == id.space.base.size() && !depends_on_lengths(id.space, space);
  Round out{std::move(id), {}};
  if (same_base)
    out.id.space = std::move(space);
  else if (differ(physical, out.id.robot.chain.length))
    out.lengths = physical.lengths;
  return out;
}

/// Logs that carry the same mass at the tip.
struct PayloadGroup {
  KnownValue payload;
  std::vector<LogSource*> logs;
  std::vector<std::size_t> index;  ///< of each log among all
};

/// Groups logs by robot.payloads, those without payload first. Throws Error(input) if every log carries one.
std::vector<PayloadGroup> group_by_payload(std::span<LogSource* const> logs, const Robot& robot) {
  std::map<std::pair<double, double>, PayloadGroup> groups;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const std::string file = std::filesystem::path(logs[i]->identity().path).filename().string();
    const auto it = robot.payloads.find(file);
    const KnownValue payload = it == robot.payloads.end() ? KnownValue{} : it->second;
    PayloadGroup& group = groups[{payload.value, payload.std}];
    group.payload = payload;
    group.logs.push_back(logs[i]);
    group.index.push_back(i);
  }
  std::vector<PayloadGroup> out;
  for (auto& [key, group] : groups) out.push_back(std::move(group));
  std::stable_partition(out.begin(), out.end(), [](const auto& g) { return g.payload.value == 0.0; });
  if (!out.empty() && out[0].payload.value != 0.0)
    throw Error(ErrorCode::input, logs[0]->identity().path,
                "carries a payload, as every log given does; give at least one log without payload");
  return out;
}

/// Returns all logs, with those of a payload group in their places.
std::vector<IdentifiedLog> with_logs(std::vector<IdentifiedLog> all, const std::vector<IdentifiedLog>& from,
                                     const PayloadGroup& group) {
  for (std::size_t k = 0; k < from.size(); ++k) {
    all[group.index[k]] = from[k];
    all[group.index[k]].payload_kg = group.payload.value;
  }
  return all;
}

/// Renumbers the logs of curves and trends by the order of all logs, not of their payload group.
Identification renumbered(const PayloadGroup& group, Identification id) {
  const auto number = [&](int& log) { log = static_cast<int>(group.index[log]); };
  for (JointFit& fit : id.joint_fits)
    for (int& log : fit.log) number(log);
  for (ParameterTrend& trend : id.trends)
    for (LogValue& value : trend.by_log) number(value.log);
  return id;
}

Issue payload_issue(const Identification& loaded, double payload) {
  return make_issue("payload_logs", Severity::note,
                    fmt::format("the logs with {:g} kg at the tip are {}: {}", payload,
                                to_string(loaded.status), loaded.reason));
}

/// Returns an issue if logs differ in sample period: the noise of the model then belongs to neither rate.
std::optional<Issue> rates_issue(const std::vector<IdentifiedLog>& logs) {
  const auto [shortest, longest] = std::minmax_element(
      logs.begin(), logs.end(),
      [](const IdentifiedLog& a, const IdentifiedLog& b) { return a.sample_period_s < b.sample_period_s; });
  if (shortest == longest || longest->sample_period_s <= (1.0 + kSameRate) * shortest->sample_period_s)
    return std::nullopt;
  return make_issue(
      "rates_differ", Severity::warning,
      fmt::format(
          "the logs have different sample periods, from {:.4g} s ({}) to {:.4g} s ({}): the noise that "
          "is estimated from them belongs to neither rate. Use logs of one rate, the rate of the logs to "
          "be diagnosed",
          shortest->sample_period_s, shortest->path, longest->sample_period_s, longest->path));
}

Round fit_groups(const std::vector<PayloadGroup>& groups, std::size_t logs, const Robot& robot,
                 const IdentifyOptions& options, const Progress& progress) {
  AlikeFit unloaded = fit_alike(groups[0].logs, robot, options, progress);
  std::vector<BaseEstimate> estimates = {{unloaded.id.estimate, unloaded.id.covariance, unloaded.usable, {}}};
  Identification id = renumbered(groups[0], std::move(unloaded.id));
  id.logs = with_logs(std::vector<IdentifiedLog>(logs), id.logs, groups[0]);
  for (std::size_t g = 1; g < groups.size(); ++g) {
    const AlikeFit loaded = fit_alike(groups[g].logs, robot, options, progress);
    estimates.push_back({loaded.id.estimate, loaded.id.covariance, loaded.usable, groups[g].payload});
    id.logs = with_logs(std::move(id.logs), loaded.id.logs, groups[g]);
    id.issues.merge(loaded.id.issues);
    if (loaded.id.status != IdentificationStatus::converged)
      id.issues.add(payload_issue(loaded.id, groups[g].payload.value));
  }
  PhysicalFit physical = physical_parameters(id.robot, id.space, estimates);
  if (physical.contradiction > kContradicts) id.issues.add(contradiction_issue(physical.contradiction));
  if (!physical.guessed_lengths.empty()) id.issues.add(guess_issue(physical.guessed_lengths));
  Round round = with_sizes(physical, std::move(id));
  Identification& sized = round.id;
  sized.take(hardly_determined(physical, sized.status));
  sized.take(negative_inertia(sized));
  sized.physical_parameters = std::move(physical.parameters);
  sized.robot = robot_with(sized.robot, sized.space, sized.estimate);
  return round;
}

/// Whether lengths that the robot file does not state change the torques of given base parameters.
bool needs_lengths(const Robot& robot) {
  Robot longer = robot;
  for (int i = 0; i < std::ssize(longer.chain.length); ++i)
    if (!robot.known.contains(fmt::format("l{}", Joint::at(i)))) longer.chain.length[i] *= 1.0 + kOtherGuess;
  const ParameterSpace given = parameter_space(robot), other = parameter_space(longer);
  return given.base.size() != other.base.size() || depends_on_lengths(given, other);
}

/// Returns the lengths at which to fit first: those of the robot file, or, where torques depend on lengths
/// that it does not state, those that the torque balance finds. The motion is fitted at these alone.
std::vector<double> first_lengths(const std::vector<PayloadGroup>& groups, std::size_t logs,
                                  const Robot& robot, const IdentifyOptions& options,
                                  const Progress& progress) {
  if (options.method == IdentifyMethod::weak_form || !needs_lengths(robot)) return robot.chain.length;
  IdentifyOptions balance = options;
  balance.method = IdentifyMethod::weak_form;
  const Round round = fit_groups(groups, logs, robot, balance, progress);
  return has_fast_log(round.id) ? round.lengths.value_or(robot.chain.length) : robot.chain.length;
}

/// Keeps messages of the solver's library about singular systems off the terminal, since the result reports
/// them. Errors that end the program are still written. May be called any number of times.
void quiet_solver() {
  static const bool done = [] {
    FLAGS_minloglevel = google::GLOG_FATAL;
    return true;
  }();
  (void)done;
}

}  // namespace

void IdentifyOptions::check() const {
  const auto positive = [](const char* field, int value) {
    if (value <= 0)
      throw Error(ErrorCode::usage, field, fmt::format("is {}; expected a number above 0", value));
  };
  positive("max_rows", max_rows);
  positive("max_iterations", max_iterations);
  if (threads < 0)
    throw Error(ErrorCode::usage, "threads", fmt::format("is {}; expected 0 or more", threads));
}

Identification identify(std::span<LogSource* const> logs, const Robot& robot, const IdentifyOptions& options,
                        const Progress& progress) {
  options.check();
  quiet_solver();
  std::vector<PayloadGroup> groups = group_by_payload(logs, robot);
  if (groups.empty()) groups.emplace_back();
  Robot sized = robot;
  sized.chain.length = first_lengths(groups, logs.size(), robot, options, progress);
  Round round = fit_groups(groups, logs.size(), sized, options, progress);
  for (int k = 1; k < kMostRounds && round.lengths; ++k) {
    sized.chain.length = *round.lengths;
    round = fit_groups(groups, logs.size(), sized, options, progress);
  }
  if (std::optional<Issue> issue = rates_issue(round.id.logs)) round.id.issues.add(std::move(*issue));
  return std::move(round.id);
}

}  // namespace faultline

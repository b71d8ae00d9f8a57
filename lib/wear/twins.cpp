// SPDX-License-Identifier: MIT
#include "lib/wear/twins.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "lib/core/error.hpp"
#include "lib/core/json_values.hpp"
#include "lib/core/number_text.hpp"
#include "lib/core/statistics.hpp"
#include "lib/core/text.hpp"
#include "lib/diagnose/condition.hpp"

namespace faultline {
namespace {

constexpr std::size_t kLogsForSpread = 3;  // fewest logs that show a variance between them
constexpr int kMostJoints = 64;            // as a robot has at most

using TwinJson = nlohmann::ordered_json;

/// Mean of a series since its last change.
TwinMember twin_member(const std::string& name, const ConditionSeries& series) {
  const std::vector<SeriesPoint> points(series.points.begin() + series.trend.first, series.points.end());
  const double between = points.size() >= kLogsForSpread ? variance_between_logs(points) : 0.0;
  const WeightedSeries s = weighted(points, between);
  double weight = 0.0;
  for (const double w : s.weight) weight += w;
  return {name, fit_level(s).level, std::sqrt(1.0 / weight)};
}

const ConditionSeries* series_named(const RobotWear& wear, const std::string& name) {
  for (const ConditionSeries& series : wear.series)
    if (series.name == name) return &series;
  return nullptr;
}

struct OthersOf {
  double mean = 0.0, variance = 0.0;
  double own_variance = 0.0;  ///< mean of the members' variances
};

OthersOf others_of(const std::vector<TwinMember>& members, std::size_t i) {
  OthersOf others;
  const double n = static_cast<double>(members.size()) - 1.0;
  for (std::size_t k = 0; k < members.size(); ++k)
    if (k != i) {
      others.mean += members[k].value / n;
      others.own_variance += members[k].std * members[k].std / n;
    }
  for (std::size_t k = 0; k < members.size(); ++k)
    if (k != i) {
      const double from_mean = members[k].value - others.mean;
      others.variance += from_mean * from_mean / (n - 1.0);
    }
  return others;
}

/// Keeps comparisons of enough members and finds who stands out in them.
TwinReport judged(std::vector<TwinComparison> all, const std::string& what, std::size_t most) {
  TwinReport report;
  std::erase_if(all, [](const TwinComparison& c) { return c.members.size() < kFewestTwins; });
  report.comparisons = std::move(all);
  if (report.comparisons.empty())
    report.not_applicable = fmt::format("{} with the same item of the condition, {} are needed",
                                        counted(static_cast<long long>(most), what), kFewestTwins);
  for (TwinComparison& comparison : report.comparisons)
    comparison.outliers =
        twin_outliers(comparison.members, kTwinFalseAlarms / static_cast<double>(report.comparisons.size()));
  return report;
}

std::size_t most_members(const std::vector<TwinComparison>& all) {
  std::size_t most = 0;
  for (const TwinComparison& comparison : all) most = std::max(most, comparison.members.size());
  return most;
}

}  // namespace

std::vector<TwinOutlier> twin_outliers(const std::vector<TwinMember>& members, double false_alarms) {
  std::vector<TwinOutlier> outliers;
  if (members.size() < kFewestTwins) return outliers;
  const double n = static_cast<double>(members.size());
  for (std::size_t i = 0; i < members.size(); ++i) {
    const OthersOf others = others_of(members, i);
    const double difference = members[i].value - others.mean;
    const double own = members[i].std * members[i].std + others.own_variance / (n - 1.0);
    const double variance = std::max(others.variance * (1.0 + 1.0 / (n - 1.0)), own);
    if (!(variance > 0.0)) continue;
    const double p = std::min(
        n * student_tail(difference / std::sqrt(variance), static_cast<int>(members.size()) - 2), 1.0);
    if (p < false_alarms) outliers.push_back({i, difference, std::sqrt(others.variance), p});
  }
  return outliers;
}

TwinReport compare_robots(const std::vector<RobotWear>& robots) {
  std::map<std::string, TwinComparison> all;
  for (const RobotWear& robot : robots)
    for (const ConditionSeries& series : robot.series) {
      TwinComparison& comparison = all[series.name];
      comparison.what = series.what;
      comparison.unit = series.unit;
      comparison.members.push_back(twin_member(robot.robot, series));
    }
  std::vector<TwinComparison> comparisons;
  for (auto& [name, comparison] : all) comparisons.push_back(std::move(comparison));
  const std::size_t most = most_members(comparisons);
  return judged(std::move(comparisons), "robot", most);
}

TwinReport compare_joints(const std::vector<RobotWear>& robots, const std::vector<JointPair>& pairs) {
  std::vector<TwinComparison> all;
  for (const DayEffectKind kind : {DayEffectKind::friction, DayEffectKind::torque_gain}) {
    TwinComparison comparison{
        kind == DayEffectKind::friction ? "friction of pairs of joints" : "drive torque of pairs of joints",
        "%",
        {},
        {}};
    for (const RobotWear& robot : robots)
      for (const auto& [first, second] : pairs) {
        const ConditionSeries* a = series_named(robot, fmt::format("{}_{}", to_string(kind), first));
        const ConditionSeries* b = series_named(robot, fmt::format("{}_{}", to_string(kind), second));
        if (!a || !b) continue;
        const TwinMember one = twin_member("", *a), other = twin_member("", *b);
        comparison.members.push_back({fmt::format("{}, joint {} minus joint {}", robot.robot, first, second),
                                      one.value - other.value,
                                      std::sqrt(one.std * one.std + other.std * other.std)});
      }
    all.push_back(std::move(comparison));
  }
  const std::size_t most = most_members(all);
  return judged(std::move(all), "pair", most);
}

std::vector<JointPair> joint_pairs(const std::string& text, const std::string& option) {
  std::vector<JointPair> pairs;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    int first = 0, second = 0;
    char rest = 0;
    if (std::sscanf(part.c_str(), "%d:%d%c", &first, &second, &rest) != 2 || first < 1 || second < 1 ||
        first == second || std::max(first, second) > kMostJoints)
      throw Error(ErrorCode::usage, option + " " + text,
                  "is not a list of pairs of joints, counted from 1, such as 1:4,2:5");
    pairs.push_back({Joint::numbered(first), Joint::numbered(second)});
  }
  return pairs;
}

std::string outlier_words(const TwinComparison& comparison, const TwinOutlier& outlier) {
  return fmt::format("{}: {} is {} beside the mean of the {} others, which scatter by {} {}", comparison.what,
                     shortened(comparison.members[outlier.member].name, 2 * kLongestName),
                     condition_value_text(outlier.difference, comparison.unit), comparison.members.size() - 1,
                     value_text(outlier.spread), comparison.unit);
}

std::string to_text(const TwinReport& report) {
  std::string text;
  for (const TwinComparison& comparison : report.comparisons)
    for (const TwinOutlier& outlier : comparison.outliers)
      text += "  stands out: " + outlier_words(comparison, outlier) + "\n";
  return text;
}

nlohmann::ordered_json to_json(const TwinReport& report) {
  return {{"not_applicable", text_or_null(report.not_applicable)},
          {"false_alarms", kTwinFalseAlarms},
          {"comparisons", list_of<TwinJson>(report.comparisons, [](const TwinComparison& c) {
             return TwinJson{{"what", c.what},
                             {"unit", c.unit},
                             {"members", list_of<TwinJson>(c.members,
                                                           [](const TwinMember& m) {
                                                             return TwinJson{
                                                                 {"name", m.name},
                                                                 {"value", number_or_null(m.value)},
                                                                 {"std", number_or_null(m.std)}};
                                                           })},
                             {"stand_out", list_of<TwinJson>(c.outliers, [&c](const TwinOutlier& o) {
                                return TwinJson{{"name", c.members[o.member].name},
                                                {"difference", number_or_null(o.difference)},
                                                {"spread", number_or_null(o.spread)},
                                                {"p", number_or_null(o.p)}};
                              })}};
           })}};
}

std::string twins_html(const TwinReport& report) {
  if (!report.not_applicable.empty())
    return "<p>Not applicable: " + escaped_markup(report.not_applicable) + ".</p>\n";
  std::string text;
  for (const TwinComparison& comparison : report.comparisons)
    for (const TwinOutlier& outlier : comparison.outliers)
      text += "<li>" + escaped_markup(printable(outlier_words(comparison, outlier))) + "</li>\n";
  return text.empty() ? "<p>None stands out from the others beyond chance.</p>\n"
                      : "<ul>\n" + text + "</ul>\n";
}

}  // namespace faultline

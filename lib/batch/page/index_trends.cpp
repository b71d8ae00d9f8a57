// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "lib/batch/page/index_page.hpp"
#include "lib/core/statistics.hpp"
#include "lib/core/text.hpp"
#include "lib/explain/day/day_effects.hpp"
#include "lib/report/plot/line_plot.hpp"
#include "lib/wear/robot_wear.hpp"

namespace faultline {
namespace {

constexpr std::size_t kPoints = 300;  // of a curve, at most
constexpr int kJoints = 6;            // curves in one panel
constexpr std::size_t kFolders = 6;   // likewise

bool is_judged(const BatchRow& row) { return row.verdict == "healthy" || row.verdict == "faulty"; }

std::vector<const BatchRow*> judged_in_order(const std::vector<BatchRow>& rows, bool& by_time) {
  std::vector<const BatchRow*> judged;
  for (const BatchRow& row : rows)
    if (is_judged(row)) judged.push_back(&row);
  by_time = all_have_dates(rows);
  if (by_time)
    std::stable_sort(judged.begin(), judged.end(),
                     [](const BatchRow* a, const BatchRow* b) { return a->start_s < b->start_s; });
  return judged;
}

/// One number a log as a curve: the largest of the logs that share a point, or their sum.
template <typename Value>
PlotSeries curve(const std::string& name, const std::vector<const BatchRow*>& rows, bool sum, Value value) {
  const std::size_t share = (rows.size() + kPoints - 1) / kPoints;
  PlotSeries series{name, {}, {}, rows.size() <= 60};
  for (std::size_t begin = 0; begin < rows.size(); begin += share) {
    const std::size_t end = std::min(begin + share, rows.size());
    double all = std::nan("");
    for (std::size_t i = begin; i < end; ++i) {
      const double one = value(*rows[i]);
      if (std::isnan(one)) continue;
      all = std::isnan(all) ? one : sum ? all + one : std::max(all, one);
    }
    series.x.push_back(static_cast<double>(begin + end + 1) / 2.0);
    series.y.push_back(all);
  }
  return series;
}

double nth(const std::vector<double>& values, int i) {
  return i < std::ssize(values) ? values[static_cast<std::size_t>(i)] : std::nan("");
}

/// Residual level by folder, on the same axis as the other panels; only for a few folders.
PlotPanel folder_panel(const std::vector<const BatchRow*>& judged) {
  PlotPanel panel{"residual by folder", {}, true};
  std::set<std::string> folders;
  for (const BatchRow* row : judged) folders.insert(folder_of(*row));
  if (folders.size() < 2 || folders.size() > kFolders) return panel;
  for (const std::string& folder : folders)
    panel.series.push_back(curve(
        printable(folder.empty() ? "(files)" : folder), judged, false,
        [&](const BatchRow& row) { return folder_of(row) == folder ? residual_level(row) : std::nan(""); }));
  return panel;
}

double value_in(const std::vector<ParameterValue>& values, const std::string& name) {
  const ParameterValue* value = find_value(values, name);
  return value ? value->value : std::nan("");
}

/// Friction of each joint against the robot that was identified.
PlotPanel condition_panel(const std::vector<const BatchRow*>& judged, int joints) {
  PlotPanel panel{"friction, % from identified", {}};
  for (int j = 0; j < std::min(joints, kJoints); ++j) {
    const std::string name = fmt::format("{}_{}", to_string(DayEffectKind::friction), Joint::at(j));
    PlotSeries series = curve(fmt::format("joint {}", Joint::at(j)), judged, false,
                              [&](const BatchRow& row) { return value_in(row.condition, name); });
    if (std::any_of(series.y.begin(), series.y.end(), [](double y) { return std::isfinite(y); }))
      panel.series.push_back(std::move(series));
  }
  return panel;
}

/// Parameters of inertia and friction as changes from their median over all logs; those near zero have no
/// such share and are left out.
PlotPanel parameter_panel(const std::vector<const BatchRow*>& judged) {
  PlotPanel panel{"parameter, % from median", {}};
  std::map<std::string, std::vector<double>> found;
  std::vector<std::string> names;
  for (const BatchRow* row : judged)
    for (const ParameterValue& p : row->parameters) {
      if (found[p.name].empty()) names.push_back(p.name);
      if (std::abs(p.value) > 3.0 * p.std) found[p.name].push_back(p.value);
    }
  for (const std::string& name : names) {
    if (found[name].size() < 2 || panel.series.size() == static_cast<std::size_t>(kJoints)) continue;
    const double usual = upper_median(found[name]);
    panel.series.push_back(curve(printable(name), judged, false, [&](const BatchRow& row) {
      return 100.0 * (value_in(row.parameters, name) / usual - 1.0);
    }));
  }
  return panel;
}

}  // namespace

bool all_have_dates(const std::vector<BatchRow>& rows) {
  return std::all_of(rows.begin(), rows.end(),
                     [](const BatchRow& row) { return !is_judged(row) || is_date(row.start_s); });
}

std::string index_trends(const std::vector<BatchRow>& rows) {
  bool by_time = false;
  const auto judged = judged_in_order(rows, by_time);
  if (judged.size() < 2) return "";
  int joints = 0;
  for (const BatchRow* row : judged) joints = std::max(joints, static_cast<int>(row->residual_rms.size()));
  PlotPanel residual{"residual (1 = healthy)", {}, true};
  for (int j = 0; j < std::min(joints, kJoints); ++j)
    residual.series.push_back(curve(fmt::format("joint {}", Joint::at(j)), judged, false,
                                    [j](const BatchRow& row) { return nth(row.residual_rms, j); }));
  PlotPanel faults{"faults", {}};
  faults.series.push_back(
      curve("faults", judged, true, [](const BatchRow& row) { return double(row.faults.size()); }));
  LinePlot plot;
  plot.title = "Residual level, faults and condition from log to log";
  plot.x_label = by_time ? "judged logs in the order of their start" : "judged logs in the order of names";
  plot.panels = {residual, faults};
  if (const PlotPanel folders = folder_panel(judged); !folders.series.empty()) plot.panels.push_back(folders);
  if (PlotPanel condition = condition_panel(judged, joints); !condition.series.empty())
    plot.panels.push_back(std::move(condition));
  if (PlotPanel parameters = parameter_panel(judged); !parameters.series.empty())
    plot.panels.push_back(std::move(parameters));
  plot.id = "trends";
  return "<figure>" + render_svg(plot) + "</figure>\n";
}

}  // namespace faultline

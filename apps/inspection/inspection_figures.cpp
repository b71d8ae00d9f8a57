// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "apps/inspection/inspection.hpp"
#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/log/columns/unit_fit.hpp"
#include "lib/report/html/elements.hpp"

namespace faultline {
namespace {

constexpr std::size_t kMostBands = 200;
constexpr int kWidth = 420, kPanelHeight = 130;
constexpr double kGapSteps = 3.0;

/// The channels in one picture.
struct ChannelGroup {
  std::string caption, unit;
  std::vector<const OverviewChannel*> channels;
};

std::string unit_in(const Inspection& inspection, const std::string& name) {
  for (const InspectedChannel& channel : inspection.channels)
    if (channel.summary.name == name) return channel.unit;
  return "";
}

std::vector<ChannelGroup> groups_of(const Inspection& inspection) {
  std::map<std::pair<Joint, Quantity>, ChannelGroup> joints;
  std::vector<ChannelGroup> others;
  for (const OverviewChannel& channel : inspection.overview.channels) {
    const auto known = channel.canonical ? canonical_channel(channel.name) : std::nullopt;
    const std::string unit = unit_in(inspection, channel.name);
    if (!known) {
      others.push_back({shortened(channel.name, kLongestName), unit, {&channel}});
      continue;
    }
    const Quantity quantity = basic_quantity(known->quantity);
    ChannelGroup& group = joints[{known->joint, quantity}];
    group.caption = fmt::format("joint {}: {}", known->joint, meaning_of(quantity));
    group.unit = unit;
    group.channels.push_back(&channel);
  }
  std::vector<ChannelGroup> all;
  for (auto& [place, group] : joints) all.push_back(std::move(group));
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

/// Returns least and largest value of each stretch, interrupted at gaps.
PlotSeries series_of(const OverviewChannel& channel, const Inspection& inspection, double zero_s) {
  const LogOverview& overview = inspection.overview;
  PlotSeries series;
  series.name = channel.name;
  const auto put = [&](double t, double value) {
    series.x.push_back(t - zero_s);
    series.y.push_back(value);
  };
  for (std::size_t i = 0; i < overview.from_s.size(); ++i) {
    const double low = channel.low[i], high = channel.high[i], from = overview.from_s[i];
    if (i > 0 && from - overview.to_s[i - 1] > kGapSteps * inspection.quality.time.period_s)
      put(from, std::nan(""));
    if (low == high || std::isnan(low)) {
      put(0.5 * (from + overview.to_s[i]), low);
    } else {
      put(from, low);
      put(overview.to_s[i], high);
    }
  }
  return series;
}

std::vector<PlotBand> bands_of(const Inspection& inspection, double zero_s) {
  std::vector<PlotBand> bands;
  for (const TimeGap& gap : inspection.quality.time.listed_gaps)
    if (bands.size() < kMostBands)
      bands.push_back({gap.start_s - zero_s, gap.start_s + gap.length_s - zero_s});
  return bands;
}

/// Returns the stretches in which one of the channels was constant although its joint moved.
std::vector<PlotBand> stuck_bands(const Inspection& inspection, const ChannelGroup& group, double zero_s) {
  std::vector<PlotBand> bands;
  for (const OverviewChannel* channel : group.channels) {
    const ChannelCheckup* found = inspection.checkup_of(channel->name, channel->canonical);
    if (!found || !inspection.issues.find("stuck_channel", channel->name)) continue;
    const SameValue& same = found->course.while_moving;
    bands.push_back({same.start_s - zero_s, same.start_s + same.length_s - zero_s});
  }
  return bands;
}

std::vector<PlotMark> marks_of(const Inspection& inspection, double zero_s) {
  std::vector<PlotMark> marks;
  for (const PeriodChange& change : inspection.checkup.clock_changes)
    marks.push_back({change.at_s - zero_s, "new period"});
  for (const Issue& issue : inspection.issues.all())
    if (issue.rows_dropped > 0 && std::isfinite(issue.first_time_s))
      marks.push_back({issue.first_time_s - zero_s, issue.code});
  std::sort(marks.begin(), marks.end(), [](const PlotMark& a, const PlotMark& b) { return a.x < b.x; });
  return marks;
}

std::string legend(const ChannelGroup& group) {
  std::string text = "<ul class=\"legend\">";
  const bool captioned = group.channels.size() == 1 && !group.channels[0]->canonical;
  for (std::size_t i = 0; i < group.channels.size() && !captioned; ++i)
    text += legend_item(plot_pen(i), escaped_markup(shortened(group.channels[i]->name, kLongestName)));
  return text + "</ul>";
}

}  // namespace

std::string inspection_figures(const Inspection& inspection, const std::string& prefix) {
  if (inspection.overview.from_s.size() < 2) return "";
  const double zero_s = time_zero(inspection.overview.from_s.front());
  LinePlot plot{"", zero_s == 0.0 ? "time, s" : fmt::format("time, s after {:.0f} s", zero_s), {}, {}};
  plot.marks = marks_of(inspection, zero_s);
  plot.width = kWidth;
  plot.panel_height = kPanelHeight;
  plot.captions = false;
  const std::vector<PlotBand> gaps = bands_of(inspection, zero_s);
  std::string text = "<div class=\"plots\">\n";
  int number = 0;
  for (const ChannelGroup& group : groups_of(inspection)) {
    plot.title = group.caption;
    plot.id = fmt::format("{}{}-", prefix, ++number);
    plot.panels = {PlotPanel{"", {}, false, {}}};
    for (const OverviewChannel* channel : group.channels)
      plot.panels[0].series.push_back(series_of(*channel, inspection, zero_s));
    plot.bands = stuck_bands(inspection, group, zero_s);
    plot.bands.insert(plot.bands.end(), gaps.begin(), gaps.end());
    const std::string unit = group.unit.empty() ? "" : " <small>(" + escaped_markup(group.unit) + ")</small>";
    text += fmt::format("<figure><figcaption>{}{}</figcaption>\n{}\n<div class=\"still\">{}</div></figure>\n",
                        escaped_markup(group.caption), unit, legend(group), render_svg(plot));
  }
  text += "</div>\n";
  if (inspection.overview.channels_left_out > 0)
    text += fmt::format("<p class=\"sub\">{} more columns are not drawn.</p>\n",
                        inspection.overview.channels_left_out);
  return text;
}

}  // namespace faultline

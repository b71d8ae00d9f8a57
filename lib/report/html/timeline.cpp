// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/diagnose/fault_event.hpp"
#include "lib/fault/fault_catalogue.hpp"
#include "lib/report/finding_words.hpp"
#include "lib/report/html/page_figures.hpp"
#include "lib/report/plot/line_plot.hpp"

namespace faultline {
namespace {

// Along the run in per cent, the rest in px.
constexpr double kWhole = 100.0;
constexpr double kNumberRoom = 2.4;  // that a number takes on a desk, and on a phone
constexpr double kNumberRoomNarrow = 9.0;
constexpr double kEasyTarget = 9.0;  // narrower faults get more to click at
constexpr double kNearEnd = 92.0;
constexpr int kLane = 30, kAboveLanes = 6, kFoot = 24;

/// A lane for the number of each joint; lane 0 is for faults of no joint.
class Picture {
 public:
  explicit Picture(const Diagnosis& d) : d_(d) {
    axis_ = {.low = d.log.start_s - zero_s_, .high = d.log.end_s - zero_s_, .from_px = 0.0, .to_px = kWhole};
    for (const FaultFinding& f : d.faults) {
      joints_ = std::max(joints_, f.label.joint.number());
      first_lane_ = f.label.joint.is_none() ? 0 : first_lane_;
    }
  }

  std::string text() const {
    std::string html = "<div class=\"timeline\">\n<div class=\"names\">";
    for (int lane = first_lane_; lane <= joints_; ++lane)
      html += lane > 0 ? fmt::format("<span>joint {}</span>", lane) : "<span>robot</span>";
    html += fmt::format("</div>\n<svg height=\"{}\" role=\"group\" aria-label=\"Timeline of the run: {}\">\n",
                        foot() + kFoot, counted(std::ssize(d_.faults), "fault"));
    for (int lane = first_lane_; lane <= joints_; ++lane)
      html += fmt::format("<rect class=\"lane\" y=\"{}\" width=\"100%\" height=\"6\"/>\n", lane_y(lane) + 8);
    for (std::size_t i = 0; i < d_.faults.size(); ++i)
      if (std::isfinite(d_.faults[i].onset_s)) html += fault_text(d_.faults[i], room_after(i));
    return html + ticks() + "</svg>\n</div>\n";
  }

 private:
  int lane_y(int lane) const { return kAboveLanes + kLane * (lane - first_lane_); }
  int foot() const { return lane_y(joints_ + 1); }
  double place(double time_s) const { return std::clamp(axis_.px(time_s - zero_s_), 0.0, kWhole); }

  std::string described(const FaultFinding& f) const {
    const double period = d_.log.sample_period_s;
    return escaped_markup(fmt::format("Fault {}: {}; onset {}, alarm {}, end {}, confidence {}", f.id,
                                      plain_words(f.label), onset_words(f, period),
                                      clock_words(f, f.alarm_s, period), clock_words(f, f.end_s, period),
                                      percent_text(f.confidence)));
  }

  /// Between a fault's onset and the next one on its lane.
  double room_after(std::size_t i) const {
    for (std::size_t k = i + 1; k < d_.faults.size(); ++k)
      if (d_.faults[k].label.joint == d_.faults[i].label.joint && std::isfinite(d_.faults[k].onset_s))
        return place(d_.faults[k].onset_s) - place(d_.faults[i].onset_s);
    return kWhole;
  }

  static std::string bar(const char* name, double from, double to, int y, int height) {
    return fmt::format("<rect class=\"{}\" x=\"{:.2f}%\" y=\"{}\" width=\"{:.2f}%\" height=\"{}\"/>", name,
                       from, y, to - from, height);
  }

  std::string fault_text(const FaultFinding& f, double room) const {
    const int y = lane_y(std::max(f.label.joint.number(), 0));
    const double onset = place(f.onset_s), alarm = std::isfinite(f.alarm_s) ? place(f.alarm_s) : onset;
    const double end = std::max({std::isfinite(f.end_s) ? place(f.end_s) : kWhole, onset, alarm});
    std::string svg = fmt::format("<a {0} aria-label=\"{1}\">", html_fault_link(f, zero_s_), described(f));
    svg += bar("hit", onset, end, y - 3, kLane - 2);
    if (end - onset < kEasyTarget)
      svg += fmt::format(
          "<rect class=\"hit\" x=\"{:.2f}%\" y=\"{}\" width=\"28\" height=\"28\" transform=\"translate(-14)\"/>",
          0.5 * (onset + end), y - 3);
    svg += bar("before", onset, alarm, y + 5, 12) + bar("fault", alarm, end, y, 22);
    svg += fmt::format("<rect class=\"alarm\" x=\"{:.2f}%\" y=\"{}\" width=\"2.5\" height=\"26\"/>", alarm,
                       y - 2);
    if (room < kNumberRoom) return svg + "</a>\n";
    const bool after = onset < kNearEnd;
    return svg + fmt::format("<text class=\"number{}\" x=\"{:.2f}%\" dx=\"{}\" y=\"{}\"{}>{}</text></a>\n",
                             room < kNumberRoomNarrow ? " tight" : "", after ? alarm : onset, after ? 6 : -5,
                             y + 16, after ? "" : " text-anchor=\"end\"", f.id);
  }

  /// Every second one is left out on a phone.
  std::string ticks() const {
    std::string svg;
    bool minor = false;
    for (const PlotTick& tick : ticks_of(axis_, 10)) {
      const double x = axis_.px(tick.value);
      svg += fmt::format(
          "<line x1=\"{0:.2f}%\" x2=\"{0:.2f}%\" y1=\"{1}\" y2=\"{2}\"/><text class=\"tick{6}\" "
          "x=\"{0:.2f}%\" y=\"{3}\" text-anchor=\"{4}\">{5} s</text>\n",
          x, foot() - 4, foot() + 2, foot() + 18,
          x < 2.0    ? "start"
          : x > 97.0 ? "end"
                     : "middle",
          tick.text, minor ? " minor" : "");
      minor = !minor;
    }
    return svg;
  }

  const Diagnosis& d_;
  double zero_s_ = time_zero(d_.log.start_s);
  PlotAxis axis_;
  int joints_ = d_.log.joints;
  int first_lane_ = 1;
};

}  // namespace

std::string html_timeline(const Diagnosis& d) {
  const double span_s = d.log.end_s - d.log.start_s;
  return std::isfinite(span_s) && span_s > 0.0 ? Picture(d).text() : "";
}

}  // namespace faultline

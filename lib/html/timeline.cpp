// SPDX-License-Identifier: MIT
#include "lib/html/timeline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/markup.hpp"
#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/fault/fault_words.hpp"
#include "lib/html/finding.hpp"
#include "lib/plot/plot_axis.hpp"
#include "lib/report/finding_words.hpp"

namespace faultline {
namespace {

constexpr double kLeft = 70.0, kRight = 1090.0;
constexpr int kLane = 30, kTop = 6;

/// Lane 0 is for faults of no joint.
class Picture {
 public:
  explicit Picture(const Diagnosis& d) : d_(d) {
    axis_ = {
        .low = d.log.start_s - zero_s_, .high = d.log.end_s - zero_s_, .from_px = kLeft, .to_px = kRight};
    for (const FaultFinding& f : d.faults) {
      joints_ = std::max(joints_, f.label.joint);
      first_lane_ = f.label.joint > 0 ? first_lane_ : 0;
    }
  }

  std::string text() const {
    std::string svg = fmt::format(
        "<svg class=\"timeline\" viewBox=\"0 0 1100 {}\" role=\"group\" aria-label=\"Timeline of the run: "
        "{}\">\n",
        foot() + 24, counted(std::ssize(d_.faults), "fault"));
    for (int lane = first_lane_; lane <= joints_; ++lane) svg += lane_text(lane);
    for (std::size_t i = 0; i < d_.faults.size(); ++i)
      if (std::isfinite(d_.faults[i].onset_s)) svg += fault_text(d_.faults[i], room_after(i));
    return svg + ticks() + "</svg>\n";
  }

 private:
  int lane_y(int lane) const { return kTop + kLane * (lane - first_lane_); }
  int foot() const { return lane_y(joints_ + 1); }
  double x_of(double time_s) const { return std::clamp(axis_.px(time_s - zero_s_), kLeft, kRight); }

  std::string lane_text(int lane) const {
    const std::string name = lane > 0 ? fmt::format("joint {}", lane) : "robot";
    return fmt::format(
        "<text x=\"0\" y=\"{}\">{}</text><rect class=\"lane\" x=\"{}\" y=\"{}\" width=\"{}\" "
        "height=\"6\"/>\n",
        lane_y(lane) + 16, name, kLeft, lane_y(lane) + 8, kRight - kLeft);
  }

  std::string described(const FaultFinding& f) const {
    const double period = d_.log.sample_period_s;
    return escaped_markup(fmt::format("Fault {}: {}; onset {}, alarm {}, end {}, confidence {}", f.id,
                                      plain_words(f.label), time_text(f.onset_s, period),
                                      time_text(f.alarm_s, period), time_text(f.end_s, period),
                                      percent_text(f.confidence)));
  }

  /// Pixels between a fault's onset and the next one on its lane.
  double room_after(std::size_t i) const {
    for (std::size_t k = i + 1; k < d_.faults.size(); ++k)
      if (d_.faults[k].label.joint == d_.faults[i].label.joint && std::isfinite(d_.faults[k].onset_s))
        return x_of(d_.faults[k].onset_s) - x_of(d_.faults[i].onset_s);
    return kRight;
  }

  std::string fault_text(const FaultFinding& f, double room_px) const {
    const int y = lane_y(std::max(f.label.joint, 0));
    const double onset = x_of(f.onset_s), alarm = std::isfinite(f.alarm_s) ? x_of(f.alarm_s) : onset;
    const double end = std::max(std::isfinite(f.end_s) ? x_of(f.end_s) : kRight, onset + 4.0);
    const std::string words = described(f);
    std::string svg = fmt::format(
        "<a {0} aria-label=\"{1}\"><title>{1}</title><rect "
        "class=\"before\" "
        "x=\"{2:.1f}\" y=\"{3}\" width=\"{4:.1f}\" height=\"22\"/>",
        html_fault_link(f, zero_s_), words, onset, y, end - onset);
    svg += fmt::format("<rect class=\"fault\" x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"22\"/>", alarm,
                       y, std::max(end - alarm, 2.0));
    svg += fmt::format("<rect class=\"alarm\" x=\"{:.1f}\" y=\"{}\" width=\"2.5\" height=\"26\"/>",
                       std::min(alarm, kRight - 2.5), y - 2);
    if (room_px < 24.0) return svg + "</a>\n";
    const bool room = onset < kRight - 24.0;
    return svg +
           fmt::format("<text class=\"number\" x=\"{:.1f}\" y=\"{}\" text-anchor=\"{}\">{}</text></a>\n",
                       onset + (room ? 6.0 : -4.0), y + 16, room ? "start" : "end", f.id);
  }

  std::string ticks() const {
    std::string svg;
    for (const PlotTick& tick : ticks_of(axis_, 10)) {
      const double x = axis_.px(tick.value);
      svg += fmt::format(
          "<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/><text class=\"tick\" x=\"{0:.1f}\" "
          "y=\"{3}\" text-anchor=\"{4}\">{5} s</text>\n",
          x, foot() - 4, foot() + 2, foot() + 18, x > kRight - 30.0 ? "end" : "middle", tick.text);
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

// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/report/plot/line_plot.hpp"
#include "lib/report/text.hpp"

namespace faultline {
namespace {

constexpr int kLabelWidth = 10;

enum class Cell { fine, before_alarm, fault };

/// One joint's bar: what each character cell stands for, and the marks drawn over it.
struct Bar {
  std::string label;
  std::vector<Cell> cells;
  std::string marks;  ///< a character a cell, ' ' = none
};

struct Scale {
  double start_s, end_s;
  int cells;

  int cell_of(double time_s) const {
    const double share = std::clamp((time_s - start_s) / (end_s - start_s), 0.0, 1.0);
    return std::min(static_cast<int>(share * cells), cells - 1);
  }
};

char digit_of(const FaultFinding& fault) { return fault.id < 10 ? static_cast<char>('0' + fault.id) : '*'; }

void put_mark(Bar& bar, int cell, char mark) {
  int place = cell;
  while (place < std::ssize(bar.marks) && bar.marks[place] != ' ') ++place;
  if (place < std::ssize(bar.marks)) bar.marks[place] = mark;
}

void draw(Bar& bar, const FaultFinding& fault, const Scale& scale) {
  if (!std::isfinite(fault.onset_s)) return;
  const int onset = scale.cell_of(fault.onset_s);
  const int alarm = std::isfinite(fault.alarm_s) ? scale.cell_of(fault.alarm_s) : onset;
  const int end = std::isfinite(fault.end_s) ? scale.cell_of(fault.end_s) : scale.cells - 1;
  for (int i = onset; i <= end; ++i) bar.cells[i] = i < alarm ? Cell::before_alarm : Cell::fault;
  put_mark(bar, onset, digit_of(fault));
  if (std::isfinite(fault.alarm_s)) put_mark(bar, alarm, '!');
}

int joints_of(const Diagnosis& d) {
  int joints = d.log.joints;
  for (const FaultFinding& fault : d.faults) joints = std::max(joints, fault.label.joint.number());
  return joints;
}

/// By number of the joint; index 0 is the robot's bar, which is drawn only when a fault belongs to no joint.
std::vector<Bar> bars_of(const Diagnosis& d, const Scale& scale) {
  std::vector<Bar> bars;
  for (int number = 0; number <= joints_of(d); ++number)
    bars.push_back({number ? fmt::format("joint {}", number) : "robot",
                    std::vector<Cell>(scale.cells, Cell::fine), std::string(scale.cells, ' ')});
  for (const FaultFinding& fault : d.faults)
    draw(bars[std::max(fault.label.joint.number(), 0)], fault, scale);
  return bars;
}

const char* glyph(Cell cell, bool unicode) {
  switch (cell) {
    case Cell::fine:
      return unicode ? "─" : "-";
    case Cell::before_alarm:
      return unicode ? "░" : "+";
    case Cell::fault:
      return unicode ? "█" : "#";
  }
  return " ";
}

std::string rendered(const Bar& bar, const TimelineOptions& options) {
  std::string line;
  for (std::size_t i = 0; i < bar.cells.size(); ++i) {
    const bool marked = bar.marks[i] != ' ';
    const std::string text = marked ? std::string(1, bar.marks[i]) : glyph(bar.cells[i], options.unicode);
    line += bar.cells[i] == Cell::fine && !marked ? text : painted(text, Paint::bold_red, options.color);
  }
  return fmt::format("  {:<{}}{}\n", bar.label, kLabelWidth - 2, line);
}

std::string axis(const Scale& scale) {
  const double zero_s = time_zero(scale.start_s);
  const double step = tick_step(scale.end_s - scale.start_s, 6);
  std::string line(kLabelWidth + scale.cells + 12, ' ');
  std::size_t free_from = 0;
  for (double k = std::ceil(scale.start_s / step); k * step <= scale.end_s; k += 1.0) {
    const std::string label = fmt::format("{:.6g}", k * step - zero_s + 0.0);
    const std::size_t place = kLabelWidth + scale.cell_of(k * step);
    if (place < free_from || place + label.size() > static_cast<std::size_t>(kLabelWidth + scale.cells))
      continue;
    line.replace(place, label.size(), label);
    free_from = place + label.size() + 1;
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line + (zero_s != 0.0 ? fmt::format(" s after {:.0f} s\n", zero_s) : " s\n");
}

std::string legend(const Diagnosis& d, bool unicode) {
  if (d.faults.empty()) return "";
  return fmt::format("  number: onset of a fault   !: alarm   {}: before it   {}: fault   {}: none found\n",
                     glyph(Cell::before_alarm, unicode), glyph(Cell::fault, unicode),
                     glyph(Cell::fine, unicode));
}

}  // namespace

std::string render_timeline(const Diagnosis& diagnosis, const TimelineOptions& options) {
  const Scale scale{diagnosis.log.start_s, diagnosis.log.end_s,
                    std::max(options.width, 40) - kLabelWidth - 2};
  if (!(std::isfinite(scale.start_s) && std::isfinite(scale.end_s) && scale.end_s > scale.start_s)) return "";
  const std::vector<Bar> bars = bars_of(diagnosis, scale);
  std::string text;
  for (std::size_t i = 0; i < bars.size(); ++i)
    if (i > 0 || bars[0].marks.find_first_not_of(' ') != std::string::npos)
      text += rendered(bars[i], options);
  return text + axis(scale) + legend(diagnosis, options.unicode);
}

}  // namespace faultline

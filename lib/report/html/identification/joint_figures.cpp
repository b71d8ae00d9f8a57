// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lib/core/text.hpp"
#include "lib/report/html/identification/identification_page.hpp"
#include "lib/robot/chain.hpp"
#include "lib/robot/dynamics.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {
namespace {

constexpr std::size_t kSamples = 480;  // of a curve, about one a pixel
constexpr double kClose_s = 5.0;       // of the figure that looks closely
constexpr double kGapOfWindows = 4.0;  // windows without one break the curve
constexpr int kWidth = 420, kHeight = 150;

/// Windows of one log.
struct Span {
  std::size_t begin = 0, end = 0;
};

Span windows_of(const JointFit& fit, int log) {
  const auto begin = std::find(fit.log.begin(), fit.log.end(), log);
  const auto end = std::find_if(begin, fit.log.end(), [log](int l) { return l != log; });
  return {static_cast<std::size_t>(begin - fit.log.begin()), static_cast<std::size_t>(end - fit.log.begin())};
}

/// The log of which this joint's torque is explained worst.
int worst_log(const Identification& id, const JointFit& fit, int j) {
  int worst = fit.log.front();
  double least = 2.0;
  for (std::size_t i = 0; i < id.logs.size(); ++i) {
    const std::vector<double>& r2 = id.logs[i].fit_r2;
    const Span span = windows_of(fit, static_cast<int>(i));
    if (span.begin == span.end || j >= std::ssize(r2) || !(r2[j] < least)) continue;
    least = r2[j];
    worst = static_cast<int>(i);
  }
  return worst;
}

/// The windows of kClose_s in which most is left.
Span worst_seconds(const JointFit& fit, const Span& all) {
  Span best{all.begin, all.begin};
  double largest = -1.0, sum = 0.0;
  for (std::size_t begin = all.begin, end = all.begin; end < all.end; ++end) {
    sum += fit.residual(end) * fit.residual(end);
    for (; fit.time_s[end] - fit.time_s[begin] > kClose_s; ++begin)
      sum -= fit.residual(begin) * fit.residual(begin);
    if (sum > largest) largest = sum, best = {begin, end + 1};
  }
  return best;
}

/// The extremes of each group of samples, in their order.
template <typename Value>
PlotSeries curve(const std::string& name, const JointFit& fit, const Span& span, Value value) {
  PlotSeries out{.name = name, .x = {}, .y = {}};
  const std::size_t count = span.end - span.begin, group = 2 * ((count + kSamples - 1) / kSamples);
  const auto put = [&](std::size_t k) {
    if (!out.x.empty() &&
        fit.time_s[k] - out.x.back() > kGapOfWindows * fit.window_s * static_cast<double>(group)) {
      out.x.push_back(fit.time_s[k]);
      out.y.push_back(std::nan(""));
    }
    out.x.push_back(fit.time_s[k]);
    out.y.push_back(value(k));
  };
  if (count <= kSamples) {
    for (std::size_t k = span.begin; k < span.end; ++k) put(k);
    return out;
  }
  for (std::size_t begin = span.begin; begin < span.end; begin += group) {
    std::size_t low = begin, high = begin;
    for (std::size_t k = begin; k < std::min(begin + group, span.end); ++k) {
      if (value(k) < value(low)) low = k;
      if (value(k) > value(high)) high = k;
    }
    put(std::min(low, high));
    if (low != high) put(std::max(low, high));
  }
  return out;
}

LinePlot over_time(const JointFit& fit, const Span& span, const std::string& title, const char* unit,
                   const char* logged) {
  LinePlot plot = figure_plot(title, "time, s");
  plot.panels = {{.y_label = unit,
                  .series = {curve(logged, fit, span, [&](std::size_t k) { return fit.measured[k]; }),
                             curve("modelled", fit, span, [&](std::size_t k) { return fit.modelled[k]; })}},
                 {.y_label = fmt::format("residual, {}", unit),
                  .series = {curve("residual", fit, span, [&](std::size_t k) { return fit.residual(k); })}}};
  plot.panels[1].series[0].pen = 2;
  return plot;
}

constexpr std::size_t kDots = 1200;  // of a cloud
constexpr std::size_t kBins = 30;    // of the mean through it
constexpr std::size_t kFewest = 20;  // dots in a bin that has a mean
constexpr std::size_t kCurve = 400;  // points of the fitted friction

/// Moving windows of a joint, and a quantity over another.
struct Cloud {
  std::vector<double> x, y;
};

template <typename X, typename Y>
Cloud cloud_of(const JointFit& fit, X x, Y y) {
  Cloud cloud;
  for (std::size_t k = 0; k < fit.size(); ++k) {
    if (!fit.moving[k]) continue;
    cloud.x.push_back(x(k));
    cloud.y.push_back(y(k));
  }
  return cloud;
}

PlotSeries dots(const std::string& name, const Cloud& cloud) {
  PlotSeries out{.name = name, .x = {}, .y = {}, .points = true, .line = false};
  const std::size_t stride = (cloud.x.size() + kDots - 1) / kDots;
  for (std::size_t k = 0; k < cloud.x.size(); k += stride) {
    out.x.push_back(cloud.x[k]);
    out.y.push_back(cloud.y[k]);
  }
  return out;
}

/// The mean over bins of equal width.
PlotSeries mean_through(const Cloud& cloud) {
  PlotSeries out{.name = "mean", .x = {}, .y = {}};
  if (cloud.x.empty()) return out;
  const auto [low, high] = std::minmax_element(cloud.x.begin(), cloud.x.end());
  const double width = (*high - *low) / static_cast<double>(kBins);
  std::vector<double> sum(kBins, 0.0), count(kBins, 0.0);
  for (std::size_t k = 0; k < cloud.x.size() && width > 0.0; ++k) {
    const std::size_t bin = std::min(static_cast<std::size_t>((cloud.x[k] - *low) / width), kBins - 1);
    sum[bin] += cloud.y[k];
    count[bin] += 1.0;
  }
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    out.x.push_back(*low + (static_cast<double>(bin) + 0.5) * width);
    out.y.push_back(count[bin] >= kFewest ? sum[bin] / count[bin] : std::nan(""));
  }
  return out;
}

/// What is left of the torque over a quantity of the motion.
NamedPlot left_over(const Identification& id, int j, const char* quantity, const char* unit,
                    const std::vector<double>& values) {
  const JointFit& fit = id.joint_fits[j];
  const Cloud cloud = cloud_of(
      fit, [&](std::size_t k) { return values[k]; }, [&](std::size_t k) { return fit.residual(k); });
  LinePlot plot = figure_plot(fmt::format("Joint {}: torque residual over {}", Joint::at(j), quantity),
                              fmt::format("{}, {}", quantity, unit));
  plot.panels = {{.y_label = fmt::format("residual, {}", torque_unit(id.space.chain.geometry[j].kind)),
                  .series = {dots("windows", cloud), mean_through(cloud)}}};
  return {fmt::format("left-{}-{}", quantity, Joint::at(j)), plot};
}

/// The friction of the identified robot over the speeds of the logs.
PlotSeries friction_curve(const Identification& id, int j, const Cloud& cloud) {
  PlotSeries out{.name = "identified", .x = {}, .y = {}};
  if (cloud.x.empty()) return out;
  const auto [low, high] = std::minmax_element(cloud.x.begin(), cloud.x.end());
  JointVector dq = JointVector::Zero(id.space.joints());
  for (std::size_t i = 0; i <= kCurve; ++i) {
    dq[j] = *low + (*high - *low) * static_cast<double>(i) / static_cast<double>(kCurve);
    out.x.push_back(dq[j]);
    out.y.push_back(friction_torque(id.robot.chain, dq)[j]);
  }
  return out;
}

NamedPlot friction_figure(const Identification& id, int j) {
  const JointFit& fit = id.joint_fits[j];
  const AxisKind kind = id.space.chain.geometry[j].kind;
  const Cloud cloud = cloud_of(
      fit, [&](std::size_t k) { return fit.dq[k]; },
      [&](std::size_t k) { return fit.measured[k] - (fit.modelled[k] - fit.friction[k]); });
  LinePlot plot = figure_plot(fmt::format("Joint {}: friction", Joint::at(j)),
                              fmt::format("speed, {}", velocity_unit(kind)));
  plot.panels = {
      {.y_label = fmt::format("friction, {}", torque_unit(kind)),
       .series = {dots(std::string(logged_words(id.robot.log.torque)) + " minus inertia and gravity", cloud),
                  friction_curve(id, j, cloud)}}};
  return {fmt::format("friction-{}", Joint::at(j)), plot};
}

NamedPlot spectrum_figure(const Identification& id, int j) {
  const ResidualPattern& p = id.residual_patterns[j];
  LinePlot plot =
      figure_plot(fmt::format("Joint {}: spectrum of the torque residual", Joint::at(j)), "frequency, Hz");
  plot.panels = {{.y_label = fmt::format("rms, {}", torque_unit(id.space.chain.geometry[j].kind)),
                  .series = {{.name = "residual", .x = p.spectrum_hz, .y = p.spectrum}},
                  .log_y = true}};
  return {fmt::format("spectrum-{}", Joint::at(j)), plot};
}

/// Measured and modelled torque, and what is left, of the log that is explained worst: all of it, and the
/// seconds where most is left.
std::vector<NamedPlot> torque_figures(const Identification& id, int j) {
  const JointFit& fit = id.joint_fits[j];
  if (fit.size() == 0) return {};
  const AxisKind kind = id.space.chain.geometry[j].kind;
  const char* what = kind == AxisKind::revolute ? "torque" : "force";
  const char* logged = logged_words(id.robot.log.torque);
  const int log = worst_log(id, fit, j);
  const Span all = windows_of(fit, log), close = worst_seconds(fit, all);
  const std::string of_log = id.logs.size() > 1 ? fmt::format(", log {}", log + 1) : "";
  std::vector<NamedPlot> plots = {
      {fmt::format("torque-{}", Joint::at(j)),
       over_time(fit, all, fmt::format("Joint {}: {} {} and modelled{}", Joint::at(j), what, logged, of_log),
                 torque_unit(kind), logged)}};
  if (close.end - close.begin < all.end - all.begin)
    plots.push_back(
        {fmt::format("torque-close-{}", Joint::at(j)),
         over_time(fit, close, fmt::format("Joint {}: largest {} residual{}", Joint::at(j), what, of_log),
                   torque_unit(kind), logged)});
  return plots;
}

}  // namespace

LinePlot figure_plot(const std::string& title, const std::string& x_label) {
  return {.title = title,
          .x_label = x_label,
          .panels = {},
          .marks = {},
          .width = kWidth,
          .panel_height = kHeight};
}

std::vector<NamedPlot> joint_figures(const Identification& id, int j) {
  if (j >= std::ssize(id.joint_fits) || id.joint_fits[j].size() == 0) return {};
  const JointFit& fit = id.joint_fits[j];
  const AxisKind kind = id.space.chain.geometry[j].kind;
  std::vector<NamedPlot> plots = torque_figures(id, j);
  plots.push_back(friction_figure(id, j));
  plots.push_back(left_over(id, j, "position", position_unit(kind), fit.q));
  plots.push_back(left_over(id, j, "speed", velocity_unit(kind), fit.dq));
  if (!id.residual_patterns[j].spectrum.empty()) plots.push_back(spectrum_figure(id, j));
  return plots;
}

}  // namespace faultline

// SPDX-License-Identifier: MIT
#include "lib/report/html/page_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/fault/fault_catalogue.hpp"
#include "lib/robot/chain.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {
namespace {

constexpr double kTraceMargin = 0.12;  // of what is shown of the evidence, on both sides

PageFigure figure_over(const CurveWindow& window, const std::string& id, const std::vector<PlotMark>& marks) {
  PageFigure figure;
  figure.id = (window.fault_id > 0 ? fmt::format("plot-{}-", window.fault_id) : "plot-run-") + id;
  figure.fault_id = figure.group = window.fault_id;
  figure.marks = marks;
  figure.from_s = window.start_s;
  figure.to_s = window.end_s;
  return figure;
}

void add_curve(PageFigure& figure, const CurveWindow& window, const std::string& name, const std::string& key,
               const std::vector<float>& values, int pen = -1) {
  if (pen < 0) pen = static_cast<int>(figure.curves.size());
  if (!values.empty()) figure.curves.push_back({name, key, pen, &window, &values});
}

PageFigure residual_figure(const CurveWindow& window, const RunCurves& curves,
                           const std::vector<PlotMark>& marks) {
  PageFigure figure = figure_over(window, "residual", marks);
  figure.caption = "Velocity residual of each joint";
  figure.y_label = "largest magnitude, times healthy";
  figure.log_y = true;
  figure.least_y = 0.1;
  for (int j = 0; j < std::ssize(window.joints); ++j)
    add_curve(figure, window, fmt::format("joint {}", Joint::at(j)), fmt::format("r{}", Joint::at(j)),
              window.joints[j].residual);
  if (!curves.healthy_residual.empty())
    figure.limits = {{"largest in healthy logs",
                      *std::max_element(curves.healthy_residual.begin(), curves.healthy_residual.end())}};
  return figure;
}

/// Position, velocity and torque of joint j (from 0): as logged, and as the healthy robot has it.
std::vector<PageFigure> joint_figures(const CurveWindow& window, const RunCurves& curves, std::size_t j,
                                      const std::vector<PlotMark>& marks) {
  const JointCurves& joint = window.joints[j];
  const bool turns = j < curves.turns.size() && curves.turns[j];
  const AxisKind axis = turns ? AxisKind::revolute : AxisKind::prismatic;
  const std::string n = fmt::format("{}", Joint::at(static_cast<int>(j)));
  auto pair = [&](const char* id, const char* what, const char* unit, const Envelope& measured,
                  const Envelope& healthy, const char* healthy_name, const char* logged_name) {
    PageFigure figure = figure_over(window, id + n, marks);
    figure.caption = fmt::format("Joint {}: {}", n, what);
    figure.y_label = unit;
    // What was logged lies on top: where the other shows, they differ.
    add_curve(figure, window, healthy_name, fmt::format("{}{}h", id, n), healthy.values, 1);
    add_curve(figure, window, logged_name, id + n, measured.values, 0);
    return figure;
  };
  const char* predicted = curves.by_reference ? "reference" : "predicted";
  return {pair("q", "position", position_unit(axis), joint.q, joint.q_predicted, predicted, "measured"),
          pair("dq", "velocity", velocity_unit(axis), joint.dq, joint.dq_predicted, predicted, "measured"),
          pair("tau", turns ? "torque" : "force", torque_unit(axis), joint.tau, joint.tau_required,
               "needed by the healthy robot", logged_words(curves.torque))};
}

/// The evidence grows in a part of the window only: its figure shows that part, and zooms alone.
void show_trace(PageFigure& figure, const FaultFinding& fault) {
  if (fault.trace.time.empty()) return;
  const double first = std::fmin(fault.trace.time.front(), fault.onset_s), last = fault.trace.time.back();
  const double margin = kTraceMargin * (last - first);
  if (!(margin > 0.0)) return;
  figure.from_s = std::max(figure.from_s, first - margin);
  figure.to_s = std::min(figure.to_s, last + margin);
  figure.group = -figure.fault_id;
}

PageFigure evidence_figure(const FaultFinding& fault, const CurveWindow& window,
                           const std::vector<PlotMark>& marks) {
  PageFigure figure = figure_over(window, "evidence", marks);
  figure.caption = "Accumulated evidence";
  figure.y_label = "log-likelihood ratio to a healthy robot, nats";
  for (std::size_t i = 0; i < fault.trace.curves.size(); ++i) {
    const EvidenceCurve& curve = fault.trace.curves[i];
    figure.curves.push_back({plain_words(curve.label), fmt::format("e{}-{}", fault.id, i),
                             static_cast<int>(i), &window, nullptr, &fault.trace.time, &curve.ratio});
  }
  figure.limits = {{"alarm threshold", fault.trace.limit}};
  double largest = fault.trace.limit;
  for (const EvidenceCurve& curve : fault.trace.curves)
    for (const double ratio : curve.ratio) largest = std::fmax(largest, ratio);
  figure.least_y = -0.15 * largest;
  show_trace(figure, fault);
  return figure;
}

PageFigure network_figure(const CurveWindow& window, const std::vector<PlotMark>& marks) {
  PageFigure figure = figure_over(window, "networks", marks);
  figure.caption = "Outputs of both networks for each sample";
  figure.y_label = "output, 1: present";
  for (std::size_t i = 0; i < window.networks.size(); ++i) {
    const NetworkCurves& network = window.networks[i];
    const std::string what =
        network.label.kind == FaultKind::none ? "fault-free" : plain_words(network.label);
    const std::string key = fmt::format("n{}-{}", window.fault_id, i);
    add_curve(figure, window, "MLP: " + what, key + "m", network.mlp.values);
    add_curve(figure, window, "RBFN: " + what, key + "r", network.rbfn.values);
  }
  return figure;
}

/// Adds marks in the order of time.
void add_marks(std::vector<PlotMark>& marks, const std::vector<PlotMark>& more) {
  marks.insert(marks.end(), more.begin(), more.end());
  std::stable_sort(marks.begin(), marks.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
}

void keep_drawable(std::vector<PageFigure>& figures) {
  std::erase_if(figures, [](const PageFigure& figure) { return figure.curves.empty(); });
}

/// The joint to look at: the fault's own, else the one with the largest residual.
std::size_t joint_of(const FaultFinding& fault, const CurveWindow& window) {
  const Joint joint = fault.label.joint;
  if (!joint.is_none() && joint.index() < std::ssize(window.joints))
    return static_cast<std::size_t>(joint.index());
  std::size_t worst = 0;
  float largest = -1.0f;
  for (std::size_t j = 0; j < window.joints.size(); ++j)
    for (const float value : window.joints[j].residual)
      if (value > largest) largest = value, worst = j;
  return worst;
}

}  // namespace

std::vector<PageFigure> run_figures(const std::vector<FaultFinding>& faults, const RunCurves& curves,
                                    const std::vector<PlotMark>& more) {
  if (curves.empty()) return {};
  std::vector<PlotMark> marks;
  for (const FaultFinding& fault : faults)
    if (std::isfinite(fault.onset_s)) marks.push_back({fault.onset_s, fmt::format("fault {}", fault.id)});
  if (marks.size() > 30) marks.clear();  // the timeline shows them better
  add_marks(marks, more);
  std::vector<PageFigure> figures = {residual_figure(curves.whole, curves, marks)};
  for (std::size_t j = 0; j < curves.whole.joints.size(); ++j)
    for (PageFigure& figure : joint_figures(curves.whole, curves, j, marks))
      figures.push_back(std::move(figure));
  keep_drawable(figures);
  return figures;
}

std::vector<PageFigure> fault_figures(const FaultFinding& fault, const RunCurves& curves,
                                      const std::vector<PlotMark>& more) {
  const auto window = std::find_if(curves.details.begin(), curves.details.end(),
                                   [&](const CurveWindow& w) { return w.fault_id == fault.id; });
  if (window == curves.details.end()) return {};
  std::vector<PlotMark> marks;
  if (std::isfinite(fault.onset_s)) marks.push_back({fault.onset_s, "onset"});
  if (std::isfinite(fault.alarm_s)) marks.push_back({fault.alarm_s, "alarm"});
  if (std::isfinite(fault.end_s)) marks.push_back({fault.end_s, "end"});
  add_marks(marks, more);
  std::vector<PageFigure> figures = {residual_figure(*window, curves, marks),
                                     evidence_figure(fault, *window, marks)};
  if (!window->joints.empty())
    for (PageFigure& figure : joint_figures(*window, curves, joint_of(fault, *window), marks))
      figures.push_back(std::move(figure));
  figures.push_back(network_figure(*window, marks));
  keep_drawable(figures);
  return figures;
}

}  // namespace faultline

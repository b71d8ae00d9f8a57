// SPDX-License-Identifier: MIT
#include "lib/report/plot/line_plot.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace faultline {
namespace {

LinePlot one_curve(std::vector<double> y) {
  std::vector<double> x(y.size());
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = static_cast<double>(i);
  return {.title = "t",
          .x_label = "time, s",
          .panels = {{.y_label = "y", .series = {{"curve", x, y}}}},
          .marks = {}};
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
  return found;
}

TEST(LinePlot, TicksAreAtRoundValuesWithinTheAxis) {
  const PlotAxis axis{.low = -0.31, .high = 1.02};
  const auto ticks = ticks_of(axis, 5);
  ASSERT_EQ(ticks.size(), 3u);
  EXPECT_EQ(ticks[0].text, "0.0");
  EXPECT_EQ(ticks[1].text, "0.5");
  EXPECT_EQ(ticks[2].text, "1.0");
}

TEST(LinePlot, ALogarithmicAxisSpansWholePowersOfTenOfPositiveValues) {
  const std::vector<double> values = {0.0, -3.0, 0.02, 700.0};
  const PlotAxis axis = axis_over({&values}, true);
  EXPECT_DOUBLE_EQ(axis.low, 0.01);
  EXPECT_DOUBLE_EQ(axis.high, 1000.0);
  EXPECT_EQ(ticks_of(axis, 6).size(), 6u);
}

TEST(LinePlot, AMissingValueBreaksTheCurve) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(count(render_svg(one_curve({1, 2, 3, 4})), "d=\"M"), 1u);
  const std::string svg = render_svg(one_curve({1, 2, nan, 4, 5}));
  const std::size_t from = svg.find("d=\"M");
  EXPECT_EQ(count(svg.substr(from, svg.find('"', from + 3) - from), "M"), 2u);
}

TEST(LinePlot, HostileNamesAreEscaped) {
  LinePlot plot = one_curve({1, 2});
  plot.title = "</title><script>alert(1)</script>";
  plot.panels[0].series[0].name = "\"><b>";
  plot.marks = {{0.5, "<i>"}};
  const std::string svg = render_svg(plot);
  EXPECT_EQ(count(svg, "<script"), 0u);
  EXPECT_EQ(count(svg, "<b>"), 0u);
  EXPECT_EQ(count(svg, "<i>"), 0u);
}

TEST(LinePlot, TextsAtCloseMarksDoNotOverlap) {
  LinePlot plot = one_curve({1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
  plot.marks = {{5.0, "onset"}, {5.1, "alarm"}};
  EXPECT_EQ(count(render_svg(plot), "text-anchor=\"end\">onset<"), 1u);
  plot.marks = {{0.0, "onset"}, {0.1, "alarm"}};
  const std::string svg = render_svg(plot);
  auto height_of = [&](const std::string& word) {
    const std::size_t end = svg.find(">" + word + "<"), from = svg.rfind(" y=\"", end);
    return std::stod(svg.substr(from + 4));
  };
  EXPECT_GT(height_of("alarm"), height_of("onset") + 10.0);
}

TEST(LinePlot, PlotsOnOnePageHaveUniqueIds) {
  LinePlot plot = one_curve({1, 2});
  plot.id = "first-";
  EXPECT_EQ(count(render_svg(plot), "id=\"first-panel0\""), 1u);
  EXPECT_EQ(count(render_svg(plot), "url(#first-panel0)"), 1u);
}

TEST(LinePlot, AnEmptyPanelAndAConstantCurveAreDrawn) {
  LinePlot plot = one_curve({});
  EXPECT_EQ(count(render_svg(plot), "nan"), 0u);
  EXPECT_EQ(count(render_svg(one_curve({2, 2, 2})), "nan"), 0u);
  plot.panels.clear();
  EXPECT_EQ(count(render_svg(plot), "inf"), 0u);
}

}  // namespace
}  // namespace faultline

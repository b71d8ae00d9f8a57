// SPDX-License-Identifier: MIT
// What a reader does with the plots of a report: points, taps, uses the buttons, prints.
#include "tests/browser/open_report.hpp"

namespace faultline {
namespace {

double height_of_page(BrowserPage& page) { return page.evaluate("document.documentElement.scrollHeight"); }

TEST(ReportPlots, PointingShowsTheTimeAndMovesNothing) {
  SKIP_WITHOUT_CHROMIUM();
  for (const int width : {390, 1280}) {
    OpenReport report(traced_diagnosis(), {.width = width});
    report.scroll_through();
    const double before = height_of_page(report.page);
    const auto [x, y] = report.middle_of("#plot-run-q2 .live");
    report.page.move_mouse(x, y);
    const std::string time =
        report.page.evaluate("document.querySelector('#plot-run-q2 .legend .at b').textContent");
    EXPECT_NEAR(std::stod(time), 4.5, 1.2) << time << ": the middle, but for the room of the axis";
    EXPECT_TRUE(time.ends_with(" s")) << time;
    EXPECT_EQ(report.page.evaluate("document.querySelector('#plot-run-tau1 .legend .at b').textContent"),
              time);
    EXPECT_EQ(height_of_page(report.page), before) << width;
  }
}

TEST(ReportPlots, EvidenceFillsItsPlotAndZoomsAlone) {
  SKIP_WITHOUT_CHROMIUM();
  OpenReport report(traced_diagnosis());  // its evidence grows from 4.210 to 4.705 s
  const auto [from, to] = report.range_of("plot-1-evidence");
  EXPECT_GT((4.705 - 4.21) / (to - from), 0.7);
  EXPECT_LE(from, 4.21);
  EXPECT_GE(to, 4.705);
  report.page.evaluate("document.querySelector('#plot-1-evidence .live').focus()");
  report.page.press("+");
  EXPECT_LT(report.range_of("plot-1-evidence").second, to);
  EXPECT_NEAR(report.range_of("plot-1-q2").first, 3.21, 1e-9);
}

TEST(ReportPlots, ButtonsDoWhatDraggingDoes) {
  SKIP_WITHOUT_CHROMIUM();
  OpenReport report(traced_diagnosis(), {.width = 390});
  const auto press = [&](const std::string& name) {
    report.page.evaluate("document.querySelector('.tools[data-fault=\"0\"] [aria-label=\"" + name +
                         "\"]').click()");
  };
  press("Zoom in");
  const auto zoomed = report.range_of("plot-run-q2");
  EXPECT_NEAR(zoomed.second - zoomed.first, 9.999 / 2, 1e-6);
  press("Later");
  EXPECT_NEAR(report.range_of("plot-run-tau1").first, zoomed.first + 9.999 / 10, 1e-6);
  press("Earlier");
  press("Zoom out");
  EXPECT_NEAR(report.range_of("plot-run-q2").second, 9.999, 1e-9);
}

TEST(ReportPlots, TheLegendNamesTheMeaningOfTheTorque) {
  Diagnosis d = traced_diagnosis();
  ReportDetails details = example_details(d);
  const char* words[] = {"commanded", "measured", "from motor current"};
  const TorqueMeaning meanings[] = {TorqueMeaning::commanded, TorqueMeaning::measured,
                                    TorqueMeaning::current};
  for (int i = 0; i < 3; ++i) {
    details.curves.torque = meanings[i];
    const std::string page = render_html(d, details);
    const std::size_t figure = page.find("id=\"plot-run-tau1\""), end = page.find("</ul>", figure);
    EXPECT_NE(page.substr(figure, end - figure).find(std::string(words[i]) + " <b>"), std::string::npos);
  }
}

TEST(ReportPlots, AxesAreLegibleInTheDark) {
  SKIP_WITHOUT_CHROMIUM();
  OpenReport report(traced_diagnosis(), {.dark = true});
  report.scroll_through();
  EXPECT_EQ(
      report.page.evaluate("getComputedStyle(document.querySelector('.live .dygraph-axis-label')).color"),
      report.page.evaluate("getComputedStyle(document.querySelector('.sub')).color"));
}

TEST(ReportPlots, AFingerOnAPlotScrollsThePage) {
  SKIP_WITHOUT_CHROMIUM();
  OpenReport report(traced_diagnosis(), {.width = 390});
  report.middle_of("#plot-run-q2 .live");
  EXPECT_EQ(report.page.evaluate(
                "(() => { const t = document.querySelector('#plot-run-q2 canvas:last-of-type');"
                "const touch = new Touch({identifier: 1, target: t, clientX: 99, clientY: 99});"
                "return t.dispatchEvent(new TouchEvent('touchstart', {touches: [touch], targetTouches: "
                "[touch], changedTouches: [touch], bubbles: true, cancelable: true})); })()"),
            true)
      << "nothing keeps the browser from scrolling";
}

TEST(ReportPlots, TimelineTextKeepsItsSize) {
  SKIP_WITHOUT_CHROMIUM();
  for (const int width : {320, 2560}) {
    OpenReport report(traced_diagnosis(), {.width = width});
    EXPECT_GE(report.page.evaluate("document.querySelector('.timeline .tick').getBoundingClientRect().height")
                  .get<double>(),
              12.0)
        << width;
  }
}

}  // namespace
}  // namespace faultline

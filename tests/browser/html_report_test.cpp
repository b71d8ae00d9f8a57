// SPDX-License-Identifier: MIT
// The HTML report in a real browser, driven as a reader would.
#include <gtest/gtest.h>

#include "lib/core/text.hpp"
#include "tests/browser/open_report.hpp"

namespace faultline {
namespace {

const char* kRunPlot = "plot-run-q2";
const char* kOtherRunPlot = "plot-run-tau1";

TEST(HtmlInChromium, DrawsEveryPlotWithoutErrorOrRequest) {
  SKIP_WITHOUT_CHROMIUM();
  OpenReport report(traced_diagnosis());
  report.scroll_through();
  EXPECT_EQ(report.page.evaluate("document.querySelectorAll('figure').length"), 16);
  EXPECT_EQ(report.page.evaluate("document.querySelectorAll('figure.drawn canvas').length"), 2 * 16);
  EXPECT_TRUE(report.page.complaints().empty()) << report.page.complaints().front();
  ASSERT_EQ(report.page.requests().size(), 1u);
  EXPECT_EQ(report.page.requests()[0].rfind("file://", 0), 0u);
}

TEST(HtmlInChromium, PolicyForbidsTheNetwork) {
  SKIP_WITHOUT_CHROMIUM();
  OpenReport report(traced_diagnosis());
  const auto violated = report.page.evaluate(
      "new Promise(r => { document.addEventListener('securitypolicyviolation', e => "
      "r(e.effectiveDirective)); fetch('https://example.org/').catch(() => 0); })");
  EXPECT_EQ(violated, "connect-src");
  EXPECT_EQ(report.page.evaluate("new Promise(r => { const i = new Image(); i.onload = () => r('loaded');"
                                 "i.onerror = () => r('refused'); i.src = 'https://example.org/a.png'; })"),
            "refused");
}

TEST(HtmlInChromium, AClickOnTheTimelineShowsTheFaultAndZooms) {
  SKIP_WITHOUT_CHROMIUM();
  OpenReport report(traced_diagnosis());
  EXPECT_NEAR(report.range_of(kRunPlot).second, 9.999, 1e-9);
  const auto [x, y] = report.middle_of("a[data-fault=\"1\"]");
  report.page.click(x, y);
  EXPECT_EQ(report.page.evaluate("location.hash"), "#fault-1");
  report.page.evaluate("new Promise(r => setTimeout(r, 200))");
  const double top = report.page.evaluate("document.getElementById('fault-1').getBoundingClientRect().top");
  EXPECT_NEAR(top, 0.0, 300.0);
  for (const char* id : {kRunPlot, kOtherRunPlot}) {
    EXPECT_NEAR(report.range_of(id).first, 3.21, 1e-9) << id;
    EXPECT_NEAR(report.range_of(id).second, 6.21, 1e-9) << id;
  }
}

TEST(HtmlInChromium, DraggingZoomsAllPlotsOfTheGroupAndDoubleClickResets) {
  SKIP_WITHOUT_CHROMIUM();
  OpenReport report(traced_diagnosis());
  const auto [x, y] = report.middle_of("#plot-run-q2 .live");
  report.page.drag(x - 60.0, x + 60.0, y);
  const auto zoomed = report.range_of(kRunPlot);
  EXPECT_LT(zoomed.second - zoomed.first, 5.0);
  EXPECT_EQ(report.range_of(kOtherRunPlot), zoomed);
  EXPECT_NEAR(report.range_of("plot-1-q2").first, 3.21, 1e-9) << "another group";
  report.page.evaluate("document.querySelector('.tools[data-fault=\"0\"] button').click()");
  EXPECT_NEAR(report.range_of(kOtherRunPlot).second, 9.999, 1e-9);
}

TEST(HtmlInChromium, PlotsOfAGroupShareTheirCursor) {
  SKIP_WITHOUT_CHROMIUM();
  OpenReport report(traced_diagnosis());
  report.range_of(kOtherRunPlot);
  const auto [x, y] = report.middle_of("#plot-run-q2 .live");
  report.page.move_mouse(x, y);
  EXPECT_NE(report.page.evaluate("document.querySelector('#plot-run-tau1 .legend b').textContent"), "");
  EXPECT_EQ(report.page.evaluate("document.querySelector('#plot-run-tau1 .cursor').style.display"), "block");
  EXPECT_EQ(report.page.evaluate("document.querySelector('#plot-1-q2 .legend b').textContent"), "");
}

TEST(HtmlInChromium, KeyboardMovesZoomsAndResets) {
  SKIP_WITHOUT_CHROMIUM();
  OpenReport report(traced_diagnosis());
  report.range_of(kRunPlot);
  report.page.evaluate("document.querySelector('#plot-run-q2 .live').focus()");
  EXPECT_EQ(report.page.evaluate("document.activeElement.getAttribute('aria-label').includes('Arrow keys')"),
            true);
  report.page.press("+");
  const auto zoomed = report.range_of(kRunPlot);
  EXPECT_NEAR(zoomed.second - zoomed.first, 9.999 / 2, 1e-6);
  report.page.press("ArrowRight");
  EXPECT_NEAR(report.range_of(kOtherRunPlot).first, zoomed.first + 9.999 / 10, 1e-6);
  report.page.press("-");
  report.page.press("Escape");
  EXPECT_NEAR(report.range_of(kRunPlot).second, 9.999, 1e-9);
  EXPECT_NEAR(report.range_of(kRunPlot).first, 0.0, 1e-9);
}

TEST(HtmlInChromium, HostileNamesAreText) {
  SKIP_WITHOUT_CHROMIUM();
  Diagnosis d = hostile_diagnosis();
  const std::string name =
      "</script><script>window.broken=1</script><img src=x onerror=broken=1> \"'`"
      "\xe2\x80\xae\xd7\xa9\xd7\x9c\xd7\x95\xd7\x9d <!-- ${1} &amp; " +
      std::string(10000, 'x');
  d.log.path = d.model.name = d.faults[0].next_check = name;
  d.faults[0].precedents = {{1, {FaultKind::locked, 1_joint}, 0.5, name}};
  d.log.issues.add({.code = "odd", .channel = name, .message = name, .count = 1});
  OpenReport report(d);
  report.scroll_through();
  EXPECT_EQ(report.page.evaluate("typeof broken"), "undefined");
  EXPECT_EQ(report.page.evaluate("document.querySelector('h1').textContent"), printable(name))
      << "marks that turn the reading direction do not reach the page";
  EXPECT_EQ(report.page.evaluate("document.querySelectorAll('img').length"), 0);
  EXPECT_EQ(report.page.evaluate("document.querySelector('.check').textContent.includes('onerror=broken')"),
            true);
  EXPECT_EQ(report.page.evaluate("document.documentElement.scrollWidth <= innerWidth"), true);
  EXPECT_TRUE(report.page.complaints().empty()) << report.page.complaints().front();
}

TEST(HtmlInChromium, WithoutScriptThePageShowsPicturesAndTables) {
  SKIP_WITHOUT_CHROMIUM();
  OpenReport report(traced_diagnosis(), {.script = false});
  EXPECT_EQ(report.page.evaluate("document.querySelectorAll('figure.drawn').length"), 0);
  EXPECT_EQ(report.page.evaluate("[...document.querySelectorAll('figure .still svg')].filter(s => "
                                 "s.getBoundingClientRect().height > 80).length"),
            16);
  EXPECT_EQ(report.page.evaluate("[...document.querySelectorAll('figure details table')].filter(t => "
                                 "t.rows.length > 10).length"),
            16);
  EXPECT_EQ(report.page.evaluate("[...document.querySelectorAll('.live')].filter(l => "
                                 "l.getBoundingClientRect().height > 0).length"),
            0);
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
  return found;
}

TEST(HtmlInChromium, PrintsAllPlotsOnA4) {
  SKIP_WITHOUT_CHROMIUM();
  OpenReport report(traced_diagnosis());
  const std::string pdf = report.page.print();
  EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
  EXPECT_GE(count(pdf, "/Type /Page\n"), 3u);
  EXPECT_LE(count(pdf, "/Type /Page\n"), 5u) << "two plots stand side by side";
  EXPECT_EQ(report.page.evaluate("[...document.styleSheets].flatMap(s => [...s.cssRules]).some(r => r "
                                 "instanceof CSSPageRule && r.cssText.includes('counter(page)'))"),
            true)
      << "pages are numbered";
  EXPECT_EQ(count(pdf, "/MediaBox [0 0 594.95996 841.91998]"), count(pdf, "/Type /Page\n"));
  report.page.emulate_print();
  EXPECT_EQ(report.page.evaluate("[...document.querySelectorAll('figure .still')].filter(s => "
                                 "s.getBoundingClientRect().height > 80).length"),
            16);
  EXPECT_EQ(report.page.evaluate("[...document.querySelectorAll('.live, .tools, details')].filter(l => "
                                 "l.getBoundingClientRect().height > 0).length"),
            0);
}

/// Contrast of text and its ground as WCAG 2 has it; 4.5 is readable.
const char* kContrast = R"((selector => {
  const light = c => { const v = c.match(/[\d.]+/g).slice(0, 3).map(x => x / 255)
      .map(x => x <= 0.03928 ? x / 12.92 : Math.pow((x + 0.055) / 1.055, 2.4));
    return 0.2126 * v[0] + 0.7152 * v[1] + 0.0722 * v[2]; };
  const a = light(getComputedStyle(document.querySelector(selector)).color);
  const b = light(getComputedStyle(document.body).backgroundColor);
  return (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05); }))";

TEST(HtmlInChromium, TextHasEnoughContrastInLightAndDark) {
  SKIP_WITHOUT_CHROMIUM();
  for (const bool dark : {false, true}) {
    OpenReport report(traced_diagnosis(), {.dark = dark});
    const std::string ground = report.page.evaluate("getComputedStyle(document.body).backgroundColor");
    EXPECT_EQ(ground, dark ? "rgb(21, 24, 28)" : "rgb(255, 255, 255)");
    for (const std::string selector : {"h1", ".verdict", ".sub", "td", "th", "a", "summary", ".legend"}) {
      const double contrast = report.page.evaluate(kContrast + ("('" + selector + "')"));
      EXPECT_GE(contrast, 4.5) << selector << (dark ? " dark" : " light");
    }
  }
}

TEST(HtmlInChromium, EveryPlotHasANameForScreenReaders) {
  SKIP_WITHOUT_CHROMIUM();
  OpenReport report(traced_diagnosis());
  report.scroll_through();
  EXPECT_EQ(
      report.page.evaluate("[...document.querySelectorAll('.live')].filter(l => l.tabIndex === 0 && "
                           "l.getAttribute('role') && l.getAttribute('aria-label').length > 20).length"),
      16);
  EXPECT_EQ(report.page.evaluate("document.querySelector('a[data-fault]').getAttribute('aria-label')"),
            "Fault 1: joint 2 is locked; onset 4.210 s, alarm 4.217 s, end 9.999 s, confidence 96 %");
}

}  // namespace
}  // namespace faultline

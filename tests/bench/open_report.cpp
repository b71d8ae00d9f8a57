// SPDX-License-Identifier: MIT
// Opens an HTML report in Chromium and tells how long that takes; tests/bench/html_report.sh runs it.
// Usage: faultline_open_report REPORT.html [--dark] [--size WxH] [--scroll SELECTOR] [--screenshot F] [--pdf
// F]
//        faultline_open_report REPORT.html --axe AXE.MIN.JS    (tests/bench/accessibility.sh runs it)
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/support/chromium.hpp"

namespace faultline {
namespace {

void write(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// Until what the reader sees first is drawn, ms since the navigation began.
double opened_ms(BrowserPage& page) {
  return page.evaluate(
      "new Promise(r => requestAnimationFrame(() => requestAnimationFrame(() => r(performance.now()))))");
}

/// Of one zoom of all plots in sight with the keyboard, ms.
double zoomed_ms(BrowserPage& page) {
  return page.evaluate(
      "(async () => { const l = document.querySelector('.live'); if (!l) return NaN; const t = "
      "performance.now(); for (let i = 0; i < 10; ++i) { l.dispatchEvent(new KeyboardEvent('keydown', {key: "
      "i % 2 ? '-' : '+'})); await new Promise(r => requestAnimationFrame(r)); } return (performance.now() - "
      "t) / 10; })()");
}

std::string contents(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// The rules of WCAG 2, levels A and AA, that axe-core checks; what breaks one is printed.
const char* kRunAxe =
    "(async () => { for (const f of document.querySelectorAll('figure')) { f.scrollIntoView(); await new "
    "Promise(r => requestAnimationFrame(() => setTimeout(r, 10))); } scrollTo(0, 0); const r = await "
    "axe.run(document, {runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa']}); return {passes: "
    "r.passes.length, broken: r.violations.map(v => v.id + ': ' + v.help + ' (' + v.nodes.length + ', first ' "
    "+ v.nodes[0].html.slice(0, 160) + ')')}; })()";

int check_with_axe(const std::string& report, const std::string& axe) {
  BrowserPage page;
  const std::string script = contents(axe);
  int broken = 0, passed = 0;
  for (const int width : {320, 390, 768, 1280, 2560})
    for (const bool dark : {false, true}) {
      page.resize(width, 900);
      page.prefer_dark(dark);
      page.open(report);
      page.evaluate(script);
      const nlohmann::json result = page.evaluate(kRunAxe);
      passed += result.at("passes").get<int>();
      for (const nlohmann::json& rule : result.at("broken")) {
        ++broken;
        std::printf("%d px, %s: %s\n", width, dark ? "dark" : "light", rule.get<std::string>().c_str());
      }
    }
  std::printf("%s: %d violations, %d rules passed\n", report.c_str(), broken, passed);
  return broken == 0 && passed > 0 ? 0 : 1;
}

int run(const std::vector<std::string>& words) {
  BrowserOptions options;
  std::string report, screenshot, pdf, scroll, axe;
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (words[i] == "--dark")
      options.dark = true;
    else if (words[i] == "--size")
      std::sscanf(words[++i].c_str(), "%dx%d", &options.width, &options.height);
    else if (words[i] == "--scroll")
      scroll = words[++i];
    else if (words[i] == "--screenshot")
      screenshot = words[++i];
    else if (words[i] == "--axe")
      axe = words[++i];
    else if (words[i] == "--pdf")
      pdf = words[++i];
    else
      report = std::filesystem::absolute(words[i]).string();
  }
  if (!axe.empty()) return check_with_axe(report, axe);
  BrowserPage page(options);
  page.open(report);
  std::printf("opened %.0f ms", opened_ms(page));
  if (!scroll.empty())
    page.evaluate("(async () => { document.querySelector('" + scroll +
                  "').scrollIntoView(); await new Promise(r => setTimeout(r, 400)); })()");
  if (!screenshot.empty()) write(screenshot, page.screenshot());
  if (!pdf.empty()) write(pdf, page.print());
  std::printf(", zoomed %.0f ms, %zu complaints\n", zoomed_ms(page), page.complaints().size());
  for (const std::string& complaint : page.complaints()) std::printf("  %s\n", complaint.c_str());
  return page.complaints().empty() ? 0 : 1;
}

}  // namespace
}  // namespace faultline

int main(int count, char** words) {
  if (count < 2 || faultline::chromium_program().empty()) {
    std::fprintf(stderr, "open_report: name a report; Chromium is installed by apps/install.sh --tests\n");
    return 2;
  }
  return faultline::run({words, words + count});
}

// SPDX-License-Identifier: MIT
// Opens an HTML report in Chromium and tells how long that takes; tests/bench/html_report.sh runs it.
// Usage: faultline_open_report REPORT.html [--dark] [--size WxH] [--scroll SELECTOR] [--screenshot F] [--pdf
// F]
#include <cstdio>
#include <filesystem>
#include <fstream>

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

int run(const std::vector<std::string>& words) {
  BrowserOptions options;
  std::string report, screenshot, pdf, scroll;
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (words[i] == "--dark")
      options.dark = true;
    else if (words[i] == "--size")
      std::sscanf(words[++i].c_str(), "%dx%d", &options.width, &options.height);
    else if (words[i] == "--scroll")
      scroll = words[++i];
    else if (words[i] == "--screenshot")
      screenshot = words[++i];
    else if (words[i] == "--pdf")
      pdf = words[++i];
    else
      report = std::filesystem::absolute(words[i]).string();
  }
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

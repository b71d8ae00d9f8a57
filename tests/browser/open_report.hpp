// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "lib/report/html/html_report.hpp"
#include "tests/report/example_details.hpp"
#include "tests/support/chromium.hpp"
#include "tests/support/skip_unless_installed.hpp"
#include "tests/support/temporary_folder.hpp"

#define SKIP_WITHOUT_CHROMIUM() SKIP_UNLESS_INSTALLED(!chromium_program().empty(), "Chromium is missing")

namespace faultline {

/// A report in a file of its own, open in a browser.
struct OpenReport {
  explicit OpenReport(const Diagnosis& d, const BrowserOptions& options = {}) : page(options) {
    page.open(folder.write("report.html", render_html(d, example_details(d))));
  }

  /// Scrolls an element into the middle of the window and gives the middle of it.
  std::pair<double, double> middle_of(const std::string& selector) {
    const nlohmann::json at = page.evaluate(
        "(async () => { const e = document.querySelector('" + selector +
        "'); e.scrollIntoView({block: 'center', behavior: 'instant'});"
        "await new Promise(r => requestAnimationFrame(() => setTimeout(r, 50)));"
        "const b = e.getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; })()");
    return {at.at(0), at.at(1)};
  }

  /// The stretch of time that a plot shows, s.
  std::pair<double, double> range_of(const std::string& id) {
    middle_of("#" + id);
    const nlohmann::json range =
        page.evaluate("document.querySelector('#" + id + " .live').dataset.range.split(' ').map(Number)");
    return {range.at(0), range.at(1)};
  }

  /// Shows every plot that is not drawn yet.
  void scroll_through() {
    page.evaluate(
        "(async () => { for (const f of document.querySelectorAll('figure')) {"
        "if (f.querySelector('.live canvas')) continue; f.scrollIntoView();"
        "await new Promise(r => requestAnimationFrame(() => setTimeout(r, 20))); } })()");
  }

  TemporaryFolder folder;
  BrowserPage page;
};

}  // namespace faultline

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <chrono>

#include "lib/batch/page/index_page.hpp"
#include "tests/support/chromium.hpp"
#include "tests/support/temporary_folder.hpp"

#define NEEDS_CHROMIUM \
  if (chromium_program().empty()) GTEST_SKIP() << "no Chromium: bash apps/install.sh --tests installs it"

namespace faultline {
namespace {

/// Every third run faulty, every tenth unusable.
std::vector<BatchRow> rows(int count) {
  std::vector<BatchRow> made;
  for (int i = 0; i < count; ++i) {
    BatchRow row;
    row.log = "runs/robot_" + std::to_string(i % 4) + "/run_" + std::to_string(i) + ".csv";
    row.verdict = i % 10 == 9 ? "unusable" : i % 3 == 0 ? "faulty" : "healthy";
    if (row.verdict != "unusable") {
      row.result = "run-" + std::to_string(i);
      row.start_s = 0.0;
      row.end_s = 20.0;
      row.joints = 3;
      row.residual_rms = {1.0 + (i * 7 % 100) / 50.0, 1.0, 1.1};
    }
    if (row.verdict == "faulty")
      row.faults = {{{i % 2 ? FaultKind::locked : FaultKind::torque_loss, 1 + i % 3}, 8.0, 8.2, 20.0, 0.9}};
    made.push_back(row);
  }
  return made;
}

std::string page_of(const std::vector<BatchRow>& all) {
  return render_index_page(all, summary_of(all, BatchFacts{}), false);
}

const char* kShown = "[...document.querySelectorAll('#logs tbody tr')].filter(r => !r.hidden).length";

TEST(BatchIndexInChromium, SortsAndFilters) {
  NEEDS_CHROMIUM;
  const TemporaryFolder folder;
  BrowserPage page;
  page.open(folder.write("index.html", page_of(rows(60))));
  EXPECT_EQ(page.evaluate(kShown), 60);
  const auto set = [&](const char* id, const char* value) {
    page.evaluate(std::string("(() => {const e = document.getElementById('") + id + "'); e.value = '" +
                  value + "'; e.dispatchEvent(new Event('input'));})()");
  };
  set("verdict", "unusable");
  EXPECT_EQ(page.evaluate(kShown), 6);
  set("verdict", "");
  set("text", "robot_1 run_1");
  EXPECT_EQ(page.evaluate(kShown), 3);  // 1, 13 and 17
  set("text", "");
  set("kind", "locked");
  EXPECT_EQ(page.evaluate(kShown), 8);
  set("kind", "");
  const char* first = "document.querySelector('#logs tbody tr').cells[5].textContent";
  page.evaluate("document.querySelectorAll('#logs thead button')[5].click()");
  EXPECT_EQ(page.evaluate(first), "1.1");
  page.evaluate("document.querySelectorAll('#logs thead button')[5].click()");
  EXPECT_EQ(page.evaluate(first), "2.98");
  EXPECT_EQ(page.evaluate("document.querySelector('#logs tbody tr:last-child').cells[5].textContent"), "-");
  EXPECT_EQ(page.complaints(), std::vector<std::string>{});
  EXPECT_EQ(page.requests().size(), 1u);
}

TEST(BatchIndexInChromium, FiveThousandLogsOpenAndHostileNamesStayText) {
  NEEDS_CHROMIUM;
  auto all = rows(5000);
  all[0].log = "</script><script>document.title='taken'</script>";
  all[1].log = "<img src=http://example.com/x.png onerror=\"document.title='taken'\">";
  all[2].log = std::string(10000, 'w');
  const std::string text = page_of(all);
  EXPECT_LT(text.size(), 6'000'000u);
  const TemporaryFolder folder;
  BrowserPage page;
  const auto start = std::chrono::steady_clock::now();
  page.open(folder.write("index.html", text));
  EXPECT_EQ(page.evaluate(kShown), 5000);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_LT(seconds, 15.0) << "measured at some 1 s on a free machine";
  EXPECT_NE(page.evaluate("document.title"), "taken");
  EXPECT_EQ(page.complaints(), std::vector<std::string>{});
  EXPECT_EQ(page.requests().size(), 1u);
  RecordProperty("seconds", std::to_string(seconds));
  std::printf("5000 logs: %.1f MB, open in %.2f s\n", double(text.size()) / 1e6, seconds);
}

TEST(BatchIndexInChromium, WithoutScriptTheTableIsThere) {
  NEEDS_CHROMIUM;
  const TemporaryFolder folder;
  BrowserPage page({.script = false});
  page.open(folder.write("index.html", page_of(rows(20))));
  EXPECT_EQ(page.evaluate("document.querySelectorAll('#logs tbody tr').length"), 20);
  EXPECT_EQ(page.evaluate("getComputedStyle(document.querySelector('.tools')).display"), "none");
}

}  // namespace
}  // namespace faultline

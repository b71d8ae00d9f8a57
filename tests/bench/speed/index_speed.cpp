// SPDX-License-Identifier: MIT
// The index of a large batch: made by the writer of batches from rows of its own, and opened, filtered and
// sorted in Chromium. tests/bench/index_speed.sh runs it.
// Usage: faultline_index_speed OUT [ROWS [WIDTH]]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <random>
#include <utility>

#include "lib/batch/batch_index.hpp"
#include "tests/support/chromium.hpp"

namespace faultline {
namespace {

constexpr int kRobots = 12, kJoints = 4, kTries = 5;
constexpr double kStart = 1.75e9, kRun_s = 20.0, kEvery_s = 900.0;

/// Robot 3 wears out, every eighth run is faulty, every fortieth unusable.
BatchRow row_of(int i, std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const int robot = i % kRobots;
  BatchRow row;
  row.log = "plant/robot_" + std::to_string(robot + 1) + "/2026-" + std::to_string(100000 + i) + ".csv";
  row.model = robot < kRobots / 2 ? "palletiser" : "welder";
  row.model_sha256 = robot < kRobots / 2 ? "aa" : "bb";
  row.verdict = i % 40 == 39 ? "unusable" : i % 8 == 3 ? "faulty" : "healthy";
  if (row.verdict == "unusable") {
    row.reason = "row 17, column tau2: holds no number";
    return row;
  }
  row.result = "robot_" + std::to_string(robot + 1) + "_" + std::to_string(i) + ".csv-0123456789ab";
  row.start_s = kStart + i * kEvery_s;
  row.end_s = row.start_s + kRun_s;
  row.sample_period_s = 1e-3;
  row.rows = 20000;
  row.joints = kJoints;
  const double wear = robot == 2 ? 30.0 * i / 10000.0 : 0.0;
  for (int j = 1; j <= kJoints; ++j) {
    row.residual_rms.push_back(0.9 + 0.3 * share(random) + wear / 20.0);
    row.residual_peak.push_back(4.0 * row.residual_rms.back());
    row.condition.push_back({"friction_" + std::to_string(j), wear + 6.0 * share(random) - 3.0, 1.5, "%"});
    row.parameters.push_back({"fv" + std::to_string(j), 2.0 + wear / 50.0 + 0.1 * share(random), 0.04, ""});
  }
  if (row.verdict != "faulty") return row;
  const FaultKind kinds[] = {FaultKind::locked, FaultKind::torque_loss, FaultKind::friction_increase,
                             FaultKind::sensor_bias};
  const double onset = row.start_s + 4.0 + 10.0 * share(random);
  row.residual_rms[0] *= 8.0;
  row.faults = {
      {{kinds[i / 8 % 4], Joint::at(i % kJoints)}, onset, onset + 0.4, row.end_s, 0.6 + 0.4 * share(random)}};
  return row;
}

void write_batch(const std::string& out, int count) {
  const BatchFolder folder(out, false);
  BatchIndex index(folder, count);
  std::mt19937_64 random(1);
  for (int i = 0; i < count; ++i) {
    JournalEntry entry;
    entry.position = i;
    entry.row = row_of(i, random);
    index.put(i, std::move(entry));
  }
  BatchFacts facts;
  facts.models = {{"palletiser", "aa", "a1"}, {"welder", "bb", "b1"}};
  facts.logs = count;
  index.finish(facts);
}

/// From the start of loading until `event` has come, ms: the median of several, and the least.
std::pair<double, double> opened_ms(const std::string& path, const BrowserOptions& options,
                                    const char* event) {
  std::vector<double> all;
  for (int i = 0; i < kTries; ++i) {
    BrowserPage page(options);
    page.open(path);
    all.push_back(page.evaluate(event));
  }
  std::sort(all.begin(), all.end());
  return {all[kTries / 2], all[0]};
}

constexpr const char* kFirstRows =
    "new Promise(r => { const look = () => { const [mark] = performance.getEntriesByName('first rows'); mark ? "
    "r(mark.startTime) : setTimeout(look); }; look(); })";
constexpr const char* kAllRows = "Promise.resolve(faultlineIndex.whole).then(() => performance.now())";

/// From `action` until the next frame is drawn, ms: the median of several, each after `before`.
double drawn_ms(BrowserPage& page, const std::string& before, const std::string& action, int tries = kTries) {
  std::vector<double> all;
  for (int i = 0; i < tries; ++i)
    all.push_back(page.evaluate(
        "(async (i) => { const f = (id, v) => { const e = document.getElementById(id); e.value = v; "
        "e.dispatchEvent(new Event('input')); }; const drawn = () => new Promise(r => requestAnimationFrame(() => "
        "setTimeout(r))); " +
        before + "; await drawn(); await drawn(); const t = performance.now(); " + action +
        "; await drawn(); return performance.now() - t; })(" + std::to_string(i) + ")"));
  std::sort(all.begin(), all.end());
  return all[all.size() / 2];
}

int run(const std::string& out, int count, int width) {
  write_batch(out, count);
  const std::string path = std::filesystem::absolute(out + "/index.html").string();
  BrowserOptions options;
  options.width = width;
  const auto [first, least_first] = opened_ms(path, options, kFirstRows);
  const auto [whole, least_whole] = opened_ms(path, options, kAllRows);
  BrowserPage page(options);
  page.open(path);
  page.evaluate(kAllRows);
  std::printf(
      "%d logs, %d px, %.1f MB: shows the first rows after %.0f ms (least %.0f), has all after %.0f ms (least %.0f)",
      count, width, static_cast<double>(std::filesystem::file_size(path)) / 1e6, first, least_first, whole,
      least_whole);
  std::printf(", filters in %.0f ms by text the first time, then %.0f ms, %.0f ms by kind",
              drawn_ms(page, "", "f('text', 'robot_7')", 1),
              drawn_ms(page, "", "f('text', i % 2 ? 'robot_3' : 'friction')"),
              drawn_ms(page, "f('text', '')", "f('kind', i % 2 ? 'locked' : 'torque_loss')"));
  std::printf(
      ", sorts in %.0f ms",
      drawn_ms(page, "f('kind', '')", "document.querySelector('#logs th button[data-id=residual]').click()"));
  std::printf(", zooms in %.0f ms", drawn_ms(page, "", "document.querySelector('.zoom button').click()"));
  std::printf(", %s elements, %zu complaints\n",
              page.evaluate("document.querySelectorAll('*').length").dump().c_str(),
              page.complaints().size());
  for (const std::string& complaint : page.complaints()) std::printf("  %s\n", complaint.c_str());
  return page.complaints().empty() ? 0 : 1;
}

}  // namespace
}  // namespace faultline

int main(int count, char** words) {
  if (count < 2 || faultline::chromium_program().empty()) {
    std::fprintf(stderr, "index_speed: name a folder; Chromium is installed by apps/install.sh --tests\n");
    return 2;
  }
  return faultline::run(words[1], count > 2 ? std::atoi(words[2]) : 10000,
                        count > 3 ? std::atoi(words[3]) : 1280);
}

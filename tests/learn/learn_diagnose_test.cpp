// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <nlohmann/json.hpp>

#include "lib/core/error.hpp"
#include "lib/diagnose/diagnose.hpp"
#include "lib/report/text.hpp"
#include "tests/learn/small_robot.hpp"
#include "tests/support/resealed_model.hpp"

namespace faultline {
namespace {

Log run_with(FaultKind kind, double size, std::uint64_t seed = 31) {
  SimulationSpec spec = small_run(7.0);
  if (kind != FaultKind::none)
    spec.faults = {{kind, 1_joint, 3.004, std::numeric_limits<double>::infinity(), size, 0.0}};
  return simulate(small_robot(), spec, seed).log;
}

Diagnosis diagnosed(const Learned& learned, const Log& log, int segment_rows = 4096,
                    const DiagnoseOptions& options = {}) {
  MemorySource source(log, "run.csv", segment_rows);
  return diagnose(source, learned.model, learned.cases, options);
}

TEST(LearnDiagnose, FindsFaultsAndRaisesNoFalseAlarm) {
  const Learned learned = learn_small();
  EXPECT_EQ(diagnosed(learned, run_with(FaultKind::none, 0.0)).verdict, Verdict::healthy);
  for (const FaultKind kind : {FaultKind::free_swinging, FaultKind::locked, FaultKind::payload_change}) {
    const Diagnosis diagnosis = diagnosed(learned, run_with(kind, 0.8));
    EXPECT_EQ(diagnosis.verdict, Verdict::faulty) << to_string(kind);
    ASSERT_FALSE(diagnosis.faults.empty());
    const FaultFinding& fault = diagnosis.faults.front();
    bool named = fault.label.kind == kind;
    for (const auto& other : fault.could_also_be) named = named || other.label.kind == kind;
    EXPECT_TRUE(named) << to_string(kind) << " was called " << to_string(fault.label.kind);
    EXPECT_GE(fault.alarm_s, 3.004);
    EXPECT_LT(fault.alarm_s, 3.3);
  }
}

TEST(LearnDiagnose, ThreadsAndSegmentBordersDoNotChangeTheModel) {
  LearnOptions options = quick_learning();
  options.threads = options.identify.threads = 1;
  const std::string one = model_to_json(learn_small(options).model);
  options.threads = options.identify.threads = 2;
  EXPECT_TRUE(one == model_to_json(learn_small(options, 100).model));
}

TEST(LearnDiagnose, AModelStoresTheOptionsOfItsTwin) {
  LearnOptions options = quick_learning();
  options.twin.pd_share = 0.5;
  const std::string text = model_to_json(learn_small(options).model);
  EXPECT_EQ(model_from_json(text, "model").twin, options.twin);
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(text);
  json["twin"] = {{"pd_share", "half"}};
  EXPECT_THROW(model_from_json(resealed_model_text(json), "model"), Error);
}

TEST(LearnDiagnose, RoundTripAndSegmentBordersChangeNoByte) {
  const Learned learned = learn_small();
  const std::string text = model_to_json(learned.model);
  EXPECT_EQ(text, model_to_json(model_from_json(text, "model")));
  const Log log = run_with(FaultKind::free_swinging, 0.0);
  for (const ClassifyMode mode : {ClassifyMode::evidence, ClassifyMode::samples}) {
    const std::string whole = render_json(diagnosed(learned, log, 1 << 20, {.mode = mode}));
    for (const int rows : {1, 7, 64})
      EXPECT_EQ(whole, render_json(diagnosed(learned, log, rows, {.mode = mode}))) << rows;
  }
}

TEST(LearnDiagnose, TheShareOfProgressNeverFallsAlsoWhenALogIsLeftOut) {
  const double forever = std::numeric_limits<double>::infinity();
  std::deque<MemorySource> logs;
  std::vector<LogSource*> sources;
  for (const bool is_weak : {false, true, false}) {
    SimulationSpec spec = small_run(12.0);
    if (is_weak) spec.faults = {{FaultKind::torque_loss, 1_joint, 7.0, forever, 0.4, 0.0}};
    const auto seed = 50 + static_cast<std::uint64_t>(logs.size());
    sources.push_back(
        &logs.emplace_back(simulate(small_robot(), spec, seed).log, is_weak ? "weak.csv" : "a.csv"));
  }
  std::vector<double> shares;
  const Learned learned = learn(sources, {}, unknown_small_robot(), quick_learning(),
                                [&](const std::string&, double share) { shares.push_back(share); });
  EXPECT_NE(learned.identification.issues.find("suspicious_log_2"), nullptr);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_GT(shares.size(), 10u);
}

}  // namespace
}  // namespace faultline

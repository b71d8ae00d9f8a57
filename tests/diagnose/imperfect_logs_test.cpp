// SPDX-License-Identifier: MIT
// Logs that lack rows or values, or whose clock restarts, held against the model of the golden folder: a
// robot that is logged at 13.7 Hz.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

#include "formats/open_log.hpp"
#include "lib/core/random.hpp"
#include "lib/diagnose/diagnose.hpp"
#include "lib/log/log.hpp"
#include "lib/log/log_source.hpp"
#include "lib/log/recorder/corrected_source.hpp"
#include "lib/model/model_files.hpp"
#include "lib/report/text.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

const std::filesystem::path kGolden = std::filesystem::path(FAULTLINE_SOURCE_DIR) / "sample_logs" / "golden";

ModelFiles golden_model() {
  std::string model, cases;
  for (const auto& entry : std::filesystem::directory_iterator(kGolden)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("model-")) model = entry.path().string();
    if (name.starts_with("cases-")) cases = entry.path().string();
  }
  return load_model_files(model, cases);
}

class ImperfectLogs : public testing::Test {
 protected:
  static Log read(const std::string& name) { return read_all(*open_log((kGolden / "logs" / name).string())); }

  Diagnosis diagnosed(Log log) const {
    MemorySource source(std::move(log));
    return diagnose(source, files_.model, files_.cases);
  }
  Diagnosis diagnosed_file(const std::string& path, const LogSelection& parts = {}) const {
    OpenLogOptions options;
    options.parts = parts;
    const auto source = open_log(path, options);
    return diagnose(*source, files_.model, files_.cases);
  }
  /// The log as CSV, its clock less `offset_s` from row `from` on.
  std::string written(const Log& log, const std::string& name, int from, double offset_s,
                      int end = -1) const {
    std::string text = "t,q1,q2,q3,dq1,dq2,dq3,tau1,tau2,tau3\n";
    for (int k = 0; k < (end < 0 ? log.rows() : end); ++k) {
      text += fmt::format("{}", k < from ? log.time[k] : log.time[k] - offset_s);
      for (const JointSignals* signals : {&log.q, &log.dq, &log.tau})
        for (const auto& values : *signals) text += fmt::format(",{}", values[k]);
      text += "\n";
    }
    return folder_.write(name, text);
  }

  TemporaryFolder folder_;
  ModelFiles files_ = golden_model();
};

Log without_rows(const Log& log, const std::vector<int>& lost) {
  Log out;
  for (int k = 0; k < log.rows(); ++k)
    if (!std::binary_search(lost.begin(), lost.end(), k)) append(out, slice(log, k, k + 1));
  return out;
}

void blank_row(Log& log, int row) {
  for_each_joint_channel(log, [&](std::vector<double>& values, Channel) { values[row] = std::nan(""); });
}

void blank_from(std::vector<double>& values, const Log& log, double from_s) {
  for (int k = 0; k < log.rows(); ++k)
    if (log.time[k] >= from_s) values[k] = std::nan("");
}

TEST_F(ImperfectLogs, ALostRowAndAnEmptyRowGiveTheSameVerdict) {
  const Log healthy = read("healthy_quintic.csv");
  for (int row = 10; row + 10 < healthy.rows(); row += 7) {
    Log blank = healthy;
    blank_row(blank, row);
    const Diagnosis without = diagnosed(without_rows(healthy, {row})), empty = diagnosed(blank);
    EXPECT_EQ(without.verdict, Verdict::healthy) << row << ": " << without.verdict_reason;
    EXPECT_EQ(without.verdict, empty.verdict) << row;
  }
}

TEST_F(ImperfectLogs, ThreePercentOfLostRowsNameNoFaultInHealthyLogs) {
  for (const char* name : {"healthy_quintic.csv", "healthy_trapezoidal.csv"}) {
    const Log healthy = read(name);
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      Random random(seed);
      std::vector<int> lost;
      for (int k = 1; k + 1 < healthy.rows(); ++k)
        if (random.uniform(0.0, 1.0) < 0.03) lost.push_back(k);
      const Diagnosis found = diagnosed(without_rows(healthy, lost));
      EXPECT_TRUE(found.faults.empty()) << name << ", seed " << seed;
      EXPECT_EQ(found.verdict_reason.find("the whole log"), std::string::npos) << "rows are missing";
    }
  }
}

TEST_F(ImperfectLogs, AFaultIsStillFoundAmongLostRows) {
  const Log faulty = read("torque_loss_2.csv");
  std::vector<int> lost;
  for (int k = 5; k < faulty.rows(); k += 33) lost.push_back(k);
  EXPECT_EQ(diagnosed(without_rows(faulty, lost)).verdict, Verdict::faulty);
}

TEST_F(ImperfectLogs, ALogWhoseValuesEndWithTheFaultIsNotHealthy) {
  for (const char* name :
       {"torque_loss_2.csv", "locked_1.csv", "payload_change.csv", "stuck_encoder_3.csv"}) {
    Log log = read(name);
    for_each_joint_channel(log, [&](std::vector<double>& values, Channel) { blank_from(values, log, 5.0); });
    const Diagnosis found = diagnosed(log);
    EXPECT_EQ(found.verdict, Verdict::inconclusive) << name << ": " << found.verdict_reason;
    EXPECT_NE(found.verdict_reason.find("could not be judged from"), std::string::npos)
        << found.verdict_reason;
    EXPECT_NE(found.verdict_reason.find("the end of the log"), std::string::npos) << found.verdict_reason;
    ASSERT_FALSE(found.cannot_see.empty());
    EXPECT_NE(found.cannot_see.front().find("Joint 1 could not be judged from"), std::string::npos);
  }
}

TEST_F(ImperfectLogs, ALogWhoseRecorderStopsWithTheFaultIsNotHealthy) {
  for (const char* name : {"torque_loss_2.csv", "locked_1.csv"})
    for (const bool writes_zeros : {false, true}) {
      Log log = read(name);
      const auto stop = std::lower_bound(log.time.begin(), log.time.end(), 5.0) - log.time.begin();
      for_each_joint_channel(log, [&](std::vector<double>& values, Channel) {
        std::fill(values.begin() + stop, values.end(), writes_zeros ? 0.0 : values[stop]);
      });
      MemorySource recorded(log);
      const Diagnosis found = diagnose(*corrected(recorded), files_.model, files_.cases);
      EXPECT_EQ(found.verdict, Verdict::inconclusive) << name << ": " << found.verdict_reason;
      EXPECT_NE(found.verdict_reason.find("the end of the log"), std::string::npos) << found.verdict_reason;
    }
}

TEST_F(ImperfectLogs, ALogWhoseEncoderIsSilentToTheEndIsNotHealthy) {
  for (int j = 0; j < 3; ++j) {
    Log log = read("healthy_trapezoidal.csv");
    blank_from(log.q[j], log, 6.0);
    blank_from(log.dq[j], log, 6.0);
    const Diagnosis found = diagnosed(log);
    EXPECT_EQ(found.verdict, Verdict::inconclusive) << found.verdict_reason;
    EXPECT_NE(found.verdict_reason.find(fmt::format("joint {} could not be judged", Joint::at(j))),
              std::string::npos)
        << found.verdict_reason;
    ASSERT_EQ(found.log.unjudged.size(), 1u);
    EXPECT_EQ(found.log.unjudged[0].joint, Joint::at(j));
  }
}

TEST_F(ImperfectLogs, AHealthyLogWhoseTorqueEndsIsInconclusiveAndHasNoFault) {
  for (const char* name : {"healthy_quintic.csv", "healthy_trapezoidal.csv"})
    for (double from_s = 4.5; from_s < 10.0; from_s += 0.7) {
      Log log = read(name);
      for (std::vector<double>& torque : log.tau) blank_from(torque, log, from_s);
      const Diagnosis found = diagnosed(log);
      EXPECT_TRUE(found.faults.empty()) << name << " from " << from_s;
      EXPECT_EQ(found.verdict, Verdict::inconclusive);
      EXPECT_NE(found.verdict_reason.find("its torque is missing"), std::string::npos)
          << found.verdict_reason;
    }
}

TEST_F(ImperfectLogs, AHealthyLogWithAFewEmptyRowsIsHealthyAndReportsTheRows) {
  Log log = read("healthy_trapezoidal.csv");
  for (int row = 80; row < 83; ++row) blank_row(log, row);
  const Diagnosis found = diagnosed(log);
  EXPECT_EQ(found.verdict, Verdict::healthy) << found.verdict_reason;
  EXPECT_NE(found.verdict_reason.find("3 of 165 rows"), std::string::npos) << found.verdict_reason;
}

TEST_F(ImperfectLogs, ALogWithManyScatteredUnjudgedRowsIsNotHealthy) {
  for (const char* name : {"torque_loss_2.csv", "payload_change.csv"})
    for (const bool torque_only : {false, true}) {
      Log log = read(name);
      for (int row = 0; row < log.rows(); row += 2) {
        if (!torque_only) blank_row(log, row);
        for (std::vector<double>& torque : log.tau) torque[row] = std::nan("");
      }
      const Diagnosis found = diagnosed(log);
      EXPECT_NE(found.verdict, Verdict::healthy) << name << ": " << found.verdict_reason;
      if (found.verdict == Verdict::faulty) continue;
      EXPECT_NE(found.verdict_reason.find("be judged in "), std::string::npos) << found.verdict_reason;
      ASSERT_FALSE(found.log.unjudged.empty());
      EXPECT_NE(render_json(found).find("\"share\":"), std::string::npos);
      EXPECT_NE(found.cannot_see.front().find("repeatedly"), std::string::npos);
    }
}

TEST_F(ImperfectLogs, AFaultInTheSecondRunIsFoundWithItsTimeOnThatRunsClock) {
  const Log log = read("torque_loss_2.csv");
  const Diagnosis straight = diagnosed(log);
  const int restart = 40;
  const Diagnosis found = diagnosed_file(written(log, "restarts.csv", restart, log.time[restart]));
  ASSERT_EQ(found.verdict, Verdict::faulty) << found.verdict_reason;
  ASSERT_EQ(straight.verdict, Verdict::faulty);
  const FaultFinding& fault = found.faults.front();
  EXPECT_EQ(fault.run, 2);
  EXPECT_NEAR(fault.onset_s - fault.clock_offset_s, straight.faults.front().onset_s - log.time[restart],
              0.15);
  ASSERT_EQ(found.log.runs.size(), 2u);
  EXPECT_EQ(found.log.runs[1].first_row, restart + 1);
  EXPECT_EQ(found.log.rows_read, found.log.rows_used);
  EXPECT_NE(render_json(found).find("\"runs\""), std::string::npos);
  EXPECT_NE(render_text(found, {}).find("(run 2, "), std::string::npos);
  EXPECT_NE(render_junit(found).find("(run 2, "), std::string::npos);
}

TEST_F(ImperfectLogs, AFaultEndsWithItsRunAndItsTimesAreOnTheClockOfTheRun) {
  const Log faulty = read("torque_loss_2.csv"), healthy = read("healthy_trapezoidal.csv");
  Log both = faulty;
  Log later = healthy;
  for (double& t : later.time) t += faulty.time.back() + 5.0;
  append(both, later);
  const double back_s = later.time.front();
  const Diagnosis found = diagnosed_file(written(both, "two.csv", faulty.rows(), back_s));
  ASSERT_EQ(found.log.runs.size(), 2u);
  ASSERT_FALSE(found.faults.empty());
  EXPECT_LE(found.faults.front().end_s, found.log.runs[0].end_s);
  const std::string text = render_text(found, {});
  const std::string times = text.substr(text.find("  onset "), 200);
  EXPECT_NE(times.substr(times.find("alarm"), 40).find("on its clock"), std::string::npos) << times;
  EXPECT_NE(times.substr(times.find("   end"), 40).find("on its clock"), std::string::npos) << times;
}

TEST_F(ImperfectLogs, AHealthyLogWhoseClockRestartsIsJudgedAsAWhole) {
  const Log log = read("healthy_quintic.csv");
  for (int restart = 40; restart < 250; restart += 30) {
    const Diagnosis found = diagnosed_file(written(log, "restarts.csv", restart, log.time[restart]));
    EXPECT_EQ(found.verdict, Verdict::healthy) << restart << ": " << found.verdict_reason;
    EXPECT_NE(found.verdict_reason.find("the whole log"), std::string::npos) << found.verdict_reason;
    EXPECT_EQ(found.log.rows_used, log.rows());
  }
}

TEST_F(ImperfectLogs, TheVerdictOnOneRunNamesOnlyThatRun) {
  const Log log = read("torque_loss_2.csv");
  const std::string path = written(log, "restarts.csv", 60, log.time[60]);
  const Diagnosis first = diagnosed_file(path, {.run = 1}), second = diagnosed_file(path, {.run = 2});
  EXPECT_EQ(first.verdict, Verdict::healthy) << first.verdict_reason;
  EXPECT_NE(first.verdict_reason.find("run 1 of 2"), std::string::npos) << first.verdict_reason;
  EXPECT_EQ(first.log.issues.find("other_run", "t")->rows_dropped, log.rows() - 60);
  EXPECT_EQ(second.verdict, Verdict::faulty);
}

TEST_F(ImperfectLogs, ASecondFileWithItsOwnClockIsTheNextRun) {
  const Log log = read("torque_loss_2.csv");
  const std::string first = written(log, "first.csv", 60, 0.0, 60);
  Log rest = slice(log, 60, log.rows());
  const std::string second = written(rest, "second.csv", 0, log.time[60]);
  const Diagnosis found = diagnosed_file(first, {.then = {second}});
  EXPECT_EQ(found.verdict, Verdict::faulty) << found.verdict_reason;
  ASSERT_FALSE(found.faults.empty());
  EXPECT_EQ(found.faults.front().run, 2);
}

TEST_F(ImperfectLogs, ATimeOfDayThatPassesMidnightIsOneRun) {
  const Log log = read("torque_loss_2.csv");
  Log late = log;
  for (double& t : late.time) t = std::round(1e3 * (t + 86396.0)) / 1e3;
  const auto midnight = std::lower_bound(late.time.begin(), late.time.end(), 86400.0) - late.time.begin();
  const Diagnosis found = diagnosed_file(written(late, "night.csv", static_cast<int>(midnight), 86400.0));
  EXPECT_EQ(found.verdict, Verdict::faulty) << found.verdict_reason;
  EXPECT_EQ(found.log.runs.size(), 1u);
  EXPECT_NE(found.log.issues.find("clock_midnight", "t"), nullptr);
  ASSERT_FALSE(found.faults.empty());
  EXPECT_NEAR(found.faults.front().onset_s - 86396.0, diagnosed(log).faults.front().onset_s, 0.15);
}

}  // namespace
}  // namespace faultline

// SPDX-License-Identifier: MIT
// What `diagnose --mcap` writes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>

#include "lib/core/atomic_file.hpp"
#include "tests/support/mcap_messages.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string kSamples = FAULTLINE_SOURCE_DIR "/sample_logs/";
constexpr double kNsPerSecond = 1e9;

class DiagnoseRecording : public testing::Test {
 protected:
  DiagnoseRecording() {
    for (const auto& entry : fs::directory_iterator(kSamples + "golden")) {
      const std::string name = entry.path().filename().string();
      if (name.rfind("model-", 0) == 0) fs::copy_file(entry.path(), model_);
      if (name.rfind("cases-", 0) == 0) fs::copy_file(entry.path(), model_ + ".cases.db");
    }
  }
  ProgramRun diagnose(const std::string& log, std::vector<std::string> more) const {
    more.insert(more.begin(), {"diagnose", log, "--model", model_});
    return run_program(more);
  }

  TemporaryFolder folder_;
  const std::string model_ = folder_.file("bench.model");
  const std::string log_ = kSamples + "bench/torque_loss_1.csv", out_ = folder_.file("out.mcap"),
                    json_ = folder_.file("out.json");
};

/// Root mean square of what a topic says of a joint in an array, in [from_s, to_s).
double rms(const std::vector<RecordedMessage>& messages, int array, int joint, double from_s, double to_s) {
  double sum = 0.0, count = 0.0;
  for (const RecordedMessage& message : messages) {
    const double at = static_cast<double>(message.time_ns) / kNsPerSecond;
    const double value = joint_state_arrays(message.bytes)[array][joint];
    if (at < from_s || at >= to_s || !std::isfinite(value)) continue;
    sum += value * value;
    ++count;
  }
  return std::sqrt(sum / count);
}

TEST_F(DiagnoseRecording, HoldsTheLogWithResidualsThatGrowAtTheOnset) {
  ASSERT_EQ(diagnose(log_, {"--mcap", out_, "--json", json_}).status, 1);
  const RecordedFile file = read_mcap(out_);
  const auto rows = json::parse(read_file(json_)).at("log").at("rows").get<std::size_t>();
  EXPECT_EQ(file.messages.at("/joint_states").size(), rows);
  const auto& residuals = file.messages.at("/faultline/residuals");
  EXPECT_GT(residuals.size(), rows / 2);
  const int velocity = 1, joint = 0;
  const double before = rms(residuals, velocity, joint, 0.0, 7.0),
               after = rms(residuals, velocity, joint, 8.0, 15.0);
  EXPECT_LT(before, 2.0);  // about 1 is healthy
  EXPECT_GT(after, 1.5 * before);
}

TEST_F(DiagnoseRecording, APredictionEqualsTheMeasurementMinusItsResidual) {
  ASSERT_EQ(diagnose(log_, {"--mcap", out_}).status, 1);
  const RecordedFile file = read_mcap(out_);
  const double scale = json::parse(read_file(model_)).at("residual").at("healthy").at("velocity_rms").at(0);
  std::map<std::uint64_t, double> measured, residual;
  for (const auto& m : file.messages.at("/joint_states"))
    measured[m.time_ns] = joint_state_arrays(m.bytes)[1][0];
  for (const auto& m : file.messages.at("/faultline/residuals"))
    residual[m.time_ns] = joint_state_arrays(m.bytes)[1][0];
  int compared = 0;
  for (const auto& m : file.messages.at("/faultline/predicted")) {
    const double predicted = joint_state_arrays(m.bytes)[1][0];
    if (!std::isfinite(predicted)) continue;
    EXPECT_NEAR(predicted, measured.at(m.time_ns) - scale * residual.at(m.time_ns), 1e-12);
    ++compared;
  }
  EXPECT_GT(compared, 100);
}

TEST_F(DiagnoseRecording, HoldsEvidenceEventsAndTheWholeDiagnosis) {
  ASSERT_EQ(diagnose(log_, {"--mcap", out_, "--json", json_}).status, 1);
  const RecordedFile file = read_mcap(out_);
  EXPECT_EQ(json::parse(file.metadata.at("faultline/diagnosis")), json::parse(read_file(json_)));
  const auto& curve = file.messages.at("/faultline/evidence/fault_1");
  ASSERT_GT(curve.size(), 5u);
  const json last = json::parse(curve.back().bytes);
  EXPECT_GT(last.at("torque_loss_1").get<double>(), 20.0);
  const auto& events = file.messages.at("/faultline/diagnosis");
  ASSERT_FALSE(events.empty());
  EXPECT_NE(events.front().bytes.find("begins: torque_loss of joint 1"), std::string::npos);
  const double onset = json::parse(read_file(json_)).at("faults").at(0).at("onset_s");
  EXPECT_NEAR(static_cast<double>(events.front().time_ns) / kNsPerSecond, onset, 1e-9);
}

TEST_F(DiagnoseRecording, ConvertReadsTheLogBackWithoutComputedSignals) {
  ASSERT_EQ(diagnose(log_, {"--mcap", out_}).status, 1);
  const std::string back = folder_.file("back.csv"), plain = folder_.file("plain.csv");
  ASSERT_EQ(run_program({"convert", out_, back}).status, 0);
  ASSERT_EQ(run_program({"convert", log_, plain, "--robot", kSamples + "bench/robot.toml"}).status, 0);
  EXPECT_EQ(read_file(back), read_file(plain));
}

TEST_F(DiagnoseRecording, TheSameRunGivesTheSameBytesAndAHealthyRunGivesItsVerdict) {
  const std::string again = folder_.file("again.mcap");
  diagnose(log_, {"--mcap", out_});
  diagnose(log_, {"--mcap", again});
  EXPECT_EQ(read_file(out_), read_file(again));
  ASSERT_EQ(diagnose(kSamples + "bench/healthy_2.csv", {"--mcap", again}).status, 0);
  const RecordedFile healthy = read_mcap(again);
  const auto& events = healthy.messages.at("/faultline/diagnosis");
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].time_ns, 0u);
  EXPECT_NE(events[0].bytes.find("no fault found: the identified robot explains the whole log"),
            std::string::npos);
  EXPECT_EQ(healthy.messages.count("/faultline/residuals"), 1u);
}

TEST_F(DiagnoseRecording, ALogThatCannotBeJudgedHasAnEventWithoutVerdict) {
  const std::string log = read_file(kSamples + "bench/healthy_2.csv");
  std::size_t end = 0;
  for (int rows = 0; rows < 4; ++rows) end = log.find('\n', end) + 1;
  ASSERT_EQ(diagnose(folder_.write("short.csv", log.substr(0, end)), {"--mcap", out_}).status, 1);
  const RecordedFile file = read_mcap(out_);
  const auto& events = file.messages.at("/faultline/diagnosis");
  ASSERT_EQ(events.size(), 1u);
  EXPECT_NE(events[0].bytes.find("\"message\":\"no verdict: "), std::string::npos) << events[0].bytes;
}

TEST_F(DiagnoseRecording, FindingsArePrintedAlsoIfTheRecordingCannotBeWritten) {
  const std::string early = folder_.write(
      "early.csv",
      std::regex_replace(read_file(kSamples + "bench/healthy_2.csv"), std::regex("\n0,"), "\n-0.001,"));
  const ProgramRun run = diagnose(early, {"--mcap", out_});
  EXPECT_EQ(run.status, 3);
  EXPECT_NE(run.out.find("No fault found"), std::string::npos) << run.out;
  EXPECT_NE(run.err.find("shift the clock of the log to start at 0"), std::string::npos) << run.err;
  EXPECT_FALSE(fs::exists(out_));
}

TEST_F(DiagnoseRecording, TheRecordingNeedsAFileThatIsNotAnInput) {
  const ProgramRun standard = diagnose(log_, {"--mcap", "-"});
  EXPECT_EQ(standard.status, 2);
  EXPECT_NE(standard.err.find("give the name of a file"), std::string::npos) << standard.err;
  EXPECT_EQ(diagnose(log_, {"--mcap", model_}).status, 2);
  const ProgramRun nowhere = diagnose(log_, {"--mcap", folder_.file("none/out.mcap")});
  EXPECT_EQ(nowhere.status, 3);
  EXPECT_NE(nowhere.err.find("none"), std::string::npos) << nowhere.err;
}

}  // namespace
}  // namespace faultline

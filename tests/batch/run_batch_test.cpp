// SPDX-License-Identifier: MIT
#include "lib/batch/run_batch.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "formats/open_log.hpp"
#include "lib/batch/log_result.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/hash.hpp"
#include "lib/golden/golden_folder.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

const std::string kGolden = FAULTLINE_SOURCE_DIR "/sample_logs/golden";

/// Two logs of the golden folder, its model, and a count of the logs that were opened.
class RunBatch : public testing::Test {
 protected:
  RunBatch() {
    const ModelAndCases subject = load_golden_model(kGolden, load_golden(kGolden));
    models_.push_back({subject.model, subject.cases});
    for (const char* name : {"healthy_trapezoidal.csv", "locked_1.csv"}) {
      fs::copy_file(kGolden + "/logs/" + name, folder_.file(name));
      logs_.push_back({folder_.file(name), std::string("runs/") + name, 0});
    }
  }

  BatchResult run(const std::string& out, BatchOptions options = {}) {
    options.threads = 1;
    const OpenLog open = [&](const std::string& path, const Robot&) {
      ++opened_;
      auto source = open_log(path);
      if (path == grows_) std::ofstream(path, std::ios::app) << "\n";
      if (path == touched_) fs::last_write_time(path, fs::last_write_time(path) + std::chrono::hours(1));
      return source;
    };
    return run_batch(logs_, open, models_, folder_.file(out), options);
  }

  std::string index(const std::string& out) const { return read_file(folder_.file(out) + "/index.ndjson"); }

  TemporaryFolder folder_;
  std::vector<ModelFiles> models_;
  std::vector<BatchLog> logs_;
  std::string grows_, touched_;
  int opened_ = 0;
};

TEST_F(RunBatch, ARowHoldsTheHashOfItsLog) {
  EXPECT_EQ(run("out").diagnosed, 2);
  for (const BatchLog& log : logs_)
    EXPECT_NE(index("out").find("\"sha256\":\"" + sha256_of_file(log.path)), std::string::npos);
}

TEST_F(RunBatch, AFinishedLogIsNotOpenedAgain) {
  run("out");
  EXPECT_EQ(opened_, 2);
  EXPECT_EQ(run("out").diagnosed, 0);
  EXPECT_EQ(opened_, 2);
  std::ofstream(logs_[0].path, std::ios::app) << "\n";
  EXPECT_EQ(run("out").diagnosed, 1);
  EXPECT_EQ(opened_, 3);
}

TEST_F(RunBatch, ALogThatGrowsWhileItIsReadIsUnusableAndDiagnosedAgain) {
  grows_ = logs_[1].path;
  EXPECT_EQ(run("out").summary.all.unusable, 1);
  EXPECT_NE(index("out").find("changed while it was read"), std::string::npos);
  grows_.clear();
  EXPECT_EQ(run("out").diagnosed, 1);
  run("fresh");
  EXPECT_EQ(index("out"), index("fresh"));
}

TEST_F(RunBatch, ALogThatIsOnlyTouchedWhileItIsReadIsUsed) {
  touched_ = logs_[1].path;
  EXPECT_EQ(run("out").summary.all.unusable, 0);
}

TEST_F(RunBatch, AnUnusableLogIsNotDiagnosedAgainUntilItChanges) {
  write_file(logs_[0].path, "one,two\nthree,four\n");
  EXPECT_EQ(run("out").summary.all.unusable, 1);
  EXPECT_EQ(run("out").diagnosed, 0);
  write_file(logs_[0].path, read_file(logs_[1].path));
  const BatchResult again = run("out");
  EXPECT_EQ(again.diagnosed, 1);
  EXPECT_EQ(again.summary.all.unusable, 0);
}

TEST_F(RunBatch, ALogThatFailedByADefectIsDiagnosedAgain) {
  const OpenLog broken = [](const std::string&, const Robot&) -> std::unique_ptr<LogSource> {
    throw std::logic_error("out of range");
  };
  for (int i = 0; i < 2; ++i) {
    const BatchResult result = run_batch(logs_, broken, models_, folder_.file("out"));
    EXPECT_EQ(result.diagnosed, 2);
    EXPECT_EQ(result.summary.status, 4);
  }
  EXPECT_NE(index("out").find(sha256_of_file(logs_[0].path)), std::string::npos);
}

nlohmann::json stamps(const std::vector<FileStamp>& all) {
  nlohmann::json json = nlohmann::json::array();
  for (const FileStamp& one : all) json.push_back({one.bytes, one.written_ns, one.changed_ns, one.number});
  return json;
}

TEST(UnusableResult, HasAKeyOnlyIfTheFileIsUnchangedSinceItWasRead) {
  const TemporaryFolder folder;
  const BatchLog log{folder.write("a.csv", "x"), "runs/a.csv", 0};
  const Error reason(ErrorCode::input, log.path, "is no log");
  const FileStamp before = stamp_of(log.path);
  EXPECT_EQ(unusable_result(log, before, reason, {}, "s").key, result_key("s", log, sha256_hex("x")));
  folder.write("a.csv", "xy");
  const JournalEntry changed = unusable_result(log, before, reason, {}, "s");
  EXPECT_EQ(changed.key, "");
  EXPECT_EQ(changed.row.sha256, sha256_hex("xy"));
  fs::remove(log.path);
  const JournalEntry gone = unusable_result(log, stamp_of(log.path), reason, {}, "s");
  EXPECT_EQ(gone.key, "");
  EXPECT_EQ(gone.row.sha256, "");
  EXPECT_EQ(gone.row.reason, "is no log");
}

/// A folder with the result of one log.
class WithEarlierResult : public testing::Test {
 protected:
  WithEarlierResult() {
    entry_.key = result_key("s", log_, sha256_hex("x"));
    entry_.row.log = log_.name;
    entry_.row.sha256 = sha256_hex("x");
    entry_.row.result = "a";
    entry_.json_sha = sha256_hex("{}");
    write_file(out_.file("logs/a.json"), "{}");
    AppendedLines(out_.journal()).add(to_journal_line(entry_));
  }

  /// What a new run into the folder finds.
  bool finds(const BatchLog& log, const std::string& settings = "s") {
    KnownLogs known(out_.known_logs());
    return EarlierResults(out_).find(log, stamps_of(files_of(log)), settings, known) != nullptr;
  }

  TemporaryFolder folder_;
  BatchFolder out_{folder_.file("out"), false};
  BatchLog log_{folder_.write("a.csv", "x"), "runs/a.csv", 0};
  JournalEntry entry_;
};

TEST_F(WithEarlierResult, ItIsUsedOnlyIfItsFilesAreUnchanged) {
  EXPECT_TRUE(finds(log_));
  EXPECT_FALSE(finds(log_, "t"));
  EXPECT_FALSE(finds({log_.path, "runs/b.csv", 0}));
  EXPECT_FALSE(finds({"/not/there", "runs/b.csv", 0})) << "was read in vain";
  write_file(out_.file("logs/a.json"), "{ }");
  EXPECT_FALSE(finds(log_));
}

/// The note says of this state of the file that its content was "x", so the "y" in it shows whether it is
/// read.
TEST_F(WithEarlierResult, ALogWhoseFileIsUnchangedIsNotReadAgain) {
  folder_.write("a.csv", "y");
  const std::vector<FileStamp> log{stamp_of(log_.path)}, result{stamp_of(out_.file("logs/a.json"))};
  const auto note = [&](const KnownLog& known) {
    const nlohmann::json line{known.log, known.sha256, stamps(known.files), stamps(known.results)};
    write_file(out_.known_logs(), line.dump() + "\n");
  };
  EXPECT_FALSE(finds(log_)) << "without a note";
  note({log_.name, sha256_hex("x"), log, result});
  EXPECT_TRUE(finds(log_));
  FileStamp other = log.front();
  ++other.changed_ns;
  note({log_.name, sha256_hex("x"), {other}, result});
  EXPECT_FALSE(finds(log_)) << "the log has changed since";
  write_file(out_.file("logs/a.json"), "{ }");
  note({log_.name, sha256_hex("x"), log, result});
  EXPECT_FALSE(finds(log_)) << "the result has changed since";
}

TEST_F(WithEarlierResult, TheRunNotesASettledLogForTheNextOne) {
  while (!are_settled({stamp_of(log_.path)})) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  KnownLogs known(out_.known_logs());
  EXPECT_NE(EarlierResults(out_).find(log_, stamps_of(files_of(log_)), "s", known), nullptr);
  const KnownLogs next(out_.known_logs());
  ASSERT_NE(next.find(log_.name), nullptr);
  EXPECT_EQ(next.find(log_.name)->sha256, sha256_hex("x"));
  EXPECT_EQ(next.find(log_.name)->files.front(), stamp_of(log_.path));
  EXPECT_EQ(next.find(log_.name)->results.front(), stamp_of(out_.file("logs/a.json")));
}

TEST(ResultName, IsReadableAndDiffersByNameAndContent) {
  const std::string name = result_name("runs/day 1/ä.csv", "aa");
  EXPECT_TRUE(name.starts_with("runs_day_1___.csv-")) << name;
  EXPECT_NE(name, result_name("runs/day_1/ä.csv", "aa"));
  EXPECT_NE(name, result_name("runs/day 1/ä.csv", "bb"));
  EXPECT_LT(result_name(std::string(500, 'x'), "aa").size(), 120u);
  EXPECT_FALSE(result_name("../a.csv", "aa").starts_with("."));
}

}  // namespace
}  // namespace faultline

// SPDX-License-Identifier: MIT
// Results of a batch that came from somebody else, made to read or overwrite files elsewhere.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <functional>

#include "lib/batch/appended_lines.hpp"
#include "lib/batch/batch_index.hpp"
#include "lib/batch/run_batch.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/hash.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

const std::string kReport = "{\"a\": \"report\"}", kMine = "my settings";

class ForeignResults : public testing::Test {
 protected:
  ForeignResults() {
    facts_.models = {{"bench", "aa", "bb"}};
    facts_.program_version = "0.1.0";
    facts_.logs = 1;
    fs::create_directories(part() + "/.batch");
    fs::create_directories(part() + "/logs");
    entry_.json_sha = sha256_hex(kReport);
    entry_.row.log = "runs/a.csv";
    entry_.row.result = "runs_a.csv-0123456789ab";
    entry_.row.verdict = "healthy";
    folder_.write("settings.json", kMine);
    write_part();
  }

  std::string part() const { return folder_.file("from/them/part"); }
  std::string out() const { return folder_.file("out"); }
  std::string settings() const { return folder_.file("settings.json"); }

  void write_part() const {
    write_file(part() + "/.batch/finished.json", facts_to_json(facts_));
    write_file(part() + "/.batch/journal", "\n" + to_journal_line(entry_));
    write_file(part() + "/logs/runs_a.csv-0123456789ab.json", kReport);
  }

  /// Nothing is merged, a sentence names the file, and what is mine stays as it is.
  void expect_refused(const std::string& where, const std::string& word) const {
    try {
      merge_batches({part()}, out());
      ADD_FAILURE() << "the results were merged";
    } catch (const Error& error) {
      EXPECT_NE(error.where().find(where), std::string::npos) << error.what();
      EXPECT_NE(error.message().find(word), std::string::npos) << error.what();
    }
    EXPECT_EQ(read_file(settings()), kMine);
  }

  TemporaryFolder folder_;
  BatchFacts facts_;
  JournalEntry entry_;
};

TEST_F(ForeignResults, ValidResultsAreMerged) {
  EXPECT_EQ(merge_batches({part()}, out()).all.logs, 1);
  EXPECT_EQ(read_file(out() + "/logs/runs_a.csv-0123456789ab.json"), kReport);
}

TEST_F(ForeignResults, ANameThatLeavesTheFolderIsRefused) {
  folder_.write("from/settings.json", kReport);  // what it would be copied from
  for (const std::string& name : {std::string("../../settings"), std::string(".."), std::string("a/b"),
                                  std::string("/etc/hosts"), std::string("a\nb"), std::string("a\0b", 3)}) {
    entry_.row.result = name;
    write_part();
    expect_refused(".batch/journal", "not the name of a file in this folder");
  }
  entry_.row.result = "runs_a.csv-0123456789ab";
  for (const char* log : {"../a.csv", "/home/a.csv", "runs/../../a.csv"}) {
    entry_.row.log = log;
    write_part();
    expect_refused(".batch/journal", log);
  }
}

TEST_F(ForeignResults, AResultWithoutANameIsRefused) {
  entry_.row.result = "";
  write_part();
  expect_refused(".batch/journal", "not the name of a file");
}

TEST_F(ForeignResults, APositionOutsideOfTheListIsRefused) {
  for (const int position : {-1, 1, 1'000'000'000}) {
    entry_.position = position;
    write_part();
    expect_refused(".batch/journal", "position");
  }
  facts_.logs = -1;
  write_part();
  expect_refused(".batch/finished.json", "finished batch");
}

TEST_F(ForeignResults, LinksAndPipesInPlaceOfTheirFilesAreNotOpened) {
  for (const std::string& name :
       {std::string(".batch/journal"), std::string(".batch/finished.json"), std::string(".batch/lock"),
        std::string(".batch/known_logs"), "logs/" + entry_.row.result + ".json"}) {
    const std::string path = part() + "/" + name;
    fs::remove(path);
    fs::create_symlink(settings(), path);
    expect_refused(name, "symbolic link");
    fs::remove(path);
    ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
    expect_refused(name, "pipe");
    fs::remove(path);
    write_part();
  }
}

/// Before anything is written.
TEST_F(ForeignResults, NothingIsWrittenThroughLinksInAFolderOfResults) {
  for (const char* name : {"index.csv", "index.ndjson", "index.html", "summary.json", ".batch/journal",
                           ".batch/finished.json", ".batch/lock", ".batch/known_logs"}) {
    fs::remove_all(out());
    fs::create_directories(out() + "/.batch");
    fs::create_symlink(settings(), out() + "/" + name);
    expect_refused(name, "symbolic link");
  }
  fs::remove_all(out());
  fs::create_directories(out() + "/.batch");
  fs::create_directories(out() + "/logs");
  fs::create_symlink(settings(), out() + "/logs/" + entry_.row.result + ".json");
  expect_refused(entry_.row.result, "symbolic link");
}

/// A batch removes results in logs/ that are not its own.
TEST_F(ForeignResults, NothingIsRemovedThroughALinkInPlaceOfLogs) {
  const std::string mine = folder_.write("mine-0123456789ab.json", kMine);
  fs::create_directories(out() + "/.batch");
  fs::create_directory_symlink(folder_.path(), out() + "/logs");
  expect_refused("logs", "symbolic link");
  EXPECT_EQ(read_file(mine), kMine);
}

/// Settings of mine under a second name.
void link_mine(const std::string& mine, const std::string& name) {
  fs::remove(name);
  fs::create_hard_link(mine, name);
}

TEST_F(ForeignResults, AFileOfResultsThatIsAHardLinkIsReplacedAndNotWrittenThrough) {
  merge_batches({part()}, out());
  const std::string rows = read_file(out() + "/index.csv");
  for (const char* name : {"/index.csv", "/index.ndjson", "/index.html", "/summary.json",
                           "/.batch/finished.json", "/logs/runs_a.csv-0123456789ab.json"})
    link_mine(settings(), out() + name);
  merge_batches({part()}, out());
  EXPECT_EQ(read_file(settings()), kMine);
  EXPECT_EQ(read_file(out() + "/index.csv"), rows);
  EXPECT_EQ(read_file(out() + "/logs/runs_a.csv-0123456789ab.json"), kReport);
  EXPECT_EQ(fs::hard_link_count(settings()), 1u);
}

TEST_F(ForeignResults, AJournalThatIsAHardLinkIsNotAppendedTo) {
  merge_batches({part()}, out());
  link_mine(settings(), out() + "/.batch/journal");
  try {
    AppendedLines(out() + "/.batch/journal").add(to_journal_line(entry_));
    ADD_FAILURE() << "the journal was opened";
  } catch (const Error& error) {
    EXPECT_NE(error.message().find("hard link"), std::string::npos) << error.what();
  }
  EXPECT_EQ(read_file(settings()), kMine);
}

}  // namespace
}  // namespace faultline

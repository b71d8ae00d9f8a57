// SPDX-License-Identifier: MIT
#include "lib/cases/case_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <thread>

#include "lib/cases/sqlite.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "tests/cases/example_base.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

std::string refusal(const std::string& path) {
  try {
    read_case_base(path);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input);
    EXPECT_EQ(error.where(), path);
    return error.message();
  }
  return "it was read";
}

CaseBase awkward_base() {
  CaseBase base = example_base(3);
  Case c = base.at(1);
  c.episode.features = {std::numeric_limits<double>::quiet_NaN(), -0.0,
                        std::numeric_limits<double>::denorm_min()};
  c.episode.evidence = std::numeric_limits<double>::quiet_NaN();
  c.what_was_done = std::string("quote ' \" and \n line, caf\xc3\xa9") + std::string("\0 after NUL", 11);
  c.outcome = CaseOutcome::rejected;
  c.log_sha256 = "ab";
  c.onset_s = 0.1;
  c.features_by = "an earlier model";
  c.log_name = "night.csv";
  c.robot = "bench 7";
  c.person = "J\xc3\xbcrgen";
  c.date = "2026-03-02";
  base.retain(c);
  base.describe_robot({"bench", "RRP"});
  return base;
}

class CaseFile : public testing::Test {
 protected:
  TemporaryFolder folder_;
  std::string path_ = folder_.file("robot.cases.db");
};

TEST_F(CaseFile, LiesBesideItsModelByDefault) {
  EXPECT_EQ(case_base_path("runs/robot.json"), "runs/robot.json.cases.db");
}

TEST_F(CaseFile, RoundTripKeepsTheContent) {
  CaseBase base = awkward_base();
  base.belong_to("0123456789abcdef");
  write_case_base(path_, base);
  const CaseBase read = read_case_base(path_);
  EXPECT_EQ(read.model_identity(), "0123456789abcdef");
  EXPECT_EQ(read.sha256(), base.sha256());
  EXPECT_EQ(read.cases().back().what_was_done, base.cases().back().what_was_done);
  EXPECT_EQ(read.feature_names(), base.feature_names());
  EXPECT_EQ(read.robot(), base.robot());
  EXPECT_EQ(read.cases().back().person, "J\xc3\xbcrgen");
  EXPECT_EQ(read.cases().back().date, "2026-03-02");
}

TEST_F(CaseFile, ExportAndImportLoseNothing) {
  CaseBase base = awkward_base();
  base.belong_to("0123456789abcdef");
  const std::string text = to_cases_json(base);
  const CaseBase read = from_cases_json(text, "export.json");
  EXPECT_EQ(read.model_identity(), "0123456789abcdef");
  EXPECT_EQ(read.sha256(), base.sha256());
  EXPECT_EQ(to_cases_json(read), text);
}

TEST_F(CaseFile, AnExportWithAnInvalidNameOfALogIsRefused) {
  CaseBase base = example_base(2);
  Case c = base.at(1);
  c.origin = "runs/night\n2.csv";
  c.log_name = "night.csv";
  base.retain(c);
  const std::string text = to_cases_json(base);
  EXPECT_EQ(from_cases_json(text, "cases.json").sha256(), base.sha256());
  const auto refused = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    changed.replace(changed.find(from), from.size(), to);
    try {
      from_cases_json(changed, "cases.json");
      ADD_FAILURE() << to << " was taken";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::input);
      EXPECT_EQ(error.where(), "cases.json");
      EXPECT_NE(error.message().find("not the name of a log"), std::string::npos) << error.message();
    }
  };
  for (const char* name : {"../night.csv", "runs/night.csv", "/etc/passwd", ".."})
    refused("\"log_name\": \"night.csv\"", std::string("\"log_name\": \"") + name + "\"");
  for (const char* name : {"../night.csv", "/etc/passwd", "runs/../../night.csv"})
    refused("\"origin\": \"runs/night\\n2.csv\"", std::string("\"origin\": \"") + name + "\"");
}

/// Somebody confirms one case over and over.
TEST_F(CaseFile, ReadersSeeAConsistentStateWhileAnotherProgramWrites) {
  constexpr int kReads = 40;
  write_case_base(path_, example_base(50));
  std::atomic<bool> stop = false;
  std::atomic<int> writes = 0;
  std::thread writer([&] {
    for (; !stop; ++writes) {
      change_case_base(path_, [&](CaseBase& base) { base.confirm(1, {}, "done " + std::to_string(writes)); });
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  });
  int read = 0;
  std::string failure;
  try {
    for (; read < kReads || writes < 5; ++read) read_case_base(path_);
  } catch (const Error& error) {
    failure = error.what();
  }
  stop = true;
  writer.join();
  EXPECT_EQ(failure, "") << "of read " << read << " beside write " << writes;
}

TEST_F(CaseFile, AnEmptyCaseBaseIsWrittenAndRead) {
  write_case_base(path_, CaseBase({"a"}));
  EXPECT_TRUE(read_case_base(path_).cases().empty());
}

TEST_F(CaseFile, IsASingleFileAlsoAfterAChange) {
  write_case_base(path_, example_base());
  change_case_base(path_, [](CaseBase& base) { base.confirm(1); });
  int files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder_.path())) ++files;
  EXPECT_EQ(files, 1);
}

TEST_F(CaseFile, ReadingChangesNothing) {
  write_case_base(path_, example_base());
  ::chmod(path_.c_str(), 0444);
  const std::string before = read_file(path_);
  const auto time = std::filesystem::last_write_time(path_);
  read_case_base(path_);
  EXPECT_EQ(read_file(path_), before);
  EXPECT_EQ(std::filesystem::last_write_time(path_), time);
}

TEST_F(CaseFile, TheSameCaseBaseGivesTheSameBytes) {
  write_case_base(path_, example_base());
  write_case_base(folder_.file("again.db"), example_base());
  EXPECT_EQ(read_file(path_), read_file(folder_.file("again.db")));
}

TEST_F(CaseFile, ChangesAreStored) {
  write_case_base(path_, example_base());
  change_case_base(path_, [](CaseBase& base) { base.confirm(2, kBias, "changed the encoder"); });
  EXPECT_EQ(read_case_base(path_).at(2).label, kBias);
  EXPECT_EQ(read_case_base(path_).at(2).what_was_done, "changed the encoder");
}

TEST_F(CaseFile, AChangeThatFailsChangesNothing) {
  write_case_base(path_, example_base());
  const std::string before = read_file(path_);
  const auto half = [](CaseBase& base) {
    base.confirm(1, kBias);
    base.confirm(100000);
  };
  EXPECT_THROW(change_case_base(path_, half), Error);
  EXPECT_EQ(read_file(path_), before);
}

TEST_F(CaseFile, AHardLinkIsNotChanged) {
  write_case_base(path_, example_base(2));
  std::filesystem::create_hard_link(path_, folder_.file("other.cases.db"));
  const std::string before = read_file(path_);
  EXPECT_THROW(change_case_base(path_, [](CaseBase& base) { base.retain(base.at(1)); }), Error);
  EXPECT_EQ(read_file(path_), before);
  EXPECT_THROW(write_case_base(path_, example_base(1)), Error);
  EXPECT_EQ(read_file(folder_.file("other.cases.db")), before);
}

TEST_F(CaseFile, AMissingFileIsRefused) {
  EXPECT_NE(refusal(path_).find("does not exist"), std::string::npos);
}

TEST_F(CaseFile, AFolderIsRefused) {
  EXPECT_NE(refusal(folder_.path().string()).find("directory"), std::string::npos);
}

TEST_F(CaseFile, AnEmptyFileIsRefused) {
  write_file(path_, "");
  EXPECT_NE(refusal(path_).find("is empty"), std::string::npos);
}

TEST_F(CaseFile, ATextFileIsRefused) {
  write_file(path_, std::string(5000, 'x'));
  EXPECT_NE(refusal(path_).find("not an SQLite file"), std::string::npos) << refusal(path_);
}

TEST_F(CaseFile, AFileTruncatedAnywhereIsRefused) {
  write_case_base(path_, example_base(50));
  const std::string whole = read_file(path_);
  ASSERT_GT(whole.size(), 20000u);
  for (std::size_t size = 50; size < whole.size(); size += 3777) {
    write_file(path_, whole.substr(0, size));
    EXPECT_NE(refusal(path_), "it was read") << size;
  }
}

TEST_F(CaseFile, AFileOverwrittenInsideIsRefused) {
  write_case_base(path_, example_base(50));
  std::string bytes = read_file(path_);
  for (std::size_t i = 4096; i < bytes.size(); i += 7) bytes[i] = '\x5a';
  write_file(path_, bytes);
  EXPECT_NE(refusal(path_).find("damaged"), std::string::npos) << refusal(path_);
}

TEST_F(CaseFile, AFileWithFlippedBitsIsReadOrRefusedWithoutACrash) {
  write_case_base(path_, example_base(5));
  const std::string whole = read_file(path_);
  Random random(11);
  int refused = 0;
  for (int i = 0; i < 150; ++i) {
    std::string bytes = whole;
    for (int k = 0; k < 8; ++k) bytes[random.below(bytes.size())] ^= static_cast<char>(1 << random.below(8));
    write_file(path_, bytes);
    try {
      read_case_base(path_);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::input) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(refused, 20);
}

TEST_F(CaseFile, ANewerSchemaIsRefused) {
  write_case_base(path_, example_base());
  SqliteFile(path_, SqliteMode::change).run("PRAGMA user_version = 4");
  EXPECT_NE(refusal(path_).find("newer faultline"), std::string::npos) << refusal(path_);
}

TEST_F(CaseFile, AnSqliteFileOfAnotherProgramIsRefused) {
  SqliteFile(path_, SqliteMode::create).run("CREATE TABLE t(x)");
  EXPECT_NE(refusal(path_).find("another program"), std::string::npos) << refusal(path_);
}

TEST_F(CaseFile, AFileWithLostRowsIsRefused) {
  write_case_base(path_, example_base());
  SqliteFile(path_, SqliteMode::change).run("DELETE FROM fault_case WHERE id = 5");
  EXPECT_NE(refusal(path_).find("does not match its digest"), std::string::npos) << refusal(path_);
}

TEST_F(CaseFile, AMissingFolderIsAFileErrorAndNothingIsWritten) {
  try {
    write_case_base(folder_.file("no/such/robot.cases.db"), example_base());
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::output);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(CaseFile, InvalidImportsAreRefused) {
  EXPECT_THROW(from_cases_json("", "x"), Error);
  EXPECT_THROW(from_cases_json("{\"schema\": \"other/1\"}", "x"), Error);
  EXPECT_THROW(from_cases_json("{\"schema\": \"faultline/cases/1\"}", "x"), Error);
  std::string text = to_cases_json(example_base(1));
  text.replace(text.find("\"outcome\": \"confirmed\""), 22, "\"outcome\": \"maybe\"");
  EXPECT_THROW(from_cases_json(text, "x"), Error);
}

TEST_F(CaseFile, AnExportWithoutRobotOrIdentityIsRefusedWithAdvice) {
  for (const char* member : {"model_identity", "robot", "axes"}) {
    nlohmann::ordered_json json = nlohmann::ordered_json::parse(to_cases_json(example_base(1)));
    json.erase(member);
    try {
      from_cases_json(json.dump(), "x");
      ADD_FAILURE() << "it was read without " << member;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::input);
      EXPECT_NE(error.message().find(member), std::string::npos) << error.message();
      EXPECT_NE(error.message().find("export the cases again"), std::string::npos) << error.message();
    }
  }
}

TEST_F(CaseFile, AnInvalidNumberInAnImportIsNamedWithItsPlace) {
  const auto problem = [](const std::string& text) -> std::string {
    try {
      from_cases_json(text, "cases.json");
    } catch (const Error& error) {
      EXPECT_EQ(error.message().find("json.exception"), std::string::npos) << error.message();
      return error.message();
    }
    return "it was read";
  };
  std::string text = to_cases_json(example_base(2));
  const std::size_t at = text.find("\"near_similarity\": ") + 19;
  const std::size_t end = text.find(',', at);
  const auto with = [&](const std::string& number) { return text.substr(0, at) + number + text.substr(end); };
  EXPECT_NE(problem(with("Infinity")).find("line 3, column 21: \"Infinity\" is not allowed there"),
            std::string::npos)
      << problem(with("Infinity"));
  EXPECT_NE(problem(with("1e999")).find("1e999 is larger than the largest number"), std::string::npos)
      << problem(with("1e999"));
  EXPECT_NE(problem(text.substr(0, 40)).find("ends too early"), std::string::npos);
  text.replace(text.find("\"id\": 2"), 7, "\"id\": \"2\"");
  EXPECT_NE(problem(text).find("case number 2 of the list"), std::string::npos) << problem(text);
}

}  // namespace
}  // namespace faultline

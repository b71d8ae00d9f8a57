// SPDX-License-Identifier: MIT
#include "lib/history/history_file.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>

#include "lib/cases/sqlite.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/hash.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

HistoryRecord record(int number, double friction = 1.0) {
  HistoryRecord made;
  made.log_sha256 = sha256_hex(std::to_string(number));
  made.model_sha256 = sha256_hex("model");
  made.robot = "bench";
  made.log = "runs/" + std::to_string(number) + ".csv";
  made.verdict = "faulty";
  made.start_s = 1.7e9 + number;
  made.findings = {{"locked", 2_joint, 1.5, 0.9}};
  made.condition = {{"friction_1", friction, {friction - 1.0, friction + 1.0}, 30.0, "%"}};
  return made;
}

std::vector<HistoryRecord> records(int from, int to) {
  std::vector<HistoryRecord> made;
  for (int i = from; i < to; ++i) made.push_back(record(i));
  return made;
}

std::string refusal_of(const std::string& path) {
  try {
    read_history(path);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input);
    EXPECT_EQ(error.where(), path);
    return error.message();
  }
  return "";
}

TEST(HistoryFile, HoldsWhatWasAddedAndGrows) {
  const TemporaryFolder folder;
  const std::string path = folder.file("h.sqlite");
  EXPECT_EQ(add_to_history(path, records(0, 3)).added, 3);
  EXPECT_EQ(add_to_history(path, records(3, 5)).added, 2);
  const std::vector<HistoryRecord> all = read_history(path);
  ASSERT_EQ(all.size(), 5u);
  for (int i = 0; i < 5; ++i)
    EXPECT_EQ(digest_of(all[static_cast<std::size_t>(i)]), digest_of(record(i))) << i;
}

TEST(HistoryFile, TheSameResultTwiceChangesNoByte) {
  const TemporaryFolder folder;
  const std::string path = folder.file("h.sqlite");
  add_to_history(path, records(0, 3));
  const std::string before = read_file(path);
  const HistoryGrowth growth = add_to_history(path, records(0, 3));
  EXPECT_EQ(growth.unchanged, 3);
  EXPECT_EQ(growth.added + growth.replaced, 0);
  EXPECT_EQ(read_file(path), before);
}

TEST(HistoryFile, AnotherResultOfTheSameLogAndModelTakesItsPlace) {
  const TemporaryFolder folder;
  const std::string path = folder.file("h.sqlite");
  add_to_history(path, records(0, 3));
  EXPECT_EQ(add_to_history(path, {record(1, 7.0)}).replaced, 1);
  HistoryRecord other_model = record(1);
  other_model.model_sha256 = sha256_hex("another model");
  EXPECT_EQ(add_to_history(path, {other_model}).added, 1);
  const std::vector<HistoryRecord> all = read_history(path);
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all[1].condition[0].value, 7.0);
  EXPECT_EQ(all[1].condition.size(), 1u);
}

TEST(HistoryFile, TwoProcessesThatWriteAtOnceLoseNothing) {
  const TemporaryFolder folder;
  const std::string path = folder.file("h.sqlite");
  std::vector<pid_t> children;
  for (int child = 0; child < 4; ++child) {
    const pid_t pid = ::fork();
    if (pid == 0) {
      try {
        for (int i = 0; i < 20; ++i) add_to_history(path, {record(100 * child + i), record(9999)});
        ::_exit(0);
      } catch (...) {
        ::_exit(1);
      }
    }
    children.push_back(pid);
  }
  for (const pid_t pid : children) {
    int status = -1;
    ::waitpid(pid, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(read_history(path).size(), 81u);
}

TEST(HistoryFile, AFileOfAnotherProgramIsRefusedAndUnchanged) {
  const TemporaryFolder folder;
  const std::string text = folder.write("notes.txt", std::string(2000, 'x'));
  EXPECT_NE(refusal_of(text).find("is not an SQLite file; a history written by faultline was expected"),
            std::string::npos)
      << refusal_of(text);
  EXPECT_THROW(add_to_history(text, records(0, 1)), Error);
  EXPECT_EQ(read_file(text), std::string(2000, 'x'));
  const std::string foreign = folder.file("foreign.sqlite");
  { SqliteFile(foreign, SqliteMode::create).run("CREATE TABLE phone(number TEXT)"); }
  EXPECT_NE(refusal_of(foreign).find("of another program"), std::string::npos);
  EXPECT_THROW(add_to_history(foreign, records(0, 1)), Error);
}

TEST(HistoryFile, DamageIsRefused) {
  const TemporaryFolder folder;
  const std::string path = folder.file("h.sqlite");
  add_to_history(path, records(0, 50));
  const std::string whole = read_file(path);
  const std::string cut = folder.write("cut.sqlite", whole.substr(0, whole.size() / 2));
  EXPECT_NE(refusal_of(cut), "");
  std::string flipped = whole;
  flipped[flipped.find("runs/17.csv") + 5] = '9';
  EXPECT_NE(refusal_of(folder.write("flipped.sqlite", flipped)).find("does not match its digest"),
            std::string::npos);
  { SqliteFile(path, SqliteMode::change).run("CREATE TABLE more(x TEXT)"); }
  EXPECT_NE(refusal_of(path).find("tables that differ"), std::string::npos);
}

TEST(HistoryFile, ANewerSchemaAsksForANewerProgram) {
  const TemporaryFolder folder;
  const std::string path = folder.file("h.sqlite");
  add_to_history(path, records(0, 1));
  { SqliteFile(path, SqliteMode::change).run("PRAGMA user_version = 2"); }
  EXPECT_NE(refusal_of(path).find("update the program"), std::string::npos);
}

TEST(HistoryFile, AMissingFileAndAFolderAreNamed) {
  const TemporaryFolder folder;
  EXPECT_NE(refusal_of(folder.file("none.sqlite")).find("does not exist"), std::string::npos);
  std::filesystem::create_directories(folder.file("dir"));
  EXPECT_NE(refusal_of(folder.file("dir")).find("a history file was expected"), std::string::npos);
}

}  // namespace
}  // namespace faultline

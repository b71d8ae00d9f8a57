// SPDX-License-Identifier: MIT
#include "lib/batch/known_logs.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

#include "lib/core/atomic_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

/// Stamps of files that were written an hour ago.
std::vector<FileStamp> old_stamps() {
  static const std::int64_t hour_ago_ns =
      std::chrono::duration_cast<std::chrono::nanoseconds>(
          (std::chrono::system_clock::now() - std::chrono::hours(1)).time_since_epoch())
          .count();
  return {{10, hour_ago_ns, hour_ago_ns, 7}};
}

KnownLog known(const std::string& log) { return {log, "ab", old_stamps(), {{1, 2, 3, 4}, {5, 6, 7, 8}}}; }

TEST(KnownLogs, ARunKnowsWhatAnEarlierOneHasNotedEvenIfThatWasKilled) {
  const TemporaryFolder folder;
  KnownLogs(folder.file("known")).note(known("runs/\"a\" b.csv"));  // destroyed without finish()
  const KnownLogs again(folder.file("known"));
  ASSERT_NE(again.find("runs/\"a\" b.csv"), nullptr);
  EXPECT_EQ(*again.find("runs/\"a\" b.csv"), known("runs/\"a\" b.csv"));
  EXPECT_EQ(again.find("runs/b.csv"), nullptr);
}

TEST(KnownLogs, ACutLineDoesNotCountAndTheNextOneDoes) {
  const TemporaryFolder folder;
  const std::string path = folder.file("known");
  KnownLogs(path).note(known("a"));
  const std::string text = read_file(path);
  for (std::size_t cut = 2; cut + 1 < text.size(); ++cut) {
    write_file(path, text.substr(0, cut));
    KnownLogs(path).note(known("b"));
    const KnownLogs again(path);
    EXPECT_EQ(again.find("a"), nullptr) << cut;
    EXPECT_NE(again.find("b"), nullptr) << cut;
  }
}

TEST(KnownLogs, OnlyTheLogsOfTheLastRunAreKept) {
  const TemporaryFolder folder;
  const std::string path = folder.file("known");
  {
    KnownLogs first(path);
    for (const char* log : {"a", "b", "c"}) first.note(known(log));
    first.finish();
  }
  KnownLogs second(path);
  second.keep("a");
  second.keep("never noted");
  second.note(known("d"));
  second.finish();
  const KnownLogs third(path);
  for (const auto& [log, is_kept] : {std::pair("a", true), {"b", false}, {"c", false}, {"d", true}})
    EXPECT_EQ(third.find(log) != nullptr, is_kept) << log;
  EXPECT_EQ(third.find("never noted"), nullptr);
}

TEST(KnownLogs, AFileThatWasWrittenJustNowIsNotNoted) {
  const TemporaryFolder folder;
  KnownLog fresh = known("a");
  fresh.files = {stamp_of(folder.write("a.csv", "x"))};
  EXPECT_FALSE(are_settled(fresh.files));
  KnownLogs(folder.file("known")).note(fresh);
  EXPECT_EQ(KnownLogs(folder.file("known")).find("a"), nullptr);
}

TEST(FileStamp, ShowsAWriteThatKeepsSizeAndTime) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.csv", "old");
  const auto time = fs::last_write_time(path);
  const FileStamp before = stamp_of(path);
  EXPECT_EQ(stamp_of(path), before);
  do {  // until the clock of the file system has moved on
    folder.write("a.csv", "new");
    fs::last_write_time(path, time);
  } while (stamp_of(path).changed_ns == before.changed_ns);
  EXPECT_EQ(stamp_of(path).bytes, before.bytes);
  EXPECT_EQ(stamp_of(path).written_ns, before.written_ns);
  EXPECT_NE(stamp_of(path), before);
}

TEST(FileStamp, OfAMissingFileIsThatOfNoFile) {
  const TemporaryFolder folder;
  EXPECT_EQ(stamp_of(folder.file("none")), FileStamp{});
  EXPECT_NE(stamp_of(folder.write("a", "")), FileStamp{});
}

}  // namespace
}  // namespace faultline

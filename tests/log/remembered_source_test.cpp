// SPDX-License-Identifier: MIT
#include "lib/log/remembered_source.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "formats/open_log.hpp"
#include "lib/core/error.hpp"
#include "lib/log/log_source.hpp"
#include "tests/log/log_text.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

/// 40 rows with a repeated time, a time that goes back, a missing value, a word and an extra column.
std::string troubled_text() {
  std::string text = "t,q1,q2,tau1,tau2,temperature\n";
  for (int i = 0; i < 40; ++i) {
    const double t = i == 7 ? 0.06 : i == 21 ? 0.05 : 0.01 * i;
    text += std::to_string(t) + "," + std::to_string(0.1 * i) + ",";
    text += i == 11 ? "" : i == 30 ? "broken" : std::to_string(-0.2 * i);
    text += ",1.5," + std::to_string(0.5 * i) + "," + std::to_string(30 + i) + "\n";
  }
  return text;
}

/// Passes everything on and counts what it is asked.
class CountingSource : public LogSource {
 public:
  explicit CountingSource(std::unique_ptr<LogSource> source) : source_(std::move(source)) {}

  bool next(Log& segment) override {
    ++asked;
    if (asked == fails_at) throw Error(ErrorCode::input, "log", "cannot be read");
    return source_->next(segment);
  }
  void rewind() override {
    ++rewound;
    source_->rewind();
  }
  const LogIdentity& identity() const override { return source_->identity(); }
  const Issues& issues() const override { return source_->issues(); }
  double share_read() const override { return source_->share_read(); }

  int asked = 0, rewound = 0, fails_at = 0;

 private:
  std::unique_ptr<LogSource> source_;
};

class RememberedLog : public testing::Test {
 protected:
  CountingSource opened() const {
    OpenLogOptions options;
    options.segment_rows = 4;
    return CountingSource(open_log(path_, options));
  }
  /// What the file shows without a memory.
  std::string plain(int segments = 1000) const {
    CountingSource source = opened();
    return seen(source, segments);
  }
  std::string plain_again() const {
    CountingSource source = opened();
    read_all(source);
    source.rewind();
    return seen(source);
  }
  /// By the whole log.
  std::int64_t bytes_kept() const {
    CountingSource source = opened();
    LogMemory memory;
    RememberedSource log(source, memory);
    const std::int64_t free = memory.free_bytes();
    read_all(log);
    return free - memory.free_bytes();
  }

  TemporaryFolder folder_;
  std::string path_ = folder_.write("log.csv", troubled_text());
};

TEST_F(RememberedLog, IsTheSameEachTimeAndReadOnce) {
  CountingSource source = opened();
  LogMemory memory;
  RememberedSource log(source, memory);
  EXPECT_EQ(seen(log), plain());
  const int asked = source.asked;
  EXPECT_GT(asked, 10);
  for (int pass = 0; pass < 3; ++pass) {
    log.rewind();
    EXPECT_EQ(seen(log), plain_again()) << pass;
  }
  EXPECT_EQ(source.asked, asked);
  EXPECT_EQ(source.rewound, 0);
}

TEST_F(RememberedLog, IssuesAreNotDoubled) {
  CountingSource source = opened();
  LogMemory memory;
  RememberedSource log(source, memory);
  read_all(log);
  log.rewind();
  read_all(log);
  ASSERT_NE(log.issues().find("time_repeated", "t"), nullptr);
  EXPECT_EQ(log.issues().find("time_repeated", "t")->count, 1);
  EXPECT_EQ(log.issues().rows_dropped(), source.issues().rows_dropped());
}

TEST_F(RememberedLog, ContinuesAtThePlaceOfTheSourceAfterARewindInTheMiddle) {
  CountingSource source = opened();
  LogMemory memory;
  RememberedSource log(source, memory);
  EXPECT_EQ(seen(log, 3), plain(3));
  log.rewind();
  EXPECT_EQ(seen(log, 2), plain(2));
  log.rewind();
  EXPECT_EQ(seen(log, 6), plain(6));
  log.rewind();
  EXPECT_EQ(seen(log), plain());
  EXPECT_EQ(source.rewound, 0);
}

TEST_F(RememberedLog, IsReadAgainAndKeepsNothingBeyondTheBudget) {
  const std::int64_t segment_bytes = 4 * 6 * sizeof(double);
  for (const std::int64_t budget : {std::int64_t{0}, std::int64_t{1}, 3 * segment_bytes, 6 * segment_bytes}) {
    CountingSource source = opened();
    LogMemory memory(budget);
    RememberedSource log(source, memory);
    for (int pass = 1; pass <= 3; ++pass) {
      EXPECT_EQ(seen(log), pass == 1 ? plain() : plain_again()) << budget << " bytes, pass " << pass;
      EXPECT_EQ(memory.free_bytes(), budget);
      log.rewind();
      EXPECT_EQ(source.rewound, pass);
    }
  }
}

TEST_F(RememberedLog, ALogThatDoesNotFitFreesItsMemoryForOthers) {
  const std::int64_t used = bytes_kept();
  ASSERT_GT(used, 0);
  CountingSource first = opened(), second = opened();
  LogMemory both(used + used / 2);
  {
    RememberedSource kept(first, both), forgotten(second, both);
    read_all(kept);
    EXPECT_EQ(both.free_bytes(), used / 2);
    EXPECT_EQ(seen(forgotten), plain());
    EXPECT_EQ(both.free_bytes(), used / 2);
    kept.rewind();
    EXPECT_EQ(seen(kept), plain_again());
  }
  EXPECT_EQ(both.free_bytes(), used + used / 2);
}

TEST_F(RememberedLog, PassesOnAFailureOfTheSourceAndReadsAgainAfterARewind) {
  CountingSource source = opened();
  source.fails_at = 4;
  LogMemory memory;
  RememberedSource log(source, memory);
  EXPECT_THROW(read_all(log), Error);
  log.rewind();
  EXPECT_EQ(source.rewound, 1);
  EXPECT_EQ(seen(log), plain_again());  // so short a file was read to its end before the failure
}

TEST(RememberedSource, AnEmptyLogIsEmptyAgain) {
  MemorySource source(Log{});
  LogMemory memory;
  RememberedSource log(source, memory);
  Log segment;
  for (int pass = 0; pass < 2; ++pass) {
    EXPECT_FALSE(log.next(segment));
    EXPECT_FALSE(log.next(segment));
    log.rewind();
  }
}

TEST(LogMemory, GivesNoMoreThanItHas) {
  LogMemory memory(10);
  EXPECT_TRUE(memory.take(7));
  EXPECT_FALSE(memory.take(4));
  EXPECT_TRUE(memory.take(3));
  memory.give_back(7);
  EXPECT_EQ(memory.free_bytes(), 7);
}

}  // namespace
}  // namespace faultline

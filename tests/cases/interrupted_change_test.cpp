// SPDX-License-Identifier: MIT
// What a change of a case base that was killed in its middle leaves behind: half of the pages written, and
// the journal that undoes them.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>

#include "lib/cases/case_file.hpp"
#include "lib/cases/sqlite.hpp"
#include "lib/core/atomic_file.hpp"
#include "tests/cases/example_base.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

constexpr uid_t kNobody = 65534;

/// A process that writes half a change into the file and is killed.
void kill_within_a_change(const std::string& path) {
  const pid_t child = ::fork();
  if (child == 0) {
    SqliteFile file(path, SqliteMode::change);
    file.run("PRAGMA cache_size = 1; BEGIN IMMEDIATE; UPDATE fault_case SET what_was_done = 'half a change'");
    ::kill(::getpid(), SIGKILL);
  }
  int state = 0;
  ::waitpid(child, &state, 0);
  ASSERT_TRUE(WIFSIGNALED(state));
}

class InterruptedChange : public testing::Test {
 protected:
  InterruptedChange() {
    write_case_base(path_, base_);
    kill_within_a_change(path_);
    changed_ = read_file(path_);
    journal_ = read_file(path_ + "-journal");
  }

  void expect_files_untouched() const {
    EXPECT_TRUE(read_file(path_) == changed_);
    EXPECT_TRUE(read_file(path_ + "-journal") == journal_);
  }

  TemporaryFolder folder_;
  std::string path_ = folder_.file("robot.cases.db"), changed_, journal_;
  CaseBase base_ = example_base(200);
};

TEST_F(InterruptedChange, LeavesAHotJournal) {
  EXPECT_NE(changed_.find("half a change"), std::string::npos) << "or these tests show nothing";
  EXPECT_FALSE(journal_.empty());
}

TEST_F(InterruptedChange, ReadersReadTheStateBeforeItAndChangeNoFile) {
  EXPECT_EQ(read_case_base(path_).sha256(), base_.sha256());
  expect_files_untouched();
}

TEST_F(InterruptedChange, AReaderWithoutWritePermissionReadsTheStateBeforeIt) {
  const auto read_only = fs::perms::owner_read | fs::perms::group_read | fs::perms::others_read;
  const auto look_only = read_only | fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec;
  fs::permissions(path_, read_only);
  fs::permissions(path_ + "-journal", read_only);
  fs::permissions(folder_.path(), look_only);
  const uid_t me = ::geteuid();
  if (me == 0) {
    ASSERT_EQ(::seteuid(kNobody), 0);
  }
  EXPECT_NE(::faccessat(AT_FDCWD, folder_.path().c_str(), W_OK, AT_EACCESS), 0);
  EXPECT_NO_THROW(EXPECT_EQ(read_case_base(path_).sha256(), base_.sha256()));
  if (me == 0) {
    ASSERT_EQ(::seteuid(me), 0);
  }
  fs::permissions(folder_.path(), fs::perms::owner_all);
  expect_files_untouched();
}

TEST_F(InterruptedChange, IsRolledBackByTheNextChange) {
  change_case_base(path_, [](CaseBase& base) { base.confirm(1, {}, "new belt"); });
  CaseBase expected = base_;
  expected.confirm(1, {}, "new belt");
  EXPECT_EQ(read_case_base(path_).sha256(), expected.sha256());
  EXPECT_FALSE(fs::exists(path_ + "-journal"));
}

TEST_F(InterruptedChange, DoesNotReturnIntoAReplacedCaseBase) {
  const CaseBase other = example_base(3);
  write_case_base(path_, other);
  EXPECT_EQ(read_case_base(path_).sha256(), other.sha256());
  change_case_base(path_, [](CaseBase&) {});
  EXPECT_EQ(read_case_base(path_).sha256(), other.sha256());
}

TEST_F(InterruptedChange, DoesNotReturnIntoANewCaseBaseOfTheSameName) {
  fs::remove(path_);
  const CaseBase other = example_base(3);
  write_case_base(path_, other);
  EXPECT_EQ(read_case_base(path_).sha256(), other.sha256());
  change_case_base(path_, [](CaseBase&) {});
  EXPECT_EQ(read_case_base(path_).sha256(), other.sha256());
}

TEST_F(InterruptedChange, ReplaceReceivesTheStateBeforeIt) {
  std::string seen;
  replace_case_base(path_, [&](const CaseBase* there) {
    seen = there->sha256();
    return *there;
  });
  EXPECT_EQ(seen, base_.sha256());
}

}  // namespace
}  // namespace faultline

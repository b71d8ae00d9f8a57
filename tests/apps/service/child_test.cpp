// SPDX-License-Identifier: MIT
#include "apps/service/child.hpp"

#include <gtest/gtest.h>

#include "lib/core/atomic_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

ChildCommand shell(const TemporaryFolder& folder, const std::string& script) {
  ChildCommand command;
  command.program = "/bin/sh";
  command.words = {"-c", script};
  command.folder = folder.path().string();
  command.answer_path = folder.file("answer");
  command.most_s = 30.0;
  return command;
}

bool always(const ChildNews&) { return true; }

TEST(Child, ItsAnswerItsMessagesAndItsProgressAreApart) {
  const TemporaryFolder folder;
  double share = -1.0;
  std::string step;
  const ChildRun run =
      run_child(shell(folder, "pwd; echo 'faultline:  42 % reading' >&2; sleep .3; echo bad >&2; exit 3"),
                [&](const ChildNews& news) {
                  share = std::max(share, news.share);
                  step = news.step;
                  return true;
                });
  EXPECT_EQ(run.end, ChildEnd::exited);
  EXPECT_EQ(run.status, 3);
  EXPECT_EQ(run.messages, "bad\n");
  EXPECT_DOUBLE_EQ(share, 0.42);
  EXPECT_EQ(step, "reading");
  EXPECT_EQ(read_file(folder.file("answer")), folder.path().string() + "\n");
}

TEST(Child, EndsWhenItsTimeIsOverOrTheWatcherSaysSo) {
  const TemporaryFolder folder;
  ChildCommand slow = shell(folder, "exec sleep 60");
  EXPECT_EQ(run_child(slow, [](const ChildNews&) { return false; }).end, ChildEnd::stopped);
  slow.most_s = 0.2;
  EXPECT_EQ(run_child(slow, always).end, ChildEnd::timed_out);
}

TEST(Child, ACrashIsNoExit) {
  const TemporaryFolder folder;
  const ChildRun run = run_child(shell(folder, "kill -SEGV $$"), always);
  EXPECT_EQ(run.end, ChildEnd::crashed);
  EXPECT_EQ(run.status, 11);
}

TEST(Child, AnEndlessMessageIsCut) {
  const TemporaryFolder folder;
  const ChildRun run =
      run_child(shell(folder, "head -c 3000000 /dev/zero | tr '\\0' 'a' >&2; echo end >&2"), always);
  EXPECT_EQ(run.end, ChildEnd::exited);
  EXPECT_LT(run.messages.size(), 200000u);
}

}  // namespace
}  // namespace faultline

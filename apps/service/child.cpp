// SPDX-License-Identifier: MIT
#include "apps/service/child.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>

#include "apps/progress_line.hpp"
#include "lib/core/error.hpp"

namespace faultline {
namespace {

constexpr int kWatchMs = 100;                                // between two looks at the watcher
constexpr std::size_t kMostMessages = std::size_t{1} << 16;  // bytes that are kept
constexpr int kNotStarted = 127;                             // exit status as of a shell

/// The two ends of a pipe; each is closed with the object.
class Pipe {
 public:
  Pipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0)
      throw Error(ErrorCode::internal, "a pipe", "cannot be created; too many files may be open");
  }
  ~Pipe() {
    close_writing();
    if (ends_[0] >= 0) ::close(ends_[0]);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int reading() const { return ends_[0]; }
  int writing() const { return ends_[1]; }
  void close_writing() {
    if (ends_[1] >= 0) ::close(ends_[1]);
    ends_[1] = -1;
  }

 private:
  std::array<int, 2> ends_ = {-1, -1};
};

/// Between fork and exec; calls only what is allowed there in a program of several threads.
[[noreturn]] void become(const char* program, const char* folder, int answer, int messages,
                         char* const* words, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent || ::chdir(folder) != 0 || ::dup2(answer, STDOUT_FILENO) < 0 ||
      ::dup2(messages, STDERR_FILENO) < 0)
    ::_exit(kNotStarted);
  const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (nothing >= 0) ::dup2(nothing, STDIN_FILENO);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::execv(program, words);
  ::_exit(kNotStarted);
}

pid_t start(const ChildCommand& command, int messages) {
  const int answer =
      ::open(command.answer_path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, S_IRUSR | S_IWUSR);
  if (answer < 0) throw Error(ErrorCode::output, command.answer_path, "cannot be created");
  std::vector<std::string> words{"faultline"};
  words.insert(words.end(), command.words.begin(), command.words.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t parent = ::getpid(), child = ::fork();
  if (child == 0)
    become(command.program.c_str(), command.folder.c_str(), answer, messages, pointers.data(), parent);
  ::close(answer);
  if (child < 0) throw Error(ErrorCode::internal, "a process", "cannot be started; the machine is full");
  return child;
}

/// Sorts the lines of standard error into progress and messages.
class MessageLines {
 public:
  void add(const char* bytes, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      if (bytes[i] == '\n')
        end_line();
      else if (line_.size() < kMostMessages)
        line_ += bytes[i];
    }
  }
  void end_line() {
    if (const auto progress = parsed_progress(line_))
      news_ = {progress->step, progress->share};
    else if (!line_.empty() && messages_.size() < kMostMessages)
      messages_ += line_ + "\n";
    line_.clear();
  }
  const ChildNews& news() const { return news_; }
  const std::string& messages() const { return messages_; }

 private:
  std::string line_, messages_;
  ChildNews news_;
};

/// Reads what is there. Returns false at the end of the pipe.
bool read_lines(int pipe, MessageLines& lines) {
  pollfd waiting{pipe, POLLIN, 0};
  if (::poll(&waiting, 1, kWatchMs) <= 0) return true;
  std::array<char, 4096> bytes;
  const ssize_t count = ::read(pipe, bytes.data(), bytes.size());
  if (count > 0) lines.add(bytes.data(), static_cast<std::size_t>(count));
  return count > 0 || (count < 0 && errno == EINTR);
}

}  // namespace

ChildRun run_child(const ChildCommand& command, const std::function<bool(const ChildNews&)>& goes_on) {
  const auto begin = std::chrono::steady_clock::now();
  Pipe messages;
  const pid_t child = start(command, messages.writing());
  messages.close_writing();
  MessageLines lines;
  ChildRun run;
  run.end = ChildEnd::exited;
  while (read_lines(messages.reading(), lines)) {
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    const bool late = taken.count() > command.most_s;
    if (run.end != ChildEnd::exited || (goes_on(lines.news()) && !late)) continue;
    run.end = late ? ChildEnd::timed_out : ChildEnd::stopped;
    ::kill(child, SIGKILL);
  }
  lines.end_line();
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  run.messages = lines.messages();
  if (WIFSIGNALED(status) && run.end == ChildEnd::exited) run.end = ChildEnd::crashed;
  run.status = WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status);
  return run;
}

}  // namespace faultline

// SPDX-License-Identifier: MIT
#include "apps/terminal.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "apps/progress_line.hpp"
#include "lib/core/error.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

bool is_terminal(std::FILE* stream) { return ::isatty(::fileno(stream)) == 1; }

bool environment_forbids_color() {
  const char* no_color = std::getenv("NO_COLOR");
  const char* term = std::getenv("TERM");
  return (no_color && *no_color) || (term && std::strcmp(term, "dumb") == 0);
}

constexpr int kProgressWidth = 30;
constexpr auto kDelay = std::chrono::milliseconds(300);  // before the bar appears
constexpr auto kRefresh = std::chrono::milliseconds(100);
constexpr auto kLineDelay =
    std::chrono::seconds(2);    // before the first line of a file, and between two at least
constexpr int kLineShare = 10;  // of the time so far until the next line: a tenth

std::string bar(double share, bool color) {
  const double known = std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0.0;
  const int full = static_cast<int>(known * kProgressWidth);
  char percent[8];
  std::snprintf(percent, sizeof percent, "%3d %%", static_cast<int>(known * 100));
  return "[" + painted(std::string(full, '='), Paint::green, color) +
         std::string(kProgressWidth - full, ' ') + "] " + percent;
}

}  // namespace

bool use_color(ColorChoice choice, std::FILE* stream) {
  if (choice != ColorChoice::automatic) return choice == ColorChoice::always;
  return is_terminal(stream) && !environment_forbids_color();
}

void print(std::string_view text, bool color) {
  const std::string safe = outgoing(text, color);
  const bool written = std::fwrite(safe.data(), 1, safe.size(), stdout) == safe.size();
  if (written && std::fflush(stdout) == 0) return;
  if (errno == EPIPE) {  // the reader closed the pipe, as head does: end as other programs do
    std::signal(SIGPIPE, SIG_DFL);
    std::raise(SIGPIPE);
  }
  throw Error(ErrorCode::output, "standard output",
              std::string("cannot be written (") + std::strerror(errno) + "); the result is incomplete");
}

void print_message(std::string_view sentence) {
  std::fprintf(stderr, "faultline: %s\n", brief(sentence).c_str());
}

void prepare_standard_streams() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  // open() takes the lowest free descriptor, so each missing one is filled in turn; writing to it still
  // fails.
  for (int descriptor = 0; descriptor <= 2; ++descriptor)
    if (::fcntl(descriptor, F_GETFD) == -1 && ::open("/dev/null", O_RDONLY) == -1) return;
}

ProgressBar::ProgressBar(ColorChoice color)
    : on_terminal_(is_terminal(stderr)),
      color_(use_color(color, stderr)),
      begin_(std::chrono::steady_clock::now()),
      next_(begin_ + (on_terminal_ ? std::chrono::steady_clock::duration(kDelay) : kLineDelay)) {}

ProgressBar::~ProgressBar() {
  if (shown_) std::fputs("\r\x1b[K", stderr);
}

Progress ProgressBar::callback() {
  return [this](const std::string& what, double share) { show(what, share); };
}

void ProgressBar::show(const std::string& what, double share) {
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return;
  if (!on_terminal_) {
    next_ = now + std::max<std::chrono::steady_clock::duration>(kLineDelay, (now - begin_) / kLineShare);
    std::fprintf(stderr, "%s\n", to_text(ProgressLine{what, share}).c_str());
    return;
  }
  next_ = now + kRefresh;
  shown_ = true;
  std::fprintf(stderr, "\r\x1b[K%s %s", bar(share, color_).c_str(), shortened(what, kLongestName).c_str());
}

}  // namespace faultline

// SPDX-License-Identifier: MIT
#include "apps/terminal.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include "lib/core/error.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

bool environment_forbids_color() {
  const char* no_color = std::getenv("NO_COLOR");
  const char* term = std::getenv("TERM");
  return (no_color && *no_color) || (term && std::strcmp(term, "dumb") == 0);
}

}  // namespace

bool is_terminal(std::FILE* stream) { return ::isatty(::fileno(stream)) == 1; }

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

void tell(std::string_view sentence) { std::fprintf(stderr, "faultline: %s\n", brief(sentence).c_str()); }

void prepare_standard_streams() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  // open() takes the lowest free descriptor, so each missing one is filled in turn; writing to it still
  // fails.
  for (int descriptor = 0; descriptor <= 2; ++descriptor)
    if (::fcntl(descriptor, F_GETFD) == -1 && ::open("/dev/null", O_RDONLY) == -1) return;
}

}  // namespace faultline

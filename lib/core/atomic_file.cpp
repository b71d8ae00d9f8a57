// SPDX-License-Identifier: MIT
#include "lib/core/atomic_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <vector>

#include "lib/core/error.hpp"
#include "lib/core/files/output_place.hpp"

namespace faultline {

namespace {

constexpr std::streamsize kBlock = 1 << 16;

/// Whether a write failed because the reader closed the pipe early, as `head` does. This is no failure: the
/// rest of the output has no reader.
bool is_broken_pipe() { return errno == EPIPE; }

}  // namespace

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)) {
  to_stdout_ = path_ == "-";
  if (to_stdout_) {
    file_ = stdout;
    return;
  }
  const OutputPlace place = output_place(path_);
  if (!place.special) temporary_.emplace(path_);
  if (place.special && place.descriptor < 0) {
    file_ = std::fopen(place.path.c_str(), "wb");
  } else {
    const int descriptor = ::dup(temporary_ ? temporary_->descriptor() : place.descriptor);
    file_ = descriptor < 0 ? nullptr : ::fdopen(descriptor, "wb");
  }
  if (!file_) fail("created");
}

AtomicFile::~AtomicFile() {
  if (!to_stdout_ && file_) std::fclose(file_);
}

void AtomicFile::fail(const char* doing) {
  const int reason = errno;
  if (file_ && !to_stdout_) std::fclose(file_);
  file_ = nullptr;
  temporary_.reset();
  errno = reason;
  fail_to_write(to_stdout_ ? "standard output" : path_, doing);
}

void AtomicFile::write(std::string_view bytes) {
  if (bytes.empty()) return;  // its data may be null, which fwrite does not accept
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size() && !is_broken_pipe()) fail("written");
}

void AtomicFile::commit() {
  const bool flushed = std::fflush(file_) == 0, is_pipe_closed = !flushed && is_broken_pipe();
  if (!flushed && !is_pipe_closed) fail("written");
  if (to_stdout_) return;
  std::FILE* file = file_;
  file_ = nullptr;
  const bool synced = temporary_ || ::fsync(::fileno(file)) == 0 || errno == EINVAL;
  const bool closed = std::fclose(file) == 0 || is_broken_pipe();
  if (!is_pipe_closed && !(closed && synced)) fail("written");
  if (temporary_) temporary_->commit();
}

void write_file(const std::string& path, std::string_view bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

std::string read_file(const std::string& path, std::size_t most_bytes) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw Error(ErrorCode::input, path, "is a directory; a file was expected");
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw Error(ErrorCode::input, path, std::string("cannot be opened (") + std::strerror(errno) + ")");
  std::string bytes;
  std::vector<char> block(kBlock);
  while (file.read(block.data(), kBlock) || file.gcount() > 0) {
    bytes.append(block.data(), static_cast<std::size_t>(file.gcount()));
    if (bytes.size() > most_bytes)
      throw Error(ErrorCode::input, path,
                  "is larger than " + std::to_string(most_bytes >> 20) +
                      " MiB, the limit for this kind of file, or a device without end");
  }
  if (file.bad()) throw Error(ErrorCode::input, path, "cannot be read to its end");
  return bytes;
}

}  // namespace faultline

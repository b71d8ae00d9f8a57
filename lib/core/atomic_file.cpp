// SPDX-License-Identifier: MIT
#include "lib/core/atomic_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "lib/core/error.hpp"

namespace faultline {

namespace {

/// A pipe or a device such as /dev/stderr, which is written straight: it must not be replaced by a file.
bool is_device(const std::string& path) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
         !std::filesystem::is_directory(status);
}

/// Differs between threads, processes and machines that write into one folder.
std::string temporary_name(const std::string& path) {
  thread_local std::random_device entropy;
  return path + ".partial-" + std::to_string(::getpid()) + "-" + std::to_string(entropy());
}

}  // namespace

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)) {
  to_stdout_ = path_ == "-";
  if (to_stdout_) {
    file_ = stdout;
    return;
  }
  if (!is_device(path_)) temporary_ = temporary_name(path_);
  file_ = std::fopen(temporary_.empty() ? path_.c_str() : temporary_.c_str(), "wb");
  if (!file_) fail("created");
}

AtomicFile::~AtomicFile() {
  if (to_stdout_ || !file_) return;
  std::fclose(file_);
  if (!temporary_.empty()) std::remove(temporary_.c_str());
}

void AtomicFile::fail(const char* doing) {
  const std::string reason = std::strerror(errno);
  if (file_ && !to_stdout_) std::fclose(file_);
  file_ = nullptr;
  if (!temporary_.empty()) std::remove(temporary_.c_str());
  throw Error(
      ErrorCode::output, to_stdout_ ? "standard output" : path_,
      std::string("cannot be ") + doing + " (" + reason +
          "); nothing was left under that name. Check that the folder exists, is writable and has room");
}

void AtomicFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail("written");
}

void AtomicFile::commit() {
  if (std::fflush(file_) != 0) fail("written");
  if (to_stdout_) return;
  std::FILE* file = file_;
  file_ = nullptr;
  const bool synced = ::fsync(::fileno(file)) == 0 || errno == EINVAL;
  if (std::fclose(file) != 0 || !synced) fail("written");
  if (!temporary_.empty() && std::rename(temporary_.c_str(), path_.c_str()) != 0) fail("renamed into place");
}

void write_file(const std::string& path, std::string_view bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

std::string read_file(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw Error(ErrorCode::input, path, "is a directory, a file was expected");
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw Error(ErrorCode::input, path, std::string("cannot be opened (") + std::strerror(errno) + ")");
  std::ostringstream bytes;
  bytes << file.rdbuf();
  if (file.bad()) throw Error(ErrorCode::input, path, "cannot be read to its end");
  return std::move(bytes).str();
}

}  // namespace faultline

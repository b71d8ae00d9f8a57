// SPDX-License-Identifier: MIT
#include "lib/core/files/inner_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPiece = 1 << 16;

/// An open file or folder; -1 if it could not be opened.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }

  operator int() const { return number_; }

 private:
  int number_;
};

[[noreturn]] void refuse(const fs::path& path, const std::string& what) {
  throw Error(ErrorCode::input, path.string(),
              what +
                  "; in this folder, which may come from another person, only regular files in real folders "
                  "are used. Put a copy of the file there");
}

[[noreturn]] void refuse_to_open(const fs::path& path) {
  throw Error(ErrorCode::input, path.string(),
              std::string("cannot be opened (") + std::strerror(errno) + "); check its permissions");
}

/// Whether the entry exists, without opening it, as opening a device may already have an effect.
bool is_there(const Descriptor& in, const std::string& name, const fs::path& path, bool is_folder) {
  struct stat facts {};
  if (::fstatat(in, name.c_str(), &facts, AT_SYMLINK_NOFOLLOW) != 0) {
    if (errno == ENOENT) return false;
    refuse_to_open(path);
  }
  if (S_ISLNK(facts.st_mode)) refuse(path, "is a symbolic link");
  if (is_folder && !S_ISDIR(facts.st_mode)) refuse(path, "is not a folder");
  if (!is_folder && S_ISDIR(facts.st_mode)) refuse(path, "is a folder; a file was expected");
  if (!is_folder && !S_ISREG(facts.st_mode)) refuse(path, "is a pipe, a socket or a device");
  return true;
}

/// Opens an entry after is_there(); in between it may have become a link or a pipe.
Descriptor opened(const Descriptor& in, const std::string& name, const fs::path& path, bool is_folder) {
  Descriptor file(::openat(in, name.c_str(),
                           O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | (is_folder ? O_DIRECTORY : 0)));
  if (file < 0) refuse_to_open(path);
  struct stat facts {};
  if (!is_folder && (::fstat(file, &facts) != 0 || !S_ISREG(facts.st_mode)))
    refuse(path, "is not a regular file");
  return file;
}

/// Opens a file or folder below `folder`; -1 if a part of the path is missing.
Descriptor open_inner(const std::string& folder, const std::string& path, bool ends_in_folder = false) {
  Descriptor at(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  fs::path so_far(folder);
  const fs::path whole(path);
  for (auto part = whole.begin(); part != whole.end() && at >= 0; ++part) {
    so_far /= *part;
    const bool is_folder = ends_in_folder || std::next(part) != whole.end();
    if (!is_there(at, part->string(), so_far, is_folder)) return Descriptor(-1);
    at = opened(at, part->string(), so_far, is_folder);
  }
  return at;
}

std::string all_of(const Descriptor& file, const std::string& path, std::size_t most_bytes) {
  std::string bytes;
  char piece[kPiece];
  for (;;) {
    const ssize_t got = ::read(file, piece, sizeof piece);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw Error(ErrorCode::input, path, "cannot be read to its end");
    if (got == 0) return bytes;
    bytes.append(piece, static_cast<std::size_t>(got));
    if (bytes.size() > most_bytes)
      throw Error(
          ErrorCode::input, path,
          "is larger than " + std::to_string(most_bytes >> 20) + " MiB, the limit for this kind of file");
  }
}

bool is_control(unsigned char c) { return c < 0x20 || c == 0x7f; }

}  // namespace

bool has_inner_file(const std::string& folder, const std::string& path) {
  return open_inner(folder, path) >= 0;
}

bool has_inner_folder(const std::string& folder, const std::string& path) {
  return open_inner(folder, path, true) >= 0;
}

std::string read_inner_file(const std::string& folder, const std::string& path, std::size_t most_bytes) {
  const std::string whole = (fs::path(folder) / path).string();
  const Descriptor file = open_inner(folder, path);
  if (file < 0) throw Error(ErrorCode::input, whole, "does not exist");
  return all_of(file, whole, most_bytes);
}

void prepare_inner_file(const std::string& folder, const std::string& path) try {
  if (has_inner_file(folder, path)) return;
  std::error_code error;  // writing the file reports it
  fs::create_directories((fs::path(folder) / path).parent_path(), error);
} catch (const Error& error) {
  throw Error(ErrorCode::output, error.where(), error.message());
}

void write_inner_file(const std::string& folder, const std::string& path, std::string_view bytes) {
  prepare_inner_file(folder, path);
  write_file((fs::path(folder) / path).string(), bytes);
}

bool is_plain_name(std::string_view name) {
  return !name.empty() && name != "." && name != ".." && name.find('/') == std::string_view::npos &&
         std::none_of(name.begin(), name.end(), is_control);
}

bool is_plain_path(std::string_view path) {
  for (;;) {
    const std::size_t end = path.find('/');
    if (!is_plain_name(path.substr(0, end))) return false;
    if (end == std::string_view::npos) return true;
    path.remove_prefix(end + 1);
  }
}

bool is_plain_log_name(std::string_view name) { return is_plain_path(printable(name)); }

}  // namespace faultline

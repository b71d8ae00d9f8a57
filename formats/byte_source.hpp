// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "formats/bytes/work_budget.hpp"
#include "lib/core/hash.hpp"
#include "lib/core/issue.hpp"

namespace faultline {

/// The bytes of a file from front to back, with a hash if requested. A regular file is open only while it is
/// read, so that a command may have any number of them; a file that was replaced meanwhile is rejected. Every
/// failure throws Error(input).
class FileBytes {
 public:
  explicit FileBytes(std::string path, bool hashed = true);
  ~FileBytes();
  FileBytes(const FileBytes&) = delete;
  FileBytes& operator=(const FileBytes&) = delete;

  const std::string& path() const { return path_; }
  /// The first bytes of the file, up to 64 KiB unless extended, independent of what was read.
  std::string_view head() const { return head_; }
  /// Doubles the head, as far as the file goes; false at its end. Allowed only before the first read();
  /// invalidates views of the head.
  bool extend_head();
  /// Copies up to `size` of the next bytes to `to`; 0 at the end of the file.
  std::size_t read(char* to, std::size_t size);
  void rewind();
  /// Closes a regular file until the next read().
  void pause();
  /// SHA-256 of all bytes, once the end was reached; empty before and if hashing is off.
  const std::string& sha256() const { return sha256_; }
  double share_read() const;
  /// Bytes read since the beginning.
  std::int64_t position() const { return position_; }
  /// Size of the file in bytes, 0 for a pipe.
  std::int64_t size() const { return regular_ ? stamp_.size : 0; }

 private:
  /// Properties of the file that show whether it was replaced or changed.
  struct Stamp {
    std::uint64_t device = 0, inode = 0;
    std::int64_t size = 0;
    bool operator==(const Stamp&) const = default;
  };

  void open();
  void open_again();
  void close();
  void read_head(std::size_t bytes);
  std::size_t read_some(char* to, std::size_t size);

  std::string path_;
  int file_ = -1;
  bool regular_ = false;
  bool at_end_ = false;
  Stamp stamp_;
  std::int64_t position_ = 0;
  std::string head_;
  std::size_t head_given_ = 0;  ///< bytes of head_ handed out by read()
  std::optional<Sha256> hash_;  ///< empty if not requested, or finished
  std::string sha256_;
};

/// The bytes inside a file that is compressed as a whole, or written in another encoding, from front to back,
/// in memory of fixed size.
class Unpacker {
 public:
  Unpacker(const char* name, double byte_ns) : name_(name), byte_ns_(byte_ns) {}
  virtual ~Unpacker() = default;
  const char* name() const { return name_; }
  /// Usual time to unpack a byte, ns.
  double byte_ns() const { return byte_ns_; }
  /// Copies up to `size` of the next bytes to `to`; 0 at their end or at damage.
  virtual std::size_t read(char* to, std::size_t size) = 0;
  /// After the end: what was wrong with the compressed bytes and its effect; empty for nothing.
  const std::string& damage() const { return damage_; }

 protected:
  std::string damage_;

 private:
  const char* name_;
  double byte_ns_;
};

/// Returns an unpacker for a file that begins as gzip, zstd or text in UTF-16 (its byte-order mark), which
/// reads from its beginning; null for any other. `file` must outlive it.
std::unique_ptr<Unpacker> unpacker_of(FileBytes& file);

/// The bytes of a log from front to back: those of its file or, if the whole file is compressed (gzip, zstd)
/// or text in UTF-16, the unpacked ones or those in UTF-8. Every failure to read the file throws
/// Error(input); damage of the compression ends the bytes and is reported in issues().
class ByteSource {
 public:
  /// Without `hashed`, sha256() stays empty and reading is faster.
  explicit ByteSource(const std::string& path, bool hashed = true);

  const std::string& path() const { return file_.path(); }
  /// The first bytes, up to 64 KiB unless extended, independent of what was read.
  std::string_view head() const { return unpacker_ ? std::string_view(head_) : file_.head(); }
  /// Doubles the head, as far as there are bytes; false at their end. Allowed only before the first read();
  /// invalidates views of the head.
  bool extend_head();
  /// Copies up to `size` of the next bytes to `to`; 0 at the end.
  std::size_t read(char* to, std::size_t size);
  void rewind();
  /// SHA-256 of the file, once its end was reached; empty before.
  const std::string& sha256() const { return file_.sha256(); }
  /// Reads the rest of the file, for its hash.
  void read_to_end();
  double share_read() const { return file_.share_read(); }
  /// Size of the file in bytes, 0 for a pipe.
  std::int64_t file_size() const { return file_.size(); }
  /// Name of the compression or encoding, or null for none: then a library may read the file by its path.
  const char* compression() const { return unpacker_ ? unpacker_->name() : nullptr; }
  /// Counts work on the bytes read so far. Throws Error(input) when it exceeds what a log of this size needs,
  /// see WorkBudget.
  void spend(std::int64_t work_ns) { budget_.spend(work_ns, file_.position()); }
  /// Damage of the compression met so far.
  const Issues& issues() const { return issues_; }

 private:
  void fill_head(std::size_t bytes);
  void note_end();

  FileBytes file_;
  std::unique_ptr<Unpacker> unpacker_;  ///< null for bytes that are not compressed
  std::string head_;                    ///< unpacked
  std::size_t head_given_ = 0;          ///< bytes of head_ handed out by read()
  Issues issues_;
  WorkBudget budget_;
};

/// The bytes of a file from front to back, in contiguous pieces of the requested size. The memory it takes
/// depends on the bytes that the file holds, never on the sizes that it states.
class ByteWindow {
 public:
  explicit ByteWindow(ByteSource& source) : source_(source) {}

  /// Brings at least the next `size` bytes into view, or all that remain; false when there are fewer.
  bool fill(std::size_t size);
  /// The bytes in memory from the current position on; valid until the next fill().
  std::string_view view() const { return {bytes_.get() + begin_, end_ - begin_}; }
  /// Moves forward by `size` bytes, which must be in view.
  void advance(std::size_t size);
  /// Moves forward by `size` bytes, in view or not, or to the end of the file.
  void skip(std::uint64_t size);
  /// Bytes advanced over since the beginning.
  std::int64_t position() const { return position_; }
  /// Bytes of the file after those; the largest number if the file is compressed or a pipe.
  std::uint64_t left() const;
  /// Reads to the end of the file; returns the number of remaining bytes, including the view.
  std::int64_t drain();
  /// Starts again, after the source was rewound.
  void clear();

 private:
  void make_room(std::size_t size);

  ByteSource& source_;
  std::unique_ptr<char[]> bytes_;
  std::size_t capacity_ = 0;
  std::size_t begin_ = 0, end_ = 0;  ///< of the view, in bytes_
  std::int64_t position_ = 0;
  bool at_end_ = false;  ///< of the file
};

}  // namespace faultline

// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "formats/bytes/file_bytes.hpp"
#include "formats/bytes/work_budget.hpp"
#include "lib/core/issue.hpp"

namespace faultline {

/// The bytes inside a file that is compressed as a whole, from front to back, in memory of fixed size.
class Unpacker {
 public:
  virtual ~Unpacker() = default;
  virtual const char* name() const = 0;
  /// Usual time to unpack a byte, ns.
  virtual double byte_ns() const = 0;
  /// Copies up to `size` of the next bytes to `to`; 0 at their end or at damage.
  virtual std::size_t read(char* to, std::size_t size) = 0;
  /// After the end: what was wrong with the compressed bytes and its effect; empty for nothing.
  virtual const std::string& damage() const = 0;
};

/// Returns an unpacker for a file that begins as gzip or zstd, which reads from its beginning; null for any
/// other. `file` must outlive it.
std::unique_ptr<Unpacker> unpacker_of(FileBytes& file);

/// The bytes of a log from front to back: those of its file or, if the whole file is compressed (gzip, zstd),
/// the unpacked ones. Every failure to read the file throws Error(input); damage of the compression ends the
/// bytes and is reported in issues().
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
  /// Name of the compression, or null for none: then a library may read the file by its path.
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

}  // namespace faultline

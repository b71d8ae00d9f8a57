// SPDX-License-Identifier: MIT
#include "formats/rosbag/rosbag2_source.hpp"

#include "formats/arrays/stored_content.hpp"
#include "formats/messages/joint_state_reader.hpp"
#include "formats/rosbag/message_table.hpp"
#include "lib/core/error.hpp"

namespace faultline {
namespace {

constexpr std::string_view kSqliteMagic{"SQLite format 3\0", 16};

std::int64_t big_endian(std::string_view bytes) {
  std::int64_t number = 0;
  for (const char c : bytes) number = 256 * number + static_cast<unsigned char>(c);
  return number;
}

/// Bytes that a database takes by its head; 0 where the head does not say.
std::int64_t sqlite_bytes(std::string_view head) {
  constexpr std::size_t kHeadBytes = 100;
  if (head.size() < kHeadBytes || head.substr(24, 4) != head.substr(92, 4))
    return 0;  // not of the same change
  const std::int64_t page = big_endian(head.substr(16, 2)), pages = big_endian(head.substr(28, 4));
  return pages * (page == 1 ? 65536 : page);
}

class Rosbag2Source : public MessageSource {
 public:
  explicit Rosbag2Source(std::unique_ptr<ByteSource> bytes)
      : bytes_(std::move(bytes)), table_(bytes_->path()) {}

  const std::string& path() const override { return bytes_->path(); }
  const char* format() const override { return "rosbag2"; }
  const std::vector<Topic>& topics() const override { return table_.topics(); }
  const Issues& issues() const override { return issues_; }
  const std::string& sha256() const override { return bytes_->sha256(); }
  double share_read() const override { return table_.share_read(); }
  void spend(std::int64_t work_ns) override { table_.spend(work_ns); }

  bool next(Message& message) override {
    if (table_.next(message, issues_)) return true;
    bytes_->read_to_end();
    tell_appended();
    return false;
  }

  void rewind() override {
    bytes_->rewind();
    table_.rewind();
    issues_ = {};
  }

 private:
  /// SQLite reads as many pages as the head says; behind them another recording may follow.
  void tell_appended() {
    const std::int64_t end = sqlite_bytes(bytes_->head());
    if (end == 0 || end >= bytes_->file_size() || issues_.find("recordings_joined")) return;
    if (RandomFile(path()).text(end, kSqliteMagic.size()) != kSqliteMagic) return;
    issues_.add(
        {"recordings_joined", "", Severity::severe,
         "another recording begins at byte " + std::to_string(end) +
             ", as where files were joined by cat; it is not read. Give the files one by one, with --then"});
  }

  std::unique_ptr<ByteSource> bytes_;
  MessageTable table_;
  Issues issues_;
};

}  // namespace

bool looks_like_rosbag2(std::string_view head) { return head.starts_with(kSqliteMagic); }

std::unique_ptr<RawReader> open_rosbag2(std::unique_ptr<ByteSource> bytes) {
  if (bytes->compression())
    throw Error(ErrorCode::input, bytes->path(),
                std::string("is a recording in SQLite inside ") + bytes->compression() +
                    "; unpack it first, SQLite reads files only");
  return read_joint_states(std::make_unique<Rosbag2Source>(std::move(bytes)));
}

}  // namespace faultline

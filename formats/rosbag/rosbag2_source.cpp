// SPDX-License-Identifier: MIT
#include "formats/rosbag/rosbag2_source.hpp"

#include "formats/messages/joint_state_reader.hpp"
#include "formats/rosbag/message_table.hpp"
#include "lib/core/error.hpp"

namespace faultline {
namespace {

constexpr std::string_view kSqliteMagic{"SQLite format 3\0", 16};

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

  bool next(Message& message) override {
    if (table_.next(message, issues_)) return true;
    bytes_->read_to_end();
    return false;
  }

  void rewind() override {
    bytes_->rewind();
    table_.rewind();
    issues_ = {};
  }

 private:
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

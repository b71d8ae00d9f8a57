// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "formats/byte_window.hpp"
#include "formats/bytes/byte_cursor.hpp"
#include "formats/bytes/unpack_block.hpp"
#include "formats/messages/joint_state_reader.hpp"
#include "formats/messages/lost_messages.hpp"
#include "formats/rosbag/rosbag1_record.hpp"
#include "formats/rosbag/rosbag_format.hpp"
#include "lib/core/error.hpp"

namespace faultline {
namespace {

/// Largest header of a record in bytes; its fields are few and short.
constexpr std::uint32_t kSourceLongestHeader = 1 << 20;
constexpr std::size_t kSourceSearchedAtOnce = 1 << 16;
constexpr std::size_t kLeastRecord = 8;  ///< two lengths

std::optional<BlockPacking> bag_packing(std::string_view name) {
  if (name == "none") return BlockPacking::none;
  if (name == "lz4") return BlockPacking::lz4_frame;
  if (name == "bz2") return BlockPacking::bz2;
  return std::nullopt;
}

class Rosbag1Source : public MessageSource {
 public:
  explicit Rosbag1Source(std::unique_ptr<ByteSource> bytes)
      : bytes_(std::move(bytes)), window_(*bytes_), topics_(bytes_->path()) {
    start();
  }

  const std::string& path() const override { return bytes_->path(); }
  const char* format() const override { return "rosbag1"; }
  const std::vector<Topic>& topics() const override { return topics_.all(); }
  const Issues& issues() const override { return issues_; }
  const std::string& sha256() const override { return bytes_->sha256(); }
  double share_read() const override { return bytes_->share_read(); }
  void spend(std::int64_t work_ns) override { bytes_->spend(work_ns); }

  bool next(Message& message) override {
    while (!at_end_) {
      if (lost_.next(message)) return true;
      if (!inside_.empty()) {
        if (next_inside(message)) return true;
      } else if (!next_record(message)) {
        end();
      } else if (given_) {
        given_ = false;
        return true;
      }
    }
    return false;
  }

  void rewind() override {
    bytes_->rewind();
    window_.clear();
    issues_ = {};
    start();
  }

 private:
  void start() {
    inside_ = {};
    lost_ = {};
    given_ = at_end_ = chunk_doubtful_ = false;
    record_size_ = 0;
    recordings_ = 0;
  }

  std::uint64_t left() const {
    if (bytes_->compression() || bytes_->file_size() == 0) return std::numeric_limits<std::uint64_t>::max();
    return static_cast<std::uint64_t>(std::max<std::int64_t>(0, bytes_->file_size() - window_.position()));
  }

  /// Returns the bytes of the record at the front of the view; 0 for an invalid one.
  std::uint64_t likely_size() {
    if (!window_.fill(sizeof(std::uint32_t))) return 0;
    const auto header = ByteCursor(window_.view()).take<std::uint32_t>();
    if (header > kSourceLongestHeader || !window_.fill(header + kLeastRecord)) return 0;
    if (!Rosbag1Fields(window_.view().substr(sizeof header, header)).has_op()) return 0;
    return rosbag1_record_size(window_.view());
  }

  /// Takes the next record; `given_` is true when it is a message. False at the end.
  bool next_record(Message& message) {
    window_.skip(record_size_);
    record_size_ = 0;
    pass_mark();
    if (!window_.fill(1)) return false;
    const std::uint64_t size = likely_size();
    if (size > kLargestBlock && size <= left() && is_chunk()) {
      lost_.begin_chunk();
      lose_chunk(too_large_block(size));
      record_size_ = size;
      return true;
    }
    if (size == 0 || size > kLargestBlock) return find_record();
    const bool whole = size <= left() && window_.fill(size);
    if (!whole && !is_chunk()) {
      // Either its length is wrong and other records follow, or the file is cut in it.
      return find_record();
    }
    record_size_ = std::min<std::uint64_t>(size, window_.view().size());
    take(window_.view().substr(0, record_size_), whole, message);
    return true;
  }

  /// Skips the mark at which a bag begins. One appended to another has connection numbers of its own.
  void pass_mark() {
    if (!window_.fill(kRosbag1Magic.size()) || !window_.view().starts_with(kRosbag1Magic)) return;
    if (recordings_ > 0)
      issues_.add(
          {"recordings_joined", "", Severity::warning,
           fmt::format("another bag begins at byte {}, as if files were joined by cat; it is read as part "
                       "of the log",
                       window_.position())});
    if (topics_of_.size() == recordings_) topics_of_.emplace_back();
    ++recordings_;
    window_.advance(kRosbag1Magic.size());
  }

  std::map<std::uint32_t, int>& topic_of() { return topics_of_[recordings_ - 1]; }

  bool is_chunk() {
    const auto header = ByteCursor(window_.view()).text();
    return Rosbag1Fields(header).op() == Rosbag1Op::chunk;
  }

  /// Moves past damaged bytes to the next plausible record.
  bool find_record() {
    const std::int64_t begin = window_.position();
    bool found = false;
    do {
      window_.advance(std::min<std::size_t>(1, window_.view().size()));
      window_.fill(kSourceSearchedAtOnce);
      const std::string_view view = window_.view();
      const auto at = view.find("op=");
      const auto mark =
          view.substr(0, at == std::string_view::npos ? at : at + kRosbag1Magic.size()).find(kRosbag1Magic);
      if (mark < at) {
        window_.advance(mark);
        found = true;
        break;
      }
      constexpr std::size_t kBefore = 2 * sizeof(std::uint32_t);
      // In the headers that this program needs, the operation is at or near the front.
      if (at == std::string_view::npos) {
        window_.advance(view.size() > kSourceSearchedAtOnce / 2 ? view.size() - kBefore : view.size());
        continue;
      }
      const auto begins = rosbag1_record_before(view, at, left());
      found = begins != std::string_view::npos;
      window_.advance(found ? begins : at + 1);
    } while (!found && !window_.view().empty());
    issues_.add(
        {"records_damaged", "", Severity::severe,
         fmt::format("bytes {} to {} are not records; their data are lost", begin, window_.position())});
    return found;
  }

  void take(std::string_view bytes, bool whole, Message& message) {
    const auto header = ByteCursor(bytes).text();
    const Rosbag1Fields fields(header);
    const std::string_view data = bytes.substr(header.size() + kLeastRecord);
    switch (fields.op()) {
      case Rosbag1Op::connection:
        add_connection(fields, data);
        break;
      case Rosbag1Op::message:
        given_ = read_message(fields, data, false, message);
        break;
      case Rosbag1Op::chunk:
        open_chunk(fields, data, whole);
        break;
      case Rosbag1Op::index:
        count_lost(fields);
        break;
      default:
        break;
    }
  }

  void add_connection(const Rosbag1Fields& fields, std::string_view data) {
    const std::uint32_t id = fields.word("conn");
    if (topic_of().count(id)) return;
    topic_of().emplace(id, topics_.add({std::string(fields.text("topic")),
                                        std::string(Rosbag1Fields(data).text("type")), "ros1"}));
  }

  bool read_message(const Rosbag1Fields& fields, std::string_view data, bool lost, Message& message) {
    const std::uint32_t id = fields.word("conn");
    lost_.met(id);
    bytes_->spend(kMessageWork_ns);
    const auto topic = topic_of().find(id);
    if (topic == topic_of().end()) {
      issues_.add(
          {"channel_unknown", "", Severity::warning,
           fmt::format("skipped a message of connection {}: the file does not declare its topic and type",
                       id)});
      return false;
    }
    message = {topic->second, fields.time("time"), data, lost};
    return true;
  }

  void open_chunk(const Rosbag1Fields& fields, std::string_view data, bool whole) {
    lost_.begin_chunk();
    const auto packing = bag_packing(fields.text("compression"));
    const std::uint32_t size = fields.word("size");
    if (!packing) return lose_chunk("its compression is unknown");
    if (size > kLargestBlock) return lose_chunk(too_large_block(size));
    bool sound = data.size() == size;
    inside_ = data;
    if (*packing != BlockPacking::none) {
      sound = unpack_block(*packing, data, size, unpacked_);
      inside_ = unpacked_.view();
      bytes_->spend(block_work_ns(*packing, static_cast<std::int64_t>(inside_.size())));
    }
    if (!whole)
      lose_chunk("the file ends inside it; the data before the cut are read");
    else if (!sound)
      lose_chunk("it cannot be unpacked to its end; its messages were left out");
    chunk_doubtful_ = whole && !sound;
  }

  void lose_chunk(const std::string& why) {
    lost_.lose();
    issues_.add({"chunk_damaged", "", Severity::severe,
                 fmt::format("the chunk at byte {}: {}", window_.position(), why)});
  }

  bool next_inside(Message& message) {
    const Rosbag1Record record = rosbag1_record(inside_);
    if (record.size == 0 || !record.fields.has_op()) {
      if (!lost_.is_lossy()) lose_chunk("the records in it are damaged; those before the damage are read");
      inside_ = {};
      return false;
    }
    inside_ = inside_.substr(record.size);
    if (record.fields.op() == Rosbag1Op::connection) add_connection(record.fields, record.data);
    return record.fields.op() == Rosbag1Op::message &&
           read_message(record.fields, record.data, chunk_doubtful_, message);
  }

  /// Counts the messages of a damaged chunk from the index after it.
  void count_lost(const Rosbag1Fields& fields) {
    const auto topic = topic_of().find(fields.word("conn"));
    if (topic == topic_of().end()) return;
    // Entries take 12 bytes each in the data, which was read with the record.
    constexpr std::size_t kEntry = 12;
    lost_.told(topic->first, std::min<std::size_t>(fields.word("count"), record_size_ / kEntry),
               topic->second);
  }

  void end() {
    at_end_ = true;
    bytes_->read_to_end();
    issues_.merge(bytes_->issues());
  }

  std::unique_ptr<ByteSource> bytes_;
  ByteWindow window_;
  TopicList topics_;
  std::size_t recordings_ = 0;                           ///< that have begun
  std::vector<std::map<std::uint32_t, int>> topics_of_;  ///< by recording, of each connection
  Issues issues_;
  std::uint64_t record_size_ = 0;  ///< of the present record; skipped at the next one
  BlockBytes unpacked_;            ///< the open chunk, if it was compressed
  std::string_view inside_;        ///< rest of the open chunk
  bool chunk_doubtful_ = false;    ///< its bytes may be wrong
  LostMessages lost_;
  bool given_ = false, at_end_ = false;
};

}  // namespace

bool looks_like_rosbag1(std::string_view head) { return head.starts_with(kRosbag1Magic); }

std::unique_ptr<RawReader> open_rosbag1(std::unique_ptr<ByteSource> bytes) {
  return read_joint_states(std::make_unique<Rosbag1Source>(std::move(bytes)));
}

}  // namespace faultline

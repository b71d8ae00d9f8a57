// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "formats/byte_source.hpp"
#include "formats/bytes/little_endian.hpp"
#include "formats/bytes/unpack_block.hpp"
#include "formats/known_formats.hpp"
#include "formats/messages/message_source.hpp"
#include "lib/core/error.hpp"

namespace faultline {
namespace {

/// Kinds of records of a ROS 1 bag, version 2.0 (wiki.ros.org/Bags/Format/2.0).
enum class Rosbag1Op : unsigned char {
  message = 0x02,
  bag_header = 0x03,
  index = 0x04,
  chunk = 0x05,
  chunk_info = 0x06,
  connection = 0x07,
};

inline constexpr std::string_view kRosbag1Magic = "#ROSBAG V2.0\n";

/// The fields of a header of name=value pairs, each after its length. Missing fields are empty.
class Rosbag1Fields {
 public:
  explicit Rosbag1Fields(std::string_view header) : header_(header) {}
  std::string_view text(std::string_view name) const {
    ByteCursor header(header_);
    while (!header.rest().empty()) {
      const std::string_view field = header.text();
      const auto sign = field.find('=');
      if (!header.ok()) break;
      if (field.substr(0, sign) == name && sign != std::string_view::npos) return field.substr(sign + 1);
    }
    return {};
  }

  /// Returns a little-endian number; 0 when it is missing or of another size.
  std::uint32_t word(std::string_view name) const {
    const std::string_view bytes = text(name);
    return bytes.size() == sizeof(std::uint32_t) ? ByteCursor(bytes).take<std::uint32_t>() : 0;
  }

  /// Converts a time in seconds and nanoseconds to ns.
  std::int64_t time(std::string_view name) const {
    constexpr std::int64_t kSecond = 1'000'000'000;
    ByteCursor bytes(text(name));
    const std::int64_t seconds = bytes.take<std::uint32_t>();
    return seconds * kSecond + bytes.take<std::uint32_t>();
  }

  /// True when it has an operation code; the code.
  bool has_op() const { return text("op").size() == 1; }
  Rosbag1Op op() const { return static_cast<Rosbag1Op>(text("op")[0]); }

 private:
  std::string_view header_;
};

/// A record: a header and its data, each after its length.
struct Rosbag1Record {
  Rosbag1Fields fields{""};
  std::string_view data;   ///< as far as they are in view
  std::uint64_t size = 0;  ///< of the whole record, in view or not; 0 when the length of its data is not
};

/// Returns the record at the front of `bytes`.
Rosbag1Record rosbag1_record(std::string_view bytes) {
  ByteCursor record(bytes);
  Rosbag1Record found;
  found.fields = Rosbag1Fields(record.text());
  const std::uint64_t data = record.take<std::uint32_t>();
  found.data = record.rest().substr(0, data);
  found.size = record.ok() ? record.position() + data : 0;
  return found;
}

/// Returns the position of a record of at most `left` bytes whose header has the operation at `at`; npos for
/// none.
std::size_t rosbag1_record_before(std::string_view bytes, std::size_t at, std::uint64_t left) {
  constexpr std::size_t kFarthest = 256;
  for (std::size_t back = 2 * sizeof(std::uint32_t); back <= std::min(at, kFarthest); ++back) {
    const std::string_view candidate = bytes.substr(at - back);
    const auto header = ByteCursor(candidate).take<std::uint32_t>();
    if (header < back || header > kFarthest) continue;
    const Rosbag1Record record = rosbag1_record(candidate);
    if (record.fields.has_op() && record.size > 0 && record.size <= left) return at - back;
  }
  return std::string_view::npos;
}

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

class Rosbag1Source : public ChunkedSource {
 public:
  explicit Rosbag1Source(std::unique_ptr<ByteSource> bytes) : ChunkedSource(std::move(bytes), "rosbag1") {}

 private:
  void start() override {
    inside_ = {};
    record_size_ = 0;
    recordings_ = 0;
  }

  /// Returns the bytes of the record at the front of the view; 0 for an invalid one.
  std::uint64_t likely_size() {
    if (!window_.fill(sizeof(std::uint32_t))) return 0;
    const auto header = ByteCursor(window_.view()).take<std::uint32_t>();
    if (header > kSourceLongestHeader || !window_.fill(header + kLeastRecord)) return 0;
    const Rosbag1Record record = rosbag1_record(window_.view());
    return record.fields.has_op() ? record.size : 0;
  }

  Taken next_record(Message& message) override {
    window_.skip(record_size_);
    record_size_ = 0;
    pass_mark();
    if (!window_.fill(1)) return Taken::nothing;
    const std::uint64_t size = likely_size();
    if (size > kLargestBlock && size <= window_.left() && is_chunk()) {
      begin_chunk();
      lose_chunk(too_large_block(size), false);
      record_size_ = size;
      return Taken::other;
    }
    if (size == 0 || size > kLargestBlock) return find_record();
    const bool whole = size <= window_.left() && window_.fill(size);
    if (!whole && !is_chunk()) {
      // Either its length is wrong and other records follow, or the file is cut in it.
      return find_record();
    }
    record_size_ = std::min<std::uint64_t>(size, window_.view().size());
    return take(rosbag1_record(window_.view()), whole, message);
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

  /// Returns the topic of a connection; -1 for an unknown one.
  int topic_of(std::uint32_t id) const {
    const auto found = topics_of_[recordings_ - 1].find(id);
    return found == topics_of_[recordings_ - 1].end() ? -1 : found->second;
  }

  bool is_chunk() const { return rosbag1_record(window_.view()).fields.op() == Rosbag1Op::chunk; }

  /// Moves past damaged bytes to the next plausible record.
  Taken find_record() {
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
      const auto begins = rosbag1_record_before(view, at, window_.left());
      found = begins != std::string_view::npos;
      window_.advance(found ? begins : at + 1);
    } while (!found && !window_.view().empty());
    issues_.add(
        {"records_damaged", "", Severity::severe,
         fmt::format("bytes {} to {} are not records; their data are lost", begin, window_.position())});
    return found ? Taken::other : Taken::nothing;
  }

  Taken take(const Rosbag1Record& record, bool whole, Message& message) {
    const auto& [fields, data, size] = record;
    switch (fields.op()) {
      case Rosbag1Op::connection:
        add_connection(fields, data);
        break;
      case Rosbag1Op::message:
        return read_message(fields, data, false, message);
      case Rosbag1Op::chunk:
        open_chunk(fields, data, whole);
        break;
      case Rosbag1Op::index:
        count_lost(fields);
        break;
      default:
        break;
    }
    return Taken::other;
  }

  void add_connection(const Rosbag1Fields& fields, std::string_view data) {
    const std::uint32_t id = fields.word("conn");
    if (topic_of(id) >= 0) return;
    const Rosbag1Fields stated(data);
    topics_of_[recordings_ - 1].emplace(
        id, topics_.add({std::string(fields.text("topic")), std::string(stated.text("type")), "ros1",
                         std::string(stated.text("message_definition"))}));
  }

  Taken read_message(const Rosbag1Fields& fields, std::string_view data, bool lost, Message& message) {
    const std::uint32_t id = fields.word("conn");
    return give({topic_of(id), fields.time("time"), data, lost}, "connection", id, message);
  }

  void open_chunk(const Rosbag1Fields& fields, std::string_view data, bool whole) {
    begin_chunk();
    const auto packing = bag_packing(fields.text("compression"));
    const std::uint32_t size = fields.word("size");
    if (!packing) return lose_chunk("its compression is unknown", false);
    if (size > kLargestBlock) return lose_chunk(too_large_block(size), false);
    inside_ = data;
    unpack(*packing, size, 0, !whole, inside_);
  }

  Taken next_inside(Message& message) override {
    if (inside_.empty()) return Taken::nothing;
    const Rosbag1Record record = rosbag1_record(inside_);
    if (record.size == 0 || record.size > inside_.size() || !record.fields.has_op()) {
      if (!is_lossy()) lose_chunk("the records in it are damaged; those before the damage are read", false);
      inside_ = {};
      return Taken::other;
    }
    inside_ = inside_.substr(record.size);
    if (record.fields.op() == Rosbag1Op::connection) add_connection(record.fields, record.data);
    if (record.fields.op() != Rosbag1Op::message) return Taken::other;
    return read_message(record.fields, record.data, is_doubtful(), message);
  }

  /// Counts the messages of a damaged chunk from the index after it.
  void count_lost(const Rosbag1Fields& fields) {
    const std::uint32_t id = fields.word("conn");
    // Entries take 12 bytes each in the data, which was read with the record.
    constexpr std::size_t kEntry = 12;
    compare(id, std::min<std::size_t>(fields.word("count"), record_size_ / kEntry), topic_of(id));
  }

  std::size_t recordings_ = 0;                           ///< that have begun
  std::vector<std::map<std::uint32_t, int>> topics_of_;  ///< by recording, of each connection
  std::uint64_t record_size_ = 0;                        ///< of the present record; skipped at the next one
  std::string_view inside_;                              ///< rest of the open chunk
};

}  // namespace

bool looks_like_rosbag1(std::string_view head) { return head.starts_with(kRosbag1Magic); }

std::unique_ptr<RawReader> open_rosbag1(std::unique_ptr<ByteSource> bytes) {
  return read_joint_states(std::make_unique<Rosbag1Source>(std::move(bytes)));
}

}  // namespace faultline

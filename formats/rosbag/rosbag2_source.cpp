// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "formats/arrays/stored_content.hpp"
#include "formats/bytes/work_budget.hpp"
#include "formats/known_formats.hpp"
#include "formats/messages/message_source.hpp"
#include "lib/core/error.hpp"
#include "lib/core/issue.hpp"

namespace faultline {
namespace {

constexpr std::string_view kSqliteMagic{"SQLite format 3\0", 16};
constexpr int kLongestMessage = 1 << 26;
constexpr std::size_t kMostDefinitions = 1 << 12;  ///< types of messages
constexpr int kMostCacheKib = 16 << 10;
/// Steps of SQLite's virtual machine between two counts of the work, and the usual time for one; a message
/// takes about ten.
constexpr int kCountedSteps = 1000;
constexpr std::int64_t kStep_ns = 20;
constexpr std::int64_t kMessageByte_ns = 1;
constexpr const char* kFromNumber =
    "SELECT id, topic_id, timestamp, data FROM messages WHERE id >= ?1 ORDER BY id";

using Statement = std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)>;

Statement prepared(sqlite3* db, const char* sql) {
  sqlite3_stmt* statement = nullptr;
  sqlite3_prepare_v2(db, sql, -1, &statement, nullptr);
  return {statement, sqlite3_finalize};
}

std::string text_of(sqlite3_stmt* statement, int column) {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement, column));
  return text ? std::string(text, sqlite3_column_bytes(statement, column)) : std::string();
}

/// Allows only to read tables, and no function but max().
int allow(void*, int action, const char*, const char* detail, const char*, const char*) {
  switch (action) {
    case SQLITE_SELECT:
    case SQLITE_READ:
      return SQLITE_OK;
    case SQLITE_FUNCTION:
      return detail && std::string_view(detail) == "max" ? SQLITE_OK : SQLITE_DENY;
    default:
      return SQLITE_DENY;
  }
}

/// Returns the bytes of a file, 0 when it does not exist.
std::int64_t bytes_of(const std::string& path) {
  std::error_code none;
  const auto bytes = std::filesystem::file_size(path, none);
  return none ? 0 : static_cast<std::int64_t>(bytes);
}

/// Returns the URI to open the file: with a recorder's write-ahead log if there is one, else without locks.
std::string uri_of(const std::string& path) {
  std::string uri = "file:";
  for (const char c : path)
    uri += c == '?' || c == '#' || c == '%' ? fmt::format("%{:02X}", static_cast<unsigned char>(c))
                                            : std::string(1, c);
  std::error_code none;
  return uri + (std::filesystem::exists(path + "-wal", none) ? "?mode=ro" : "?immutable=1");
}

std::int64_t big_endian(std::string_view bytes) {
  std::int64_t number = 0;
  for (const char c : bytes) number = 256 * number + static_cast<unsigned char>(c);
  return number;
}

/// Returns the bytes of a database according to its head; 0 if the head is not valid.
std::int64_t sqlite_bytes(std::string_view head) {
  constexpr std::size_t kDatabaseHead = 100;
  if (head.size() < kDatabaseHead || head.substr(24, 4) != head.substr(92, 4))
    return 0;  // not of the same change
  const std::int64_t page = big_endian(head.substr(16, 2)), pages = big_endian(head.substr(28, 4));
  return pages * (page == 1 ? 65536 : page);
}

/// The tables of a rosbag2 recording in SQLite: topics, and messages in the order of their numbers. Pages
/// that are damaged or missing are skipped. The file is not changed and no code in it is run.
class Rosbag2Source : public MessageSource {
 public:
  /// Throws Error(input) when the file is no such recording.
  explicit Rosbag2Source(std::unique_ptr<ByteSource> bytes)
      : MessageSource(std::move(bytes), "rosbag2"),
        file_bytes_(bytes_of(path()) + bytes_of(path() + "-wal")),
        budget_(path()) {
    open();
    bound_work();
    for (const char* table : {"topics", "messages", "message_definitions"}) refuse_computed(table);
    sqlite3_set_authorizer(db_.get(), allow, nullptr);
    read_topics();
    start();
  }

  bool next(Message& message) override {
    while (!at_end_) {
      if (!at_row_) {
        const int result = sqlite3_step(messages_.get());
        const bool sound = result == SQLITE_ROW && sqlite3_column_int64(messages_.get(), 0) > number_;
        if (over_budget_) refuse_work();
        at_end_ = result == SQLITE_DONE || (!sound && !pass_damage());
        if (at_end_) break;
      }
      at_row_ = false;
      if (take(message)) return true;
    }
    bytes_->read_to_end();
    tell_appended();
    return false;
  }

  void rewind() override {
    bytes_->rewind();
    issues_ = {};
    start();
  }

  void spend(std::int64_t work_ns) override { budget_.spend(work_ns, file_bytes_); }
  /// Share of the numbers of all messages, 0 to 1.
  double share_read() const override {
    if (last_number_ <= 0 || number_ <= 0) return 0.0;
    return std::min(1.0, static_cast<double>(number_) / static_cast<double>(last_number_));
  }

 private:
  void start() {
    number_ = std::numeric_limits<std::int64_t>::min();
    budget_.start();
    over_budget_ = false;
    find_last_number();
    seek(number_);
    at_row_ = at_end_ = false;
    sqlite3_reset(messages_.get());
  }

  void open() {
    sqlite3* db = nullptr;
    const int result =
        sqlite3_open_v2(uri_of(path()).c_str(), &db, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
    db_.reset(db);
    if (result != SQLITE_OK) fail(fmt::format("cannot be opened as SQLite ({})", sqlite3_errmsg(db)));
    for (const int off :
         {SQLITE_DBCONFIG_TRUSTED_SCHEMA, SQLITE_DBCONFIG_ENABLE_TRIGGER, SQLITE_DBCONFIG_ENABLE_VIEW})
      sqlite3_db_config(db, off, 0, nullptr);
    sqlite3_limit(db, SQLITE_LIMIT_LENGTH, kLongestMessage);
    // Nothing is written; the setting lets SQLite read a file that is shorter than its head states.
    sqlite3_db_config(db, SQLITE_DBCONFIG_WRITABLE_SCHEMA, 1, nullptr);
  }

  /// Stops SQLite when it takes far more steps than a file of this size needs.
  void bound_work() {
    sqlite3_exec(db_.get(),
                 fmt::format("PRAGMA cache_size = -{}; PRAGMA temp_store = FILE", kMostCacheKib).c_str(),
                 nullptr, nullptr, nullptr);
    sqlite3_progress_handler(
        db_.get(), kCountedSteps,
        [](void* self) {
          auto& source = *static_cast<Rosbag2Source*>(self);
          try {
            source.spend(kCountedSteps * kStep_ns);
          } catch (const Error&) {
            source.over_budget_ = true;
          }
          return source.over_budget_ ? 1 : 0;
        },
        this);
  }

  /// Rejects views, virtual tables and computed columns, as they could cause any amount of work from a small
  /// file.
  void refuse_computed(const char* table) {
    const Statement kind = prepared(db_.get(), "SELECT type, sql FROM sqlite_master WHERE name = ?1");
    if (!kind) return;
    sqlite3_bind_text(kind.get(), 1, table, -1, SQLITE_STATIC);
    if (sqlite3_step(kind.get()) == SQLITE_ROW &&
        (text_of(kind.get(), 0) != "table" || sqlite3_column_type(kind.get(), 1) != SQLITE_TEXT ||
         text_of(kind.get(), 1).find("VIRTUAL") != std::string::npos))
      fail(fmt::format(
          "is not a rosbag2 recording: \"{}\" is not a plain table but a computed one, which is not "
          "evaluated. Export it as CSV",
          table));
    const Statement columns = prepared(db_.get(), "SELECT hidden FROM pragma_table_xinfo(?1)");
    if (!columns) return;
    sqlite3_bind_text(columns.get(), 1, table, -1, SQLITE_STATIC);
    while (sqlite3_step(columns.get()) == SQLITE_ROW)
      if (sqlite3_column_int(columns.get(), 0) != 0)
        fail(fmt::format(
            "is not a rosbag2 recording: the table \"{}\" has a computed column, which is not evaluated. "
            "Export it as CSV",
            table));
  }

  [[noreturn]] void refuse_work() const {
    fail(
        "makes SQLite do far more work than a recording of its size needs, so reading stopped; a rosbag2 "
        "recording has plain tables of topics and messages. Export it as CSV");
  }

  void read_topics() {
    const Statement topics =
        prepared(db_.get(), "SELECT id, name, type, serialization_format FROM topics ORDER BY id");
    if (!topics || !prepared(db_.get(), kFromNumber))
      fail(fmt::format(
          "is an SQLite file, but not a readable rosbag2 recording ({}); a recording has the tables topics "
          "and messages. Export it as CSV",
          sqlite3_errmsg(db_.get())));
    const std::map<std::string, std::string> definitions = read_definitions();
    while (sqlite3_step(topics.get()) == SQLITE_ROW) {
      spend(kMessageWork_ns);
      const std::string type = text_of(topics.get(), 2);
      const auto stated = definitions.find(type);
      topic_of_id_.emplace(sqlite3_column_int64(topics.get(), 0),
                           topics_.add({text_of(topics.get(), 1), type, text_of(topics.get(), 3),
                                        stated == definitions.end() ? "" : stated->second}));
    }
    if (over_budget_) refuse_work();
  }

  /// Returns the definitions by type, which recorders of ROS 2 Iron and later write.
  std::map<std::string, std::string> read_definitions() {
    std::map<std::string, std::string> definitions;
    const Statement rows = prepared(
        db_.get(), "SELECT topic_type, encoding, encoded_message_definition FROM message_definitions");
    while (rows && sqlite3_step(rows.get()) == SQLITE_ROW && definitions.size() < kMostDefinitions) {
      spend(kMessageWork_ns);
      if (text_of(rows.get(), 1) == "ros2msg")
        definitions.emplace(text_of(rows.get(), 0), text_of(rows.get(), 2));
    }
    return definitions;
  }

  void find_last_number() {
    const Statement last = prepared(db_.get(), "SELECT max(id) FROM messages");
    last_number_ = last && sqlite3_step(last.get()) == SQLITE_ROW ? sqlite3_column_int64(last.get(), 0) : 0;
    if (over_budget_) refuse_work();
  }

  /// Moves to the first message from `number` on; false when none can be read.
  bool seek(std::int64_t number) {
    messages_ = prepared(db_.get(), kFromNumber);
    sqlite3_bind_int64(messages_.get(), 1, number);
    return at_row_ = sqlite3_step(messages_.get()) == SQLITE_ROW &&
                     sqlite3_column_int64(messages_.get(), 0) >= number;
  }

  /// Skips unreadable messages, with growing steps, then bisects to the first readable one.
  bool pass_damage() {
    constexpr std::int64_t kFarthest = std::int64_t{1} << 24;
    const std::int64_t first = std::max<std::int64_t>(number_, 0) + 1;
    std::int64_t step = 1;
    while (step < kFarthest && !seek(first + step)) step *= 2;
    const bool found = at_row_;
    if (over_budget_) refuse_work();
    if (found) {
      std::int64_t dark = first + step / 2, light = first + step;  // seek() fails at dark, not at light
      while (light - dark > 1) {
        const std::int64_t middle = dark + (light - dark) / 2;
        (seek(middle) ? light : dark) = middle;
      }
      seek(light);
    }
    const std::int64_t next = found ? sqlite3_column_int64(messages_.get(), 0) : last_number_ + 1;
    const std::string lost = next > first ? fmt::format("messages {} to {}", first, next - 1)
                                          : fmt::format("the messages from number {} on", first);
    issues_.add(
        {"pages_damaged", "", Severity::severe, lost + " are on damaged or missing pages and are lost"});
    return found;
  }

  bool take(Message& message) {
    number_ = sqlite3_column_int64(messages_.get(), 0);
    const std::int64_t id = sqlite3_column_int64(messages_.get(), 1);
    const auto topic = topic_of_id_.find(id);
    if (topic == topic_of_id_.end()) {
      issues_.add({"channel_unknown", "", Severity::warning,
                   fmt::format("skipped message {}: the file declares no topic {}", number_, id)});
      return false;
    }
    const auto* bytes = static_cast<const char*>(sqlite3_column_blob(messages_.get(), 3));
    spend(kMessageWork_ns + kMessageByte_ns * sqlite3_column_bytes(messages_.get(), 3));
    message = {topic->second,
               sqlite3_column_int64(messages_.get(), 2),
               {bytes ? bytes : "", static_cast<std::size_t>(sqlite3_column_bytes(messages_.get(), 3))},
               bytes == nullptr};
    return true;
  }

  /// Reports a recording after the pages of the first one, of which SQLite reads as many as the head states.
  void tell_appended() {
    const std::int64_t end = sqlite_bytes(bytes_->head());
    if (end == 0 || end >= bytes_->file_size() || issues_.find("recordings_joined")) return;
    if (RandomFile(path()).text(end, kSqliteMagic.size()) != kSqliteMagic) return;
    issues_.add(
        {"recordings_joined", "", Severity::severe,
         "another recording begins at byte " + std::to_string(end) +
             ", as if files were joined by cat; it is not read. Give the files separately, with --then"});
  }

  [[noreturn]] void fail(const std::string& what) const { throw Error(ErrorCode::input, path(), what); }

  std::unique_ptr<sqlite3, int (*)(sqlite3*)> db_{nullptr, sqlite3_close};
  Statement messages_{nullptr, sqlite3_finalize};  ///< from some number on
  std::map<std::int64_t, int> topic_of_id_;
  std::int64_t number_ = 0;       ///< of the last message handed out
  std::int64_t last_number_ = 0;  ///< of the file's last message, if it can be read
  bool at_row_ = false;           ///< a row was read by seek() and not handed out
  bool at_end_ = false;
  std::int64_t file_bytes_ = 0;
  WorkBudget budget_;         ///< of the steps of SQLite
  bool over_budget_ = false;  ///< SQLite was interrupted
};

}  // namespace

bool looks_like_rosbag2(std::string_view head) { return head.starts_with(kSqliteMagic); }

std::unique_ptr<RawReader> open_rosbag2(std::unique_ptr<ByteSource> bytes) {
  if (bytes->compression())
    throw Error(ErrorCode::input, bytes->path(),
                std::string("is a recording in SQLite inside ") + bytes->compression() +
                    "; unpack it first, as SQLite reads files only");
  return read_joint_states(std::make_unique<Rosbag2Source>(std::move(bytes)));
}

}  // namespace faultline

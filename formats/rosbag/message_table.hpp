// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "formats/bytes/work_budget.hpp"
#include "formats/messages/message_source.hpp"
#include "lib/core/issue.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace faultline {

/// The tables of a rosbag2 recording in SQLite: topics, and messages in the order of their numbers. Pages
/// that are damaged or missing are passed over. The file is not changed and nothing in it is trusted to run.
class MessageTable {
 public:
  /// Throws Error(input) when the file is no such recording.
  explicit MessageTable(const std::string& path);
  ~MessageTable();
  MessageTable(const MessageTable&) = delete;
  MessageTable& operator=(const MessageTable&) = delete;

  const std::vector<Topic>& topics() const { return topics_.all(); }
  /// The next message; its bytes are valid until the next call. False after the last one.
  bool next(Message& message, Issues& issues);
  void rewind();
  /// Counts work on the messages, see WorkBudget.
  void spend(std::int64_t work_ns) { budget_.spend(work_ns, file_bytes_); }
  /// Of the numbers of all messages, 0 to 1.
  double share_read() const;

 private:
  void open(const std::string& path);
  void bound_work();
  void refuse_computed(const char* table);
  [[noreturn]] void refuse_work() const;
  void read_topics();
  void find_last_number();
  bool seek(std::int64_t number);
  bool pass_damage(Issues& issues);
  bool take(Message& message, Issues& issues);
  [[noreturn]] void fail(const std::string& what) const;

  std::string path_;
  sqlite3* db_ = nullptr;
  sqlite3_stmt* messages_ = nullptr;  ///< from some number on
  TopicList topics_;
  std::map<std::int64_t, int> topic_of_id_;
  std::int64_t number_ = 0;       ///< of the last message handed out
  std::int64_t last_number_ = 0;  ///< of the file's last message, as far as it can be told
  bool at_row_ = false;           ///< a row was read by seek() and not handed out
  bool at_end_ = false;
  std::int64_t file_bytes_ = 0;
  WorkBudget budget_;         ///< of the steps of SQLite
  bool over_budget_ = false;  ///< SQLite was interrupted
};

}  // namespace faultline

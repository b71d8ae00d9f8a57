// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

struct sqlite3;
struct sqlite3_stmt;

namespace faultline {

/// The file and the journals that SQLite keeps beside it while it is changed, whether they are there or not.
/// SQLite believes what it finds in them.
std::vector<std::string> sqlite_files(const std::string& path);

enum class SqliteMode { read_only, change, create };

/// An open SQLite file; every failure throws Error(input), or Error(output) where writing failed, with the
/// file's name and SQLite's reason in words. What the file brings along is not trusted: its triggers and
/// views do not run, no function of its schema may do harm, and a statement that takes far more steps than
/// the size of the file explains is ended.
class SqliteFile {
 public:
  /// `name` stands in messages; empty: the path. The path ":memory:" is a new one that is no file.
  SqliteFile(std::string path, SqliteMode mode, std::string name = "");
  ~SqliteFile();
  SqliteFile(const SqliteFile&) = delete;
  SqliteFile& operator=(const SqliteFile&) = delete;

  void run(const char* sql);
  std::int64_t number(const char* sql);
  std::string text(const char* sql);
  /// All its bytes, as they would stand in a file.
  std::string bytes();

 private:
  friend class SqliteStatement;
  [[noreturn]] void fail(int code) const;
  void distrust_schema();
  void limit_steps(const std::string& path);

  std::string name_;
  SqliteMode mode_;
  long long steps_left_ = 0;  ///< in units of kStepsAtATime
  sqlite3* db_ = nullptr;
};

/// A prepared statement; parameters and columns count from 0 and go left to right.
class SqliteStatement {
 public:
  SqliteStatement(SqliteFile& file, const char* sql);
  ~SqliteStatement();
  SqliteStatement(const SqliteStatement&) = delete;
  SqliteStatement& operator=(const SqliteStatement&) = delete;

  SqliteStatement& bind(std::int64_t value);
  SqliteStatement& bind(double value);  ///< NaN becomes NULL
  SqliteStatement& bind(const std::string& text);
  SqliteStatement& bind_blob(std::string_view bytes);
  /// True when there is a row; after the last one the statement is ready to be bound again.
  bool step();
  std::int64_t integer(int column) const;
  double real(int column) const;  ///< NULL becomes NaN
  std::string text(int column) const;
  std::string blob(int column) const;
  int columns() const;
  /// Type and value without loss: what is different has different bytes.
  std::string exact(int column) const;

 private:
  void check(int code) const;

  SqliteFile& file_;
  sqlite3_stmt* statement_ = nullptr;
  int bound_ = 0;
};

}  // namespace faultline

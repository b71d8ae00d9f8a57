// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

struct sqlite3;
struct sqlite3_stmt;

namespace faultline {

/// Returns the paths of the file and of the journals that SQLite keeps beside it during a change, whether
/// they exist or not. SQLite applies any journal that it finds.
std::vector<std::string> sqlite_files(const std::string& path);

/// What a file is for, in the words of messages.
struct SqlitePurpose {
  std::string what;  ///< "case base"
  std::string undo;  ///< the command that rolls an interrupted change back
  std::string mend;  ///< what to do about a damaged file
};
/// That of a case base.
SqlitePurpose case_base_purpose();

enum class SqliteMode { read_only, change, create };

/// An open SQLite file; every failure throws Error(input), or Error(output) if writing failed, with the
/// file's name and SQLite's reason in words. The file's schema has no rights: its triggers and views do not
/// run, its functions are restricted, and a statement is ended once all statements have taken far more steps
/// than the size of the file explains.
class SqliteFile {
 public:
  /// `name` stands in messages; empty: the path. The path ":memory:" is a new database without a file.
  SqliteFile(const std::string& path, SqliteMode mode, const std::string& name = "",
             SqlitePurpose purpose = case_base_purpose());
  ~SqliteFile();
  SqliteFile(const SqliteFile&) = delete;
  SqliteFile& operator=(const SqliteFile&) = delete;

  void run(const char* sql);
  std::int64_t number(const char* sql);
  std::string text(const char* sql);
  /// Returns all bytes of the database, as they would stand in a file.
  std::string bytes();

 private:
  friend class SqliteStatement;
  [[noreturn]] void fail(int code) const;
  void restrict_schema();
  void limit_steps(const std::string& path);

  std::string name_;
  SqliteMode mode_;
  SqlitePurpose purpose_;
  long long steps_left_ = 0;  ///< in units of kStepsAtATime
  sqlite3* db_ = nullptr;
};

/// A prepared statement; parameters and columns count from 0, left to right.
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
  /// Whether there is a row; after the last one the statement can be bound again.
  bool step();
  std::int64_t integer(int column) const;
  double real(int column) const;  ///< NULL becomes NaN
  std::string text(int column) const;
  std::string blob(int column) const;
  int columns() const;
  /// Returns type and value without loss: different values have different bytes.
  std::string exact(int column) const;

 private:
  void check(int code) const;

  SqliteFile& file_;
  sqlite3_stmt* statement_ = nullptr;
  int bound_ = 0;
};

/// Whether a journal lies beside the SQLite file: a change is in progress or was interrupted.
bool has_journal(const std::string& path);

/// Removes the journals that a deleted file has left behind, which SQLite would apply to the next file of
/// that name.
void remove_journals(const std::string& path);

/// A private copy of an SQLite file and its journals, in which SQLite may roll back an interrupted change
/// without changing the file itself. Removed with the object.
class SettledCopy {
 public:
  /// Throws Error(input) if the file, or a folder for temporary files, cannot be used.
  explicit SettledCopy(const std::string& path);
  ~SettledCopy();
  SettledCopy(const SettledCopy&) = delete;
  SettledCopy& operator=(const SettledCopy&) = delete;

  std::string path() const { return folder_ + "/copy.db"; }
  /// False if the file changed while it was copied; then copy it again.
  bool is_of_one_moment() const { return of_one_moment_; }

 private:
  std::string folder_;
  bool of_one_moment_ = false;
};

}  // namespace faultline

// SPDX-License-Identifier: MIT
#include "lib/cases/sqlite.hpp"

#include <sqlite3.h>

#include <cmath>
#include <limits>

#include "lib/core/error.hpp"

namespace faultline {
namespace {

int open_flags(SqliteMode mode) {
  switch (mode) {
    case SqliteMode::read_only:
      return SQLITE_OPEN_READONLY;
    case SqliteMode::change:
      return SQLITE_OPEN_READWRITE;
    case SqliteMode::create:
      return SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  }
  return SQLITE_OPEN_READONLY;
}

ErrorCode code_of(int sqlite, SqliteMode mode) {
  const bool writing = sqlite == SQLITE_FULL || sqlite == SQLITE_READONLY || sqlite == SQLITE_IOERR;
  return writing && mode != SqliteMode::read_only ? ErrorCode::output : ErrorCode::input;
}

const char* advice_for(int sqlite) {
  if (sqlite == SQLITE_READONLY_ROLLBACK)
    return "holds a change that was interrupted; the next `faultline cases confirm`, `reject` or `add` rolls "
           "it back";
  switch (sqlite & 0xff) {
    case SQLITE_NOTADB:
      return "is no SQLite file; a case base written by faultline was expected";
    case SQLITE_CORRUPT:
      return "is a damaged or truncated case base; restore it from a copy or run learn again";
    case SQLITE_FULL:
      return "cannot be written, the disk is full; nothing was changed. Make room and try again";
    case SQLITE_READONLY:
      return "cannot be changed, it is read-only; nothing was changed. Check its permissions";
    case SQLITE_BUSY:
      return "is being changed by another program; try again when that has finished";
    case SQLITE_CANTOPEN:
      return "cannot be opened; check that it exists, is a file and may be read";
    case SQLITE_IOERR:
      return "cannot be read or written to its end; nothing was changed. Check the disk";
    default:
      return "is not what a case base should be";
  }
}

}  // namespace

SqliteFile::SqliteFile(std::string path, SqliteMode mode) : path_(std::move(path)), mode_(mode) {
  const int code = sqlite3_open_v2(path_.c_str(), &db_, open_flags(mode), nullptr);
  if (code != SQLITE_OK) {
    sqlite3_close(db_);
    db_ = nullptr;
    fail(code);
  }
  sqlite3_busy_timeout(db_, 5000);
}

SqliteFile::~SqliteFile() { sqlite3_close(db_); }

void SqliteFile::fail(int code) const {
  const int extended = db_ ? sqlite3_extended_errcode(db_) : code;
  const std::string reason = db_ ? sqlite3_errmsg(db_) : sqlite3_errstr(code);
  throw Error(code_of(extended & 0xff, mode_), path_,
              std::string(advice_for(extended)) + " (SQLite says: " + reason + ")");
}

void SqliteFile::run(const char* sql) {
  const int code = sqlite3_exec(db_, sql, nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) fail(code);
}

std::int64_t SqliteFile::number(const char* sql) {
  SqliteStatement statement(*this, sql);
  return statement.step() ? statement.integer(0) : 0;
}

std::string SqliteFile::text(const char* sql) {
  SqliteStatement statement(*this, sql);
  return statement.step() ? statement.text(0) : "";
}

SqliteStatement::SqliteStatement(SqliteFile& file, const char* sql) : file_(file) {
  check(sqlite3_prepare_v2(file.db_, sql, -1, &statement_, nullptr));
}

SqliteStatement::~SqliteStatement() { sqlite3_finalize(statement_); }

void SqliteStatement::check(int code) const {
  if (code != SQLITE_OK) file_.fail(code);
}

SqliteStatement& SqliteStatement::bind(std::int64_t value) {
  check(sqlite3_bind_int64(statement_, ++bound_, value));
  return *this;
}

SqliteStatement& SqliteStatement::bind(double value) {
  ++bound_;
  check(std::isnan(value) ? sqlite3_bind_null(statement_, bound_)
                          : sqlite3_bind_double(statement_, bound_, value));
  return *this;
}

SqliteStatement& SqliteStatement::bind(const std::string& text) {
  check(sqlite3_bind_text64(statement_, ++bound_, text.data(), text.size(), SQLITE_TRANSIENT, SQLITE_UTF8));
  return *this;
}

SqliteStatement& SqliteStatement::bind_blob(std::string_view bytes) {
  check(sqlite3_bind_blob64(statement_, ++bound_, bytes.data(), bytes.size(), SQLITE_TRANSIENT));
  return *this;
}

bool SqliteStatement::step() {
  const int code = sqlite3_step(statement_);
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) file_.fail(code);
  check(sqlite3_reset(statement_));
  bound_ = 0;
  return false;
}

std::int64_t SqliteStatement::integer(int column) const { return sqlite3_column_int64(statement_, column); }

double SqliteStatement::real(int column) const {
  if (sqlite3_column_type(statement_, column) == SQLITE_NULL) return std::numeric_limits<double>::quiet_NaN();
  return sqlite3_column_double(statement_, column);
}

std::string SqliteStatement::text(int column) const {
  const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
  return bytes ? std::string(bytes, sqlite3_column_bytes(statement_, column)) : std::string();
}

std::string SqliteStatement::blob(int column) const {
  const auto* bytes = static_cast<const char*>(sqlite3_column_blob(statement_, column));
  return bytes ? std::string(bytes, sqlite3_column_bytes(statement_, column)) : std::string();
}

}  // namespace faultline

// SPDX-License-Identifier: MIT
#include "lib/cases/sqlite.hpp"

#include <sqlite3.h>
#include <sys/stat.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <utility>

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

constexpr int kStepsAtATime = 10'000;
constexpr long long kLeastSteps = 50'000'000, kStepsAByte = 100;

/// Counts the steps down; SQLite ends the statement if it returns a value other than 0.
int use_up_steps(void* left) { return --*static_cast<long long*>(left) < 0 ? 1 : 0; }

ErrorCode code_of(int sqlite, SqliteMode mode) {
  const bool writing = sqlite == SQLITE_FULL || sqlite == SQLITE_READONLY || sqlite == SQLITE_IOERR;
  return writing && mode != SqliteMode::read_only ? ErrorCode::output : ErrorCode::input;
}

std::string advice_for(int sqlite, const SqlitePurpose& purpose) {
  if (sqlite == SQLITE_READONLY_ROLLBACK)
    return "holds a change that was interrupted; " + purpose.undo + " rolls it back";
  switch (sqlite & 0xff) {
    case SQLITE_NOTADB:
      return "is not an SQLite file; a " + purpose.what + " written by faultline was expected";
    case SQLITE_CORRUPT:
      return "is a damaged or truncated " + purpose.what + "; " + purpose.mend;
    case SQLITE_FULL:
      return "cannot be written, the disk is full; nothing was changed. Make room and try again";
    case SQLITE_READONLY:
      return "cannot be changed, it is read-only; nothing was changed. Check its permissions";
    case SQLITE_BUSY:
      return "is being changed by another program; try again when that has finished";
    case SQLITE_CANTOPEN:
      return "cannot be opened; check that it exists, is a file and may be read";
    case SQLITE_INTERRUPT:
      return "takes far longer to read than its size explains; it is not a " + purpose.what +
             " written by faultline";
    case SQLITE_IOERR:
      return "cannot be read or written to its end; nothing was changed. Check the disk";
    default:
      return "is not a valid " + purpose.what;
  }
}

namespace fs = std::filesystem;

constexpr std::array<const char*, 2> kJournals = {"-journal", "-wal"};

/// Returns a text that changes if the file changes; empty if there is no file.
std::string state_of(const std::string& path) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0) return "";
  std::string state;
  for (const long long part :
       {static_cast<long long>(found.st_ino), static_cast<long long>(found.st_size),
        static_cast<long long>(found.st_mtim.tv_sec), static_cast<long long>(found.st_mtim.tv_nsec)})
    state += std::to_string(part) + " ";
  return state;
}

std::string state_of_all(const std::string& path) {
  std::string state = state_of(path);
  for (const char* journal : kJournals) state += "/" + state_of(path + journal);
  return state;
}

std::string private_folder(const std::string& path) {
  std::error_code error;
  std::string name = (fs::temp_directory_path(error) / "faultline-cases-XXXXXX").string();
  if (error || !::mkdtemp(name.data()))
    throw Error(
        ErrorCode::input, path,
        "holds a change that was interrupted, and there is no folder for temporary files to undo it "
        "in; set TMPDIR to one, or undo it in place with `faultline cases confirm`, `reject` or `add`");
  return name;
}

/// Copies a file without its permissions, which may forbid writing. Returns the reason of a failure, or "".
std::string copy_bytes(const std::string& from, const std::string& to) {
  std::error_code error, ignored;
  fs::copy_file(from, to, error);
  fs::permissions(to, fs::perms::owner_read | fs::perms::owner_write, ignored);
  return error ? error.message() : "";
}

/// Copies the file and the existing journals, as copy_bytes().
std::string copy_all(const std::string& from, const std::string& to) {
  std::string failure = copy_bytes(from, to);
  for (const char* journal : kJournals)
    if (failure.empty() && !state_of(from + journal).empty())
      failure = copy_bytes(from + journal, to + journal);
  return failure;
}

}  // namespace

std::vector<std::string> sqlite_files(const std::string& path) {
  return {path, path + "-journal", path + "-wal", path + "-shm"};
}

SqlitePurpose case_base_purpose() {
  return {"case base", "the next `faultline cases confirm`, `reject` or `add`",
          "restore it from a copy or run learn again"};
}

SqliteFile::SqliteFile(const std::string& path, SqliteMode mode, const std::string& name,
                       SqlitePurpose purpose)
    : name_(name.empty() ? path : name), mode_(mode), purpose_(std::move(purpose)) {
  const int code = sqlite3_open_v2(path.c_str(), &db_, open_flags(mode), nullptr);
  if (code != SQLITE_OK) {
    sqlite3_close(db_);
    db_ = nullptr;
    fail(code);
  }
  sqlite3_busy_timeout(db_, 5000);  // ms to wait for the lock of another program
  restrict_schema();
  if (mode != SqliteMode::create) limit_steps(path);
}

SqliteFile::~SqliteFile() { sqlite3_close(db_); }

void SqliteFile::restrict_schema() {
  for (const int off : {SQLITE_DBCONFIG_TRUSTED_SCHEMA, SQLITE_DBCONFIG_ENABLE_TRIGGER,
                        SQLITE_DBCONFIG_ENABLE_VIEW, SQLITE_DBCONFIG_DQS_DDL, SQLITE_DBCONFIG_DQS_DML})
    sqlite3_db_config(db_, off, 0, nullptr);
  sqlite3_db_config(db_, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_limit(db_, SQLITE_LIMIT_LENGTH, 64 << 20);
  sqlite3_limit(db_, SQLITE_LIMIT_ATTACHED, 0);
}

void SqliteFile::limit_steps(const std::string& path) {
  std::error_code no_file;
  const auto size = std::filesystem::file_size(path, no_file);
  const long long bytes = no_file ? 0 : static_cast<long long>(size);
  steps_left_ = (kLeastSteps + kStepsAByte * bytes) / kStepsAtATime;
  sqlite3_progress_handler(db_, kStepsAtATime, use_up_steps, &steps_left_);
}

void SqliteFile::fail(int code) const {
  const int extended = db_ ? sqlite3_extended_errcode(db_) : code;
  const std::string reason = db_ ? sqlite3_errmsg(db_) : sqlite3_errstr(code);
  throw Error(code_of(extended & 0xff, mode_), name_,
              advice_for(extended, purpose_) + " (SQLite: " + reason + ")");
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

std::string SqliteFile::bytes() {
  sqlite3_int64 size = 0;
  unsigned char* image = sqlite3_serialize(db_, "main", &size, 0);
  if (!image) fail(SQLITE_NOMEM);
  std::string copy(reinterpret_cast<const char*>(image), static_cast<std::size_t>(size));
  sqlite3_free(image);
  return copy;
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

int SqliteStatement::columns() const { return sqlite3_column_count(statement_); }

std::string SqliteStatement::exact(int column) const {
  switch (sqlite3_column_type(statement_, column)) {
    case SQLITE_INTEGER:
      return "i" + std::to_string(integer(column));
    case SQLITE_FLOAT:
      return "r" + std::to_string(std::bit_cast<std::uint64_t>(real(column)));
    case SQLITE_TEXT:
      return "t" + text(column);
    case SQLITE_BLOB:
      return "b" + blob(column);
    default:
      return "n";
  }
}

bool has_journal(const std::string& path) {
  std::error_code error;
  for (const char* journal : kJournals)
    if (fs::exists(path + journal, error)) return true;
  return false;
}

void remove_journals(const std::string& path) {
  std::error_code error;
  for (const std::string& file : sqlite_files(path))
    if (file != path) fs::remove(file, error);
}

SettledCopy::SettledCopy(const std::string& path) : folder_(private_folder(path)) {
  const std::string before = state_of_all(path), failure = copy_all(path, this->path());
  of_one_moment_ = state_of_all(path) == before;
  if (failure.empty() || !of_one_moment_) return;
  std::error_code error;
  fs::remove_all(folder_, error);
  throw Error(ErrorCode::input, path,
              "holds a change that was interrupted and cannot be copied to undo it (" + failure + ")");
}

SettledCopy::~SettledCopy() {
  std::error_code error;
  fs::remove_all(folder_, error);
}

}  // namespace faultline

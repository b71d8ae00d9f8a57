// SPDX-License-Identifier: MIT
#include "lib/history/history_file.hpp"

#include <filesystem>
#include <map>

#include "lib/cases/sqlite.hpp"
#include "lib/core/error.hpp"
#include "lib/core/files/output_place.hpp"

namespace faultline {
namespace {

constexpr std::int64_t kHistoryApplication = 0x464c4849;  // "FLHI"

constexpr const char* kHistoryTables = R"(
    CREATE TABLE result(id INTEGER PRIMARY KEY, log_sha256 TEXT NOT NULL, model_sha256 TEXT NOT NULL,
      robot TEXT NOT NULL, log TEXT NOT NULL, verdict TEXT NOT NULL, start_s REAL, end_s REAL,
      digest TEXT NOT NULL, UNIQUE(log_sha256, model_sha256)) STRICT;
    CREATE TABLE finding(result INTEGER NOT NULL, position INTEGER NOT NULL, kind TEXT NOT NULL,
      joint INTEGER NOT NULL, onset_s REAL, confidence REAL, PRIMARY KEY(result, position)) STRICT, WITHOUT ROWID;
    CREATE TABLE condition(result INTEGER NOT NULL, position INTEGER NOT NULL, name TEXT NOT NULL, value REAL,
      low REAL, high REAL, normal_range REAL, unit TEXT NOT NULL,
      PRIMARY KEY(result, position)) STRICT, WITHOUT ROWID;)";

SqlitePurpose history_purpose() {
  return {"history", "the next `faultline history RESULTS --db` with this file",
          "restore it from a copy, or make it again from the results of the batches"};
}

[[noreturn]] void refuse_history(const std::string& path, const std::string& message) {
  throw Error(ErrorCode::input, path, message);
}

std::string schema_text(SqliteFile& file) {
  SqliteStatement row(file, "SELECT type, name, tbl_name, sql FROM sqlite_schema ORDER BY type, name");
  std::string text;
  while (row.step())
    for (int column = 0; column < row.columns(); ++column) text += row.exact(column) + ";";
  return text;
}

std::string history_schema() {
  SqliteFile memory(":memory:", SqliteMode::create);
  memory.run(kHistoryTables);
  return schema_text(memory);
}

/// Whether the file has no content yet, as one that was just made.
bool is_new(SqliteFile& file) {
  return file.number("PRAGMA application_id") == 0 && file.number("PRAGMA user_version") == 0 &&
         file.number("SELECT count(*) FROM sqlite_schema") == 0;
}

void create_tables(SqliteFile& file) {
  file.run(kHistoryTables);
  file.run(("PRAGMA application_id = " + std::to_string(kHistoryApplication)).c_str());
  file.run(("PRAGMA user_version = " + std::to_string(kHistorySchemaVersion)).c_str());
}

void check_history(SqliteFile& file, const std::string& path) {
  if (file.number("PRAGMA application_id") != kHistoryApplication)
    refuse_history(path,
                   "is an SQLite file of another program, not a history of faultline; give another name");
  const std::int64_t version = file.number("PRAGMA user_version");
  if (version != kHistorySchemaVersion)
    refuse_history(path,
                   "has the history schema " + std::to_string(version) + ", this program reads " +
                       std::to_string(kHistorySchemaVersion) +
                       (version > kHistorySchemaVersion ? "; update the program"
                                                        : "; make it again from the results of the batches"));
  if (schema_text(file) != history_schema())
    refuse_history(
        path,
        "has tables that differ from those of a history of faultline: it is damaged, or was changed "
        "by another program; " +
            history_purpose().mend);
  const std::string check = file.text("PRAGMA quick_check(1)");
  if (check != "ok")
    refuse_history(path, "is a damaged or truncated history (" + check + "); " + history_purpose().mend);
}

/// Refuses what SQLite would take for a new database, or wait for.
void check_place(const std::string& path, bool may_be_new) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (!std::filesystem::exists(status)) {
    if (may_be_new) return;
    refuse_history(path, "does not exist; `faultline history RESULTS --db` makes a history from results");
  }
  if (!std::filesystem::is_regular_file(status))
    refuse_history(path, "is a folder, device or pipe; a history file was expected");
  if (!may_be_new && std::filesystem::file_size(path, ignored) == 0)
    refuse_history(path, "is empty; add results to it: `faultline history RESULTS --db`");
}

void write_lists(SqliteFile& file, std::int64_t id, const HistoryRecord& record) {
  SqliteStatement finding(file, "INSERT INTO finding VALUES (?,?,?,?,?,?)");
  for (std::size_t i = 0; i < record.findings.size(); ++i) {
    const HistoryFinding& f = record.findings[i];
    finding.bind(id).bind(static_cast<std::int64_t>(i)).bind(f.kind);
    finding.bind(static_cast<std::int64_t>(f.joint.number())).bind(f.onset_s).bind(f.confidence).step();
  }
  SqliteStatement condition(file, "INSERT INTO condition VALUES (?,?,?,?,?,?,?,?)");
  for (std::size_t i = 0; i < record.condition.size(); ++i) {
    const HistoryCondition& c = record.condition[i];
    condition.bind(id).bind(static_cast<std::int64_t>(i)).bind(c.name).bind(c.value);
    condition.bind(c.ci95[0]).bind(c.ci95[1]).bind(c.normal_range).bind(c.unit).step();
  }
}

void put_record(SqliteFile& file, const HistoryRecord& record, HistoryGrowth& growth) {
  const std::string digest = digest_of(record);
  SqliteStatement known(file, "SELECT id, digest FROM result WHERE log_sha256 = ? AND model_sha256 = ?");
  known.bind(record.log_sha256).bind(record.model_sha256);
  const bool is_known = known.step();
  if (is_known && known.text(1) == digest) {
    ++growth.unchanged;
    return;
  }
  const std::int64_t id =
      is_known ? known.integer(0) : file.number("SELECT coalesce(max(id), 0) + 1 FROM result");
  ++(is_known ? growth.replaced : growth.added);
  for (const char* table : {"DELETE FROM finding WHERE result = ?", "DELETE FROM condition WHERE result = ?"})
    SqliteStatement(file, table).bind(id).step();
  SqliteStatement(file, "INSERT OR REPLACE INTO result VALUES (?,?,?,?,?,?,?,?,?)")
      .bind(id)
      .bind(record.log_sha256)
      .bind(record.model_sha256)
      .bind(record.robot)
      .bind(record.log)
      .bind(record.verdict)
      .bind(record.start_s)
      .bind(record.end_s)
      .bind(digest)
      .step();
  write_lists(file, id, record);
}

using RecordsById = std::map<std::int64_t, HistoryRecord>;

void read_lists(SqliteFile& file, RecordsById& records) {
  SqliteStatement finding(file, "SELECT * FROM finding ORDER BY result, position");
  while (finding.step())
    records[finding.integer(0)].findings.push_back({finding.text(2),
                                                    Joint::numbered(static_cast<int>(finding.integer(3))),
                                                    finding.real(4), finding.real(5)});
  SqliteStatement item(file, "SELECT * FROM condition ORDER BY result, position");
  while (item.step())
    records[item.integer(0)].condition.push_back(
        {item.text(2), item.real(3), {item.real(4), item.real(5)}, item.real(6), item.text(7)});
}

std::vector<HistoryRecord> records_in(SqliteFile& file, const std::string& path) {
  RecordsById records;
  std::map<std::int64_t, std::string> digests;
  SqliteStatement row(file, "SELECT * FROM result ORDER BY id");
  while (row.step()) {
    records[row.integer(0)] = {row.text(1), row.text(2), row.text(3), row.text(4), row.text(5),
                               row.real(6), row.real(7), {},          {}};
    digests[row.integer(0)] = row.text(8);
  }
  read_lists(file, records);
  std::vector<HistoryRecord> all;
  for (auto& [id, record] : records) {
    if (digests[id] != digest_of(record))
      refuse_history(path, "is damaged, or was changed by another program: result " + std::to_string(id) +
                               " does not match its digest; " + history_purpose().mend);
    all.push_back(std::move(record));
  }
  return all;
}

}  // namespace

HistoryGrowth add_to_history(const std::string& path, const std::vector<HistoryRecord>& records) {
  check_place(path, true);
  refuse_other_names(path);
  SqliteFile file(path, SqliteMode::create, path, history_purpose());
  file.run("BEGIN IMMEDIATE");
  if (is_new(file))
    create_tables(file);
  else
    check_history(file, path);
  HistoryGrowth growth;
  for (const HistoryRecord& record : records) put_record(file, record, growth);
  file.run("COMMIT");
  return growth;
}

std::vector<HistoryRecord> read_history(const std::string& path) {
  check_place(path, false);
  SqliteFile file(path, SqliteMode::read_only, path, history_purpose());
  file.run("BEGIN");
  check_history(file, path);
  std::vector<HistoryRecord> records = records_in(file, path);
  file.run("COMMIT");
  return records;
}

}  // namespace faultline

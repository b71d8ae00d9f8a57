// SPDX-License-Identifier: MIT
#include "lib/cases/case_schema.hpp"

#include "lib/core/error.hpp"
#include "lib/core/hash.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

constexpr std::int64_t kApplicationId = 0x464c4342;  // "FLCB"
static_assert(kApplicationId == 1179403074);

/// The tables as SQL, without significant white space.
constexpr const char* kTables = R"(
    CREATE TABLE metric(near_similarity REAL NOT NULL) STRICT;
    CREATE TABLE feature(position INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE,
                         scale REAL NOT NULL, weight REAL NOT NULL) STRICT;
    CREATE TABLE counts(features INTEGER NOT NULL, cases INTEGER NOT NULL) STRICT;
    CREATE TABLE fault_case(id INTEGER PRIMARY KEY,
      kind TEXT NOT NULL, joint INTEGER NOT NULL,
      decision_kind TEXT NOT NULL, decision_joint INTEGER NOT NULL,
      outcome TEXT NOT NULL, what_was_done TEXT NOT NULL, origin TEXT NOT NULL,
      mlp_kind TEXT NOT NULL, mlp_joint INTEGER NOT NULL, mlp_confidence REAL NOT NULL,
      rbfn_kind TEXT NOT NULL, rbfn_joint INTEGER NOT NULL, rbfn_confidence REAL NOT NULL,
      evidence REAL, features BLOB NOT NULL)"
                                R"(, log_sha256 TEXT NOT NULL, onset_s REAL, features_by TEXT NOT NULL,
      log_name TEXT NOT NULL, robot TEXT NOT NULL, person TEXT NOT NULL, date TEXT NOT NULL) STRICT;
    CREATE TABLE identity(model TEXT NOT NULL, robot TEXT NOT NULL, axes TEXT NOT NULL,
                          digest TEXT NOT NULL) STRICT;)";

/// Returns the whole schema as one text, without white space.
std::string schema_of(SqliteFile& file) {
  SqliteStatement row(file, "SELECT type, name, tbl_name, sql FROM sqlite_schema ORDER BY type, name");
  std::string text;
  while (row.step()) {
    for (int column = 0; column < row.columns(); ++column) text += row.exact(column) + ";";
    text += "\n";
  }
  std::string words;
  for (const char c : text)
    if (c != ' ' && c != '\n' && c != '\t' && c != '\r') words += c;
  return words;
}

std::string expected_schema() {
  SqliteFile memory(":memory:", SqliteMode::create);
  memory.run(kTables);
  return schema_of(memory);
}

[[noreturn]] void refuse_schema(const std::string& name, const std::string& message) {
  throw Error(ErrorCode::input, name, message);
}

/// Returns in words the first element of the schema that no case base has, for a message; may be empty.
std::string unknown_element(SqliteFile& file) {
  SqliteStatement row(file,
                      "SELECT type, name FROM sqlite_schema WHERE type NOT IN ('table', 'index') OR name NOT "
                      "IN ('metric', 'feature', 'fault_case', 'counts', 'identity', "
                      "'sqlite_autoindex_feature_1') ORDER BY type DESC, name LIMIT 1");
  if (!row.step()) return "";
  return " (it has the " + printable(row.text(0)) + " \"" + printable(row.text(1).substr(0, 64)) + "\")";
}

void add_rows(SqliteFile& file, const char* sql, Sha256& hash) {
  SqliteStatement row(file, sql);
  while (row.step())
    for (int column = 0; column < row.columns(); ++column) {
      const std::string value = row.exact(column);
      hash.update(std::to_string(value.size()) + ":");
      hash.update(value);
    }
  hash.update(";");
}

}  // namespace

void create_case_tables(SqliteFile& file) {
  file.run(kTables);
  file.run(("PRAGMA application_id = " + std::to_string(kApplicationId)).c_str());
  file.run(("PRAGMA user_version = " + std::to_string(kCaseSchemaVersion)).c_str());
}

void drop_case_tables(SqliteFile& file) {
  file.run(
      "DROP TABLE metric; DROP TABLE feature; DROP TABLE fault_case; DROP TABLE counts; DROP TABLE identity");
}

void check_case_schema(SqliteFile& file, const std::string& name) {
  const std::int64_t application = file.number("PRAGMA application_id");
  if (application != kApplicationId)
    refuse_schema(name, "is an SQLite file of another program, not a case base of faultline");
  const std::int64_t version = file.number("PRAGMA user_version");
  if (version > kCaseSchemaVersion)
    refuse_schema(name, "was written by a newer faultline (case base schema " + std::to_string(version) +
                            ", this program reads " + std::to_string(kCaseSchemaVersion) +
                            "); update the program");
  if (version < 1) refuse_schema(name, "has the unknown case base schema " + std::to_string(version));
  if (version < kCaseSchemaVersion)
    refuse_schema(name, "has the case base schema " + std::to_string(version) +
                            " of an earlier program, this one reads " + std::to_string(kCaseSchemaVersion) +
                            "; learn the model again");
  if (schema_of(file) != expected_schema())
    refuse_schema(name, "has tables that differ from those of a case base of faultline" +
                            unknown_element(file) +
                            ": it is damaged, or was changed by another program; restore it from a copy");
}

std::string case_tables_digest(SqliteFile& file) {
  Sha256 hash;
  for (const char* rows : {"SELECT * FROM metric ORDER BY rowid", "SELECT * FROM feature ORDER BY position",
                           "SELECT * FROM fault_case ORDER BY id", "SELECT * FROM counts ORDER BY rowid",
                           "SELECT model, robot, axes FROM identity ORDER BY rowid"})
    add_rows(file, rows, hash);
  return hash.hex();
}

}  // namespace faultline

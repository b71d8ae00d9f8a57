// SPDX-License-Identifier: MIT
#include "lib/cases/case_file.hpp"

#include <algorithm>
#include <bit>
#include <filesystem>

#include "lib/cases/sqlite.hpp"
#include "lib/core/error.hpp"
#include "lib/core/files/temporary_file.hpp"

namespace faultline {
namespace {

constexpr std::int64_t kApplicationId = 0x464c4342;  // "FLCB"
constexpr std::int64_t kSchemaVersion = 1;

constexpr const char* kSchema = R"(
  CREATE TABLE metric(near_similarity REAL NOT NULL) STRICT;
  CREATE TABLE feature(position INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE,
                       scale REAL NOT NULL, weight REAL NOT NULL) STRICT;
  CREATE TABLE fault_case(id INTEGER PRIMARY KEY,
                          kind TEXT NOT NULL, joint INTEGER NOT NULL,
                          decision_kind TEXT NOT NULL, decision_joint INTEGER NOT NULL,
                          outcome TEXT NOT NULL, what_was_done TEXT NOT NULL, origin TEXT NOT NULL,
                          mlp_kind TEXT NOT NULL, mlp_joint INTEGER NOT NULL, mlp_confidence REAL NOT NULL,
                          rbfn_kind TEXT NOT NULL, rbfn_joint INTEGER NOT NULL, rbfn_confidence REAL NOT NULL,
                          evidence REAL, features BLOB NOT NULL) STRICT;
  CREATE TABLE counts(features INTEGER NOT NULL, cases INTEGER NOT NULL) STRICT;
  PRAGMA application_id = 1179403074;
  PRAGMA user_version = 1;
)";
static_assert(kApplicationId == 1179403074);

/// Little-endian IEEE doubles, whatever the machine.
std::string to_bytes(const std::vector<double>& values) {
  std::string bytes;
  for (const double value : values)
    for (int shift = 0; shift < 64; shift += 8)
      bytes += static_cast<char>(std::bit_cast<std::uint64_t>(value) >> shift & 0xff);
  return bytes;
}

std::vector<double> from_bytes(const std::string& bytes) {
  std::vector<double> values;
  for (std::size_t i = 0; i + 8 <= bytes.size(); i += 8) {
    std::uint64_t bits = 0;
    for (int k = 7; k >= 0; --k) bits = bits << 8 | static_cast<unsigned char>(bytes[i + k]);
    values.push_back(std::bit_cast<double>(bits));
  }
  return values;
}

FaultLabel label_at(const SqliteStatement& row, int column) {
  return {fault_kind_from(row.text(column)), static_cast<int>(row.integer(column + 1))};
}

void bind_label(SqliteStatement& row, const FaultLabel& label) {
  row.bind(std::string(to_string(label.kind))).bind(static_cast<std::int64_t>(label.joint));
}

Metric read_metric(SqliteFile& file) {
  Metric metric;
  SqliteStatement near(file, "SELECT near_similarity FROM metric");
  if (near.step()) metric.near_similarity = near.real(0);
  SqliteStatement row(file, "SELECT name, scale, weight FROM feature ORDER BY position");
  while (row.step()) metric.features.push_back({row.text(0), row.real(1), row.real(2)});
  return metric;
}

Case case_at(const SqliteStatement& row) {
  Case c;
  c.id = row.integer(0);
  c.label = label_at(row, 1);
  c.decision = label_at(row, 3);
  c.outcome = case_outcome_from(row.text(5));
  c.what_was_done = row.text(6);
  c.origin = row.text(7);
  c.episode.mlp = {label_at(row, 8), row.real(10)};
  c.episode.rbfn = {label_at(row, 11), row.real(13)};
  c.episode.evidence = row.real(14);
  c.episode.features = from_bytes(row.blob(15));
  return c;
}

std::vector<Case> read_cases(SqliteFile& file) {
  std::vector<Case> cases;
  SqliteStatement row(
      file,
      "SELECT id, kind, joint, decision_kind, decision_joint, outcome, what_was_done, origin, "
      "mlp_kind, mlp_joint, mlp_confidence, rbfn_kind, rbfn_joint, rbfn_confidence, evidence, "
      "features FROM fault_case ORDER BY id");
  while (row.step()) cases.push_back(case_at(row));
  return cases;
}

void write_metric(SqliteFile& file, const Metric& metric) {
  file.run("DELETE FROM metric; DELETE FROM feature");
  SqliteStatement(file, "INSERT INTO metric VALUES (?)").bind(metric.near_similarity).step();
  SqliteStatement row(file, "INSERT INTO feature VALUES (?, ?, ?, ?)");
  for (std::size_t i = 0; i < metric.features.size(); ++i) {
    const Feature& f = metric.features[i];
    row.bind(static_cast<std::int64_t>(i)).bind(f.name).bind(f.scale).bind(f.weight).step();
  }
}

void write_case(SqliteStatement& row, const Case& c) {
  row.bind(c.id);
  bind_label(row, c.label);
  bind_label(row, c.decision);
  row.bind(std::string(to_string(c.outcome))).bind(c.what_was_done).bind(c.origin);
  bind_label(row, c.episode.mlp.label);
  row.bind(c.episode.mlp.confidence);
  bind_label(row, c.episode.rbfn.label);
  row.bind(c.episode.rbfn.confidence).bind(c.episode.evidence).bind_blob(to_bytes(c.episode.features)).step();
}

void write_counts(SqliteFile& file, const CaseBase& base) {
  file.run("DELETE FROM counts");
  SqliteStatement(file, "INSERT INTO counts VALUES (?, ?)")
      .bind(static_cast<std::int64_t>(base.metric().features.size()))
      .bind(static_cast<std::int64_t>(base.cases().size()))
      .step();
}

void write_content(SqliteFile& file, const CaseBase& base) {
  write_metric(file, base.metric());
  file.run("DELETE FROM fault_case");
  SqliteStatement row(file, "INSERT INTO fault_case VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)");
  for (const Case& c : base.cases()) write_case(row, c);
  write_counts(file, base);
}

[[noreturn]] void refuse(const std::string& path, const std::string& message) {
  throw Error(ErrorCode::input, path, message);
}

void check_file(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found)
    refuse(path,
           "there is no such case base; learn writes one beside the model as " + case_base_path("MODEL"));
  if (status.type() == std::filesystem::file_type::directory)
    refuse(path, "is a directory, a case base file was expected");
  if (std::filesystem::is_regular_file(status) && std::filesystem::file_size(path, error) == 0)
    refuse(path, "is empty, a case base was expected; restore it from a copy or run learn again");
}

void check_schema(SqliteFile& file, const std::string& path) {
  const std::int64_t application = file.number("PRAGMA application_id");
  if (application != kApplicationId)
    refuse(path, "is an SQLite file of another program, not a case base of faultline");
  const std::int64_t version = file.number("PRAGMA user_version");
  if (version > kSchemaVersion)
    refuse(path, "was written by a newer faultline (case base schema " + std::to_string(version) +
                     ", this program knows " + std::to_string(kSchemaVersion) + "); update the program");
  if (version != kSchemaVersion) refuse(path, "has the unknown case base schema " + std::to_string(version));
  const std::string check = file.text("PRAGMA quick_check(1)");
  if (check != "ok")
    refuse(path, "is a damaged or truncated case base (" + check + "); restore it from a copy");
}

CaseBase read_content(SqliteFile& file, const std::string& path) try {
  check_schema(file, path);
  CaseBase base(read_metric(file), read_cases(file));
  const auto features = file.number("SELECT features FROM counts"),
             cases = file.number("SELECT cases FROM counts");
  if (features != std::ssize(base.metric().features) || cases != std::ssize(base.cases()))
    refuse(path, "is incomplete: it should hold " + std::to_string(cases) + " cases and holds " +
                     std::to_string(base.cases().size()));
  return base;
} catch (const Error& error) {
  if (error.where() == path) throw;
  refuse(path, "is a damaged case base: " + std::string(error.what()));
}

}  // namespace

std::string case_base_path(const std::string& model) { return model + ".cases.db"; }

CaseBase read_case_base(const std::string& path) {
  check_file(path);
  SqliteFile file(path, SqliteMode::read_only);
  return read_content(file, path);
}

void write_case_base(const std::string& path, const CaseBase& base) try {
  TemporaryFile temporary(path);
  {
    SqliteFile file(temporary.path(), SqliteMode::create);
    file.text("PRAGMA journal_mode = OFF");  // nobody sees the file before it is whole
    file.run("BEGIN IMMEDIATE");
    file.run(kSchema);
    write_content(file, base);
    file.run("COMMIT");
  }
  temporary.commit();
} catch (const Error& error) {
  throw Error(
      ErrorCode::output, path,
      "the case base cannot be written; nothing was left under that name. Check that the folder exists, is "
      "writable and has room (" +
          error.message() + ")");
} catch (const std::filesystem::filesystem_error& error) {
  throw Error(ErrorCode::output, path, std::string("the case base cannot be written (") + error.what() + ")");
}

void change_case_base(const std::string& path, const std::function<void(CaseBase&)>& change) {
  check_file(path);
  SqliteFile file(path, SqliteMode::change);
  file.text("PRAGMA journal_mode = DELETE");  // one file, also when another tool had left it in WAL mode
  file.run("BEGIN IMMEDIATE");
  CaseBase base = read_content(file, path);
  change(base);
  write_content(file, base);
  file.run("COMMIT");
}

}  // namespace faultline

// SPDX-License-Identifier: MIT
#include "lib/cases/case_file.hpp"

#include <bit>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "lib/cases/case_schema.hpp"
#include "lib/cases/sqlite.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/files/output_place.hpp"

namespace faultline {
namespace {

constexpr int kCopyAttempts = 5;

[[noreturn]] void refuse_file(const std::string& path, const std::string& message) {
  throw Error(ErrorCode::input, path, message);
}

void check_file(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found)
    refuse_file(path, "does not exist; `faultline learn` writes a case base beside the model as " +
                          case_base_path("MODEL"));
  if (status.type() == std::filesystem::file_type::directory)
    refuse_file(path, "is a directory; a case base file was expected");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    refuse_file(path, "is a device or pipe; a case base file was expected");
  if (std::filesystem::is_regular_file(status) && std::filesystem::file_size(path, error) == 0)
    refuse_file(path, "is empty; a case base was expected. Restore it from a copy or run learn again");
}

void check_whole(SqliteFile& file, const std::string& path) {
  const std::string check = file.text("PRAGMA quick_check(1)");
  if (check != "ok")
    refuse_file(path, "is a damaged or truncated case base (" + check + "); restore it from a copy");
  if (file.text("SELECT digest FROM identity") != case_tables_digest(file))
    refuse_file(path,
                "is damaged, or was changed by another program: its content does not match its digest; "
                "restore it from a copy or run learn again");
}

void check_counts(SqliteFile& file, const std::string& path, const CaseBase& base) {
  const auto features = file.number("SELECT features FROM counts"),
             cases = file.number("SELECT cases FROM counts");
  if (features != std::ssize(base.metric().features) || cases != std::ssize(base.cases()))
    refuse_file(path, "is incomplete: it should hold " + std::to_string(cases) + " cases and holds " +
                          std::to_string(base.cases().size()));
}

/// Returns the values as little-endian IEEE doubles on any machine.
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

/// Returns the joint of a number, or one of number -1, which the base refuses, if it is out of range.
Joint joint_from(std::int64_t number) {
  return Joint::numbered(number >= 0 && number <= 1000 ? static_cast<int>(number) : -1);
}

FaultLabel label_at(const SqliteStatement& row, int column) {
  return {fault_kind_from(row.text(column)), joint_from(row.integer(column + 1))};
}

void bind_label(SqliteStatement& row, const FaultLabel& label) {
  row.bind(std::string(to_string(label.kind))).bind(static_cast<std::int64_t>(label.joint.number()));
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
  c.log_sha256 = row.text(16);
  c.onset_s = row.real(17);
  c.features_by = row.text(18);
  c.log_name = row.text(19);
  c.robot = row.text(20);
  c.person = row.text(21);
  c.date = row.text(22);
  return c;
}

void write_case(SqliteStatement& row, const Case& c) {
  row.bind(c.id);
  bind_label(row, c.label);
  bind_label(row, c.decision);
  row.bind(std::string(to_string(c.outcome))).bind(c.what_was_done).bind(c.origin);
  bind_label(row, c.episode.mlp.label);
  row.bind(c.episode.mlp.confidence);
  bind_label(row, c.episode.rbfn.label);
  row.bind(c.episode.rbfn.confidence).bind(c.episode.evidence).bind_blob(to_bytes(c.episode.features));
  row.bind(c.log_sha256).bind(c.onset_s).bind(c.features_by);
  row.bind(c.log_name).bind(c.robot).bind(c.person).bind(c.date).step();
}

void write_metric(SqliteFile& file, const Metric& metric) {
  SqliteStatement(file, "INSERT INTO metric VALUES (?)").bind(metric.near_similarity).step();
  SqliteStatement row(file, "INSERT INTO feature VALUES (?, ?, ?, ?)");
  for (std::size_t i = 0; i < metric.features.size(); ++i) {
    const Feature& f = metric.features[i];
    row.bind(static_cast<std::int64_t>(i)).bind(f.name).bind(f.scale).bind(f.weight).step();
  }
}

/// Reads the tables of a case base without checking whether they are complete and consistent.
Metric metric_in_tables(SqliteFile& file) {
  Metric metric;
  SqliteStatement near(file, "SELECT near_similarity FROM metric");
  if (near.step()) metric.near_similarity = near.real(0);
  SqliteStatement row(file, "SELECT name, scale, weight FROM feature ORDER BY position");
  while (row.step()) metric.features.push_back({row.text(0), row.real(1), row.real(2)});
  return metric;
}

std::vector<Case> cases_in_tables(SqliteFile& file) {
  std::vector<Case> cases;
  SqliteStatement row(file, "SELECT * FROM fault_case ORDER BY id");  // columns as in check_case_schema()
  while (row.step()) cases.push_back(case_at(row));
  return cases;
}

void fill_tables(SqliteFile& file, const CaseBase& base) {
  write_metric(file, base.metric());
  SqliteStatement row(file, "INSERT INTO fault_case VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)");
  for (const Case& c : base.cases()) write_case(row, c);
  SqliteStatement(file, "INSERT INTO counts VALUES (?, ?)")
      .bind(static_cast<std::int64_t>(base.metric().features.size()))
      .bind(static_cast<std::int64_t>(base.cases().size()))
      .step();
}

/// Reads the base within a transaction of the caller, so that all statements see the same state of the file.
CaseBase read_content(SqliteFile& file, const std::string& path) try {
  check_case_schema(file, path);
  check_whole(file, path);
  CaseBase base(metric_in_tables(file), cases_in_tables(file));
  check_counts(file, path, base);
  base.belong_to(file.text("SELECT model FROM identity"));
  base.describe_robot({file.text("SELECT robot FROM identity"), file.text("SELECT axes FROM identity")});
  return base;
} catch (const Error& error) {
  if (error.where() == path) throw;
  refuse_file(path, "is a damaged case base: " + std::string(error.what()));
}

CaseBase read_at_one_moment(SqliteFile& file, const std::string& path) {
  file.run("BEGIN");
  CaseBase base = read_content(file, path);
  file.run("COMMIT");
  return base;
}

/// Returns nothing if the file changed meanwhile.
std::optional<CaseBase> read_settled(const std::string& path) {
  const SettledCopy copy(path);
  if (!copy.is_of_one_moment()) return {};
  SqliteFile file(copy.path(), SqliteMode::change, path);
  return read_at_one_moment(file, path);
}

CaseBase read_in_place(const std::string& path) {
  SqliteFile file(path, SqliteMode::read_only);
  return read_at_one_moment(file, path);
}

void fill(SqliteFile& file, const CaseBase& base) {
  create_case_tables(file);
  fill_tables(file, base);
  SqliteStatement(file, "INSERT INTO identity VALUES (?, ?, ?, '')")
      .bind(base.model_identity())
      .bind(base.robot().name)
      .bind(base.robot().axes)
      .step();
  SqliteStatement(file, "UPDATE identity SET digest = ?").bind(case_tables_digest(file)).step();
}

void write_new(const std::string& path, const CaseBase& base) {
  SqliteFile memory(":memory:", SqliteMode::create, path);
  fill(memory, base);
  AtomicFile file(path);
  file.write(memory.bytes());
  remove_journals(path);
  file.commit();
}

/// Replaces the content of the file by what `make` returns for the open file, in one transaction.
void rewrite(const std::string& path, const std::function<CaseBase(SqliteFile& file)>& make) {
  check_file(path);
  refuse_other_names(path);
  SqliteFile file(path, SqliteMode::change);
  file.text("PRAGMA journal_mode = DELETE");  // one file, even if another tool had left it in WAL mode
  file.run("BEGIN IMMEDIATE");
  check_case_schema(file, path);
  const CaseBase base = make(file);
  drop_case_tables(file);
  fill(file, base);
  file.run("COMMIT");
}

[[noreturn]] void fail_to_write(const std::string& path, const std::string& reason) {
  throw Error(ErrorCode::output, path,
              "the case base cannot be written; the previous file is unchanged. Check that the folder "
              "exists, is writable and has room (" +
                  reason + ")");
}

}  // namespace

std::string case_base_path(const std::string& model) { return model + ".cases.db"; }

bool has_case_base(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) return false;
  return !std::filesystem::is_regular_file(status) || std::filesystem::file_size(path, error) > 0;
}

CaseBase read_case_base(const std::string& path) {
  check_file(path);
  if (!has_journal(path)) return read_in_place(path);
  for (int attempt = 1;; ++attempt) {
    try {
      return read_in_place(path);  // a change in progress may finish
    } catch (const Error&) {
      if (attempt == kCopyAttempts) throw;
    }
    if (std::optional<CaseBase> base = read_settled(path)) return *std::move(base);
  }
}

void write_case_base(const std::string& path, const CaseBase& base) try {
  if (has_case_base(path))
    rewrite(path, [&](SqliteFile&) { return base; });
  else
    write_new(path, base);
} catch (const Error& error) {
  if (error.code() == ErrorCode::input) throw;
  fail_to_write(path, error.message());
}

void replace_case_base(const std::string& path, const std::function<CaseBase(const CaseBase* there)>& make) {
  if (!has_case_base(path)) return write_case_base(path, make(nullptr));
  rewrite(path, [&](SqliteFile& file) {
    const CaseBase there = read_content(file, path);
    return make(&there);
  });
}

void change_case_base(const std::string& path, const std::function<void(CaseBase&)>& change) {
  rewrite(path, [&](SqliteFile& file) {
    CaseBase base = read_content(file, path);
    change(base);
    return base;
  });
}

}  // namespace faultline

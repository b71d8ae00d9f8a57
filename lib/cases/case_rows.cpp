// SPDX-License-Identifier: MIT
#include "lib/cases/case_rows.hpp"

#include <bit>

namespace faultline {
namespace {

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

/// A joint that is no int becomes one that the base refuses.
int joint_from(std::int64_t joint) { return joint >= 0 && joint <= 1000 ? static_cast<int>(joint) : -1; }

FaultLabel label_at(const SqliteStatement& row, int column) {
  return {fault_kind_from(row.text(column)), joint_from(row.integer(column + 1))};
}

void bind_label(SqliteStatement& row, const FaultLabel& label) {
  row.bind(std::string(to_string(label.kind))).bind(static_cast<std::int64_t>(label.joint));
}

Case case_at(const SqliteStatement& row, std::int64_t version) {
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
  if (version == 1) return c;
  c.log_sha256 = row.text(16);
  c.onset_s = row.real(17);
  c.features_by = row.text(18);
  if (version == 2) return c;
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

}  // namespace

Metric metric_in_tables(SqliteFile& file) {
  Metric metric;
  SqliteStatement near(file, "SELECT near_similarity FROM metric");
  if (near.step()) metric.near_similarity = near.real(0);
  SqliteStatement row(file, "SELECT name, scale, weight FROM feature ORDER BY position");
  while (row.step()) metric.features.push_back({row.text(0), row.real(1), row.real(2)});
  return metric;
}

std::vector<Case> cases_in_tables(SqliteFile& file, std::int64_t version) {
  std::string columns =
      "id, kind, joint, decision_kind, decision_joint, outcome, what_was_done, origin, mlp_kind, mlp_joint, "
      "mlp_confidence, rbfn_kind, rbfn_joint, rbfn_confidence, evidence, features";
  if (version > 1) columns += ", log_sha256, onset_s, features_by";
  if (version > 2) columns += ", log_name, robot, person, date";
  std::vector<Case> cases;
  SqliteStatement row(file, ("SELECT " + columns + " FROM fault_case ORDER BY id").c_str());
  while (row.step()) cases.push_back(case_at(row, version));
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

}  // namespace faultline

// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lib/golden/comparison.hpp"
#include "lib/golden/observation.hpp"

namespace faultline {

/// A file of a golden folder, by its path in it, and what its content must be.
struct GoldenFile {
  std::string path;
  std::string sha256;
};

struct GoldenLog {
  GoldenFile log;
  GoldenFile trace;
  Observation expected;  ///< its trace is read from the file beside
  Tolerances tolerances;
  std::string damage;  ///< what is wrong with its files; empty when nothing is

  /// File name without folders.
  std::string name() const { return std::filesystem::path(log.path).filename().string(); }
};

struct GoldenIdentification {
  std::vector<std::string> logs;  ///< names
  ObservedIdentification expected;
  Tolerances tolerances;
};

inline constexpr const char* kIdentification = "identification";
inline constexpr const char* kModelItem = "model";

/// What golden.toml says: the model, the logs, what is expected of each and how exactly.
struct GoldenSet {
  std::string program_version;  ///< that it was recorded with
  std::string model_name;
  int joints = 0;
  GoldenFile model;
  GoldenFile cases;                          ///< sha256 of the case base's content
  std::vector<ParameterValue> model_values;  ///< values_of()
  int trace_points = 500;
  Tolerances tolerances;
  std::optional<GoldenIdentification> identification;
  std::vector<GoldenLog> logs;

  /// Paths in the folder of the model, the cases, the logs and their traces.
  std::vector<std::string> files() const;
  ToleranceChain chain(const GoldenLog& log) const { return {&log.tolerances, &tolerances}; }
  ToleranceChain chain(const GoldenIdentification& identified) const {
    return {&identified.tolerances, &tolerances};
  }
  ToleranceChain chain() const { return {&tolerances}; }
};

/// golden.toml (docs/golden.md): the same set gives the same text.
std::string golden_text(const GoldenSet& set);
/// Without the traces. Throws Error(input) for text that is no golden file, is cut or does not fit together.
GoldenSet golden_from_text(const std::string& text, const std::string& where);

}  // namespace faultline

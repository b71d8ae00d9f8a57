// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "formats/open_log.hpp"
#include "lib/core/error.hpp"
#include "lib/core/hash.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {

/// What was read of bytes that may be damaged, or why nothing was.
struct ReadArrays {
  Log log;
  LogIdentity identity;
  Issues issues;
  std::string refused;

  /// The extra channel of this name, empty when there is none.
  std::vector<double> extra(const std::string& name) const {
    for (const ExtraChannel& channel : log.extra)
      if (channel.name == name) return channel.values;
    return {};
  }
};

inline ReadArrays read_array_file(const std::string& path, const OpenLogOptions& options = {}) {
  ReadArrays result;
  try {
    const auto source = open_log(path, options);
    result.log = read_all(*source);
    result.identity = source->identity();
    result.issues = source->issues();
    EXPECT_EQ(result.identity.rows_read, result.log.rows() + result.issues.rows_dropped());
    EXPECT_EQ(result.identity.sha256, sha256_of_file(path));
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input);
    result.refused = error.what();
  }
  return result;
}

inline ReadArrays read_bytes(const std::string& bytes, const OpenLogOptions& options = {}) {
  static const TemporaryFolder folder;
  return read_array_file(folder.write("log", bytes), options);
}

/// A log of `joints` joints whose values tell their place.
inline Log numbered_log(int rows, int joints) {
  Log log;
  for (JointSignals* signals : {&log.q, &log.dq, &log.tau}) signals->resize(static_cast<std::size_t>(joints));
  for (int i = 0; i < rows; ++i) {
    log.time.push_back(0.01 * i);
    for (int j = 0; j < joints; ++j) {
      log.q[static_cast<std::size_t>(j)].push_back(i + 0.1 * j);
      log.dq[static_cast<std::size_t>(j)].push_back(-i - 0.1 * j);
      log.tau[static_cast<std::size_t>(j)].push_back(1.0 / (1 + i + j));
    }
  }
  return log;
}

}  // namespace faultline

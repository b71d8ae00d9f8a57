// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "formats/open_log.hpp"
#include "lib/core/error.hpp"
#include "lib/core/hash.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {

/// A log read in full, with what was found wrong in it.
struct ReadLog {
  Log log;
  LogIdentity identity;
  Issues issues;
};

inline ReadLog read_csv(const std::string& text, const OpenLogOptions& options = {}) {
  const TemporaryFolder folder;
  const auto source = open_log(folder.write("log.csv", text), options);
  ReadLog result;
  result.log = read_all(*source);
  result.identity = source->identity();
  result.issues = source->issues();
  EXPECT_EQ(result.identity.rows_read, result.log.rows() + result.issues.rows_dropped());
  EXPECT_EQ(result.identity.sha256, sha256_hex(text));
  return result;
}

inline std::string why_refused(const std::string& text, const OpenLogOptions& options = {}) {
  const TemporaryFolder folder;
  try {
    const auto source = open_log(folder.write("log.csv", text), options);
    read_all(*source);
  } catch (const Error& error) {
    return error.what();
  }
  return "was read";
}

}  // namespace faultline

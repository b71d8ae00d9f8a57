// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tests/support/skip_unless_installed.hpp"

namespace faultline {

/// Name of a schema in docs/schemas, such as "diagnosis-1", and the file of a document.
using SchemaAndDocument = std::pair<std::string, std::string>;

struct SchemaVerdict {
  bool can_judge = true;             ///< false where python3-jsonschema is missing
  bool valid = false;                ///< all documents are as their schemas say
  std::string text;                  ///< what is wrong
  std::vector<std::string> is_open;  ///< "NAME PATH" of objects that take any member
};

/// Judges documents by docs/schemas; of .ndjson each line is one.
SchemaVerdict judge_by_schema(const std::vector<SchemaAndDocument>& documents);

}  // namespace faultline

/// Fails unless the documents are as their schemas say; says so and passes where nothing can judge them.
#define EXPECT_FOLLOWS_SCHEMA(...)                                                                    \
  if (const ::faultline::SchemaVerdict verdict = ::faultline::judge_by_schema({__VA_ARGS__}); true) { \
    SKIP_UNLESS_INSTALLED(verdict.can_judge, verdict.text);                                           \
    EXPECT_TRUE(verdict.valid) << verdict.text;                                                       \
  }

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <chrono>

#include "lib/core/atomic_file.hpp"
#include "tests/fuzz/readers/readers.hpp"
#include "tests/fuzz/seed_files.hpp"

/// Files that once crashed a reader, or took it too long, and one whole file of each kind: every reader takes
/// or refuses each of them.
namespace faultline {
namespace {

constexpr double kLongest_s = 5.0;

class PastCrashes : public testing::TestWithParam<FedReader> {};

TEST_P(PastCrashes, DoNotRecur) {
  const std::vector<std::string> paths = seed_files();
  ASSERT_GT(paths.size(), 8u);
  for (const std::string& path : paths) {
    SCOPED_TRACE(path);
    const std::string bytes = read_file(path);
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_NO_THROW(GetParam().feed(bytes));
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), kLongest_s);
  }
}

INSTANTIATE_TEST_SUITE_P(Readers, PastCrashes, testing::ValuesIn(fed_readers()),
                         [](const auto& reader) { return reader.param.name; });

}  // namespace
}  // namespace faultline

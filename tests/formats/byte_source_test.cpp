// SPDX-License-Identifier: MIT
#include "formats/byte_source.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "lib/core/error.hpp"
#include "tests/support/limits.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

constexpr rlim_t kFewFiles = 48;

/// Longer than the head that is read at once.
std::string long_text(char c) { return std::string(200000, c); }

std::string rest_of(ByteSource& source) {
  std::string all, part(50000, '\0');
  for (std::size_t got; (got = source.read(part.data(), part.size())) > 0;) all.append(part, 0, got);
  return all;
}

TEST(ByteSource, ManyFilesNeedFewDescriptors) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a", long_text('a'));
  const Limit limit(RLIMIT_NOFILE, kFewFiles);
  std::vector<std::unique_ptr<ByteSource>> sources;
  for (int i = 0; i < 200; ++i) sources.push_back(std::make_unique<ByteSource>(path));
  for (int time = 0; time < 2; ++time)
    for (const auto& source : sources) {
      ASSERT_EQ(rest_of(*source), long_text('a'));
      source->rewind();
    }
}

TEST(ByteSource, AFileThatWasReplacedMeanwhileIsRefused) {
  const TemporaryFolder folder;
  ByteSource source(folder.write("a", long_text('a')));
  std::filesystem::rename(folder.write("b", long_text('b')), folder.file("a"));
  EXPECT_THROW(rest_of(source), Error);
}

TEST(ByteSource, WithoutItsHashAFileReadsTheSame) {
  const TemporaryFolder folder;
  ByteSource source(folder.write("a", long_text('a')), false);
  for (int time = 0; time < 2; ++time, source.rewind()) {
    EXPECT_EQ(rest_of(source), long_text('a'));
    EXPECT_EQ(source.sha256(), "");
  }
}

}  // namespace
}  // namespace faultline

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "lib/core/atomic_file.hpp"
#include "lib/core/random.hpp"
#include "tests/fuzz/readers/readers.hpp"
#include "tests/fuzz/seed_files.hpp"

/// Seeds, changed at random in the same way each time: what a fuzzer would try first, in every run of the
/// suite. tests/fuzz/run.sh looks further.
namespace faultline {
namespace {

constexpr int kMutationsOfASeed = 40;
constexpr std::size_t kLongestSeed = 65536;

std::size_t place_in(const std::string& bytes, Random& random) {
  return std::min(bytes.size(),
                  static_cast<std::size_t>(random.uniform() * static_cast<double>(bytes.size())));
}

std::string mutated(std::string bytes, Random& random) {
  const int changes = 1 + static_cast<int>(4.0 * random.uniform());
  for (int i = 0; i < changes && !bytes.empty(); ++i) {
    const std::size_t at = std::min(place_in(bytes, random), bytes.size() - 1);
    const double what = random.uniform();
    if (what < 0.4)
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << static_cast<int>(8.0 * random.uniform())));
    else if (what < 0.6)
      bytes[at] = static_cast<char>(256.0 * random.uniform());
    else if (what < 0.75)
      bytes.insert(at, bytes.substr(place_in(bytes, random), 64));
    else if (what < 0.9)
      bytes.erase(at, 1 + static_cast<std::size_t>(32.0 * random.uniform()));
    else
      bytes.resize(at);
  }
  return bytes;
}

class MutatedSeeds : public testing::TestWithParam<FedReader> {};

TEST_P(MutatedSeeds, AreReadOrRefused) {
  std::vector<std::string> paths = seed_files();
  std::erase_if(paths,
                [](const std::string& path) { return std::filesystem::file_size(path) > kLongestSeed; });
  ASSERT_FALSE(paths.empty());
  Random random(1);
  for (const std::string& path : paths) {
    const std::string bytes = read_file(path);
    for (int i = 0; i < kMutationsOfASeed; ++i) {
      SCOPED_TRACE(path + ", mutation " + std::to_string(i));
      EXPECT_NO_THROW(GetParam().feed(mutated(bytes, random)));
    }
  }
}

constexpr int kMutationsOfACase = 15;

TEST(MutatedCases, OfLogFormatsAreReadOrRefused) {
  Random random(2);
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(FAULTLINE_SOURCE_DIR "/tests/formats/cases")) {
    if (!entry.path().filename().string().starts_with("input")) continue;
    const std::string bytes = read_file(entry.path());
    for (int i = 0; i < kMutationsOfACase; ++i) {
      SCOPED_TRACE(entry.path().string() + ", mutation " + std::to_string(i));
      EXPECT_NO_THROW(feed_log(mutated(bytes, random)));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Readers, MutatedSeeds, testing::ValuesIn(fed_readers()),
                         [](const auto& reader) { return reader.param.name; });

}  // namespace
}  // namespace faultline

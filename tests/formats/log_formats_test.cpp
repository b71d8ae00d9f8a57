// SPDX-License-Identifier: MIT
#include "formats/log_formats.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "formats/log_writer.hpp"
#include "formats/open_log.hpp"
#include "lib/core/error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

Log short_log() {
  Log log;
  log.time = {0.0, 0.25, 0.5};
  log.q = {{1.0, 2.0, 3.0}};
  return log;
}

TEST(LogFormats, EachHasItsOwnNameAndExtensions) {
  std::set<std::string> names, extensions;
  for (const LogFormat& format : log_formats()) {
    EXPECT_TRUE(names.insert(format.name).second) << format.name;
    for (const std::string& extension : format.extensions)
      EXPECT_TRUE(extensions.insert(extension).second) << extension;
  }
  EXPECT_EQ(log_extensions().size(), extensions.size());
}

TEST(LogFormats, AWrittenLogIsRecognisedByItsContentUnderAnyName) {
  const TemporaryFolder folder;
  ASSERT_GE(written_formats().size(), 2u);
  for (const LogFormat& format : written_formats()) {
    const std::string path = folder.file("log" + format.extensions.front()), other = folder.file("log.other");
    write_log(path, short_log());
    std::filesystem::copy_file(path, other, std::filesystem::copy_options::overwrite_existing);
    const auto source = open_log(other);
    const Log log = read_all(*source);
    EXPECT_EQ(source->identity().format, format.name);
    EXPECT_EQ(log.time, short_log().time) << format.name;
    EXPECT_EQ(log.q, short_log().q) << format.name;
  }
}

TEST(LogFormats, AnUnknownExtensionIsRefusedWithTheKnownOnes) {
  try {
    create_log("log.xyz");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    EXPECT_TRUE(error.message().starts_with("the extension decides the format of a log: use .csv (text), "))
        << error.message();
    EXPECT_TRUE(error.message().ends_with(" or .flog (binary, exact, fast)")) << error.message();
  }
}

TEST(LogFormats, ChoicesAreJoinedWithOr) {
  EXPECT_EQ(either_of({"a"}), "a");
  EXPECT_EQ(either_of({"a", "b"}), "a or b");
  EXPECT_EQ(either_of({"a", "b", "c"}), "a, b or c");
}

}  // namespace
}  // namespace faultline

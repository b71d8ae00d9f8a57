// SPDX-License-Identifier: MIT
#include "lib/batch/page/packed.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

/// As the programs base64 and gzip of the system unpack it.
std::string unpacked(const std::string& text) {
  const TemporaryFolder folder;
  const std::string command = "base64 -d '" + folder.write("packed", text) + "' | gzip -dc";
  std::FILE* const run = popen(command.c_str(), "r");
  std::string out;
  for (int c; run && (c = std::fgetc(run)) != EOF;) out += static_cast<char>(c);
  EXPECT_EQ(pclose(run), 0);
  return out;
}

TEST(Packed, OtherProgramsUnpackIt) {
  std::string long_text;
  for (int i = 0; i < 100000; ++i) long_text += std::to_string(i * 7919 % 1009) + ",";
  for (const std::string& text :
       {std::string(), std::string("a"), std::string("\0\xff</script>", 11), long_text})
    EXPECT_EQ(unpacked(packed(text)), text);
  EXPECT_LT(packed(long_text).size(), long_text.size() / 2);
}

TEST(Packed, TheSameTextGivesTheSameBytes) { EXPECT_EQ(packed("one two"), packed("one two")); }

}  // namespace
}  // namespace faultline

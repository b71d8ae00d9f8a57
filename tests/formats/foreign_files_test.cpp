// SPDX-License-Identifier: MIT
// Files of other programs: text in UTF-16 is read, other formats are refused by name with the way out.
#include <zlib.h>

#include <cmath>

#include "tests/formats/read_csv.hpp"

namespace faultline {
namespace {

/// Returns the text in UTF-16; `text` holds characters up to U+FFFF.
std::string utf16(std::u16string_view text, bool high_first, bool with_mark = true) {
  std::string bytes;
  const auto put = [&](char16_t unit) {
    const char high = static_cast<char>(unit >> 8), low = static_cast<char>(unit & 0xFF);
    bytes += high_first ? high : low;
    bytes += high_first ? low : high;
  };
  if (with_mark) put(0xFEFF);
  for (const char16_t unit : text) put(unit);
  return bytes;
}

void expect_refused_with(const std::string& bytes, const std::vector<const char*>& words) {
  const std::string why = why_refused(bytes);
  for (const char* word : words) EXPECT_NE(why.find(word), std::string::npos) << word << " in: " << why;
}

TEST(Utf16, TextOfBothByteOrdersIsRead) {
  for (const bool high_first : {false, true}) {
    const Log log =
        read_csv(utf16(u"t;q1 [\u00B0];\u7535\u6D41\r\n0;180;1,5\r\n0,1;90;2,5\r\n", high_first)).log;
    EXPECT_EQ(log.time, (std::vector<double>{0, 0.1}));
    EXPECT_DOUBLE_EQ(log.q[0][0], M_PI);
    ASSERT_EQ(log.extra.size(), 1u);
    EXPECT_EQ(log.extra[0].name, "\xE7\x94\xB5\xE6\xB5\x81");
  }
}

TEST(Utf16, ATextLongerThanTheHeadOfTheFileIsReadTwice) {
  std::u16string text = u"t,q1\n";
  for (int i = 0; i < 40000; ++i) {
    for (const char c : std::to_string(i) + "," + std::to_string(2 * i) + "\n")
      text += static_cast<char16_t>(c);
  }
  const TemporaryFolder folder;
  const auto source = open_log(folder.write("log.csv", utf16(text, false)), {});
  for (int time = 0; time < 2; ++time, source->rewind()) {
    const Log log = read_all(*source);
    ASSERT_EQ(log.rows(), 40000);
    EXPECT_EQ(log.q[0].back(), 79998);
  }
}

TEST(Utf16, PairsOfSurrogatesAndHalvesOfThemAreConverted) {
  const auto name_in = [](std::u16string_view name) {
    const Log log = read_csv(utf16(u"t,q1," + std::u16string(name) + u"\n0,1,2\n1,2,3\n", false)).log;
    return log.extra.at(0).name;
  };
  EXPECT_EQ(name_in(u"a\U0001F600b"),
            "a\xF0\x9F\x98\x80"
            "b");
  const char16_t half[] = {u'a', 0xD83D, u'b', 0xDE00, u'c', 0};
  EXPECT_EQ(name_in(half),
            "a\xEF\xBF\xBD"
            "b\xEF\xBF\xBD"
            "c");
}

TEST(Utf16, ACutCharacterAtTheEndIsReportedAndTheRowsBeforeItAreRead) {
  const auto [log, identity, issues] = read_csv(utf16(u"t,q1\n0,1\n1,2\n", false) + "3");
  EXPECT_EQ(log.rows(), 2);
  const Issue* issue = issues.find("compression_damaged");
  ASSERT_NE(issue, nullptr);
  EXPECT_NE(issue->message.find("UTF-16"), std::string::npos) << issue->message;
}

TEST(Utf16, WithoutAByteOrderMarkItIsRefusedWithTheCommandThatConvertsIt) {
  expect_refused_with(utf16(u"t,q1\n0,1\n", false, false), {"iconv -f UTF-16LE -t UTF-8"});
  expect_refused_with(utf16(u"t,q1\n0,1\n", true, false), {"iconv -f UTF-16BE -t UTF-8"});
}

TEST(Utf16, InsideGzipItIsRefusedByName) {
  const TemporaryFolder folder;
  const std::string path = folder.file("log.csv.gz"), text = utf16(u"t,q1\n0,1\n", false);
  gzFile file = gzopen(path.c_str(), "wb");
  gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
  gzclose(file);
  try {
    open_log(path, {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.message().find("UTF-16"), std::string::npos) << error.message();
  }
}

TEST(ForeignFiles, AreRefusedByNameWithTheWayOut) {
  const std::string zeros(64, '\0');
  expect_refused_with("TDSm" + zeros, {"TDMS", "nptdms.TdmsFile.read(\"run.tdms\")", "to_csv"});
  expect_refused_with("MDF     4.10    " + zeros, {"MDF file", "asammdf.MDF(\"run.mf4\")", "raster"});
  expect_refused_with("UnFinMF 4.10    " + zeros, {"did not finish", "asammdf.MDF"});
  expect_refused_with("\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1" + zeros,
                      {"Excel", "libreoffice --headless --convert-to csv run.xls"});
  expect_refused_with(std::string("ARROW1\0\0", 8), {"Feather", "pandas.read_feather"});
  expect_refused_with("\x01\x02" + zeros, {"unknown format"});
}

}  // namespace
}  // namespace faultline

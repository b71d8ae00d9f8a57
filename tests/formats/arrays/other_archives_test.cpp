// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "formats/bytes/little_endian.hpp"
#include "tests/formats/arrays/read_bytes.hpp"

namespace faultline {
namespace {

/// A ZIP archive of stored files of one byte.
std::string zip_of(const std::vector<std::string>& names) {
  ByteBuilder all, directory;
  for (const std::string& name : names) {
    ByteBuilder fields;
    for (int i = 0; i < 5; ++i) fields.put(std::uint16_t{0});  // version, flags, method, time, date
    fields.put(std::uint32_t{0xE8B7BE43});                     // CRC-32 of "a"
    fields.put(std::uint32_t{1}).put(std::uint32_t{1});        // packed and unpacked bytes
    fields.put(static_cast<std::uint16_t>(name.size())).put(std::uint16_t{0});
    directory.put_bytes("PK\x01\x02").put(std::uint16_t{0}).put_bytes(fields.bytes());
    for (int i = 0; i < 5; ++i) directory.put(std::uint16_t{0});  // comment, disk, attributes
    directory.put(static_cast<std::uint32_t>(all.bytes().size())).put_bytes(name);
    all.put_bytes("PK\x03\x04").put_bytes(fields.bytes()).put_bytes(name).put_bytes("a");
  }
  const auto at = static_cast<std::uint32_t>(all.bytes().size()),
             size = static_cast<std::uint32_t>(directory.bytes().size());
  const auto count = static_cast<std::uint16_t>(names.size());
  all.put_bytes(directory.bytes()).put_bytes("PK\x05\x06").put(std::uint32_t{0}).put(count).put(count);
  all.put(size).put(at).put(std::uint16_t{0});
  return all.bytes();
}

void expect_refused(const std::vector<std::string>& names, const std::string& what) {
  const std::string refused = read_bytes(zip_of(names)).refused;
  EXPECT_NE(refused.find(what), std::string::npos) << refused;
  EXPECT_EQ(refused.find("no array of numbers"), std::string::npos) << refused;
}

TEST(OtherArchives, AnExcelWorkbookIsRefusedWithTheAdviceToSaveItAsCsv) {
  expect_refused({"[Content_Types].xml", "xl/workbook.xml", "xl/worksheets/sheet1.xml"},
                 "is an Excel workbook; save");
}

TEST(OtherArchives, AnOpenDocumentSheetIsRefusedWithTheAdviceToSaveItAsCsv) {
  expect_refused({"mimetype", "content.xml"}, "is an OpenDocument file; save");
}

TEST(OtherArchives, AZipOfLogsIsRefusedWithTheNamesOfTheLogs) {
  expect_refused({"robot/", "robot/axes.csv", "log.ulg"},
                 "it holds robot/axes.csv, log.ulg. Unpack it first");
}

TEST(OtherArchives, AnEmptyZipIsRefusedAsEmpty) { expect_refused({}, "is an empty ZIP archive"); }

}  // namespace
}  // namespace faultline

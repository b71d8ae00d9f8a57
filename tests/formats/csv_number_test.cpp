// SPDX-License-Identifier: MIT
// Every number of a text table is the double that strtod() gives.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "formats/csv/wide_rows.hpp"
#include "lib/core/random.hpp"

namespace faultline {
namespace {

constexpr int kNumbers = 25000;  // of a kind
constexpr int kFields = 7;

/// Numbers as rows of a table, and what is read of them.
class NumberTable {
 public:
  void add(const std::string& number) { numbers_.push_back(number); }

  void expect_strtod() {
    while (numbers_.size() % kFields != 0) numbers_.push_back("0.5");
    const int rows = static_cast<int>(numbers_.size()) / kFields;
    std::string text(kNumberMargin, 'x');
    for (std::size_t i = 0; i < numbers_.size(); ++i)
      text += numbers_[i] + (i % kFields == kFields - 1 ? "\n" : ",");
    const std::size_t size = text.size();
    text.append(kNumberMargin, '7');
    std::vector<std::vector<double>> values(kFields, std::vector<double>(rows, -1.0));
    std::vector<double*> columns;
    for (auto& column : values) columns.push_back(column.data());
    WideRows wide(',', '.');
    if (!wide.can_read()) GTEST_SKIP() << "this processor reads numbers one by one";
    const char* p = text.data() + kNumberMargin;
    EXPECT_EQ(wide.read(p, text.data() + size, columns, 0, rows), rows);
    EXPECT_EQ(p, text.data() + size);
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      const double expected = std::strtod(numbers_[i].c_str(), nullptr);
      const double got = values[i % kFields][i / kFields];
      ASSERT_EQ(std::bit_cast<std::uint64_t>(got), std::bit_cast<std::uint64_t>(expected)) << numbers_[i];
    }
  }

 private:
  std::vector<std::string> numbers_;
};

int below(Random& random, int limit) { return static_cast<int>(random.uniform() * limit); }

std::string digits(Random& random, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += static_cast<char>('0' + below(random, 10));
  return text;
}

double any_double(Random& random) {
  while (true) {
    std::uint64_t bits = 0;
    for (int i = 0; i < 4; ++i) bits = bits << 16 | static_cast<std::uint64_t>(below(random, 1 << 16));
    const double value = std::bit_cast<double>(bits);
    if (std::isfinite(value)) return value;
  }
}

double as_in_a_log(Random& random) { return std::ldexp(random.normal(), below(random, 40) - 30); }

TEST(CsvNumber, DigitsOfAnyLengthAndPlaceOfTheSignAreRoundedCorrectly) {
  NumberTable table;
  Random random(1);
  for (int i = 0; i < kNumbers; ++i) {
    std::string text = (below(random, 2) ? "-" : "") + digits(random, below(random, 22)) + "." +
                       digits(random, below(random, 24) + (i % 3 == 0 ? 14 : 1));
    if (i % 4 == 0) text += fmt::format("e{}", below(random, 700) - 350);
    table.add(text);
  }
  table.expect_strtod();
}

TEST(CsvNumber, ShortestAndFixedTextOfLogsIsRoundedCorrectly) {
  NumberTable table;
  Random random(2);
  for (int i = 0; i < kNumbers; ++i) {
    const double value = as_in_a_log(random);
    table.add(fmt::format("{}", value));
    table.add(fmt::format("{:.{}f}", value, 1 + below(random, 20)));
    table.add(fmt::format("{:.{}e}", value, below(random, 20)));
  }
  table.expect_strtod();
}

TEST(CsvNumber, NumbersOfEveryExponentAreReadExactly) {
  NumberTable table;
  Random random(3);
  for (int i = 0; i < kNumbers; ++i) {
    const double value = any_double(random);
    table.add(fmt::format("{}", value));
    table.add(fmt::format("{:.{}e}", value, 14 + below(random, 6)));
    const double subnormal = value * std::numeric_limits<double>::min() / std::pow(2.0, std::ilogb(value));
    table.add(fmt::format("{:.{}e}", subnormal / 4096.0, 14 + below(random, 6)));
  }
  table.expect_strtod();
}

TEST(CsvNumber, ANumberHalfwayBetweenTwoDoublesRoundsToTheEvenOne) {
  NumberTable table;
  Random random(4);
  for (int i = 0; i < kNumbers; ++i) {
    const double low = std::abs(as_in_a_log(random)) + 1e-300;
    const long double between =
        (static_cast<long double>(low) + std::nextafter(low, std::numeric_limits<double>::infinity())) / 2.0L;
    table.add(fmt::format("{:.{}f}", between, 15 + below(random, 50)));
    const double large = std::ldexp(1.0 + random.uniform(), 53 + below(random, 9));
    const auto odd = static_cast<std::uint64_t>(large) + (std::uint64_t{1} << (std::ilogb(large) - 53));
    table.add(fmt::format("{}.0", odd));
    table.add(fmt::format("{}", odd));
    table.add(fmt::format("{}.{}", odd / 1000, odd % 1000));
  }
  table.expect_strtod();
}

TEST(CsvNumber, UnusualFormsAreReadAsByStrtod) {
  NumberTable table;
  for (const char* text : {"0",
                           "-0",
                           "0.0",
                           "-0.0",
                           "-0.000000",
                           "0.0000000000000000000000000000000000001",
                           "000000.5",
                           ".5",
                           "-.5",
                           "5.",
                           "-5.",
                           "1e5",
                           "1E5",
                           "1e+5",
                           "1e-5",
                           "1.e5",
                           ".5e-3",
                           "9007199254740993.",
                           "1e400",
                           "-1e400",
                           "1e-400",
                           "123456789012345678901234567890",
                           "1.7976931348623157e308",
                           "1.7976931348623159e308",
                           "4.9e-324",
                           "2.4e-324",
                           "2.5e-324",
                           "2.2250738585072011e-308",
                           "9999999999999999.5",
                           "999.9999999999999999",
                           "1000.0000000000000000",
                           "1000000000000000000.5",
                           "18446744073709551615.0",
                           "18446744073709551616.0",
                           "1e0005",
                           "1e-00000005",
                           "0.00000000000000000000000000000000000000000000000000000001e60",
                           "inf",
                           "-inf"})
    table.add(text);
  table.expect_strtod();
}

TEST(CsvNumber, TextThatIsNotANumberIsNotRead) {
  WideRows wide(',', '.');
  for (const std::string cell : {"",        "-",     ".",    "-.",   "e5",   "1e",   "1e+", "1.5e",
                                 "1.2.3",   "--1.5", "+1.5", "1.5 ", "1.5x", "0x10", "1,5", "\"1.5\"",
                                 "1.5e5.0", "1-1.5", "1.5-", "/.5",  ":.5",  "1:.5", "1./5"}) {
    std::string text = std::string(kNumberMargin, '1') + cell + "\n";
    const std::size_t size = text.size();
    text.append(kNumberMargin, '1');
    double value = 0.0;
    const char* p = text.data() + kNumberMargin;
    EXPECT_EQ(wide.can_read() ? wide.read(p, text.data() + size, {&value}, 0, 1) : 0, 0) << cell;
    EXPECT_EQ(p, text.data() + kNumberMargin);
  }
}

TEST(CsvNumber, AnEmptyCellIsMissingButAnEmptyRowIsLeftToTheOtherReader) {
  WideRows wide('\t', '.');
  if (!wide.can_read()) GTEST_SKIP() << "this processor reads numbers one by one";
  std::string text = std::string(kNumberMargin, '1') + "0.5\t\n\t2.5\r\n\t \r\n";
  const std::size_t size = text.size();
  text.append(kNumberMargin, '1');
  std::vector<double> first(3, 0.0), second(3, 0.0);
  const char* p = text.data() + kNumberMargin;
  EXPECT_EQ(wide.read(p, text.data() + size, {first.data(), second.data()}, 0, 3), 2);
  EXPECT_EQ(p, text.data() + size - 4);
  EXPECT_TRUE(std::isnan(second[0]) && std::isnan(first[1]));
  EXPECT_EQ(first[0], 0.5);
  EXPECT_EQ(second[1], 2.5);
}

}  // namespace
}  // namespace faultline

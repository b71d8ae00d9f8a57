// SPDX-License-Identifier: MIT
#include "lib/report/html/html_report.hpp"

#include <gtest/gtest.h>

#include <set>

#include "lib/core/error.hpp"
#include "lib/report/text.hpp"
#include "tests/report/example_details.hpp"

namespace faultline {
namespace {

TEST(ReportFormats, EachHasItsOwnName) {
  std::set<std::string> names;
  for (const ReportFormat& format : report_formats()) {
    EXPECT_TRUE(names.insert(format.name).second) << format.name;
    EXPECT_EQ(&report_format(format.name), &format);
  }
  EXPECT_TRUE(names.count("json") && names.count("html"));
}

TEST(ReportFormats, OnlyFormatsOfASecondPassRequestDetails) {
  const Diagnosis d = faulty_diagnosis();
  for (const ReportFormat& format : report_formats()) {
    int asked = 0;
    const ReportSource source{d, [&] {
                                ++asked;
                                return example_details(d);
                              }};
    EXPECT_FALSE(format.render(source).empty()) << format.name;
    EXPECT_EQ(asked, format.second_pass ? 1 : 0) << format.name;
  }
}

TEST(ReportFormats, RenderTheFormatOfTheirName) {
  const Diagnosis d = faulty_diagnosis();
  const ReportSource source{d, [&] { return example_details(d); }};
  EXPECT_EQ(report_format("json").render(source), render_json(d));
  EXPECT_EQ(report_format("html").render(source), render_html(d, example_details(d)));
}

TEST(ReportFormats, AnUnknownNameIsADefect) {
  try {
    report_format("pdf");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::internal);
    EXPECT_EQ(error.where(), "pdf");
  }
}

}  // namespace
}  // namespace faultline

// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "lib/core/markup.hpp"
#include "lib/golden/check_text.hpp"

namespace faultline {
namespace {

std::string body(const CheckedItem& item, const GoldenCheck& check) {
  if (!item.damage.empty())
    return fmt::format("      <error type=\"damaged\" message=\"{}\"/>\n", escaped_markup(item.damage));
  if (item.same()) return "";
  return fmt::format("      <failure type=\"{}\" message=\"{}\">{}</failure>\n",
                     item.changes_verdict() ? "verdict" : "mismatch", escaped_markup(divergence_text(item)),
                     escaped_markup(unified_difference(item, check)));
}

}  // namespace

std::string render_check_junit(const GoldenCheck& check, const std::string& suite) {
  const auto errors = std::count_if(check.items.begin(), check.items.end(),
                                    [](const CheckedItem& item) { return !item.damage.empty(); });
  const auto same = std::count_if(check.items.begin(), check.items.end(),
                                  [](const CheckedItem& item) { return item.same(); });
  const std::string name = escaped_markup(suite);
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n  <testsuite name=\"{}\" tests=\"{}\" "
      "failures=\"{}\" errors=\"{}\">\n",
      name, check.items.size(), std::ssize(check.items) - same - errors, errors);
  for (const CheckedItem& item : check.items) {
    const std::string inner = body(item, check);
    text += fmt::format("    <testcase classname=\"{}\" name=\"{}\"{}", name, escaped_markup(item.name),
                        inner.empty() ? "/>\n" : ">\n" + inner + "    </testcase>\n");
  }
  return text + "  </testsuite>\n</testsuites>\n";
}

}  // namespace faultline

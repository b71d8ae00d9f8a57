// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/markup.hpp"
#include "lib/core/number_text.hpp"
#include "lib/core/paint.hpp"
#include "lib/core/text.hpp"
#include "lib/golden/check.hpp"

namespace faultline {
namespace {

std::string result_word(const CheckedItem& item) {
  if (!item.damage.empty()) return "DAMAGED";
  if (item.same()) return "same";
  return fmt::format("{} differ{}", item.comparison.differences.size(),
                     item.changes_verdict() ? ", also in the findings" : "");
}

std::string change(const std::string& expected, const std::string& actual) {
  return expected == actual ? expected : expected + " -> " + actual;
}

std::string cell(const std::string& text, std::size_t width) {
  return text + std::string(width > text.size() ? width - text.size() : 0, ' ');
}

std::string table(const GoldenCheck& check, bool color) {
  std::size_t name = 3, verdict = 7;
  for (const CheckedItem& item : check.items) {
    name = std::max(name, printable(item.name).size());
    verdict = std::max(verdict, change(item.verdict_expected, item.verdict_actual).size());
  }
  std::string text =
      cell("log", name) + "  " + cell("verdict", verdict) + "  " + cell("events", 8) + "result\n";
  for (const CheckedItem& item : check.items) {
    const bool is_log = item.name != kIdentification && item.name != kModelItem;
    const std::string events =
        is_log ? change(fmt::format("{}", item.events_expected), fmt::format("{}", item.events_actual)) : "";
    text += cell(printable(item.name), name) + "  " +
            cell(item.damage.empty() ? change(item.verdict_expected, item.verdict_actual) : "-", verdict) +
            "  " + cell(item.damage.empty() ? events : "-", 8) +
            painted(result_word(item), item.same() ? Paint::bold_green : Paint::bold_red, color) + "\n";
  }
  return text;
}

std::string summary(const GoldenCheck& check) {
  const auto count = [&](auto&& which) {
    return std::count_if(check.items.begin(), check.items.end(), which);
  };
  const auto damaged = count([](const CheckedItem& i) { return !i.damage.empty(); });
  const auto same = count([](const CheckedItem& i) { return i.same(); });
  const auto different = std::ssize(check.items) - same - damaged;
  const auto found = count([](const CheckedItem& i) { return i.changes_verdict(); });
  const std::string where = different == 0 ? "" : fmt::format(" ({} also in the findings)", found);
  return fmt::format("{} of {} as expected, {} different{}, {} damaged.\n", same, check.items.size(),
                     different, where, damaged);
}

std::string body(const CheckedItem& item, const GoldenCheck& check) {
  if (!item.damage.empty())
    return fmt::format("      <error type=\"damaged\" message=\"{}\"/>\n", escaped_markup(item.damage));
  if (item.same()) return "";
  return fmt::format("      <failure type=\"{}\" message=\"{}\">{}</failure>\n",
                     item.changes_verdict() ? "verdict" : "mismatch", escaped_markup(divergence_text(item)),
                     escaped_markup(unified_difference(item, check)));
}

}  // namespace

std::string divergence_text(const CheckedItem& item) {
  const Difference* first = first_divergence(item.comparison);
  if (!first) return "";
  std::string text = "first divergence";
  if (!std::isnan(first->time_s)) text += " at " + seconds_text(first->time_s);
  text += fmt::format(": {} is {}, expected {}", first->channel,
                      first->actual.empty() ? "missing" : printable(first->actual),
                      first->expected.empty() ? "none" : printable(first->expected));
  if (!std::isnan(first->allowed) && first->channel != "rows")
    text += fmt::format(" (allowed +-{:.3g})", first->allowed);
  return text;
}

std::string unified_difference(const CheckedItem& item, const GoldenCheck& check, bool color) {
  std::string text =
      painted(fmt::format("--- {}: expected by {}", printable(item.name), printable(check.expected_by)),
              Paint::bold, color) +
      "\n" +
      painted(fmt::format("+++ {}: {}", printable(item.name), printable(check.actual_by)), Paint::bold,
              color) +
      "\n";
  for (const DiffLine& line : item.comparison.lines) {
    if (!line.differs) {
      text += "  " + printable(line.expected) + "\n";
      continue;
    }
    if (!line.expected.empty())
      text += painted("- " + printable(line.expected), Paint::bold_red, color) + "\n";
    if (!line.actual.empty()) text += painted("+ " + printable(line.actual), Paint::bold_green, color) + "\n";
  }
  return text;
}

std::string render_check_text(const GoldenCheck& check, bool color) {
  std::string text = table(check, color);
  for (const CheckedItem& item : check.items) {
    if (item.same()) continue;
    text += "\n" + painted(printable(item.name), Paint::bold, color) + ": ";
    if (!item.damage.empty())
      text += printable(item.damage) + "\n";
    else
      text += divergence_text(item) + "\n" + unified_difference(item, check, color);
  }
  return text + "\n" + summary(check);
}

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

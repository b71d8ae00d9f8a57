// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <charconv>
#include <string_view>

#include "lib/core/error.hpp"
#include "lib/golden/observation.hpp"

namespace faultline {
namespace {

[[noreturn]] void damaged(const std::string& where, int line, const std::string& what) {
  throw Error(ErrorCode::input, fmt::format("{}, line {}", where, line),
              what + "; the trace is damaged: restore it, or record a new one with faultline golden accept");
}

std::string_view cut(std::string_view& text, char at) {
  const std::size_t end = text.find(at);
  const std::string_view head = text.substr(0, end);
  text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
  return head;
}

double number(std::string_view field, const std::string& where, int line) {
  double value = 0.0;
  const auto [end, code] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (code != std::errc() || end != field.data() + field.size())
    damaged(where, line, fmt::format("expected a number, found \"{}\"", field));
  return value;
}

}  // namespace

std::string trace_to_csv(const Trace& trace) {
  std::string text = fmt::format("t,{}\n", fmt::join(trace.channels, ","));
  for (int i = 0; i < trace.points(); ++i) {
    text += fmt::format("{}", trace.time[i]);
    for (const auto& values : trace.values) text += fmt::format(",{:.9g}", values[i]);
    text += '\n';
  }
  return text;
}

Trace trace_from_csv(const std::string& text, const std::string& where) {
  std::string_view rest = text;
  std::string_view head = cut(rest, '\n');
  if (cut(head, ',') != "t") damaged(where, 1, "expected a header that begins with \"t,\"");
  Trace trace;
  while (!head.empty()) trace.channels.emplace_back(cut(head, ','));
  trace.values.resize(trace.channels.size());
  for (int line = 2; !rest.empty(); ++line) {
    std::string_view row = cut(rest, '\n');
    trace.time.push_back(number(cut(row, ','), where, line));
    for (auto& values : trace.values) values.push_back(number(cut(row, ','), where, line));
    if (!row.empty()) damaged(where, line, "more fields than channels");
  }
  return trace;
}

}  // namespace faultline

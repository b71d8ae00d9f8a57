// SPDX-License-Identifier: MIT
#include "lib/robot/urdf/urdf_element.hpp"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <charconv>
#include <cmath>
#include <sstream>

#include "lib/core/error.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

constexpr std::size_t kShownLetters = 60;

/// A text of the file as messages quote it.
std::string quoted(const std::string& text) {
  const bool is_long = text.size() > kShownLetters;
  return "\"" + printable(text.substr(0, kShownLetters)) + (is_long ? "..." : "") + "\"";
}

std::optional<double> finite_number(const std::string& word) {
  const char* begin = word.data() + (word.size() > 1 && word[0] == '+' && word[1] != '-');
  const char* end = word.data() + word.size();
  double value = 0.0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

std::optional<UrdfElement> UrdfElement::child(const std::string& name) const {
  const tinyxml2::XMLElement* first = element_->FirstChildElement(name.c_str());
  if (!first) return std::nullopt;
  if (first->NextSiblingElement(name.c_str())) fail(fmt::format("has more than one <{}>; one counts", name));
  return UrdfElement(*first, file_);
}

UrdfElement UrdfElement::required(const std::string& name) const {
  const auto found = child(name);
  if (!found) fail(fmt::format("has no <{}>, which it needs", name));
  return *found;
}

std::vector<UrdfElement> UrdfElement::children() const {
  std::vector<UrdfElement> found;
  for (auto* e = element_->FirstChildElement(); e; e = e->NextSiblingElement()) found.emplace_back(*e, file_);
  return found;
}

std::string UrdfElement::tag() const { return element_->Name(); }
int UrdfElement::line() const { return element_->GetLineNum(); }

std::string UrdfElement::content() const {
  std::string all;
  for (auto* node = element_->FirstChild(); node; node = node->NextSibling())
    if (const tinyxml2::XMLText* text = node->ToText()) all += text->Value();
  return all;
}

bool UrdfElement::has(const std::string& attribute) const {
  return element_->Attribute(attribute.c_str()) != nullptr;
}

std::string UrdfElement::text(const std::string& attribute) const {
  const char* value = element_->Attribute(attribute.c_str());
  if (!value || !*value) fail(fmt::format("has no {}, which it needs", attribute));
  return value;
}

double UrdfElement::number(const std::string& attribute) const { return numbers(attribute, 1)[0]; }

double UrdfElement::number(const std::string& attribute, double fallback) const {
  return has(attribute) ? number(attribute) : fallback;
}

Eigen::Vector3d UrdfElement::vector(const std::string& attribute, const Eigen::Vector3d& fallback) const {
  if (!has(attribute)) return fallback;
  const auto values = numbers(attribute, 3);
  return {values[0], values[1], values[2]};
}

std::vector<double> UrdfElement::numbers(const std::string& attribute, std::size_t count) const {
  const std::string all = text(attribute);
  std::vector<double> values;
  std::istringstream words(all);
  bool understood = true;
  for (std::string word; values.size() <= count && words >> word;) {
    const auto value = finite_number(word);
    understood = understood && value;
    values.push_back(value.value_or(0.0));
  }
  if (!understood || values.size() != count)
    fail(fmt::format("has {} = {}; expected {}{}", attribute, quoted(all),
                     count == 1 ? "a finite number" : fmt::format("{} finite numbers", count),
                     all.find("${") == std::string::npos ? "" : ". Expand the file by xacro first"));
  return values;
}

void UrdfElement::fail(const std::string& message) const {
  const char* name = element_->Attribute("name");
  throw Error(
      ErrorCode::input,
      fmt::format("{}, line {}, <{}>{}", file_, line(), printable(tag()), name ? " " + quoted(name) : ""),
      message);
}

}  // namespace faultline

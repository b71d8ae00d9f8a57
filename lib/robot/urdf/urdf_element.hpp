// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace tinyxml2 {
class XMLElement;
}

namespace faultline {

/// An element of a URDF file, which knows where it stands: every failure throws Error(input) naming file,
/// line, element and what to do. Keeps the XML library out of the headers. Valid while the document lives.
class UrdfElement {
 public:
  UrdfElement(const tinyxml2::XMLElement& element, const std::string& file)
      : element_(&element), file_(file) {}

  /// The only child of that name, if there is one.
  std::optional<UrdfElement> child(const std::string& name) const;
  UrdfElement required(const std::string& name) const;
  std::vector<UrdfElement> children() const;

  std::string tag() const;
  int line() const;
  /// The text between the tags.
  std::string content() const;
  bool has(const std::string& attribute) const;
  /// An attribute that is there and not empty.
  std::string text(const std::string& attribute) const;
  /// A finite number; the second form gives `fallback` when there is no such attribute.
  double number(const std::string& attribute) const;
  double number(const std::string& attribute, double fallback) const;
  /// Three of them.
  Eigen::Vector3d vector(const std::string& attribute, const Eigen::Vector3d& fallback) const;

  [[noreturn]] void fail(const std::string& message) const;

 private:
  std::vector<double> numbers(const std::string& attribute, std::size_t count) const;

  const tinyxml2::XMLElement* element_;
  std::string file_;
};

}  // namespace faultline

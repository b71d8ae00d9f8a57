// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <tinyxml2.h>

#include <Eigen/Core>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "lib/core/error.hpp"
#include "lib/core/text.hpp"
#include "lib/robot/turns.hpp"
#include "lib/robot/urdf/urdf_model.hpp"

namespace faultline {
namespace {

constexpr std::uintmax_t kMostBytes = 32u << 20;  ///< a URDF has some 100 kB, without the files of its meshes
constexpr std::size_t kShownLetters = 60;

using Places = std::map<std::string, int>;  ///< index of each link by name

/// Returns a text of the file as messages quote it.
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

/// An element of a URDF file with its position: every failure throws Error(input) naming file, line, element
/// and what to do. Valid as long as the document exists.
class UrdfElement {
 public:
  UrdfElement(const tinyxml2::XMLElement& element, const std::string& file)
      : element_(&element), file_(file) {}

  /// Returns the child of that name, empty if there is none; fails if there are several.
  std::optional<UrdfElement> child(const std::string& name) const {
    const tinyxml2::XMLElement* first = element_->FirstChildElement(name.c_str());
    if (!first) return std::nullopt;
    if (first->NextSiblingElement(name.c_str()))
      fail(fmt::format("has more than one <{}>; only one is allowed", name));
    return UrdfElement(*first, file_);
  }

  UrdfElement required(const std::string& name) const {
    const auto found = child(name);
    if (!found) fail(fmt::format("has no <{}>, which is required", name));
    return *found;
  }

  std::vector<UrdfElement> children() const {
    std::vector<UrdfElement> found;
    for (auto* e = element_->FirstChildElement(); e; e = e->NextSiblingElement())
      found.emplace_back(*e, file_);
    return found;
  }

  std::string tag() const { return element_->Name(); }
  int line() const { return element_->GetLineNum(); }

  /// The text between the tags.
  std::string content() const {
    std::string all;
    for (auto* node = element_->FirstChild(); node; node = node->NextSibling())
      if (const tinyxml2::XMLText* text = node->ToText()) all += text->Value();
    return all;
  }

  bool has(const std::string& attribute) const { return element_->Attribute(attribute.c_str()) != nullptr; }

  /// Returns an attribute; fails if it is absent or empty.
  std::string text(const std::string& attribute) const {
    const char* value = element_->Attribute(attribute.c_str());
    if (!value || !*value) fail(fmt::format("has no {}, which is required", attribute));
    return value;
  }

  /// A finite number; the second form returns `fallback` if the attribute is absent.
  double number(const std::string& attribute) const { return numbers(attribute, 1)[0]; }
  double number(const std::string& attribute, double fallback) const {
    return has(attribute) ? number(attribute) : fallback;
  }

  /// Three finite numbers, or `fallback` if the attribute is absent.
  Eigen::Vector3d vector(const std::string& attribute, const Eigen::Vector3d& fallback) const {
    if (!has(attribute)) return fallback;
    const auto values = numbers(attribute, 3);
    return {values[0], values[1], values[2]};
  }

  [[noreturn]] void fail(const std::string& message) const {
    const char* name = element_->Attribute("name");
    throw Error(
        ErrorCode::input,
        fmt::format("{}, line {}, <{}>{}", file_, line(), printable(tag()), name ? " " + quoted(name) : ""),
        message);
  }

 private:
  std::vector<double> numbers(const std::string& attribute, std::size_t count) const {
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

  const tinyxml2::XMLElement* element_;
  std::string file_;
};

/// Returns the name of an error in words: "mismatched element" for XML_ERROR_MISMATCHED_ELEMENT.
std::string words_of(tinyxml2::XMLError error) {
  std::string words = tinyxml2::XMLDocument::ErrorIDToName(error);
  for (const char* prefix : {"XML_ERROR_", "XML_"})
    if (words.rfind(prefix, 0) == 0) words.erase(0, std::string(prefix).size());
  std::transform(words.begin(), words.end(), words.begin(), [](char c) {
    return c == '_' ? ' ' : static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c);
  });
  return words;
}

Eigen::Isometry3d origin_of(const UrdfElement& element) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const auto origin = element.child("origin");
  if (!origin) return pose;
  pose.linear() = turn_rpy(origin->vector("rpy", Eigen::Vector3d::Zero()));
  pose.translation() = origin->vector("xyz", Eigen::Vector3d::Zero());
  return pose;
}

UrdfLink link_of(const UrdfElement& element) {
  UrdfLink link{element.text("name"), element.line(), {}};
  const auto inertial = element.child("inertial");
  if (!inertial) return link;
  const UrdfElement inertia = inertial->required("inertia");
  Eigen::Matrix3d tensor =
      Eigen::Vector3d(inertia.number("ixx"), inertia.number("iyy"), inertia.number("izz")).asDiagonal();
  tensor(0, 1) = tensor(1, 0) = inertia.number("ixy", 0.0);
  tensor(0, 2) = tensor(2, 0) = inertia.number("ixz", 0.0);
  tensor(1, 2) = tensor(2, 1) = inertia.number("iyz", 0.0);
  const Eigen::Isometry3d pose = origin_of(*inertial);
  const double mass = inertial->required("mass").number("value");
  link.body =
      seen_from(general_body(mass, Eigen::Vector3d::Zero(), tensor), pose.linear(), pose.translation());
  return link;
}

UrdfJointType type_of(const UrdfElement& element) {
  static const std::map<std::string, UrdfJointType> types = {
      {"revolute", UrdfJointType::revolute},   {"continuous", UrdfJointType::continuous},
      {"prismatic", UrdfJointType::prismatic}, {"fixed", UrdfJointType::fixed},
      {"floating", UrdfJointType::floating},   {"planar", UrdfJointType::planar}};
  const auto found = types.find(element.text("type"));
  if (found == types.end())
    element.fail(
        fmt::format("has the type \"{}\"; expected revolute, continuous, prismatic, fixed, floating or "
                    "planar",
                    printable(element.text("type"))));
  return found->second;
}

int link_named_in(const UrdfElement& joint, const char* end, const Places& places) {
  const std::string name = joint.required(end).text("link");
  const auto found = places.find(name);
  if (found == places.end())
    joint.fail(
        fmt::format("has as its {} the link \"{}\", which the file does not have", end, printable(name)));
  return found->second;
}

UrdfJoint joint_of(const UrdfElement& element, const Places& places) {
  UrdfJoint joint;
  joint.name = element.text("name");
  joint.line = element.line();
  joint.type = type_of(element);
  joint.parent = link_named_in(element, "parent", places);
  joint.child = link_named_in(element, "child", places);
  joint.origin = origin_of(element);
  joint.mimics = element.child("mimic").has_value();
  const auto axis = element.child("axis");
  if (axis) joint.axis = axis->vector("xyz", joint.axis);
  const double length = joint.axis.norm();
  if (joint.type != UrdfJointType::fixed && !(length > 1e-9 && std::isfinite(length)))
    element.fail("has an axis without direction; expected a vector that is not zero");
  if (std::abs(length - 1.0) > 1e-12) joint.axis /= length;
  if (const auto dynamics = element.child("dynamics")) {
    joint.damping = dynamics->number("damping", 0.0);
    joint.friction = dynamics->number("friction", 0.0);
  }
  return joint;
}

/// Fails if another element of the kind has the same name.
void take_name(Places& places, const std::string& name, const UrdfElement& element) {
  const auto number = static_cast<int>(places.size());
  if (!places.emplace(name, number).second)
    element.fail("has the same name as another one; names must be unique");
}

UrdfModel model_of(const UrdfElement& root, const std::string& file) {
  if (root.tag() != "robot")
    root.fail(fmt::format("is the outermost element; a URDF file begins with <robot>{}",
                          root.tag() == "sdf" ? ". This is SDF; export the robot as URDF" : ""));
  UrdfModel model;
  model.file = file;
  model.name = root.has("name") ? root.text("name") : "robot";
  Places links, joints;
  const auto children = root.children();
  for (const UrdfElement& element : children) {
    if (element.tag().rfind("xacro:", 0) == 0)
      element.fail("is an xacro element; expand the file first: xacro FILE > robot.urdf");
    if (element.tag() != "link") continue;
    model.links.push_back(link_of(element));
    take_name(links, model.links.back().name, element);
  }
  for (const UrdfElement& element : children) {
    if (element.tag() != "joint") continue;
    model.joints.push_back(joint_of(element, links));
    take_name(joints, model.joints.back().name, element);
  }
  if (const auto more = root.child("faultline")) model.more = more->content();
  return model;
}

}  // namespace

void check_urdf_size(std::uintmax_t bytes, const std::string& file) {
  if (bytes > kMostBytes)
    throw Error(ErrorCode::input, file,
                fmt::format("has {} MB; expected a URDF of at most {} MB, its meshes in files of their own",
                            bytes >> 20, kMostBytes >> 20));
}

UrdfModel parse_urdf(const std::string& text, const std::string& file) {
  check_urdf_size(text.size(), file);
  if (text.find('\0') != std::string::npos)
    throw Error(ErrorCode::input, file,
                "contains zero bytes, so it is not XML; check that it is a URDF file");
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS)
    throw Error(
        ErrorCode::input, fmt::format("{}, line {}", file, document.ErrorLineNum()),
        fmt::format("is not valid XML ({}); a URDF file is complete XML", words_of(document.ErrorID())));
  if (!document.RootElement())
    throw Error(ErrorCode::input, file, "contains no element; a URDF file begins with <robot>");
  return model_of(UrdfElement(*document.RootElement(), file), file);
}

}  // namespace faultline

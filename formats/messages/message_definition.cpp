// SPDX-License-Identifier: MIT
#include "formats/messages/message_definition.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <utility>

namespace faultline {
namespace {

/// Largest definition in bytes, fields of all its types together, and depth of types in types.
constexpr std::size_t kLongestDefinition = 1 << 20;
constexpr std::size_t kMostFields = 1 << 12;
constexpr int kDeepestType = 16;

struct ValueName {
  std::string_view name;
  MessageValue value;
};

/// Names of single values in ROS 1 and ROS 2.
constexpr std::array kValueNames{
    ValueName{"bool", MessageValue::boolean},    ValueName{"byte", MessageValue::uint8},
    ValueName{"char", MessageValue::uint8},      ValueName{"int8", MessageValue::int8},
    ValueName{"uint8", MessageValue::uint8},     ValueName{"int16", MessageValue::int16},
    ValueName{"uint16", MessageValue::uint16},   ValueName{"int32", MessageValue::int32},
    ValueName{"uint32", MessageValue::uint32},   ValueName{"int64", MessageValue::int64},
    ValueName{"uint64", MessageValue::uint64},   ValueName{"float32", MessageValue::float32},
    ValueName{"float64", MessageValue::float64}, ValueName{"string", MessageValue::text}};

/// Types that a definition may use without stating them.
constexpr std::string_view kImpliedTypes =
    "===\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n"
    "===\nMSG: builtin_interfaces/Duration\nint32 sec\nuint32 nanosec\n"
    "===\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n";

/// The text of one type: its name and its lines, without comments and empty lines.
struct TypeText {
  std::string type;
  std::vector<std::string_view> lines;
};

std::string_view without_blanks(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// Splits a definition into its types.
std::vector<TypeText> split_types(std::string_view type, std::string_view text) {
  std::vector<TypeText> types{{plain_type(type), {}}};
  bool after_rule = false;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    const std::string_view line = without_blanks(text.substr(0, std::min(text.find('#'), end)));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty()) continue;
    if (line.starts_with("===")) {
      after_rule = true;
    } else if (after_rule && line.starts_with("MSG:")) {
      types.push_back({plain_type(without_blanks(line.substr(4))), {}});
      after_rule = false;
    } else {
      types.back().lines.push_back(line);
    }
  }
  return types;
}

/// Parses the types of a definition from the message downwards.
class DefinitionParser {
 public:
  explicit DefinitionParser(const std::vector<TypeText>& types) {
    for (const TypeText& type : types) text_of_.emplace(type.type, &type);
  }

  /// Adds a type with all types in it and returns its index; -1 when it cannot be parsed.
  int add(const std::string& type, int depth) {
    const auto text = text_of_.find(type);
    if (text == text_of_.end() || depth > kDeepestType) return -1;
    const int index = static_cast<int>(definition_.groups.size());
    definition_.groups.push_back({type, {}});
    for (const std::string_view line : text->second->lines) {
      if (is_constant(line)) continue;
      const auto field = parse_field(line, type, depth);
      if (!field || ++fields_ > kMostFields) return -1;
      definition_.groups[static_cast<std::size_t>(index)].fields.push_back(*field);
    }
    return index;
  }

  MessageDefinition take() { return std::move(definition_); }

 private:
  /// True for "uint8 MODE_IDLE=1". The value of a default comes after a blank instead.
  static bool is_constant(std::string_view line) {
    const auto sign = line.find('=');
    return sign != std::string_view::npos && sign > 0 && line[sign - 1] != '<' &&
           line.find_first_of("\"'[") > sign;
  }

  std::optional<MessageField> parse_field(std::string_view line, const std::string& inside, int depth) {
    const auto blank = line.find_first_of(" \t");
    if (blank == std::string_view::npos) return std::nullopt;
    const std::string_view rest = without_blanks(line.substr(blank));
    std::string_view type = line.substr(0, blank);
    MessageField field;
    field.name = rest.substr(0, rest.find_first_of(" \t"));
    if (const auto bracket = type.find('['); bracket != std::string_view::npos) {
      if (type.back() != ']' || !parse_count(type.substr(bracket + 1, type.size() - bracket - 2), field))
        return std::nullopt;
      type = type.substr(0, bracket);
    }
    type = type.substr(0, type.find("<="));
    if (const auto known = std::find_if(kValueNames.begin(), kValueNames.end(),
                                        [&](const ValueName& value) { return value.name == type; });
        known != kValueNames.end()) {
      field.value = known->value;
      return field;
    }
    field.group = add(resolved(type, inside), depth + 1);
    return field.group < 0 ? std::nullopt : std::optional(field);
  }

  /// Reads what stands in brackets: nothing, a bound "<=5", or a number of values.
  static bool parse_count(std::string_view count, MessageField& field) {
    field.count = MessageCount::listed;
    if (count.empty() || count.starts_with("<=")) return true;
    field.count = MessageCount::fixed;
    const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), field.size);
    return error == std::errc{} && end == count.data() + count.size();
  }

  /// Returns the full name of a type that is named inside another.
  std::string resolved(std::string_view type, const std::string& inside) const {
    if (type == "time") return "builtin_interfaces/Time";
    if (type == "duration") return "builtin_interfaces/Duration";
    if (type == "Header") return "std_msgs/Header";
    if (type.find('/') != std::string_view::npos) return plain_type(type);
    return inside.substr(0, inside.find('/') + 1) + std::string(type);
  }

  std::map<std::string, const TypeText*> text_of_;
  MessageDefinition definition_;
  std::size_t fields_ = 0;
};

/// The fields of trajectory_msgs/JointTrajectoryPoint.
constexpr std::string_view kTrajectoryPoint =
    "===\nMSG: trajectory_msgs/JointTrajectoryPoint\nfloat64[] positions\nfloat64[] velocities\n"
    "float64[] accelerations\nfloat64[] effort\nbuiltin_interfaces/Duration time_from_start\n";

/// The fields of points that move more than one degree of freedom; a message about joints has none.
constexpr std::string_view kMultiPoint =
    "===\nMSG: trajectory_msgs/MultiDOFJointTrajectoryPoint\ngeometry_msgs/Transform[] transforms\n"
    "geometry_msgs/Twist[] velocities\ngeometry_msgs/Twist[] accelerations\n"
    "builtin_interfaces/Duration time_from_start\n"
    "===\nMSG: geometry_msgs/Transform\nfloat64[3] translation\nfloat64[4] rotation\n"
    "===\nMSG: geometry_msgs/Twist\nfloat64[3] linear\nfloat64[3] angular\n";

/// Returns the fields of a controller's points, each of the type `point`.
std::string points(std::initializer_list<std::string_view> names, std::string_view point) {
  std::string text;
  for (const std::string_view name : names)
    text += "trajectory_msgs/" + std::string(point) + " " + std::string(name) + "\n";
  return text;
}

/// The versions of control_msgs/JointTrajectoryControllerState (github.com/ros-controls/control_msgs,
/// branches master, humble and foxy).
std::vector<std::string> controller_state_texts() {
  const std::string head = "std_msgs/Header header\nstring[] joint_names\n";
  const std::string more = std::string(kTrajectoryPoint) + std::string(kMultiPoint);
  constexpr std::string_view kPoint = "JointTrajectoryPoint", kMulti = "MultiDOFJointTrajectoryPoint";
  return {head + points({"reference", "feedback", "error", "output"}, kPoint) +
              "string[] multi_dof_joint_names\n" +
              points({"multi_dof_reference", "multi_dof_feedback", "multi_dof_error", "multi_dof_output"},
                     kMulti) +
              more,
          head + points({"reference", "feedback", "error", "output", "desired", "actual"}, kPoint) +
              "string[] multi_dof_joint_names\n" +
              points({"multi_dof_reference", "multi_dof_feedback", "multi_dof_error", "multi_dof_output",
                      "multi_dof_desired", "multi_dof_actual"},
                     kMulti) +
              more,
          head + points({"desired", "actual", "error"}, kPoint) + more};
}

std::vector<std::string> known_texts(const std::string& type) {
  if (type == "control_msgs/JointTrajectoryControllerState") return controller_state_texts();
  if (type == "control_msgs/DynamicJointState")
    return {
        "std_msgs/Header header\nstring[] joint_names\ncontrol_msgs/InterfaceValue[] interface_values\n"
        "===\nMSG: control_msgs/InterfaceValue\nstring[] interface_names\nfloat64[] values\n"};
  if (type == "trajectory_msgs/JointTrajectory")
    return {"std_msgs/Header header\nstring[] joint_names\ntrajectory_msgs/JointTrajectoryPoint[] points\n" +
            std::string(kTrajectoryPoint)};
  return {};
}

}  // namespace

std::size_t bytes_of(MessageValue value) {
  switch (value) {
    case MessageValue::boolean:
    case MessageValue::int8:
    case MessageValue::uint8:
      return 1;
    case MessageValue::int16:
    case MessageValue::uint16:
      return 2;
    case MessageValue::int32:
    case MessageValue::uint32:
    case MessageValue::float32:
      return 4;
    case MessageValue::int64:
    case MessageValue::uint64:
    case MessageValue::float64:
      return 8;
    case MessageValue::text:
      break;
  }
  return 0;
}

std::string plain_type(std::string_view type) {
  std::string plain(type);
  for (const std::string_view inserted : {"::msg::", "/msg/", "::"})
    if (const auto at = plain.find(inserted); at != std::string::npos)
      plain.replace(at, inserted.size(), "/");
  return plain;
}

std::optional<MessageDefinition> parse_definition(std::string_view type, std::string_view text) {
  if (text.size() > kLongestDefinition) return std::nullopt;
  std::vector<TypeText> types = split_types(type, text);
  for (TypeText& implied : split_types("", kImpliedTypes)) types.push_back(std::move(implied));
  DefinitionParser parser(types);
  if (parser.add(types.front().type, 0) < 0) return std::nullopt;
  return parser.take();
}

std::vector<MessageDefinition> known_definitions(std::string_view type) {
  std::vector<MessageDefinition> known;
  for (const std::string& text : known_texts(plain_type(type)))
    if (auto definition = parse_definition(type, text)) known.push_back(*std::move(definition));
  return known;
}

}  // namespace faultline

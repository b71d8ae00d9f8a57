// SPDX-License-Identifier: MIT
#include "formats/messages/joint_views.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "lib/log/raw_reader.hpp"

namespace faultline {
namespace {

/// Paths of the fields of a view: names of the joints, positions, velocities, efforts; empty for none.
struct ViewFields {
  TopicRole role;
  const char* name;
  std::array<std::string_view, 4> paths;
};

constexpr auto kReferenceRole = TopicRole::reference;
constexpr auto kMeasuredRole = TopicRole::measured;

/// Of fields with one name of a view the first that a message fills is taken: newer names come first. Effort
/// in the output of a trajectory controller is the torque that it commands.
constexpr std::array kTrajectoryViews{
    ViewFields{kReferenceRole,
               "reference",
               {"joint_names", "reference.positions", "reference.velocities", "reference.effort"}},
    ViewFields{kReferenceRole,
               "reference",
               {"joint_names", "desired.positions", "desired.velocities", "desired.effort"}},
    ViewFields{TopicRole::commanded_torque, "output", {"joint_names", "", "", "output.effort"}},
    ViewFields{kMeasuredRole,
               "feedback",
               {"joint_names", "feedback.positions", "feedback.velocities", "feedback.effort"}},
    ViewFields{kMeasuredRole,
               "feedback",
               {"joint_names", "actual.positions", "actual.velocities", "actual.effort"}}};

/// The desired torque of a Franka arm lacks gravity, so that it is no reference of the measured one.
constexpr std::array kFrankaViews{ViewFields{kReferenceRole, "desired", {"", "q_d", "dq_d", ""}},
                                  ViewFields{kMeasuredRole, "measured", {"", "q", "dq", "tau_J"}},
                                  ViewFields{kMeasuredRole, "measured", {"", "q", "dq", "tau_j"}}};

constexpr std::array kFrankaRobotViews{
    ViewFields{
        kReferenceRole,
        "desired",
        {"desired_joint_state.name", "desired_joint_state.position", "desired_joint_state.velocity", ""}},
    ViewFields{kMeasuredRole,
               "measured",
               {"measured_joint_state.name", "measured_joint_state.position", "measured_joint_state.velocity",
                "measured_joint_state.effort"}}};

/// The effort of a UR arm is the current of its motors in A, as in its joint states.
constexpr std::array kUrViews{ViewFields{kReferenceRole, "target", {"", "q_target", "qd_target", ""}},
                              ViewFields{kMeasuredRole, "actual", {"", "q_actual", "qd_actual", "i_actual"}}};

/// Returns the numbers under a path; empty if none is known, as controllers fill signals without a value.
std::vector<double> known_numbers(const MessageContent& content, std::string_view path) {
  std::vector<double> numbers = content.numbers(path);
  const auto is_missing = [](double number) { return number != number; };
  if (std::all_of(numbers.begin(), numbers.end(), is_missing)) numbers.clear();
  return numbers;
}

/// Adds the views whose fields the message fills, one of each name.
template <std::size_t N>
std::vector<JointView> views_of(const std::array<ViewFields, N>& known, const MessageContent& content) {
  std::vector<JointView> views;
  for (const ViewFields& fields : known) {
    JointView view{fields.role, fields.name, {}, {}};
    bool any = false;
    for (std::size_t a = 0; a < view.row.size(); ++a) {
      view.row[a] = known_numbers(content, fields.paths[a + 1]);
      any = any || !view.row[a].empty();
    }
    const bool is_filled = fields.paths[1].empty() ? any : !view.row[0].empty();
    const bool has_effort = fields.paths[3].empty() || !view.row[2].empty();
    if (!is_filled) continue;
    view.joints = content.texts(fields.paths[0]);
    const bool is_known = !views.empty() && std::string_view(views.back().name) == fields.name;
    if (!is_known)
      views.push_back(std::move(view));
    else if (has_effort && views.back().row[2].empty())
      views.back() = std::move(view);
  }
  return views;
}

/// The joints of a DynamicJointState, whose signals have names of their own: each joint with a position.
std::vector<JointView> dynamic_views(const MessageContent& content) {
  const FieldContent* interfaces = content.find("interface_values.interface_names");
  const FieldContent* values = content.find("interface_values.values");
  if (!interfaces || !values || interfaces->runs.size() != values->runs.size()) return {};
  constexpr std::array<std::string_view, 3> kInterfaces{"position", "velocity", "effort"};
  const std::vector<std::string> joints = content.texts("joint_names");
  JointView view{kMeasuredRole, "dynamic", {}, {}};
  std::array<bool, 3> has{};
  for (std::size_t j = 0; j < std::min(joints.size(), values->runs.size()); ++j) {
    std::array<double, 3> signals{kNan, kNan, kNan};
    const FieldRun &named = interfaces->runs[j], &valued = values->runs[j];
    bool has_position = false;
    for (std::size_t i = 0; i < std::min(named.count, valued.count); ++i)
      for (std::size_t a = 0; a < kInterfaces.size(); ++a) {
        if (interfaces->texts[named.first + i] != kInterfaces[a]) continue;
        signals[a] = values->numbers[valued.first + i];
        has_position = has_position || a == 0;
        has[a] = true;
      }
    if (!has_position) continue;
    view.joints.push_back(joints[j]);
    for (std::size_t a = 0; a < signals.size(); ++a) view.row[a].push_back(signals[a]);
  }
  for (std::size_t a = 0; a < has.size(); ++a)
    if (!has[a]) view.row[a].clear();
  return view.joints.empty() ? std::vector<JointView>{} : std::vector{std::move(view)};
}

/// A trajectory of one point is a command. One of more points is sampled by its controller, whose state holds
/// the reference of each moment.
std::vector<JointView> trajectory_views(const MessageContent& content) {
  const FieldContent* positions = content.find("points.positions");
  if (!positions || positions->runs.size() != 1 || positions->runs.front().count == 0) return {};
  return {{kReferenceRole,
           "reference",
           content.texts("joint_names"),
           {content.numbers("points.positions"), content.numbers("points.velocities"),
            content.numbers("points.effort")}}};
}

struct KnownType {
  std::string_view type;  ///< as plain_type() returns it
  std::vector<JointView> (*views)(const MessageContent&);
};

constexpr std::array kKnownTypes{
    KnownType{"control_msgs/JointTrajectoryControllerState",
              [](const MessageContent& content) { return views_of(kTrajectoryViews, content); }},
    KnownType{"control_msgs/DynamicJointState", dynamic_views},
    KnownType{"trajectory_msgs/JointTrajectory", trajectory_views},
    KnownType{"franka_msgs/FrankaState",
              [](const MessageContent& content) { return views_of(kFrankaViews, content); }},
    KnownType{"franka_msgs/FrankaRobotState",
              [](const MessageContent& content) { return views_of(kFrankaRobotViews, content); }},
    KnownType{"ur_msgs/RobotStateRTMsg",
              [](const MessageContent& content) { return views_of(kUrViews, content); }}};

const KnownType* known_type(std::string_view type) {
  const std::string plain = plain_type(type);
  const auto* found = std::find_if(kKnownTypes.begin(), kKnownTypes.end(),
                                   [&](const KnownType& known) { return known.type == plain; });
  return found == kKnownTypes.end() ? nullptr : found;
}

}  // namespace

bool has_joint_views(std::string_view type) { return known_type(type) != nullptr; }

std::vector<JointView> joint_views(std::string_view type, const MessageContent& content) {
  const KnownType* known = known_type(type);
  return known ? known->views(content) : std::vector<JointView>{};
}

}  // namespace faultline

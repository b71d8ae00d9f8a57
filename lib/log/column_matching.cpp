// SPDX-License-Identifier: MIT
#include "lib/log/column_matching.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "lib/core/error.hpp"
#include "lib/core/text.hpp"
#include "lib/log/column_families.hpp"
#include "lib/log/columns/unit_fit.hpp"
#include "lib/log/units.hpp"

namespace faultline {
namespace {

constexpr int kMostJoints = 64;

constexpr std::size_t kMostNamed = 20;

std::string quoted(const std::string& name) { return "\"" + shortened(name, kLongestName) + "\""; }

std::string listed(const std::vector<std::string>& columns) {
  std::string found;
  for (std::size_t i = 0; i < columns.size() && i < kMostNamed; ++i)
    found += (i ? ", " : "") + quoted(columns[i]);
  if (columns.size() > kMostNamed) found += " and " + std::to_string(columns.size() - kMostNamed) + " more";
  return found;
}

/// Returns a sentence that no column is this channel, and how to name one in the robot file.
std::string missing_column_sentence(const std::vector<std::string>& columns, const std::string& channel,
                                    const std::string& meaning) {
  return "no column for the " + meaning + " (" + channel + ") was found; the columns are " + listed(columns) +
         ". Name it in the robot file: [log.columns] " + channel + " = {name = \"...\"}" +
         (channel == "t" ? "; without any, t = {name = \"@row\", scale = SAMPLE_PERIOD_IN_S}" : "");
}

/// Returns a sentence that a joint has no position, though the column `later` shows that the log has it or a
/// later one, and how to name one in the robot file.
std::string missing_joint_sentence(const std::vector<std::string>& columns, Joint joint,
                                   const std::string& later) {
  const std::string channel = to_string({Quantity::q, joint});
  return fmt::format(
      "no column for the position of joint {} ({}) was found, although the log has {}; only the joints before "
      "it are read. The columns are {}. Name it in the robot file: [log.columns] {} = {{name = \"...\"}}",
      joint, channel, quoted(later), listed(columns), channel);
}

/// Returns a sentence that the header of a column has an unknown unit.
std::string unknown_unit_sentence(const std::string& column, const std::string& unit,
                                  const std::string& channel) {
  return "column " + quoted(column) + " has the unit " + quoted(unit) +
         ", which is unknown; its numbers are treated as SI. Set unit or scale in [log.columns] " + channel;
}

/// Returns a sentence on the column used for a quantity and its alternatives; empty if there are none.
std::string rivals_sentence(const std::vector<std::string>& columns,
                            const std::vector<ColumnFamily>& families, Quantity quantity,
                            const ColumnFamily& chosen) {
  const auto name_of = [&](const ColumnFamily& family) {
    return quoted(columns[family.column_of.begin()->second]);
  };
  std::string rivals;
  for (const ColumnFamily& family : families)
    if (&family != &chosen && (family.quantity == quantity || family.quantity == chosen.quantity))
      rivals += (rivals.empty() ? "" : ", ") + name_of(family);
  if (rivals.empty()) return "";
  const std::string channel = to_string({quantity, 1_joint});
  return name_of(chosen) + " was used as " + channel + "; " + rivals +
         " could also be meant. To choose, name the column in the robot file: [log.columns] " + channel;
}

/// Returns a sentence on the order in which joints with words for names were taken.
std::string joint_order_sentence(const std::vector<std::string>& columns,
                                 const std::vector<std::pair<Channel, int>>& joints) {
  std::string names;
  for (const auto& [channel, column] : joints)
    if (channel.quantity == Quantity::q) names += (names.empty() ? "" : ", ") + quoted(columns[column]);
  return "the joints are taken in the order of the columns: " + names +
         ". If that is not from base to tip, name them in the robot file: [log.columns] q1 = {name = \"...\"}";
}

class Matcher {
 public:
  Matcher(const std::vector<RawColumn>& columns, const ColumnMap& map, const std::string& path)
      : columns_(columns), map_(map), path_(path) {
    for (const RawColumn& column : columns) names_.push_back(column.name);
  }

  Matching run() {
    match_mapped();
    match_told();
    match_time();
    match_named_joints();
    find_families();
    for (const Quantity quantity : kJointQuantities) {
      match_quantity(quantity);
      if (matching_.joints == 0) fail_missing("q1", "position of joint 1");
    }
    finish();
    return std::move(matching_);
  }

 private:
  [[noreturn]] void fail_missing(const std::string& channel, const char* meaning) const {
    throw Error(ErrorCode::input, path_, missing_column_sentence(names_, channel, meaning));
  }

  int column_named(const std::string& name) const {
    const auto found = std::find(names_.begin(), names_.end(), name);
    return found == names_.end() ? -1 : static_cast<int>(found - names_.begin());
  }

  const ColumnSpec* spec_of(Channel channel) const {
    const auto found = map_.find(to_string(channel));
    return found == map_.end() ? nullptr : &found->second;
  }

  void add(Channel channel, int column) {
    if (taken_.count(channel)) return;
    const ColumnSpec spec = spec_of(channel) ? *spec_of(channel) : ColumnSpec{};
    const std::string name = to_string(channel);
    double factor = checked_factor(spec, name);
    const std::string& header_unit = column >= 0 ? columns_[column].unit : "";
    if (const auto known = si_factor(header_unit); known && spec.unit.empty())
      factor = *known;
    else if (!known && spec.unit.empty())
      note("unit_unknown", name, Severity::warning, unknown_unit_sentence(names_[column], header_unit, name));
    refuse_misfit(column >= 0 ? columns_[column] : RawColumn{kRowNumberName, ""}, spec, channel, path_);
    matching_.channels.push_back({channel, column, -1, spec.sign * spec.scale * factor, spec.offset,
                                  !spec.unit.empty() || (!header_unit.empty() && si_factor(header_unit))});
    taken_.insert(channel);
    used_.insert(column);
  }

  void note(const std::string& code, const std::string& channel, Severity severity,
            const std::string& message) {
    matching_.issues.add({code, channel, severity, message});
  }

  void match_mapped() {
    for (const auto& [name, spec] : map_) {
      if (name == kStopChannel) continue;
      const auto channel = canonical_channel(name);
      if (!channel)
        throw Error(ErrorCode::usage, "[log.columns] " + name,
                    "is not a channel; the channels are t, q1.., dq1.., tau1.., q_ref1.., dq_ref1.., "
                    "tau_ref1.., tau_meas1..");
      if (spec.name.empty()) continue;
      const int column = spec.name == kRowNumberName ? kRowNumber : column_named(spec.name);
      if (column == -1)
        fail_missing(
            name, ("\"" + spec.name + "\" of the robot file, the " + meaning_of(channel->quantity)).c_str());
      add(*channel, column);
    }
  }

  /// Adds the channels that the file itself states, unless the robot file names columns of the quantity.
  void match_told() {
    for (int i = 0; i < std::ssize(columns_); ++i) {
      const auto& meaning = columns_[i].meaning;
      if (!meaning || used_.count(i) || named_in_map(meaning->quantity)) continue;
      add(*meaning, i);
      told_.insert(meaning->quantity);
    }
  }

  /// Adds joints whose columns have words for names, if nothing else identifies the joints.
  void match_named_joints() {
    if (told_.count(Quantity::q) || column_named("q1") >= 0 || named_in_map(Quantity::q)) return;
    const auto joints = named_joints(names_, [&](int column) { return !used_.count(column); });
    for (const auto& [channel, column] : joints) {
      add(channel, column);
      told_.insert(channel.quantity);
    }
    if (!joints.empty()) note("joint_order", "", Severity::note, joint_order_sentence(names_, joints));
  }

  void match_time() {
    if (taken_.count(Channel{})) return;
    const int column = find_time_column(names_);
    if (column >= 0) return add(Channel{}, column);
    const auto pair = find_time_pair(names_);
    if (!pair) fail_missing("t", meaning_of(Quantity::time));
    add(Channel{}, pair->seconds);
    matching_.channels.back().nanoseconds_column = pair->nanoseconds;
    used_.insert(pair->nanoseconds);
  }

  /// Finds the families of columns; none if the file itself states which columns are the joints'.
  void find_families() {
    const auto is_free = [&](int column) {
      return !used_.count(column) || canonical_channel(names_[column]).has_value();
    };
    if (!told_.count(Quantity::q)) families_ = column_families(names_, is_free);
    misfits_ = take_mismatched(families_, columns_, map_);
  }

  /// Throws if a position or torque exists only in another dimension; notes other quantities that were left
  /// out for this reason.
  void judge_mismatched(Quantity quantity) {
    for (const ColumnFamily& family : misfits_) {
      const bool meant = quantity == Quantity::tau ? is_torque(family.quantity)
                                                   : !is_torque(quantity) && family.quantity == quantity;
      const int column = family.column_of.begin()->second;
      if (!meant || used_.count(column)) continue;
      if ((quantity == Quantity::q || quantity == Quantity::tau) && !taken_.count({quantity, 1_joint}))
        refuse_misfit(columns_[column], {}, {quantity, 1_joint}, path_);
      note("unit_of_other_dimension", to_string({family.quantity, 1_joint}), Severity::note,
           not_taken_sentence(columns_[column], family.quantity));
    }
  }

  /// Whether the robot file names a column of the quantity; it then names those of all joints.
  bool named_in_map(Quantity quantity) const {
    return std::any_of(map_.begin(), map_.end(), [&](const auto& entry) {
      const auto channel = canonical_channel(entry.first);
      return channel && channel->quantity == quantity && !entry.second.name.empty();
    });
  }

  /// Adds further joints by their usual names if the robot file names a joint by its usual name.
  void match_usual_names(Quantity quantity) {
    const bool usual = std::any_of(taken_.begin(), taken_.end(), [&](const Channel& channel) {
      const int column = column_named(to_string(channel));
      return channel.quantity == quantity && column >= 0 && used_.count(column) > 0;
    });
    for (int j = 0; usual && j < kMostJoints; ++j) {
      const Channel channel{quantity, Joint::at(j)};
      if (const int column = column_named(to_string(channel)); column >= 0 && !used_.count(column))
        add(channel, column);
    }
  }

  int first_of(const ColumnFamily& family) const { return family.first(first_position_, matching_.joints); }

  const ColumnFamily* family_of(Quantity quantity) const {
    if (named_in_map(quantity)) return nullptr;
    const auto usable = [&](const ColumnFamily& family) {
      if (quantity == Quantity::q) return family.joints(family.first()) > 0;
      const int first = first_of(family);
      const auto at = family.column_of.lower_bound(first);
      return at != family.column_of.end() && at->first < first + matching_.joints;
    };
    if (quantity == Quantity::tau) return best_torque(families_, usable);
    if (is_torque(quantity) && quantity == meaning_of_tau()) return nullptr;
    return best_family(families_, quantity, usable);
  }

  /// Returns tau_ref or tau_meas if the name of the column for tau means that, else tau.
  Quantity meaning_of_tau() const {
    for (const ChannelSource& source : matching_.channels)
      if (source.channel.quantity == Quantity::tau && source.column >= 0)
        return parse_name(names_[source.column]).quantity.value_or(Quantity::tau);
    return Quantity::tau;
  }

  void match_quantity(Quantity quantity) {
    if (named_in_map(quantity)) match_usual_names(quantity);
    const ColumnFamily* family = family_of(quantity);
    if (family) {
      if (quantity == Quantity::q) first_position_ = family->first();
      const int first = first_of(*family);
      const int joints = quantity == Quantity::q ? family->joints(first) : matching_.joints;
      for (int j = 0; j < joints; ++j)
        if (const auto column = family->column_of.find(first + j); column != family->column_of.end())
          add({quantity, Joint::at(j)}, column->second);
      note_rivals(quantity, *family);
    }
    judge_mismatched(quantity);
    if (quantity != Quantity::q) return;
    while (taken_.count({Quantity::q, behind_last()})) ++matching_.joints;
    if (family) note_later_positions(*family);
  }

  /// The first joint without a position.
  Joint behind_last() const { return Joint::at(matching_.joints); }

  void note_missing_joint(const std::string& later, Severity severity) {
    const Joint joint = behind_last();
    note("channel_missing", to_string({Quantity::q, joint}), severity,
         missing_joint_sentence(names_, joint, later));
  }

  /// Notes positions behind a joint without one.
  void note_later_positions(const ColumnFamily& family) {
    const auto later = family.column_of.upper_bound(first_of(family) + matching_.joints);
    if (!family.numbered || later == family.column_of.end() || later->first > kMostJoints) return;
    note_missing_joint(names_[later->second], Severity::severe);
  }

  /// Notes a velocity or torque with a usual name for the joint behind the last position.
  void note_last_position() {
    const Joint joint = behind_last();
    if (matching_.issues.find("channel_missing", to_string({Quantity::q, joint}))) return;
    for (const Quantity quantity : {Quantity::dq, Quantity::tau})
      if (const std::string name = to_string({quantity, joint}); column_named(name) >= 0)
        return note_missing_joint(name, Severity::note);
  }

  void note_rivals(Quantity quantity, const ColumnFamily& chosen) {
    if (chosen.fitness >= 100) return;
    const std::string sentence = rivals_sentence(names_, families_, quantity, chosen);
    if (!sentence.empty())
      note("channel_ambiguous", to_string({quantity, 1_joint}), Severity::note, sentence);
  }

  void finish() {
    auto& channels = matching_.channels;
    const int joints = matching_.joints;
    std::erase_if(channels,
                  [joints](const ChannelSource& source) { return source.channel.joint.index() >= joints; });
    std::sort(channels.begin(), channels.end(),
              [](const ChannelSource& a, const ChannelSource& b) { return a.channel < b.channel; });
    for (const Quantity quantity : kJointQuantities) note_gaps(quantity);
    note_last_position();
    std::set<int> used;
    for (const ChannelSource& source : channels) used.insert({source.column, source.nanoseconds_column});
    for (int i = 0; i < static_cast<int>(columns_.size()); ++i)
      if (!used.count(i)) matching_.extra.push_back(i);
  }

  /// Notes joints that lack a quantity which other joints have.
  void note_gaps(Quantity quantity) {
    auto has = [&](int j) { return taken_.count({quantity, Joint::at(j)}) > 0; };
    int present = 0;
    for (int j = 0; j < matching_.joints; ++j) present += has(j);
    if (present == 0) return;
    for (int j = 0; j < matching_.joints; ++j)
      if (!has(j))
        note("channel_missing", to_string({quantity, Joint::at(j)}), Severity::warning,
             fmt::format(
                 "no column for the {} of joint {}, although other joints have one; it is treated as missing",
                 meaning_of(quantity), Joint::at(j)));
  }

  const std::vector<RawColumn>& columns_;
  const ColumnMap& map_;
  const std::string& path_;
  std::vector<std::string> names_;
  std::vector<ColumnFamily> families_;
  std::vector<ColumnFamily> misfits_;  ///< families in a unit of another dimension than their quantity
  int first_position_ = 1;             ///< the number of the first position, 0 or 1
  std::set<Channel> taken_;
  std::set<Quantity> told_;  ///< quantities that the file itself states
  std::set<int> used_;
  Matching matching_;
};

}  // namespace

Matching match_columns(const std::vector<RawColumn>& columns, const ColumnMap& map, const std::string& path) {
  return Matcher(columns, map, path).run();
}

Matching without_partial_velocity(Matching matching) {
  const auto is_velocity = [](const ChannelSource& source) {
    return source.channel.quantity == Quantity::dq;
  };
  std::set<Joint> measured;
  for (const ChannelSource& source : matching.channels)
    if (is_velocity(source)) measured.insert(source.channel.joint);
  if (measured.empty() || std::ssize(measured) == matching.joints) return matching;
  std::vector<std::string> missing;
  for (int j = 0; j < matching.joints; ++j)
    if (const Joint joint = Joint::at(j); !measured.contains(joint))
      missing.push_back(to_string({Quantity::dq, joint}));
  matching.issues.add(make_issue(
      "velocities_left_out", Severity::warning,
      fmt::format(
          "no column for {}, so the velocities of all joints are left out and computed from positions "
          "where they are needed; if the log has the column under another name, give it in "
          "[log.columns]",
          fmt::join(missing, ", "))));
  std::erase_if(matching.channels, is_velocity);
  return matching;
}

std::string why_no_match(const std::vector<RawColumn>& columns, const ColumnMap& map,
                         const std::string& path) {
  try {
    match_columns(columns, map, path);
    return "";
  } catch (const Error& error) {
    return error.message();
  }
}

}  // namespace faultline

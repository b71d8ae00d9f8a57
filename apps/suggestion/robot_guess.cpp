// SPDX-License-Identifier: MIT
#include "apps/suggestion/robot_guess.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "lib/core/text.hpp"
#include "lib/log/column_matching.hpp"
#include "lib/log/columns/unit_fit.hpp"
#include "lib/log/time_axis.hpp"
#include "lib/log/units.hpp"
#include "lib/plausibility/checkup/joint_relations.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {
namespace {

constexpr std::size_t kAllRows = std::numeric_limits<std::size_t>::max();
constexpr std::size_t kSearchedRows = 20000, kSearchedColumns = 32;
constexpr double kSurelyWith = 0.8;  // correlation with acceleration of a torque among columns with names
constexpr double kRatherAgainst = -0.2, kBrakes = -0.05;       // correlations with acceleration and velocity
constexpr double kSurelyDegrees = 45.0, kSurelyRadians = 0.7;  // many turns in rad; too far for a slide in m

constexpr double kRestSpan = 1e-3;  // rad or m: of a joint that does not move
constexpr double kShortSpan = 0.6;  // rad or m: of a joint that may slide
constexpr double kShorterSpan = 0.4;
constexpr double kToAndFro = 4.0;  // path to span, of a joint that uses its whole range

/// Decides whether a joint turns or slides; `header` is its position's unit in the file, empty for none.
GuessedAxis guess_axis(const JointNumbers& joint, const GuessedUnits& units, const std::string& header) {
  const double span = joint.span * units.position_factor;
  const auto known = known_unit(units.position.unit);
  const Dimension dimension = known ? known->dimension : Dimension::none;
  if (dimension == Dimension::length)
    return {true, header.empty() ? "its values are those of a length" : "its header gives " + header};
  if (dimension == Dimension::angle)
    return {false, header.empty() ? "its values are those of an angle" : "its header gives " + header};
  if (span < kRestSpan)
    return {false, "? the joint rests, so the log does not show whether it turns or slides"};
  if (span < kShortSpan && joint.carries)
    return {true, fmt::format("? its torque always carries a weight, and its position spans {:.3g} m", span)};
  if (span < kShorterSpan && joint.path > kToAndFro * joint.span)
    return {true, fmt::format("? it moves back and forth over {:.3g}, a small range for an angle", span)};
  const std::string spans = fmt::format("spans {:.3g} rad", span);
  return {false,
          span < kShorterSpan ? "? it " + spans + ", which may also be the range of a sliding joint" : spans};
}

class Guesser {
 public:
  explicit Guesser(const RawExcerpt& excerpt) : excerpt_(excerpt) {}

  RobotGuess run() {
    guess_.channels = guess_columns(excerpt_);
    for (const GuessedChannel& one : guess_.channels)
      if (one.channel.quantity == Quantity::q) joints_ = std::max(joints_, one.channel.joint.number());
    if (joints_ > kMaxJoints) {
      guess_.untold.push_back(fmt::format("further joints: the log has {} joints; only the first {} are used",
                                          joints_, kMaxJoints));
      joints_ = kMaxJoints;
      std::erase_if(guess_.channels,
                    [](const GuessedChannel& one) { return one.channel.joint.index() >= kMaxJoints; });
    }
    take_columns_left();
    time_ = values_of(excerpt_, guess_.channels.front());
    for (int j = 0; j < joints_; ++j)
      numbers_.push_back(
          joint_numbers(time_, raw(Quantity::q, j), raw(Quantity::dq, j), raw(Quantity::tau, j)));
    guess_time();
    guess_units();
    for (int j = 0; j < joints_; ++j)
      guess_.axes.push_back(guess_axis(numbers_[j], units_[j], header_unit(find(Quantity::q, j))));
    guess_torques();
    return std::move(guess_);
  }

 private:
  /// The channel of joint `j` (from 0); null if none was found.
  GuessedChannel* find(Quantity quantity, int j) {
    for (GuessedChannel& one : guess_.channels)
      if (one.channel == Channel{quantity, Joint::at(j)}) return &one;
    return nullptr;
  }
  std::vector<double> raw(Quantity quantity, int j) {
    const GuessedChannel* one = find(quantity, j);
    return one ? values_of(excerpt_, *one) : std::vector<double>();
  }
  std::string header_unit(const GuessedChannel* one) const {
    if (!one || one->column < 0 || excerpt_.columns[one->column].unit_assumed) return "";
    const std::string& unit = excerpt_.columns[one->column].unit;
    const auto known = known_unit(unit);
    return known && measures(known->dimension, one->channel.quantity) ? unit : "";
  }

  void guess_time() {
    GuessedChannel& time = guess_.channels.front();
    const std::string header = header_unit(&time);
    if (time.column == kRowNumber) {
      time.spec.scale = time_factor_ = 1e-3;
      time.reason += "; 1 ms per row is only an example: set scale to the true sample period";
      guess_.untold.push_back("the sample period: no column is a time");
      return;
    }
    if (!header.empty() || time.nanoseconds >= 0) {
      time_factor_ = si_factor(header).value_or(1.0);
      if (!header.empty()) time.reason += ", in " + header + " by its header";
      return;
    }
    const GuessedUnit unit = guess_time_unit(time_, numbers_);
    time.spec.unit = unit.unit;
    time.reason += fmt::format("; in {}: {}", unit.unit.empty() ? "s" : unit.unit, unit.reason);
    time_factor_ = si_factor(unit.unit).value_or(1.0);
  }

  void set_unit(Quantity quantity, int j, const GuessedUnit& unit) {
    GuessedChannel* one = find(quantity, j);
    if (!one) return;
    const std::string header = header_unit(one);
    if (!header.empty()) {
      one->reason += ", in " + header + " by its header";
      return;
    }
    one->spec.unit = unit.unit;
    one->reason += fmt::format("; in {}: {}", unit.unit.empty() ? "SI" : unit.unit, unit.reason);
  }

  void guess_units(OtherAngles others) {
    for (int j = 0; j < joints_; ++j)
      units_[j] = guess_joint_units(numbers_[j], time_factor_, header_unit(find(Quantity::q, j)),
                                    header_unit(find(Quantity::dq, j)), others);
  }

  /// Returns degrees if the values of some joint certainly are, or no other joint moves far in radians.
  OtherAngles other_angles() const {
    bool degrees = false, surely = false, radians = false;
    for (std::size_t j = 0; j < units_.size(); ++j) {
      const bool in_degrees = units_[j].position.unit == "deg";
      degrees = degrees || in_degrees;
      surely =
          surely || (in_degrees && (numbers_[j].largest > kSurelyDegrees || units_[j].velocity.unit.empty()));
      radians = radians || (units_[j].position.unit.empty() && numbers_[j].span > kSurelyRadians);
    }
    if (!degrees) return OtherAngles::unknown;
    return surely || !radians ? OtherAngles::degrees : OtherAngles::radians;
  }

  void guess_units() {
    units_.resize(numbers_.size());
    guess_units(OtherAngles::unknown);
    guess_units(other_angles());
    for (int j = 0; j < joints_; ++j) {
      const GuessedUnits& units = units_[j];
      set_unit(Quantity::q, j, units.position), set_unit(Quantity::q_ref, j, units.position);
      set_unit(Quantity::dq, j, units.velocity), set_unit(Quantity::dq_ref, j, units.velocity);
      if (!units.flipped) continue;
      GuessedChannel* velocity = find(Quantity::dq, j);
      velocity->spec.sign = -1.0;
      velocity->reason +=
          "; sign: it is negative while the position rises; the data do not show which of the two is wrong";
    }
  }

  static std::vector<double> scaled(std::vector<double> values, double factor) {
    for (double& value : values) value *= factor;
    return values;
  }

  std::vector<TorqueRelated> torques_related(const std::vector<std::vector<double>>& tau,
                                             std::size_t most_rows = kAllRows) {
    const std::vector<double> time = scaled(time_, time_factor_);
    const double period_s = median_step(time);
    std::vector<std::vector<double>> q;
    for (int j = 0; j < joints_; ++j) q.push_back(scaled(raw(Quantity::q, j), units_[j].position_factor));
    if (!(period_s > 0.0)) return {};
    TorqueRelation relation(joints_, period_s);
    for (std::size_t i = 0; i < std::min(time.size(), most_rows); ++i) relation.add(time[i], q, tau, i);
    return relation.result();
  }

  void guess_torques() {
    if (!find(Quantity::tau, 0)) find_torques();
    std::vector<std::vector<double>> tau;
    for (int j = 0; j < joints_; ++j)
      if (find(Quantity::tau, j)) tau.push_back(raw(Quantity::tau, j));
    if (tau.empty()) {
      guess_.untold.push_back(
          "torque: no column is a torque; name one as tau1 = {name = .., scale = N m for a value of 1}");
      return;
    }
    guess_meaning(
        *std::find_if(guess_.channels.begin(), guess_.channels.end(),
                      [](const GuessedChannel& one) { return one.channel.quantity == Quantity::tau; }));
    if (std::ssize(tau) < joints_) return;
    const auto related = torques_related(tau);
    for (std::size_t j = 0; j < related.size(); ++j) {
      GuessedChannel& one = *find(Quantity::tau, static_cast<int>(j));
      const TorqueRelated& torque = related[j];
      if (std::isnan(torque.correlation)) continue;
      one.reason += fmt::format("; correlation with acceleration {:.2f}", torque.correlation);
      if (!std::isnan(torque.delay_rows))
        one.reason +=
            fmt::format(", {:.1f} +- {:.1f} rows late", torque.delay_rows, torque.delay_uncertainty_rows);
      const double power = units_[j].flipped ? -numbers_[j].power : numbers_[j].power;
      const bool against =
          torque.is_against_acceleration() || (torque.correlation < kRatherAgainst && power < kBrakes);
      if (!against) continue;
      one.spec.sign = -1.0;
      one.reason += "; sign: it decreases when the joint accelerates";
    }
  }

  bool is_named() const { return !guess_.channels.back().reason.starts_with("?"); }

  std::vector<int> columns_left() const {
    std::vector<int> left;
    for (int c = 0; c < std::ssize(excerpt_.columns); ++c) {
      const bool used = std::any_of(guess_.channels.begin(), guess_.channels.end(),
                                    [c](const GuessedChannel& one) { return one.column == c; });
      const auto& values = excerpt_.values[c];
      const bool varies = std::any_of(values.begin(), values.end(), [&](double value) {
        return value != values.front() && !std::isnan(value);
      });
      if (!used && varies && may_be(excerpt_.columns[c], Quantity::tau)) left.push_back(c);
    }
    return left;
  }

  /// Takes columns as the torques of the joints in their order.
  void add_torques(const std::vector<int>& columns, const std::string& reason) {
    guess_.untold.push_back("the torque for a value of 1 in the torque columns: their names give no unit");
    for (std::size_t j = 0; j < columns.size(); ++j)
      guess_.channels.push_back({{Quantity::tau, Joint::at(static_cast<int>(j))}, columns[j], {}, reason});
    std::sort(guess_.channels.begin(), guess_.channels.end(),
              [](const GuessedChannel& a, const GuessedChannel& b) { return a.channel < b.channel; });
  }

  /// If names give no meaning: takes the remaining columns as torques when they are as many as the joints.
  void take_columns_left() {
    const std::vector<int> left = columns_left();
    if (is_named() || !find(Quantity::dq, 0) || std::ssize(left) != joints_) return;
    add_torques(left,
                "? as many columns as joints have no other meaning; they are used as the torques in their "
                "order");
  }

  /// Finds for each joint the unused column that has the highest correlation with its acceleration.
  void find_torques() {
    std::vector<int> left = columns_left(), found;
    left.resize(std::min(left.size(), kSearchedColumns));
    for (int j = 0; j < joints_; ++j) {
      auto best = left.end();
      double most = is_named() ? kSurelyWith : TorqueRelated::kClear;
      for (auto at = left.begin(); at != left.end(); ++at) {
        const auto related = torques_related(
            std::vector<std::vector<double>>(static_cast<std::size_t>(joints_), excerpt_.values[*at]),
            kSearchedRows);
        const double share = related.empty() ? NAN : related[j].correlation;
        if (std::abs(share) > most) most = std::abs(share), best = at;
      }
      if (best == left.end()) return;
      found.push_back(*best);
      left.erase(best);
    }
    add_torques(found, "? by the data: it correlates with the joint's acceleration");
  }

  void guess_meaning(const GuessedChannel& tau) {
    const RawColumn& column = excerpt_.columns[static_cast<std::size_t>(tau.column)];
    const auto quantity = parse_name(column.name).quantity;
    const auto unit = known_unit(column.unit);
    if (unit && unit->dimension != Dimension::none && !measures(unit->dimension, Quantity::tau)) {
      guess_.torque = "current";
      guess_.torque_reason = "the header gives " + column.unit;
      for (GuessedChannel& one : guess_.channels) {
        if (one.channel.quantity != Quantity::tau) continue;
        one.spec.unit = "N m";
        one.reason += "; ? the header gives " + column.unit +
                      ": set scale to the torque in N m for a value of 1, and remove the unit";
      }
      guess_.untold.push_back("the torque for 1 " + column.unit + " in the torque columns");
    } else if (quantity == Quantity::tau_meas) {
      guess_.torque = "measured";
      guess_.torque_reason = "by its name";
    } else if (quantity == Quantity::tau_ref) {
      guess_.torque_reason = "by its name";
    } else {
      guess_.torque_reason = "? neither names nor data show whether the torque is commanded or measured";
    }
  }

  const RawExcerpt& excerpt_;
  RobotGuess guess_;
  int joints_ = 0;
  std::vector<double> time_;
  double time_factor_ = 1.0;
  std::vector<JointNumbers> numbers_;
  std::vector<GuessedUnits> units_;
};

}  // namespace

RobotGuess guess_robot(const RawExcerpt& excerpt) { return Guesser(excerpt).run(); }

}  // namespace faultline

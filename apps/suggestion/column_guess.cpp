// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>

#include "apps/suggestion/robot_guess.hpp"
#include "formats/open_log.hpp"
#include "lib/core/error.hpp"
#include "lib/log/column_families.hpp"
#include "lib/log/column_matching.hpp"
#include "lib/log/columns/unit_fit.hpp"
#include "lib/log/units.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {
namespace {

constexpr std::size_t kMostColumns = 256;
constexpr std::size_t kMostRows = 60000;
constexpr std::size_t kMostValues = 4'000'000;
constexpr int kBlockRows = 4096;

constexpr std::size_t kMostPaired = 64;  // columns of which pairs are tested
constexpr double kDerivative = 0.95;     // correlation of a velocity with its position's change
constexpr double kVaries = 1e-6;         // least variance by mean square; less is rounding
constexpr double kInOrder = 0.999;       // share of steps of a time that are forward
constexpr double kSmallSteps = 0.1;      // of mean square step to variance
constexpr std::size_t kGuessFewestRows = 20;
constexpr std::size_t kFewestPairedRows = 200;
constexpr std::ptrdiff_t kReach = 3;  // rows, of a change of position, to both sides

/// What a name without a joint quantity shows nevertheless.
enum class OtherQuantity {
  none,   ///< no known word
  drive,  ///< a motor's current or voltage, which may represent a torque
  other,  ///< neither a joint's motion nor its torque: a temperature, an acceleration, a counter, a state
};

OtherQuantity other_quantity_of(const std::string& word) {
  static const std::set<std::string> drives{"current", "currents", "curr",     "amp",  "amps",
                                            "ampere",  "voltage",  "voltages", "volt", "volts"};
  static const std::set<std::string> others{
      "temp",          "temperature", "temperatures", "power", "energy", "acc",    "accel", "acceleration",
      "accelerations", "ddq",         "qdd",          "jerk",  "num",    "number", "no",    "nr",
      "index",         "idx",         "count",        "id",    "seq",    "row",    "line",  "sequence",
      "counter",       "cycle",       "cycles",       "mode",  "flag",   "flags",  "error", "err",
      "status"};
  if (drives.count(word) > 0) return OtherQuantity::drive;
  return others.count(word) > 0 ? OtherQuantity::other : OtherQuantity::none;
}

OtherQuantity other_quantity_of(const ParsedName& reading) {
  std::istringstream words(reading.stem);
  OtherQuantity found = OtherQuantity::none;
  for (std::string word; words >> word;) found = std::max(found, other_quantity_of(word));
  return found;
}

std::vector<std::string> names_of(const RawExcerpt& excerpt) {
  std::vector<std::string> names;
  for (const RawColumn& column : excerpt.columns) names.push_back(column.name);
  return names;
}

ColumnMap map_with(bool row_number, bool any_torque) {
  ColumnMap map;
  if (row_number) map["t"] = {.name = kRowNumberName};
  for (int j = 0; any_torque && j < kMaxJoints; ++j)
    map[to_string({Quantity::tau, Joint::at(j)})] = {.unit = "N m"};
  return map;
}

std::optional<Matching> match_names(const RawExcerpt& excerpt, const ColumnMap& map) {
  if (!why_no_match(excerpt.columns, map, excerpt.path).empty()) return std::nullopt;
  return match_columns(excerpt.columns, map, excerpt.path);
}

std::vector<GuessedChannel> by_names(const RawExcerpt& excerpt) {
  for (const auto& [row_number, any_torque] :
       {std::pair{false, false}, {false, true}, {true, false}, {true, true}}) {
    const auto matching = match_names(excerpt, map_with(row_number, any_torque));
    if (!matching) continue;
    std::vector<GuessedChannel> found;
    for (const ChannelSource& source : matching->channels)
      found.push_back({source.channel, source.column, {}, "by its name", source.nanoseconds_column});
    return found;
  }
  return {};
}

/// Returns the column whose values increase from row to row and whose name is not that of a counter; the one
/// with the most even steps of several, or kRowNumber.
int rising_column(const RawExcerpt& excerpt) {
  int best = kRowNumber;
  double steadiest = 1.0;
  for (std::size_t c = 0; c < excerpt.values.size(); ++c) {
    const auto& values = excerpt.values[c];
    if (values.size() < kGuessFewestRows || !may_be(excerpt.columns[c], Quantity::time)) continue;
    double forward = 0.0;
    for (std::size_t i = 1; i < values.size(); ++i) forward += values[i] > values[i - 1] ? 1.0 : 0.0;
    const double steps = static_cast<double>(values.size() - 1), mean = (values.back() - values[0]) / steps;
    if (forward < kInOrder * steps) continue;
    double off = 0.0;
    for (std::size_t i = 1; i < values.size(); ++i) off += std::abs(values[i] - values[i - 1] - mean);
    const double uneven = off / (steps * mean);
    if (!(uneven < steadiest)) continue;
    steadiest = uneven;
    best = static_cast<int>(c);
  }
  return best;
}

/// Returns the correlation of the changes of `a` with the mean of `b` over the same rows; negative if one
/// sign is wrong.
double as_derivative(const std::vector<double>& a, const std::vector<double>& b) {
  double count = 0.0, as = 0.0, bs = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
  for (std::ptrdiff_t i = kReach; i + kReach < std::ssize(a); i += 2) {
    double mean = 0.0;
    for (std::ptrdiff_t k = -kReach; k <= kReach; ++k) mean += b[i + k];
    const double change = a[i + kReach] - a[i - kReach];
    if (std::isnan(change) || std::isnan(mean)) continue;
    count += 1.0, as += change, bs += mean, aa += change * change, bb += mean * mean, ab += change * mean;
  }
  // The means are removed, as they are no evidence: a counter's change and a temperature are both about
  // constant.
  const double va = aa - as * as / count, vb = bb - bs * bs / count;
  return va > kVaries * aa && vb > kVaries * bb ? (ab - as * bs / count) / std::sqrt(va * vb) : 0.0;
}

/// Returns positions and the velocities that are their derivatives, in the order of the positions' columns.
std::vector<GuessedChannel> by_derivatives(const RawExcerpt& excerpt, int time) {
  std::map<int, std::pair<int, double>> velocity_of;
  std::set<int> velocities;
  const int columns = static_cast<int>(std::min(excerpt.values.size(), kMostPaired));
  std::vector<std::tuple<bool, double, int, int>> pairs;  // one sign is wrong, -|correlation|, columns
  for (int a = 0; a < columns; ++a)
    for (int b = 0; b < columns; ++b)
      if (a != b && a != time && b != time && excerpt.values[a].size() >= kFewestPairedRows &&
          may_be(excerpt.columns[a], Quantity::q) && may_be(excerpt.columns[b], Quantity::dq))
        if (const double r = as_derivative(excerpt.values[a], excerpt.values[b]); std::abs(r) > kDerivative)
          pairs.push_back({r < 0.0, -std::abs(r), a, b});
  // A sine is also the derivative of its derivative, except for the sign.
  std::sort(pairs.begin(), pairs.end());
  for (const auto& [flipped, r, a, b] : pairs) {
    if (velocity_of.count(a) || velocities.count(a) || velocity_of.count(b) || velocities.count(b)) continue;
    velocity_of[a] = {b, -r};
    velocities.insert(b);
  }
  std::vector<GuessedChannel> found;
  for (const auto& [a, velocity] : velocity_of) {
    const Joint joint = Joint::at(static_cast<int>(found.size()) / 2);
    const std::string why = fmt::format(
        "? not by its name, but by the data: column {} is the derivative of column {} (correlation {:.3f})",
        velocity.first + 1, a + 1, velocity.second);
    found.push_back({{Quantity::q, joint}, a, {}, why});
    found.push_back({{Quantity::dq, joint}, velocity.first, {}, why});
  }
  return found;
}

/// True when values are continuous as those of a motion: steps are small compared with the deviation.
bool flows(const std::vector<double>& values) {
  double sum = 0.0, squares = 0.0, steps = 0.0, count = 0.0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (std::isnan(values[i]) || std::isnan(values[i - 1])) continue;
    sum += values[i], squares += values[i] * values[i], count += 1.0;
    steps += (values[i] - values[i - 1]) * (values[i] - values[i - 1]);
  }
  return steps > 0.0 && steps < kSmallSteps * (squares - sum * sum / count);
}

/// Returns the largest group of columns whose names differ by a number.
std::vector<GuessedChannel> by_numbers(const RawExcerpt& excerpt, int time) {
  std::map<std::string, std::map<int, int>> families;
  for (int c = 0; c < std::ssize(excerpt.columns); ++c) {
    const ParsedName reading = parse_name(excerpt.columns[c].name);
    if (c != time && reading.number && may_be(excerpt.columns[c], Quantity::q))
      families[reading.stem].emplace(*reading.number, c);
  }
  const auto largest = std::max_element(families.begin(), families.end(), [](const auto& a, const auto& b) {
    return a.second.size() < b.second.size();
  });
  std::vector<GuessedChannel> found;
  const auto moves = [&](const auto& one) { return flows(excerpt.values[one.second]); };
  if (largest == families.end() || largest->second.size() < 2) return found;
  if (std::none_of(largest->second.begin(), largest->second.end(), moves)) return found;
  for (const auto& [number, column] : largest->second)
    found.push_back({{Quantity::q, Joint::at(static_cast<int>(found.size()))},
                     column,
                     {},
                     "? neither name nor data identify it as a position; it is numbered like joints"});
  return found;
}

}  // namespace

std::size_t RawExcerpt::rows() const {
  std::size_t rows = 0;
  for (const auto& column : values) rows = std::max(rows, column.size());
  return rows;
}

RawExcerpt raw_excerpt(const std::string& path) {
  const auto reader = open_raw(path, false);
  RawExcerpt excerpt;
  excerpt.path = path;
  excerpt.canonical = reader->canonical();
  excerpt.columns = reader->columns();
  const std::size_t all = excerpt.columns.size(), taken = std::min(all, kMostColumns);
  excerpt.columns.resize(taken);
  const std::size_t most = std::min(kMostRows, kMostValues / std::max<std::size_t>(taken, 1));
  std::vector<bool> wanted(all, false);
  std::fill_n(wanted.begin(), taken, true);
  reader->want(wanted);
  excerpt.values.resize(taken);
  RawBlock block;
  while (excerpt.rows() < most && reader->next(block, kBlockRows))
    for (std::size_t c = 0; c < taken; ++c)
      excerpt.values[c].insert(excerpt.values[c].end(), block.columns[c].begin(), block.columns[c].end());
  return excerpt;
}

std::vector<GuessedChannel> guess_columns(const RawExcerpt& excerpt) {
  std::vector<GuessedChannel> found = by_names(excerpt);
  int time = find_time_column(names_of(excerpt));
  if (!found.empty() && found.front().column != kRowNumber) return found;
  const bool named = time >= 0;
  if (!named) time = rising_column(excerpt);
  const GuessedChannel stamp{{},
                             time,
                             {},
                             named       ? "by its name"
                             : time >= 0 ? "? not by its name, but it increases steadily"
                                         : "? no column is a time: the row number is used instead"};
  if (!found.empty()) {
    found.front() = stamp;
    return found;
  }
  found = by_derivatives(excerpt, time);
  if (found.empty()) found = by_numbers(excerpt, time);
  if (found.empty())
    throw Error(
        ErrorCode::input, excerpt.path,
        "no column could be identified as a joint's position, neither by its name nor as a column whose "
        "derivative is another column; name one in a robot file: [log.columns] q1 = \"its name\"");
  found.insert(found.begin(), stamp);
  std::sort(found.begin(), found.end(),
            [](const GuessedChannel& a, const GuessedChannel& b) { return a.channel < b.channel; });
  std::erase_if(found, [](const GuessedChannel& one) { return one.channel.joint.index() >= kMaxJoints; });
  return found;
}

bool may_be(const RawColumn& column, Quantity quantity) {
  const ParsedName reading = parse_name(column.name);
  const auto unit = known_unit(column.unit);
  const Dimension dimension = unit ? unit->dimension : Dimension::none;
  if (is_torque(quantity)) {
    const bool of_motion = measures(dimension, Quantity::q) || measures(dimension, Quantity::dq);
    if (dimension != Dimension::none && of_motion) return false;
    return reading.quantity ? is_torque(*reading.quantity)
                            : other_quantity_of(reading) != OtherQuantity::other;
  }
  if (!measures(dimension, quantity)) return false;
  return reading.quantity ? reading.quantity == quantity : other_quantity_of(reading) == OtherQuantity::none;
}

std::vector<double> values_of(const RawExcerpt& excerpt, const GuessedChannel& guess) {
  if (guess.column >= 0) {
    std::vector<double> values = excerpt.values[guess.column];
    if (guess.nanoseconds >= 0)
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] += 1e-9 * excerpt.values[guess.nanoseconds][i];
    return values;
  }
  std::vector<double> rows(excerpt.rows());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = static_cast<double>(i);
  return rows;
}

}  // namespace faultline

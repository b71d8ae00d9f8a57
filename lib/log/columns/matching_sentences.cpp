// SPDX-License-Identifier: MIT
#include "lib/log/columns/matching_sentences.hpp"

#include "lib/core/text.hpp"

namespace faultline {
namespace {

constexpr std::size_t kMostNamed = 20;

std::string quoted(const std::string& name) { return "\"" + shortened(name, kLongestName) + "\""; }

std::string listed(const std::vector<std::string>& columns) {
  std::string found;
  for (std::size_t i = 0; i < columns.size() && i < kMostNamed; ++i)
    found += (i ? ", " : "") + quoted(columns[i]);
  if (columns.size() > kMostNamed) found += " and " + std::to_string(columns.size() - kMostNamed) + " more";
  return found;
}

}  // namespace

std::string missing_column_sentence(const std::vector<std::string>& columns, const std::string& channel,
                                    const std::string& meaning) {
  return "no column for the " + meaning + " (" + channel + ") was found; the columns are " + listed(columns) +
         ". Name it in the robot file: [log.columns] " + channel + " = {name = \"...\"}" +
         (channel == "t" ? "; without any, t = {name = \"@row\", scale = SAMPLE_PERIOD_IN_S}" : "");
}

std::string missing_joint_sentence(const std::vector<std::string>& columns, int joint,
                                   const std::string& later) {
  const std::string channel = to_string({Quantity::q, joint});
  return "no column for the position of joint " + std::to_string(joint) + " (" + channel +
         "), though there is " + quoted(later) + "; only the joints before it are read. The columns are " +
         listed(columns) + ". Name it in the robot file: [log.columns] " + channel + " = {name = \"...\"}";
}

std::string unknown_unit_sentence(const std::string& column, const std::string& unit,
                                  const std::string& channel) {
  return "column " + quoted(column) + " has the unit " + quoted(unit) +
         ", which is not known; its numbers are taken as SI. Set unit or scale in [log.columns] " + channel;
}

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
  const std::string channel = to_string({quantity, 1});
  return name_of(chosen) + " was taken as " + channel + "; " + rivals +
         " could be meant as well. To choose, name it in the robot file: [log.columns] " + channel;
}

std::string joint_order_sentence(const std::vector<std::string>& columns,
                                 const std::vector<std::pair<Channel, int>>& joints) {
  std::string names;
  for (const auto& [channel, column] : joints)
    if (channel.quantity == Quantity::q) names += (names.empty() ? "" : ", ") + quoted(columns[column]);
  return "the joints are taken in the order of the columns: " + names +
         ". If that is not from base to tip, name them in the robot file: [log.columns] q1 = {name = \"...\"}";
}

}  // namespace faultline

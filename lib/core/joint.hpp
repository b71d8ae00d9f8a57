// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/core.h>

#include <compare>

namespace faultline {

/// A joint of a robot, from base to tip, or no joint: the place of a fault that belongs to none or to all. A
/// link is identified by the joint that moves it. People count joints from 1, and so do messages, which print
/// a Joint as its number, and files; indices of vectors count from 0. No conversion between the two is
/// implicit.
class Joint {
 public:
  /// No joint.
  constexpr Joint() = default;
  /// The joint of an index from 0.
  static constexpr Joint at(int index) { return Joint(index + 1); }
  /// The joint of a number from 1; 0 is none.
  static constexpr Joint numbered(int number) { return Joint(number); }

  /// From 0, for vectors and matrices; -1 for none.
  constexpr int index() const { return is_none() ? -1 : number_ - 1; }
  /// From 1, for people and files; 0 for none. A number below 0, as a damaged file may have it, is kept, so
  /// that a check finds it.
  constexpr int number() const { return number_; }
  constexpr bool is_none() const { return number_ <= 0; }

  /// No joint is before the first one.
  friend constexpr auto operator<=>(Joint, Joint) = default;  // NOLINT(modernize-use-nullptr)

 private:
  explicit constexpr Joint(int number) : number_(number) {}

  int number_ = 0;
};

/// A joint of a constant number from 1: 2_joint is Joint::numbered(2).
constexpr Joint operator""_joint(unsigned long long number) {
  return Joint::numbered(static_cast<int>(number));
}

}  // namespace faultline

/// Prints the number; takes the width and alignment of an int.
template <>
struct fmt::formatter<faultline::Joint> : fmt::formatter<int> {
  template <typename Context>
  auto format(faultline::Joint joint, Context& context) const {
    return fmt::formatter<int>::format(joint.number(), context);
  }
};

// SPDX-License-Identifier: MIT
#include "lib/log/log.hpp"

#include <array>
#include <utility>

namespace faultline {
namespace {

/// In the order of Quantity; the time belongs to no joint.
constexpr std::array kSignals{&Log::q,     &Log::q,      &Log::dq,      &Log::tau,
                              &Log::q_ref, &Log::dq_ref, &Log::tau_ref, &Log::tau_meas};
static_assert(kSignals.size() == static_cast<std::size_t>(Quantity::tau_meas) + 1);

}  // namespace

JointSignals& signals_of(Log& log, Quantity quantity) {
  return log.*kSignals[static_cast<std::size_t>(quantity)];
}
const JointSignals& signals_of(const Log& log, Quantity quantity) {
  return log.*kSignals[static_cast<std::size_t>(quantity)];
}

void resize_like(Log& log, const Log& like, int rows) {
  for_each_column(log, like,
                  [&](std::vector<double>& mine, const std::vector<double>&) { mine.resize(rows); });
}

Log slice(const Log& log, int begin, int end) {
  Log part;
  part.first_row = log.first_row + begin;
  for_each_column(part, log, [&](std::vector<double>& mine, const std::vector<double>& all) {
    mine.assign(all.begin() + begin, all.begin() + end);
  });
  return part;
}

void append(Log& log, const Log& more) {
  if (log.rows() == 0) log.first_row = more.first_row;
  for_each_column(log, more, [](std::vector<double>& mine, const std::vector<double>& next) {
    mine.insert(mine.end(), next.begin(), next.end());
  });
}

void append(Log& log, Log&& more) {
  if (log.rows() == 0)
    std::swap(log, more);
  else
    append(log, std::as_const(more));
}

Log take_front(Log& log, int rows) {
  if (rows == log.rows()) return std::exchange(log, {});
  Log front = slice(log, 0, rows);
  log = slice(log, rows, log.rows());
  return front;
}

}  // namespace faultline

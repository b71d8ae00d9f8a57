// SPDX-License-Identifier: MIT
#include "lib/log/log.hpp"

namespace faultline {
namespace {

template <typename Visit>
void visit_columns(Log& log, const Log& like, Visit visit) {
  visit(log.time, like.time);
  auto visit_signals = [&](JointSignals& mine, const JointSignals& theirs) {
    mine.resize(theirs.size());
    for (std::size_t j = 0; j < theirs.size(); ++j) visit(mine[j], theirs[j]);
  };
  visit_signals(log.q, like.q);
  visit_signals(log.dq, like.dq);
  visit_signals(log.tau, like.tau);
  visit_signals(log.q_ref, like.q_ref);
  visit_signals(log.dq_ref, like.dq_ref);
  log.extra.resize(like.extra.size());
  for (std::size_t i = 0; i < like.extra.size(); ++i) {
    log.extra[i].name = like.extra[i].name;
    log.extra[i].unit = like.extra[i].unit;
    visit(log.extra[i].values, like.extra[i].values);
  }
}

}  // namespace

void resize_like(Log& log, const Log& like, int rows) {
  visit_columns(log, like, [&](std::vector<double>& mine, const std::vector<double>&) { mine.resize(rows); });
}

Log slice(const Log& log, int begin, int end) {
  Log part;
  part.first_row = log.first_row + begin;
  visit_columns(part, log, [&](std::vector<double>& mine, const std::vector<double>& all) {
    mine.assign(all.begin() + begin, all.begin() + end);
  });
  return part;
}

void append(Log& log, const Log& more) {
  if (log.rows() == 0) log.first_row = more.first_row;
  visit_columns(log, more, [](std::vector<double>& mine, const std::vector<double>& next) {
    mine.insert(mine.end(), next.begin(), next.end());
  });
}

}  // namespace faultline

// SPDX-License-Identifier: MIT
#include <iterator>

#include "lib/reproduce/page/reproduction.hpp"

namespace faultline {
namespace {

template <typename T>
void append(std::vector<T>& all, std::vector<T> more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

void add(Reproduction& reproduction, StudyResult study) {
  append(reproduction.tables, std::move(study.tables));
  append(reproduction.goals, std::move(study.goals));
}

}  // namespace

Reproduction reproduce(const ReproduceOptions& options, const Progress& progress) {
  options.check();
  Reproduction reproduction{options, {}, {}, {}};
  add(reproduction, generator_study(options, part_of(progress, 0.0, 0.3)));
  add(reproduction, classifier_study(options, part_of(progress, 0.3, 0.5)));
  add(reproduction, run_study(options, part_of(progress, 0.5, 0.98)));
  reproduction.figures = fault_figures(options);
  append(reproduction.figures, trade_off_figures(reproduction.tables));
  return reproduction;
}

}  // namespace faultline

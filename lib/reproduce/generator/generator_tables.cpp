// SPDX-License-Identifier: MIT
#include "lib/reproduce/generator/generator_tables.hpp"

#include <cmath>
#include <iterator>

#include "lib/reproduce/generator/generator_text.hpp"

namespace faultline {
namespace {

constexpr GeneratorTest kTests[] = {GeneratorTest::clean, GeneratorTest::noise_01, GeneratorTest::noise_1,
                                    GeneratorTest::clean_runs};

std::vector<FigureColumn> columns_of_tests() {
  return {{"clean"}, {"sigma 0.01"}, {"sigma 0.1"}, {"clean, runs of moves"}};
}

std::optional<Measured> printed(double figure) {
  if (std::isnan(figure)) return std::nullopt;
  return Measured{{figure}};
}

double study_clean(const StudyFigures& study, ControllerReading controller) {
  switch (controller) {
    case ControllerReading::held:
      return study.held;
    case ControllerReading::fast:
      return study.fast;
    case ControllerReading::pd:
      return study.pd;
  }
  return std::nan("");
}

ResultRow row_of(const GeneratorMeasurements& measured, int candidate, int controller) {
  const GeneratorCandidate& who = measured.candidates[candidate];
  ResultRow row{{who.name, to_string(kControllerReadings[controller]), who.patterns}, {}};
  for (const GeneratorTest test : kTests) row.figures.push_back(measured.mse(candidate, controller, test));
  row.figures.push_back(printed(study_clean(who.study, kControllerReadings[controller])));
  return row;
}

/// Rows of all candidates, controller by controller.
std::vector<ResultRow> rows_of(const GeneratorMeasurements& measured) {
  std::vector<ResultRow> rows;
  for (int controller = 0; controller < kControllers; ++controller)
    for (int c = 0; c < static_cast<int>(measured.candidates.size()); ++c)
      if (measured.mse(c, controller, GeneratorTest::clean)) rows.push_back(row_of(measured, c, controller));
  return rows;
}

ResultTable table_of(const GeneratorMeasurements& measured, std::string id, std::string title) {
  ResultTable table;
  table.id = std::move(id);
  table.title = std::move(title);
  table.label_columns = {"generator", "controller", "patterns"};
  table.figure_columns = columns_of_tests();
  table.figure_columns.push_back({"study, clean"});
  table.rows = rows_of(measured);
  return table;
}

}  // namespace

ResultTable generator_mse_table(const GeneratorMeasurements& measured, const GeneratorScale& scale) {
  ResultTable table = table_of(measured, "generator_mse", "Residual generators, robot without friction");
  table.figure_columns.push_back({"study, sigma 0.01"});
  table.figure_columns.push_back({"study, sigma 0.1"});
  const std::size_t candidates = measured.candidates.size();
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const bool is_held = i < candidates;
    const StudyFigures& study = measured.candidates[i % candidates].study;
    table.rows[i].figures.push_back(is_held ? printed(study.held_noise_01) : std::nullopt);
    table.rows[i].figures.push_back(is_held ? printed(study.held_noise_1) : std::nullopt);
  }
  table.text = generator_mse_text(measured, scale);
  return table;
}

ResultTable generator_by_output_table(const GeneratorMeasurements& measured) {
  ResultTable table;
  table.id = "generator_by_output";
  table.title = "The paper's residual generator, output by output";
  table.text = generator_by_output_text();
  table.label_columns = {"generator", "controller", "test"};
  for (const char* name : {"q1", "q2", "q3", "dq1", "dq2", "dq3"}) table.figure_columns.push_back({name});
  for (const char* name : {kBackPropagation, kLevenbergMarquardt})
    for (int controller = 0; controller < kControllers; ++controller)
      for (const GeneratorTest test : {GeneratorTest::clean, GeneratorTest::noise_01}) {
        ResultRow row{{name, to_string(kControllerReadings[controller]),
                       test == GeneratorTest::clean ? "clean" : "sigma 0.01"},
                      {}};
        for (int output = 0; output < 6; ++output)
          row.figures.push_back(measured.mse(measured.find(name), controller, test, output));
        table.rows.push_back(std::move(row));
      }
  return table;
}

ResultTable generator_friction_table(const GeneratorMeasurements& measured, const GeneratorScale& scale) {
  ResultTable table = table_of(measured, "generator_friction", "Residual generators, robot with friction");
  table.text = generator_friction_text(measured, scale);
  return table;
}

}  // namespace faultline

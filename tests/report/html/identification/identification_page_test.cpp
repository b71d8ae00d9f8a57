// SPDX-License-Identifier: MIT
#include "lib/report/html/identification/identification_page.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "lib/identify/identify.hpp"
#include "lib/log/log_source.hpp"
#include "tests/identify/closed_form_scara.hpp"

namespace faultline {
namespace {

const Identification& identified() {
  static const Identification id = [] {
    testing::ClosedFormRun run;
    run.duration_s = 12.0;  // a spectrum takes some seconds of windows
    MemorySource source(testing::simulate_closed_form({}, run), "<b>log</b>.csv");
    LogSource* logs[] = {&source};
    Robot robot = preset_robot("RRP");
    robot.name = "<script>arm";
    robot.log.torque_between_samples = TorqueTiming::held;
    IdentifyOptions options;
    options.method = IdentifyMethod::weak_form;
    return identify(logs, robot, options);
  }();
  return id;
}

TEST(IdentificationPage, ShowsEveryJointAndEveryPart) {
  const std::string page = render_identification_html(identified());
  for (const char* id : {"parameters", "fit", "joint-1", "joint-3", "motion", "logs", "torque-2",
                         "friction-2", "left-position-2", "left-speed-2", "spectrum-2"})
    EXPECT_NE(page.find(std::string("id=\"") + id + "\""), std::string::npos) << id;
}

TEST(IdentificationPage, LoadsAndRunsNothing) {
  const std::string page = render_identification_html(identified());
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_EQ(page.find("<b>log"), std::string::npos);
  EXPECT_EQ(page.find(" src="), std::string::npos);
  EXPECT_NE(page.find("script-src 'none'"), std::string::npos);
}

TEST(IdentificationPage, PicturesHaveUniqueNames) {
  std::set<std::string> names;
  for (const NamedPlot& plot : identification_figures(identified()))
    EXPECT_TRUE(names.insert(plot.name).second) << plot.name;
  EXPECT_GE(names.size(), 12u);
}

TEST(IdentificationPage, HasOnlyTablesIfThereAreNoCurves) {
  Identification id = identified();
  id.joint_fits.clear();
  const std::string page = render_identification_html(id);
  EXPECT_EQ(page.find("<figure"), std::string::npos);
  EXPECT_NE(page.find("95 % interval"), std::string::npos);
}

}  // namespace
}  // namespace faultline

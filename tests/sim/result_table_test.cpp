#include "sim/result/result_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace {

using sim::Dataset;

/// A sweep over two modules and two distances.
Dataset sweep() {
  Dataset data;
  data.experiment = "link";
  data.seed = 7;
  data.axes = {{"receiver.module", "", "", {0, 1}, {"TSOP4856", "my, \"own\""}},
               {"receiver.range_m", "m", "", {1, 2.5}}};
  return data;
}

Dataset::Variable counts(std::string name, std::vector<std::string> dimensions,
                         std::vector<std::int64_t> values) {
  return {.facts = {std::move(name), "1", ""},
          .dimensions = std::move(dimensions),
          .values = std::move(values)};
}

TEST(ResultTable, HasARowAPoint) {
  Dataset data = sweep();
  data.variables = {
      counts("n_frames", {}, {8, 16, 8, 8}),
      {.facts = {"ber", "1", ""}, .values = std::vector{0.1, 1e-9, std::nan(""), 1 / 3.}},
      {.facts = {"stop_reason", "1", ""},
       .values = std::vector<std::int64_t>{0, 1, sim::no_choice, 0},
       .flags = {"max_frames", "rel_ci"},
       .is_choice = true},
      {.facts = {"heard_s", "s", ""}, .on_axes = false, .values = std::vector{0.5}}};
  EXPECT_EQ(sim::result_as_csv(data),
            "experiment,seed,point,receiver_module,receiver_range_m,n_frames,ber,stop_reason\n"
            "link,7,0,TSOP4856,1,8,0.1,max_frames\n"
            "link,7,1,TSOP4856,2.5,16,1e-09,rel_ci\n"
            "link,7,2,\"my, \"\"own\"\"\",1,8,,\n"
            "link,7,3,\"my, \"\"own\"\"\",2.5,8,0.3333333333333333,max_frames\n");
  EXPECT_TRUE(sim::result_as_json_lines(data).starts_with(
      R"({"format_version":"1","experiment":"link","seed":7,"point":0,)"
      R"("receiver_module":"TSOP4856","receiver_range_m":1.0,"n_frames":8,"ber":0.1,)"
      R"("stop_reason":"max_frames"})"
      "\n"));
  EXPECT_NE(sim::result_as_json_lines(data).find(R"("ber":null,"stop_reason":null})"),
            std::string::npos);
}

TEST(ResultTable, HasARowAnElementOfTheOnlyDimension) {
  Dataset data = sweep();
  data.axes.erase(data.axes.begin());
  data.dimensions = {{{"device", "1", ""}, std::vector<std::string>{"near", "far"}}};
  data.variables = {counts("n_runs", {}, {3, 4}), counts("n_heard", {"device"}, {30, 31, 40, 41})};
  EXPECT_EQ(sim::result_as_csv(data),
            "experiment,seed,point,receiver_range_m,device,n_runs,n_heard\n"
            "link,7,0,1,near,3,30\n"
            "link,7,0,1,far,3,31\n"
            "link,7,1,2.5,near,4,40\n"
            "link,7,1,2.5,far,4,41\n");
}

TEST(ResultTable, HasColumnsOfTheElementsOfSeveralDimensions) {
  Dataset data = sweep();
  data.axes.clear();
  data.dimensions = {{{"reading", "1", ""}, std::vector<double>{1, 2}},
                     {{"outcome", "1", ""}, std::vector<std::string>{"good", "poor"}}};
  data.variables = {counts("n_read", {"reading"}, {1, 2}),
                    counts("n_outcomes", {"outcome"}, {3, 4}),
                    counts("n_both", {"reading", "outcome"}, {5, 6, 7, 8})};
  EXPECT_EQ(sim::result_as_csv(data),
            "experiment,seed,point,n_read[1],n_read[2],n_outcomes[good],n_outcomes[poor],"
            "\"n_both[1,good]\",\"n_both[1,poor]\",\"n_both[2,good]\",\"n_both[2,poor]\"\n"
            "link,7,0,1,2,3,4,5,6,7,8\n");
}

}  // namespace

// `cosys-sim report` of experiments that are no links: what is in each report is what was counted.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <regex>

#include "experiment_report.hpp"
#include "occurrences.hpp"

namespace sim {
namespace {

TEST_F(ExperimentReport, OfAnArenaShowsWhoWasHeardWhere) {
  const Json counted = run("a", arena);
  const std::int64_t delivered = sum(counted, "n_delivered");
  const std::int64_t silent = sum(counted, "n_silent");
  ASSERT_GT(delivered, 0);
  ASSERT_GT(silent, 0);
  const std::string page = report({"a.h5", "--svg", "p"});
  expect_has(page,
             fmt::format("<p>{} messages were sent in 2 runs; {} of them were delivered. {} more "
                         "were left out in silent spells.</p>",
                         sum(counted, "n_messages") - silent, delivered, silent));
  expect_has(page, "<p>Of those lost: out of reach ");
  const Json& first = counted["variables"]["latency_mean_s"]["values"];
  expect_has(page, fmt::format("<p>First heard on average: near after {:.2g} s (2 of 2 runs).</p>",
                               first[1].get<double>()));
  expect_has(page, "<h2>Where messages were heard</h2>");
  expect_has(page, "<td>near</td><td>1.5</td><td>0</td>");
  expect_has(page, "&lt;b&gt;");
  const std::string map = content(path("p/map.svg"));
  expect_has(map, fmt::format(">near: {} messages heard</text>", delivered));
  expect_has(map, ">away: 0 messages heard</text>");
  EXPECT_EQ(occurrences(map, " disc\""), 1U) << "one of them was heard";
  expect_has(content(path("p/fates.svg")), ">out of reach</text>");
}

TEST_F(ExperimentReport, OfASweptArenaHasAMapOfEachPoint) {
  const Json counted = run("a", arena + "[sweep]\ndevices.near.x_m = [1.5, 30]\n");
  const Json& names = counted["dimensions"]["device"];
  const auto near = static_cast<std::size_t>(names[0] == "near" ? 0 : 1);
  ASSERT_NE(cell(counted, "n_delivered", 0, near), cell(counted, "n_delivered", 1, near));
  const std::string page = report({"a.h5", "--svg", "p"});
  expect_has(page, "<p>The mean time until the first message is heard is ");
  ASSERT_EQ(cell(counted, "n_delivered", 1, near), 0);
  expect_has(page, "<p>At 1 of 2 points none is ever heard.</p>");
  const char* const maps[] = {"p/map.svg", "p/map-2.svg"};
  const char* const places[] = {"1.5", "30"};
  for (std::size_t point = 0; point < 2; ++point) {
    const std::int64_t delivered = cell(counted, "n_delivered", point, near);
    expect_has(content(path(maps[point])),
               fmt::format(">near: {} messages heard</text>", delivered));
    const std::regex row(fmt::format(
        "<td>near</td><td>{}</td><td>0</td><td>[^<]*</td><td>{}</td>"
        "<td>{}</td>",
        places[point],
        cell(counted, "n_messages", point, near) - cell(counted, "n_silent", point, near),
        delivered));
    EXPECT_TRUE(std::regex_search(page, row)) << point;
  }
}

TEST_F(ExperimentReport, OfASweptArenaComparesFilesInOnePicture) {
  run("a", arena + "[sweep]\ndevices.near.x_m = [1.5, 2]\n");
  run("b", arena + "[sweep]\ndevices.near.x_m = [1.7, 2]\n");
  const std::string page = report({"a.h5", "b.h5"});
  EXPECT_EQ(occurrences(page, "<h2>Throughput</h2>"), 1U);
  for (const std::string name : {"a", "b"}) {
    expect_has(page, ">" + name + ", simulated</text>");
    expect_has(page, "<h2>" + name + ": Where messages were heard, devices.near.x_m = 2 m</h2>");
  }
  expect_has(page, ">dashed: theory</text>");
  expect_has(page, "<p>a: ");
}

TEST_F(ExperimentReport, OfALinkAndAnArenaTogether) {
  run("a", arena);
  write_scenario("l.toml", "receiver.range_m = [1, 11]");
  ASSERT_EQ(program({"run", "l.toml", "-q"}).code, 0);
  const std::string page = report({"l.h5", "a.h5"});
  expect_has(page, "<h1>l, a</h1>");
  expect_has(page, "<h2>l: All numbers</h2>");
  expect_has(page, "<h2>a: All numbers</h2>");
}

TEST_F(ExperimentReport, OfAGuardSaysWhatTheBaseStationKnows) {
  const Json counted = run("g", std::regex_replace(arena, std::regex("\"arena\""), "\"guard\"") +
                                    "messages = \"AWAY 1\"\n[devices.third]\nx_m = 2\ny_m = 0.2\n"
                                    "yaw_deg = 180\nmessages = \"THIRD\"\n");
  const std::string page = report({"g.h5"});
  const std::int64_t sent = sum(counted, "n_messages") - sum(counted, "n_silent");
  ASSERT_GT(sum(counted, "n_silent"), 0);
  expect_has(page, fmt::format("<p>{} messages were sent in ", sent));
  expect_has(page, fmt::format("The base station got to know {} of the {} messages.</p>",
                               sum(counted, "n_known"), sent));
  const Json& ages = counted["variables"]["age_mean_s"]["values"];
  const Json& names = counted["dimensions"]["device"];
  std::map<double, std::string> by_age;
  for (std::size_t i = 0; i < ages.size(); ++i)
    if (!ages[i].is_null()) by_age[ages[i].get<double>()] = names[i].get<std::string>();
  ASSERT_EQ(by_age.size(), 2U) << "two were heard";
  expect_has(page, "<p>What it knows is oldest of " + by_age.rbegin()->second + ": ");
  expect_has(page, ">known to the base station</text>");
  expect_has(page, "<th scope=\"col\">lost by SharedLink</th>");
}

TEST_F(ExperimentReport, OfSharedLinkShowsWhyMessagesWereRefused) {
  const Json counted =
      run("s",
          "experiment = \"sharedlink\"\n[receiver]\nmodule = \"TSSP4056\"\n[exchange]\n"
          "duration_s = 10\nruns = 1\n[sweep]\nreceiver.range_m = [1, 12.5, 40]\n");
  const std::string page = report({"s.h5"});
  const std::int64_t sent = sum(counted, "n_messages");
  expect_has(page, fmt::format("<p>Both nodes together sent {} messages in 3 runs at 3 points; {} "
                               "of them the other did not accept.</p>",
                               sent, sent - sum(counted, "n_accepted")));
  expect_has(page, "<h2>Message loss</h2>");
  expect_has(page,
             "<p>Half of a node's messages or more are lost at receiver.range_m from 12.5 to 40 m, "
             "where the sweep ends.</p>");
  const Json& ages = counted["variables"]["age_mean_s"]["values"];
  expect_has(page,
             fmt::format("<p>Where more than half of them are heard, its values are so old at the "
                         "other on average: {:.2g} s (sender A); {:.2g} s (sender B).</p>",
                         ages[0].get<double>(), ages[1].get<double>()));
  const Json& unknown = counted["variables"]["unknown_share"]["values"];
  expect_has(page, fmt::format("<td>{:.1f} %</td>", 100 * unknown[0].get<double>()));
  expect_has(page, ">sender A</text>");
  expect_has(page, ">sender B</text>");
  expect_has(page, ">refused for another reason</text>");
  for (std::size_t point = 0; point < 2; ++point)
    expect_has(page, fmt::format("<td>{}</td><td>{}</td>", point == 0 ? "1" : "12.5",
                                 cell(counted, "n_accepted", point, 0) +
                                     cell(counted, "n_accepted", point, 1)));
  expect_has(page, fmt::format("<td>{}</td></tr>", cell(counted, "n_messages", 2, 0) +
                                                       cell(counted, "n_messages", 2, 1)));
}

TEST_F(ExperimentReport, OfPresenceDrawsDetectionAndRoc) {
  run("p",
      "experiment = \"presence\"\n[presence]\ntrials = 50\nadc_bits = 16\n[sweep]\n"
      "receiver.range_m = [40, 50, 400]\n");
  const std::string page = report({"p.h5"});
  expect_has(page, "<p>150 windows with and 150 without light were judged at 3 points.</p>");
  expect_has(page,
             "With false_alarm = 0.001 the device is noticed in 90 % of the windows or more at "
             "receiver.range_m from 40, where the sweep begins, to 50 m.</p>");
  expect_has(page, "<h2>Detection</h2>");
  expect_has(page, "<h2>Receiver operating characteristic (ROC)</h2>");
  expect_has(page, ">receiver.range_m = 400</text>");
  expect_has(page, ">dashed: theory</text>");
}

TEST_F(ExperimentReport, OfPresenceComparesDetectors) {
  const auto answer = [&](const std::string& ranges) {
    run("p",
        "experiment = \"presence\"\n[presence]\ntrials = 50\nadc_bits = 16\n[sweep]\n"
        "presence.detector = [\"synchronous\", \"goertzel\"]\nreceiver.range_m = " +
            ranges + "\n");
    return report({"p.h5"});
  };
  const std::string equal = answer("[40, 50, 400]");
  expect_has(
      equal,
      "or more at receiver.range_m from 40, where the sweep begins, to 50 m, in both cases.</p>");
  expect_has(answer("[300, 400]"), "at no point that was simulated is the device noticed in 90 %");
}

TEST_F(ExperimentReport, OfLocationDrawsTheEllipses) {
  const Json counted = run("x",
                           "experiment = \"location\"\n[location]\ntrials = 8\n[sweep]\n"
                           "location.relative_sigma = [0.01, 0.03]\n");
  const std::string page = report({"x.h5", "--svg", "p"});
  expect_has(page, "<p>Locating was tried 16 times at 2 points: located ");
  expect_has(page,
             "The rms error of the located ones is least at location.relative_sigma = 0.01: ");
  expect_has(page, "<p>The coverage of the 95 % region is ");
  const std::string map = content(path("p/map.svg"));
  for (const std::size_t point : {0U, 1U}) {
    EXPECT_EQ(occurrences(map, fmt::format("<path class=\"curve{}\"", point + 1)), 2U)
        << "an ellipse in the colour of its point, and the legend's";
    expect_has(map,
               fmt::format(">location.relative_sigma = {}: {} of the first 8 trials located it"
                           "</text>",
                           point == 0 ? 0.01 : 0.03,
                           counted["variables"]["n_outcomes"]["values"][5 * point].get<int>()));
  }
  EXPECT_EQ(occurrences(map, "<path class=\"dot\""), 4U + 2U)
      << "each of the receivers once, and the device of each point";
  expect_has(content(path("p/outcomes.svg")), ">located</text>");
}

TEST_F(ExperimentReport, OfFalseAcceptSaysHowOftenSomethingWasAccepted) {
  const Json counted = run("n",
                           "experiment = \"listening\"\n[receiver]\nmodule = \"TSSP4056\"\n"
                           "[listening]\ndevice_sends = false\nduration_s = 10\nruns = 1\n"
                           "air = \"cosys\"\n");
  const std::string page = report({"n.h5"});
  ASSERT_GT(sum(counted, "n_frames_false"), 0);
  expect_has(page, fmt::format("{} messages were accepted though the device itself sent none.</p>",
                               sum(counted, "n_frames_false")));
  for (const char* impossible : {"sent another", "ndetected error", "accepted as sent"})
    EXPECT_EQ(page.find(impossible), std::string::npos) << impossible;
  expect_has(page, "<p>The rate of false accepts is ");
  expect_has(page, ">accepted though the device sent none</text>");
  expect_has(page, fmt::format("<td>all</td><td>{}</td><td>{}</td>", sum(counted, "n_frames_false"),
                               sum(counted, "n_rejected")));
}

TEST_F(ExperimentReport, RefusesWhatIsDamagedOrNewer) {
  run("p", "experiment = \"presence\"\n[presence]\ntrials = 8\n");
  std::string file = content(path("p.h5"));
  write("cut.h5", file.substr(0, file.size() / 2));
  expect_refused({"report", "cut.h5"}, 2,
                 "cut.h5 (not a result of cosys-sim, or damaged) give a file that run wrote");
  const std::size_t at = file.find("1.3", file.find("format_version"));
  ASSERT_NE(at, std::string::npos);
  write("new.h5", file.replace(at, 3, "7.0"));
  expect_refused(
      {"report", "new.h5"}, 2,
      "new.h5 (its format 7.0 is newer than 1.3, the newest known here) read it with the "
      "cosys-sim that wrote it, or a later one");
}

}  // namespace
}  // namespace sim

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "coordinator/export/csv_files.hpp"
#include "coordinator/export/geo_anchor.hpp"
#include "coordinator/export/geojson_file.hpp"
#include "coordinator/export/mission_report_pdf.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const Timestamp kBegin{std::chrono::seconds(1'790'000'000)};

/// One helmet that walked 2 m along x, placed 10 m to the right and turned to the left, and a room
/// with a wall of three cells and a single one above.
MissionStory story() {
  MissionStory story;
  story.mission_id = "m";
  story.first = kBegin;
  story.last = kBegin + std::chrono::seconds(65);
  OccupancyGrid grid{1.0, {0.0, 0.0}, 3, 3, std::vector<Occupancy>(9, Occupancy::free)};
  for (const std::size_t cell : {0U, 1U, 2U, 7U}) grid.cells[cell] = Occupancy::occupied;
  story.maps.push_back({"map", "A room", grid, {0}});
  HelmetTrack track{
      {AgentId::parse("alpha").value(), MapId{1}, Floor{0}}, Pose2{10.0, 0.0, M_PI / 2.0}, {}, {}};
  for (int i = 0; i <= 20; ++i) {
    track.poses.push_back({kBegin + std::chrono::milliseconds(100 * i), {0.1 * i, 0.0, 0.0}});
    track.trust_percent.push_back(90);
  }
  story.tracks.push_back(track);
  sharing::FleetDetection find{.group = 0,
                               .layer = track.layer,
                               .x_m = 1.0,
                               .y_m = 2.0,
                               .confidence = 0.5,
                               .first = {1, "alpha"},
                               .last = {2, "alpha"},
                               .seen_by = {"alpha"}};
  story.finds.push_back(find);
  wire::Alert alert;
  alert.issuer_id = "alpha";
  alert.text = "=SUM(A1), \"help\"";
  story.alerts.push_back({kBegin + std::chrono::seconds(5), alert});
  wire::MergeEvidence evidence;
  evidence.a = {"alpha", 1, 0};
  evidence.b = {"bravo", 1, 0};
  evidence.reason = "too little, wait";
  story.merges.push_back({kBegin + std::chrono::seconds(7), evidence});
  return story;
}

GeoAnchor anchor(const std::string& a, const std::string& b) {
  const auto anchor = GeoAnchor::parse({a, b});
  EXPECT_TRUE(anchor) << anchor.error().text;
  return anchor.value();
}

TEST(GeoAnchor, AKnownPointLiesWhereItWasSaid) {
  const GeoAnchor north_up = anchor("0,0=49.4521,11.0767", "0,100=49.4529991,11.0767");
  EXPECT_NEAR(north_up.to_earth({0.0, 0.0}).latitude_deg, 49.4521, 1e-7);
  EXPECT_NEAR(north_up.to_earth({0.0, 100.0}).latitude_deg, 49.4529991, 1e-7);
  // 100 m east: a degree of longitude is 72,489 m here (WGS 84's tables).
  EXPECT_NEAR(north_up.to_earth({100.0, 0.0}).longitude_deg, 11.0767 + 100.0 / 72'489.0, 2e-6);
}

TEST(GeoAnchor, AMapMayLieTurned) {
  // Its x axis points north.
  const GeoAnchor turned = anchor("0,0=0,0", "111,0=0.0010038,0");
  const GeoPoint left = turned.to_earth({0.0, 111.0});
  EXPECT_NEAR(left.latitude_deg, 0.0, 1e-6);
  EXPECT_NEAR(left.longitude_deg, -111.0 / 111'319.5, 1e-6);
}

TEST(GeoAnchor, WhatCannotBeIsRefusedWithWhatToDo) {
  const auto refusal = [](const std::vector<std::string>& texts) {
    const auto parsed = GeoAnchor::parse(texts);
    return parsed ? std::string("accepted") : parsed.error().text;
  };
  EXPECT_THAT(refusal({"0,0=49,11"}), HasSubstr("twice"));
  for (const char* text : {"", "0,0", "0,0=49", "0,0=49,11,3", "0;0=49,11", "nan,0=49,11",
                           "0,0=91,11", "0,0=49,181", "1e9,0=49,11", "0,0=49,11 "}) {
    EXPECT_THAT(refusal({text, "5,0=49,11"}), HasSubstr("write X,Y=LATITUDE,LONGITUDE")) << text;
  }
  EXPECT_THAT(refusal({"0,0=49,11", "1,0=49,11.1"}), HasSubstr("at least 2 m apart"));
  EXPECT_THAT(refusal({"0,0=49,11", "10,0=49,11.1"}), HasSubstr("correct the one"));
}

TEST(GeoJson, HoldsWallsPathsAndFindsInLongitudeAndLatitude) {
  const std::string text = to_geojson(story(), anchor("0,0=0,0", "0,111=0.00100384,0"));
  const auto json = nlohmann::json::parse(text);
  EXPECT_EQ(json.at("type"), "FeatureCollection");
  const auto& features = json.at("features");
  ASSERT_EQ(features.size(), 3U);
  EXPECT_EQ(features[0].at("geometry").at("type"), "MultiLineString");
  EXPECT_EQ(features[0].at("geometry").at("coordinates").size(), 2U) << "a wall and a single cell";
  for (const auto& line : features[0].at("geometry").at("coordinates")) {
    ASSERT_EQ(line.size(), 2U);
    EXPECT_NE(line[0], line[1]);
  }
  const auto& path = features[1];
  EXPECT_EQ(path.at("geometry").at("type"), "LineString");
  EXPECT_EQ(path.at("properties").at("helmet"), "alpha");
  // Placed at x = 10 m and turned left: it goes north.
  const auto& last = path.at("geometry").at("coordinates").back();
  EXPECT_NEAR(last[0].get<double>(), 10.0 / 111'319.5, 2e-7);
  EXPECT_NEAR(last[1].get<double>(), 2.0 / 110'574.0, 2e-7);
  EXPECT_EQ(features[2].at("properties").at("what"), "detection");
  EXPECT_EQ(features[2].at("properties").at("kind"), "victim");
}

TEST(Csv, TextsFromOutsideStayInTheirCell) {
  const support::TemporaryFolder folder;
  ASSERT_TRUE(write_csv_files(folder.path(), story()));
  EXPECT_THAT(support::content_of(folder.path() / "alerts.csv"),
              HasSubstr("5.000,2026-09-21 14:13:25,alpha,0,mayday,raised,,"
                        "\"'=SUM(A1), \"\"help\"\"\",\r\n"));
  EXPECT_THAT(support::content_of(folder.path() / "merges.csv"),
              HasSubstr(",alpha/1,bravo/1,wait,,,,,,\"too little, wait\"\r\n"));
  EXPECT_THAT(support::content_of(folder.path() / "paths.csv"),
              HasSubstr("2.000,2026-09-21 14:13:22,alpha,1,0,2.000,0.000,0.0000,10.000,2.000,"
                        "1.5708,90\r\n"));
  EXPECT_THAT(support::content_of(folder.path() / "detections.csv"),
              HasSubstr("victim,reported,common,0,1.000,2.000,0.500,alpha,"));
}

TEST(Csv, EveryLineHasAsManyCellsAsItsHeading) {
  const support::TemporaryFolder folder;
  MissionStory plain = story();
  plain.alerts[0].message.text = "help";
  plain.merges[0].message.reason = "wait";
  ASSERT_TRUE(write_csv_files(folder.path(), plain));
  for (const char* name : {"paths.csv", "detections.csv", "alerts.csv", "merges.csv"}) {
    std::istringstream lines(support::content_of(folder.path() / name));
    std::string heading;
    std::getline(lines, heading);
    for (std::string line; std::getline(lines, line);)
      EXPECT_EQ(std::count(line.begin(), line.end(), ','),
                std::count(heading.begin(), heading.end(), ','))
          << name << ": " << line;
  }
}

TEST(ReportPdf, IsWrittenWhateverThereIsToTell) {
  const auto full = to_report_pdf(story());
  ASSERT_TRUE(full);
  EXPECT_THAT(*full, StartsWith("%PDF-"));
  EXPECT_THAT(*full, HasSubstr("%%EOF"));
  MissionStory long_one = story();
  for (int i = 0; i < 5'000; ++i) long_one.merges.push_back(long_one.merges.front());
  const auto many = to_report_pdf(long_one);
  ASSERT_TRUE(many);
  EXPECT_GT(many->size(), full->size());
  EXPECT_TRUE(to_report_pdf(MissionStory{}));
}

TEST(MissionStory, AWalkIsAsLongAsItIs) {
  EXPECT_NEAR(story().tracks[0].walked_m(), 2.0, 1e-9);
  EXPECT_EQ(story().tracks[0].name(), "alpha");
  EXPECT_NEAR(story().tracks[0].placed().back().pose.y_m, 2.0, 1e-9);
  EXPECT_EQ(mission_time(std::chrono::seconds(3725)), "1:02:05");
}

}  // namespace
}  // namespace lifeline

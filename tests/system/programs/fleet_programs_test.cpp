// The real programs, each a process of its own, over real DDS on the loopback interface.

#include <algorithm>
#include <csignal>
#include <fstream>
#include <map>
#include <sstream>
#include <thread>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/socket.h>
#include <unistd.h>

#include "common/base/ids.hpp"
#include "common/wire/tile_codec.hpp"
#include "common/wire/tile_parts.hpp"
#include "coordinator/dashboard/listen_address.hpp"
#include "deploy/demo/free_domain.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::test {
namespace {

using std::chrono::seconds;

class FleetProgramsTest : public testing::Test {
 protected:
  std::vector<std::string> agent(const std::string& id, const std::string& source) {
    return {"lifeline-agent", "run",      "--id",  id,      "--source", source,      "--report",
            report(),         "--domain", domain_, "--qos", qos_,       "--mission", mission_};
  }
  [[nodiscard]] std::string report() const { return (folder_.path() / "report").string(); }

  nlohmann::json read(const std::string& name) {
    std::ifstream file(folder_.path() / "report" / name);
    return nlohmann::json::parse(file, nullptr, false);
  }

  support::TemporaryFolder folder_;
  std::string domain_ =
      std::to_string(demo::pick_free_domain(random_incarnation().value, 4).value());
  std::string mission_ = "test-" + std::to_string(random_incarnation().value % 1'000'000'000);
  std::string qos_ = LIFELINE_SOURCE_DIR "/config/qos/loopback.xml";
};

/// Nobody else listens at the dashboard's default address, whoever has it now.
class TakenDashboardAddress {
 public:
  TakenDashboardAddress() : handle_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(dashboard::kDefaultPort);
    // Refused where another program listens there: as good.
    (void)::bind(handle_, reinterpret_cast<const sockaddr*>(&address), sizeof address);
    (void)::listen(handle_, 1);
  }
  ~TakenDashboardAddress() { ::close(handle_); }
  TakenDashboardAddress(const TakenDashboardAddress&) = delete;
  TakenDashboardAddress& operator=(const TakenDashboardAddress&) = delete;

 private:
  int handle_;
};

TEST_F(FleetProgramsTest, EveryProcessOfTheDemoEndsWithTheSameCommonMap) {
  const TakenDashboardAddress taken;  // a page that cannot be shown harms nothing else
  const Ended ended = run_program({"lifeline-demo", "--helmets", "2", "--report", report()},
                                  folder_.path() / "log", seconds(150));
  ASSERT_EQ(ended.status, 0) << ended.output;
  const auto summary = read("summary.json");
  ASSERT_TRUE(summary.is_object());
  EXPECT_TRUE(summary.at("shared").get<bool>());
  const std::string sha256 = summary.at("coordinator").at("common_map_sha256");
  EXPECT_EQ(sha256.size(), 64U);
  ASSERT_EQ(summary.at("helmets").size(), 2U);
  for (const auto& helmet : summary.at("helmets")) {
    EXPECT_EQ(helmet.at("common_map_sha256"), sha256);
    EXPECT_EQ(helmet.at("fingerprint"), summary.at("helmets")[0].at("fingerprint"));
    EXPECT_LE(helmet.at("trajectory_rmse_m").get<double>(), 0.10);
    EXPECT_GT(helmet.at("scans").get<int>(), 100);
    EXPECT_GT(helmet.at("bytes_sent").get<std::int64_t>(), 1000);
  }
  for (const auto& merge : summary.at("merges")) {
    if (!merge.at("accepted").get<bool>()) continue;
    EXPECT_LE(merge.at("error_m").get<double>(), 0.10);
    EXPECT_LE(merge.at("error_deg").get<double>(), 1.0);
  }
  EXPECT_GT(std::filesystem::file_size(folder_.path() / "report/common_map.png"), 1000U);
}

TEST_F(FleetProgramsTest, ASecondHelmetOfOneIdDoesNotStartAndBothSaySo) {
  Program first(agent("alpha", "sim:office?duration=600"), folder_.path() / "first.log");
  std::this_thread::sleep_for(seconds(3));
  const Ended second = run_program(agent("alpha", "sim:office?duration=600&walk_seed=9"),
                                   folder_.path() / "second.log", seconds(30));
  EXPECT_EQ(second.status, 1) << second.output;
  EXPECT_EQ(lines_with(second.output, "lifeline-agent: another helmet calls itself alpha already"),
            1U)
      << second.output;
  EXPECT_TRUE(first.wait_for_output("another helmet calls itself alpha too", seconds(10)))
      << first.output();
  first.send(SIGTERM);
  EXPECT_EQ(first.wait(seconds(20)).status, 0)
      << "the one at work goes on, and stops in good order";
}

TEST_F(FleetProgramsTest, AHelmetMapsWithNobodyElseThere) {
  Program alpha(agent("alpha", "sim:office?duration=20&rate=x10&beams=400"),
                folder_.path() / "alpha.log");
  ASSERT_TRUE(alpha.wait_for_output("last scan", seconds(40))) << alpha.output();
  alpha.send(SIGINT);
  ASSERT_EQ(alpha.wait(seconds(20)).status, 0) << alpha.output();
  const auto helmet = read("alpha.json");
  EXPECT_EQ(helmet.at("scans").get<int>() + helmet.at("scans_dropped").get<int>(), 200);
  EXPECT_EQ(helmet.at("common_map_sha256"), "");
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "report/alpha.lifemap"));
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "report/alpha.truth.tum"));
}

std::vector<std::uint8_t> from_hex(const std::string& text) {
  std::vector<std::uint8_t> octets;
  for (std::size_t i = 0; i + 1 < text.size(); i += 2) {
    octets.push_back(static_cast<std::uint8_t>(std::stoi(text.substr(i, 2), nullptr, 16)));
  }
  return octets;
}

wire::TsdTile tile_part(const nlohmann::json& sample) {
  wire::TsdTile tile;
  tile.part = sample.at("part");
  tile.parts = sample.at("parts");
  tile.revision = sample.at("revision");
  tile.payload = from_hex(sample.at("payload"));
  return tile;
}

std::string tile_name(const nlohmann::json& sample) {
  return sample.at("agent_id").get<std::string>() + sample.at("tile_x").dump() + "/" +
         sample.at("tile_y").dump();
}

TEST_F(FleetProgramsTest, CycloneDdsReadsTheTilesAndTheDirectiveOfARunningFleet) {
  const std::string walk = "&walkers=2&duration=60&rate=x10&beams=400&seed=1";
  Program reader({"lifeline-cyclone-reader", "--domain", domain_, "--seconds", "90", "--tiles",
                  "100", "--directives", "1"},
                 folder_.path() / "cyclone.log");
  Program coordinator(
      {"lifeline-coordinator", "run", "--domain", domain_, "--qos", qos_, "--mission", mission_},
      folder_.path() / "coordinator.log");
  Program alpha(agent("alpha", "sim:office?walker=0" + walk), folder_.path() / "alpha.log");
  Program bravo(agent("bravo", "sim:office?walker=1" + walk), folder_.path() / "bravo.log");
  const Ended read = reader.wait(seconds(100));
  ASSERT_EQ(read.status, 0) << read.output;

  std::size_t tiles = 0, known_cells = 0, directives = 0;
  std::map<std::string, wire::TileParts> parts;
  std::istringstream lines(read.output);
  for (std::string line; std::getline(lines, line);) {
    const auto sample = nlohmann::json::parse(line, nullptr, false);
    if (!sample.is_object()) continue;
    EXPECT_EQ(sample.at("mission_id"), mission_);
    if (sample.at("topic") == "tsd_tile") {
      const auto payload = parts[tile_name(sample)].add(tile_part(sample)).value();
      if (!payload) continue;
      const auto cells = wire::decode_tile(*payload, GridGeometry{});
      ASSERT_TRUE(cells) << cells.error().text;
      ++tiles;
      known_cells += static_cast<std::size_t>(std::count_if(
          cells->begin(), cells->end(), [](QuantisedCell cell) { return cell.weight > 0; }));
    } else {
      ++directives;
      EXPECT_EQ(sample.at("members").size(), 2U);
      EXPECT_GE(sample.at("epoch").get<int>(), 1);
    }
  }
  EXPECT_GE(tiles, 20U);
  EXPECT_GT(known_cells, 10'000U);
  EXPECT_GE(directives, 1U);
}

}  // namespace
}  // namespace lifeline::test

#include "deploy/demo/report_folder.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <system_error>
#include <utility>

#include "common/files/atomic_file.hpp"
#include "common/files/read_file.hpp"
#include "common/files/report_folder.hpp"
#include "deploy/demo/judge_trajectory.hpp"

namespace lifeline::demo {
namespace {

using std::filesystem::path;

constexpr std::size_t kMostReportBytes = 16 * 1024 * 1024;
constexpr std::size_t kMostLogBytes = 64 * 1024 * 1024;

/// What a demo may leave: its own files, and those of every helmet that it can have.
std::vector<std::string> demo_files() {
  std::vector<std::string> files{"summary.json",   "coordinator.json", "coordinator.log",
                                 "common_map.png", "common_map.pgm",   "common_map.yaml"};
  constexpr std::array kEndings{".json", ".tum", ".truth.tum", ".lifemap", ".png", ".log"};
  for (std::size_t i = 0; i < kMostHelmets; ++i) {
    for (const char* ending : kEndings) files.push_back(helmet_name(i) + ending);
  }
  return files;
}

}  // namespace

Result<void> prepare_report_folder(const path& folder) {
  auto made = files::prepare_report_folder(folder);
  if (!made) return fail(made.error().code, "{} (--report names another)", made.error().text);
  for (const std::string& file : demo_files()) {
    std::error_code error;
    std::filesystem::remove(folder / file, error);
    if (error) {
      return fail(ErrorCode::unavailable,
                  "{}: cannot be removed: {} (--report names another folder)",
                  (folder / file).string(), error.message());
    }
  }
  return {};
}

nlohmann::json read_report(const path& file) {
  const auto text = files::read_file(file, kMostReportBytes);
  if (!text) return nullptr;
  nlohmann::json report = nlohmann::json::parse(*text, nullptr, false);
  return report.is_object() ? report : nlohmann::json();
}

std::vector<HelmetOutcome> read_outcomes(const path& folder, const FleetPlan& fleet) {
  std::vector<HelmetOutcome> outcomes;
  for (const HelmetPlan& helmet : fleet.helmets) {
    const std::string& id = helmet.agent_id;
    const TrajectoryVerdict verdict =
        judge_trajectory(folder / (id + ".tum"), folder / (id + ".truth.tum"));
    outcomes.push_back(
        {id, read_report(folder / (id + ".json")), verdict.rmse_m, verdict.T_world_map});
  }
  return outcomes;
}

Result<void> write_summary(const path& folder, const nlohmann::json& summary) {
  return files::write_file_atomically(folder / "summary.json", summary.dump(2) + "\n");
}

std::vector<path> pictures(const path& folder) {
  std::vector<path> found;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".png") found.push_back(entry.path());
  }
  std::ranges::sort(found, {}, [](const path& picture) {
    return std::pair(picture.filename() != "common_map.png", picture);
  });
  return found;
}

std::string last_line(const path& file) {
  std::istringstream text(files::read_file(file, kMostLogBytes).value_or(""));
  std::string last;
  for (std::string line; std::getline(text, line);) {
    if (!line.empty()) last = line;
  }
  return last;
}

}  // namespace lifeline::demo

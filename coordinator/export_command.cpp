#include "coordinator/export_command.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "common/base/log.hpp"
#include "common/files/atomic_file.hpp"
#include "common/files/occupancy_image.hpp"
#include "common/files/report_folder.hpp"
#include "common/files/tum.hpp"
#include "coordinator/export/collect_story.hpp"
#include "coordinator/export/csv_files.hpp"
#include "coordinator/export/geojson_file.hpp"
#include "coordinator/export/mission_report_pdf.hpp"

namespace lifeline {
namespace {

constexpr std::array<std::string_view, 7> kFormats{"pgm", "png", "svg",    "pdf",
                                                   "tum", "csv", "geojson"};

/// What is to be written, checked before anything is read.
struct Plan {
  std::vector<std::string> formats;
  std::optional<GeoAnchor> anchor;

  [[nodiscard]] bool wants(std::string_view format) const {
    return std::find(formats.begin(), formats.end(), format) != formats.end();
  }
};

Result<Plan> make_plan(const ExportCommandOptions& options) {
  Plan plan{options.formats, std::nullopt};
  for (const std::string& format : plan.formats) {
    if (std::find(kFormats.begin(), kFormats.end(), format) != kFormats.end()) continue;
    return fail(ErrorCode::wrong_use, "--format {}: is none of {}", format,
                fmt::join(kFormats, ", "));
  }
  if (plan.formats.empty()) {
    plan.formats.assign(kFormats.begin(), kFormats.end());
    if (options.origin.empty()) plan.formats.pop_back();  // geojson
  }
  if (!plan.wants("geojson")) return plan;
  auto anchor = GeoAnchor::parse(options.origin);
  if (!anchor) return forward_error(anchor);
  plan.anchor = *anchor;
  return plan;
}

Result<MissionStory> read_story(const std::filesystem::path& source) {
  if (source.extension() == ".lifemap" || source.extension() == ".yaml")
    return story_of_map(source);
  return story_of_recording(source);
}

class Exporter {
 public:
  Exporter(const MissionStory& story, const Plan& plan, std::filesystem::path folder)
      : story_(story), plan_(plan), folder_(std::move(folder)) {}

  Result<void> write_all() {
    for (const auto part : {&Exporter::write_maps, &Exporter::write_tracks, &Exporter::write_csv,
                            &Exporter::write_geojson, &Exporter::write_pdf}) {
      if (auto written = (this->*part)(); !written) return written;
    }
    return {};
  }

 private:
  Result<void> write_maps() {
    for (const StoryMap& map : story_.maps) {
      const auto paths = picture_paths(story_, map);
      Result<void> done;
      if (plan_.wants("pgm")) done = files::write_occupancy_image(folder_ / map.name, map.grid);
      if (done && plan_.wants("png"))
        done = files::write_map_picture(folder_ / (map.name + ".png"), map.grid, paths, map.title);
      if (done && plan_.wants("svg"))
        done = files::write_map_picture(folder_ / (map.name + ".svg"), map.grid, paths, map.title,
                                        files::DrawingFormat::svg);
      if (!done) return done;
    }
    return {};
  }
  Result<void> write_tracks() {
    if (!plan_.wants("tum")) return {};
    for (const HelmetTrack& track : story_.tracks) {
      if (auto written = files::write_tum(folder_ / (track.name() + ".tum"), track.placed());
          !written)
        return written;
    }
    return {};
  }
  Result<void> write_csv() {
    return plan_.wants("csv") ? write_csv_files(folder_, story_) : Result<void>{};
  }
  Result<void> write_geojson() {
    if (!plan_.anchor) return {};
    return files::write_file_atomically(folder_ / "map.geojson", to_geojson(story_, *plan_.anchor));
  }
  Result<void> write_pdf() {
    if (!plan_.wants("pdf")) return {};
    const auto pdf = to_report_pdf(story_);
    if (!pdf) return forward_error(pdf);
    return files::write_file_atomically(folder_ / "report.pdf", *pdf);
  }

  const MissionStory& story_;
  const Plan& plan_;
  std::filesystem::path folder_;
};

std::string to_json(const std::filesystem::path& folder, const Plan& plan,
                    const MissionStory& story) {
  const nlohmann::ordered_json json{{"folder", folder.string()},
                                    {"formats", plan.formats},
                                    {"maps", story.maps.size()},
                                    {"paths", story.tracks.size()},
                                    {"finds", story.finds.size()},
                                    {"alerts", story.alerts.size()},
                                    {"common_map_sha256", story.common_map_sha256}};
  return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

Result<void> run(const ExportCommandOptions& options) {
  const auto plan = make_plan(options);
  if (!plan) return forward_error(plan);
  const auto story = read_story(options.source);
  if (!story) return forward_error(story);
  if (story->maps.empty() && story->tracks.empty()) {
    return fail(ErrorCode::bad_data, "{}: holds no map and no path: nothing to export",
                options.source.string());
  }
  if (auto ready = files::prepare_report_folder(options.to); !ready) return ready;
  if (auto written = Exporter(*story, *plan, options.to).write_all(); !written) return written;
  if (options.json) {
    fmt::print("{}", to_json(options.to, *plan, *story));
    return {};
  }
  fmt::print("{}: {} of {} map{}, {} path{}, {} find{}, {} alert{}\n", options.to.string(),
             fmt::join(plan->formats, " "), story->maps.size(), story->maps.size() == 1 ? "" : "s",
             story->tracks.size(), story->tracks.size() == 1 ? "" : "s", story->finds.size(),
             story->finds.size() == 1 ? "" : "s", story->alerts.size(),
             story->alerts.size() == 1 ? "" : "s");
  return {};
}

}  // namespace

int run_export_command(const ExportCommandOptions& options) {
  set_up_log("export", "warn");
  const auto done = run(options);
  if (done) return 0;
  fmt::print(stderr, "lifeline-coordinator: {}\n", done.error().text);
  return done.error().code == ErrorCode::wrong_use ? 2 : 1;
}

}  // namespace lifeline

#include "agents/helmet_report.hpp"

#include <nlohmann/json.hpp>

#include "common/base/quantile.hpp"
#include "common/base/sha256.hpp"
#include "common/files/atomic_file.hpp"
#include "common/files/finds_json.hpp"
#include "common/files/map_file.hpp"
#include "common/files/tum.hpp"

namespace lifeline {
namespace {

std::string to_json(const LayerKey& layer, const HelmetMapper& mapper, std::size_t scans_dropped,
                    const sharing::HelmetSharing& helmet) {
  const auto& map = helmet.map();
  const wire::AgentStatus status = helmet.status();
  const sharing::HelmetState state = mapper.state();
  nlohmann::ordered_json json;
  json["agent_id"] = layer.agent_id.text();
  json["map_id"] = layer.map_id.value;
  json["floor"] = layer.floor.value;
  json["scans"] = state.scans;
  json["scans_dropped"] = scans_dropped;
  json["failures"] = state.failures;
  json["lost_scans"] = mapper.lost_scans();
  json["relocalisations"] = mapper.relocalisations();
  json["epoch_applied"] = map.epoch().value;
  json["common_map_sha256"] = map.shares() ? to_hex(map.common_map_sha256()) : "";
  json["fingerprint"] = map.shares() ? to_hex(map.fingerprint()) : "";
  json["slam_ms_median"] = quantile(mapper.step_ms(), 0.5);
  json["slam_ms_p99"] = quantile(mapper.step_ms(), 0.99);
  json["explored_m2"] = status.explored_m2;
  json["bytes_sent"] = status.bytes_sent;
  json["samples_refused"] = status.samples_refused;
  json["tiles_behind"] = status.tiles_behind;
  json["duplicate_id_heard"] = status.duplicate_id_heard;
  json["detections"] = files::to_json(helmet.detections());
  return json.dump(1) + "\n";
}

}  // namespace

Result<void> write_helmet_report(const std::filesystem::path& folder, const LayerKey& layer,
                                 const HelmetMapper& mapper, std::size_t scans_dropped,
                                 const sharing::HelmetSharing& helmet) {
  const std::string& id = layer.agent_id.text();
  if (auto written = files::write_tum(folder / (id + ".tum"), mapper.trajectory()); !written)
    return written;
  if (!mapper.truth().empty()) {
    if (auto written = files::write_tum(folder / (id + ".truth.tum"), mapper.truth()); !written)
      return written;
  }
  const auto saved =
      files::save_map(folder / (id + ".lifemap"), layer, mapper.layer(), mapper.trajectory());
  if (!saved) return saved;
  return files::write_file_atomically(folder / (id + ".json"),
                                      to_json(layer, mapper, scans_dropped, helmet));
}

}  // namespace lifeline

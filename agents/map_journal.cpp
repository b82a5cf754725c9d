#include "agents/map_journal.hpp"

#include <utility>

#include <fmt/ostream.h>

namespace lifeline {
namespace {

double seconds_of(SteadyTime time) {
  return to_seconds(time.time_since_epoch());
}

double now_s() {
  return seconds_of(std::chrono::steady_clock::now());
}

}  // namespace

Result<MapJournal> MapJournal::open(const std::filesystem::path& file) {
  auto stream = std::make_unique<std::ofstream>(file);
  if (!*stream) return fail(ErrorCode::unavailable, "{}: cannot be written", file.string());
  return MapJournal(std::move(stream));
}

void MapJournal::attach(sharing::HelmetSharing& helmet) {
  helmet.set_journal(
      [file = file_.get()](TileIndex tile, Revision revision, SteadyTime scanned_at) {
        fmt::print(*file,
                   R"({{"published":[{},{}],"revision":{},"scanned_at_s":{:.6f},"at_s":{:.6f}}})"
                   "\n",
                   tile.x, tile.y, revision.value, seconds_of(scanned_at), now_s());
      },
      [file = file_.get()](const LayerKey& layer, TileIndex tile, Revision revision) {
        fmt::print(*file,
                   R"({{"fused":[{},{}],"of":"{}","revision":{},"at_s":{:.6f}}})"
                   "\n",
                   tile.x, tile.y, layer.agent_id.text(), revision.value, now_s());
      });
}

}  // namespace lifeline

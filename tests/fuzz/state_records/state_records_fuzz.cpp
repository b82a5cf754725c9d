// Any octets as a record of a state file: refused in one line, or values that can be built on. The
// first octet chooses the record.

#include <cstdint>
#include <cstdlib>
#include <string>

#include "agents/storage/helmet_memory.hpp"
#include "common/store/tile_records.hpp"
#include "coordinator/storage/merge_records.hpp"

namespace {

using namespace lifeline;

void require(bool condition) {
  if (!condition) std::abort();
}

template <typename T>
void require_clear(const Result<T>& read) {
  if (!read) require(read.error().text.find('\n') == std::string::npos);
}

void read_helmet(const std::string& key, const std::string& value) {
  store::Records records;
  records[kProgressKey] = "\x08\x01\x18\x01";  // map 1, which holds something
  records[key] = value;
  const store::StateIdentity identity{"helmet", "alpha", "mission", GridGeometry{}, 1};
  const auto memory =
      read_helmet_memory(records, {2, Timestamp(std::chrono::hours(1))}, identity, Floor{0});
  require_clear(memory);
  if (!memory || !memory->mapper) return;
  for (const StampedPose& pose : memory->mapper->trajectory) require(pose.pose.is_finite());
  require(memory->mapper->state.T_map_head.is_finite());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string value(reinterpret_cast<const char*>(data + 1), size - 1);
  switch (data[0] % 6) {
    case 0:
      require_clear(store::read_tiles({{"tile/alpha/1/0/2/3", value}}, GridGeometry{}));
      require_clear(store::read_tiles(
          {{"tile/" + value, store::peer_tile_record(Revision{1}, QuantisedTile{})}},
          GridGeometry{}));
      break;
    case 1:
      require_clear(store::read_directive({{store::kDirectiveKey, value}}, "mission"));
      break;
    case 2:
      require_clear(read_merges({{kMergesKey, value}}));
      break;
    case 3:
      read_helmet(kProgressKey, value);
      break;
    case 4:
      read_helmet(store::tile_key(kLayerPrefix, {1, -1}), value);
      break;
    default:
      read_helmet(kPlaceKey, value);
  }
  return 0;
}

#include "coordinator/dashboard/zstd_frame.hpp"

#include <zstd.h>

#include "common/base/check.hpp"

namespace lifeline::dashboard {

std::string to_zstd(std::string_view plain) {
  std::string packed(ZSTD_compressBound(plain.size()), '\0');
  const std::size_t size =
      ZSTD_compress(packed.data(), packed.size(), plain.data(), plain.size(), 1);
  LIFELINE_CHECK(ZSTD_isError(size) == 0);
  packed.resize(size);
  return packed;
}

}  // namespace lifeline::dashboard

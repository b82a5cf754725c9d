#include "tests/support/ahrs/check_receiver.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lifeline::ahrs::check_receiver("vectornav", {data, size});
  return 0;
}

// Scenes in NFF of any bytes. The first byte says whether polygons are refused or skipped.
#include "tests/fuzz/fuzz_scene.h"
#include "tests/fuzz/input_budget.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const boule::fuzz::InputBudget budget;
  using boule::PolygonPolicy;
  static const boule::fuzz::InputFolder folder;
  constexpr PolygonPolicy policies[] = {PolygonPolicy::plane, PolygonPolicy::skip,
                                        PolygonPolicy::error};
  if (size == 0) return 0;
  boule::fuzz::load_bytes(folder, "scene.nff", data + 1, size - 1, {policies[data[0] % 3]});
  return 0;
}

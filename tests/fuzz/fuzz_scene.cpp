// Scene text: a Scene, or a SceneError; nothing else may happen. Small procedural volumes are made too.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "scenes/scene_io.h"
#include "scenes/scene_plan.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace volumark;
  try {
    Scene scene = parse_scene(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz.json");
    if (scene.views.empty() || scene.transfer.points.empty() || !(scene.transfer.lo < scene.transfer.hi)) std::abort();
    const auto* spec = std::get_if<ProceduralSpec>(&scene.plan->volume);
    if (spec == nullptr) return 0;
    const glm::dvec3 n(spec->size);
    if (n.x * n.y * n.z > 4096) return 0;
    load_data(scene, {});
    if (!scene.volume || scene.hash.size() != 64) std::abort();
  } catch (const SceneError&) {
  }
  return 0;
}

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "methods/method.h"
#include "methods/raycast/raycast.h"
#include "methods/texture3d_slices/texture3d_slices.h"

namespace volumark {

// The one list of methods: add yours here.
std::span<const Method* const> method_list() {
  static const std::array<const Method*, 2> list = {&texture3d_slices(), &raycast()};
  return list;
}

const Method& find_method(const std::string& name) {
  std::vector<std::string> names;
  for (const Method* method : method_list()) {
    if (method->info().name == name) return *method;
    names.push_back(method->info().name);
  }
  throw ParameterError(
      fmt::format("unknown method \"{}\"{}; known: {}", name, did_you_mean(name, names), fmt::join(names, ", ")));
}

std::optional<std::string> unsupported_reason(const Method& method, const Scene& scene, const Values& values,
                                              const BackendInfo& backend) {
  const MethodInfo& info = method.info();
  for (const std::string& effect : effect_names(scene.effects)) {
    if (std::find(info.effects.begin(), info.effects.end(), effect) == info.effects.end()) {
      return fmt::format("effect {}: {} does not simulate it", effect, info.name);
    }
  }
  return method.unsupported(scene, values, backend);
}

}  // namespace volumark

// Gradients of the volume at its samples, as scenes/scene.h (Lighting) defines them, for textures that hold them:
// central differences of neighbouring samples, indices clamped at the border, in the volume's own axes.
#pragma once

#include <span>
#include <vector>

#include "scenes/scene.h"

namespace volumark {

// Data values in widths of the transfer window, not clamped to it; x fastest. `scene.volume` is loaded.
std::vector<float> window_values(const Scene& scene);

class SampleGradients {
 public:
  // `values`: window_values(scene); not copied.
  SampleGradients(const Scene& scene, std::span<const float> values);

  // Widths of the window a world unit.
  glm::dvec3 gradient(int i, int j, int k) const;
  // -g / max(|g|, floor): the normal, normalised at the sample. The floor is that of the scene's lighting, or of a
  // lighting by default where the scene calls for none.
  glm::dvec3 normal(int i, int j, int k) const;

 private:
  double difference(size_t here, size_t stride, int index, int size) const;

  std::span<const float> values_;
  glm::ivec3 size_;
  glm::dvec3 per_world_;
  double floor_;
};

}  // namespace volumark

#include "harness/verify/test_scenes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>

namespace volumark {

Volume volume_of(const Field& field, const glm::ivec3& size, double extent) {
  return make_volume({field, size, VoxelType::F32, extent});
}

Volume volume_of(const std::vector<float>& values, const glm::ivec3& size, const glm::dvec3& spacing) {
  Volume volume;
  volume.size = size;
  volume.type = VoxelType::F32;
  volume.spacing = spacing;
  volume.voxels.resize(values.size() * sizeof(float));
  std::memcpy(volume.voxels.data(), values.data(), volume.voxels.size());
  volume.origin = -0.5 * spacing * glm::dvec3(size - 1);
  volume.min_value = static_cast<double>(*std::min_element(values.begin(), values.end()));
  volume.max_value = static_cast<double>(*std::max_element(values.begin(), values.end()));
  return volume;
}

TransferFunction homogeneous(double extinction, const glm::dvec3& colour) { return {{{1, colour, extinction}}, 0, 2}; }

TransferFunction transfer_of(std::vector<TransferPoint> points, double lo, double hi) {
  return {std::move(points), lo, hi};
}

Scene scene_of(Volume volume, TransferFunction transfer) {
  Scene scene;
  scene.name = "hard case";
  scene.volume = std::make_shared<const Volume>(std::move(volume));
  scene.transfer = std::move(transfer);
  return scene;
}

View orthographic(const glm::dvec3& direction, double half_height, double distance) {
  View view;
  view.perspective = false;
  view.half_height = half_height;
  view.eye = -distance * glm::normalize(direction);
  view.up = std::abs(glm::normalize(direction).y) > 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
  return view;
}

View perspective(const glm::dvec3& eye, const glm::dvec3& target, double fov_y) {
  View view;
  view.eye = eye;
  view.target = target;
  view.fov_y = fov_y;
  view.near = 1e-3;
  return view;
}

Scene homogeneous_cube(int samples, double depth) {
  return scene_of(volume_of(ConstantField{1}, glm::ivec3(samples)), homogeneous(depth / 2));
}

Scene small_cloud() {
  PerlinCloudField field;
  field.seed = 7;
  field.octaves = 2;
  field.frequency = 2;
  Scene scene =
      scene_of(volume_of(field, glm::ivec3(32)), transfer_of({{0.1, {0.2, 0.4, 1}, 0}, {1, {1, 0.6, 0.2}, 6}}));
  scene.views = {perspective(3.2 * glm::dvec3(0.8138, 0.3420, 0.4698), glm::dvec3(0))};
  return scene;
}

Chord box_chord(const Ray& ray, const glm::dvec3& half) {
  Chord chord{ray.t_near, std::numeric_limits<double>::max()};
  for (int axis = 0; axis < 3; ++axis) {
    const double o = ray.origin[axis], d = ray.direction[axis];
    if (d == 0) {
      if (std::abs(o) > half[axis]) return {};
      continue;
    }
    const double a = (-half[axis] - o) / d, b = (half[axis] - o) / d;
    chord.t0 = std::max(chord.t0, std::min(a, b));
    chord.t1 = std::min(chord.t1, std::max(a, b));
  }
  return chord;
}

Chord cut_chord(Chord chord, const Ray& ray, const ClipPlane& plane) {
  const double at = glm::dot(plane.normal, ray.origin) - plane.distance, rate = glm::dot(plane.normal, ray.direction);
  if (rate == 0) return at >= 0 ? chord : Chord{};
  if (rate > 0) {
    chord.t0 = std::max(chord.t0, -at / rate);
  } else {
    chord.t1 = std::min(chord.t1, -at / rate);
  }
  return chord;
}

}  // namespace volumark

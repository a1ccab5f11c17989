// Small scenes made by hand for the tests of methods.
#pragma once

#include <cstring>
#include <glm/ext/matrix_transform.hpp>

#include "scenes/scene.h"
#include "tests/unit/shell_slices/hand_made.h"

namespace volumark::testing {

template <class T>
Volume volume_of(glm::ivec3 size, VoxelType type, const std::vector<T>& values) {
  Volume volume;
  volume.size = size;
  volume.type = type;
  volume.voxels.resize(values.size() * sizeof(T));
  std::memcpy(volume.voxels.data(), values.data(), volume.voxels.size());
  volume.min_value = static_cast<double>(*std::min_element(values.begin(), values.end()));
  volume.max_value = static_cast<double>(*std::max_element(values.begin(), values.end()));
  return volume;
}

inline Scene scene_of(Volume volume, double lo = 0, double hi = 255) {
  Scene scene;
  scene.name = "test";
  scene.volume = std::make_shared<const Volume>(std::move(volume));
  scene.transfer.points = {{lo, {1, 0, 0}, 0}, {hi, {0, 1, 0}, 4}};
  scene.transfer.lo = lo;
  scene.transfer.hi = hi;
  scene.views.push_back({});
  return scene;
}

// The scene showing what a method that draws `display` can draw; a shell of one prism instead of the volume.
inline Scene showing(Scene scene, Display display) {
  scene.display = display;
  if (display == Display::Isosurface) scene.isosurface.emplace().value = (scene.transfer.lo + scene.transfer.hi) / 2;
  if (display == Display::SlicePlane) scene.slice_plane.emplace();
  if (display == Display::Shell) {
    scene.volume.reset();
    scene.shell = std::make_shared<Shell>(one_prism(1, {.1, .1, .1}));
  }
  return scene;
}

// Unequal spacing and size, turned axes, and a place of its own.
inline Volume skewed_volume(double scale = 1, const glm::dvec3& moved = glm::dvec3(0)) {
  Volume volume = volume_of<uint8_t>({3, 5, 9}, VoxelType::U8, std::vector<uint8_t>(3 * 5 * 9, 7));
  volume.spacing = glm::dvec3(0.5, 0.25, 0.2) * scale;
  volume.axes = glm::dmat3(glm::rotate(glm::dmat4(1), 0.7, glm::normalize(glm::dvec3(1, 2, 3))));
  volume.origin = glm::dvec3(0.3, -0.2, 0.9) * scale + moved;
  return volume;
}

inline View view_at(const glm::dvec3& eye, const glm::dvec3& target, bool perspective) {
  View view;
  view.eye = eye;
  view.target = target;
  view.up = {0.1, 1, 0.2};
  view.perspective = perspective;
  view.fov_y = 0.8;
  view.half_height = 2;
  view.near = 0.01;
  return view;
}

}  // namespace volumark::testing

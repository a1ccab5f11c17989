#include <cmath>
#include <glm/geometric.hpp>

#include "scenes/scene.h"

namespace volumark {

ViewFrame frame_of(const View& view) {
  const glm::dvec3 forward = glm::normalize(view.target - view.eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, view.up));
  return {right, glm::cross(right, forward), forward};
}

namespace {

// Half the height of the picture: at distance 1 in perspective, anywhere in an orthographic view.
double half_height_of(const View& view) { return view.perspective ? std::tan(view.fov_y / 2) : view.half_height; }

}  // namespace

Ray pixel_ray(const View& view, int width, int height, double x, double y) {
  const ViewFrame frame = frame_of(view);
  const double half_height = half_height_of(view);
  const double half_width = half_height * width / height;
  const glm::dvec3 offset = frame.right * (((x + 0.5) / width * 2 - 1) * half_width) +
                            frame.up * ((1 - (y + 0.5) / height * 2) * half_height);
  if (!view.perspective) return {view.eye + offset, frame.forward, view.near};
  const glm::dvec3 direction = glm::normalize(frame.forward + offset);
  return {view.eye, direction, view.near / glm::dot(direction, frame.forward)};
}

glm::dmat4 world_to_clip(const View& view, int width, int height, double far) {
  const ViewFrame frame = frame_of(view);
  const double half_height = half_height_of(view);
  const double half_width = half_height * width / height;
  const double depth_scale = 1 / (far - view.near);
  // Rows of the matrix as functions of the world position: (axis . (p - eye)) scaled, plus a constant.
  const auto row = [&](const glm::dvec3& axis, double scale, double constant) {
    return glm::dvec4(axis * scale, constant - glm::dot(axis, view.eye) * scale);
  };
  const double z_scale = view.perspective ? far * depth_scale : depth_scale;
  const glm::dvec4 rows[4] = {row(frame.right, 1 / half_width, 0), row(frame.up, 1 / half_height, 0),
                              row(frame.forward, z_scale, -view.near * z_scale),
                              view.perspective ? row(frame.forward, 1, 0) : glm::dvec4(0, 0, 0, 1)};
  glm::dmat4 m;
  for (int column = 0; column < 4; ++column) {
    m[column] = {rows[0][column], rows[1][column], rows[2][column], rows[3][column]};
  }
  return m;
}

}  // namespace volumark

#include "methods/shell_slices/shell_frame.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

namespace volumark {
namespace {

Float4 float4(const glm::dvec3& v, double w) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
}

}  // namespace

ShellFrame shell_frame(const ShellPrisms& shell, const View& view, int width, int height, int planes) {
  ShellFrame out;
  const ViewFrame frame = frame_of(view);
  out.forward = frame.forward;
  const glm::dvec3 eye = view.eye - shell.middle;
  const double eye_depth = glm::dot(eye, frame.forward);
  double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
  for (const Prism& prism : shell.prisms) {
    for (int i = 0; i < 6; ++i) {
      const double depth = glm::dot(glm::dvec3(shell.corner(prism, i)), frame.forward);
      nearest = std::min(nearest, depth);
      farthest = std::max(farthest, depth);
    }
  }
  nearest = std::max(nearest, eye_depth + view.near);
  if (!(nearest < farthest)) return out;
  out.planes = planes;
  out.step = (farthest - nearest) / planes;
  out.first = nearest + 0.5 * out.step;

  const double half_height = view.perspective ? std::tan(view.fov_y / 2) : view.half_height;
  const double half_width = half_height * width / height;
  ShellUniforms& u = out.uniforms;
  u.depth = float4(frame.forward / out.step, -out.first / out.step);
  u.across = float4(frame.right / half_width, -glm::dot(eye, frame.right) / half_width);
  u.up = float4(frame.up / half_height, -glm::dot(eye, frame.up) / half_height);
  u.lens = {1, 0, static_cast<float>(planes), static_cast<float>(1 / shell.radius)};
  if (view.perspective) {
    u.lens[0] = static_cast<float>(out.first - eye_depth);
    u.lens[1] = static_cast<float>(out.step);
  }
  u.window = {2.F / static_cast<float>(width), -2.F / static_cast<float>(height), 0, 0};
  if (view.perspective) {
    u.window[2] = static_cast<float>(half_width);
    u.window[3] = static_cast<float>(half_height);
  }
  u.texture[2] = static_cast<float>(out.step);
  return out;
}

}  // namespace volumark

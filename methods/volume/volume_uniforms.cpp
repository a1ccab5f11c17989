#include "methods/volume/volume_uniforms.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "backends/defects.h"

namespace volumark {
namespace {

Float4 float4(const glm::dvec3& v, double w = 0) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
}

// The local frame: the volume's own axes, world units, origin at the middle of the box.
struct LocalFrame {
  glm::dvec3 middle;  // world
  glm::dmat3 to_local;
  explicit LocalFrame(const Volume& volume)
      : middle(volume.origin + volume.axes * (volume.spacing * glm::dvec3(volume.size - 1) * 0.5)),
        to_local(defect(Defect::AxesTransposed) ? volume.axes : glm::transpose(volume.axes)) {}
  glm::dvec3 point(const glm::dvec3& world) const {
    if (defect(Defect::PlacedInFloat)) return to_local * glm::dvec3(glm::vec3(world) - glm::vec3(middle));
    return to_local * (world - middle);
  }
  glm::dvec3 vector(const glm::dvec3& world) const { return to_local * world; }
};

void fill_effects(const Scene& scene, const LocalFrame& frame, VolumeUniforms& uniforms) {
  const glm::dvec3 extent = scene.volume->extent();
  const std::vector<LocalPlane> planes = local_clip_planes(scene);
  for (size_t i = 0; i < planes.size() && i < kMaxClipPlanes; ++i) {
    // local = (box - .5) * extent.
    const glm::dvec3 normal = planes[i].normal * extent;
    uniforms.clip_planes[i] = float4(normal, planes[i].distance + 0.5 * (normal.x + normal.y + normal.z));
  }
  uniforms.counts[1] = static_cast<float>(planes.size());
  if (scene.effects.lighting) fill_lights(*scene.effects.lighting, frame.middle, frame.to_local, uniforms);
}

}  // namespace

void fill_lights(const Lighting& lighting, const glm::dvec3& middle, const glm::dmat3& to_local,
                 VolumeUniforms& uniforms) {
  uniforms.lighting = float4({lighting.ambient, lighting.diffuse, lighting.specular}, lighting.shininess);
  for (size_t i = 0; i < lighting.lights.size() && i < kMaxLights; ++i) {
    const Light& light = lighting.lights[i];
    const bool point = light.kind == Light::Kind::Point;
    uniforms.lights[i].vector =
        point ? float4(to_local * (light.vector - middle), 1) : float4(glm::normalize(to_local * light.vector), 0);
    uniforms.lights[i].colour = float4(light.colour);
  }
  uniforms.counts[0] = static_cast<float>(lighting.lights.size());
  uniforms.counts[2] = lighting.specular > 0 ? 1.F : 0.F;
  uniforms.counts[3] = lighting.two_sided ? 1.F : 0.F;
}

double smallest_spacing(const Volume& volume) {
  return std::min({volume.spacing.x, volume.spacing.y, volume.spacing.z});
}

std::vector<LocalPlane> local_clip_planes(const Scene& scene) {
  const LocalFrame frame(*scene.volume);
  std::vector<LocalPlane> planes;
  for (const ClipPlane& plane : scene.effects.clip_planes) {
    planes.push_back({frame.vector(plane.normal), plane.distance - glm::dot(plane.normal, frame.middle)});
  }
  return planes;
}

ViewRays view_rays(const Volume& volume, const View& view, int width, int height) {
  const LocalFrame local(volume);
  const ViewFrame frame = frame_of(view);
  const double half_height = view.perspective ? std::tan(view.fov_y / 2) : view.half_height;
  const glm::dvec3 right = local.vector(frame.right) * (half_height * width / height);
  const glm::dvec3 up = local.vector(frame.up) * half_height;
  ViewRays rays{};
  rays.eye = local.point(view.eye);
  rays.forward = local.vector(frame.forward);
  rays.perspective = view.perspective;
  // Through the middle of the box, so that z stays small; in perspective in front of the eye.
  const double middle_depth = -glm::dot(rays.eye, rays.forward);
  rays.reference_depth = view.perspective ? std::max(middle_depth, view.near) : middle_depth;
  rays.z_near = view.near - rays.reference_depth;
  rays.direction = rays.forward;
  if (view.perspective) {
    rays.direction_x = right;
    rays.direction_y = up;
    rays.origin = rays.eye + rays.reference_depth * rays.forward;
    rays.origin_x = rays.reference_depth * right;
    rays.origin_y = rays.reference_depth * up;
  } else {
    rays.origin = rays.eye + rays.reference_depth * rays.forward;
    rays.origin_x = right;
    rays.origin_y = up;
  }
  return rays;
}

VolumeUniforms volume_uniforms(const Scene& scene, const View& view, int width, int height) {
  const Volume& volume = *scene.volume;
  const LocalFrame frame(volume);
  const glm::dvec3 extent = volume.extent();
  const glm::dvec3 size(volume.size);
  const double smallest = smallest_spacing(volume);
  const ViewRays rays = view_rays(volume, view, width, height);
  VolumeUniforms uniforms;
  uniforms.ray_origin = float4(rays.origin / extent + 0.5);
  uniforms.ray_origin_x = float4(rays.origin_x / extent);
  uniforms.ray_origin_y = float4(rays.origin_y / extent);
  uniforms.ray_direction = float4(rays.direction / extent);
  uniforms.ray_direction_x = float4(rays.direction_x / extent);
  uniforms.ray_direction_y = float4(rays.direction_y / extent);
  uniforms.depth = {static_cast<float>(defect(Defect::NearPlaneIgnored) ? -1e30 : rays.z_near), 0, 0, 0};
  uniforms.extent = float4(extent, smallest);
  uniforms.size = float4(size, 1 / smallest);
  uniforms.texture_scale = float4((size - 1.) / size);
  uniforms.texture_offset = float4((defect(Defect::HalfVoxelShift) ? 0 : 0.5) / size);
  uniforms.texel = float4(1. / size);
  uniforms.gradient_scale =
      float4(smallest / (defect(Defect::IsotropicGradients) ? glm::dvec3(smallest) : volume.spacing));
  if (scene.effects.lighting) {
    // Gradients in the program are differences over two smallest spacings, in widths of the window.
    uniforms.gradient_scale[3] = static_cast<float>(2 * scene.effects.lighting->gradient_floor);
  }
  uniforms.eye = float4(rays.eye, view.perspective ? 1 : 0);
  uniforms.forward = float4(rays.forward);
  fill_effects(scene, frame, uniforms);
  return uniforms;
}

}  // namespace volumark
